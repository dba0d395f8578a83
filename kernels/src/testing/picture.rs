//! Pictures that tests read, draw and compare with golden files.

use super::panics::{Outcome, run_caught};
use super::{Color, Tolerance};
use crate::pictures::{Drawn, Likeness, Mismatch, compare_with_file, is_size, picture_path, read_drawn};
use crate::prelude::{Filterable, Picture};
use glam::{IVec2, UVec2, Vec2, Vec3, Vec4};
use std::panic::Location;
use std::path::{Path, PathBuf};

/// Texels that are read from a file.
pub trait FromTexel: Filterable {
    /// The components that it has, of red, green, blue and alpha.
    fn from_texel(texel: [f32; 4]) -> Self;
}

impl FromTexel for f32 {
    fn from_texel([x, ..]: [f32; 4]) -> f32 {
        x
    }
}

impl FromTexel for Vec2 {
    fn from_texel([x, y, ..]: [f32; 4]) -> Vec2 {
        Vec2::new(x, y)
    }
}

impl FromTexel for Vec3 {
    fn from_texel([x, y, z, _]: [f32; 4]) -> Vec3 {
        Vec3::new(x, y, z)
    }
}

impl FromTexel for Vec4 {
    fn from_texel(texel: [f32; 4]) -> Vec4 {
        Vec4::from_array(texel)
    }
}

/// Reads a picture beside the test's file, a PNG in sRGB, as linear colour.
///
/// # Panics
///
/// If it cannot be read.
#[track_caller]
pub fn read_picture<P: Picture<Texel: FromTexel>>(name: &str) -> P {
    read_texels(name, false)
}

/// Reads a picture beside the test's file as it is, numbers from 0 to 1: of data such as normals.
///
/// # Panics
///
/// If it cannot be read.
#[track_caller]
pub fn read_linear<P: Picture<Texel: FromTexel>>(name: &str) -> P {
    read_texels(name, true)
}

#[track_caller]
fn read_texels<P: Picture<Texel: FromTexel>>(name: &str, data: bool) -> P {
    let read = beside_caller(name).and_then(|path| read_drawn(&path, data));
    match read {
        Ok(read) => P::from_texels(
            UVec2::from_array(read.size),
            read.texels.into_iter().map(FromTexel::from_texel).collect(),
        ),
        Err(error) => panic!("{error}"),
    }
}

/// A ratio of peak signal to noise of at least `least` decibels; of bytes that differ by one, it is 48.
pub fn psnr(least: f32) -> Likeness {
    Likeness::Psnr(least)
}

/// Equal bytes.
pub fn exactly() -> Likeness {
    Likeness::Exact
}

impl From<Tolerance> for Likeness {
    /// # Panics
    ///
    /// Unless it is [`absolute`](super::absolute): files have neither units of the last place nor large numbers.
    fn from(tolerance: Tolerance) -> Likeness {
        let others = tolerance.ulps > 0 || tolerance.relative != 0.0;
        assert!(!others, "a picture takes `exactly()`, `absolute(e)` or `psnr(db)`");
        Likeness::Absolute(tolerance.absolute)
    }
}

/// Asserts that a picture is that of the golden file beside the test's file. `shade` computes each pixel, as for `draw`.
///
/// With `STRAIGHTLINE_BLESS=1` in the environment the file is written.
///
/// ```no_run
/// use straightline_kernels::prelude::*;
/// use straightline_kernels::testing::*;
///
/// // In a `#[test]`:
/// let chart: Texture<Vec4> = read_picture("chart.png");
/// assert_picture("dark.png", uvec2(64, 36), |pixel| chart.load(pixel) * 0.5, psnr(50.0));
/// ```
///
/// # Panics
///
/// If the picture differs by more than `likeness`, if there is no golden file, or if an assertion fails at a pixel.
#[track_caller]
pub fn assert_picture<C: Color>(golden: &str, size: UVec2, shade: impl Fn(IVec2) -> C, likeness: impl Into<Likeness>) {
    let bless = std::env::var_os("STRAIGHTLINE_BLESS").is_some();
    let path = beside_caller(golden).unwrap_or_else(|error| panic!("{error}"));
    if let Err(message) = compare_drawn(&path, size, shade, likeness.into(), bless) {
        panic!("{message}");
    }
}

/// Draws and compares a picture. Returns the message of a failure.
fn compare_drawn<C: Color>(
    golden: &Path,
    size: UVec2,
    shade: impl Fn(IVec2) -> C,
    likeness: Likeness,
    bless: bool,
) -> Result<(), String> {
    let size = size.to_array();
    if !is_size(size) {
        return Err(format!("a test draws no picture of {}×{} pixels", size[0], size[1]));
    }
    let mut texels = Vec::new();
    for (y, x) in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (y, x))) {
        let mut texel = Vec4::ZERO;
        match run_caught(|| texel = shade(IVec2::new(x as i32, y as i32)).into_color()) {
            Outcome::Held => texels.push(texel.to_array()),
            Outcome::PassedOver => return Err("`assume` is for properties, not for pixels".to_owned()),
            Outcome::Failed(message) => return Err(format!("at the pixel ({x}, {y}): {message}")),
        }
    }
    compare_with_file(golden, &Drawn { size, texels }, likeness, bless).map_err(|mismatch| match &mismatch {
        Mismatch::Missing(_) => format!("{mismatch}: write it by `STRAIGHTLINE_BLESS=1 cargo test`, and look at it"),
        Mismatch::Differs { files: [actual, marked], .. } => format!(
            "the picture differs: {mismatch}\n  drawn: {}\n  difference: {}\n  if it is right: `STRAIGHTLINE_BLESS=1 cargo test`",
            actual.display(),
            marked.display()
        ),
        _ => mismatch.to_string(),
    })
}

/// Path of a picture beside the file of the test that calls.
#[track_caller]
fn beside_caller(name: &str) -> Result<PathBuf, String> {
    let file = Path::new(Location::caller().file());
    let here = std::env::current_dir().map_err(|error| format!("the current folder is unknown: {error}"))?;
    // rustc names files as cargo calls it: from the crate's folder, or from that of the workspace around it.
    let found = here
        .ancestors()
        .map(|folder| folder.join(file))
        .find(|path| path.is_file());
    let found = found.ok_or_else(|| {
        format!(
            "the test's file `{}` is not below `{}`: run the test by `cargo test`",
            file.display(),
            here.display()
        )
    })?;
    picture_path(found.parent().unwrap_or(&here), name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{absolute, ulp};

    fn ramp(pixel: IVec2) -> f32 {
        pixel.x as f32 / 8.0 + pixel.y as f32 / 64.0
    }

    fn scratch(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("straightline-{}-{name}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        folder
    }

    #[test]
    fn pictures_are_blessed_compared_and_marked() {
        let folder = scratch("golden");
        let golden = folder.join("ramp.png");
        let size = UVec2::new(8, 4);
        let missing = compare_drawn(&golden, size, ramp, exactly(), false).expect_err("there is none");
        assert!(
            missing.contains("no golden file") && missing.contains("STRAIGHTLINE_BLESS=1"),
            "{missing}"
        );
        compare_drawn(&golden, size, ramp, exactly(), true).expect("it is written");
        compare_drawn(&golden, size, ramp, exactly(), false).expect("it is the same");
        let other = |pixel: IVec2| ramp(pixel) + if pixel == IVec2::new(5, 2) { 0.5 } else { 0.0 };
        let differs = compare_drawn(&golden, size, other, psnr(50.0), false).expect_err("a pixel differs");
        assert!(
            differs.contains("1 pixel differs, most at (5, 2)") && differs.contains("ramp.actual.png"),
            "{differs}"
        );
        compare_drawn(&golden, size, other, psnr(20.0), false).expect("it is alike");
        compare_drawn(&golden, size, other, absolute(0.5).into(), false).expect("it is alike");
        let actual = read_drawn(&folder.join("ramp.actual.png"), true).expect("it is written");
        let marked = read_drawn(&folder.join("ramp.difference.png"), true).expect("it is written");
        assert_eq!(actual.size, [8, 4]);
        let lit = marked.texels.iter().position(|texel| texel[0] == 1.0);
        assert_eq!(lit, Some(2 * 8 + 5));
        let wrong = compare_drawn(&golden, UVec2::new(4, 4), ramp, exactly(), false).expect_err("another size");
        assert!(wrong.contains("is 8×4 pixels, and the test draws 4×4"), "{wrong}");
        let failing = |pixel: IVec2| {
            assert!(pixel.x < 3, "too far");
            ramp(pixel)
        };
        let fails = compare_drawn(&golden, size, failing, exactly(), false).expect_err("an assertion fails");
        assert!(
            fails.starts_with("at the pixel (3, 0): ") && fails.contains("too far"),
            "{fails}"
        );
        std::fs::write(&golden, b"no picture").expect("it is written");
        let damaged = compare_drawn(&golden, size, ramp, exactly(), false).expect_err("no PNG");
        assert!(damaged.contains("no PNG"), "{damaged}");
        std::fs::remove_dir_all(folder).expect("it was there");
    }

    #[test]
    fn names_lead_nowhere_else() {
        for (name, reason) in [
            ("../a.png", "leads out"),
            ("/a.png", "leads out"),
            ("a/../../b.png", "leads out"),
            ("a.exr", "no `.png`"),
        ] {
            let error = picture_path(Path::new("here"), name).expect_err(name);
            assert!(error.contains(reason), "{error}");
        }
        assert!(picture_path(Path::new("here"), "a/b.png").is_ok());
        assert!(!is_size([0, 4]) && !is_size([4097, 1]) && !is_size([4096, 4096]) && is_size([4096, 512]));
        assert!(std::panic::catch_unwind(|| Likeness::from(ulp(1))).is_err());
    }
}
