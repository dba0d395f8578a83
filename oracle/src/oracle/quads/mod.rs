//! Definition of the filters of quads: pixel by pixel, in `f64`, without quads, lanes or messages.

mod shadow;
mod surface;

pub use shadow::{
    Counted, Shadow, counted_coordinates, find_blockers, mean_coordinates, pcf_around, pcf_bilinear, pcss,
    slope_fitted, slope_prewitt, weighted_middle,
};
pub use surface::{Ao, Light, ssao, ssao_between};

/// An image in `f64`, its border continued outwards.
pub struct Picture {
    /// Width and height.
    pub size: [i64; 2],
    /// Row by row.
    pub texels: Vec<[f64; 4]>,
}

impl Picture {
    /// The texel at a place, or the nearest one on the border.
    pub fn texel_at(&self, x: i64, y: i64) -> [f64; 4] {
        let (x, y) = (x.clamp(0, self.size[0] - 1), y.clamp(0, self.size[1] - 1));
        self.texels[(y * self.size[0] + x) as usize]
    }
}

/// The image as a convolution takes it, whose weights' sizes sum up to `heaviest`: a pixel with a component that is not
/// finite, or too large for the sum, is 0.
pub fn bounded_image(image: &Picture, heaviest: f64) -> Picture {
    let counts = |texel: &[f64; 4]| texel.iter().all(|c| c.abs() < BRIGHTEST / heaviest);
    Picture {
        size: image.size,
        texels: image
            .texels
            .iter()
            .map(|t| if counts(t) { *t } else { [0.0; 4] })
            .collect(),
    }
}

/// The sum of the pixels around, each times its weight.
pub fn convolve_pixel(image: &Picture, radius: i64, weight: impl Fn(i64, i64) -> f64, [x, y]: [i64; 2]) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for j in -radius..=radius {
        for i in -radius..=radius {
            let texel = image.texel_at(x + i, y + j);
            for k in 0..4 {
                sum[k] += weight(i, j) * texel[k];
            }
        }
    }
    sum
}

/// The plane that fits the bilinear taps of a quad's (2k+2)² pixels best, where the pixel lies. `weight` is that of a column,
/// or row, by its number outwards from the middle.
pub fn fit_plane(image: &Picture, radius: i64, weight: impl Fn(i64) -> f64, [x, y]: [i64; 2]) -> [f64; 4] {
    let corner = [x - x.rem_euclid(2), y - y.rem_euclid(2)];
    // For a column or row: the two pixels, from the quad's first, the share of the farther, the place and the weight.
    let mut axis = Vec::new();
    for k in (0..=radius).step_by(2) {
        let (near, far) = (weight(k), weight(k + 1));
        let (both, place) = (near + far, k as f64 + 0.5 + far / (near + far));
        axis.push((1 + k, 2 + k, far / both, place, both));
        axis.push((-k, -k - 1, far / both, -place, both));
    }
    // The normal equations of a + b·x + c·y, by colour.
    let mut normal = [[0.0; 7]; 3];
    for &(x0, x1, s, px, wx) in &axis {
        for &(y0, y1, t, py, wy) in &axis {
            let texel = |i: i64, j: i64| image.texel_at(corner[0] + i, corner[1] + j);
            let [a, b, c, d] = [texel(x0, y0), texel(x1, y0), texel(x0, y1), texel(x1, y1)];
            let basis = [1.0, px, py];
            for row in 0..3 {
                for column in 0..3 {
                    normal[row][column] += wx * wy * basis[row] * basis[column];
                }
                let taps =
                    [0, 1, 2, 3].map(|k| (1.0 - t) * ((1.0 - s) * a[k] + s * b[k]) + t * ((1.0 - s) * c[k] + s * d[k]));
                // A tap of which a component is no finite colour is 0.
                if taps.iter().all(|tap| tap.abs() < BRIGHTEST / 4.0) {
                    for k in 0..4 {
                        normal[row][3 + k] += wx * wy * basis[row] * taps[k];
                    }
                }
            }
        }
    }
    for pivot in 0..3 {
        let by = normal[pivot];
        for (_, row) in normal.iter_mut().enumerate().filter(|(row, _)| *row != pivot) {
            let factor = row[pivot] / by[pivot];
            row.iter_mut().zip(by).for_each(|(entry, by)| *entry -= factor * by);
        }
    }
    let (u, v) = ((x - corner[0]) as f64 - 0.5, (y - corner[1]) as f64 - 0.5);
    let solved = |row: usize, k: usize| normal[row][3 + k] / normal[row][row];
    std::array::from_fn(|k| solved(0, k) + u * solved(1, k) + v * solved(2, k))
}

/// Entry `x` from the middle of row 2k of Pascal's triangle, over the row's sum.
pub fn binomial(radius: i64, x: i64) -> f64 {
    pascal(2 * radius, radius + x)
}

/// Entry `k` of row `n` of Pascal's triangle, over the row's sum.
pub fn pascal(n: i64, k: i64) -> f64 {
    let factorial = |n: i64| (1..=n).map(|k| k as f64).product::<f64>();
    factorial(n) / factorial(k) / factorial(n - k) / 2.0f64.powi(n as i32)
}

/// Maximum depth by definition of the filters; infinities and NaN get the same depth.
const DEEPEST: f64 = 1.0e30_f32 as f64;

/// Colours are less than this, by definition of the filters; a texel with another has no weight.
const BRIGHTEST: f64 = 1.5e38_f32 as f64;

/// `depth` as it counts.
pub fn clamp_depth(depth: f64) -> f64 {
    if depth.abs() < DEEPEST { depth } else { DEEPEST }
}

/// A texel as it counts, colour and depth: one of whose first `lanes` components any is not finite is black, and of no
/// surface.
pub fn counted_texel(texel: [f64; 4], lanes: usize) -> [f64; 4] {
    match texel.iter().take(lanes).all(|c| c.abs() < BRIGHTEST) {
        true => [texel[0], texel[1], texel[2], clamp_depth(texel[3])],
        false => [0.0, 0.0, 0.0, -DEEPEST],
    }
}

/// The mean of the pixels around, weighed by Gaussians of distance and of depth, the fourth component.
pub fn bilateral_mean(image: &Picture, radius: i64, sigma: f64, depth_sigma: f64, [x, y]: [i64; 2]) -> [f64; 4] {
    let surface = |x: i64, y: i64| counted_texel(image.texel_at(x, y), 3);
    let centre = surface(x, y);
    let (mut sum, mut total) = ([0.0; 3], 0.0);
    for j in -radius..=radius {
        for i in -radius..=radius {
            let texel = surface(x + i, y + j);
            let z = (texel[3] - centre[3]) / depth_sigma;
            let weight = (-0.5 * (((i * i + j * j) as f64) / (sigma * sigma) + z * z)).exp();
            total += weight;
            for k in 0..3 {
                sum[k] += weight * texel[k];
            }
        }
    }
    [
        sum[0] / total,
        sum[1] / total,
        sum[2] / total,
        clamp_depth(image.texel_at(x, y)[3]),
    ]
}

/// Inputs of upsampling, with the parameters by which surfaces differ.
pub struct Upsampled<'a> {
    /// Pixels to one of low resolution.
    pub factor: i64,
    /// The low resolution, and depth in the fourth component of its surface.
    pub low: &'a Picture,
    /// Normals and depths of the low resolution.
    pub surface: &'a Picture,
    /// Depth of the frame, first component.
    pub depth: &'a Picture,
    /// Normals of the frame.
    pub normal: &'a Picture,
    /// Difference of depths at a weight of exp(-1/2).
    pub depth_sigma: f64,
    /// Difference of 1 less the cosine of normals at a weight of exp(-1/2), if normals count.
    pub normal_sigma: Option<f64>,
    /// Distance on the screen, in texels of low resolution, at a weight of exp(-1/2), of a Gaussian; `None` of a tent.
    pub screen_sigma: Option<f64>,
}

/// A texel of low resolution as a pixel sees it.
#[derive(Clone, Copy, Debug)]
pub struct Tap {
    /// Colour; black if the texel does not count.
    pub color: [f64; 4],
    /// Weight by distance on the screen.
    pub screen: f64,
    /// Distance of the texel's depth from the pixel's.
    pub away: f64,
    /// 1 less the cosine between normals, in units of its sigma; 0 if normals do not count.
    pub turned: f64,
    /// Sum of the absolute products of the cosine; 0 if irrelevant.
    pub products: f64,
    /// Exponent of exp(-1/2) in the weight by difference of surfaces.
    pub exponent: f64,
}

/// The four texels of low resolution around the pixel's centre, each standing for a corner of pixels.
pub fn upsampling_taps(inputs: &Upsampled<'_>, [x, y]: [i64; 2]) -> [Tap; 4] {
    let factor = inputs.factor as f64;
    let place = [(x as f64 + 0.5) / factor, (y as f64 + 0.5) / factor];
    let first = place.map(f64::floor);
    let z = clamp_depth(inputs.depth.texel_at(x, y)[0]);
    let normal = inputs.normal.texel_at(x, y);
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[i, j]| {
        let at = [first[0] + i, first[1] + j];
        let apart = [(place[0] - at[0]).abs(), (place[1] - at[1]).abs()];
        let screen = match inputs.screen_sigma {
            None => (1.0 - apart[0]) * (1.0 - apart[1]),
            Some(sigma) => (-0.5 * (apart[0] * apart[0] + apart[1] * apart[1]) / (sigma * sigma)).exp(),
        };
        let texel = inputs.low.texel_at(at[0] as i64, at[1] as i64);
        let surface = inputs.surface.texel_at(at[0] as i64, at[1] as i64);
        let (color, depth) = match texel.iter().all(|c| c.abs() < BRIGHTEST) {
            true => (texel, clamp_depth(surface[3])),
            false => ([0.0; 4], -DEEPEST),
        };
        let away = (depth - z).abs();
        let (mut turned, mut products) = (0.0, 0.0);
        if let Some(sigma) = inputs.normal_sigma {
            let cosine: f64 = (0..3).map(|k| surface[k] * normal[k]).sum();
            products = 1.0 + (0..3).map(|k| (surface[k] * normal[k]).abs()).sum::<f64>();
            products = if cosine.is_nan() { 0.0 } else { products };
            turned = (1.0 - cosine) / sigma;
            // A cosine that is not a number does not count.
            turned = if turned.is_nan() { 0.0 } else { turned };
        }
        Tap {
            color,
            screen,
            away,
            turned,
            products,
            exponent: (away / inputs.depth_sigma).powi(2) + turned.powi(2),
        }
    })
}

/// The four texels of low resolution around the pixel's centre, weighed: by their distance on the screen, times Gaussians.
/// If none is of a similar surface, the tap with the nearest depth counts.
pub fn upsample_pixel(inputs: &Upsampled<'_>, at: [i64; 2]) -> [f64; 4] {
    let taps = upsampling_taps(inputs, at);
    let (mut sum, mut total) = ([0.0; 4], 0.0);
    let mut nearest = (f64::INFINITY, [0.0; 4]);
    for tap in taps {
        let weight = tap.screen * (-0.5 * tap.exponent).exp();
        total += weight;
        for (sum, lane) in sum.iter_mut().zip(tap.color) {
            *sum += weight * lane;
        }
        if tap.away < nearest.0 {
            nearest = (tap.away, tap.color);
        }
    }
    if total > 1.0e-20 {
        sum.map(|s| s / total)
    } else {
        nearest.1
    }
}

/// The depth nearest to the viewer among the pixels around a corner, and where it is.
pub fn downsample_corner(depth: &Picture, factor: i64, [x, y]: [i64; 2]) -> ([i64; 2], f64) {
    let mut found = ([0, 0], f64::INFINITY);
    for j in 0..factor {
        for i in 0..factor {
            let at = [x * factor - factor / 2 + i, y * factor - factor / 2 + j];
            let z = depth.texel_at(at[0], at[1])[0];
            if z < found.1 {
                found = (at, z);
            }
        }
    }
    found
}
