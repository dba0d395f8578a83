//! Samplers: how textures are read between their texels.

use glam::{IVec2, IVec3, UVec2, UVec3};

/// Weights of the texels around a coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// Only the nearest texel.
    Nearest,
    /// The four texels around it, weighted by distance.
    #[default]
    Linear,
}

/// Address mode: texels beyond the border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Address {
    /// The border's texels.
    #[default]
    Clamp,
    /// The image, repeated.
    Repeat,
    /// The image, mirrored.
    Mirror,
}

impl Address {
    pub(super) fn wrap(self, k: i32, size: u32) -> u32 {
        let n = size as i32;
        let inside = match self {
            Address::Clamp => k.clamp(0, n - 1),
            Address::Repeat => k.rem_euclid(n),
            Address::Mirror => {
                let k = k.rem_euclid(2 * n);
                k.min(2 * n - 1 - k)
            }
        };
        inside as u32
    }

    pub(super) fn inside(self, coord: IVec2, size: UVec2) -> IVec2 {
        IVec2::new(self.wrap(coord.x, size.x) as i32, self.wrap(coord.y, size.y) as i32)
    }

    pub(super) fn inside_volume(self, coord: IVec3, size: UVec3) -> IVec3 {
        let row = self.inside(coord.truncate(), size.truncate());
        row.extend(self.wrap(coord.z, size.z) as i32)
    }
}

/// Filter and address mode of a [`Texture`](super::Texture). Bound as a `sampler`, which the host creates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sampler {
    /// Filter between texels.
    pub filter: Filter,
    /// Address mode beyond the border.
    pub address: Address,
    /// Filter between levels, where a level is given.
    pub mip: Filter,
}

/// Condition of a comparison: reference, operator, stored depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Comparison {
    /// `reference < depth`.
    Less,
    /// `reference <= depth`.
    #[default]
    LessEqual,
    /// `reference > depth`.
    Greater,
    /// `reference >= depth`.
    GreaterEqual,
}

impl Comparison {
    /// Returns 1 if the comparison of `reference` with the stored `depth` holds, else 0.
    pub(super) fn of(self, reference: f32, depth: f32) -> f32 {
        let holds = match self {
            Comparison::Less => reference < depth,
            Comparison::LessEqual => reference <= depth,
            Comparison::Greater => reference > depth,
            Comparison::GreaterEqual => reference >= depth,
        };
        f32::from(u8::from(holds))
    }
}

/// Comparison and filter of a [`DepthTexture`](super::DepthTexture). Bound as a `sampler_comparison`, which the host creates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ComparisonSampler {
    /// Condition under which a texel counts as 1.
    pub comparison: Comparison,
    /// Filter between the results.
    pub filter: Filter,
}
