//! Pixel quads: four neighbouring pixels that compute together and exchange their results.
//!
//! Based on E. Penner, "Shader Amortization using Pixel Quad Message Passing" (GPU Pro 2, 2011), with its errors corrected. A
//! kernel that takes `pixel: Quad<IVec2>` runs in the four lanes of a 2×2 block of pixels in lockstep.
//! Natively a [`Quad`] holds four values. In a shader it is the one value held by each invocation, and a
//! message is a quad operation of the hardware, a fine derivative, or, where one invocation computes the whole block,
//! no operation.
//!
//! Quads begin at even coordinates. If the frame's size is odd, some lanes are outside the frame. Such a helper lane computes
//! like any other, reads what [`Frame::load`](super::Frame::load) returns beyond the border, and stores nothing.
//!
//! | natively | lane 0 | lane 1 | lane 2 | lane 3 |
//! | --- | --- | --- | --- | --- |
//! | position in the quad | upper left | upper right | lower left | lower right |
//! | [`lane_position`] | (0, 0) | (1, 0) | (0, 1) | (1, 1) |
//! | [`quad_vector`] | (-1, -1) | (1, -1) | (-1, 1) | (1, 1) |
//! | [`quad_select`] | (0, 0) | (1, 0) | (0, 1) | (1, 1) |

mod each;
mod maths;
mod operators;

use glam::{IVec2, Vec2};

pub use each::PerLane;

/// A value for each of the four lanes of a quad: upper left, upper right, lower left, lower right.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quad<T> {
    lanes: [T; 4],
}

impl<T: Copy> Quad<T> {
    /// Creates a quad from its lanes' values: upper left, upper right, lower left, lower right.
    pub const fn new(lanes: [T; 4]) -> Self {
        Quad { lanes }
    }

    /// Creates a quad with the same value in every lane.
    pub fn splat(value: T) -> Self {
        Quad { lanes: [value; 4] }
    }

    /// Values of all lanes. For hosts and tests: a lane of a shader holds only its own value and gets the others by messages.
    pub fn lanes(self) -> [T; 4] {
        self.lanes
    }

    /// Applies `f` to each lane's value. For hosts and tests.
    pub fn map<U>(self, f: impl Fn(T) -> U) -> Quad<U> {
        Quad {
            lanes: self.lanes.map(f),
        }
    }

    /// Applies `f` to two values in each lane. For hosts and tests.
    pub fn zip<A: Copy, U: Copy>(self, other: Quad<A>, f: impl Fn(T, A) -> U) -> Quad<U> {
        let lane = |k: usize| f(self.lanes[k], other.lanes[k]);
        Quad::new([lane(0), lane(1), lane(2), lane(3)])
    }

    /// Message: the value of the horizontally adjacent lane.
    pub fn swap_horizontal(self) -> Self {
        let [a, b, c, d] = self.lanes;
        Quad::new([b, a, d, c])
    }

    /// Message: the value of the vertically adjacent lane.
    pub fn swap_vertical(self) -> Self {
        let [a, b, c, d] = self.lanes;
        Quad::new([c, d, a, b])
    }

    /// Message: the value of the diagonally opposite lane.
    pub fn swap_diagonal(self) -> Self {
        let [a, b, c, d] = self.lanes;
        Quad::new([d, c, b, a])
    }

    /// Values of this lane and of its horizontal, vertical and diagonal neighbours (the chapter's `QuadGather2x2`). Takes two
    /// messages for a number or a two-component vector, the second of which contains the first; three for longer vectors.
    pub fn gather(self) -> [Self; 4] {
        [self, self.swap_horizontal(), self.swap_vertical(), self.swap_diagonal()]
    }
}

impl<T: Copy + std::ops::Add<Output = T>> Quad<T> {
    /// Sum over the quad, bit-identical in every lane. Takes two messages.
    pub fn sum(self) -> Self {
        let row = self + self.swap_horizontal();
        row + row.swap_vertical()
    }
}

impl<T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f32, Output = T>> Quad<T> {
    /// Mean over the quad (the chapter's `QuadAve`), bit-identical in every lane. Takes two messages.
    pub fn average(self) -> Self {
        self.sum() * Quad::splat(0.25)
    }
}

impl Quad<IVec2> {
    /// Coordinates of the quad whose upper left pixel is `corner`. Both coordinates of `corner` must be even.
    pub fn pixels(corner: IVec2) -> Self {
        lane_position() + corner
    }
}

/// Position of each lane in its quad: 0 or 1 across and down.
pub fn lane_position() -> Quad<IVec2> {
    Quad::new([IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE])
}

/// Direction away from the quad's centre: -1 on the left and top, 1 on the right and bottom (the chapter's `QuadVector.xy`).
pub fn quad_vector() -> Quad<Vec2> {
    lane_position().as_vec2() * 2.0 - 1.0
}

/// 0 on the left and top, 1 on the right and bottom (the chapter's `QuadSelect.xy`). Selects when used with `mix`.
pub fn quad_select() -> Quad<Vec2> {
    lane_position().as_vec2()
}
