//! Images as textures of a device.

use super::convert::Converters;
use super::{Bench, ExecuteError};
use glam::{UVec2, UVec4, Vec4};
use straightline_codegen::ir::Scalar;
use straightline_kernels::prelude::Frame;
use straightline_manifest::{Dimension, SampleType};
use wgpu::{TextureFormat, TextureUsages, TextureView, TextureViewDimension};

/// Samples of a multisampled texel that WebGPU promises.
const MULTISAMPLES: usize = 4;

/// Returns the integer type of the texels of a texture; `None` if they are floats.
pub(super) fn integers_of(sample_type: SampleType) -> Option<Scalar> {
    match sample_type {
        SampleType::Sint => Some(Scalar::I32),
        SampleType::Uint => Some(Scalar::U32),
        SampleType::Filterable | SampleType::Unfilterable | SampleType::Depth => None,
    }
}

impl Bench {
    /// A texture of `layers`, of the shape and kind that a shader asks for, holding the `components` that it reads.
    ///
    /// # Errors
    ///
    /// If it is larger than the device holds, or not of that shape.
    pub fn create_texture(
        &self,
        layers: &[Frame<Vec4>],
        dimension: Dimension,
        sample_type: SampleType,
        components: u8,
    ) -> Result<TextureView, ExecuteError> {
        self.create_mip_texture(layers, &[], dimension, sample_type, components)
    }

    /// As [`texture`](Self::texture), with smaller levels.
    pub(super) fn create_mip_texture(
        &self,
        layers: &[Frame<Vec4>],
        smaller: &[Vec<Frame<Vec4>>],
        dimension: Dimension,
        sample_type: SampleType,
        components: u8,
    ) -> Result<TextureView, ExecuteError> {
        let size = self.size_that_fits(layers, dimension)?;
        let filterable = self.device.features().contains(wgpu::Features::FLOAT32_FILTERABLE);
        let half = sample_type == SampleType::Filterable && !filterable;
        let format = match (half, components) {
            (true, _) => TextureFormat::Rgba16Float,
            (false, 1) => TextureFormat::R32Float,
            (false, 2) => TextureFormat::Rg32Float,
            (false, _) => TextureFormat::Rgba32Float,
        };
        let count = usize::from(format.components());
        let bytes = |layers: &[Frame<Vec4>]| -> Vec<u8> {
            let mut bytes = Vec::new();
            for texel in layers.iter().flat_map(Frame::texels) {
                let lanes = &texel.to_array()[..count];
                match format {
                    TextureFormat::Rgba16Float => {
                        bytes.extend(lanes.iter().flat_map(|v| half::f16::from_f32(*v).to_le_bytes()));
                    }
                    _ => bytes.extend_from_slice(bytemuck::cast_slice(lanes)),
                }
            }
            bytes
        };
        let levels: Vec<(UVec2, usize, Vec<u8>)> = std::iter::once(layers)
            .chain(smaller.iter().map(Vec::as_slice))
            .map(|layers| {
                (
                    layers.first().map_or(UVec2::ONE, Frame::size),
                    layers.len(),
                    bytes(layers),
                )
            })
            .collect();
        let plain = self.texture_of(&levels, dimension, format);
        let view = |dimension| {
            plain.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(dimension),
                ..Default::default()
            })
        };
        let converters = || Converters::new(&self.device, &self.queue);
        Ok(match (dimension, sample_type) {
            (_, SampleType::Depth) => {
                let layer = |k| {
                    plain.create_view(&wgpu::TextureViewDescriptor {
                        dimension: Some(TextureViewDimension::D2),
                        base_array_layer: k,
                        array_layer_count: Some(1),
                        ..Default::default()
                    })
                };
                let layers: Vec<TextureView> = (0..layers.len() as u32).map(layer).collect();
                let depths = converters().create_depths(&layers, size);
                depths.create_view(&wgpu::TextureViewDescriptor {
                    dimension: Some(view_of(dimension)),
                    ..Default::default()
                })
            }
            (Dimension::D2Multisampled, _) => converters().create_multisampled(
                &view(TextureViewDimension::D2Array),
                size,
                layers.len() as u32,
                components,
            ),
            _ => view(view_of(dimension)),
        })
    }

    /// A texture of integers, by their bits.
    pub(super) fn create_integer_texture(
        &self,
        layers: &[Frame<UVec4>],
        dimension: Dimension,
        scalar: Scalar,
    ) -> Result<TextureView, ExecuteError> {
        let size = self.size_that_fits(layers, dimension)?;
        let format = match scalar {
            Scalar::I32 => TextureFormat::Rgba32Sint,
            _ => TextureFormat::Rgba32Uint,
        };
        let texels = layers.iter().flat_map(Frame::texels);
        let mut bytes = Vec::new();
        texels.for_each(|texel| bytes.extend_from_slice(bytemuck::bytes_of(texel)));
        let texture = self.texture_of(&[(size, layers.len(), bytes)], dimension, format);
        Ok(texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(view_of(dimension)),
            ..Default::default()
        }))
    }

    /// The size of layers that make a texture of a shape.
    fn size_that_fits<T: Copy>(&self, layers: &[Frame<T>], dimension: Dimension) -> Result<UVec2, ExecuteError> {
        let size = layers.first().map_or(UVec2::ONE, Frame::size);
        let limits = self.device.limits();
        let (largest, most) = match dimension {
            Dimension::D3 => (limits.max_texture_dimension_3d, limits.max_texture_dimension_3d),
            _ => (limits.max_texture_dimension_2d, limits.max_texture_array_layers),
        };
        if size.max_element() > largest || layers.len() as u32 > most {
            return Err(ExecuteError::Input(format!(
                "a picture of {}x{} with {} layers is more than this adapter holds ({largest}x{largest}, {most} layers)",
                size.x,
                size.y,
                layers.len(),
            )));
        }
        if dimension == Dimension::D2Multisampled && layers.len() != MULTISAMPLES {
            return Err(ExecuteError::Input(format!(
                "a texture of {} samples a texel, where every device has {MULTISAMPLES}: use a pattern of {MULTISAMPLES} samples, \
                 or another layout",
                layers.len()
            )));
        }
        if dimension == Dimension::Cube && (layers.len() != 6 || size.x != size.y) {
            return Err(ExecuteError::Input(format!(
                "{} pictures of {}x{} for a cube, which has six square faces",
                layers.len(),
                size.x,
                size.y
            )));
        }
        Ok(size)
    }

    /// A texture of levels, each with its size, its number of layers and its bytes.
    fn texture_of(
        &self,
        levels: &[(UVec2, usize, Vec<u8>)],
        dimension: Dimension,
        format: TextureFormat,
    ) -> wgpu::Texture {
        let extent = |size: UVec2, layers: usize| wgpu::Extent3d {
            width: size.x,
            height: size.y,
            depth_or_array_layers: layers as u32,
        };
        let (size, layers, _) = &levels[0];
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: extent(*size, *layers),
            mip_level_count: levels.len() as u32,
            sample_count: 1,
            dimension: match dimension {
                Dimension::D3 => wgpu::TextureDimension::D3,
                _ => wgpu::TextureDimension::D2,
            },
            format,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for (mip_level, (size, layers, bytes)) in (0..).zip(levels) {
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(size.x * format.block_copy_size(None).unwrap_or(16)),
                rows_per_image: Some(size.y),
            };
            let copy = wgpu::TexelCopyTextureInfo {
                mip_level,
                ..texture.as_image_copy()
            };
            self.queue.write_texture(copy, bytes, layout, extent(*size, *layers));
        }
        texture
    }
}

/// The view that a shader reads.
fn view_of(dimension: Dimension) -> TextureViewDimension {
    match dimension {
        Dimension::D2 | Dimension::D2Multisampled => TextureViewDimension::D2,
        Dimension::D2Array => TextureViewDimension::D2Array,
        Dimension::D3 => TextureViewDimension::D3,
        Dimension::Cube => TextureViewDimension::Cube,
    }
}
