//// `skip`, `take`, `step_by`, `rev` and `enumerate` of ranges with runtime bounds
pub fn lazy_parts(weights: &Buffer<f32>, taps: i32, pixel: IVec2) -> Vec4 {
    let n = weights.len().min((taps + (pixel.x & 3)).max(0) as usize);
    let tail: f32 = (0..n).skip(1).map(|k| weights.load(k)).sum();
    let head: f32 = (0..n).take(2).map(|k| weights.load(k) * 0.5).sum();
    let inner = (-taps..=taps).skip(1).take(3).fold(1, |a, k| a * 3 + k);
    let back = (0..n).map(|k| weights.load(k)).rev().skip(1).fold(0.25, |a, x| a * 0.5 + x);
    let mut sum = 0.0;
    for (k, x) in (0..n).rev().enumerate() {
        sum += weights.load(x) * k as f32;
    }
    for (k, x) in (pixel.x..pixel.x + taps).step_by(2).map(|x| x * 2).enumerate().skip(1) {
        sum += (k as i32 * x) as f32;
    }
    let few = (0..20).take((pixel.y & 7) as usize).map(|k| k * k).sum::<i32>() + (2..9).skip((pixel.x & 3) as usize).count() as i32;
    let listed = [1, 5, 2, 4].iter().take((pixel.x & 3) as usize).rev().fold(0, |a, k| a * 2 + k);
    vec4(tail + head, inner as f32 + back, sum, (few + listed) as f32)
}

//// `zip` of ranges with runtime bounds, and of arrays
pub fn lazy_pairs(color: &Frame<Vec4>, weights: &Buffer<f32>, taps: i32, pixel: IVec2) -> Vec4 {
    let n = weights.len().min((taps + (pixel.x & 3)).max(0) as usize);
    let shares = [0.5, 0.25, 0.125, 2.0, 1.0];
    let mut sum = Vec4::ZERO;
    for (x, share) in (-taps..=taps).zip(shares) {
        sum += color.load(pixel + ivec2(x, 0)) * share;
    }
    let both: f32 = shares.iter().zip(0..n).map(|(share, k)| share * weights.load(k)).sum();
    let turned = (0..n).rev().zip((0..taps).step_by(2)).fold(1.0, |a, (k, x)| a * 0.5 + weights.load(k) * x as f32);
    let three = (0..n).zip(shares.iter().zip(3..9)).enumerate().find(|(_, (k, (_, x)))| k * x > 7);
    sum + vec4(both, turned, three.map_or(-1.0, |(k, (_, (share, _)))| k as f32 + share), 0.0)
}
