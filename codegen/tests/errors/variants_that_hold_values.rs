enum Shape {
    Empty,
    Disc(f32),
    Slab { half: Vec2, round: f32 },
}

fn area(shape: Shape) -> f32 {
    match shape {
        Shape::Empty => 0.0,
        Shape::Disc => 1.0,
        Shape::Slab { half, height } => half.x,
        Shape::Ring(r) => r,
    }
}

fn size(shape: &Shape) -> f32 {
    match shape {
        Shape::Disc(r) => *r,
        Shape::Slab { round, .. } => *round,
    }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let a = Shape::Disc(1);
    let b = Shape::Disc(1.0, 2.0);
    let c = Shape::Slab { half: here.x, round: 1.0 };
    let d = Shape::Empty(1.0);
    let e = Shape::Slab;
    let same = if a == Shape::Empty { 1.0 } else { 0.0 };
    let Shape::Disc(r) = a;
    here * area(a) * size(&b) * same * r
}
