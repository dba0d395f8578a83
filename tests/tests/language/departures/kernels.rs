//! Kernels whose loops are left early, across loops that stay in the shader and loops that are unrolled: compiled by rustc, and
//! read as text by the generator.

use straightline_kernels::prelude::*;

/// A loop of three steps at most inside of two steps inside of a loop with runtime bounds, which is continued from within.
pub fn continues_outer(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut t = (color.load(pixel).x * 8.0) as i32 + pixel.x;
    let mut u = n + pixel.y;
    'outer: for i in (t & 3)..(u & 7) {
        let mut a = 0;
        loop {
            if a >= 2 {
                break;
            }
            a += 1;
            t = {
                let mut b = 0;
                loop {
                    b += 1;
                    if t < i {
                        break u;
                    }
                    if b == 3 {
                        break t ^ b;
                    }
                }
            };
            if t == u {
                continue 'outer;
            }
            u ^= t;
        }
        t ^= i;
    }
    vec4(t as f32, u as f32, 0.0, 1.0)
}

/// The outer loop ends at run time; the inner one after four steps at most.
pub fn continues_counting(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut a = 0;
    let s = color.load(pixel).x;
    'o: loop {
        let mut b = 0;
        loop {
            b += 1;
            if b > a + n - 3 {
                a += 1;
                continue 'o;
            }
            if b == 4 {
                break 'o;
            }
        }
    }
    vec4(s + a as f32, 0.0, 0.0, 1.0)
}

/// Three loops deep, each left from the innermost.
pub fn three_deep(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let (mut s, mut k) = (c.x, 0);
    'a: for i in 0..4 {
        'b: for j in 0..3 {
            for l in 0..3 {
                k += 1;
                s = s * 1.5 + (i * 9 + j * 3 + l) as f32;
                if s > 40.0 + c.y {
                    s -= 30.0;
                    continue 'a;
                }
                if k + pixel.x == n * 2 {
                    continue 'b;
                }
                if s < -2.0 {
                    break 'a;
                }
            }
            s += 0.25;
        }
        s -= 0.5;
    }
    vec4(s, k as f32, 0.0, 1.0)
}

/// A labelled `break` out of a `while` in a `for`.
pub fn breaks_labelled(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let (mut s, mut found) = (c.x, -1);
    'rows: for y in 0..5 {
        let mut x = 0;
        while x < 4 {
            s = s * 0.75 + color.load(pixel + ivec2(x, y)).y;
            if s > n as f32 * 0.5 {
                found = y * 4 + x;
                break 'rows;
            }
            x += 1;
        }
    }
    vec4(s, found as f32, 0.0, 1.0)
}

/// `continue` in the arms of a `match`.
pub fn continues_in_arms(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut s = color.load(pixel).x;
    let mut state = n + pixel.x;
    'all: for i in 0..6 {
        let mut j = 0;
        loop {
            j += 1;
            let step = match state % 5 {
                0 => {
                    state += 3;
                    continue 'all;
                }
                1 if j < 3 => {
                    state += i;
                    continue;
                }
                2 => break,
                3 => break 'all,
                other => other,
            };
            s += step as f32;
            state += 1 + j;
            if j == 3 {
                break;
            }
        }
        s *= 1.25;
    }
    vec4(s, state as f32, 0.0, 1.0)
}

fn first_above(color: &Frame<Vec4>, pixel: IVec2, least: f32) -> i32 {
    let mut k = 0;
    while k < 6 {
        for side in 0..2 {
            if color.load(pixel + ivec2(k, side)).x > least {
                return k * 2 + side;
            }
        }
        k += 1;
    }
    -1
}

/// `return` from a function that is called in loops.
pub fn returns_from_calls(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut s = 0.0;
    'rows: for i in 0..3 {
        for j in 0..3 {
            let at = first_above(color, pixel + ivec2(i, j), n as f32 * 0.2 + j as f32 * 0.1);
            if at < 0 {
                continue 'rows;
            }
            if at == 7 {
                return vec4(s, 7.0, i as f32, j as f32);
            }
            s += at as f32;
        }
        s = s * 1.5 + 1.0;
    }
    vec4(s, 0.0, 0.0, 1.0)
}

fn checked(x: f32, step: i32) -> Option<f32> {
    let mut x = x;
    for k in 0..3 {
        if x > 6.0 - step as f32 {
            return None;
        }
        x = x * 1.25 + k as f32 * 0.5;
    }
    Some(x)
}

fn sum(x: f32, n: i32) -> Option<f32> {
    let mut s = x;
    let mut steps = 0;
    while steps < 4 {
        steps += 1;
        s = checked(s * 0.5, steps)? - 1.0;
        if steps == n {
            return Some(s + 100.0);
        }
    }
    Some(s)
}

/// `?` in a loop, of a function whose loop returns early.
pub fn question_marks(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut s = 0.0;
    for i in 0..3 {
        s = match sum(c.z + s + i as f32, n - i) {
            Some(x) => s * 0.5 + x,
            None => break,
        };
    }
    vec4(s, 0.0, 0.0, 1.0)
}

/// Counters that an exit sets to a constant, and that decide further loops.
pub fn exits_with_constants(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let (mut s, mut left) = (c.x, 3);
    'o: while left > 0 {
        left -= 1;
        let mut tries = 0;
        loop {
            tries += 1;
            if s > tries as f32 * 2.0 + n as f32 {
                left = 0;
                continue 'o;
            }
            if s < 0.5 {
                s += 0.125;
                continue 'o;
            }
            if tries == 3 {
                break;
            }
            s = s * 1.75 + 0.5;
        }
        s -= 1.0;
    }
    vec4(s, left as f32, 0.0, 1.0)
}

/// A loop with runtime bounds inside of an unrolled one, left for both.
pub fn runtime_inside(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let (mut s, mut k) = (c.x, 0);
    'o: for i in 0..3 {
        for j in 0..n {
            k += 1;
            s = s * 1.25 + j as f32;
            if s > 20.0 {
                s = 1.0;
                continue 'o;
            }
            if k + i == 9 {
                k = 40;
                break 'o;
            }
        }
        k += 2;
    }
    for _ in 0..2 {
        k += 1;
    }
    vec4(s, k as f32, 0.0, 1.0)
}

#[derive(Clone, Copy, PartialEq)]
enum Phase {
    Search,
    Refine(i32),
    Done,
}

/// A machine of states in a loop that ends early.
pub fn machine(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let (mut s, mut phase, mut steps) = (c.x, Phase::Search, 0);
    'o: loop {
        steps += 1;
        if steps > 6 {
            break;
        }
        phase = match phase {
            Phase::Search => {
                if s > n as f32 {
                    Phase::Refine(2)
                } else {
                    s = s * 1.5 + 0.75;
                    continue 'o;
                }
            }
            Phase::Refine(0) => Phase::Done,
            Phase::Refine(k) => {
                s -= 0.375;
                for i in 0..2 {
                    if s < i as f32 {
                        break 'o;
                    }
                }
                Phase::Refine(k - 1)
            }
            Phase::Done => break 'o,
        };
    }
    vec4(s, steps as f32, if phase == Phase::Done { 1.0 } else { 0.0 }, 1.0)
}

/// Labelled blocks in loops.
pub fn labelled_blocks(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut s = c.x;
    'o: for i in 0..4 {
        let k = 'b: {
            for j in 0..3 {
                if s > (j + n) as f32 {
                    break 'b j;
                }
                if s + c.w < -1.0 {
                    continue 'o;
                }
                s = s * 1.5 + 0.5;
            }
            7
        };
        s -= (k - i) as f32;
    }
    vec4(s, 0.0, 0.0, 1.0)
}

/// Arrays and structures that exits change.
pub fn arrays_at_exits(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut list = [c.x, 1.0, 2.0, 0.0];
    let mut at = (0, 3);
    'o: for i in 0..4 {
        let mut j = 0;
        loop {
            if j == 3 {
                break;
            }
            if list[j] > n as f32 {
                list[j] = 0.25;
                at = (i, 1);
                continue 'o;
            }
            if list[j] < -3.0 {
                at.1 = 2;
                break 'o;
            }
            list[j + 1] += list[j] * 0.5;
            j += 1;
        }
        list[0] += 1.5;
    }
    vec4(
        list[0] + list[1] * 4.0,
        list[2] + list[3] * 4.0,
        at.0 as f32,
        at.1 as f32,
    )
}

/// A variable that gets its value after an exit.
pub fn set_after_an_exit(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let c = color.load(pixel);
    let mut s = c.x;
    'o: for i in 0..3 {
        let x;
        let mut j = 0;
        loop {
            j += 1;
            if s > (n + j) as f32 {
                s -= 1.0;
                continue 'o;
            }
            if j == 2 {
                x = s + i as f32;
                break;
            }
        }
        s = x * 1.5 + 0.25;
    }
    vec4(s, 0.0, 0.0, 1.0)
}

/// A variable that gets its value in the last iteration.
pub fn set_in_a_loop(color: &Frame<Vec4>, n: i32, pixel: IVec2) -> Vec4 {
    let mut s = color.load(pixel).x;
    let found: (i32, f32);
    let mut i = 0;
    'o: loop {
        i += 1;
        for j in 0..3 {
            if i * 3 + j > n + pixel.x {
                found = (i, s - j as f32);
                break 'o;
            }
            s = s * 1.25 + 0.5;
        }
    }
    vec4(found.1, found.0 as f32, s, 1.0)
}
