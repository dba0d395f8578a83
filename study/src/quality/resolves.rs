//! Antialiasing with more than one shading sample a pixel. Pictures follow the definitions, on the CPU (`bounds`,
//! [`straightline_scene::render::render_aggregated`]); kernels resolve the same samples on a device, for timing.

use super::QualityError;
use super::bounds::{
    along_edges, by_coverage, find_stored_sample, multisampled_frames, once_a_surface, where_edges_are,
};
use super::methods::{Method, MethodKind, NEAR_LATIN4};
use super::shot::Shot;
use super::surfaces::Surfaces;
use glam::{UVec2, UVec4, Vec3, Vec4};
use straightline_bench::execute::Inputs;
use straightline_codegen::Kernel;
use straightline_kernels::prelude::Frame;
use straightline_scene::gbuffer;
use straightline_scene::render::{Aggregated, Surface};

macro_rules! kernel {
    ($file:literal, $name:expr) => {
        Kernel::from_text(
            concat!("study/kernels/resolves/", $file, ".rs"),
            include_str!(concat!("../../kernels/resolves/", $file, ".rs")),
            $name,
        )
    };
}

/// Returns the linear picture of a method that is not a filter.
///
/// # Errors
///
/// [`QualityError::NotDrawn`], if the shot was not drawn for it.
pub fn resolve_picture(method: &Method, shot: &Shot) -> Result<Frame<Vec4>, QualityError> {
    let surfaces = || {
        let surfaces = Surfaces::from_captures(&[shot.capture_for(method)?]);
        surfaces.ok_or_else(|| QualityError::NotDrawn(method.name.clone()))
    };
    Ok(match method.kind {
        MethodKind::Supersampled(samples) => shot.supersampled_mean(samples)?,
        MethodKind::Aggregated => shot.aggregated_for(method)?.picture(),
        MethodKind::Covered => by_coverage(&surfaces()?, shot.shaded_frames(16)?, &NEAR_LATIN4),
        MethodKind::Directional => {
            let offsets = gbuffer::pattern_offsets(method.pattern()).unwrap_or_default();
            along_edges(&surfaces()?, shot.shaded_frames(4)?, &offsets)
        }
        MethodKind::Classified => where_edges_are(&surfaces()?, shot.shaded_frames(4)?),
        MethodKind::Multisampled => once_a_surface(&surfaces()?, shot.shaded_frames(4)?),
        _ => shot.any_capture()?.color.clone(),
    })
}

/// Returns the passes that resolve a method's samples, in order; empty for a single sample.
pub fn resolve_kernels(method: &Method) -> Vec<Kernel> {
    match method.kind {
        MethodKind::Directional => vec![kernel!("directional", "directional")],
        MethodKind::Classified => vec![kernel!("classified", "classified")],
        MethodKind::Covered => vec![kernel!("coverage", "coverage")],
        MethodKind::Multisampled | MethodKind::Supersampled(4) => vec![kernel!("mean", "mean4")],
        MethodKind::Supersampled(16) => vec![kernel!("mean", "mean16")],
        MethodKind::Aggregated => {
            let first = if method.pattern() == "latin16" {
                "aggregate16"
            } else {
                "aggregate4"
            };
            vec![kernel!("aggregate", first), kernel!("aggregate", "aggregated")]
        }
        _ => Vec::new(),
    }
}

/// Returns the inputs of each kernel of a method from a shot.
///
/// # Errors
///
/// As [`resolve_picture`].
pub fn resolve_inputs(method: &Method, shot: &Shot) -> Result<Vec<Inputs>, QualityError> {
    let missing = || QualityError::NotDrawn(method.name.clone());
    if method.kind == MethodKind::Aggregated {
        return Ok(of_aggregates(shot.aggregated_for(method)?));
    }
    if let MethodKind::Supersampled(samples) = method.kind {
        let shaded = shot.shaded_frames(samples)?;
        let size = shaded.first().ok_or_else(missing)?.size();
        return Ok(vec![Inputs::new(size).with_layers("colors", shaded.to_vec())]);
    }
    let capture = shot.capture_for(method)?;
    let surfaces = Surfaces::from_captures(&[capture]).ok_or_else(missing)?;
    let inputs = Inputs::new(capture.size);
    Ok(match method.kind {
        MethodKind::Multisampled | MethodKind::Directional => {
            vec![inputs.with_layers("colors", multisampled_frames(&surfaces, shot.shaded_frames(4)?))]
        }
        MethodKind::Covered => {
            let colors = shot.shaded_frames(16)?;
            let kept = NEAR_LATIN4.iter().filter_map(|sample| colors.get(*sample).cloned());
            vec![
                inputs
                    .with_layers("colors", kept.collect())
                    .with_integers("codes", vec![sample_codes(&surfaces)]),
            ]
        }
        MethodKind::Classified => {
            let normal = capture.normal.as_ref().ok_or_else(missing)?;
            let rays = capture.perspective_rays().ok_or_else(missing)?;
            let samples = capture.samples.len();
            let inputs = inputs
                .with_layers(
                    "depth",
                    map_frames(&capture.depth.layers()[..samples], |z| Vec4::splat(*z)),
                )
                .with_layers("normal", map_frames(&normal.layers()[..samples], |n| n.extend(0.0)))
                .with_layers("colors", shot.shaded_frames(4)?.to_vec());
            let rays = ["ray_corner", "ray_right", "ray_down"].into_iter().zip(rays);
            let numbers = |ray: Vec3| ray.to_array().map(f64::from);
            vec![rays.fold(inputs, |inputs, (name, ray)| inputs.with_uniform(name, &numbers(ray)))]
        }
        _ => Vec::new(),
    })
}

/// Returns for each sample the index of its stored colour, in four bits: 15 for none.
fn sample_codes(surfaces: &Surfaces<'_>) -> Frame<UVec4> {
    let size = surfaces.size();
    let code = |pixel: UVec2, sample: usize| {
        find_stored_sample(surfaces, &NEAR_LATIN4, pixel, sample).map_or(15, |kept| kept as u64)
    };
    let texel = |k: u32| {
        let pixel = UVec2::new(k % size.x, k / size.x);
        let bits = (0..16).map(|sample| code(pixel, sample) << (4 * sample)).sum::<u64>();
        UVec4::new(bits as u32, (bits >> 32) as u32, 0, 1)
    };
    Frame::new(size, (0..size.x * size.y).map(texel).collect())
}

/// Returns the inputs of gathering aggregates, and of resolving them once they are shaded.
fn of_aggregates(aggregated: &Aggregated) -> Vec<Inputs> {
    let layers = |texel: fn(&Surface) -> Vec4| {
        let frame = |layer: &Vec<Surface>| Frame::new(aggregated.size, layer.iter().map(texel).collect());
        aggregated.samples.iter().map(frame).collect::<Vec<_>>()
    };
    let of =
        |texel: &dyn Fn(usize) -> Vec4| Frame::new(aggregated.size, (0..aggregated.pixels.len()).map(texel).collect());
    let members = |which: usize| of(&|k| Vec4::splat(aggregated.pixels[k][which].members as f32));
    let color = |which: usize| of(&|k| aggregated.pixels[k][which].color.extend(1.0));
    vec![
        Inputs::new(aggregated.size)
            .with_layers("geometry", layers(|surface| surface.normal.extend(surface.depth)))
            .with_layers("paint", layers(|surface| surface.color.extend(surface.material))),
        Inputs::new(aggregated.size)
            .with_image("geometry_0", members(0))
            .with_image("geometry_1", members(1))
            .with_layers("colors", vec![color(0), color(1)]),
    ]
}

fn map_frames<T: Copy>(layers: &[Frame<T>], texel: impl Fn(&T) -> Vec4) -> Vec<Frame<Vec4>> {
    let frame = |layer: &Frame<T>| Frame::new(layer.size(), layer.texels().iter().map(&texel).collect());
    layers.iter().map(frame).collect()
}
