//// Integers that saturate, and that may overflow
pub fn checked_integers(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let a = (color.load(pixel).to_array()[0].to_bits() as i32).wrapping_mul(pixel.x * 7 - 30);
    let b = (color.load(pixel).y.to_bits() as i32).wrapping_sub(pixel.y.wrapping_mul(0x1000_0001));
    let (u, v) = (a as u32, b as u32);
    let small = (taps + pixel.x) % 5 - 2;
    let mut bits = 0_u32;
    for k in 0..2 {
        let b = if k == 0 { b } else { small };
        bits = bits.wrapping_mul(31) ^ a.saturating_add(b) as u32;
        bits = bits.wrapping_mul(31) ^ a.saturating_sub(b) as u32;
        bits = bits.wrapping_mul(31) ^ a.saturating_mul(b) as u32;
        bits = bits.wrapping_mul(31) ^ a.checked_add(b).unwrap_or(3) as u32;
        bits = bits.wrapping_mul(31) ^ a.checked_sub(b).unwrap_or(5) as u32;
        bits = bits.wrapping_mul(31) ^ a.checked_mul(b).unwrap_or(7) as u32;
        bits = bits.wrapping_mul(31) ^ a.checked_div(b).unwrap_or(9) as u32;
        bits = bits.wrapping_mul(31) ^ a.checked_rem(b).unwrap_or(11) as u32;
        bits = bits.wrapping_mul(31) ^ a.overflowing_add(b).0 as u32 ^ u32::from(a.overflowing_mul(b).1);
        bits = bits.wrapping_mul(31) ^ a.midpoint(b) as u32 ^ a.checked_abs().unwrap_or(1) as u32;
        bits = bits.wrapping_mul(31) ^ a.saturating_add_unsigned(v) as u32 ^ a.checked_sub_unsigned(v).unwrap_or(2) as u32;
    }
    bits = bits.wrapping_mul(31) ^ u.saturating_mul(v) ^ u.checked_mul(small as u32 & 3).unwrap_or(13);
    bits = bits.wrapping_mul(31) ^ u.saturating_add_signed(b) ^ u.checked_add_signed(b).unwrap_or(17);
    bits = bits.wrapping_mul(31) ^ u.unbounded_shl(v & 63) ^ u.unbounded_shr(v & 63) ^ a.unbounded_shr(v & 63) as u32;
    bits = bits.wrapping_mul(31) ^ u.leading_ones() ^ u.trailing_ones() ^ u.count_zeros() ^ (u | 1).ilog10();
    bits = bits.wrapping_mul(31) ^ u.checked_ilog2().unwrap_or(40) ^ (a & 0x7fff_ffff).isqrt() as u32;
    bits = bits.wrapping_mul(31) ^ u.checked_shl(v & 63).unwrap_or(19) ^ (v & 0xffff).next_multiple_of(12);
    vec4((bits & 0xffff) as f32, (bits >> 16) as f32, small as f32, 1.0)
}

//// Neighbours of a float, subnormal and normal floats
pub fn floats_by_bits(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel) - 0.5;
    let up = here.x.next_up().to_bits().wrapping_sub(here.x.to_bits());
    let down = here.y.next_down().to_bits().wrapping_sub(here.y.to_bits());
    let tiny = f32::from_bits(pixel.x as u32 * 0x0010_0000);
    let kind = u32::from(tiny.is_subnormal()) + 2 * u32::from(here.z.is_normal()) + 4 * u32::from(tiny.is_normal());
    vec4(up as i32 as f32, down as i32 as f32, kind as f32, 0.0_f32.next_up().to_bits() as f32)
}

//// Integer vectors that saturate and that may overflow, and their distances
pub fn vectors_of_integers(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = (color.load(pixel).truncate() * 4.0e9 - 2.0e9).as_ivec3();
    let other = here.yzx();
    let sum = here.saturating_add(other) ^ here.saturating_sub(other) ^ here.saturating_mul(other);
    let fits = here.checked_add(other).unwrap_or(IVec3::AXES[1]) ^ here.checked_mul(other).unwrap_or(IVec3::ONE);
    let small = IVec3::from_array([pixel.x, pixel.y, 3]);
    let near = small.manhattan_distance(IVec3::splat(4)) + small.chebyshev_distance(IVec3::splat(2)) * 16;
    let around = small.cross(IVec3::new(2, -1, 5));
    vec4(((sum ^ fits) & IVec3::splat(255)).dot(around) as f32, near as f32, around.x as f32, around.z as f32)
}

//// Rows, diagonals and parts of matrices
pub fn parts_of_matrices(color: &Frame<Vec4>, grade: Mat3, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel).truncate();
    let turned = Mat4::from_axis_angle(Vec3::Y, here.x) * Mat4::from_rotation_z(here.y) * Mat4::from_rotation_x(here.z);
    let rows = Mat3::from_rows(here, grade.row(1), grade.diagonal());
    let scaled = rows.mul_scalar(0.5).add_mat3(&grade).mul_diagonal_scale(here + 0.5).abs();
    let flat = Mat3::from_scale_angle_translation(here.xy(), here.z, here.yz()).transform_point2(here.zx());
    let back = scaled.transpose_mul_vec3(here) + rows.inverse_or_zero() * here * 1.0e-3;
    let placed = Mat4::from_mat3_translation(rows, back).to_rows_array();
    let minor = Mat2::from_mat3_minor(rows, 1, 2);
    vec4(turned.x_axis.dot(placed[3] * Vec4::ONE), back.y, flat.x + minor.y_axis.x, flat.y + grade.to_cols_array_2d()[1][2])
}

//// Quaternions
pub fn quaternions(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let axis = (here.truncate() + 0.25).normalize();
    let turn = Quat::from_axis_angle(axis, here.w * 3.0) * Quat::from_rotation_y(here.x);
    let between = Quat::IDENTITY.slerp(turn, 0.25).lerp(Quat::from_rotation_arc(Vec3::X, axis), 0.5);
    let back = Quat::from_mat3(&Mat3::from_quat(between.normalize()));
    let placed = Mat4::from_scale_rotation_translation(here.truncate(), turn.conjugate(), axis);
    let moved = placed.transform_point3(between * axis) + axis.rotate_axis(Vec3::Z, here.y);
    moved.extend(back.dot(turn) + turn.angle_between(back) + turn.to_scaled_axis().x)
}

//// Smooth steps, tests and homogeneous coordinates of vectors
pub fn vectors_by_component(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let smooth = here.smoothstep(Vec4::splat(0.1), Vec4::splat(0.9)) + Vec4::splat(0.5).step(here);
    let (sines, cosines) = here.sin_cos();
    let odd = (here / (here - here.x)).is_finite_mask();
    let flat = Vec3::from_homogeneous(here + 1.0).to_homogeneous();
    Vec4::select(odd, smooth + sines * cosines, flat) + here.lerp_monotonic(smooth, 0.25)
}

//// Slices that are sorted, rotated, compared and exchanged
pub fn slices_in_place(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut all = [here.x, here.y, here.z, here.w, taps as f32 * 0.1];
    let sorted = all.is_sorted() || all[1..3].is_sorted_by(|a, b| a <= b);
    all.rotate_left(2);
    let mut order = [3, pixel.x & 3, taps & 3];
    order.sort_unstable_by_key(|k| -*k);
    let mut others = [0.5; 5];
    others.swap_with_slice(&mut all);
    let begins = order.starts_with(&[3, 3]) || order.ends_with(&[0]);
    let last = others.iter().rposition(|x| *x > 0.5).unwrap_or(7);
    let kept: f32 = others.iter().map_while(|x| if *x < 0.75 { Some(*x * 2.0) } else { None }).sum();
    let old = std::mem::take(&mut others[1]);
    vec4(kept + old, last as f32 + all[2], order[1] as f32, u32::from(sorted) as f32 + u32::from(begins) as f32)
}

//// Options that are taken and replaced
pub fn options_in_place(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut first = (here.x > 0.5).then_some(here.x);
    let old = first.replace(here.y).unwrap_or(0.25);
    let taken = if here.z > 0.5 { first.take() } else { None };
    let result: Result<f32, u32> = taken.ok_or(3);
    let other = result.or_else(|e| if here.w > 0.5 { Ok(e as f32) } else { Err(7_u32) });
    let sum = other.map_or_else(|e| e as f32, |x| x * 2.0) + other.unwrap_or_default();
    vec4(old, sum, first.unwrap_or(0.5), u32::from(other.is_ok_and(|x| x > 1.0)) as f32)
}

//// Associated types of type parameters: `C::Space::WHITE`, and functions of them as values
trait Space {
    const WHITE: Vec3;
    fn encode(x: f32) -> f32;
}

trait Curve {
    type Space: Space;
    fn apply(x: f32) -> f32 {
        x * x
    }
}

struct Linear;
struct Squared;
struct First;
struct Second;

impl Space for Linear {
    const WHITE: Vec3 = Vec3::ONE;
    fn encode(x: f32) -> f32 {
        x
    }
}

impl Space for Squared {
    const WHITE: Vec3 = vec3(0.9, 1.0, 0.5);
    fn encode(x: f32) -> f32 {
        x.max(0.0).sqrt()
    }
}

impl Curve for First {
    type Space = Linear;
}

impl Curve for Second {
    type Space = Squared;
    fn apply(x: f32) -> f32 {
        x * 0.5
    }
}

#[derive(Clone, Copy)]
struct Level(f32);

impl std::ops::Add for Level {
    type Output = Level;
    fn add(self, other: Level) -> Level {
        Level(self.0 + other.0)
    }
}

impl From<f32> for Level {
    fn from(x: f32) -> Level {
        Level(x * 2.0)
    }
}

fn mapped<C: Curve>(color: Vec3) -> Vec3 {
    (color * C::Space::WHITE).map(C::apply).map(C::Space::encode) + <C::Space as Space>::WHITE * C::Space::encode(0.25)
}

pub fn associated(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel).xyz();
    let level = Level(here.x) + here.y.into();
    (mapped::<First>(here) - mapped::<Second>(here)).extend(level.0)
}

//// Imports from modules and enums: `use super::{Vec3, helper}`, `use self::..`, `use Enum::*`, `use std::cmp::Ordering::*`
use self::tone::graded as toned;
use std::cmp::Ordering::*;
use std::cmp::{max, min as least};
use std::f32::consts::{self, FRAC_1_PI as PART};
use tone::{SHARE, inner};

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Dark,
    Mid(f32),
    Bright { x: f32 },
}

fn helper(x: f32) -> f32 {
    x * 0.5
}

mod light {
    use super::{Vec3, helper, vec3};
    pub fn lit(x: f32) -> Vec3 {
        vec3(x, helper(x), 1.0)
    }

    #[derive(Clone, Copy, PartialEq)]
    pub enum Side {
        Left,
        Right,
    }
    impl Side {
        pub const ALL: [Side; 2] = [Side::Left, Side::Right];
    }
}

mod tone {
    use self::inner::deep;
    use super::*;
    pub mod inner {
        use super::super::*;
        pub fn deep(x: f32) -> f32 {
            helper(x) + 0.125
        }
    }

    pub fn graded(v: Vec3) -> Vec3 {
        v * deep(v.x)
    }

    pub const SHARE: f32 = 0.25;
}

pub fn imports(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    use self::light::lit;
    use Kind::*;
    use light::Side::{self, Left, Right as Opposite};
    let here = color.load(pixel);
    let order = match here.x.partial_cmp(&0.5) {
        Some(Less) => 0.25,
        Some(Equal) => 0.5,
        Some(Greater) => 1.0,
        None => 0.0,
    };
    let kind = if here.y > 0.5 {
        Bright { x: here.y }
    } else if here.y > 0.25 {
        Mid(here.z)
    } else {
        Dark
    };
    let value = match kind {
        Dark => 0.0,
        Mid(x) => x,
        Bright { x } => x * 2.0,
    };
    let side = if pixel.x > 3 { Left } else { Opposite };
    let sides = match side {
        Left => 1.0,
        Opposite => 2.0,
    } + (side == Side::ALL[1]) as i32 as f32;
    let sizes = max(pixel.x, 3)
        + least(pixel.y, 2)
        + match pixel.x.cmp(&pixel.y) {
            Less => 1,
            Equal | Greater => 2,
        };
    let colour = lit(here.x) + toned(here.xyz()) * SHARE;
    colour.extend(inner::deep(here.w)) + vec4(order, value, sides, sizes as f32) + PART * consts::FRAC_1_SQRT_2
}
