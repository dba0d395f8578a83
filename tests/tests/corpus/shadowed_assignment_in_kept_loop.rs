// A structured loop that assigns a variable of its own made an outer variable of the same name unknown.
// expect 1 0: 2 2 2 2

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = 2;
    let mut sum = 0.0;
    while v > 0 {
        v -= 1;
        for i in 0..pixel.x {
            let mut v = a.load(pixel);
            v.w = 1.0;
            sum += v.w;
        }
    }
    Vec4::splat(sum)
}
