//! Inputs of the gallery's shaders, in f64: nothing of this is shared with the code that it judges.

use glam::{DVec2, DVec3, DVec4, Vec4};
use straightline_bench::execute::Inputs;

/// The inputs of a shader.
pub struct World<'a>(pub &'a Inputs);

/// An image; beyond its border lie its border's texels.
pub struct Picture<'a> {
    width: i64,
    height: i64,
    texels: &'a [Vec4],
}

impl<'a> World<'a> {
    pub fn width(&self) -> f64 {
        f64::from(self.0.size.x)
    }

    pub fn height(&self) -> f64 {
        f64::from(self.0.size.y)
    }

    pub fn size(&self) -> DVec2 {
        DVec2::new(self.width(), self.height())
    }

    pub fn picture(&self, name: &str) -> Picture<'a> {
        let (_, layers) = self.0.images.iter().find(|(n, _)| n == name).expect("an image");
        Picture {
            width: layers[0].size().x.into(),
            height: layers[0].size().y.into(),
            texels: layers[0].texels(),
        }
    }

    pub fn numbers(&self, name: &str) -> &[f64] {
        let (_, numbers) = self
            .0
            .uniforms
            .iter()
            .rev()
            .find(|(n, _)| n == name)
            .expect("a uniform");
        numbers
    }

    pub fn number(&self, name: &str) -> f64 {
        // As it arrives in the shader.
        f64::from(self.numbers(name)[0] as f32)
    }
}

impl Picture<'_> {
    pub fn width(&self) -> i64 {
        self.width
    }

    pub fn height(&self) -> i64 {
        self.height
    }

    pub fn size(&self) -> DVec2 {
        DVec2::new(self.width as f64, self.height as f64)
    }

    pub fn rgba(&self, x: i64, y: i64) -> DVec4 {
        let (x, y) = (x.clamp(0, self.width - 1), y.clamp(0, self.height - 1));
        self.texels[(y * self.width + x) as usize].as_dvec4()
    }

    pub fn rgb(&self, x: i64, y: i64) -> DVec3 {
        self.rgba(x, y).truncate()
    }

    pub fn r(&self, x: i64, y: i64) -> f64 {
        self.rgba(x, y).x
    }

    /// Between texels, whose middles lie at halves: `at` in texels.
    pub fn bilinear(&self, at: DVec2) -> DVec4 {
        let mut sum = DVec4::ZERO;
        let from = at - 0.5;
        for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let (x, y) = (from.x.floor() as i64 + dx, from.y.floor() as i64 + dy);
            let tent = |distance: f64| (1.0 - distance.abs()).max(0.0);
            sum += self.rgba(x, y) * tent(from.x - x as f64) * tent(from.y - y as f64);
        }
        sum
    }
}

/// The weight of two numbers, from the first to the second.
pub fn mix(a: f64, b: f64, t: f64) -> f64 {
    a * (1.0 - t) + b * t
}

pub fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    3.0 * t.powi(2) - 2.0 * t.powi(3)
}

/// Jimenez's interleaved gradient noise.
pub fn interleaved(x: i64, y: i64) -> f64 {
    (52.982_918_9 * (0.067_110_56 * x as f64 + 0.005_837_15 * y as f64).rem_euclid(1.0)).rem_euclid(1.0)
}
