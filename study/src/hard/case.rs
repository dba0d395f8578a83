//! Hard cases: the surface seen at every sample, and the settings of the filter.

use glam::{UVec2, Vec2, Vec3, Vec4, vec2, vec3};
use straightline_scene::encode::DepthStorage;

/// A small scene with a single numerical difficulty.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name: one word or several with hyphens.
    pub name: &'static str,
    /// Description of the difficulty, in one line.
    pub about: &'static str,
    /// Width and height in pixels.
    pub size: UVec2,
    /// `true` if the difficulty occurs in real scenes, so that a precision that fails here is useless. The others are
    /// accidents, which must only not spread.
    pub common: bool,
    /// Options of SRAA that the case concerns. The case then runs with the forms of SRAA that accept them, and with no
    /// other kernel.
    pub options: &'static [(&'static str, &'static str)],
    /// Runtime numbers of SRAA, for options that are `uniform`.
    pub uniforms: &'static [(&'static str, f64)],
    /// Storage of a depth that `options` encodes.
    pub storage: DepthStorage,
    /// Linear depths of the near and far plane, for encoded depths.
    pub planes: [f32; 2],
    /// Surface seen at each place.
    pub seen: fn(&Place) -> Seen,
    /// Coordinates in a shadow map, for a case about them; the case then runs only with shadow filters.
    pub coord: Option<fn(&Place) -> Vec3>,
    /// Width and height of the shadow map in texels.
    pub map: UVec2,
}

/// Place at which something is seen.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The pixel.
    pub pixel: UVec2,
    /// Width and height of the picture.
    pub size: UVec2,
    /// Position relative to the picture's upper left corner, in pixels.
    pub at: Vec2,
    /// Index of the geometry sample, from 0; `None` at the pixel's centre.
    pub sample: Option<usize>,
}

/// Surface seen at a place.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Linear depth.
    pub depth: f32,
    /// Normal, of length 1 or not.
    pub normal: Normal,
    /// Colour, used only at pixel centres.
    pub color: Vec4,
}

/// Normal as a G-buffer holds it.
#[derive(Clone, Copy, Debug)]
pub enum Normal {
    /// A vector, stored in any encoding.
    Vector(Vec3),
    /// The texel's components, stored unchanged.
    Texel(Vec4),
}

impl Case {
    /// Creates a case of 12×12 pixels with default settings.
    pub const fn new(name: &'static str, about: &'static str, seen: fn(&Place) -> Seen) -> Case {
        Case {
            name,
            about,
            size: UVec2::new(12, 12),
            common: false,
            options: &[],
            uniforms: &[],
            storage: DepthStorage::Float32,
            planes: [0.1, 1000.0],
            seen,
            coord: None,
            map: UVec2::new(16, 12),
        }
    }

    /// Sets the picture's size.
    pub const fn with_size(mut self, width: u32, height: u32) -> Case {
        self.size = UVec2::new(width, height);
        self
    }

    /// Marks the case as one that occurs in real scenes.
    pub const fn mark_common(mut self) -> Case {
        self.common = true;
        self
    }

    /// Sets options of SRAA.
    pub const fn with_options(mut self, options: &'static [(&'static str, &'static str)]) -> Case {
        self.options = options;
        self
    }

    /// Sets runtime numbers of SRAA.
    pub const fn with_uniforms(mut self, uniforms: &'static [(&'static str, f64)]) -> Case {
        self.uniforms = uniforms;
        self
    }

    /// Sets the storage of encoded depths.
    pub const fn with_storage(mut self, storage: DepthStorage) -> Case {
        self.storage = storage;
        self
    }

    /// Sets the near and far plane.
    pub const fn with_planes(mut self, near: f32, far: f32) -> Case {
        self.planes = [near, far];
        self
    }

    /// Sets coordinates in the shadow map, for shadow filters.
    pub const fn with_coordinates(mut self, coord: fn(&Place) -> Vec3) -> Case {
        self.coord = Some(coord);
        self
    }

    /// Sets the size of the shadow map.
    pub const fn with_shadow_map(mut self, width: u32, height: u32) -> Case {
        self.map = UVec2::new(width, height);
        self
    }

    /// Returns the position of `pixel` in the shadow map and its depth there: as seen by a light close to the eye, unless
    /// the case overrides it.
    pub fn coordinates_at(&self, pixel: UVec2) -> Vec3 {
        let place = self.place_at(pixel.as_vec2() + 0.5);
        if let Some(coord) = self.coord {
            return coord(&place);
        }
        let depth = (self.seen)(&place).depth;
        let across = place.centred() * (LIGHT_SCALE * depth) + LIGHT_CENTRE;
        across.extend(LIGHT_SCALE * depth - 0.01 + 0.02 * place.pixel_noise(12))
    }

    /// Returns the depth in the shadow map at `texel`, 0 to 1: the depth seen there, with grain; 1 if it is not finite.
    pub fn shadow_at(&self, texel: UVec2) -> f32 {
        let at = (texel.as_vec2() + 0.5) / self.map.as_vec2() * self.size.as_vec2();
        let depth = (self.seen)(&self.place_at(at)).depth;
        let grain = hash_noise(texel.x + 257 * texel.y + 7_000_003);
        match depth.is_finite() {
            true => (LIGHT_SCALE * depth + 0.03 * (grain - 0.5)).clamp(0.0, 1.0),
            false => 1.0,
        }
    }

    fn place_at(&self, at: Vec2) -> Place {
        Place {
            pixel: at.as_uvec2().min(self.size - 1),
            size: self.size,
            at,
            sample: None,
        }
    }

    /// Returns the surface seen in `pixel`, `offset` from its centre.
    pub fn surface_at(&self, pixel: UVec2, offset: Vec2, sample: Option<usize>) -> Seen {
        (self.seen)(&Place {
            pixel,
            size: self.size,
            at: pixel.as_vec2() + 0.5 + offset,
            sample,
        })
    }
}

/// Ratio of shadow-map depths to depths of the scene.
const LIGHT_SCALE: f32 = 0.05;

/// Position in the shadow map at the centre of the view, chosen so that no pixel lies on a border between texels.
const LIGHT_CENTRE: Vec2 = Vec2::new(0.5137, 0.4891);

impl Place {
    /// Returns the position from -1 to 1 across and down, independent of the picture's size.
    pub fn centred(&self) -> Vec2 {
        2.0 * self.at / self.size.as_vec2() - 1.0
    }

    /// Returns noise in 0..1 that is constant within a pixel, and different for each `kind`.
    pub fn pixel_noise(&self, kind: u32) -> f32 {
        hash_noise(self.pixel.x + 131 * self.pixel.y + 17_389 * kind)
    }

    /// Returns noise that differs at each sample.
    pub fn sample_noise(&self, kind: u32) -> f32 {
        let sample = self.sample.map_or(64, |k| k as u32);
        hash_noise(self.pixel.x + 131 * self.pixel.y + 17_389 * kind + 1_000_003 * (sample + 1))
    }

    /// Returns whether the pixel is one of a few, at least one in every picture.
    pub fn is_spot(&self) -> bool {
        self.pixel == self.size / 2 || self.pixel_noise(99) < 0.06
    }

    /// Returns a colour that differs from pixel to pixel, each component in 0..1.
    pub fn color(&self) -> Vec4 {
        Vec4::new(self.pixel_noise(1), self.pixel_noise(2), self.pixel_noise(3), 1.0)
    }

    /// Returns whether the pixel is one lane of its quad: the second of the first row.
    pub fn is_one_lane(&self) -> bool {
        self.pixel.x % 2 == 1 && self.pixel.y.is_multiple_of(2)
    }

    /// Returns coordinates well inside a shadow map, at depths around the surface's own.
    pub fn shadow_coordinates(&self) -> Vec3 {
        let across = self.centred() * 0.35 + LIGHT_CENTRE;
        let depth = if self.is_behind() { 0.4 } else { 0.25 };
        vec3(across.x, across.y, depth - 0.01 + 0.02 * self.pixel_noise(12))
    }

    /// Returns whether the place lies behind a slanted edge through the picture's middle.
    pub fn is_behind(&self) -> bool {
        let from = self.centred();
        vec2(0.93, 0.37).dot(from) > 0.03
    }
}

/// Returns a deterministic hash of a number, in 0..1 (PCG).
fn hash_noise(k: u32) -> f32 {
    let state = k.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (((word >> 22) ^ word) >> 8) as f32 / (1 << 24) as f32
}
