// A value that doubles thirty times: the process is aborted.

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let v = (0.0, 0.0);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    let v = (v, v);
    Vec4::ZERO
}
