// With its loops left in the shader, the counter is not known to the condition of `while`.

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    for i in 0..3 {
        let mut n = 0;
        while n < i {
            n += 1;
            sum += a.load(pixel).x;
        }
    }
    Vec4::splat(sum)
}
