// Each write copies the array: takes minutes.

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut x = [0.0; 65536];
    for i in 0..65536 {
        x[i] = 1.0;
    }
    Vec4::splat(x[0])
}
