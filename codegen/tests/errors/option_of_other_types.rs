fn bright(x: f32) -> Option<f32> {
    if x > 0.5 { Some(x) } else { None }
}

fn tried(x: f32) -> f32 {
    bright(x)? * 2.0
}

fn twice(x: f32) -> Option<f32> {
    let y = x?;
    Some(y * 2.0)
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let a: f32 = bright(here.x);
    let b = bright(here.y).unwrap_or(1);
    let c = bright(here.z).map(|x| x as i32).unwrap_or(0.5);
    let d = bright(here.w) + 1.0;
    let e = bright(Some(0.5));
    let f = match bright(0.5) {
        Some(x) => x,
    };
    let g = if let Some(x, y) = bright(0.5) { x } else { 0.0 };
    here * a * b * c * d * e * f * g * tried(1.0) * twice(1.0).unwrap_or(0.0)
}
