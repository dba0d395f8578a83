//// `return` from the middle of a function
fn graded(x: f32) -> f32 {
    if x < 0.25 {
        return 0.0;
    }
    x * 2.0
}

pub fn returned(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(graded(color.load(pixel).x))
}

//// `return` from a loop
fn first_above(color: &Frame<Vec4>, from: IVec2, bound: f32) -> i32 {
    for k in 0..8 {
        if color.load(from + ivec2(k, 0)).x > bound {
            return k;
        }
    }
    -1
}

pub fn returned_from_a_loop(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(first_above(color, pixel, 0.75) as f32)
}

//// `break` under a runtime condition
pub fn broken(color: &Frame<Vec4>, strength: f32, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    for k in 0..8 {
        if sum > strength {
            break;
        }
        sum += color.load(pixel + ivec2(k, 0)).x;
    }
    Vec4::splat(sum)
}

//// `continue` under a runtime condition
pub fn continued(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    for k in 0..6 {
        let here = color.load(pixel + ivec2(k, k));
        if here.x < 0.5 {
            continue;
        }
        sum += here.y;
    }
    Vec4::splat(sum)
}

//// `break` and `continue` of an outer loop
pub fn labelled(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = 0.0;
    'rows: for y in 0..4 {
        for x in 0..4 {
            let here = color.load(pixel + ivec2(x, y)).x;
            if here > 0.9 {
                break 'rows;
            }
            if here > 0.6 {
                continue 'rows;
            }
            sum += here;
        }
    }
    Vec4::splat(sum)
}

//// `while` that ends at run time
pub fn while_at_run_time(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut x = color.load(pixel).x + 0.1;
    let mut count = 0;
    while x < 4.0 {
        x *= 1.5;
        count += 1;
    }
    Vec4::splat(count as f32)
}

//// `while` with a bound on its iterations
pub fn while_with_a_bound(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut x = color.load(pixel).x + 0.1;
    let mut count = 0;
    #[cfg_attr(false, bound(12))]
    while x < 4.0 {
        x *= 1.5;
        count += 1;
    }
    Vec4::splat(count as f32)
}

//// `loop` that ends at run time
pub fn loop_at_run_time(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut at = pixel;
    loop {
        if color.load(at).x > 0.5 || at.x > 40 {
            break;
        }
        at.x += 1;
    }
    Vec4::splat(at.x as f32)
}

//// `loop` that gives a value
pub fn loop_with_a_value(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut k = 0;
    let found = loop {
        let here = color.load(pixel + ivec2(k, 0));
        if here.x > 0.5 {
            break here.y;
        }
        if k == 9 {
            break 0.0;
        }
        k += 1;
    };
    Vec4::splat(found)
}

//// A block that is left with a value
pub fn block_with_a_value(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let weight = 'weight: {
        if here.x > 0.75 {
            break 'weight 1.0;
        }
        if here.y > 0.75 {
            break 'weight 0.5;
        }
        0.25
    };
    here * weight
}

//// `for` with bounds that are runtime values
pub fn bounds_at_run_time(color: &Frame<Vec4>, taps: i32, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for k in -taps..=taps {
        sum += color.load(pixel + ivec2(k, 0));
    }
    sum
}

//// `for` over ranges by `rev` and `step_by`
pub fn ranges(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for k in (0..9).step_by(2).rev() {
        sum = sum * 0.5 + color.load(pixel + ivec2(k, 0));
    }
    sum
}

//// `for` over an array, by value and by reference
pub fn for_over_an_array(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut weights = [0.1, 0.2, 0.4];
    for weight in &mut weights {
        *weight *= 2.0;
    }
    let mut sum = 0.0;
    for (k, weight) in weights.into_iter().enumerate() {
        sum += color.load(pixel + ivec2(k as i32, 0)).x * weight;
    }
    Vec4::splat(sum)
}

//// A block as an expression
pub fn block_expression(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let luma = {
        let here = color.load(pixel);
        here.x * 0.3 + here.y * 0.6
    };
    Vec4::splat(luma)
}

//// Recursion that ends when the shader is made
fn binomial(n: i32, k: i32) -> i32 {
    if k == 0 || k == n { 1 } else { binomial(n - 1, k - 1) + binomial(n - 1, k) }
}

pub fn recursion(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for k in 0..=4 {
        sum += color.load(pixel + ivec2(k, 0)) * binomial(4, k) as f32 / 16.0;
    }
    sum
}

//// Recursion that ends at run time
fn depth_of(x: f32) -> f32 {
    if x < 1.0 { x } else { depth_of(x * 0.5) + 1.0 }
}

pub fn recursion_at_run_time(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    Vec4::splat(depth_of(color.load(pixel).x * 8.0))
}
