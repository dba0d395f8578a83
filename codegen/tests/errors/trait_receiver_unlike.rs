trait Shade {
    fn shade(&self, x: f32) -> f32;
    fn twice(self, x: f32) -> f32 { self.shade(self.shade(x)) }
}

#[derive(Clone, Copy, PartialEq)]
struct Gain(f32);

impl Shade for Gain {
    fn shade(self, x: f32) -> f32 { self.0 * x }
}

impl PartialOrd for Gain {
    fn partial_cmp(self, other: &Self) -> Option<std::cmp::Ordering> { self.0.partial_cmp(&other.0) }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let gain = Gain(2.0);
    let less = if gain < Gain(3.0) { 1.0 } else { 0.0 };
    color.load(pixel) * gain.shade(0.5) * gain.twice(0.5) * less
}
