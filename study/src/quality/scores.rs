//! Errors of a picture, in total and by class of pixels; and the gap between SRAA and supersampling.

use super::QualityError;
use super::bounds::reconstruct_ideal;
use super::classes::Classes;
use super::methods::Method;
use super::shot::Shot;
use super::surfaces::Surfaces;
use crate::record::{Gap, MOST_DB, MethodErrors};
use glam::Vec4;
use straightline_kernels::prelude::Frame;
use straightline_oracle::metrics;
use straightline_scene::picture;

/// Computes all errors; time, bytes and pictures are left out.
pub fn score_picture(method: &Method, made: &Frame<Vec4>, reference: &Frame<Vec4>, classes: &Classes) -> MethodErrors {
    let of = |class: &dyn Fn(usize) -> bool| where_any(made, reference, class);
    MethodErrors {
        method: method.name.clone(),
        family: method.family(),
        options: method.options().to_vec(),
        psnr: capped_psnr(made, reference),
        ssim: metrics::ssim(made, reference),
        flip: metrics::flip(made, reference),
        psnr_geometry: of(&|k| classes.geometry[k]),
        psnr_shading: of(&|k| classes.shading[k]),
        psnr_flat: of(&|k| classes.is_flat(k)),
        worst: Some(metrics::worst_error(made, reference)),
        gap_closed: None,
        temporal: None,
        time: None,
        bytes: 0,
        extra: None,
        non_finite: metrics::non_finite(made),
        picture: None,
    }
}

fn capped_psnr(made: &Frame<Vec4>, reference: &Frame<Vec4>) -> f64 {
    metrics::psnr(made, reference).min(MOST_DB)
}

/// Returns `None` for a class without pixels.
fn where_any(made: &Frame<Vec4>, reference: &Frame<Vec4>, class: &dyn Fn(usize) -> bool) -> Option<f64> {
    let found = metrics::psnr_where(made, reference, class);
    (!found.is_nan()).then(|| found.min(MOST_DB))
}

/// Fills in each method's share of the gap between no antialiasing and 16x that it closes, if there is a gap.
pub fn share_of_gap(methods: &mut [MethodErrors]) {
    let of = |name: &str| methods.iter().find(|m| m.method == name).map(|m| m.psnr);
    let (Some(plain), Some(best)) = (of("1x"), of("16x")) else {
        return;
    };
    if best > plain {
        for method in methods {
            method.gap_closed = Some((method.psnr - plain) / (best - plain));
        }
    }
}

/// Measures the gaps of SRAA with 4 and with 16 samples to 4x and 16x; pictures and reference are at 8 bits.
pub fn measure_gaps(
    shot: &Shot,
    made: [&Frame<Vec4>; 2],
    reference: &Frame<Vec4>,
    classes: &Classes,
) -> Result<Vec<Gap>, QualityError> {
    let mut gaps = Vec::new();
    for (samples, made) in [4, 16].into_iter().zip(made) {
        let missing = || QualityError::NotDrawn(format!("SRAA {samples}"));
        let capture = shot.captures.get(&format!("latin{samples}")).ok_or_else(missing)?;
        let surfaces = Surfaces::from_captures(&[capture]).ok_or_else(missing)?;
        let best = picture::at_eight_bits(&reconstruct_ideal(
            &surfaces,
            shot.shaded_frames(samples)?,
            &capture.color,
        ));
        let bound = picture::at_eight_bits(&shot.supersampled_mean(samples)?);
        let seen = |k: usize| !classes.unseen[k];
        let pixels = made.texels().len();
        let unseen = classes.unseen.iter().filter(|is| **is).count();
        let (all, lost) = (
            metrics::mse(made, reference) * pixels as f64,
            metrics::mse_where(made, reference, |k| !seen(k)) * unseen as f64,
        );
        gaps.push(Gap {
            method: format!("SRAA {samples}"),
            bound: format!("{samples}x"),
            psnr: capped_psnr(made, reference),
            ideal_psnr: capped_psnr(&best, reference),
            bound_psnr: capped_psnr(&bound, reference),
            psnr_seen: where_any(made, reference, &seen),
            bound_psnr_seen: where_any(&bound, reference, &seen),
            error_unseen: if unseen > 0 && all > 0.0 { lost / all } else { 0.0 },
        });
    }
    Ok(gaps)
}
