//// `match` on a runtime value: literals, `|`, ranges
pub fn match_at_run_time(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    match (here.x * 8.0) as i32 {
        0 | 1 => here,
        2..=4 => here * 0.5,
        _ => Vec4::ONE,
    }
}

//// `match` with guards and bindings
pub fn match_guards(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let weight = match (here.y * 8.0) as i32 {
        n @ 0..=3 if here.x > 0.5 => n as f32,
        n if n % 2 == 0 => 0.5,
        _ => 0.25,
    };
    here * weight
}

//// `match` on tuples
pub fn match_tuples(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    match (here.x > 0.5, here.y > 0.5) {
        (true, true) => here,
        (false, _) => here.zyxw(),
        (true, false) => Vec4::ZERO,
    }
}

//// `if let` and chains of it
pub fn if_let(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    if let (1, y) | (y, 1) = (pixel.x & 3, pixel.y & 3)
        && y > 0
    {
        here * y as f32
    } else {
        here
    }
}

//// `let ... else`
pub fn let_else(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let (0, row) = (pixel.x & 1, pixel.y) else {
        return here;
    };
    here * row as f32
}

//// `while let`
pub fn while_let(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut at = 0;
    let mut sum = Vec4::ZERO;
    while let k @ 0..=4 = at {
        sum += color.load(pixel + ivec2(k, 0));
        at += 2;
    }
    sum
}

//// `matches!`
pub fn matches_macro(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    if matches!(pixel.x, 0..=3 | 8) { color.load(pixel) } else { Vec4::ZERO }
}

//// Patterns in `let`, parameters and closures
fn difference((a, b): (f32, f32)) -> f32 {
    a - b
}

pub fn patterns(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let [x, y, ..] = color.load(pixel).to_array();
    let mean = |[a, b]: [f32; 2]| 0.5 * (a + b);
    Vec4::splat(difference((x, y)) + mean([x, y]))
}

//// Assignment to several places
pub fn several_places(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let (mut a, mut b) = (here.x, here.y);
    (a, b) = (b, a + b);
    [a, b] = [b * 0.5, a];
    Vec4::splat(a - b)
}
