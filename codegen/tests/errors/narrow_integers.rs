const TABLE: [u8; 4] = [1, 2, 3, 256];

enum Twice {
    A = 1,
    B = 1,
}

pub fn k(color: &Frame<Vec4>, levels: &Buffer<u8>, pixel: IVec2) -> Vec4 {
    let a = TABLE[(pixel.x & 3) as usize];
    let b = a + 1;
    let c = a.count_ones();
    let d = i8::from(a);
    let e = u8::from(pixel.x);
    let f = !a;
    let g = if pixel.x > 3 { Twice::A } else { Twice::B };
    color.load(pixel) * (b as f32 + c as f32 + d as f32 + e as f32 + f as f32) * g as i32 as f32
}
