//! Pictures beside one another, with a line of text above each, and enlarged details.

use font8x8::{BASIC_FONTS, LATIN_FONTS, UnicodeFonts};
use glam::{UVec2, Vec4, uvec2};
use straightline_kernels::prelude::Frame;

const BACKGROUND: Vec4 = Vec4::new(0.02, 0.02, 0.02, 1.0);
const INK: Vec4 = Vec4::new(0.9, 0.9, 0.9, 1.0);
/// Width and height of a character of the font.
const GLYPH: u32 = 8;

/// Pictures side by side at their own size, tops aligned, each under its label.
///
/// Text is as large as suits the pictures, the same for all; a label wider than its picture widens the column,
/// so none is cut. Characters other than Latin-1's show as `?`. Without columns the result is one dark texel.
pub fn compose_montage(columns: &[(&str, &Frame<Vec4>)]) -> Frame<Vec4> {
    let scale = text_scale(columns);
    let gap = GLYPH * scale / 2;
    let strip = GLYPH * scale + 2 * gap;
    let widths: Vec<u32> = columns
        .iter()
        .map(|(label, frame)| frame.size().x.max(text_width(label, scale)))
        .collect();
    let gaps = gap * widths.len().saturating_sub(1) as u32;
    let tallest = columns.iter().map(|(_, frame)| frame.size().y).max().unwrap_or(1);
    let top = if columns.is_empty() { 0 } else { strip };
    let mut canvas = Canvas::new(uvec2((widths.iter().sum::<u32>() + gaps).max(1), top + tallest));
    let mut left = 0;
    for ((label, frame), width) in columns.iter().zip(&widths) {
        canvas.text(label, uvec2(left, gap), scale);
        canvas.picture(frame, uvec2(left, strip));
        left += width + gap;
    }
    canvas.into_frame()
}

/// The `width` × `height` texels whose top left one is (`x`, `y`), each enlarged to `zoom` × `zoom`.
///
/// What would reach over the border is moved inside, and cut to the frame's size; sizes and zoom of 0 count as 1.
pub fn enlarge_detail(frame: &Frame<Vec4>, x: u32, y: u32, width: u32, height: u32, zoom: u32) -> Frame<Vec4> {
    let size = uvec2(width, height).clamp(UVec2::ONE, frame.size());
    let corner = uvec2(x, y).min(frame.size() - size);
    let zoom = zoom.max(1);
    let enlarged = size * zoom;
    let texels = (0..enlarged.y)
        .flat_map(|row| (0..enlarged.x).map(move |column| corner + uvec2(column, row) / zoom))
        .map(|texel| frame.load(texel.as_ivec2()))
        .collect();
    Frame::new(enlarged, texels)
}

/// Enlarges one square of several pictures of one size, side by side under their names.
pub fn compare_details(pictures: &[(&str, &Frame<Vec4>)], corner: UVec2, side: u32, zoom: u32) -> Frame<Vec4> {
    let of = |frame: &Frame<Vec4>| enlarge_detail(frame, corner.x, corner.y, side, side, zoom);
    let details: Vec<(&str, Frame<Vec4>)> = pictures.iter().map(|(name, frame)| (*name, of(frame))).collect();
    let columns: Vec<(&str, &Frame<Vec4>)> = details.iter().map(|(name, frame)| (*name, frame)).collect();
    compose_montage(&columns)
}

/// Finds the square in which antialiasing has most to do: returns the corner of the one in which a plain picture is farthest
/// from the reference. Squares begin every 16 texels.
pub fn find_busiest_square(plain: &Frame<Vec4>, reference: &Frame<Vec4>, side: u32) -> UVec2 {
    let size = plain.size();
    let side = UVec2::splat(side).min(size);
    let error = |p: UVec2| {
        let k = (p.y * size.x + p.x) as usize;
        let apart = plain.texels()[k] - reference.texels()[k];
        apart.truncate().length_squared()
    };
    let sum = |corner: UVec2| -> f32 {
        (0..side.y)
            .flat_map(|y| (0..side.x).map(move |x| uvec2(x, y)))
            .map(|p| error(corner + p))
            .sum()
    };
    let steps = |length: u32, window: u32| (0..=(length - window)).step_by(16);
    let corners = steps(size.y, side.y).flat_map(|y| steps(size.x, side.x).map(move |x| uvec2(x, y)));
    let best = corners.map(|c| (sum(c), c)).max_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(UVec2::ZERO, |(_, corner)| corner)
}

/// Texels a dot of the font is wide: as many as let every label fit its picture, up to what suits its height.
fn text_scale(columns: &[(&str, &Frame<Vec4>)]) -> u32 {
    columns
        .iter()
        .map(|(label, frame)| {
            let fits = frame.size().x / text_width(label, 1).max(1);
            let suits = frame.size().y.div_ceil(200);
            fits.min(suits)
        })
        .min()
        .unwrap_or(1)
        .max(1)
}

fn text_width(text: &str, scale: u32) -> u32 {
    text.chars().count() as u32 * GLYPH * scale
}

/// Rows of a character, the lowest bit leftmost.
fn glyph_rows(character: char) -> [u8; 8] {
    BASIC_FONTS
        .get(character)
        .or_else(|| LATIN_FONTS.get(character))
        .or_else(|| BASIC_FONTS.get('?'))
        .unwrap_or([0xff; 8])
}

/// A picture being put together.
struct Canvas {
    size: UVec2,
    texels: Vec<Vec4>,
}

impl Canvas {
    fn new(size: UVec2) -> Self {
        Canvas {
            size,
            texels: vec![BACKGROUND; size.x as usize * size.y as usize],
        }
    }

    fn set(&mut self, at: UVec2, value: Vec4) {
        self.texels[at.y as usize * self.size.x as usize + at.x as usize] = value;
    }

    fn picture(&mut self, frame: &Frame<Vec4>, corner: UVec2) {
        let width = frame.size().x as usize;
        for (y, row) in frame.texels().chunks(width).enumerate() {
            let start = (corner.y as usize + y) * self.size.x as usize + corner.x as usize;
            self.texels[start..start + width].copy_from_slice(row);
        }
    }

    fn text(&mut self, text: &str, corner: UVec2, scale: u32) {
        for (index, character) in text.chars().enumerate() {
            let rows = glyph_rows(character);
            let left = corner + uvec2(index as u32 * GLYPH * scale, 0);
            for y in 0..GLYPH * scale {
                for x in 0..GLYPH * scale {
                    if rows[(y / scale) as usize] >> (x / scale) & 1 == 1 {
                        self.set(left + uvec2(x, y), INK);
                    }
                }
            }
        }
    }

    fn into_frame(self) -> Frame<Vec4> {
        Frame::new(self.size, self.texels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbered_frame(width: u32, height: u32) -> Frame<Vec4> {
        Frame::new(
            uvec2(width, height),
            (0..width * height).map(|i| Vec4::splat(i as f32)).collect(),
        )
    }

    #[test]
    fn pictures_keep_their_texels_and_labels_their_letters() {
        let (a, b) = (numbered_frame(20, 30), numbered_frame(9, 12));
        let result = compose_montage(&[("1x", &a), ("I", &b)]);
        // Scale 1: strip 8 + 2·4, gap 4.
        assert_eq!(result.size(), uvec2(20 + 4 + 9, 16 + 30));
        let texel = |x: u32, y: u32| result.texels()[(y * result.size().x + x) as usize];
        assert_eq!(texel(0, 16), Vec4::splat(0.0));
        assert_eq!(texel(19, 45), Vec4::splat(599.0));
        assert_eq!(texel(24, 16), Vec4::splat(0.0));
        assert_eq!(texel(32, 27), Vec4::splat(107.0));
        assert_eq!(texel(24, 28), BACKGROUND);
        // The capital I of an 8-dot font, its column's leftmost.
        let drawn: Vec<String> = (4..12)
            .map(|y| (24..32).map(|x| if texel(x, y) == INK { '#' } else { '.' }).collect())
            .collect();
        let serif = ".####...";
        let stem = "..##....";
        assert_eq!(drawn, [serif, stem, stem, stem, stem, stem, serif, "........"]);
    }

    #[test]
    fn a_long_label_widens_its_column() {
        let narrow = numbered_frame(3, 3);
        let result = compose_montage(&[("sixteen", &narrow), ("16×", &narrow)]);
        assert_eq!(result.size().x, 7 * 8 + 4 + 3 * 8);
    }

    #[test]
    fn text_grows_with_the_pictures() {
        let large = numbered_frame(400, 450);
        assert_eq!(text_scale(&[("SRAA 16", &large)]), 3);
        assert_eq!(
            text_scale(&[("SRAA 16", &large), ("a label of thirty-two letters...", &large)]),
            1
        );
    }

    #[test]
    fn no_columns_give_one_texel() {
        assert_eq!(compose_montage(&[]).size(), UVec2::ONE);
    }

    #[test]
    fn characters_without_a_glyph_show_as_a_question_mark() {
        assert_eq!(glyph_rows('漢'), glyph_rows('?'));
        assert_ne!(glyph_rows('×'), glyph_rows('?'));
        assert_ne!(glyph_rows('A'), glyph_rows('B'));
    }

    #[test]
    fn a_detail_repeats_each_texel() {
        let result = enlarge_detail(&numbered_frame(4, 3), 1, 1, 2, 2, 2);
        let row = |a: f32, b: f32| [a, a, b, b].map(Vec4::splat);
        assert_eq!(result.size(), uvec2(4, 4));
        assert_eq!(
            result.texels(),
            [row(5.0, 6.0), row(5.0, 6.0), row(9.0, 10.0), row(9.0, 10.0)].concat()
        );
    }

    #[test]
    fn a_detail_over_the_border_is_moved_inside() {
        let frame = numbered_frame(4, 3);
        assert_eq!(
            enlarge_detail(&frame, 100, 100, 2, 1, 1),
            enlarge_detail(&frame, 2, 2, 2, 1, 1)
        );
        assert_eq!(enlarge_detail(&frame, 1, 1, 99, 99, 1), frame);
        assert_eq!(enlarge_detail(&frame, 0, 0, 0, 0, 0).size(), UVec2::ONE);
    }
}
