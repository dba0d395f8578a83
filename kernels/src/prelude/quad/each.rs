//! One value, or one in each lane: what textures can be asked for.

use super::Quad;
use glam::{IVec2, IVec3, Vec2, Vec3};

/// A `V`, or a [`Quad`] of them.
pub trait PerLane<V>: Copy {
    /// A `T` where this is a `V`, a `Quad<T>` where it is a `Quad<V>`.
    type Of<T: Copy>: Copy;

    /// `f` of the value, or of each lane's.
    fn each<T: Copy>(self, f: impl Fn(V) -> T) -> Self::Of<T>;

    /// `f` of this and another value, or of both in each lane.
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
