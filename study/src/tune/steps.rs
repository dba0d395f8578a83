//! Steps between surfaces in a capture: the scale of depth with which real steps count as 1 (SRAA, section 3.2).

use straightline_scene::capture::Capture;
use straightline_scene::scene::SKY_DEPTH;

/// Share of the reciprocal of depth by which a pixel must miss the planes of both sides of a step.
const MISSED: f64 = 0.01;

/// Share of all steps that may be smaller than 1.
const SMALLER: f64 = 0.1;

/// Fewest steps that tell anything.
const FEWEST: usize = 16;

/// The scale with which nine of ten steps from surface to surface are 1 or more, rounded to two digits; `None` of a view in which
/// nothing stands out.
///
/// Two neighbours are on different surfaces where neither lies on the line through the two pixels on the other's far side: the
/// reciprocal of depth is linear over a plane.
pub fn depth_scale(capture: &Capture) -> Option<f64> {
    let depth = capture.depth.layers().first()?;
    let (size, texels) = (depth.size(), depth.texels());
    let mut steps = Vec::new();
    let mut look = |at: [usize; 4]| {
        let z = at.map(|k| f64::from(texels[k]));
        if z.iter().any(|z| !(*z > 0.0 && *z < 0.5 * f64::from(SKY_DEPTH))) {
            return;
        }
        let [a, b, c, d] = z.map(|z| 1.0 / z);
        let misses = |found: f64, foreseen: f64| (found - foreseen).abs() > MISSED * found;
        if misses(c, 2.0 * b - a) && misses(b, 2.0 * c - d) {
            steps.push((z[1] - z[2]).abs());
        }
    };
    let width = size.x as usize;
    for y in 0..size.y as usize {
        for x in 0..width.saturating_sub(3) {
            look([0, 1, 2, 3].map(|k| y * width + x + k));
        }
    }
    for y in 0..(size.y as usize).saturating_sub(3) {
        for x in 0..width {
            look([0, 1, 2, 3].map(|k| (y + k) * width + x));
        }
    }
    if steps.len() < FEWEST {
        return None;
    }
    steps.sort_by(f64::total_cmp);
    let smallest = steps[(steps.len() as f64 * SMALLER) as usize];
    let digits = 10f64.powf(1.0 - (1.0 / smallest).log10().floor());
    (smallest > 0.0).then(|| (digits / smallest).round() / digits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{UVec2, Vec4, uvec2};
    use straightline_kernels::prelude::{Frame, FrameLayers};
    use straightline_scene::capture::ShadingSample;

    const SIZE: UVec2 = uvec2(40, 30);

    fn seen(depth: impl Fn(u32, u32) -> f32) -> Capture {
        let texels = (0..SIZE.x * SIZE.y).map(|k| depth(k % SIZE.x, k / SIZE.x)).collect();
        Capture {
            size: SIZE,
            samples: vec![glam::Vec2::ZERO],
            shading: ShadingSample::Centre,
            normal_space: Default::default(),
            camera: None,
            color: Frame::new(SIZE, vec![Vec4::ONE; SIZE.element_product() as usize]),
            colors: Vec::new(),
            place: None,
            depth: FrameLayers::new(vec![Frame::new(SIZE, texels)]),
            normal: None,
            albedo: None,
            direct: None,
            rest: None,
            guide: None,
            reference: None,
        }
    }

    #[test]
    fn steps_are_found_and_slopes_are_none() {
        // A slanted plane, its depth far from linear, and below it a ledge two units nearer.
        let plane = |x: u32| 1.0 / (0.02 + 0.004 * x as f32);
        let board = |x: u32, y: u32| if y > 9 { plane(x) - 2.0 } else { plane(x) };
        assert_eq!(depth_scale(&seen(board)), Some(0.5));
        assert_eq!(depth_scale(&seen(|x, _| plane(x))), None);
        // A silhouette before the sky tells nothing of depths.
        let silhouette = |x: u32, _: u32| if x < 20 { 3.0 } else { SKY_DEPTH };
        assert_eq!(depth_scale(&seen(silhouette)), None);
    }
}
