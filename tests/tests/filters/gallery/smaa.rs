//! SMAA's three passes as a renderer runs them: by fragment shaders, its edges and weights in 8 bits.

use crate::common::forms::Example;
use std::collections::BTreeMap;
use std::path::Path;
use straightline_bench::execute::Bench;
use straightline_codegen::{Branches, Settings, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_runtime::{PassOptions, Resource};
use straightline_scene::picture;
use wgpu::TextureFormat::{R8Unorm, Rg8Unorm, Rgba8Unorm, Rgba16Float, Rgba32Float};
use wgpu::{TextureFormat, TextureUsages, TextureView};

/// A table of the reference implementation.
pub fn table(name: &str) -> Frame<Vec4> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../examples/gallery/{name}.png"));
    let stored = picture::read_integers(&path).unwrap_or_else(|e| panic!("{e}"));
    let texels = stored.texels().iter().map(|texel| texel.as_vec4() / 255.0);
    Frame::new(stored.size(), texels.collect())
}

/// A device, and the textures that passes have drawn so far.
pub struct Chain<'a> {
    bench: &'a Bench,
    size: UVec2,
    views: BTreeMap<&'static str, TextureView>,
    linear: wgpu::Sampler,
}

impl<'a> Chain<'a> {
    /// With the picture and the two tables.
    pub fn new(bench: &'a Bench, color: &Frame<Vec4>) -> Chain<'a> {
        let linear = bench.device().create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let mut chain = Chain {
            bench,
            size: color.size(),
            views: BTreeMap::new(),
            linear,
        };
        let levels = |v: f32| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
        let halves = color
            .texels()
            .iter()
            .flat_map(|t| t.to_array().map(half_bits))
            .flatten();
        chain.upload("color", color.size(), Rgba16Float, &halves.collect::<Vec<u8>>());
        let area = table("smaa_area");
        let pairs = area.texels().iter().flat_map(|t| [levels(t.x), levels(t.y)]);
        chain.upload("area", area.size(), Rg8Unorm, &pairs.collect::<Vec<u8>>());
        let search = table("smaa_search");
        let bytes = search.texels().iter().map(|t| levels(t.x));
        chain.upload("search", search.size(), R8Unorm, &bytes.collect::<Vec<u8>>());
        chain
    }

    /// The three passes of one form; the last one's picture.
    pub fn run(&mut self, unroll: Unroll, branches: Branches) -> Frame<Vec4> {
        self.draw("smaa_edges", "edges", Rg8Unorm, unroll, branches);
        self.draw("smaa_weights", "weights", Rgba8Unorm, unroll, branches);
        let drawn = self.draw("smaa_blend", "result", Rgba32Float, unroll, branches);
        self.bench.download(&drawn).unwrap_or_else(|e| panic!("{e}"))
    }

    fn texture(&self, size: UVec2, format: TextureFormat) -> wgpu::Texture {
        let target = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
        self.bench.device().create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: size.x,
                height: size.y,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST | target,
            view_formats: &[],
        })
    }

    fn upload(&mut self, name: &'static str, size: UVec2, format: TextureFormat, bytes: &[u8]) {
        let texture = self.texture(size, format);
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(bytes.len() as u32 / size.y),
            rows_per_image: None,
        };
        self.bench
            .queue()
            .write_texture(texture.as_image_copy(), bytes, layout, texture.size());
        self.views.insert(name, texture.create_view(&Default::default()));
    }

    /// Draws a pass into a texture that later passes read as `into`.
    fn draw(
        &mut self,
        name: &'static str,
        into: &'static str,
        format: TextureFormat,
        unroll: Unroll,
        branches: Branches,
    ) -> wgpu::Texture {
        let settings = Settings::new().unroll(unroll).branches(branches);
        let compiled = Example::new("examples/gallery", name).compile(&settings);
        let emitted = compiled
            .emit(&self.bench.emit_options(Stage::Fragment))
            .unwrap_or_else(|e| panic!("{e}"));
        let options = PassOptions::default().target_format(format);
        let pass = self
            .bench
            .create_pass(&emitted, &options)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let target = self.texture(self.size, format);
        let view = target.create_view(&Default::default());
        let resources: Vec<(&str, Resource<'_>)> = pass
            .inputs()
            .map(|input| match self.views.get(input) {
                Some(view) => (input, Resource::from(view)),
                None => (input, Resource::from(&self.linear)),
            })
            .collect();
        let mut encoder = self.bench.device().create_command_encoder(&Default::default());
        pass.bind(&resources, &view)
            .unwrap_or_else(|e| panic!("{name}: {e}"))
            .encode(&mut encoder);
        self.bench.queue().submit([encoder.finish()]);
        drop(resources);
        self.views.insert(into, view);
        target
    }
}

/// The bytes of a number in half precision.
fn half_bits(x: f32) -> [u8; 2] {
    half::f16::from_f32(x).to_le_bytes()
}
