//! `break`, `continue`, `return` and `?` under runtime conditions, out of loops that stay in the shader and loops that are
//! unrolled: every form computes what rustc's own code does, and no form multiplies the work of compiling.

#[path = "departures/kernels.rs"]
#[allow(
    clippy::needless_range_loop,
    clippy::explicit_counter_loop,
    clippy::needless_late_init
)] // kernels as people write them
mod kernels;

use glam::{IVec2, Vec4, ivec2, uvec2};
use straightline_bench::execute::{Inputs, interpret_kernel};
use straightline_codegen::{Branches, Compiled, EmitOptions, Kernel, Settings, Unroll};
use straightline_kernels::prelude::Frame;

type Native = fn(&Frame<Vec4>, i32, IVec2) -> Vec4;

const TEXT: &str = include_str!("departures/kernels.rs");

const KERNELS: &[(&str, Native)] = &[
    ("continues_outer", kernels::continues_outer),
    ("continues_counting", kernels::continues_counting),
    ("three_deep", kernels::three_deep),
    ("breaks_labelled", kernels::breaks_labelled),
    ("continues_in_arms", kernels::continues_in_arms),
    ("returns_from_calls", kernels::returns_from_calls),
    ("question_marks", kernels::question_marks),
    ("exits_with_constants", kernels::exits_with_constants),
    ("runtime_inside", kernels::runtime_inside),
    ("machine", kernels::machine),
    ("labelled_blocks", kernels::labelled_blocks),
    ("arrays_at_exits", kernels::arrays_at_exits),
    ("set_after_an_exit", kernels::set_after_an_exit),
    ("set_in_a_loop", kernels::set_in_a_loop),
];

const UNROLLS: [Unroll; 4] = [Unroll::Full, Unroll::None, Unroll::Partial(2), Unroll::Partial(4)];
const BRANCHES: [Branches; 3] = [Branches::Keep, Branches::Select, Branches::AsLoops];

/// Work that compiling one of the kernels may take: a form that evaluates the rest once for each exit takes a hundred times
/// as much.
const MOST_WORK: u64 = 60_000;

fn forms() -> impl Iterator<Item = (Unroll, Branches)> {
    UNROLLS
        .into_iter()
        .flat_map(|unroll| BRANCHES.map(|branches| (unroll, branches)))
}

fn compiled(name: &str, (unroll, branches): (Unroll, Branches)) -> Compiled {
    let settings = Settings::new().unroll(unroll).branches(branches);
    let compiled = Kernel::from_text("departures.rs", TEXT, name).compile(&settings);
    compiled.unwrap_or_else(|e| panic!("{name}, loops {unroll}, branches {branches}:\n{e}"))
}

fn frame() -> Frame<Vec4> {
    let texel = |k: u32| Vec4::new((k * 7 % 12) as f32 * 0.5, 1.5 - k as f32 * 0.25, k as f32, 0.75);
    Frame::new(uvec2(4, 3), (0..12).map(texel).collect())
}

fn inputs(n: i32) -> Inputs {
    let mut inputs = Inputs::new(uvec2(4, 3));
    inputs.images = vec![("color".to_owned(), vec![frame()])];
    inputs.uniforms = vec![("n".to_owned(), vec![f64::from(n)])];
    inputs
}

#[test]
fn every_form_computes_what_rust_does() {
    let frame = frame();
    for (name, native) in KERNELS {
        for form in forms() {
            let compiled = compiled(name, form);
            for n in [0, 1, 3, 4, 7] {
                let found = interpret_kernel::<f32>(&compiled, &inputs(n), false)
                    .unwrap_or_else(|e| panic!("{name} {form:?}: {e}"));
                for (k, found) in (0..).zip(&found.texels) {
                    let pixel = ivec2(k % 4, k / 4);
                    let expected = native(&frame, n, pixel).to_array();
                    assert_eq!(expected, *found, "{name} {form:?}, n = {n}, pixel {pixel}");
                }
            }
        }
    }
}

#[test]
fn no_form_multiplies_the_work() {
    let mut worst = Vec::new();
    for (name, _) in KERNELS {
        for (unroll, branches) in forms() {
            let compiled = compiled(name, (unroll, branches));
            worst.push((compiled.work, format!("{name}, loops {unroll}, branches {branches}")));
            compiled
                .emit(&EmitOptions::new())
                .unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
    worst.sort();
    let (work, which) = worst.last().expect("there are kernels");
    assert!(
        *work <= MOST_WORK,
        "{which} takes the work of {work}, most take {}",
        worst[worst.len() / 2].0
    );
}

/// Copies and operations are those of a loop's final form, not of abandoned attempts.
#[test]
fn reports_leave_abandoned_attempts_out() {
    let counted = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut s = color.load(pixel).x;
    let mut i = 0;
    while i < 50 { s = s * 1.5 + 1.0; i += 1; }
    Vec4::splat(s)
}
";
    let guessed = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut s = color.load(pixel).x;
    let mut i = 0;
    loop { i += 1; s = s * 1.5 + i as f32; if s > 1000.0 { break; } }
    Vec4::splat(s)
}
";
    for (text, unroll) in [
        (counted, Unroll::None),
        (guessed, Unroll::Full),
        (guessed, Unroll::None),
    ] {
        let settings = Settings::new().unroll(unroll);
        let compiled = Kernel::from_text("k.rs", text, "k")
            .compile(&settings)
            .unwrap_or_else(|e| panic!("{e}"));
        let [report] = compiled.loops.as_slice() else {
            panic!("one loop: {:?}", compiled.loops);
        };
        assert_eq!((report.unroll, report.copies), (Unroll::None, 1), "{text}");
        assert!(report.operations < 30, "{} operations in\n{text}", report.operations);
    }
}
