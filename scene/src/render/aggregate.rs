//! Aggregate G-buffer antialiasing (Crassin, McGuire, Fatahalian and Lefohn 2015): what became of shading less often than
//! geometry is sampled, for deferred renderers.
//!
//! The samples of a pixel are gathered into at most two aggregates, each is shaded once, by the means of its samples'
//! attributes, and counts by how many samples it has. Of the publication this lacks the moments that widen the highlights
//! of averaged normals.

use super::shade::Surface;
use super::{RenderError, Renderer, check_offsets};
use crate::scene::SKY_DEPTH;
use glam::{UVec2, Vec2, Vec3, Vec4, uvec2};
use straightline_kernels::prelude::Frame;

/// Samples that differ by less are of one aggregate: the sum of one less the cosine of their normals and their step in depth over
/// the nearer depth.
const ALIKE: f32 = 0.1;

/// Samples of a pixel that are shaded once.
#[derive(Clone, Copy, Debug)]
pub struct Aggregate {
    /// Number of samples.
    pub members: usize,
    /// Place of shading, in pixels from the pixel's centre.
    pub place: Vec2,
    /// Surface that is shaded.
    pub surface: Surface,
    /// Linear colour of the surface.
    pub color: Vec3,
}

/// A picture that is shaded once or twice a pixel.
#[derive(Clone, Debug)]
pub struct Aggregated {
    /// Width and height in pixels.
    pub size: UVec2,
    /// Surfaces that the samples see: a layer for each, row by row from the top.
    pub samples: Vec<Vec<Surface>>,
    /// The aggregates of each pixel, row by row from the top; the second has no members where all samples are alike.
    pub pixels: Vec<[Aggregate; 2]>,
}

impl Aggregated {
    /// The picture: each pixel has its aggregates' colours, by how many samples they have.
    pub fn picture(&self) -> Frame<Vec4> {
        let colors = self.pixels.iter().map(|aggregates| {
            let members = aggregates.iter().map(|aggregate| aggregate.members).sum::<usize>();
            let colors = aggregates
                .iter()
                .map(|aggregate| aggregate.color * aggregate.members as f32);
            (colors.sum::<Vec3>() / members as f32).extend(1.0)
        });
        Frame::new(self.size, colors.collect())
    }
}

/// The picture whose pixels are sampled at each of `offsets`, shaded once or twice a pixel.
///
/// # Errors
///
/// As [`Renderer::draw_mean`].
pub fn render_aggregated(renderer: &dyn Renderer, offsets: &[Vec2]) -> Result<Aggregated, RenderError> {
    check_offsets(offsets)?;
    let layers: Result<Vec<Vec<Surface>>, RenderError> = offsets.iter().map(|o| renderer.draw_surfaces(*o)).collect();
    let (layers, size) = (layers?, renderer.size());
    let pixel = |k: u32| {
        let centre = uvec2(k % size.x, k / size.x).as_vec2() + 0.5;
        let samples: Vec<(Vec2, Surface)> = offsets.iter().zip(&layers).map(|(o, l)| (*o, l[k as usize])).collect();
        split_samples(&samples).map(|group| {
            let (place, surface) = mean_surface(&group);
            let color = match group.is_empty() {
                true => Vec3::ZERO,
                false => renderer.shade_surface(&surface, centre + place),
            };
            Aggregate {
                members: group.len(),
                place,
                surface,
                color,
            }
        })
    };
    let pixels = (0..size.x * size.y).map(pixel).collect();
    Ok(Aggregated {
        size,
        samples: layers,
        pixels,
    })
}

/// Difference of two surfaces; the greatest of all if they cannot be averaged.
fn surface_difference(a: &Surface, b: &Surface) -> f32 {
    let is_sky = |surface: &Surface| surface.depth >= SKY_DEPTH;
    match (is_sky(a), is_sky(b)) {
        (true, true) => 0.0,
        (false, false) if a.material == b.material => {
            1.0 - a.normal.dot(b.normal) + (a.depth - b.depth).abs() / a.depth.min(b.depth)
        }
        _ => f32::INFINITY,
    }
}

/// The samples by which of the two that differ most they are nearer to; one group if even those are alike.
fn split_samples(samples: &[(Vec2, Surface)]) -> [Vec<(Vec2, Surface)>; 2] {
    let pairs = (0..samples.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    let difference = |(i, j): &(usize, usize)| surface_difference(&samples[*i].1, &samples[*j].1);
    let farthest = pairs.max_by(|a, b| difference(a).total_cmp(&difference(b)));
    match farthest.filter(|pair| difference(pair) > ALIKE) {
        None => [samples.to_vec(), Vec::new()],
        Some((i, j)) => {
            let nearer = |s: &&(Vec2, Surface)| {
                surface_difference(&s.1, &samples[j].1) <= surface_difference(&s.1, &samples[i].1)
            };
            let (first, second): (Vec<_>, Vec<_>) = samples.iter().partition(nearer);
            let owned = |group: Vec<&(Vec2, Surface)>| group.into_iter().copied().collect();
            [owned(first), owned(second)]
        }
    }
}

/// Means of place and attributes, of the material that most of them have: of sky and of materials apart, a third in a pixel
/// follows what it is nearest to.
fn mean_surface(group: &[(Vec2, Surface)]) -> (Vec2, Surface) {
    let count = |surface: &Surface| {
        group
            .iter()
            .filter(|(_, other)| surface_difference(surface, other).is_finite())
            .count()
    };
    let commonest = group.iter().max_by_key(|(_, surface)| count(surface));
    let Some((_, kind)) = commonest else {
        return (Vec2::ZERO, Surface::SKY);
    };
    let alike = group
        .iter()
        .filter(|(_, surface)| surface_difference(kind, surface).is_finite());
    let share = 1.0 / alike.clone().count() as f32;
    let sum = |of: &dyn Fn(&Surface) -> Vec3| alike.clone().map(|(_, surface)| of(surface)).sum::<Vec3>();
    let surface = Surface {
        normal: sum(&|surface| surface.normal).normalize_or(kind.normal),
        depth: sum(&|surface| Vec3::splat(surface.depth)).x * share,
        color: sum(&|surface| surface.color) * share,
        material: kind.material,
    };
    (alike.map(|(offset, _)| *offset).sum::<Vec2>() * share, surface)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::CpuRenderer;
    use crate::scene::Scene;
    use glam::{IVec2, ivec2, vec2};

    const OFFSETS: [Vec2; 4] = [
        vec2(-0.125, -0.375),
        vec2(0.375, -0.125),
        vec2(-0.375, 0.125),
        vec2(0.125, 0.375),
    ];

    #[test]
    fn a_pixel_of_two_flat_surfaces_is_as_if_every_sample_were_shaded() {
        let surface = |depth: f32, x: f32| Surface {
            normal: vec2(x, 1.0).extend(0.0).normalize(),
            depth,
            color: Vec3::splat(depth),
            material: 0.0,
        };
        let samples: Vec<(Vec2, Surface)> = [(1.0, 0.0), (1.01, 0.01), (5.0, 0.0), (1.0, 0.02)]
            .iter()
            .zip(OFFSETS)
            .map(|((depth, x), offset)| (offset, surface(*depth, *x)))
            .collect();
        let [near, far] = split_samples(&samples).map(|group| group.len());
        assert_eq!((near.max(far), near.min(far)), (3, 1));
        assert_eq!(
            split_samples(&samples[..2])[1].len(),
            0,
            "alike surfaces are one aggregate"
        );
        assert!((mean_surface(&samples[..2]).1.depth - 1.005).abs() < 1.0e-6);
    }

    #[test]
    fn it_is_near_supersampling_and_better_than_one_sample() {
        let renderer =
            CpuRenderer::new(&Scene::from_name("creases").expect("a scene"), uvec2(160, 90)).expect("a renderer");
        let all = renderer.draw_mean(&OFFSETS).expect("a picture");
        let off = |picture: &Frame<Vec4>| {
            let pixels = (0..90).flat_map(|y| (0..160).map(move |x| ivec2(x, y)));
            let square = |at: IVec2| (picture.load(at) - all.load(at)).length_squared();
            pixels.map(square).sum::<f32>()
        };
        let (one, two) = (
            off(&renderer.draw_shaded(Vec2::ZERO).expect("a picture")),
            off(&render_aggregated(&renderer, &OFFSETS).expect("a picture").picture()),
        );
        assert!(two < 0.1 * one, "{two} against {one}");
    }
}
