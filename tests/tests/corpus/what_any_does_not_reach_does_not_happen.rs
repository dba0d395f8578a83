// `any` and `all` called a closure that changes a buffer for what is behind the first that decides, too.

pub fn k(a: &Frame<Vec4>, xi: &AtomicBuffer<i32>, pixel: IVec2) -> Vec4 {
    let any = [1, 2, 3].into_iter().any(|k: i32| xi.add(k as usize, k) > pixel.x * 3);
    let all = (4..7).all(|k: i32| xi.add(k as usize, k) < pixel.y * 20);
    let same = if [7, 8].iter().any(|k: &i32| xi.xor(*k as usize, 5) > *k) { pixel.x } else { pixel.x };
    vec4(any as u32 as f32, all as u32 as f32, same as f32, 1.0)
}
