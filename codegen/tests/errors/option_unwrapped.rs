fn bright(x: f32) -> Option<f32> {
    if x > 0.5 { Some(x) } else { None }
}

fn never() -> Option<f32> {
    None
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let a = bright(here.x).unwrap();
    let b = bright(here.y).expect("bright");
    let c = never().unwrap();
    here * a * b * c
}
