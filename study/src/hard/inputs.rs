//! Conversion of a case to the images and numbers that a kernel reads.

use super::HardError;
use super::case::{Case, Normal, Place, Seen};
use super::form::{self, Family, KernelForm, choice_or};
use glam::{UVec2, UVec4, Vec2, Vec3, Vec4, uvec2, vec2};
use straightline_bench::execute::Inputs;
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_kernels::{OptionValue, OptionValues};
use straightline_oracle::oracle::{self, Shading, SraaParams};
use straightline_scene::encode::{self, DepthEncoding, NormalEncoding};

/// Inputs of a form in a case, and the parameters of its definition.
pub struct CaseInputs {
    /// Images and uniforms.
    pub inputs: Inputs,
    /// Parameters of SRAA's definition.
    pub params: Option<SraaParams>,
}

/// Builds the inputs of a form with `options` in a case.
pub fn build_case_inputs(case: &Case, form: &KernelForm, options: &OptionValues) -> Result<CaseInputs, HardError> {
    let inputs = match form.family {
        Family::Sraa => {
            let params = sraa_params(case, options)?;
            return Ok(CaseInputs {
                inputs: sraa_inputs(case, &params),
                params: Some(params),
            });
        }
        Family::Stalker | Family::TabulaRasa => {
            let projected = form.family == Family::Stalker && choice_or(options, "depth", "projected") == "projected";
            let near = f64::from(case.planes[0]);
            let depth = image_at_centres(case, |seen| {
                Vec4::splat(match projected {
                    true => DepthEncoding::InfiniteReversed { near }.encode(seen.depth.into()) as f32,
                    false => seen.depth,
                })
            });
            let normal = image_at_centres(case, |seen| normal_vector(seen).extend(0.0));
            Inputs::new(case.size)
                .with_image("depth", depth)
                .with_image("normal", normal)
                .with_image("color", image_at_centres(case, |seen| seen.color))
        }
        Family::Upsampling => upsampling_inputs(case, options),
        Family::Bilateral => Inputs::new(case.size).with_image(
            "image",
            image_at_centres(case, |seen| seen.color.truncate().extend(seen.depth)),
        ),
        Family::Convolution => Inputs::new(case.size).with_image("image", image_at_centres(case, |seen| seen.color)),
        Family::Ssao => Inputs::new(case.size)
            .with_image("depth", image_at_centres(case, |seen| Vec4::splat(seen.depth)))
            .with_image("normal", image_at_centres(case, |seen| normal_vector(seen).extend(0.0))),
        Family::Pcf | Family::Pcss => Inputs::new(case.size)
            .with_image(
                "shadow",
                image_from_fn(case.map, |texel| Vec4::splat(case.shadow_at(texel))),
            )
            .with_image(
                "coord",
                image_from_fn(case.size, |pixel| case.coordinates_at(pixel).extend(0.0)),
            )
            .with_image("lookup", cubic_table(form::shadow_filter_width(options) as f32 / 2.0)),
    };
    Ok(CaseInputs { inputs, params: None })
}

/// Returns the definition's parameters, with uniforms set by the case.
fn sraa_params(case: &Case, options: &OptionValues) -> Result<SraaParams, OracleFailure> {
    let mut params = SraaParams::default();
    for (name, value) in options {
        match value {
            OptionValue::Uniform => {}
            OptionValue::Override(default) => {
                params.set(name, default)?;
                continue;
            }
            value => {
                params.set(name, value)?;
                continue;
            }
        }
        let uniform = name.replace('-', "_");
        if let Some((_, number)) = case.uniforms.iter().find(|(known, _)| *known == uniform) {
            match name.as_str() {
                "tau" => params.tau = *number,
                "depth-scale" => params.depth_scale = *number,
                _ => params.set(name, &OptionValue::Number(*number))?,
            }
        }
    }
    Ok(params)
}

type OracleFailure = oracle::OracleError;

fn sraa_inputs(case: &Case, params: &SraaParams) -> Inputs {
    let places = params
        .sample_offsets()
        .into_iter()
        .map(|[x, y]| vec2(x as f32, y as f32));
    let mut places: Vec<(Vec2, Option<usize>)> = places.enumerate().map(|(k, at)| (at, Some(k))).collect();
    if matches!(params.shading, Shading::Centre | Shading::Placed) {
        places.push((Vec2::ZERO, None));
    }
    let layers = |texel: &dyn Fn(&Seen) -> Vec4| -> Vec<Frame<Vec4>> {
        let layer = |(offset, sample): &(Vec2, Option<usize>)| {
            image_from_fn(case.size, |pixel| texel(&case.surface_at(pixel, *offset, *sample)))
        };
        places.iter().map(layer).collect()
    };
    let size = case.size.as_dvec2();
    let [near, far] = case.planes.map(f64::from);
    let mut inputs = Inputs::new(case.size)
        .with_image("color", image_at_centres(case, |seen| seen.color))
        .with_uniform("near", &[near])
        .with_uniform("far", &[far])
        .with_uniform("ray_corner", &[-1.0, 1.0, -1.0])
        .with_uniform("ray_right", &[2.0 / size.x, 0.0, 0.0])
        .with_uniform("ray_down", &[0.0, -2.0 / size.y, 0.0])
        .with_uniform("origin", &[0.0, 0.0])
        .with_uniform("tau", &[params.tau])
        .with_uniform("depth_scale", &[params.depth_scale]);
    if params.shading == Shading::Placed {
        // No two neighbours have the same sample.
        let layer = |pixel: UVec2| ((3 * pixel.x + 7 * pixel.y) % places.len() as u32) as usize;
        let shaded = image_from_fn(case.size, |pixel| {
            let (offset, sample) = places[layer(pixel)];
            case.surface_at(pixel, offset, sample).color
        });
        let pixels = (0..case.size.y).flat_map(|y| (0..case.size.x).map(move |x| uvec2(x, y)));
        let texels = pixels.map(|pixel| UVec4::new(layer(pixel) as u32, 0, 0, 1));
        let place = Frame::new(case.size, texels.collect());
        inputs = inputs.with_image("color", shaded).with_integers("place", vec![place]);
    }
    if params.normals == oracle::Normals::Packed {
        let part = |of: &dyn Fn(&Seen) -> Vec4| FrameLayers::new(layers(of));
        let normals = map_layers(&part(&|seen| normal_vector(seen).extend(0.0)), Vec4::truncate);
        let depths = map_layers(&part(&|seen| Vec4::splat(seen.depth)), |texel| texel.x);
        let packed = encode::pack_normals_depths(&normals, &depths, DepthEncoding::Linear);
        return inputs.with_layers("packed", packed.layers().to_vec());
    }
    let depths = layers(&|seen| Vec4::splat(encode_depth(case, params.depth, seen.depth)));
    inputs = match params.layout {
        oracle::Layout::Split => {
            let texels = depths.iter().flat_map(Frame::texels);
            inputs.with_buffer("depth_buffer", texels.map(|depth| [f64::from(depth.x); 4]).collect())
        }
        _ => inputs.with_layers("depth", depths),
    };
    inputs.with_layers("normal", layers(&|seen| encode_normal(params.normals, seen)))
}

fn map_layers<A: Copy, B: Copy>(stack: &FrameLayers<A>, of: impl Fn(A) -> B) -> FrameLayers<B> {
    let layer = |l: &Frame<A>| Frame::new(l.size(), l.texels().iter().map(|t| of(*t)).collect());
    FrameLayers::new(stack.layers().iter().map(layer).collect())
}

/// Encodes a linear depth for a texture.
fn encode_depth(case: &Case, encoding: oracle::Depth, depth: f32) -> f32 {
    let ([near, far], depth) = (case.planes.map(f64::from), f64::from(depth));
    // The definitions' products with infinities are NaN.
    let endless = far.is_infinite() || depth.is_infinite();
    let value = match encoding {
        oracle::Depth::Linear => return depth as f32,
        oracle::Depth::Perspective if endless => (1.0 - near / depth).clamp(0.0, 1.0),
        oracle::Depth::Reversed if endless => (near / depth).clamp(0.0, 1.0),
        oracle::Depth::Perspective => DepthEncoding::Perspective { near, far }.encode(depth),
        oracle::Depth::Reversed => DepthEncoding::Reversed { near, far }.encode(depth),
        oracle::Depth::ReversedInfinite => DepthEncoding::InfiniteReversed { near }.encode(depth),
    };
    case.storage.round(value) as f32
}

/// Encodes a normal for a texture.
fn encode_normal(encoding: oracle::Normals, seen: &Seen) -> Vec4 {
    let vector = match seen.normal {
        Normal::Texel(texel) => return texel,
        Normal::Vector(vector) => vector,
    };
    let encoding = match encoding {
        oracle::Normals::Unorm => NormalEncoding::Rgb8,
        oracle::Normals::Octahedral => NormalEncoding::Octahedral8,
        _ => return vector.extend(0.0),
    };
    let [x, y, z] = encoding.encode(vector.as_dvec3().to_array());
    Vec4::new(x as f32, y as f32, z as f32, 1.0)
}

/// Returns the weights of a cubic B-spline that ends at `half` texels, for `weights=lookup`: of a texel and the next, and
/// the share of the next.
fn cubic_table(half: f32) -> Frame<Vec4> {
    let weight = |distance: f32| match 2.0 * distance.abs() / half {
        x if x < 1.0 => 2.0 / 3.0 - x * x + 0.5 * x * x * x,
        x if x < 2.0 => (2.0 - x).powi(3) / 6.0,
        _ => 0.0,
    };
    image_from_fn(uvec2(513, 1), |texel| {
        let first = texel.x as f32 / 512.0 * (2.0 * half - 1.0) - half;
        let [near, far] = [first, first + 1.0].map(weight);
        let share = if near + far > 0.0 { far / (near + far) } else { 0.5 };
        Vec4::new(near + far, share, 0.0, 0.0)
    })
}

/// Returns the normal of a case, without encoding.
fn normal_vector(seen: &Seen) -> Vec3 {
    match seen.normal {
        Normal::Vector(vector) => vector,
        Normal::Texel(texel) => texel.truncate(),
    }
}

/// Returns the frame at full resolution, and the corner of every 2×2 (or 4×4) pixels as the low resolution.
fn upsampling_inputs(case: &Case, options: &OptionValues) -> Inputs {
    let factor = match choice_or(options, "factor", "twice") {
        "four-times" => 4,
        _ => 2,
    };
    let packed = choice_or(options, "reads", "packed") == "packed";
    let size = case.size.map(|n| n.div_ceil(factor) + 1);
    let low = |texel: &dyn Fn(&Seen) -> Vec4| {
        image_from_fn(size, |corner| {
            let at = corner * factor;
            texel(&(case.seen)(&Place {
                pixel: at.min(case.size - 1),
                size: case.size,
                at: at.as_vec2(),
                sample: None,
            }))
        })
    };
    Inputs::new(case.size)
        .with_image(
            "low",
            low(&|seen| match packed {
                true => seen.color.truncate().extend(seen.depth),
                false => seen.color,
            }),
        )
        .with_image("low_surface", low(&|seen| normal_vector(seen).extend(seen.depth)))
        .with_image("depth", image_at_centres(case, |seen| Vec4::splat(seen.depth)))
        .with_image("normal", image_at_centres(case, |seen| normal_vector(seen).extend(0.0)))
}

fn image_at_centres(case: &Case, texel: impl Fn(&Seen) -> Vec4) -> Frame<Vec4> {
    image_from_fn(case.size, |pixel| texel(&case.surface_at(pixel, Vec2::ZERO, None)))
}

fn image_from_fn(size: UVec2, texel: impl Fn(UVec2) -> Vec4) -> Frame<Vec4> {
    let pixels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| uvec2(x, y)));
    Frame::new(size, pixels.map(texel).collect())
}
