//! Shading that the mask looks at.

use super::{Definition, add, is_finite};
use crate::oracle::params::NonFinite;

/// Shading of a pixel and of its neighbours.
pub(super) struct Shading {
    /// The largest step of the pixel's colour from those of its four neighbours that lie on its surface, a channel at a gamma of 2; 0
    /// where all steps are alike to the mask.
    pub step: f64,
    /// The colour of a pixel that the mask keeps.
    pub color: [f64; 4],
    /// True if 32 bits decide as 64 do.
    pub is_decided: bool,
}

impl Definition<'_> {
    /// Compares the colours around a pixel with its own, `mean`, and gives it a 24th of each neighbour on its surface. A neighbour may
    /// differ by eight times what a sample may, as a curved surface differs more the farther it is.
    pub(super) fn shading(&self, pixel: [i32; 2], mean: [f64; 4]) -> Shading {
        let (most, threshold) = (self.params.mask_step, 8.0 * self.params.mask_threshold);
        let mut found = Shading {
            step: 0.0,
            color: mean,
            is_decided: true,
        };
        if most >= 1.0 {
            return found;
        }
        let at = |away: [i32; 2]| {
            let there = [pixel[0] + away[0], pixel[1] + away[1]];
            (away, self.gbuffer.shaded_at(there, self.shaded[0]))
        };
        let displayed = |channel: f64| {
            let bright = if channel.abs() < 1.0 { channel.abs() } else { 1.0 };
            if channel < 0.0 { -bright.sqrt() } else { bright.sqrt() }
        };
        let color = |away: [i32; 2]| self.gbuffer.color([pixel[0] + away[0], pixel[1] + away[1]], 0);
        let (own, here) = (self.point(pixel, at([0, 0])), color([0, 0]).map(displayed));
        let (mut counted, mut sum) = (0.0, [0.0; 4]);
        for away in [[0, -1], [-1, 0], [1, 0], [0, 1]] {
            let there = color(away);
            let shown = there.map(displayed);
            let step = (0..3).map(|axis| (shown[axis] - here[axis]).abs()).fold(0.0, f64::max);
            let apart = self.difference(&own, &self.point(pixel, at(away)));
            let is_near = (apart - threshold).abs() <= 1.0e-3 * threshold.max(1.0e-3) && apart != threshold;
            found.is_decided &= (step - most).abs() > 1.0e-5 && !is_near;
            if apart <= threshold {
                found.step = found.step.max(step);
                if self.params.non_finite == NonFinite::Spread || is_finite(&there) {
                    counted += 1.0;
                    add(&mut sum, there, 1.0);
                }
            }
        }
        for axis in 0..4 {
            found.color[axis] = ((24.0 - counted) * mean[axis] + sum[axis]) / 24.0;
        }
        found
    }
}
