//! What compilers are asked about beside the kernels of `study loops`.

use crate::loops::{Input, Subject};
use straightline_codegen::Kernel;
use straightline_codegen::diagnostic::Errors;

/// A kernel that compilers are asked about.
#[derive(Clone, Debug)]
pub struct Asking {
    /// The kernel.
    pub subject: Subject,
    /// The WGSL that Slang's compiler makes of the same work, unrolled; its entry point has the kernel's name.
    pub slang: Option<&'static str>,
}

impl From<Subject> for Asking {
    fn from(subject: Subject) -> Asking {
        Asking { subject, slang: None }
    }
}

/// The work that was written in Slang too (`study/kernels/rivals/sraa.slang`), but for its pattern.
const SAME_WORK: [(&str, &str); 6] = [
    ("shading", "sample0"),
    ("falloff", "none"),
    ("normals", "unorm"),
    ("normalisation", "paper"),
    ("non-finite", "spread"),
    ("guards", "none"),
];

/// What goes beyond the paper: shading where geometry asks for it, and a search for what no tap shows.
const RELATIVE: [(&str, &str); 2] = [("difference", "relative"), ("depth-scale", "3")];
const SEARCHED: (&str, &str) = ("search", "five");
const PLACED: (&str, &str) = ("shading", "placed");

/// SRAA without tests, with what goes beyond the paper, and with as much work as its rival by Slang.
///
/// # Errors
///
/// The kernel is none.
pub fn further() -> Result<Vec<Asking>, Errors> {
    let of = |kernel: &str, name: &str, options: &[(&str, &str)], slang| -> Result<Asking, Errors> {
        Ok(Asking {
            subject: Subject {
                name: name.to_owned(),
                options: options
                    .iter()
                    .map(|(n, v)| ((*n).to_owned(), (*v).to_owned()))
                    .collect(),
                kernel: Kernel::builtin(kernel)?,
                by_hand: Err("its loops are those of the default".to_owned()),
                input: Input::Roof,
            },
            slang,
        })
    };
    let asking = |name: &str, options: &[(&str, &str)], slang| of("sraa", name, options, slang);
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
        asking("SRAA 4, relative depth", &RELATIVE, None)?,
        asking("SRAA 4, searched", &relative(&[SEARCHED]), None)?,
        asking("SRAA 4, placed and searched", &relative(&[PLACED, SEARCHED]), None)?,
        of("sraa_place", "where SRAA 4 is shaded", &RELATIVE, None)?,
        asking("SRAA 4, as in Slang", &same_work("ordered4"), Some(four))?,
        asking("SRAA 16, as in Slang", &same_work("ordered16"), Some(sixteen))?,
    ])
}
