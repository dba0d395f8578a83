struct Tone {
    gain: f32,
}

fn scaled(by: f32) -> impl Fn(f32) -> f32 {
    move |x| x * by
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let tone = Tone { gain: 2.0 };
    let x = (tone.gain)(1.0);
    let y = scaled(2.0)(1.0, 2.0);
    let z = scaled(2.0)(1);
    let curve: fn(f32) -> f32 = scaled;
    let other: fn(f32) -> f32 = f32::max;
    color.load(pixel) * x
}
