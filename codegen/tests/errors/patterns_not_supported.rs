pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let ref a = 1.0;
    let (b, ..) = (1.0, 2.0);
    let c = match 2 {
        0..=1 => 1.0,
        const { 5 } => 3.0,
        _ => 4.0,
    };
    _ = const { 1.0 };
    color.load(pixel) * a * b * c
}
