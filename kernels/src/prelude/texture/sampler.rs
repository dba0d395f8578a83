//! How textures are read between their texels.

use glam::{IVec2, IVec3, UVec2, UVec3};

/// How texels between which a coordinate falls are weighed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The nearest counts alone.
    Nearest,
    /// The four around it, by their distance.
    #[default]
    Linear,
}

/// What lies beyond the border.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Address {
    /// The border's texels.
    #[default]
    Clamp,
    /// The image again.
    Repeat,
    /// The image mirrored.
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

/// How a [`Texture`](super::Texture) is read between its texels. Bound as a `sampler`, which the host makes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sampler {
    /// How texels are weighed.
    pub filter: Filter,
    /// What lies beyond the border.
    pub address: Address,
    /// How the two levels between which one falls are weighed, where a level is asked for.
    pub mip: Filter,
}

/// When a comparison holds: reference, comparison, stored depth.
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
    /// 1 if it holds of a reference and a stored depth, else 0.
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

/// How a [`DepthTexture`](super::DepthTexture) is compared. Bound as a `sampler_comparison`, which the host makes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ComparisonSampler {
    /// When a texel counts as 1.
    pub comparison: Comparison,
    /// How results are weighed.
    pub filter: Filter,
}
