struct Gain(f32);

impl Shade for Gain {
    fn shade(&self, x: f32) -> f32 { self.0 * x }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let gain = Gain(2.0);
    color.load(pixel) * gain.0
}
