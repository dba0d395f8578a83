//! Expected result of a form in a case, by definition in `f64`, and the bound on its error: by error analysis of the case's
//! inputs, never by what was seen.
//!
//! | what | how far | why |
//! | --- | --- | --- |
//! | SRAA | [`bound::sraa`] | weights by the rounding of differences, exponents and sums; see there |
//! | an edge filter's taps, by the interpreter | 8 u · side of the picture · range of colours around | a place between texels is off by some roundings of its coordinate |
//! | the same, on a device | 1/128 of the range | hardware weighs texels in steps of 1/256 on each axis |
//! | an edge filter where a decision is close | the range of colours around | a comparison may go either way, and moves the taps by less than their reach |
//! | bilateral filters | [`bound::of_mean`] | as SRAA: Gaussians of differences that are known |
//! | the same, differences from one colour | 24 u · the brightest of the colours | what is subtracted and added again is rounded, even if it weighs nothing |
//! | a convolution | n² + 16 roundings of the brightest colour around | a sum of n² products |
//! | its bilinear taps, and filters of shadow maps, on a device | 1/128 of the range for each comparison | as an edge filter's taps |
//! | filters of shadow maps | their definition at places and depths a few roundings off | a comparison may go either way |
//! | ambient occlusion | each tap's between the least and the most of its place, its way and its cosine | a place may be the next pixel |
//! | 16 bits | 1/255 of the brightest colour | a step of an 8-bit picture: more would be seen |

mod shadow;
mod sums;

use super::HardError;
use super::case::Case;
use super::form::{Family, KernelForm, choice_or};
use super::inputs::CaseInputs;
use glam::{IVec2, Vec4};
use straightline_bench::execute::Inputs;
use straightline_kernels::OptionValues;
use straightline_kernels::prelude::Frame;
use straightline_oracle::oracle;
use straightline_oracle::oracle::bound::{self, Rounding, Share};
use straightline_oracle::oracle::edge::{Edge, Geometry, Stalker, TabulaRasa};
use straightline_oracle::oracle::quads::{self, Picture};

/// Expected result of a form.
pub struct Expected {
    /// Colours by definition, pixel by pixel.
    pub colors: Vec<[f64; 4]>,
    /// Maximum error of the interpreter in each pixel.
    pub bounds: Vec<f64>,
    /// Maximum error of a device.
    pub device_bounds: Vec<f64>,
    /// Maximum error of either in `f16`, where that has been analysed.
    pub half_bounds: Option<Vec<f64>>,
    /// Number of compared components: the fourth of some is a depth, or always 1.
    pub lanes: usize,
}

/// Returns the expected result of a form with `options`.
pub fn expected_result(form: &KernelForm, options: &OptionValues, reads: &CaseInputs) -> Result<Expected, HardError> {
    let inputs = &reads.inputs;
    match form.family {
        Family::Sraa => {
            let params = reads.params.clone().unwrap_or_default();
            let resolved = oracle::resolve_sraa(inputs, &params)?;
            let bounds = bound::bound_sraa(inputs, &params, &Rounding::SINGLE)?;
            Ok(Expected {
                colors: resolved.into_iter().map(|pixel| pixel.color).collect(),
                device_bounds: bounds.clone(),
                bounds,
                half_bounds: Some(bound::bound_sraa(inputs, &params, &Rounding::HALF)?),
                lanes: 4,
            })
        }
        Family::Stalker | Family::TabulaRasa => Ok(expected_edges(form.family, options, inputs)),
        Family::Upsampling => Ok(expected_upsampling(options, inputs)),
        Family::Bilateral => Ok(expected_blur(options, inputs)),
        Family::Convolution => Ok(sums::expected_convolution(options, inputs)),
        Family::Ssao => Ok(sums::expected_occlusion(options, inputs)),
        Family::Pcf | Family::Pcss => Ok(shadow::expected_shadow(form.family, options, inputs)),
    }
}

/// Returns a step of an 8-bit picture, relative to the case's brightest colour; for light, relative to 1.
pub fn half_limit(case: &Case, family: Family) -> f64 {
    if family.gives_light() {
        return 1.0 / 255.0;
    }
    let pixels = (0..case.size.y).flat_map(|y| (0..case.size.x).map(move |x| glam::uvec2(x, y)));
    let lanes = pixels.flat_map(|pixel| case.surface_at(pixel, glam::Vec2::ZERO, None).color.to_array());
    let finite = lanes.filter(|lane| lane.is_finite());
    finite.fold(0.0f64, |most, lane| most.max(f64::from(lane).abs())) / 255.0
}

fn find_image<'a>(inputs: &'a Inputs, name: &str) -> Option<&'a Frame<Vec4>> {
    let found = inputs.images.iter().rev().find(|(known, _)| known == name);
    found.and_then(|(_, layers)| layers.first())
}

fn input_frame<T: Copy>(inputs: &Inputs, name: &str, of: impl Fn(Vec4) -> T) -> Frame<T> {
    match find_image(inputs, name) {
        Some(image) => Frame::new(image.size(), image.texels().iter().map(|t| of(*t)).collect()),
        None => Frame::new(glam::UVec2::ONE, vec![of(Vec4::ZERO)]),
    }
}

fn number_or(options: &OptionValues, name: &str, default: f64) -> f64 {
    options.number(name).unwrap_or(default)
}

/// Relative margin within which a decision may go either way: products of three, their sums, a reciprocal of 2.5 ULP.
const CLOSE: f64 = 32.0 * Rounding::SINGLE.unit;

fn expected_edges(family: Family, options: &OptionValues, inputs: &Inputs) -> Expected {
    let (depth, normal) = (
        input_frame(inputs, "depth", |t| t.x),
        input_frame(inputs, "normal", |t| t.truncate()),
    );
    let color = input_frame(inputs, "color", |t| t);
    let geometry = Geometry {
        depth: &depth,
        normal: &normal,
    };
    let printed = choice_or(options, "form", "corrected") == "paper";
    let (edges, colors) = match family {
        Family::Stalker => {
            let filter = Stalker {
                printed,
                linear_depth: choice_or(options, "depth", "projected") == "linear",
                normal_barrier: number_or(options, "normal-barrier", 0.8),
                depth_barrier: number_or(options, "depth-barrier", 1.0e-5),
                normal_weight: number_or(options, "normal-weight", 1.0),
                depth_weight: number_or(options, "depth-weight", 1.0),
                kernel: number_or(options, "kernel", 1.0),
            };
            (filter.edges(&geometry), filter.filter_picture(&geometry, &color))
        }
        _ => {
            let filter = TabulaRasa {
                printed,
                depth_sensibility: number_or(options, "depth-sensibility", 25.0),
                normal_sensibility: number_or(options, "normal-sensibility", 1.0),
                weight: number_or(options, "weight", 1.0),
            };
            (filter.edges(&geometry), filter.filter_picture(&geometry, &color))
        }
    };
    let size = color.size().as_ivec2();
    let unit = Rounding::SINGLE.unit;
    let (mut bounds, mut device_bounds) = (Vec::new(), Vec::new());
    for (k, edge) in edges.iter().enumerate() {
        let at = IVec2::new(k as i32 % size.x, k as i32 / size.x);
        let around = Around::new(&color, &normal, at);
        let rounded = 24.0 * unit * around.brightest + 24.0 * Rounding::SINGLE.smallest;
        let [exact, device] = match around.is_sure(edge) {
            true => [8.0 * unit * f64::from(size.max_element()), 1.0 / 128.0].map(|share| share * around.range),
            false => [around.range; 2],
        };
        bounds.push(exact + rounded);
        device_bounds.push(exact.max(device) + rounded);
    }
    Expected {
        colors,
        bounds,
        device_bounds,
        half_bounds: None,
        lanes: 4,
    }
}

/// Colours and normals that an edge filter may read for a pixel.
struct Around {
    range: f64,
    brightest: f64,
    all_good: bool,
    long_normals: bool,
}

impl Around {
    fn new(color: &Frame<Vec4>, normal: &Frame<glam::Vec3>, at: IVec2) -> Around {
        let places = (-2..=2).flat_map(|y| (-2..=2).map(move |x| at + IVec2::new(x, y)));
        let (mut low, mut high, mut all_good, mut long_normals) = (Vec4::INFINITY, Vec4::NEG_INFINITY, true, false);
        for place in places {
            let texel = color.load(place);
            // Black replaces an invalid colour.
            let counted = if texel.is_finite() { texel } else { Vec4::ZERO };
            (low, high) = (low.min(counted), high.max(counted));
            all_good &= texel.is_finite();
            let length = normal.load(place).length();
            long_normals |= length.is_finite() && length > 2.0;
        }
        let lanes = |v: Vec4| v.to_array().map(f64::from);
        let pairs = lanes(low).into_iter().zip(lanes(high));
        Around {
            range: pairs.clone().map(|(l, h)| h - l).fold(0.0, f64::max),
            brightest: pairs.map(|(l, h)| l.abs().max(h.abs())).fold(0.0, f64::max),
            all_good,
            long_normals,
        }
    }

    /// Returns whether 32 bits decide as 64 do, and the sampler reads nothing invalid. A cosine of long normals is a
    /// difference of large numbers, which the margin does not cover.
    fn is_sure(&self, edge: &Edge) -> bool {
        edge.margin > CLOSE && self.all_good && !self.long_normals
    }
}

fn input_picture(inputs: &Inputs, name: &str, of: impl Fn([f64; 4]) -> [f64; 4]) -> Picture {
    let image = input_frame(inputs, name, |t| t);
    Picture {
        size: [image.size().x.into(), image.size().y.into()],
        texels: image.texels().iter().map(|t| of(t.to_array().map(f64::from))).collect(),
    }
}

fn pixel_positions(inputs: &Inputs) -> impl Iterator<Item = [i64; 2]> {
    let size = inputs.size;
    (0..size.y).flat_map(move |y| (0..size.x).map(move |x| [i64::from(x), i64::from(y)]))
}

/// Returns a Gaussian weight `tent` exp(−`exponent`), and its maximum error. `off` is the maximum error of the exponent in
/// addition to the rounding of the squares that it sums.
fn gaussian_weight(tent: f64, exponent: f64, off: f64) -> (f64, f64) {
    let rounding = &Rounding::SINGLE;
    let weight = tent * (-exponent).exp();
    let share = off + rounding.of_exponential(exponent) + 16.0 * rounding.unit * (1.0 + exponent);
    let most = weight * share.min(700.0).exp_m1();
    (weight, most.min(tent) + 2.0 * rounding.smallest)
}

fn largest_component(color: &[f64; 4]) -> f64 {
    color.iter().fold(0.0, |most, lane| most.max(lane.abs()))
}

fn expected_blur(options: &OptionValues, inputs: &Inputs) -> Expected {
    let (radius, sigma) = (
        number_or(options, "radius", 2.0) as i64,
        number_or(options, "sigma", 2.0),
    );
    let depth_sigma = number_or(options, "depth-sigma", 0.1);
    let image = input_picture(inputs, "image", |t| t);
    let colors = pixel_positions(inputs)
        .map(|at| quads::bilateral_mean(&image, radius, sigma, depth_sigma, at))
        .collect();
    let most_off = |[x, y]: [i64; 2]| {
        let centre = quads::counted_texel(image.texel_at(x, y), 3);
        let mut shares = Vec::new();
        let mut brightest = largest_component(&color_of(centre));
        for j in -radius..=radius {
            for i in -radius..=radius {
                let texel = quads::counted_texel(image.texel_at(x + i, y + j), 3);
                let z = (texel[3] - centre[3]) / depth_sigma;
                let near = (i * i + j * j) as f64 / (sigma * sigma);
                let (weight, off) = gaussian_weight(1.0, 0.5 * (z * z + near), 0.0);
                brightest = brightest.max(largest_component(&color_of(texel)));
                shares.push(Share {
                    color: color_of(texel),
                    weight,
                    off,
                });
            }
        }
        bound::of_mean(&shares, true, &Rounding::SINGLE) + 24.0 * Rounding::SINGLE.unit * brightest
    };
    let bounds: Vec<f64> = pixel_positions(inputs).map(most_off).collect();
    Expected {
        colors,
        device_bounds: bounds.clone(),
        bounds,
        half_bounds: None,
        lanes: 3,
    }
}

fn color_of(texel: [f64; 4]) -> [f64; 4] {
    [texel[0], texel[1], texel[2], 0.0]
}

fn expected_upsampling(options: &OptionValues, inputs: &Inputs) -> Expected {
    let factor: i64 = if choice_or(options, "factor", "twice") == "four-times" {
        4
    } else {
        2
    };
    let packed = choice_or(options, "reads", "packed") == "packed";
    let normals = !packed && options.flag("normals") == Some(true);
    let low = input_picture(inputs, "low", |t| if packed { [t[0], t[1], t[2], 1.0] } else { t });
    let surface = input_picture(inputs, if packed { "low" } else { "low_surface" }, |t| t);
    let (depth, normal) = (
        input_picture(inputs, "depth", |t| t),
        input_picture(inputs, "normal", |t| t),
    );
    let given = quads::Upsampled {
        factor,
        low: &low,
        surface: &surface,
        depth: &depth,
        normal: &normal,
        depth_sigma: number_or(options, "depth-sigma", 0.1),
        normal_sigma: normals.then(|| number_or(options, "normal-sigma", 0.1)),
        screen_sigma: (choice_or(options, "screen", "tent") == "gaussian")
            .then(|| number_or(options, "screen-sigma", 0.5)),
    };
    let colors = pixel_positions(inputs)
        .map(|at| quads::upsample_pixel(&given, at))
        .collect();
    let bounds: Vec<f64> = pixel_positions(inputs).map(|at| upsampling_off(&given, at)).collect();
    Expected {
        colors,
        device_bounds: bounds.clone(),
        bounds,
        half_bounds: None,
        lanes: if packed { 3 } else { 4 },
    }
}

/// Sums of weights near this may round to no surface or to one.
const SMALLEST_SUM: f64 = 1.0e-20;

fn upsampling_off(given: &quads::Upsampled<'_>, at: [i64; 2]) -> f64 {
    let unit = Rounding::SINGLE.unit;
    let taps = quads::upsampling_taps(given, at);
    let mut shares = Vec::new();
    for tap in &taps {
        // A cosine has the error of four roundings of its products; its square twice that, times itself.
        let n_off = 8.0 * unit * tap.products / given.normal_sigma.unwrap_or(1.0);
        let off = n_off * tap.turned.abs() + n_off * n_off;
        let (weight, most) = gaussian_weight(tap.screen, 0.5 * tap.exponent, off);
        shares.push(Share {
            color: tap.color,
            weight,
            off: most,
        });
    }
    let brightest = taps.iter().map(|tap| largest_component(&tap.color)).fold(0.0, f64::max);
    let rounded = 24.0 * unit * brightest + 24.0 * Rounding::SINGLE.smallest;
    let range = taps
        .iter()
        .flat_map(|a| taps.iter().map(|b| largest_difference(&a.color, &b.color)))
        .fold(0.0, f64::max);
    let (low, high) = shares.iter().fold((0.0, 0.0), |(l, h), s| {
        (l + (s.weight - s.off).max(0.0), h + s.weight + s.off)
    });
    // A sum of products that are infinite in 32 bits may be NaN there.
    if taps.iter().any(|tap| tap.products > f64::from(f32::MAX)) {
        return range + rounded;
    }
    if low > SMALLEST_SUM {
        return bound::of_mean(&shares, true, &Rounding::SINGLE) + rounded;
    }
    if high > SMALLEST_SUM {
        return range + rounded;
    }
    // Taps that may be the nearest: of equally near ones, any may win.
    let nearest = taps.iter().map(|tap| tap.away).fold(f64::INFINITY, f64::min);
    let may_be = |tap: &&quads::Tap| tap.away <= nearest + 4.0 * unit * tap.away;
    let near: Vec<_> = taps.iter().filter(may_be).collect();
    near.iter()
        .flat_map(|a| near.iter().map(|b| largest_difference(&a.color, &b.color)))
        .fold(0.0, f64::max)
        + rounded
}

fn largest_difference(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    (0..4).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max)
}
