//! One kernel, computed in every way there is.

use super::Random;
use super::ast::Program;
use super::eval::{Invalid, Picture, evaluate};
use super::print::print;
use std::fmt;
use straightline_codegen::ir::interp::{Bindings, Image, Interpreter};
use straightline_codegen::{Branches, Compiled, Kernel, Settings, Unroll};

/// What may become of loops and branches; the first is what kernels are made for, and what it takes all must take.
pub const FORMS: &[Form] = &[
    Form(Unroll::Full, Branches::AsLoops),
    Form(Unroll::None, Branches::AsLoops),
    Form(Unroll::Partial(2), Branches::AsLoops),
    Form(Unroll::Partial(3), Branches::Select),
    Form(Unroll::Full, Branches::Keep),
];

/// What becomes of loops, and of branches on what is known at run time only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form(pub Unroll, pub Branches);

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "loops {}, branches {}", self.0, self.1)
    }
}

/// A kernel that is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// In which form.
    pub form: Form,
    /// The first error, without its place.
    pub message: String,
}

/// What went wrong with a kernel.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The generator refuses the kernel.
    Refused(Refusal),
    /// Two ways to compute a pixel differ.
    Differs {
        /// In which form the second value was computed.
        form: Form,
        /// The pixel.
        pixel: [u32; 2],
        /// The tree's value.
        expected: [f32; 4],
        /// The other value.
        found: [f32; 4],
    },
    /// The interpreter panicked.
    Panicked {
        /// On the graph of this form.
        form: Form,
        /// What it said.
        message: String,
    },
    /// The tree itself has no meaning: a mistake of this crate, or a step too far while a kernel is made smaller.
    Invalid(Invalid),
}

impl Failure {
    /// Whether it is of the same sort as another, as far as making kernels smaller is concerned.
    pub fn like(&self, other: &Failure) -> bool {
        match (self, other) {
            (Failure::Refused(a), Failure::Refused(b)) => a == b,
            (Failure::Differs { form: a, .. }, Failure::Differs { form: b, .. }) => a == b,
            (Failure::Panicked { form: a, .. }, Failure::Panicked { form: b, .. }) => a == b,
            (Failure::Invalid(a), Failure::Invalid(b)) => a == b,
            _ => false,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Refused(refusal) => write!(f, "refused with {}: {}", refusal.form, refusal.message),
            Failure::Differs {
                form,
                pixel,
                expected,
                found,
            } => write!(
                f,
                "pixel {pixel:?}: the tree gives {expected:?}, {form} gives {found:?}"
            ),
            Failure::Panicked { form, message } => write!(f, "interpreting {form} panicked: {message}"),
            Failure::Invalid(Invalid(why)) => write!(f, "the tree has no meaning: {why}"),
        }
    }
}

/// A small picture of all sorts of numbers.
pub fn picture(seed: u64) -> Picture {
    let mut random = Random(seed ^ 0x70_6963_7475_7265);
    let size = [5, 4];
    let mut number = || match random.below(8) {
        0 => 0.0,
        1 => -0.0,
        2 => random.between(-3, 3) as f32,
        3 => random.between(-5, 5) as f32 + 0.5,
        4 => random.between(-1000, 1000) as f32,
        _ => (random.below(1 << 20) as f32 / (1 << 19) as f32 - 1.0) * 2.0,
    };
    Picture {
        size,
        texels: (0..size[0] * size[1])
            .map(|_| [number(), number(), number(), number()])
            .collect(),
    }
}

/// Compiles a kernel's text in a form.
pub fn compile(text: &str, form: Form) -> Result<Compiled, Refusal> {
    let settings = Settings {
        unroll: form.0,
        branches: form.1,
        ..Default::default()
    };
    Kernel::from_text("random.rs", text, "k")
        .compile(&settings)
        .map_err(|errors| Refusal {
            form,
            message: errors.diagnostics[0].message.clone(),
        })
}

/// Every pixel of a compiled kernel.
pub fn interpret(compiled: &Compiled, picture: &Picture) -> Vec<[f32; 4]> {
    let image = Image::new(picture.size, vec![picture.texels.clone()]).expect("a whole picture");
    let bindings = Bindings::new().texture("a", &image);
    let interpreter = Interpreter::new(&compiled.graph, &compiled.schedule, picture.size, &bindings);
    let interpreter = interpreter.expect("the picture is bound");
    let mut scratch = interpreter.scratch();
    pixels(picture)
        .map(|[x, y]| interpreter.pixel(x, y, &mut scratch))
        .collect()
}

/// Coordinates of a picture's pixels.
pub fn pixels(picture: &Picture) -> impl Iterator<Item = [u32; 2]> + use<> {
    let [width, height] = picture.size;
    (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]))
}

/// Bit for bit, but any NaN equals any other.
pub fn same(a: [f32; 4], b: [f32; 4]) -> bool {
    a.iter()
        .zip(b)
        .all(|(x, y)| x.to_bits() == y.to_bits() || (x.is_nan() && y.is_nan()))
}

/// Compares the tree with every form.
pub fn check(program: &Program, picture: &Picture) -> Result<(), Failure> {
    let expected: Result<Vec<[f32; 4]>, Invalid> = pixels(picture)
        .map(|[x, y]| Ok(evaluate::<f32>(program, picture, [x as i32, y as i32])?.color))
        .collect();
    let expected = expected.map_err(Failure::Invalid)?;
    agrees(&print(program), picture, Some(&expected))
}

/// Compares a text's forms with each other, and with a tree's values if given.
pub fn agrees(text: &str, picture: &Picture, expected: Option<&[[f32; 4]]>) -> Result<(), Failure> {
    let mut expected = expected.map(<[_]>::to_vec);
    for form in FORMS {
        let compiled = compile(text, *form).map_err(Failure::Refused)?;
        let run = || interpret(&compiled, picture);
        let found = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run));
        let found = found.map_err(|panic| Failure::Panicked {
            form: *form,
            message: said(&*panic),
        })?;
        let expected = expected.get_or_insert_with(|| found.clone());
        for ((pixel, a), b) in pixels(picture).zip(expected.iter()).zip(&found) {
            if !same(*a, *b) {
                return Err(Failure::Differs {
                    form: *form,
                    pixel,
                    expected: *a,
                    found: *b,
                });
            }
        }
    }
    Ok(())
}

/// Whether an error is the generator's own: a broken rule, or a panic.
pub fn is_internal(message: &str) -> bool {
    message.starts_with("the stage `")
}

/// What a panic said.
fn said(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied())
        .unwrap_or("nothing")
        .to_owned()
}
