//! Inputs of an SRAA shader, made from a capture: the G-buffer in the layout and the encodings that its options name.

mod coarse;
mod guide;
mod offsets;
mod pattern;
mod space;

use crate::capture::Capture;
use crate::encode::{self, DepthEncoding, DepthStorage, NormalEncoding};
use crate::inputs::Inputs;
use glam::{UVec2, UVec4, Vec2, Vec3, Vec4};
use straightline_kernels::OptionValues;
use straightline_kernels::prelude::{Frame, FrameLayers};

pub use coarse::{Coarse, detect_coarse_depth};
pub(crate) use guide::{difference_at, differences as guide_differences};
pub use offsets::{Misplaced, find_misplaced};
pub(crate) use pattern::pattern_of;
pub use pattern::{PATTERNS, in_parallel, pattern_offsets, sampled_at};
pub use space::{bent_normals, has_planes};

/// Why a capture cannot feed a shader.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GBufferError {
    /// The capture lacks what the options need.
    #[error("the capture has no {what}, which {option} needs: {help}")]
    Missing {
        /// Part that the capture lacks.
        what: &'static str,
        /// The option that needs it.
        option: String,
        /// Advice for another choice.
        help: &'static str,
    },
    /// Normals are in another space than the capture says.
    #[error(
        "the capture's normals cannot be in {stated} space: {off:.0} % of them are off the planes that its depths make, and {other_off:.0} % in \
         {other} space; write \"normals\": \"{other}\" into capture.json, or use metric=depth-normals"
    )]
    NormalSpace {
        /// The space that the capture says.
        stated: &'static str,
        /// Share of normals that are off planes in it, in percent.
        off: f64,
        /// The other space.
        other: &'static str,
        /// Share of those that are off in that, in percent.
        other_off: f64,
    },
    /// The options are for another projection than the capture's.
    #[error("the capture's camera is {found}, and the shader is for projection={asked}: set projection={found}")]
    Projection {
        /// The camera's.
        found: &'static str,
        /// That of the options.
        asked: String,
    },
    /// The options ask for samples that the capture does not have.
    #[error("the shader needs {needed} geometry samples a pixel, and the capture has {found}")]
    Samples {
        /// Number of samples needed.
        needed: usize,
        /// Number of samples found.
        found: usize,
    },
}

/// Choice of a compiled kernel's option, or its default.
fn choice_or_default<'a>(options: &'a OptionValues, name: &str, default: &'a str) -> &'a str {
    options.choice(name).unwrap_or(default)
}

/// Everything that SRAA with these options may read, by the names of its bindings.
///
/// `options` are those of the compiled kernel; the capture's samples must be those of its pattern. Depth is encoded with
/// the camera's near plane and a far plane just beyond the farthest surface.
///
/// # Errors
///
/// [`GBufferError`] if the capture lacks normals, a camera or samples that the options need, and for `history`, as no capture has
/// earlier frames: [`sequence`](crate::sequence) has.
pub fn sraa_inputs(capture: &Capture, options: &OptionValues) -> Result<Inputs, GBufferError> {
    if let Some(history) = options.get("history").filter(|frames| frames.number() != Some(0.0)) {
        return Err(GBufferError::Missing {
            what: "earlier frames",
            option: format!("history={history}"),
            help: "use history=0; `straightline study motion` has frames that follow on each other",
        });
    }
    if options.flag("extra") == Some(true) {
        return Err(GBufferError::Missing {
            what: "further shading samples",
            option: "extra=true".to_owned(),
            help: "use extra=false; `straightline study error` has renderers that shade some",
        });
    }
    let projection = choice_or_default(options, "projection", "perspective");
    let found = pattern::projection_of(capture);
    if capture.camera.is_some() && projection != found {
        return Err(GBufferError::Projection {
            found,
            asked: projection.to_owned(),
        });
    }
    let metric = choice_or_default(options, "metric", "depth-normals");
    let layout = choice_or_default(options, "layout", "layers");
    let needed = match choice_or_default(options, "pattern", "latin4") {
        "listed" => options.numbers("offsets").map_or(0, |axes| axes.len() / 2),
        name => pattern_offsets(name).map_or(0, |samples| samples.len()),
    };
    if needed != capture.samples.len() {
        return Err(GBufferError::Samples {
            needed,
            found: capture.samples.len(),
        });
    }
    let planes = depth_planes(capture, options)?;
    let depth_encoding = depth_encoding(options, planes);
    let normals = match (metric, &capture.normal) {
        ("depth", _) => None,
        (_, Some(normals)) => Some(normals),
        (metric, None) => {
            return Err(GBufferError::Missing {
                what: "normals (normal.exr)",
                option: format!("metric={metric}"),
                help: "use metric=depth",
            });
        }
    };
    let mut images = Vec::new();
    match (choice_or_default(options, "normals", "float"), normals) {
        ("packed", Some(normals)) => {
            images.push((
                "packed",
                encode::pack_normals_depths(normals, &capture.depth, depth_encoding),
            ));
        }
        (normals_as, normals) => {
            if metric != "normals" {
                let stored = encode::encode_depths(&capture.depth, depth_encoding, DepthStorage::Float32);
                images.push(("depth", splat_depths(&stored)));
            }
            if let Some(normals) = normals {
                let stored = encode::encode_normals(normals, normal_encoding(normals_as));
                images.push(("normal", stored));
            }
        }
    }
    let demodulate = choice_or_default(options, "demodulate", "none");
    if demodulate != "none" {
        images.push(("albedo", needed_of(&capture.albedo, "albedo (albedo.exr)", demodulate)?));
    }
    let has_guide = choice_or_default(options, "guide", "none") == "add";
    if has_guide {
        images.push(("guide", guide::layers(capture)?.clone()));
    }
    let mut inputs = match has_guide {
        true => guide::colors(capture, options)?,
        false => Inputs::new(capture.size).with_image("color", capture.color.clone()),
    };
    if demodulate == "albedo-shadow" {
        inputs = inputs.with_image(
            "direct",
            needed_of(&capture.direct, "direct light (direct.exr)", demodulate)?,
        );
    }
    if demodulate != "none" && options.flag("rest") == Some(true) {
        let rest = needed_of(&capture.rest, "what does not follow the albedo (rest.exr)", demodulate)?;
        inputs = inputs.with_image("rest", rest);
    }
    if !capture.colors.is_empty() && !has_guide {
        inputs = inputs.with_layers("colors", capture.colors.clone());
    }
    if let Some(place) = &capture.place {
        inputs = inputs.with_integers("place", vec![encode_places(place)]);
    }
    let apart = capture.layer_count() > capture.samples.len();
    for (name, stack) in images {
        // Formats that every device can multisample: a single component in whole floats, more in half.
        let stack = if layout == "multisampled" && name != "depth" {
            encode::round_to_half(&stack)
        } else {
            stack
        };
        inputs = laid_out(
            inputs,
            name,
            stack.layers().to_vec(),
            layout,
            capture.samples.len(),
            apart,
        );
    }
    let inputs = inputs
        .with_uniform("near", &[f64::from(planes.x)])
        .with_uniform("far", &[f64::from(planes.y)]);
    if metric == "planes-normals" {
        if capture.camera.is_none() {
            return Err(GBufferError::Missing {
                what: "camera",
                option: "metric=planes-normals".to_owned(),
                help: "write `camera` into capture.json, or use metric=depth-normals",
            });
        }
        space::check_normal_space(capture)?;
    }
    Ok(match (capture.perspective_rays(), capture.parallel_rays()) {
        (Some(rays), _) => with_rays(inputs, "ray_corner", rays),
        (None, Some(rays)) => with_rays(inputs, "ray_forward", rays),
        (None, None) => inputs,
    })
}

/// Encodes the shading position of each pixel for the binding `place`.
pub fn encode_places(place: &Frame<u32>) -> Frame<UVec4> {
    let texels = place.texels().iter().map(|layer| UVec4::new(*layer, 0, 0, 1));
    Frame::new(place.size(), texels.collect())
}

/// Returns a part of the capture that demodulated light needs.
fn needed_of<T: Clone>(found: &Option<T>, what: &'static str, demodulate: &str) -> Result<T, GBufferError> {
    found.clone().ok_or_else(|| GBufferError::Missing {
        what,
        option: format!("demodulate={demodulate}"),
        help: "write it, as `straightline capture --albedo` does, or use demodulate=none",
    })
}

/// With the rays through the pixels of the whole picture, of which the first is called `name`; the other projection's is 0.
fn with_rays(inputs: Inputs, name: &str, [first, right, down]: [Vec3; 3]) -> Inputs {
    let numbers = |v: Vec3| v.to_array().map(f64::from);
    let other = match name {
        "ray_corner" => "ray_forward",
        _ => "ray_corner",
    };
    inputs
        .with_uniform(name, &numbers(first))
        .with_uniform(other, &[0.0; 3])
        .with_uniform("ray_right", &numbers(right))
        .with_uniform("ray_down", &numbers(down))
        .with_uniform("origin", &[0.0, 0.0])
}

/// Near and far plane that depth is encoded with.
fn depth_planes(capture: &Capture, options: &OptionValues) -> Result<Vec2, GBufferError> {
    let camera = match (&capture.camera, choice_or_default(options, "depth", "linear")) {
        (Some(camera), _) => camera,
        (None, "linear") => return Ok(Vec2::ONE),
        (None, encoding) => {
            return Err(GBufferError::Missing {
                what: "camera",
                option: format!("depth={encoding}"),
                help: "write `camera` into capture.json, or use depth=linear",
            });
        }
    };
    let layers = capture.depth.layers().iter();
    let depths = layers.flat_map(|layer| layer.texels().iter().copied());
    let farthest = depths
        .filter(|z| *z < crate::scene::SKY_DEPTH)
        .fold(2.0 * camera.near, f32::max);
    Ok(Vec2::new(camera.near, 1.01 * farthest))
}

fn depth_encoding(options: &OptionValues, planes: Vec2) -> DepthEncoding {
    let (near, far) = (f64::from(planes.x), f64::from(planes.y));
    let is_parallel = choice_or_default(options, "projection", "perspective") == "parallel";
    match choice_or_default(options, "depth", "linear") {
        "perspective" if is_parallel => DepthEncoding::Parallel { near, far },
        "reversed" if is_parallel => DepthEncoding::ParallelReversed { near, far },
        "perspective" => DepthEncoding::Perspective { near, far },
        "reversed" => DepthEncoding::Reversed { near, far },
        "reversed-infinite" => DepthEncoding::InfiniteReversed { near },
        _ => DepthEncoding::Linear,
    }
}

/// In the smallest format that the shader's encoding stands for.
fn normal_encoding(name: &str) -> NormalEncoding {
    match name {
        "unorm" => NormalEncoding::Rgb8,
        "octahedral" => NormalEncoding::Octahedral8,
        _ => NormalEncoding::Float,
    }
}

fn splat_depths(depths: &FrameLayers<f32>) -> FrameLayers<Vec4> {
    let layer = |l: &Frame<f32>| Frame::new(l.size(), l.texels().iter().map(|z| Vec4::splat(*z)).collect());
    FrameLayers::new(depths.layers().iter().map(layer).collect())
}

fn texel_to_f64(texel: Vec4) -> [f64; 4] {
    texel.to_array().map(f64::from)
}

/// The layers of one quantity, the pixel's centre `apart` as the last, as the images that a layout has.
fn laid_out(
    inputs: Inputs,
    name: &str,
    mut layers: Vec<Frame<Vec4>>,
    layout: &str,
    samples: usize,
    apart: bool,
) -> Inputs {
    match (layout, name) {
        ("split", "depth") => {
            let texels = layers.iter().flat_map(|layer| layer.texels());
            return inputs.with_buffer("depth_buffer", texels.map(|texel| texel_to_f64(*texel)).collect());
        }
        ("layers" | "split", _) => return inputs.with_layers(name, layers),
        _ => {}
    }
    let inputs = match (apart, layers.len() > samples) {
        (true, true) => inputs.with_image(&format!("centre_{name}"), layers.remove(samples)),
        _ => inputs,
    };
    match layout {
        "superresolution" => inputs.with_image(&format!("{name}_grid"), side_by_side(&layers)),
        _ => inputs.with_layers(&format!("{name}_samples"), layers),
    }
}

/// The samples of each pixel side by side, row by row, in as square a block as can be.
fn side_by_side(layers: &[Frame<Vec4>]) -> Frame<Vec4> {
    let columns = (1..).find(|c| c * c >= layers.len()).unwrap_or(1);
    let rows = layers.len().div_ceil(columns);
    let block = UVec2::new(columns as u32, rows as u32);
    let size = layers[0].size() * block;
    let texels = (0..size.x * size.y).map(|k| {
        let at = UVec2::new(k % size.x, k / size.x);
        let (pixel, cell) = (at / block, at % block);
        let sample = (cell.y * block.x + cell.x) as usize;
        layers
            .get(sample)
            .map_or(Vec4::ZERO, |layer| layer.load(pixel.as_ivec2()))
    });
    Frame::new(size, texels.collect())
}
