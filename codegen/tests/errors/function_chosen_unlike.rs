fn half(x: f32) -> f32 {
    x * 0.5
}

fn halves(x: i32) -> i32 {
    x / 2
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let curve = if pixel.x < 2 { half } else { halves };
    color.load(pixel) * curve(1.0)
}
