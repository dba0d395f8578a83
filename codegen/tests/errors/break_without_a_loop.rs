fn f(x: f32) -> f32 {
    if x > 0.5 {
        break;
    }
    x
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = f(color.load(pixel).x);
    'rows: for y in 0..4 {
        for x in 0..4 {
            if color.load(pixel + ivec2(x, y)).x > 0.5 {
                continue 'columns;
            }
            sum += 1.0;
        }
    }
    Vec4::splat(sum)
}
