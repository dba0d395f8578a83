//! Shadow maps.

/// A shadow map and how it is filtered.
pub struct Shadow {
    /// Width and height.
    pub size: [i64; 2],
    /// Depths, row by row.
    pub depths: Vec<f64>,
    /// `box`, `linear-step`, `smooth-step`, `gaussian`, `linear`, `quadratic` or `cubic`.
    pub weights: String,
    /// Texels from the middle at which weights end.
    pub half: f64,
}

impl Shadow {
    /// The depth of a texel, or of the nearest one on the border.
    pub fn depth(&self, x: i64, y: i64) -> f64 {
        let (x, y) = (x.clamp(0, self.size[0] - 1), y.clamp(0, self.size[1] - 1));
        self.depths[(y * self.size[0] + x) as usize]
    }

    fn compare_texel(&self, x: i64, y: i64, reference: f64) -> f64 {
        if reference <= self.depth(x, y) { 1.0 } else { 0.0 }
    }

    /// Returns the share of light that passes at a place in texels, by a filter that weighs the four texels around it.
    pub fn compare_bilinear(&self, [x, y]: [f64; 2], reference: f64) -> f64 {
        let (x, y) = (x - 0.5, y - 0.5);
        let (i, j) = (x.floor() as i64, y.floor() as i64);
        let (s, t) = (x - x.floor(), y - y.floor());
        let row = |j| (1.0 - s) * self.compare_texel(i, j, reference) + s * self.compare_texel(i + 1, j, reference);
        (1.0 - t) * row(j) + t * row(j + 1)
    }

    /// The weight of a texel by its distance on one axis.
    pub fn weight(&self, distance: f64) -> f64 {
        let (d, half) = (distance.abs(), self.half);
        let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
        match self.weights.as_str() {
            "linear-step" => ((half - d) / (half / 2.0)).clamp(0.0, 1.0),
            "smooth-step" => smooth(((half - d) / (0.75 * half)).clamp(0.0, 1.0)),
            "gaussian" => ((-0.5 * (2.0 * d / half).powi(2)).exp() - (-2.0f64).exp()).max(0.0),
            "linear" => (1.0 - d / half).max(0.0),
            "quadratic" => match 1.5 * d / half {
                x if x < 0.5 => 0.75 - x * x,
                x if x < 1.5 => 0.5 * (1.5 - x).powi(2),
                _ => 0.0,
            },
            "cubic" => match 2.0 * d / half {
                x if x < 1.0 => 2.0 / 3.0 - x * x + 0.5 * x * x * x,
                x if x < 2.0 => (2.0 - x).powi(3) / 6.0,
                _ => 0.0,
            },
            _ => (half + 0.5 - d).clamp(0.0, 1.0),
        }
    }
}

/// Coordinates that count as numbers are smaller, by definition of the filters.
const FARTHEST: f64 = 1.0e20_f32 as f64;

/// Coordinates in a shadow map as a filter takes them.
#[derive(Clone, Copy, Debug)]
pub struct Counted {
    /// Place and depth.
    pub coord: [f64; 3],
    /// True if they say where the quad is.
    pub counts: bool,
}

/// `coord` as it counts, of a filter that reaches `reach` texels in a map of `size`: 0 if a component is no number or too
/// large, and at most as far from the map as the filter reaches.
pub fn counted_coordinates(coord: [f64; 3], size: [i64; 2], reach: f64) -> Counted {
    if !coord.iter().all(|c| c.abs() < FARTHEST) {
        return Counted {
            coord: [0.0; 3],
            counts: false,
        };
    }
    let margin = size.map(|texels| reach / texels as f64);
    let place = [0, 1].map(|axis| coord[axis].clamp(-margin[axis], 1.0 + margin[axis]));
    Counted {
        coord: [place[0], place[1], coord[2]],
        counts: place == coord[..2],
    }
}

/// Mean coordinates of the lanes of a quad that count, or of all if none does.
pub fn mean_coordinates(lanes: &[Counted; 4]) -> [f64; 3] {
    let any = lanes.iter().any(|lane| lane.counts);
    let taken: Vec<_> = lanes.iter().filter(|lane| lane.counts || !any).collect();
    std::array::from_fn(|k| taken.iter().map(|lane| lane.coord[k]).sum::<f64>() / taken.len() as f64)
}

/// Mean place, from the centre, of the texels that are weighed on one axis.
pub fn weighted_middle(shadow: &Shadow, texels: i64, centre: f64) -> f64 {
    let first = (centre - 0.5).floor() as i64 - texels / 2 + 1;
    let (mut sum, mut total) = (0.0, 0.0);
    for k in first..first + texels {
        let away = k as f64 + 0.5 - centre;
        let weight = match shadow.weights.as_str() {
            "box" => 1.0,
            _ => shadow.weight(away),
        };
        sum += weight * away;
        total += weight;
    }
    sum / total
}

/// Every texel of `texels` by `texels` around `centre` compared with `reference` and weighed by its distance from `from`,
/// both in texels.
pub fn pcf_around(shadow: &Shadow, texels: i64, centre: [f64; 2], from: [f64; 2], reference: f64) -> f64 {
    let plain = shadow.weights == "box" && from == centre;
    let first = centre.map(|c| (c - 0.5).floor() as i64 - texels / 2 + 1);
    let (mut sum, mut total) = (0.0, 0.0);
    for j in first[1]..first[1] + texels {
        for i in first[0]..first[0] + texels {
            let weight = match plain {
                true => 1.0,
                false => shadow.weight(i as f64 + 0.5 - from[0]) * shadow.weight(j as f64 + 0.5 - from[1]),
            };
            sum += weight * shadow.compare_texel(i, j, reference);
            total += weight;
        }
    }
    sum / total
}

/// Returns the place between texels `first` and `first + 1`, counted from the one at the upper left of the centre, at which one
/// comparison weighs both as the filter does: from the centre, whose fraction is `a`.
fn tap_position(shadow: &Shadow, a: f64, first: f64) -> f64 {
    let at = first - a;
    match shadow.weights.as_str() {
        "box" => at + 0.5,
        _ => {
            let (w0, w1) = (shadow.weight(at), shadow.weight(at + 1.0));
            at + w1 / (w0 + w1)
        }
    }
}

/// All comparisons of a filter of `texels` by `texels`: places from the centre, numbers of their middles, and results, where
/// `result` gives those.
fn comparison_taps(
    shadow: &Shadow,
    texels: i64,
    centre: [f64; 2],
    result: impl Fn([f64; 2]) -> f64,
) -> Vec<([f64; 2], [f64; 2], f64)> {
    let a = centre.map(|c| (c - 0.5) - (c - 0.5).floor());
    let numbers: Vec<f64> = (0..texels / 2).map(|k| (2 * k - texels / 2 + 1) as f64).collect();
    let mut all = Vec::new();
    for y in &numbers {
        for x in &numbers {
            let place = [tap_position(shadow, a[0], *x), tap_position(shadow, a[1], *y)];
            all.push((place, [*x, *y], result(place)));
        }
    }
    all
}

/// The mean of bilinear comparisons in the middles of 2×2 texels, `spread` times as far apart.
pub fn pcf_bilinear(shadow: &Shadow, texels: i64, centre: [f64; 2], spread: f64, reference: f64) -> f64 {
    let at = |p: [f64; 2]| [centre[0] + spread * p[0], centre[1] + spread * p[1]];
    let taps = comparison_taps(shadow, texels, centre, |p| shadow.compare_bilinear(at(p), reference));
    taps.iter().map(|(_, _, lit)| lit).sum::<f64>() / taps.len() as f64
}

/// Slope for each texel by the moments of the comparisons about their numbers.
pub fn slope_prewitt(shadow: &Shadow, texels: i64, centre: [f64; 2], reference: f64) -> [f64; 2] {
    let at = |p: [f64; 2]| [centre[0] + p[0], centre[1] + p[1]];
    let taps = comparison_taps(shadow, texels, centre, |p| shadow.compare_bilinear(at(p), reference));
    [0, 1].map(|axis| {
        let squares: f64 = taps.iter().map(|(_, n, _)| n[axis] * n[axis]).sum();
        taps.iter().map(|(_, n, lit)| n[axis] * lit).sum::<f64>() / squares
    })
}

/// Slope for each texel of the least-squares plane through the comparisons.
pub fn slope_fitted(shadow: &Shadow, texels: i64, centre: [f64; 2], reference: f64) -> [f64; 2] {
    let at = |p: [f64; 2]| [centre[0] + p[0], centre[1] + p[1]];
    let taps = comparison_taps(shadow, texels, centre, |p| shadow.compare_bilinear(at(p), reference));
    let count = taps.len() as f64;
    let lit: f64 = taps.iter().map(|t| t.2).sum::<f64>() / count;
    [0, 1].map(|axis| {
        let mean: f64 = taps.iter().map(|t| t.0[axis]).sum::<f64>() / count;
        let moment: f64 = taps.iter().map(|t| (t.0[axis] - mean) * (t.2 - lit)).sum();
        moment / taps.iter().map(|t| (t.0[axis] - mean).powi(2)).sum::<f64>()
    })
}

/// Sixteen places: -3, -1, 1 and 3 on each axis.
fn grid_positions() -> impl Iterator<Item = [f64; 2]> {
    (0..16).map(|k| [f64::from(2 * (k % 4) - 3), f64::from(2 * (k / 4) - 3)])
}

/// Depths nearer than `reference` among sixteen in a width of `search` texels.
pub fn find_blockers(shadow: &Shadow, centre: [f64; 2], reference: f64, search: f64) -> Vec<f64> {
    let depths = grid_positions().map(|g| {
        let at = [0, 1].map(|axis| (centre[axis] + g[axis] * search / 8.0).floor() as i64);
        shadow.depth(at[0], at[1])
    });
    depths.filter(|depth| *depth < reference).collect()
}

/// Contact-hardening light: sixteen depths, those nearer than `reference` its blockers, and sixteen comparisons.
pub fn pcss(shadow: &Shadow, centre: [f64; 2], reference: f64, [search, light, low, high]: [f64; 4]) -> f64 {
    let blockers = find_blockers(shadow, centre, reference, search);
    let width = match blockers.len() {
        0 => low,
        n => ((reference - blockers.iter().sum::<f64>() / n as f64) * light).clamp(low, high),
    };
    let taps = grid_positions()
        .map(|g| shadow.compare_bilinear([0, 1].map(|axis| centre[axis] + g[axis] * width / 8.0), reference));
    taps.sum::<f64>() / 16.0
}
