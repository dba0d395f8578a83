fn halve(list: &mut [f32]) {
    list[0] *= 0.5;
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let all = here.to_array();
    let part = all[1..3];
    let pair = &here[..2];
    let floats = &all[0.5..];
    let mapped = all[1..3].map(|x| x * 2.0);
    halve(&mut all[1..]);
    for x in all[..2] {
        halve(&all[2..]);
    }
    Vec4::splat(part[0])
}
