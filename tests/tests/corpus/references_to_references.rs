// A reference to a reference is a place, too, however deep.

fn add(by: &mut &mut f32, x: f32) {
    **by += x;
}

pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut v = a.load(pixel);
    let mut first = v.x;
    {
        let mut one = &mut first;
        let two = &mut one;
        let three = &mut *two;
        ***(&mut &mut *three) *= 2.0;
        add(three, 1.0);
        let four = &three;
        v.y = ****&four + 0.5;
    }
    v.x = first;
    v
}
