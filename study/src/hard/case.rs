//! Hard cases: something seen at every sample, and the settings that it is filtered with.

use glam::{UVec2, Vec2, Vec3, Vec4, vec2, vec3};
use straightline_scene::encode::DepthStorage;

/// A small world with one thing in it that is hard to compute.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name: one word or several with hyphens.
    pub name: &'static str,
    /// Description of the difficulty, in a line.
    pub about: &'static str,
    /// Width and height in pixels.
    pub size: UVec2,
    /// True if scenes really have this, so that a precision that fails here is of no use; the others are accidents, which only
    /// must not spread.
    pub common: bool,
    /// Options of SRAA that it is about; it then runs with the forms of SRAA that have something to say to them, and with no
    /// other kernel.
    pub options: &'static [(&'static str, &'static str)],
    /// Numbers of SRAA that are given at run time, of options that are `uniform`.
    pub uniforms: &'static [(&'static str, f64)],
    /// Storage of a depth that `options` encodes.
    pub storage: DepthStorage,
    /// Linear depths of the near and far plane, of an encoded depth.
    pub planes: [f32; 2],
    /// Surface seen at each place.
    pub seen: fn(&Place) -> Seen,
    /// Coordinates in a shadow map, of a case that is about them; it then runs with the filters of shadow maps alone.
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
    /// From the picture's upper left corner, in pixels.
    pub at: Vec2,
    /// Number of the geometry sample, from 0 on; `None` at the pixel's centre.
    pub sample: Option<usize>,
}

/// Surface seen at a place.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Linear depth.
    pub depth: f32,
    /// Normal, of length 1 or not.
    pub normal: Normal,
    /// Colour, which counts at pixel centres alone.
    pub color: Vec4,
}

/// Normal as a G-buffer holds it.
#[derive(Clone, Copy, Debug)]
pub enum Normal {
    /// This vector, in whatever encoding.
    Vector(Vec3),
    /// The texel's components as they are.
    Texel(Vec4),
}

impl Case {
    /// A case of 12×12 pixels with default settings.
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

    /// Of another size.
    pub const fn with_size(mut self, width: u32, height: u32) -> Case {
        self.size = UVec2::new(width, height);
        self
    }

    /// Scenes really have this.
    pub const fn mark_common(mut self) -> Case {
        self.common = true;
        self
    }

    /// With options of SRAA.
    pub const fn with_options(mut self, options: &'static [(&'static str, &'static str)]) -> Case {
        self.options = options;
        self
    }

    /// With numbers of SRAA that are given at run time.
    pub const fn with_uniforms(mut self, uniforms: &'static [(&'static str, f64)]) -> Case {
        self.uniforms = uniforms;
        self
    }

    /// With an encoded depth held otherwise.
    pub const fn with_storage(mut self, storage: DepthStorage) -> Case {
        self.storage = storage;
        self
    }

    /// With other planes.
    pub const fn with_planes(mut self, near: f32, far: f32) -> Case {
        self.planes = [near, far];
        self
    }

    /// With coordinates of its own, for filters of shadow maps.
    pub const fn with_coordinates(mut self, coord: fn(&Place) -> Vec3) -> Case {
        self.coord = Some(coord);
        self
    }

    /// With a shadow map of another size.
    pub const fn with_shadow_map(mut self, width: u32, height: u32) -> Case {
        self.map = UVec2::new(width, height);
        self
    }

    /// Returns the place of `pixel` in the shadow map, and its depth there: as a light close to the eye sees it, unless the
    /// case says otherwise.
    pub fn coordinates_at(&self, pixel: UVec2) -> Vec3 {
        let place = self.place_at(pixel.as_vec2() + 0.5);
        if let Some(coord) = self.coord {
            return coord(&place);
        }
        let depth = (self.seen)(&place).depth;
        let across = place.centred() * (LIGHT_SCALE * depth) + LIGHT_CENTRE;
        across.extend(LIGHT_SCALE * depth - 0.01 + 0.02 * place.pixel_noise(12))
    }

    /// Depth that the shadow map holds at `texel`, 0 to 1: that of what is seen there, with grain; 1 where that is not finite.
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

/// Depths of the built-in world over those of a shadow map.
const LIGHT_SCALE: f32 = 0.05;

/// Place in the shadow map at which the eye looks, so that no pixel lies on the border of texels.
const LIGHT_CENTRE: Vec2 = Vec2::new(0.5137, 0.4891);

impl Place {
    /// From -1 to 1 across and down, whatever the picture's size.
    pub fn centred(&self) -> Vec2 {
        2.0 * self.at / self.size.as_vec2() - 1.0
    }

    /// Noise in 0..1 that is the same all over a pixel, another one for each `kind`.
    pub fn pixel_noise(&self, kind: u32) -> f32 {
        hash_noise(self.pixel.x + 131 * self.pixel.y + 17_389 * kind)
    }

    /// Noise that differs at each sample.
    pub fn sample_noise(&self, kind: u32) -> f32 {
        let sample = self.sample.map_or(64, |k| k as u32);
        hash_noise(self.pixel.x + 131 * self.pixel.y + 17_389 * kind + 1_000_003 * (sample + 1))
    }

    /// Returns whether the pixel is one of a few, at least one in every picture.
    pub fn is_spot(&self) -> bool {
        self.pixel == self.size / 2 || self.pixel_noise(99) < 0.06
    }

    /// A colour that differs from pixel to pixel, each component in 0..1.
    pub fn color(&self) -> Vec4 {
        Vec4::new(self.pixel_noise(1), self.pixel_noise(2), self.pixel_noise(3), 1.0)
    }

    /// Returns whether the pixel is one lane of its quad: the second of the first row.
    pub fn is_one_lane(&self) -> bool {
        self.pixel.x % 2 == 1 && self.pixel.y.is_multiple_of(2)
    }

    /// Coordinates in a shadow map that lie well inside, at depths around its own.
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

/// In 0..1, the same for the same number (PCG).
fn hash_noise(k: u32) -> f32 {
    let state = k.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (((word >> 22) ^ word) >> 8) as f32 / (1 << 24) as f32
}
