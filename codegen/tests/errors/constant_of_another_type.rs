struct Window<const R: usize> {
    weight: f32,
}

impl<const R: usize> Window<R> {
    fn sum(&self) -> f32 {
        self.weight * R as f32
    }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let narrow = Window::<3> { weight: 0.5 };
    let wide: Window<5> = narrow;
    color.load(pixel) * wide.sum()
}
