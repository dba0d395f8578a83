//! A value, or one value per lane: the types of texture coordinates.

use super::Quad;
use glam::{IVec2, IVec3, Vec2, Vec3};

/// A `V`, or a [`Quad`] of them.
pub trait PerLane<V>: Copy {
    /// A `T` if this is a `V`, or a `Quad<T>` if it is a `Quad<V>`.
    type Of<T: Copy>: Copy;

    /// Applies `f` to the value, or to the value of each lane.
    fn each<T: Copy>(self, f: impl Fn(V) -> T) -> Self::Of<T>;

    /// Applies `f` to this and another value, or to both in each lane.
    fn with<A: Copy, T: Copy>(self, other: Self::Of<A>, f: impl Fn(V, A) -> T) -> Self::Of<T>;
}

macro_rules! per_lane {
    ($($ty:ty)*) => { $(
        impl PerLane<$ty> for $ty {
            type Of<T: Copy> = T;

            fn each<T: Copy>(self, f: impl Fn($ty) -> T) -> T {
                f(self)
            }

            fn with<A: Copy, T: Copy>(self, other: A, f: impl Fn($ty, A) -> T) -> T {
                f(self, other)
            }
        }

        impl PerLane<$ty> for Quad<$ty> {
            type Of<T: Copy> = Quad<T>;

            fn each<T: Copy>(self, f: impl Fn($ty) -> T) -> Quad<T> {
                self.map(f)
            }

            fn with<A: Copy, T: Copy>(self, other: Quad<A>, f: impl Fn($ty, A) -> T) -> Quad<T> {
                self.zip(other, f)
            }
        }
    )* };
}

per_lane! { IVec2 IVec3 Vec2 Vec3 }
