pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut n = 0;
    let x = loop {
        n += 1;
        if color.load(pixel).x > 0.5 {
            break 1.0;
        }
        if n > 3 {
            break n;
        }
    };
    for j in 0..3 {
        if j == 2 {
            break j;
        }
    }
    while n > 0 {
        n -= 1;
        break 2.0;
    }
    color.load(pixel) * x
}
