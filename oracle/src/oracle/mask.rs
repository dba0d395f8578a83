//! Steps of shading that the mask looks at.

use super::Definition;

impl Definition<'_> {
    /// The largest step of a pixel's colour from those of its four neighbours that lie on its plane, a channel at a gamma of 2; and whether
    /// 32 bits decide as 64 do. 0 where all steps are alike to the mask.
    pub(super) fn step(&self, pixel: [i32; 2]) -> (f64, bool) {
        let (most, threshold) = (self.params.mask_step, self.params.mask_threshold);
        let (mut largest, mut is_decided) = (0.0f64, true);
        if most >= 1.0 {
            return (largest, is_decided);
        }
        let at = |away: [i32; 2]| {
            let there = [pixel[0] + away[0], pixel[1] + away[1]];
            (away, self.gbuffer.shaded_at(there, self.shaded[0]))
        };
        let displayed = |channel: f64| {
            let bright = if channel.abs() < 1.0 { channel.abs() } else { 1.0 };
            if channel < 0.0 { -bright.sqrt() } else { bright.sqrt() }
        };
        let shown = |away: [i32; 2]| {
            let [red, green, blue, _] = self.gbuffer.color([pixel[0] + away[0], pixel[1] + away[1]], 0);
            [red, green, blue].map(displayed)
        };
        let (own, here) = (self.point(pixel, at([0, 0])), shown([0, 0]));
        for away in [[0, -1], [-1, 0], [1, 0], [0, 1]] {
            let there = shown(away);
            let step = (0..3).map(|axis| (there[axis] - here[axis]).abs()).fold(0.0, f64::max);
            let apart = self.difference(&own, &self.point(pixel, at(away)));
            let is_near = (apart - threshold).abs() <= 1.0e-3 * threshold.max(1.0e-3) && apart != threshold;
            is_decided &= (step - most).abs() > 1.0e-5 && !(is_near && step > most);
            if apart <= threshold {
                largest = largest.max(step);
            }
        }
        (largest, is_decided)
    }
}
