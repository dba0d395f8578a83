//! Methods of numbers and vectors, lane by lane; fields as methods; comparison and selection.

use super::Quad;
use crate::prelude::maths::Floats;
use glam::{IVec2, Vec2, Vec2Swizzles, Vec3, Vec4, Vec4Swizzles};

macro_rules! one {
    ($ty:ty => $out:ty: $($method:ident)*) => { $(
        #[doc = concat!("`", stringify!($method), "` of each lane.")]
        pub fn $method(self) -> Quad<$out> {
            self.map(|lane| lane.$method())
        }
    )* };
}

macro_rules! two {
    ($ty:ty, $other:ty => $out:ty: $($method:ident)*) => { $(
        #[doc = concat!("`", stringify!($method), "` of each lane and another value, or the other quad's lane.")]
        pub fn $method(self, other: impl Into<Quad<$other>>) -> Quad<$out> {
            self.zip(other.into(), |lane, other| lane.$method(other))
        }
    )* };
}

macro_rules! lane_of {
    ($out:ty: $($field:ident)*) => { $(
        #[doc = concat!("Component `", stringify!($field), "` of each lane.")]
        pub fn $field(self) -> Quad<$out> {
            self.map(|lane| lane.$field)
        }
    )* };
}

impl Quad<f32> {
    one! { f32 => f32: abs acos asin atan ceil cos exp exp2 floor ln log2 recip round_ties_even sin sqrt tan tanh trunc }
    two! { f32, f32 => f32: atan2 max min powf }

    /// `max(min(x, high), low)` of each lane.
    #[allow(clippy::manual_clamp)] // a NaN becomes a number, as in the graph
    pub fn clamp(self, low: impl Into<Quad<f32>>, high: impl Into<Quad<f32>>) -> Quad<f32> {
        self.min(high).max(low)
    }

    /// Converts each lane to an integer by truncation.
    pub fn as_i32(self) -> Quad<i32> {
        self.map(|lane| lane as i32)
    }
}

impl Quad<i32> {
    one! { i32 => i32: abs signum }
    two! { i32, i32 => i32: max min }

    /// Converts each lane to a float.
    pub fn as_f32(self) -> Quad<f32> {
        self.map(|lane| lane as f32)
    }
}

macro_rules! compared {
    ($($ty:ty)*) => { $(
        impl Quad<$ty> {
            compared! { $ty: lt <, le <=, gt >, ge >=, eq ==, ne != }
        }
    )* };
    ($ty:ty: $($method:ident $op:tt),*) => { $(
        #[doc = concat!("Whether the lane `", stringify!($op), "` another value, or the other quad's lane.")]
        #[allow(clippy::should_implement_trait)] // a quad has four results
        pub fn $method(self, other: impl Into<Quad<$ty>>) -> Quad<bool> {
            self.zip(other.into(), |lane, other| lane $op other)
        }
    )* };
}

compared! { f32 i32 }

impl Quad<bool> {
    /// Selects `yes` in the lanes that are `true`, else `no`.
    pub fn select<T: Copy>(self, yes: Quad<T>, no: Quad<T>) -> Quad<T> {
        let (yes, no) = (yes.lanes(), no.lanes());
        let lane = |k: usize| if self.lanes()[k] { yes[k] } else { no[k] };
        Quad::new([lane(0), lane(1), lane(2), lane(3)])
    }
}

macro_rules! float_vectors {
    ($($ty:ty)*) => { $(
        impl Quad<$ty> {
            one! { $ty => $ty: abs ceil exp exp2 floor normalize trunc }
            one! { $ty => f32: element_sum length length_squared max_element min_element }
            two! { $ty, $ty => f32: distance distance_squared dot }
            two! { $ty, $ty => $ty: max min }
            lane_of! { f32: x y }
        }
    )* };
}

float_vectors! { Vec2 Vec3 Vec4 }

impl Quad<Vec2> {
    one! { Vec2 => IVec2: as_ivec2 }
    one! { Vec2 => Vec2: yx }
    one! { Vec2 => Vec4: xyxy }
    two! { Vec2, f32 => Vec3: extend }

    /// Creates a vector from its components.
    pub fn from_xy(x: impl Into<Quad<f32>>, y: impl Into<Quad<f32>>) -> Self {
        x.into().zip(y.into(), Vec2::new)
    }
}

impl Quad<Vec3> {
    lane_of! { f32: z }
    one! { Vec3 => Vec2: truncate }
    two! { Vec3, f32 => Vec4: extend }
    two! { Vec3, Vec3 => Vec3: cross }
}

impl Quad<Vec4> {
    lane_of! { f32: z w }
    one! { Vec4 => Vec3: truncate }
    one! { Vec4 => Vec2: xy zw xz yw xw zy }
    one! { Vec4 => Vec4: xzxz yyww xxyy zwzw }
}

impl Quad<IVec2> {
    lane_of! { i32: x y }
    one! { IVec2 => Vec2: as_vec2 }
    two! { IVec2, IVec2 => IVec2: max min }
}

impl Floats for Quad<f32> {
    fn map(self, f: impl Fn(f32) -> f32) -> Self {
        Quad::map(self, f)
    }
}

macro_rules! floats {
    ($($ty:ty)*) => { $(
        impl Floats for Quad<$ty> {
            fn map(self, f: impl Fn(f32) -> f32) -> Self {
                Quad::map(self, |lane| Floats::map(lane, &f))
            }
        }
    )* };
}

floats! { Vec2 Vec3 Vec4 }
