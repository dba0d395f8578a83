//! A shader with everything that is known of it before there is a device.

use crate::Error;
use crate::plan::Plan;
use std::borrow::Cow;
use straightline_manifest::text_hash;

/// An emitted shader: its text, with its plan. A [`Pass`](crate::Pass) or a [`Draw`](crate::Draw) is made of one.
///
/// In a crate with a build script it is the constant `SHADER` of the shader's module, and nothing is parsed when the program
/// starts: the generator has compared the text with the plan. A shader that travels is read by `Shader::from_manifest` (the
/// feature `manifest`). Both are the same afterwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Shader<'a> {
    pub(crate) plan: Plan,
    pub(crate) wgsl: &'a str,
    pub(crate) loops: Loops,
    /// [`text_hash`] of the text.
    pub(crate) hash: u64,
    #[cfg(feature = "manifest")]
    pub(crate) source_map: Option<std::sync::Arc<straightline_manifest::SourceMap>>,
}

impl Shader<'static> {
    /// A shader of constants, for generated code alone, which has checked them. Does not compile if `wgsl` is not the text with
    /// this hash.
    #[doc(hidden)]
    pub const fn generated(wgsl: &'static str, hash: u64, loops: Loops, plan: Plan) -> Self {
        assert!(
            text_hash(wgsl) == hash,
            "the WGSL was changed since its bindings were generated: generate both again"
        );
        Shader {
            plan,
            wgsl,
            loops,
            hash,
            #[cfg(feature = "manifest")]
            source_map: None,
        }
    }
}

impl Shader<'_> {
    /// The kernel's name.
    pub fn kernel(&self) -> &str {
        &self.plan.kernel
    }

    /// The text.
    pub fn wgsl(&self) -> &str {
        self.wgsl
    }

    /// Adds places in the kernel's source to an error, if the shader has a source map.
    pub(crate) fn locate(&self, error: Error) -> Error {
        #[cfg(feature = "manifest")]
        if let Some(map) = &self.source_map {
            return crate::source::locate_error(error, map);
        }
        error
    }
}

/// Result of the proof that the loops of a shader end.
#[derive(Clone, Debug, PartialEq)]
pub enum Loops {
    /// Each ends.
    End(LoopsEnd),
    /// At least one is not shown to end: how the first such loop differs from one that counts.
    Unproven(Cow<'static, str>),
}

/// Witness that each loop of a text ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LoopsEnd(());

impl LoopsEnd {
    /// The witness.
    ///
    /// # Safety
    ///
    /// Each loop of the text that the witness belongs to must end.
    #[allow(unsafe_code)]
    pub const unsafe fn new() -> Self {
        LoopsEnd(())
    }
}

/// States of the text beside it that each of its loops ends, for generated code alone: the generator has proved it. A macro, so
/// that crates which forbid `unsafe` can include what is generated.
#[doc(hidden)]
#[macro_export]
macro_rules! loops_end {
    () => {
        // SAFETY: the generator only writes this beside a text for which it has proved it.
        $crate::plan::Loops::End(unsafe { $crate::plan::LoopsEnd::new() })
    };
}
