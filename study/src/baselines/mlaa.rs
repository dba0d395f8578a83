//! MLAA (Reshetov 2009, "Morphological Antialiasing"), on the CPU, after its publication.
//!
//! Two pixels that differ in a colour by sixteen steps of 255 have an edge between them. A run of edges between two rows is
//! a separation line; the edges that meet its ends at right angles make it a Z (one up, one down), a U (both to the same
//! side) or an L (at one end only). The silhouette is taken to go from the middle of such an edge to the middle of the
//! line, in an L to its far end; each pixel that it cuts takes the colour across the line for the area that it loses.
//! Columns are treated as rows.
//!
//! The paper moves the ends of the silhouette from the middle of the edges so that blended colours of many-coloured
//! pictures go on beyond them; here they stay in the middle, as it has them for two colours. Ends at which edges meet to
//! both sides are no end of a shape.

use glam::{UVec2, Vec3, Vec4};
use rayon::prelude::*;
use straightline_kernels::prelude::Frame;

/// Smallest difference of a colour that counts as an edge: a step of the upper four of eight bits.
const EDGE: f32 = 16.0 / 255.0;

/// A rounding less than a step of 8 bits.
const ROUNDING: f32 = 1.0e-4;

/// Returns the antialiased picture. Colours are as sent to a display, each in 0..=1; alpha is unchanged.
pub fn apply_mlaa(picture: &Frame<Vec4>) -> Frame<Vec4> {
    let UVec2 { x: width, y: height } = picture.size();
    let (width, height) = (width as usize, height as usize);
    let colors: Vec<Vec3> = picture.texels().iter().map(|texel| texel.truncate()).collect();
    let rows = Grid {
        colors: &colors,
        along: width,
        across: height,
        step: 1,
        stride: width,
    };
    let columns = Grid {
        along: height,
        across: width,
        step: width,
        stride: 1,
        ..rows
    };
    let mut blends: Vec<(usize, usize, f32)> = rows.find_blends();
    blends.extend(columns.find_blends());
    let mut sums = vec![(Vec3::ZERO, 0.0f32); colors.len()];
    for (pixel, other, area) in blends {
        sums[pixel].0 += area * colors[other];
        sums[pixel].1 += area;
    }
    let texels = picture.texels().iter().zip(sums).map(|(texel, (sum, area))| {
        let kept = (1.0 - area).max(0.0);
        ((kept * texel.truncate() + sum) / (kept + area)).extend(texel.w)
    });
    Frame::new(picture.size(), texels.collect())
}

/// A picture whose separation lines are looked for along its rows, or along its columns.
#[derive(Clone, Copy)]
struct Grid<'a> {
    colors: &'a [Vec3],
    /// Number of pixels in a row, and number of rows.
    along: usize,
    across: usize,
    /// Offsets to the next pixel of a row, and to the next row.
    step: usize,
    stride: usize,
}

/// Edge at a right angle to a separation line, at its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// On the side of the row before the line.
    Before,
    /// On the side of the row after it.
    After,
    /// Nowhere, or on both sides.
    None,
}

impl Grid<'_> {
    fn at(&self, row: usize, k: usize) -> usize {
        row * self.stride + k * self.step
    }

    fn has_edge(&self, a: usize, b: usize) -> bool {
        (self.colors[a] - self.colors[b]).abs().max_element() >= EDGE - ROUNDING
    }

    /// Returns every pixel that a silhouette cuts, the pixel across the separation line, and the exchanged area.
    fn find_blends(&self) -> Vec<(usize, usize, f32)> {
        let lines = (0..self.across.saturating_sub(1)).into_par_iter();
        lines.flat_map_iter(|row| self.of_line(row)).collect()
    }

    /// Returns the blends of the separation lines between a row and the next.
    fn of_line(&self, row: usize) -> Vec<(usize, usize, f32)> {
        let is_edge = |k: usize| self.has_edge(self.at(row, k), self.at(row + 1, k));
        let mut found = Vec::new();
        let mut k = 0;
        while k < self.along {
            let first = k;
            while k < self.along && is_edge(k) {
                k += 1;
            }
            if k > first {
                self.of_run(row, first, k, &mut found);
            }
            k += 1;
        }
        found
    }

    /// Collects the blends of the line between pixels `first..end` of a row and the next.
    fn of_run(&self, row: usize, first: usize, end: usize, found: &mut Vec<(usize, usize, f32)>) {
        let ends = [self.line_end(row, first), self.line_end(row, end)];
        let length = (end - first) as f32;
        let whole = match ends {
            [End::None, _] | [_, End::None] => length,
            _ => 0.5 * length,
        };
        for (which, side) in ends.into_iter().enumerate() {
            let (own, other) = match side {
                End::Before => (row, row + 1),
                End::After => (row + 1, row),
                End::None => continue,
            };
            for k in 0..end - first {
                let area = cut_area(k as f32, whole);
                if area <= 0.0 {
                    break;
                }
                let at = if which == 0 { first + k } else { end - 1 - k };
                found.push((self.at(own, at), self.at(other, at), area));
            }
        }
    }

    /// Returns the edge that meets the separation line after `row` between its pixels `k - 1` and `k`.
    fn line_end(&self, row: usize, k: usize) -> End {
        if k == 0 || k >= self.along {
            return End::None;
        }
        let meets = |row: usize| self.has_edge(self.at(row, k - 1), self.at(row, k));
        match (meets(row), meets(row + 1)) {
            (true, false) => End::Before,
            (false, true) => End::After,
            _ => End::None,
        }
    }
}

/// Returns the area below a silhouette that falls from one half to zero over `whole` pixels, in the pixel that begins after
/// `start` of them.
fn cut_area(start: f32, whole: f32) -> f32 {
    let end = (start + 1.0).min(whole);
    if end <= start {
        return 0.0;
    }
    0.5 * ((end - start) - (end * end - start * start) / (2.0 * whole))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{uvec2, vec4};

    /// Dark `#` and light `.` pixels.
    fn picture(rows: &[&str]) -> Frame<Vec4> {
        let light = |c: char| if c == '#' { 0.0 } else { 1.0 };
        let texels = rows
            .iter()
            .flat_map(|row| row.chars().map(light))
            .map(|v| vec4(v, v, v, 1.0));
        Frame::new(uvec2(rows[0].len() as u32, rows.len() as u32), texels.collect())
    }

    fn light(frame: &Frame<Vec4>) -> Vec<Vec<f32>> {
        let width = frame.size().x as usize;
        let rows = frame.texels().chunks(width);
        rows.map(|row| row.iter().map(|texel| texel.x).collect()).collect()
    }

    fn mirrored(frame: &Frame<Vec4>) -> Frame<Vec4> {
        let size = frame.size();
        let texels = (0..size.x * size.y).map(|k| frame.texels()[((k % size.y) * size.x + k / size.y) as usize]);
        Frame::new(uvec2(size.y, size.x), texels.collect())
    }

    /// Down by one in four pixels, through the middles of the steps. The line between rows is a Z of four pixels, whose
    /// silhouette takes 3/8 and 1/8 of the pixels at either end; so are the steps, of one pixel, with 1/8 to either side.
    #[test]
    fn stairs_are_zs() {
        let stairs = picture(&["############", "....########", "........####", "............"]);
        let found = apply_mlaa(&stairs);
        assert_eq!(&light(&found)[1][4..8], &[0.375 + 0.125, 0.125, 0.0, 0.0]);
        assert_eq!(&light(&found)[2][4..8], &[1.0, 1.0, 0.875, 1.0 - 0.375 - 0.125]);
        // Columns must give the mirrored result.
        assert_eq!(mirrored(&found), apply_mlaa(&mirrored(&stairs)));
    }

    /// From one half to zero over two pixels, from either side; its walls are Zs of one pixel.
    #[test]
    fn a_notch_is_a_u() {
        let found = apply_mlaa(&picture(&["........", "##....##", "########"]));
        assert_eq!(&light(&found)[1][2..6], &[0.625 - 0.125, 0.875, 0.875, 0.625 - 0.125]);
    }

    /// Lines that end at the border, so that they have one step: from one half to zero over both pixels, of the row and of the
    /// column. The corner has both.
    #[test]
    fn a_step_at_one_end_is_an_l() {
        let found = apply_mlaa(&picture(&["##..", "##..", "####", "####"]));
        let expected: [&[f32]; 3] = [&[0.0, 0.0, 0.875, 1.0], &[0.0, 0.0, 0.25, 0.875], &[0.0; 4]];
        assert_eq!(light(&found)[..3], expected);
    }

    #[test]
    fn even_pictures_straight_edges_and_little_differences_stay() {
        for rows in [
            ["....", "....", "...."],
            ["....", "####", "####"],
            ["..##", "..##", "..##"],
        ] {
            assert_eq!(apply_mlaa(&picture(&rows)), picture(&rows));
        }
        let stairs = |step: f32| {
            let texels = picture(&["....####", "....####", "########"]).texels().to_vec();
            let faint = texels.iter().map(|texel| Vec4::splat(0.5) + step * *texel);
            Frame::new(uvec2(8, 3), faint.collect())
        };
        assert_eq!(apply_mlaa(&stairs(15.0 / 255.0)), stairs(15.0 / 255.0));
        assert_ne!(apply_mlaa(&stairs(16.0 / 255.0)), stairs(16.0 / 255.0));
        // Nothing to compare with.
        assert_eq!(apply_mlaa(&picture(&["#"])), picture(&["#"]));
    }

    #[test]
    fn crossed_lines_have_no_shape() {
        let board = picture(&["##..", "##..", "..##", "..##"]);
        assert_eq!(apply_mlaa(&board), board);
    }
}
