//! Textures of one size.

use crate::options::{Options, Samples};
use straightline_runtime::wgpu;
use wgpu::{Device, Texture, TextureFormat, TextureUsages, TextureView, TextureViewDimension};

/// Format of the depth that is drawn.
pub const DEPTH: TextureFormat = TextureFormat::Depth32Float;
/// Format of the normals that are drawn.
pub const NORMAL: TextureFormat = TextureFormat::Rgba16Float;
/// Format of the guide that is drawn.
pub const GUIDE: TextureFormat = TextureFormat::Rgba16Float;
/// Format of the shaded and of the antialiased colour.
pub const COLOR: TextureFormat = TextureFormat::Rgba16Float;

/// Width and height of the tiles that the kernel `sraa_fit_sums` adds up.
const TILE: u32 = 16;

const DRAWN: TextureUsages = TextureUsages::RENDER_ATTACHMENT.union(TextureUsages::TEXTURE_BINDING);
const STORED: TextureUsages = TextureUsages::STORAGE_BINDING.union(TextureUsages::TEXTURE_BINDING);

/// Views that a geometry pass draws into.
#[derive(Debug)]
pub(crate) struct Surface {
    pub depth: TextureView,
    pub normal: Option<TextureView>,
    pub guide: Option<TextureView>,
}

/// Textures of the geometry.
#[derive(Debug)]
pub(crate) struct Geometry {
    /// Passes over the samples: one for all of them, or one for each.
    pub samples: Vec<Surface>,
    pub centre: Surface,
    /// Names and views as the kernels read them.
    pub read: Vec<(&'static str, TextureView)>,
}

/// Textures for the guide.
#[derive(Debug)]
pub(crate) struct GuideTargets {
    /// Sums over tiles, then over rows of tiles: of products with the colour, and of squares.
    pub tiles: [TextureView; 2],
    pub rows: [TextureView; 2],
    pub scale: TextureView,
    /// Mean of the guide over each pixel's samples.
    pub mean: TextureView,
    /// Shaded colour less the guide.
    pub difference: TextureView,
}

/// All textures of one size.
#[derive(Debug)]
pub(crate) struct Targets {
    pub geometry: Geometry,
    pub color: TextureView,
    pub place: Option<TextureView>,
    pub guide: Option<GuideTargets>,
    pub resolved: TextureView,
}

/// Layers and samples of a texture.
#[derive(Clone, Copy)]
struct Depth {
    layers: u32,
    samples: u32,
}

const FLAT: Depth = Depth { layers: 1, samples: 1 };

impl Targets {
    pub fn new(device: &Device, size: [u32; 2], options: Options) -> Targets {
        let preset = options.preset;
        let flat = |label, size, format, usage| whole(&texture(device, label, size, format, FLAT, usage));
        let guide = preset.has_guide().then(|| {
            let stored = |label, size, format| flat(label, size, format, STORED);
            let tiles = size.map(|side| side.div_ceil(TILE));
            let pair =
                |size, format| ["SRAA sums with the colour", "SRAA sums of squares"].map(|l| stored(l, size, format));
            GuideTargets {
                tiles: pair(tiles, COLOR),
                rows: pair([1, tiles[1]], TextureFormat::Rgba32Float),
                scale: stored("SRAA scale of the guide", [1, 1], COLOR),
                mean: stored("SRAA mean of the guide", size, COLOR),
                difference: stored("SRAA colour less the guide", size, COLOR),
            }
        });
        Targets {
            geometry: Geometry::new(device, size, options),
            color: flat(
                "SRAA colour",
                size,
                COLOR,
                DRAWN | TextureUsages::COPY_SRC | TextureUsages::COPY_DST,
            ),
            place: preset
                .has_place()
                .then(|| flat("SRAA place", size, TextureFormat::R32Uint, STORED)),
            guide,
            resolved: flat("SRAA resolved", size, COLOR, STORED | TextureUsages::COPY_SRC),
        }
    }
}

impl Geometry {
    fn new(device: &Device, size: [u32; 2], options: Options) -> Geometry {
        let count = options.samples.offsets().len() as u32;
        let all = [
            (true, DEPTH, ["depth", "depth_samples", "centre_depth"]),
            (
                options.has_normals(),
                NORMAL,
                ["normal", "normal_samples", "centre_normal"],
            ),
            (
                options.preset.has_guide(),
                GUIDE,
                ["guide", "guide_samples", "centre_guide"],
            ),
        ];
        let mut read = Vec::new();
        // For each attribute, the views to draw into: of the samples, and last of the centre.
        let drawn = all.map(|(is_drawn, format, [layered, multisampled, centre])| {
            is_drawn.then(|| match options.samples {
                Samples::Four => {
                    let depth = Depth {
                        layers: 1,
                        samples: count,
                    };
                    let samples = whole(&texture(device, multisampled, size, format, depth, DRAWN));
                    let own = whole(&texture(device, centre, size, format, FLAT, DRAWN));
                    read.extend([(multisampled, samples.clone()), (centre, own.clone())]);
                    vec![samples, own]
                }
                Samples::Sixteen => {
                    let depth = Depth {
                        layers: count + 1,
                        samples: 1,
                    };
                    let texture = texture(device, layered, size, format, depth, DRAWN);
                    read.push((layered, layers(&texture)));
                    (0..=count).map(|at| layer(&texture, at)).collect()
                }
            })
        });
        let [depth, normal, guide] = drawn.map(Option::unwrap_or_default);
        let surfaces = depth.into_iter().enumerate().map(|(k, depth)| Surface {
            depth,
            normal: normal.get(k).cloned(),
            guide: guide.get(k).cloned(),
        });
        let mut samples: Vec<_> = surfaces.collect();
        let centre = samples.pop().expect("the centre is the last");
        Geometry { samples, centre, read }
    }
}

fn texture(
    device: &Device,
    label: &str,
    [width, height]: [u32; 2],
    format: TextureFormat,
    Depth { layers, samples }: Depth,
    usage: TextureUsages,
) -> Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: layers,
        },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

fn whole(texture: &Texture) -> TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn layers(texture: &Texture) -> TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2Array),
        ..Default::default()
    })
}

fn layer(texture: &Texture, at: u32) -> TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2),
        base_array_layer: at,
        array_layer_count: Some(1),
        ..Default::default()
    })
}
