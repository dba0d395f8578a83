//! Tables of colours in a volume: `.cube` files, and strips of slices side by side.

use super::PictureError;
use glam::{UVec2, Vec4, uvec2};
use std::path::Path;
use straightline_files as files;
use straightline_kernels::prelude::Frame;

/// Longest file that is read, in bytes: a table of 128 steps a side, with many digits.
const MAX_BYTES: u64 = 1 << 28;

/// Most steps along a side, as far as devices hold volumes.
const MAX_STEPS: u32 = 256;

/// The slices of a `.cube` file, by blue: columns are red and rows green, alpha is 1.
///
/// # Errors
///
/// If it cannot be read, holds no table of three dimensions, or one of another domain than 0 to 1.
pub fn read_cube(path: &Path) -> Result<Vec<Frame<Vec4>>, PictureError> {
    let text = files::read_text(path, MAX_BYTES).map_err(|source| PictureError::Io {
        action: "read",
        path: path.to_owned(),
        source,
    })?;
    parse_cube(&text).map_err(|problem| PictureError::Damaged {
        path: path.to_owned(),
        format: "a .cube table",
        problem,
    })
}

fn parse_cube(text: &str) -> Result<Vec<Frame<Vec4>>, String> {
    let mut steps: Option<u32> = None;
    let mut colours = Vec::new();
    for (k, line) in (1..).zip(text.lines()) {
        let line = line.trim();
        let (word, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match word {
            "" | "TITLE" => {}
            _ if word.starts_with('#') => {}
            "LUT_3D_SIZE" => {
                let found = rest.trim().parse().ok().filter(|n| (2..=MAX_STEPS).contains(n));
                steps = Some(found.ok_or_else(|| format!("line {k}: a size is 2 to {MAX_STEPS}"))?);
            }
            "LUT_1D_SIZE" => return Err(format!("line {k}: a table of one dimension is no volume")),
            "DOMAIN_MIN" | "DOMAIN_MAX" => {
                let wanted = if word == "DOMAIN_MIN" { 0.0 } else { 1.0 };
                if parse_numbers(rest) != Some([wanted; 3]) {
                    return Err(format!(
                        "line {k}: its domain is not 0 to 1, and places in a volume are"
                    ));
                }
            }
            _ => {
                let [red, green, blue] = parse_numbers(line).ok_or_else(|| format!("line {k}: it is no colour"))?;
                colours.push(Vec4::new(red, green, blue, 1.0));
            }
        }
    }
    let steps = steps.ok_or("it says no LUT_3D_SIZE")?;
    let (slice, needed) = ((steps * steps) as usize, (steps as usize).pow(3));
    if colours.len() != needed {
        return Err(format!(
            "it has {} colours, and {steps} steps a side need {needed}",
            colours.len()
        ));
    }
    let slices = colours.chunks(slice);
    Ok(slices
        .map(|slice| Frame::new(UVec2::splat(steps), slice.to_vec()))
        .collect())
}

fn parse_numbers(text: &str) -> Option<[f32; 3]> {
    let found: Option<Vec<f32>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
    found?
        .try_into()
        .ok()
        .filter(|all: &[f32; 3]| all.iter().all(|v| v.is_finite()))
}

/// The slices of a picture that shows them from left to right, each as wide as it is high; `None` if it is not as wide as
/// that.
pub fn slice_strip(picture: &Frame<Vec4>) -> Option<Vec<Frame<Vec4>>> {
    let size = picture.size();
    if size.y < 2 || u64::from(size.x) != u64::from(size.y) * u64::from(size.y) {
        return None;
    }
    let at = |slice: u32, x: u32, y: u32| picture.texels()[(y * size.x + slice * size.y + x) as usize];
    let slice = |slice: u32| {
        let texels = (0..size.y).flat_map(|y| (0..size.y).map(move |x| at(slice, x, y)));
        Frame::new(uvec2(size.y, size.y), texels.collect())
    };
    Some((0..size.y).map(slice).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read_red_first() {
        let colours = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n";
        let text = format!("# made by hand\nTITLE \"same\"\nLUT_3D_SIZE 2\nDOMAIN_MIN 0 0 0\n{colours}");
        let slices = parse_cube(&text).expect("a table");
        assert_eq!(slices.len(), 2);
        for (blue, slice) in slices.iter().enumerate() {
            for (k, texel) in slice.texels().iter().enumerate() {
                assert_eq!(texel.to_array(), [(k % 2) as f32, (k / 2) as f32, blue as f32, 1.0]);
            }
        }
    }

    #[test]
    fn what_is_no_table_is_refused() {
        let cases = [
            ("", "no LUT_3D_SIZE"),
            ("LUT_1D_SIZE 4\n", "line 1: a table of one dimension"),
            ("LUT_3D_SIZE 1\n", "line 1: a size is"),
            ("LUT_3D_SIZE 2\n0 0 0\n", "1 colours, and 2 steps a side need 8"),
            ("LUT_3D_SIZE 2\n0 0\n", "line 2: it is no colour"),
            ("LUT_3D_SIZE 2\n0 0 nan\n", "line 2: it is no colour"),
            ("LUT_3D_SIZE 2\nDOMAIN_MAX 2 2 2\n", "line 2: its domain"),
        ];
        for (text, why) in cases {
            let error = parse_cube(text).expect_err(text);
            assert!(error.contains(why), "{text}: {error}");
        }
    }

    #[test]
    fn a_strip_has_its_slices_side_by_side() {
        let texels = (0..8).map(|k| Vec4::splat(k as f32)).collect();
        let slices = slice_strip(&Frame::new(uvec2(4, 2), texels)).expect("two slices");
        let values = slices
            .iter()
            .map(|s| s.texels().iter().map(|t| t.x).collect::<Vec<_>>());
        assert_eq!(values.collect::<Vec<_>>(), [[0.0, 1.0, 4.0, 5.0], [2.0, 3.0, 6.0, 7.0]]);
        assert!(slice_strip(&Frame::new(uvec2(3, 2), vec![Vec4::ZERO; 6])).is_none());
    }
}
