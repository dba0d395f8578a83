// Memory for every element: the process is aborted.

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let x = [[0.0; 65536]; 65536];
    Vec4::splat(x[0][0])
}
