struct Window<const R: usize> {
    weight: f32,
}

impl<const R: usize> Window<R> {
    fn sum(&self) -> f32 {
        self.weight * R as f32
    }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let window = Window { weight: 0.5 };
    color.load(pixel) * window.sum()
}
