//! Contents of a kernel's textures: the picture, or the scene's geometry as the kernel's options say that it is stored.

mod geometry;

use crate::compiled::Asked;
use crate::errors::Refusal;
use crate::scene::{self, FAR, NEAR};
use crate::state::State;
use crate::texels::{Picture, TexelFormat};
use serde::Deserialize;
use serde_json::{Map, Value, json};
use straightline_codegen::Compiled;
use straightline_manifest::{BindingKind, Dimension, Extent, SampleType};
use straightline_page_abi::Message;

/// For which kernel, and at which size of its result.
#[derive(Deserialize)]
pub struct InputsRequest {
    #[serde(flatten)]
    asked: Asked,
    size: [u32; 2],
}

/// Contents of one texture.
pub struct Plane {
    /// The texture's name in the kernel.
    pub name: String,
    /// Width and height.
    pub size: [u32; 2],
    /// Format of the stored texels.
    pub format: TexelFormat,
    /// Layers of rows from the top.
    pub layers: Vec<Vec<[f32; 4]>>,
    /// True if the texture is an array of layers, be it of one.
    pub layered: bool,
    /// True if the texture holds the scene's geometry, which a visitor's picture does not have.
    pub geometry: bool,
}

/// A texture that is to be filled.
struct Wanted<'a> {
    name: &'a str,
    /// Components that the kernel uses.
    components: u8,
    /// True if a sampler filters the texture.
    filtered: bool,
    /// True if the texture has the size of the result, false if that of the picture.
    framed: bool,
    layered: bool,
    compiled: &'a Compiled,
}

impl Wanted<'_> {
    /// Choice of an option; empty of a kernel that has none of this name.
    fn option_choice(&self, name: &str) -> &str {
        self.compiled.options.choice(name).unwrap_or_default()
    }

    /// Numbers of an option that is a list.
    fn option_numbers(&self, name: &str) -> impl Iterator<Item = f32> {
        let numbers = self.compiled.options.numbers(name).unwrap_or_default().iter();
        numbers.map(|number| *number as f32)
    }
}

/// Textures as bytes, one after the other, and the uniforms that go with the scene.
pub fn fill_inputs(state: &mut State, request: &InputsRequest) -> Result<Message, Refusal> {
    let planes = fill_planes(state, &request.asked, request.size)?;
    let (mut bytes, mut textures) = (Vec::new(), Vec::new());
    for plane in &planes {
        let offset = bytes.len();
        let texels: usize = plane.layers.iter().map(Vec::len).sum();
        bytes.reserve(texels * plane.format.texel_bytes() + 8);
        for texel in plane.layers.iter().flatten() {
            plane.format.write_texel(*texel, &mut bytes);
        }
        textures.push(json!({
            "name": plane.name, "width": plane.size[0], "height": plane.size[1], "layers": plane.layers.len(),
            "layered": plane.layered, "format": plane.format.name(), "offset": offset, "length": bytes.len() - offset,
        }));
        // Textures are aligned for views of floats.
        bytes.resize(bytes.len().next_multiple_of(8), 0);
    }
    let json = json!({
        "textures": textures,
        "uniforms": scene_uniforms(request.size),
        "geometry": planes.iter().any(|plane| plane.geometry),
        "picture": !planes.is_empty(),
    });
    Ok(Message { json, bytes })
}

/// Uniforms whose values are the scene's, by the names that the kernels have for them.
fn scene_uniforms(size: [u32; 2]) -> Map<String, Value> {
    let [corner, right, down] = scene::picture_rays(size);
    let all = [
        ("ray_corner", json!(corner.to_array())),
        ("ray_right", json!(right.to_array())),
        ("ray_down", json!(down.to_array())),
        ("origin", json!([0, 0])),
        ("near", json!([NEAR])),
        ("far", json!([FAR])),
        ("focal", json!([scene::focal_length(size)])),
    ];
    all.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Fills every texture of a kernel.
///
/// # Errors
///
/// The first texture of a kind that the page cannot fill, by name.
pub fn fill_planes(state: &mut State, asked: &Asked, size: [u32; 2]) -> Result<Vec<Plane>, Refusal> {
    let compiled = state.cached_compiled(asked)?;
    let manifest = state.cached_manifest(asked)?;
    let mut wanted = Vec::new();
    for binding in &manifest.bindings {
        match &binding.kind {
            BindingKind::Texture {
                dimension,
                sample_type,
                components,
                extent,
                ..
            } => {
                let refuse = |what: &str| Err(Refusal::from_message(&format!("`{}` is {what}", binding.name)));
                let layered = match dimension {
                    Dimension::D2 => false,
                    Dimension::D2Array => true,
                    Dimension::D2Multisampled => return refuse("a multisampled texture, which only drawing can fill"),
                    Dimension::D3 => return refuse("a volume, and the page has none to fill it with"),
                    Dimension::Cube => return refuse("a cube, and the page has none to fill it with"),
                };
                let filtered = match sample_type {
                    SampleType::Filterable => true,
                    SampleType::Unfilterable => false,
                    SampleType::Depth => return refuse("a shadow map, which only drawing can fill"),
                    SampleType::Sint | SampleType::Uint => {
                        return refuse("a texture of integers, and the page has none");
                    }
                };
                wanted.push(Wanted {
                    name: &binding.name,
                    components: *components,
                    filtered,
                    framed: *extent == Extent::Output,
                    layered,
                    compiled: &compiled,
                });
            }
            BindingKind::Buffer { .. } => {
                return Err(Refusal::from_message(&format!(
                    "`{}` is a buffer, and the page has none to fill it with",
                    binding.name
                )));
            }
            BindingKind::Sampler { .. } | BindingKind::Uniform { .. } => {}
        }
    }
    let by_geometry = wanted.iter().any(geometry::is_geometry);
    let filled = wanted.iter().map(|wanted| {
        geometry::fill_plane(state, wanted, size).unwrap_or_else(|| {
            let base = if wanted.framed { size } else { scene::SIZE };
            let texels = match &state.picture {
                Some(picture) if !by_geometry => fit_picture(picture, wanted, size),
                _ => Picture::clone(&state.scene.trace_picture(base, 1)),
            };
            picture_plane(wanted, texels)
        })
    });
    let mut planes: Vec<Plane> = filled.collect();
    for plane in &mut planes {
        plane.geometry = by_geometry;
    }
    Ok(planes)
}

/// The visitor's picture at the size that a texture must have: that of the result, texel by texel.
fn fit_picture(picture: &Picture, wanted: &Wanted<'_>, size: [u32; 2]) -> Picture {
    if !wanted.framed || picture.size == size {
        return picture.clone();
    }
    let [width, height] = size.map(i64::from);
    let [across, down] = picture.size.map(i64::from);
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x * across / width, y * down / height)));
    Picture {
        size,
        texels: texels.map(|(x, y)| picture.texel_at(x, y)).collect(),
    }
}

/// A texture that shows a picture: its colour, or of one component how bright it is.
fn picture_plane(wanted: &Wanted<'_>, picture: Picture) -> Plane {
    let format = match (wanted.components, wanted.filtered) {
        (1, true) => TexelFormat::R16,
        (1, false) => TexelFormat::R32,
        (2, _) => TexelFormat::Rg16,
        _ => TexelFormat::Rgba16,
    };
    let bright = |t: [f32; 4]| [0.2126 * t[0] + 0.7152 * t[1] + 0.0722 * t[2], 0.0, 0.0, 0.0];
    let layer = match wanted.components {
        1 => picture.texels.into_iter().map(bright).collect(),
        _ => picture.texels,
    };
    Plane {
        name: wanted.name.to_owned(),
        size: picture.size,
        format,
        layers: vec![layer],
        layered: false,
        geometry: false,
    }
}

/// The picture that is filtered; or the scene, with so many samples a pixel: four floats a pixel.
pub fn reference_picture(state: &mut State, samples: u32, scene: bool) -> Message {
    let picture = match &state.picture {
        Some(picture) if !scene => picture.clone(),
        _ => Picture::clone(&state.scene.trace_picture(scene::SIZE, samples)),
    };
    let values = picture.texels.iter().flatten();
    Message {
        json: json!({ "width": picture.size[0], "height": picture.size[1] }),
        bytes: values.flat_map(|value| value.to_le_bytes()).collect(),
    }
}
