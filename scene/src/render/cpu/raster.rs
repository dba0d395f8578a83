//! Finds the triangle that each pixel of a band of rows shows.

use super::clip::{STEPS, ScreenTriangle};
use glam::{UVec2, uvec2};

/// For each of `count` bands of `height` rows, the triangles that may reach into it, in order.
pub(super) fn bin_triangles(triangles: &[ScreenTriangle], count: u32, height: u32) -> Vec<Vec<u32>> {
    let mut bands = vec![Vec::new(); count as usize];
    for (at, triangle) in triangles.iter().enumerate() {
        let [top, bottom] = row_range(triangle);
        let band = |row: i32| row.div_euclid(height as i32);
        for inside in band(top).max(0)..=band(bottom).min(count as i32 - 1) {
            bands[inside as usize].push(at as u32);
        }
    }
    bands
}

/// First and last row whose pixels' centres lie between a triangle's highest and lowest corner.
fn row_range(triangle: &ScreenTriangle) -> [i32; 2] {
    let heights = triangle.corners.map(|[_, y]| y);
    let top = heights.into_iter().fold(i32::MAX, i32::min);
    let bottom = heights.into_iter().fold(i32::MIN, i32::max);
    // Centres lie half a pixel below a row's upper edge.
    [
        (top + STEPS / 2 - 1).div_euclid(STEPS),
        (bottom - STEPS / 2).div_euclid(STEPS),
    ]
}

/// The nearest triangle at each pixel of a band.
pub(super) struct Visible {
    /// Indices of triangles, row by row; [`NONE`] where there is none.
    triangles: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Visible {
    /// Draws those of `triangles` that `inside` lists, into rows `top` and below of a picture. `size` is the
    /// picture's width and the band's height. `holes` tells, of a triangle that is not whole, where it is there.
    pub fn draw<'a, H: Fn(UVec2) -> bool + 'a>(
        triangles: &'a [ScreenTriangle],
        inside: &[u32],
        top: u32,
        size: UVec2,
        picture: UVec2,
        holes: impl Fn(&'a ScreenTriangle) -> Option<H>,
    ) -> Self {
        let width = size.x as usize;
        let mut visible = vec![NONE; width * size.y as usize];
        // Without a surface, infinitely far.
        let mut nearest = vec![0.0_f32; visible.len()];
        for &at in inside {
            let triangle = &triangles[at as usize];
            let [least, most] = triangle.reach;
            let there = holes(triangle);
            let [first, last] = row_range(triangle);
            let last = last.min((top + size.y) as i32 - 1);
            for y in first.max(top as i32)..=last {
                let Some([left, right]) = pixel_span(triangle, y, size.x) else {
                    continue;
                };
                let (start, step) = triangle.nearness_row(y as u32, picture);
                let (start, step) = ((start + step * left as f64) as f32, step as f32);
                let row = (y as usize - top as usize) * width;
                let pixels = row + left..=row + right;
                let depths = nearest[pixels.clone()].iter_mut().zip(&mut visible[pixels]);
                for (i, (nearest, visible)) in depths.enumerate() {
                    let nearness = (start + step * i as f32).clamp(least, most);
                    let seen = |there: &H| there(uvec2((left + i) as u32, y as u32));
                    if nearness > *nearest && there.as_ref().is_none_or(seen) {
                        *nearest = nearness;
                        *visible = at;
                    }
                }
            }
        }
        Visible { triangles: visible }
    }

    /// Index of the triangle seen at a pixel, counted row by row from the band's first.
    pub fn triangle_at(&self, pixel: usize) -> Option<usize> {
        match self.triangles[pixel] {
            NONE => None,
            triangle => Some(triangle as usize),
        }
    }
}

/// First and last pixel of row `y` whose centres lie in `triangle`. A centre on an edge belongs to the triangle
/// below or to the right of it, so that of two triangles with a common edge it is in exactly one.
fn pixel_span(triangle: &ScreenTriangle, y: i32, width: u32) -> Option<[usize; 2]> {
    let steps = i64::from(STEPS);
    let (mut first, mut last) = (0, i64::from(width) - 1);
    let centre = i64::from(y) * steps + steps / 2;
    for i in 0..3 {
        let [ax, ay] = triangle.corners[i].map(i64::from);
        let [bx, by] = triangle.corners[(i + 1) % 3].map(i64::from);
        let (dx, dy) = (bx - ax, by - ay);
        let top_or_left = dy < 0 || (dy == 0 && dx > 0);
        // Not negative where a pixel's centre is on the inner side of this edge: level + slope * x.
        let slope = -dy * steps;
        let level = dx * (centre - ay) - dy * (steps / 2 - ax) - i64::from(!top_or_left);
        match slope {
            0 if level < 0 => return None,
            0 => {}
            1.. => first = first.max(-level.div_euclid(slope)),
            _ => last = last.min(level.div_euclid(-slope)),
        }
    }
    (first <= last).then_some([first as usize, last as usize])
}

#[cfg(test)]
mod tests {
    use super::super::clip::project_triangle;
    use super::*;
    use glam::{Vec4, vec4};

    fn covered(corners: [Vec4; 3], size: UVec2) -> Vec<u32> {
        let triangles: Vec<_> = project_triangle(0, corners, corners.map(|corner| corner.w).into(), size).collect();
        let inside: Vec<u32> = (0..triangles.len() as u32).collect();
        let whole = |_: &ScreenTriangle| None::<fn(UVec2) -> bool>;
        let visible = Visible::draw(&triangles, &inside, 0, size, size, whole);
        (0..visible.triangles.len())
            .map(|at| u32::from(visible.triangle_at(at).is_some()))
            .collect()
    }

    #[test]
    fn triangles_around_a_point_cover_each_pixel_once() {
        let size = uvec2(33, 21);
        // Corners of the screen and beyond, and a hub at odd places, among them a pixel's very centre.
        for hub in [
            vec4(0.1, 0.2, 0.1, 1.0),
            vec4(0.0, 0.0, 0.1, 1.0),
            vec4(-0.31, 0.77, 0.1, 1.0),
        ] {
            let rim = [
                (-1.5, -1.5),
                (1.0, -2.0),
                (30.0, 0.3),
                (1.1, 1.0),
                (-0.2, 40.0),
                (-1.0, 1.0),
            ];
            let rim = rim.map(|(x, y)| vec4(x, y, 0.1, 1.0));
            let mut sum = vec![0; 33 * 21];
            for i in 0..rim.len() {
                let one = covered([hub, rim[i], rim[(i + 1) % rim.len()]], size);
                sum.iter_mut().zip(one).for_each(|(sum, one)| *sum += one);
            }
            assert!(sum.iter().all(|count| *count == 1), "{hub}: {sum:?}");
        }
    }

    #[test]
    fn what_crosses_the_camera_is_cut_at_the_near_plane() {
        // A floor one unit below, from behind the camera to far ahead: it fills the lower half.
        let size = uvec2(16, 16);
        let corner = |x: f32, depth: f32| vec4(x, -1.0, 0.1, depth);
        let near = covered([corner(-1.0e5, -50.0), corner(1.0e5, -50.0), corner(0.0, 1.0e5)], size);
        let rows: Vec<u32> = near.chunks(16).map(|row| row.iter().sum()).collect();
        assert_eq!(rows[..8], [0; 8], "{rows:?}");
        assert_eq!(rows[9..], [16; 7], "{rows:?}");
    }
}
