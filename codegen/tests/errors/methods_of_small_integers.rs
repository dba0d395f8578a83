pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let r = (color.load(pixel).x * 255.0) as u8;
    let darker = r.saturating_sub(20);
    let all = r.wrapping_add(200);
    vec4(darker as f32, all as f32, (!r) as f32, (r + 1) as f32)
}
