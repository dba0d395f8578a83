pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let mut sum = 0.0;
    for j in 0..3 {
        sum += 'a: {
            if here.x > 0.5 {
                break;
            }
            if here.y > 0.5 {
                continue 'a;
            }
            if here.z > 0.5 {
                break 'b 2.0;
            }
            break 'a true;
            1.0
        };
    }
    here * sum
}
