//! Names that WGSL spells otherwise than the kernel.

use straightline_manifest::{LanguageBinding, LanguageKind, Manifest};

/// The names of a shader's text, by those of the kernel.
pub struct Spelling<'m>(Vec<&'m LanguageBinding>);

impl<'m> Spelling<'m> {
    /// The names that the WGSL of `manifest` has in place of the kernel's.
    pub fn of_wgsl(manifest: &'m Manifest) -> Self {
        let all = manifest.language_bindings.iter();
        Spelling(
            all.filter(|b| b.language == "wgsl" && b.location.is_none() && b.of.is_some())
                .collect(),
        )
    }

    /// Name of a binding or an output in the text.
    pub fn of_binding<'n>(&'n self, name: &'n str, binding: u32) -> &'n str {
        self.find_name(name, |bound| bound.binding == Some(binding))
    }

    /// Name of a member of the uniform struct in the text.
    pub fn of_member<'n>(&'n self, name: &'n str) -> &'n str {
        self.find_name(name, |bound| {
            bound.binding.is_none() && bound.kind != LanguageKind::Immediates
        })
    }

    /// Name of the immediates in the text.
    pub fn of_immediates<'n>(&'n self, name: &'n str) -> &'n str {
        self.find_name(name, |bound| bound.kind == LanguageKind::Immediates)
    }

    fn find_name<'n>(&'n self, name: &'n str, fits: impl Fn(&LanguageBinding) -> bool) -> &'n str {
        let mut all = self.0.iter();
        let found = all.find(|b| fits(b) && b.of.as_deref() == Some(name));
        found.map_or(name, |b| &b.name)
    }
}
