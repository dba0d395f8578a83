//! The scene's depths and normals, at the samples and in the encodings that a kernel's options name.

use super::{Plane, Wanted};
use crate::scene::{self, FAR, NEAR, Surface};
use crate::state::State;
use crate::texels::{Picture, TexelFormat};
use glam::{Vec2, Vec3, vec2};
use straightline_kernels::sraa::{Pattern, Sraa};

/// Returns whether a texture holds data that only a scene has.
pub fn is_geometry(wanted: &Wanted<'_>) -> bool {
    let rest = wanted.name.strip_prefix("centre_").unwrap_or(wanted.name);
    match rest.strip_suffix("_grid").unwrap_or(rest) {
        "depth" | "normal" | "packed" | "low" | "low_depth" | "low_surface" | "colors" | "velocities" | "most" => true,
        "image" => wanted.compiled.kernel == "quad_bilateral",
        _ => false,
    }
}

/// Fills a texture of geometry; `None` of any other.
pub fn fill_plane(state: &mut State, wanted: &Wanted<'_>, size: [u32; 2]) -> Option<Plane> {
    let base = if wanted.framed { size } else { scene::SIZE };
    let kernel = wanted.compiled.kernel.as_str();
    let encoding = Encoding::from_options(wanted);
    let (size, layers) = match wanted.name {
        "low" | "low_depth" | "low_surface" => low_resolution_scene(state, wanted, size),
        "velocities" | "most" => (base, vec![motion_texels(kernel, base)]),
        "colors" => (
            base,
            shading_offsets(wanted)
                .into_iter()
                .map(|at| scene_colours(base, at))
                .collect(),
        ),
        "image" if is_geometry(wanted) => (base, vec![with_depth(state, base)]),
        name if is_geometry(wanted) => {
            let at = |offset: Vec2, state: &mut State| -> Vec<[f32; 4]> {
                let surfaces = state.scene.trace_surfaces(base, offset);
                surfaces
                    .iter()
                    .map(|surface| encoding.encode_surface(surface))
                    .collect()
            };
            match (wanted.layered, name.ends_with("_grid")) {
                (true, _) => {
                    let offsets = sample_offsets(wanted);
                    (base, offsets.into_iter().map(|offset| at(offset, state)).collect())
                }
                (false, true) => sample_grid(state, wanted, size),
                (false, false) => (base, vec![at(Vec2::ZERO, state)]),
            }
        }
        _ => return None,
    };
    let wide = wanted.name.ends_with("packed") || wanted.name == "packed_grid" || wanted.name.starts_with("low");
    let format = match (wanted.components, wanted.filtered) {
        (1, false) => TexelFormat::R32,
        (1, true) => TexelFormat::R16,
        (2, _) => TexelFormat::Rg16,
        (_, false) if wide || kernel == "quad_bilateral" => TexelFormat::Rgba32,
        _ => TexelFormat::Rgba16,
    };
    Some(Plane {
        name: wanted.name.to_owned(),
        size,
        format,
        layers,
        layered: wanted.layered,
        geometry: true,
    })
}

/// Offsets of the geometry samples from a pixel's centre; last the centre, where that is shaded. Of kernels without a pattern
/// the centre alone.
fn sample_offsets(wanted: &Wanted<'_>) -> Vec<Vec2> {
    let pattern = match wanted.option_choice("pattern") {
        "ordered4" => Pattern::Ordered4,
        "latin4" => Pattern::Latin4,
        "standard8" => Pattern::Standard8,
        "ordered16" => Pattern::Ordered16,
        "latin16" => Pattern::Latin16,
        "standard16" => Pattern::Standard16,
        "listed" => {
            let offsets: Vec<f32> = wanted.option_numbers("offsets").collect();
            let listed = offsets.chunks_exact(2).map(|pair| vec2(pair[0], pair[1]));
            return with_centre(wanted, listed.collect());
        }
        _ => return vec![Vec2::ZERO],
    };
    let sraa = Sraa {
        pattern,
        ..Sraa::default()
    };
    with_centre(wanted, (0..sraa.samples()).map(|k| sraa.offset(k)).collect())
}

/// With the pixel's centre as the last one, if that is shaded and the layout is one of layers.
fn with_centre(wanted: &Wanted<'_>, mut offsets: Vec<Vec2>) -> Vec<Vec2> {
    if matches!(wanted.option_choice("shading"), "centre" | "placed") && wanted.layered {
        offsets.push(Vec2::ZERO);
    }
    offsets
}

/// Offsets of the shading samples, where there are several.
fn shading_offsets(wanted: &Wanted<'_>) -> Vec<Vec2> {
    let offsets = sample_offsets(wanted);
    let listed = wanted.option_numbers("shaded");
    listed.filter_map(|k| offsets.get(k as usize).copied()).collect()
}

fn scene_colours(size: [u32; 2], offset: Vec2) -> Vec<[f32; 4]> {
    let [width, height] = size;
    let centres = (0..height).flat_map(|y| (0..width).map(move |x| vec2(x as f32 + 0.5, y as f32 + 0.5)));
    centres
        .map(|at| scene::to_texel(scene::trace_colour(size, at + offset), 1.0))
        .collect()
}

/// All samples of a pixel side by side: sample s of c columns at column s % c and row s / c.
fn sample_grid(state: &mut State, wanted: &Wanted<'_>, size: [u32; 2]) -> ([u32; 2], Vec<Vec<[f32; 4]>>) {
    let encoding = Encoding::from_options(wanted);
    let offsets = sample_offsets(wanted);
    let columns = (1..).find(|n| n * n >= offsets.len()).unwrap_or(1);
    let rows = offsets.len().div_ceil(columns);
    let [width, height] = size.map(|n| n as usize);
    let mut texels = vec![[0.0; 4]; width * columns * height * rows];
    for (k, offset) in offsets.iter().enumerate() {
        for (place, surface) in state.scene.trace_surfaces(size, *offset).iter().enumerate() {
            let (x, y) = (
                place % width * columns + k % columns,
                place / width * rows + k / columns,
            );
            texels[y * width * columns + x] = encoding.encode_surface(surface);
        }
    }
    ([(width * columns) as u32, (height * rows) as u32], vec![texels])
}

/// Encoding of a surface in a texture, found once: there are a million of them.
#[derive(Clone, Copy)]
struct Encoding {
    /// Of depths: factor and summand of the nearness, near plane over depth; `None` of depths as they are.
    depth: Option<[f32; 2]>,
    holds: Holds,
}

/// Contents of a texel.
#[derive(Clone, Copy)]
enum Holds {
    Depth,
    Normal,
    /// A normal as 0.5 + 0.5 n.
    Unorm,
    Octahedral,
    /// An octahedral normal, and the depth.
    Packed,
}

impl Encoding {
    /// As the kernel's options say.
    fn from_options(wanted: &Wanted<'_>) -> Encoding {
        let share = NEAR / FAR;
        let scale = 1.0 / (1.0 - share);
        let depth = match wanted.option_choice("depth") {
            "perspective" => Some([-scale, scale]),
            "reversed" | "projected" => Some([scale, -share * scale]),
            "reversed-infinite" => Some([1.0, 0.0]),
            _ => None,
        };
        let holds = match wanted.option_choice("normals") {
            _ if wanted.name.contains("depth") => Holds::Depth,
            "packed" => Holds::Packed,
            "octahedral" => Holds::Octahedral,
            "unorm" => Holds::Unorm,
            _ => Holds::Normal,
        };
        Encoding { depth, holds }
    }

    /// A surface's texel.
    fn encode_surface(self, surface: &Surface) -> [f32; 4] {
        let depth = match self.depth {
            None => surface.depth,
            Some([factor, summand]) => NEAR / surface.depth * factor + summand,
        };
        let half = |v: f32| 0.5 + 0.5 * v;
        let normal = surface.normal;
        match self.holds {
            Holds::Depth => [depth, 0.0, 0.0, 0.0],
            Holds::Normal => [normal.x, normal.y, normal.z, 0.0],
            Holds::Unorm => [half(normal.x), half(normal.y), half(normal.z), 0.0],
            Holds::Octahedral => {
                let folded = encode_octahedral(normal);
                [half(folded.x), half(folded.y), 0.0, 0.0]
            }
            Holds::Packed => {
                let folded = encode_octahedral(normal);
                [folded.x, folded.y, depth, 0.0]
            }
        }
    }
}

/// A unit vector unfolded to a square from -1 to 1 (Cigolle et al. 2014).
fn encode_octahedral(normal: Vec3) -> Vec2 {
    let flat = normal.truncate() / (normal.x.abs() + normal.y.abs() + normal.z.abs());
    match normal.z >= 0.0 {
        true => flat,
        false => (Vec2::ONE - vec2(flat.y.abs(), flat.x.abs())) * Vec2::ONE.copysign(flat),
    }
}

/// Motion of each pixel: to the side for kernels that show motion, and none for those that hide it.
fn motion_texels(kernel: &str, size: [u32; 2]) -> Vec<[f32; 4]> {
    let moved = if kernel == "motion_blur" {
        [18.0, 4.0, 0.0, 0.0]
    } else {
        [0.0; 4]
    };
    vec![moved; (size[0] * size[1]) as usize]
}

/// The picture with the depth as its fourth component.
fn with_depth(state: &mut State, size: [u32; 2]) -> Vec<[f32; 4]> {
    let picture = state.scene.trace_picture(size, 1);
    let surfaces = state.scene.trace_surfaces(size, Vec2::ZERO);
    let both = picture.texels.iter().zip(surfaces.iter());
    both.map(|(t, surface)| [t[0], t[1], t[2], surface.depth]).collect()
}

/// The scene at a low resolution: at half the size, or for pixel quads at the corners that those read.
fn low_resolution_scene(state: &mut State, wanted: &Wanted<'_>, size: [u32; 2]) -> ([u32; 2], Vec<Vec<[f32; 4]>>) {
    let texel = |colour: [f32; 4], surface: &Surface| match wanted.name {
        "low_depth" => [surface.depth, 0.0, 0.0, 0.0],
        "low_surface" => surface.normal.extend(surface.depth).to_array(),
        _ if wanted.option_choice("reads") == "packed" => [colour[0], colour[1], colour[2], surface.depth],
        _ => colour,
    };
    if wanted.compiled.kernel != "quad_upsampling" {
        let half = size.map(|n| n.div_ceil(2));
        let picture: std::sync::Arc<Picture> = state.scene.trace_picture(half, 1);
        let surfaces = state.scene.trace_surfaces(half, Vec2::ZERO);
        let texels = picture.texels.iter().zip(surfaces.iter());
        return (
            half,
            vec![texels.map(|(colour, surface)| texel(*colour, surface)).collect()],
        );
    }
    let factor = if wanted.option_choice("factor") == "four-times" {
        4
    } else {
        2
    };
    let corners = size.map(|n| n.div_ceil(factor) + 1);
    let at = (0..corners[1]).flat_map(|y| (0..corners[0]).map(move |x| vec2((x * factor) as f32, (y * factor) as f32)));
    let texels = at.map(|at| {
        // Half a texel inwards: what is seen just beside the corner.
        let at = at - 0.5;
        texel(
            scene::to_texel(scene::trace_colour(size, at), 1.0),
            &scene::trace_surface(size, at),
        )
    });
    (corners, vec![texels.collect()])
}
