pub struct Inner {
    low: f32,
}

pub struct Outer {
    range: Inner,
    range_low: f32,
}

pub fn k(all: &Buffer<Outer>, pixel: IVec2) -> Vec4 {
    Vec4::splat(all.load(0).range.low)
}
