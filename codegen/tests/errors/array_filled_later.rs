pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = color.load(pixel).x;
    let sums = std::array::from_fn(|_| {
        sum += 1.0;
        sum
    });
    sum = 8.0;
    let [first, second]: [f32; 2] = sums;
    vec4(first, second, sum, 1.0)
}
