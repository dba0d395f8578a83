struct Window<const N: u32> {
    taps: [f32; N],
}

struct Row<const N: usize> {
    taps: [f32; N],
}

impl<const N: u32> Row<N> {
    fn first(&self) -> f32 { self.taps[0] }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let window = Window { taps: [1.0, 2.0] };
    let row = Row { taps: [1.0, 2.0] };
    color.load(pixel) * window.taps[0] * row.first()
}
