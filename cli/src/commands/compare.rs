//! `compare`: difference between two pictures.

use crate::args::CompareArgs;
use crate::failure::Failure;
use glam::Vec4;
use serde_json::json;
use std::path::Path;
use straightline_kernels::prelude::Frame;
use straightline_oracle::metrics::{self, MOST_DB};
use straightline_scene::picture;

/// Reads two pictures of one size and prints PSNR, SSIM and FLIP.
///
/// If either is a PNG, both are compared at 8 bits, as in `study error`, so that the results match.
pub fn compare_pictures(args: &CompareArgs) -> Result<(), Failure> {
    let read = |path: &Path| picture::read_picture(path).map_err(Failure::from_error);
    let (mut test, mut reference) = (read(&args.picture)?, read(&args.reference)?);
    if test.size() != reference.size() {
        let said =
            |path: &Path, frame: &Frame<Vec4>| format!("{} is {}x{}", path.display(), frame.size().x, frame.size().y);
        return Err(Failure::Failed(format!(
            "{} and {}: pictures of different sizes cannot be compared pixel by pixel; scale or crop one of them",
            said(&args.picture, &test),
            said(&args.reference, &reference)
        )));
    }
    let rounded = [&args.picture, &args.reference].iter().any(|path| is_png(path));
    if rounded {
        test = picture::at_eight_bits(&test);
        reference = picture::at_eight_bits(&reference);
    }
    let psnr = metrics::psnr(&test, &reference).min(MOST_DB);
    let (ssim, flip) = (metrics::ssim(&test, &reference), metrics::flip(&test, &reference));
    let bad = metrics::non_finite(&test) + metrics::non_finite(&reference);
    if args.json {
        outln!(
            "{:#}",
            json!({
                "picture": args.picture, "reference": args.reference, "size": test.size().to_array(),
                "bits": if rounded { 8 } else { 32 }, "psnr_db": psnr, "ssim": ssim, "flip": flip, "non_finite_pixels": bad,
            })
        );
        return Ok(());
    }
    match psnr >= MOST_DB {
        true => outln!("PSNR  equal"),
        false => outln!("PSNR  {psnr:.2} dB, over linear colour clamped to 0..1"),
    }
    outln!("SSIM  {ssim:.4}");
    outln!("FLIP  {flip:.4}");
    if rounded {
        outln!("Both at 8 bits of sRGB, which a PNG has.");
    }
    if bad > 0 {
        outln!("{bad} pixels are not finite, and count as wrong as can be.");
    }
    Ok(())
}

fn is_png(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("png"))
}
