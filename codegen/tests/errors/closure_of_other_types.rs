fn twice(f: impl Fn(f32) -> f32, x: f32) -> f32 {
    f(f(x))
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let add = |x: f32, y: f32| x + y;
    let a = twice(|x| x.floor() as i32, here.x);
    let b = twice(add, here.y) + add(here.z);
    here * (a + b)
}
