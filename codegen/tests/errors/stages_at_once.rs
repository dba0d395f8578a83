struct Glow {
    radius: f32,
}

fn falloff(x: f32) -> f32 {
    let text = format!("{x}");
    x * 2.0
}

fn share(x: f32) -> f32 {
    let n: i32 = x;
    missing(n)
}

pub fn k(color: &Frame<Vec4>, glow: &mut Glow, label: &str, pixel: IVec2) -> Vec4 {
    let weight: i32 = falloff(0.5);
    let other: bool = share(weight as f32);
    color.load(pixel) * sharpness
}
