//! Images of a shader's inputs, decoded in double precision.

use super::bound::Rounding;
use super::{Demodulate, Depth, Layout, Metric, Normals, OracleError, Projection, Shading, SraaParams};
use glam::UVec4;
use std::borrow::Cow;
use straightline_kernels::prelude::{Frame, Vec4};
use straightline_scene::inputs::Inputs;

/// A point of a surface.
pub struct Point {
    /// Linear depth.
    pub depth: f64,
    /// Unit normal.
    pub normal: [f64; 3],
    /// Origin of the point's ray, at depth 0: the eye, or of a parallel projection a place of the picture.
    pub base: [f64; 3],
    /// From there to depth 1.
    pub ray: [f64; 3],
}

impl Point {
    /// Returns the point's coordinate along an axis.
    pub fn axis(&self, axis: usize) -> f64 {
        self.base[axis] + self.depth * self.ray[axis]
    }
}

/// More than any depth, by definition of the filter: a sky is as deep as any other, and so is what is no number.
pub(super) const DEEPEST: f64 = 1.0e30_f32 as f64;

/// Stored depths of a reversed projection are no less, by definition of the filter.
const SHORTEST: f64 = 1.0e-30_f32 as f64;

/// Albedo is no more, by definition of the filter.
const BRIGHTEST: f64 = 65504.0;

/// Normals that are shorter are divided by this, by definition of the filter: a cleared texel is no normal.
const NO_NORMAL: f64 = 0.01;

/// The square of a normal's length is no less, by definition of the filter.
const LEAST_SQUARE: f64 = 1.0 / 4096.0;

/// That of 2 t - 1 is no more, by definition of the filter: of a texel of zeros it is 3.
const MOST_SQUARE: f64 = 2.0;

/// Depth from which on nothing is drawn, and the share of the far plane's, by definition of the filter.
const BACKDROP: f64 = 1.0e20;
const NEAR_FAR: f64 = 0.999;

/// Bounds on the error with which a point is read.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reading {
    /// Depth as it is stored; 0 where none is read, and infinite where it is not a number.
    pub stored: f64,
    /// True if depth is not a number.
    pub is_nan: bool,
    /// True if depth is a number so far below 0 that it is taken for the sky.
    pub is_below: bool,
    /// The texel of the normal.
    pub texel: [f64; 4],
    /// Most that linear depth is off, as a share of it.
    pub depth: f64,
    /// Most that a component of the normal is off.
    pub normal: f64,
}

/// The images and numbers that a filter's options name.
pub struct GBuffer<'a> {
    params: &'a SraaParams,
    samples: usize,
    width: i32,
    height: i32,
    colors: &'a [Frame<Vec4>],
    place: Option<&'a Frame<UVec4>>,
    extra: Option<Extra<'a>>,
    albedo: Option<Stored<'a>>,
    direct: Option<&'a Frame<Vec4>>,
    rest: Option<&'a Frame<Vec4>>,
    guide_mean: Option<&'a Frame<Vec4>>,
    depth: Option<Stored<'a>>,
    normal: Option<Stored<'a>>,
    rays: Option<[[f64; 3]; 3]>,
    /// Of a parallel projection: all rays.
    forward: Option<[f64; 3]>,
    origin: [f64; 2],
    planes: [f64; 2],
}

/// Further shading samples, and what is known of their light.
struct Extra<'a> {
    sample: &'a Frame<UVec4>,
    color: &'a Frame<Vec4>,
    direct: Option<&'a Frame<Vec4>>,
    rest: Option<&'a Frame<Vec4>>,
}

/// Light of a shading sample, as far as it is known.
#[derive(Clone, Copy)]
pub struct Light {
    pub color: [f64; 4],
    /// Contribution of the direct light out of shadow; 0 if that is not known.
    pub direct: [f64; 3],
    /// Part of the colour that does not follow the albedo; 0 if that is not known.
    pub rest: [f64; 3],
}

/// A quantity at all samples.
pub(super) struct Stored<'a> {
    images: Cow<'a, [Frame<Vec4>]>,
    centre: Option<&'a Frame<Vec4>>,
}

impl<'a> GBuffer<'a> {
    pub fn new(inputs: &'a Inputs, params: &'a SraaParams) -> Result<Self, OracleError> {
        let samples = params.sample_offsets().len();
        let packed = params.normals == Normals::Packed;
        let stored = |name: &str| find_stored(inputs, params, samples, name);
        let shared = if packed { Some("packed") } else { None };
        let depth = match params.metric {
            Metric::Normals => None,
            _ => Some(stored(shared.unwrap_or("depth"))?),
        };
        let normal = match params.metric {
            Metric::Depth => None,
            _ => Some(stored(shared.unwrap_or("normal"))?),
        };
        let colors = match params.shaded_samples().len() {
            1 => find_images(inputs, "color", 1)?,
            several => find_images(inputs, "colors", several)?,
        };
        let albedo = match params.demodulate {
            Demodulate::None => None,
            Demodulate::Albedo | Demodulate::AlbedoShadow => Some(stored("albedo")?),
        };
        let direct = match params.demodulate {
            Demodulate::AlbedoShadow => Some(&find_images(inputs, "direct", 1)?[0]),
            Demodulate::None | Demodulate::Albedo => None,
        };
        let rest = match params.demodulate {
            Demodulate::Albedo | Demodulate::AlbedoShadow if params.rest => Some(&find_images(inputs, "rest", 1)?[0]),
            _ => None,
        };
        let guide_mean = match params.guide {
            true => Some(&find_images(inputs, "guide_mean", 1)?[0]),
            false => None,
        };
        let place = match params.shading {
            Shading::Placed => Some(find_integers(inputs, "place")?),
            Shading::Sample0 | Shading::Centre | Shading::Listed => None,
        };
        let extra = match params.extra {
            false => None,
            true => {
                let image = |name: &str| find_images(inputs, name, 1).map(|frames| &frames[0]);
                Some(Extra {
                    sample: find_integers(inputs, "extra")?,
                    color: image("extra_color")?,
                    direct: direct.map(|_| image("extra_direct")).transpose()?,
                    rest: rest.map(|_| image("extra_rest")).transpose()?,
                })
            }
        };
        let rays = match params.metric {
            // The picture's place makes no difference in a parallel projection.
            Metric::PlanesNormals => Some([
                match params.projection {
                    Projection::Perspective => find_vector(inputs, "ray_corner")?,
                    Projection::Parallel => [0.0; 3],
                },
                find_vector(inputs, "ray_right")?,
                find_vector(inputs, "ray_down")?,
            ]),
            _ => None,
        };
        let forward = match (params.metric, params.projection) {
            (Metric::PlanesNormals, Projection::Parallel) => Some(find_vector(inputs, "ray_forward")?),
            _ => None,
        };
        let number = |name: &str| find_vector::<1>(inputs, name).map(|[value]| value);
        let planes = match (params.depth, &depth) {
            (Depth::Linear, _) | (_, None) => [1.0, 1.0],
            (Depth::ReversedInfinite, _) => [number("near")?, f64::INFINITY],
            _ => [number("near")?, number("far")?],
        };
        Ok(GBuffer {
            params,
            samples,
            width: inputs.size.x as i32,
            height: inputs.size.y as i32,
            colors,
            place,
            extra,
            albedo,
            direct,
            rest,
            guide_mean,
            depth,
            normal,
            rays,
            forward,
            origin: find_vector(inputs, "origin").unwrap_or([0.0; 2]),
            planes,
        })
    }

    /// The ray through the image's corner, and how it changes to the right and down.
    pub fn rays(&self) -> Option<[[f64; 3]; 3]> {
        self.rays
    }

    /// The geometry sample at which `pixel` is shaded that would be at `sample` otherwise.
    pub fn shaded_at(&self, pixel: [i32; 2], sample: usize) -> usize {
        let [x, y] = self.clamp_pixel(pixel);
        self.place.map_or(sample, |place| {
            let texel = place.texels()[y as usize * self.width as usize + x as usize];
            (texel.x as usize).min(self.samples)
        })
    }

    /// Colour of shading sample `k` of `pixel`, or of the nearest one inside.
    pub fn color(&self, pixel: [i32; 2], k: usize) -> [f64; 4] {
        texel_to_f64(texel(&self.colors[k], self.clamp_pixel(pixel)))
    }

    /// Light of shading sample `k` of `pixel`, or of the nearest one inside.
    pub fn light(&self, pixel: [i32; 2], k: usize) -> Light {
        Light {
            color: self.color(pixel, k),
            direct: self.light_part(self.direct, pixel),
            rest: self.light_part(self.rest, pixel),
        }
    }

    /// The geometry sample at which `pixel`, or the nearest one inside, is shaded once more, and its light; `None` where it is not.
    pub fn extra_light(&self, pixel: [i32; 2]) -> Option<(usize, Light)> {
        let extra = self.extra.as_ref()?;
        let [x, y] = self.clamp_pixel(pixel);
        let sample = extra.sample.texels()[y as usize * self.width as usize + x as usize].x as usize;
        let light = Light {
            color: texel_to_f64(texel(extra.color, [x, y])),
            direct: self.light_part(extra.direct, pixel),
            rest: self.light_part(extra.rest, pixel),
        };
        (sample < self.samples).then_some((sample, light))
    }

    /// Mean of the guide of `pixel`, if there is a guide.
    pub(super) fn guide_mean(&self, pixel: [i32; 2]) -> Option<[f64; 3]> {
        self.guide_mean.map(|_| self.light_part(self.guide_mean, pixel))
    }

    fn light_part(&self, of: Option<&Frame<Vec4>>, pixel: [i32; 2]) -> [f64; 3] {
        let light = of.map(|frame| texel_to_f64(texel(frame, self.clamp_pixel(pixel))));
        light.map_or([0.0; 3], |[red, green, blue, _]| [red, green, blue])
    }

    /// Albedo at `sample` of `pixel`, or of the nearest one inside, by which colours may be divided, and the share of the direct
    /// light there. `None` if that is not asked for.
    pub fn surface_paint(&self, pixel: [i32; 2], sample: usize) -> Option<([f64; 3], f64)> {
        let [red, green, blue, lit] = self.texel(self.albedo.as_ref()?, self.clamp_pixel(pixel), sample);
        let least = self.params.albedo_floor;
        let within = |value: f64, least: f64, most: f64| if value > least { value.min(most) } else { least };
        let albedo = [red, green, blue].map(|channel| within(channel, least, BRIGHTEST));
        Some((albedo, within(lit, 0.0, 1.0)))
    }

    /// The surface at `sample` of `pixel`, or of the nearest one inside, seen along the ray through `ray_at`.
    pub fn point(&self, pixel: [i32; 2], sample: usize, ray_at: [f64; 2]) -> Point {
        let pixel = self.clamp_pixel(pixel);
        let depth = self.depth.as_ref().map_or(1.0, |stored| {
            let texel = self.texel(stored, pixel, sample);
            let depth = self.linear_depth(self.stored_depth(texel));
            if depth.abs() < DEEPEST { depth } else { DEEPEST }
        });
        let normal = self.normal.as_ref().map_or([0.0, 0.0, 1.0], |stored| {
            self.decode_normal(self.texel(stored, pixel, sample))
        });
        let [base, ray] = self.ray(ray_at);
        Point {
            depth,
            normal,
            base,
            ray,
        }
    }

    /// Returns the origin of the ray through a place of these inputs, in pixels from their corner, and the way from there to
    /// depth 1; 0 where no metric asks.
    pub(super) fn ray(&self, place: [f64; 2]) -> [[f64; 3]; 2] {
        let through = self.rays.map_or([0.0; 3], |[corner, right, down]| {
            let at = [0, 1].map(|axis| place[axis] + self.origin[axis]);
            [0, 1, 2].map(|axis| corner[axis] + at[0] * right[axis] + at[1] * down[axis])
        });
        match self.forward {
            Some(forward) => [through, forward],
            None => [[0.0; 3], through],
        }
    }

    /// A unit vector as normals are compared that are not read from the G-buffer; any where the metric compares none.
    pub(super) fn compared_normal(&self, normal: [f64; 3]) -> [f64; 3] {
        match self.normal {
            Some(_) => normal,
            None => [0.0, 0.0, 1.0],
        }
    }

    /// Returns whether a surface is drawn at a geometry sample, by a metric that measures from planes.
    pub(super) fn is_drawn(&self, point: &Point) -> bool {
        let square: f64 = point.normal.iter().map(|axis| axis * axis).sum();
        let params = self.params;
        if params.metric != Metric::PlanesNormals {
            return true;
        }
        let has_normal = match params.normals {
            Normals::Float => square >= LEAST_SQUARE,
            Normals::Unorm if params.as_stored() => (LEAST_SQUARE..=MOST_SQUARE).contains(&square),
            Normals::Unorm | Normals::Octahedral | Normals::Packed => true,
        };
        point.depth < self.backdrop_depth() && has_normal
    }

    /// Linear depth from which on nothing is drawn.
    pub(super) fn backdrop_depth(&self) -> f64 {
        match self.params.depth {
            Depth::Linear | Depth::ReversedInfinite => BACKDROP,
            Depth::Perspective | Depth::Reversed => {
                let [near, far] = self.planes;
                match self.params.projection {
                    Projection::Perspective => NEAR_FAR * far,
                    Projection::Parallel => near + NEAR_FAR * (far - near),
                }
            }
        }
    }

    /// Linear depth that is infinite in earlier frames, as this frame has it.
    pub(super) fn deepest_depth(&self) -> f64 {
        match self.params.depth {
            Depth::Linear | Depth::ReversedInfinite => f64::INFINITY,
            Depth::Perspective | Depth::Reversed => self.planes[1],
        }
    }

    fn stored_depth(&self, texel: [f64; 4]) -> f64 {
        match self.params.normals {
            Normals::Packed => texel[2] + texel[3],
            _ => texel[0],
        }
    }

    /// Returns how far off a filter in less than `f64` may read a point.
    pub fn reading(&self, pixel: [i32; 2], sample: usize, rounding: &Rounding) -> Reading {
        let pixel = self.clamp_pixel(pixel);
        let (unit, read) = (rounding.unit, rounding.read);
        let mut reading = Reading::default();
        if let Some(stored) = &self.depth {
            let value = self.stored_depth(self.texel(stored, pixel, sample));
            reading.is_nan = value.is_nan();
            // Stored numbers that are taken for the same depth become the same number.
            reading.stored = match self.params.depth {
                // `max` gives the number of a number and a NaN.
                Depth::ReversedInfinite => value.max(SHORTEST),
                _ if value.is_nan() => f64::INFINITY,
                _ => value,
            };
            let depth = self.linear_depth(value);
            reading.is_below = depth <= -DEEPEST;
            let [near, far] = self.planes;
            // (stored / depth) d depth / d stored, of the definitions below.
            let condition = match self.params.depth {
                Depth::Perspective | Depth::Reversed if self.params.projection == Projection::Parallel => {
                    // Each product and sum is rounded, and small depths are differences of large numbers.
                    (value.abs() + 4.0) * (far - near).abs().max(near.abs()) / depth.abs().max(f64::MIN_POSITIVE)
                }
                Depth::Linear | Depth::ReversedInfinite => 1.0,
                Depth::Perspective | Depth::Reversed => value * depth / near * (1.0 - near / far),
            };
            // Near and far are read too; then two products, two sums and two quotients of 2.5 ULP each.
            let decoding = match self.params.depth {
                Depth::Linear => 0.0,
                _ => 2.0 * read + 16.0 * unit,
            };
            let packed = if self.params.normals == Normals::Packed {
                unit
            } else {
                0.0
            };
            let rounded = match self.params.projection {
                Projection::Perspective => read,
                Projection::Parallel => read + unit,
            };
            reading.depth = rounded * condition.abs() + decoding + packed;
        }
        if let Some(stored) = &self.normal {
            let texel = self.texel(stored, pixel, sample);
            reading.texel = texel;
            // Components are at most 1 long; 2 t - 1 and the folding are off by some units, which the division by the
            // length makes larger; then the length itself, by an inverse square root of 2 ULP.
            let normalised = |v: [f64; 3], off: f64| off / length(v).max(NO_NORMAL) + 10.0 * unit;
            let largest = texel.iter().take(3).fold(0.0f64, |most, axis| most.max(axis.abs()));
            let signed = texel.map(|axis| 2.0 * axis - 1.0);
            reading.normal = match self.params.normals {
                Normals::Float => read * largest,
                Normals::Unorm if self.params.as_stored() => 2.0 * read + 2.0 * unit,
                Normals::Unorm => normalised([signed[0], signed[1], signed[2]], 2.0 * read + 2.0 * unit),
                // No point of the octahedron is nearer to its middle than 1/√3.
                Normals::Octahedral | Normals::Packed => 4.0 * (2.0 * read + 4.0 * unit) + 10.0 * unit,
            };
        }
        reading
    }

    pub(super) fn texel(&self, stored: &Stored<'_>, pixel: [i32; 2], sample: usize) -> [f64; 4] {
        if let (Some(centre), true) = (stored.centre, sample == self.samples) {
            return texel_to_f64(texel(centre, pixel));
        }
        if self.params.layout != Layout::Superresolution {
            return texel_to_f64(texel(&stored.images[sample], pixel));
        }
        let columns = (self.samples as f64).sqrt().ceil() as usize;
        let rows = self.samples.div_ceil(columns);
        let at = [
            pixel[0] * columns as i32 + (sample % columns) as i32,
            pixel[1] * rows as i32 + (sample / columns) as i32,
        ];
        texel_to_f64(texel(&stored.images[0], at))
    }

    pub(super) fn clamp_pixel(&self, pixel: [i32; 2]) -> [i32; 2] {
        [pixel[0].clamp(0, self.width - 1), pixel[1].clamp(0, self.height - 1)]
    }

    /// Distance along the view direction, from the definition of the projections: d = (f / (f - n)) (1 - n / z), and the
    /// same with 1 - d, and n / z.
    fn linear_depth(&self, stored: f64) -> f64 {
        let [near, far] = self.planes;
        let whole = 1.0 / (1.0 - near / far);
        match self.params.depth {
            Depth::Linear => stored,
            Depth::Perspective if self.params.projection == Projection::Parallel => near + stored * (far - near),
            Depth::Reversed if self.params.projection == Projection::Parallel => near + (1.0 - stored) * (far - near),
            Depth::Perspective => near / (1.0 - stored / whole),
            Depth::Reversed => near / (1.0 - (1.0 - stored) / whole),
            Depth::ReversedInfinite => near / if stored > SHORTEST { stored } else { SHORTEST },
        }
    }

    fn decode_normal(&self, texel: [f64; 4]) -> [f64; 3] {
        let signed = texel.map(|axis| 2.0 * axis - 1.0);
        match self.params.normals {
            Normals::Float => [texel[0], texel[1], texel[2]],
            Normals::Unorm if self.params.as_stored() => [signed[0], signed[1], signed[2]],
            Normals::Unorm => unit([signed[0], signed[1], signed[2]]),
            Normals::Octahedral => fold_octahedron([signed[0], signed[1]]),
            Normals::Packed => fold_octahedron([texel[0], texel[1]]),
        }
    }
}

/// The images of `name` in the layout of the options.
pub(super) fn find_stored<'a>(
    inputs: &'a Inputs,
    params: &SraaParams,
    samples: usize,
    name: &str,
) -> Result<Stored<'a>, OracleError> {
    let apart = matches!(params.shading, Shading::Centre | Shading::Placed);
    let count = samples + usize::from(apart);
    let layers = match (params.layout, name) {
        (Layout::Split, "depth") => Some(Cow::Owned(frames_of(inputs, "depth_buffer", count)?)),
        (Layout::Layers | Layout::Split, _) => Some(Cow::Borrowed(find_images(inputs, name, count)?)),
        _ => None,
    };
    if let Some(images) = layers {
        return Ok(Stored { images, centre: None });
    }
    let (suffix, count) = match params.layout {
        Layout::Superresolution => ("grid", 1),
        _ => ("samples", samples),
    };
    let centre = match apart {
        true => Some(&find_images(inputs, &format!("centre_{name}"), 1)?[0]),
        false => None,
    };
    Ok(Stored {
        images: Cow::Borrowed(find_images(inputs, &format!("{name}_{suffix}"), count)?),
        centre,
    })
}

/// The frames that lie in a buffer, one after the other.
fn frames_of(inputs: &Inputs, name: &str, count: usize) -> Result<Vec<Frame<Vec4>>, OracleError> {
    let found = inputs.buffers.iter().rev().find(|(known, _)| known == name);
    let pixels = inputs.size.element_product() as usize;
    match found {
        Some((_, elements)) if elements.len() >= count * pixels => {
            let texel = |element: &[f64; 4]| Vec4::from_array(element.map(|lane| lane as f32));
            let frame = |k: usize| elements[k * pixels..][..pixels].iter().map(texel).collect();
            Ok((0..count).map(|k| Frame::new(inputs.size, frame(k))).collect())
        }
        _ => Err(OracleError::Input {
            name: name.to_owned(),
            needed: format!("{count} times {pixels} elements"),
        }),
    }
}

pub(super) fn find_images<'a>(inputs: &'a Inputs, name: &str, count: usize) -> Result<&'a [Frame<Vec4>], OracleError> {
    let found = inputs.images.iter().rev().find(|(known, _)| known == name);
    match found {
        Some((_, images)) if images.len() >= count => Ok(images),
        _ => Err(OracleError::Input {
            name: name.to_owned(),
            needed: format!("{count} images"),
        }),
    }
}

fn find_integers<'a>(inputs: &'a Inputs, name: &str) -> Result<&'a Frame<UVec4>, OracleError> {
    let found = inputs.integers.iter().rev().find(|(known, _)| known == name);
    let first = found.and_then(|(_, layers)| layers.first());
    first.ok_or_else(|| OracleError::Input {
        name: name.to_owned(),
        needed: "an image of integers".to_owned(),
    })
}

pub(super) fn find_vector<const N: usize>(inputs: &Inputs, name: &str) -> Result<[f64; N], OracleError> {
    let found = inputs.uniforms.iter().rev().find(|(known, _)| known == name);
    found
        .and_then(|(_, lanes)| lanes.as_slice().try_into().ok())
        .ok_or_else(|| OracleError::Input {
            name: name.to_owned(),
            needed: format!("{N} numbers"),
        })
}

fn texel(image: &Frame<Vec4>, at: [i32; 2]) -> Vec4 {
    let width = image.size().x as usize;
    image.texels()[at[1] as usize * width + at[0] as usize]
}

fn texel_to_f64(texel: Vec4) -> [f64; 4] {
    texel.to_array().map(f64::from)
}

/// The point of the octahedron |x| + |y| + |z| = 1 whose lower half was unfolded outwards, at length 1.
fn fold_octahedron([x, y]: [f64; 2]) -> [f64; 3] {
    let z = 1.0 - x.abs() - y.abs();
    if z >= 0.0 {
        return unit([x, y, z]);
    }
    unit([(1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y), z])
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = length(v).max(NO_NORMAL);
    v.map(|axis| axis / length)
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|axis| axis * axis).sum::<f64>().sqrt()
}
