//! Kernels to compile in addition to those of `study loops`.

use crate::loops::{Input, Subject};
use straightline_codegen::Kernel;
use straightline_codegen::diagnostic::{Code, Diagnostic, Errors};

/// A kernel to compile.
#[derive(Clone, Debug)]
pub struct Asking {
    /// The kernel.
    pub subject: Subject,
    /// WGSL that Slang's compiler generates for the same work, unrolled; its entry point has the kernel's name.
    pub slang: Option<&'static str>,
}

impl From<Subject> for Asking {
    fn from(subject: Subject) -> Asking {
        Asking { subject, slang: None }
    }
}

/// Options of the work that is also written in Slang (`study/kernels/rivals/sraa.slang`), except its pattern.
const SAME_WORK: [(&str, &str); 6] = [
    ("shading", "sample0"),
    ("falloff", "none"),
    ("normals", "unorm"),
    ("normalisation", "paper"),
    ("non-finite", "spread"),
    ("guards", "none"),
];

/// Options beyond the paper: shading where geometry needs it, and a search for surfaces that no tap shows.
const RELATIVE: [(&str, &str); 2] = [("difference", "relative"), ("depth-scale", "3")];
const SEARCHED: (&str, &str) = ("search", "five");
const PLACED: (&str, &str) = ("shading", "placed");

/// Lines that compute the filter again, with all tests, and their replacement.
const AGAIN: [&str; 2] = [
    "                again::<TAPS, SIDE>(cfg, inputs)\n",
    "                vec4(color.x, color.y, color.z, 0.0)\n",
];

/// Returns SRAA without the second computation: only the path that nearly every pixel takes, with the test at its end. For
/// the whole kernel a compiler counts the other path too, because it cannot know that it is rare.
fn taken_path_kernel() -> Result<Kernel, Errors> {
    let changed = |what: &str| {
        Errors::from_diagnostic(Diagnostic::new(
            Code::Internal,
            format!("the source of `sraa` has changed: {what}"),
        ))
    };
    let entry = straightline_kernels::find("sraa").ok_or_else(|| changed("it is no kernel"))?;
    let found: usize = entry
        .sources
        .iter()
        .map(|source| source.text.matches(AGAIN[0]).count())
        .sum();
    let is_main = |source: &&straightline_kernels::SourceFile| source.text.contains("pub fn sraa(");
    let main = entry.sources.iter().find(is_main).filter(|_| found == 1);
    let main = main.ok_or_else(|| changed("it is not known where it filters again"))?;
    let text = main.text.replace(AGAIN[0], AGAIN[1]);
    let kernel = Kernel::from_text(main.path, &text, "sraa");
    let others = entry.sources.iter().filter(|source| source.path != main.path);
    Ok(others.fold(kernel, |kernel, source| kernel.with_text(source.path, source.text)))
}

/// Returns SRAA without tests, with the additions beyond the paper, and with the same work as its rival in Slang.
///
/// # Errors
///
/// If a kernel is invalid.
pub fn further_askings() -> Result<Vec<Asking>, Errors> {
    let of = |kernel: Kernel, name: &str, options: &[(&str, &str)], slang| -> Asking {
        Asking {
            subject: Subject {
                name: name.to_owned(),
                options: options
                    .iter()
                    .map(|(n, v)| ((*n).to_owned(), (*v).to_owned()))
                    .collect(),
                kernel,
                by_hand: Err("its loops are those of the default".to_owned()),
                input: Input::Roof,
                uniforms: Vec::new(),
            },
            slang,
        }
    };
    let asking = |name: &str, options: &[(&str, &str)], slang| -> Result<Asking, Errors> {
        Ok(of(Kernel::builtin("sraa")?, name, options, slang))
    };
    let relative = |more: &[(&'static str, &'static str)]| [&RELATIVE[..], more].concat();
    let same_work = |pattern| [&[("pattern", pattern)], &SAME_WORK[..]].concat();
    let (four, sixteen) = (
        include_str!("../../kernels/rivals/sraa4.slang.wgsl"),
        include_str!("../../kernels/rivals/sraa16.slang.wgsl"),
    );
    Ok(vec![
        asking("SRAA 4, no tests", &[("guards", "none")], None)?,
        asking("SRAA 16, no tests", &[("pattern", "latin16"), ("guards", "none")], None)?,
        asking("SRAA 4, fallback", &[("guards", "fallback")], None)?,
        of(
            taken_path_kernel()?,
            "SRAA 4, fallback, the path taken",
            &[("guards", "fallback")],
            None,
        ),
        of(
            taken_path_kernel()?,
            "SRAA 16, fallback, the path taken",
            &[("pattern", "latin16"), ("guards", "fallback")],
            None,
        ),
        asking("SRAA 4, relative depth", &RELATIVE, None)?,
        asking("SRAA 4, searched", &relative(&[SEARCHED]), None)?,
        asking("SRAA 4, placed and searched", &relative(&[PLACED, SEARCHED]), None)?,
        of(
            Kernel::builtin("sraa_place")?,
            "where SRAA 4 is shaded",
            &RELATIVE,
            None,
        ),
        asking("SRAA 4, as in Slang", &same_work("ordered4"), Some(four))?,
        asking("SRAA 16, as in Slang", &same_work("ordered16"), Some(sixteen))?,
    ])
}
