//// Tables of `u8` and `i8`, and integers of 8 and 16 bits that are stored, compared and converted
const PERMUTATION: [u8; 16] = [9, 14, 3, 6, 255, 1, 12, 8, 4, 0, 7, 15, 2, 200, 10, 5];
const OFFSETS: [i8; 4] = [-128, -3, 0, 127];

#[derive(Clone, Copy, Default, PartialEq, PartialOrd)]
struct Texel {
    red: u8,
    height: i16,
}

pub fn narrow_integers(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let hash = PERMUTATION[(pixel.x & 15) as usize] as usize;
    let again = PERMUTATION[(hash + pixel.y as usize) & 15];
    let here = color.load(pixel);
    let texel = Texel { red: (here.x * 300.0) as u8, height: (here.y * 1e5 - 4e4) as i16 };
    let low = (pixel.x * 77 + taps) as i8;
    let top = (pixel.y as u32).wrapping_mul(0x9e37_79b9).to_be_bytes();
    let [_, r, g, b] = 0x11_aa_bb_ccu32.to_be_bytes();
    let sum = match again {
        0..=9 => OFFSETS[(pixel.y & 3) as usize] as i32,
        10 | b'\x0c' => i32::from(low),
        u8::MAX => -1,
        _ => low.max(-5).min(i8::MAX) as i32,
    };
    let more = if texel > Texel::default() { f32::from(texel.red) } else { texel.height as f32 };
    vec4(sum as f32, more, f32::from(top[0] ^ top[3]), (u32::from(r) + g as u32 * u32::from(b >> 2)) as f32)
}

//// Discriminants of enums: `Format::Half as u32`
const FIRST: i32 = 3;

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(i32)]
enum Format {
    Byte = FIRST,
    Half,
    Single = 1 << 4,
    Below = -7,
}

#[derive(Clone, Copy)]
enum Switch {
    Off,
    On,
}

impl Format {
    const ALL: [Self; 4] = [Self::Byte, Self::Half, Self::Single, Self::Below];

    fn of(code: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|format| *format as i32 == code)
    }
}

pub fn discriminants(taps: i32, pixel: IVec2) -> Vec4 {
    let format = Format::of(pixel.x + taps).unwrap_or(Format::Below);
    let switch = if pixel.y > 2 { Switch::On } else { Switch::Off };
    let order = if format < Format::Half { 1.0 } else { 0.0 };
    vec4(format as i32 as f32, format as u32 as f32, switch as usize as f32, order)
}

//// Derived `PartialOrd` of structures, tuples, enums and options
#[derive(Clone, Copy, PartialEq, PartialOrd)]
struct Version {
    major: i32,
    minor: f32,
    last: bool,
}

#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Weight {
    None,
    Share(f32),
    Whole { of: i32 },
}

pub fn orders(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let there = color.load(pixel + ivec2(1, taps));
    let version = |v: Vec4| Version { major: (v.x * 3.0) as i32, minor: (v.y * 4.0).floor() / v.z.floor(), last: v.w > 0.5 };
    let weight = |v: Vec4| match (v.x * 3.0) as i32 {
        0 => Weight::None,
        1 => Weight::Share(v.y),
        _ => Weight::Whole { of: (v.z * 4.0) as i32 },
    };
    let (a, b) = (version(here), version(there));
    let (c, d) = (weight(here), weight(there));
    let some = |v: Vec4| (v.x > 0.5).then_some(v.y);
    let bits = [
        a < b, a <= b, a > b, a >= b, c < d, c <= d, c > d, c >= d,
        (a.major, here.y) < (b.major, there.y), [here.x, here.y] >= [here.x, there.y], some(here) < some(there), a.last < b.last,
    ];
    let mut code = 0;
    for (k, bit) in bits.into_iter().enumerate() {
        code |= u32::from(bit) << k;
    }
    vec4(code as f32, 0.0, 0.0, 1.0)
}

//// `round`, `fract`, `signum` and `hypot` with Rust's meaning
pub fn roundings(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let x = (here.x - 0.5) * 4.0 + (pixel.x as f32) * 0.5 - 3.0;
    let v = vec3(x, -x, x * 2.0);
    let rounded = v.round() + v.fract().signum() * Vec2::splat(x).round().extend(x.fract());
    vec4(rounded.x, rounded.y, rounded.z, (x * 3.0).round() + (0.0 * x).signum() + 3.0f32.hypot(4.0) + vec4(x, x, x, x).round().z)
}

//// Vectors and matrices written as structures: `Vec3 { x, y, z }`
pub fn written_out(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let Vec3 { x, y, .. } = color.load(pixel).truncate();
    let turned = Vec3 { x: y, y: x, ..Vec3::ONE };
    let IVec4 { x: a, w: b, .. } = IVec4 { x: pixel.x, y: pixel.y, z: 3, w: 4 };
    let basis = Mat3 { x_axis: turned, y_axis: Vec3::Y, z_axis: Vec3 { z: x, ..Vec3::ZERO } };
    let flags = BVec2 { x: a > b, y: true };
    (basis * turned).extend(if flags.all() { 1.0 } else { 0.5 })
}

//// Literals where a function takes numbers and vectors: `mix(32.0, 8.0, x)`
pub fn literals(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = color.load(pixel).x;
    let layers = mix(32.0, 8.0, x) as u32;
    let smooth = smoothstep(0.0, 1.0, 0.25);
    vec4(layers as f32, smooth, saturate(1.5), sign(-2.0))
}
