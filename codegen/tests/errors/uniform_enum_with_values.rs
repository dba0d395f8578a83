#[derive(Clone, Copy)]
pub enum Shape {
    Point,
    Disc(f32),
}

pub fn k(color: &Frame<Vec4>, shape: Shape, pixel: IVec2) -> Vec4 {
    match shape {
        Shape::Point => color.load(pixel),
        Shape::Disc(radius) => color.load(pixel) * radius,
    }
}
