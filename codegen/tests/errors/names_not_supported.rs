struct Shape<const N: usize> {
    weights: [f32; N],
}

impl<const N: usize> Shape<N> {
    fn unit() -> f32 {
        1.0
    }

    fn power<const K: usize>(&self) -> f32 {
        K as f32
    }
}

fn area<T: Surface>(x: T) -> f32 {
    T::area(x)
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let r#type = Shape::<3>::unit();
    let shape = Shape { weights: [r#type; 3] };
    let a = shape.power::<2>() + area(1.0);
    let b: f64 = 1.0;
    color.load(pixel) * a * <f32>::MAX
}
