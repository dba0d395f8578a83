//! Inputs of the edge filters.

use straightline_bench::execute::Inputs;
use straightline_kernels::edge::Normals;
use straightline_kernels::prelude::*;
use straightline_oracle::oracle::edge as oracle;
use straightline_scene::encode::NormalEncoding;

/// Inputs of both filters.
pub struct World {
    pub depth: Frame<f32>,
    /// Unit vectors.
    pub normal: Frame<Vec3>,
    /// `normal` as the texture stores it.
    pub stored: Frame<Vec3>,
    pub color: Frame<Vec4>,
}

impl World {
    pub fn new(size: UVec2, texel: impl Fn(IVec2) -> (f32, Vec3, Vec4)) -> World {
        let texels: Vec<_> = pixels(size).map(texel).collect();
        let normal = Frame::new(size, texels.iter().map(|t| t.1).collect());
        World {
            depth: Frame::new(size, texels.iter().map(|t| t.0).collect()),
            stored: normal.clone(),
            normal,
            color: Frame::new(size, texels.iter().map(|t| t.2).collect()),
        }
    }

    /// Tilted surfaces beside and before each other, with noise in all that there is.
    pub fn surfaces(size: UVec2) -> World {
        World::new(size, |p| {
            let cell = uvec2(p.x as u32 / 9, p.y as u32 / 7);
            let surface = noise(cell.x * 31 + cell.y);
            let here = (p.y as u32 * size.x + p.x as u32) * 8;
            let [a, b] = [noise(here), noise(here + 1)];
            let depth = 1.0 + 4.0 * surface + 0.03 * p.x as f32 * noise(cell.x + 77) + 0.02 * a * a;
            // Some facets look the other way.
            let side = if surface > 0.8 { -1.0 } else { 1.0 };
            let normal = vec3(1.6 * surface - 0.8, 0.5 * b - 0.2, 0.7 * side).normalize();
            let color = vec4(noise(here + 2), noise(here + 3), surface, 0.25 + 0.5 * a);
            (depth, normal, color)
        })
    }

    /// Returns the same world with normals of 8 bits, if they are not floats.
    pub fn storing(&self, normals: Normals) -> World {
        let encoding = match normals {
            Normals::Float => NormalEncoding::Float,
            Normals::Unorm => NormalEncoding::Rgb8,
            Normals::Octahedral => NormalEncoding::Octahedral8,
        };
        let single = |v: [f64; 3]| Vec3::from_array(v.map(|c| c as f32));
        let texels = self.normal.texels().iter();
        let texels: Vec<_> = texels.map(|n| encoding.encode(n.to_array().map(f64::from))).collect();
        let frame = |vectors| Frame::new(self.depth.size(), vectors);
        World {
            depth: self.depth.clone(),
            normal: frame(texels.iter().map(|t| single(encoding.decode(*t))).collect()),
            stored: frame(texels.iter().map(|t| single(*t)).collect()),
            color: self.color.clone(),
        }
    }

    pub fn inputs(&self) -> Inputs {
        let size = self.depth.size();
        let depth = self.depth.texels().iter().map(|d| Vec4::splat(*d)).collect();
        let normal = self.stored.texels().iter().map(|n| n.extend(0.0)).collect();
        Inputs::new(size)
            .with_image("depth", Frame::new(size, depth))
            .with_image("normal", Frame::new(size, normal))
            .with_image("color", self.color.clone())
    }

    pub fn geometry(&self) -> oracle::Geometry<'_> {
        oracle::Geometry {
            depth: &self.depth,
            normal: &self.normal,
        }
    }
}

pub fn pixels(size: UVec2) -> impl Iterator<Item = IVec2> {
    let size = size.as_ivec2();
    (0..size.y).flat_map(move |y| (0..size.x).map(move |x| ivec2(x, y)))
}

/// Between 0 and 1, the same for the same number (PCG).
pub fn noise(k: u32) -> f32 {
    let state = k.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    ((word >> 22) ^ word) as f32 / u32::MAX as f32
}
