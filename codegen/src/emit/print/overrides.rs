//! Declarations of options that the host sets when it creates the pipeline.

use super::Language;
use crate::emit::resources::Resources;
use straightline_evaluator::ir::{Override, Scalar};

/// Parts of the declarations of overrides.
pub trait PrintOverrides: Language {
    /// The shader's bindings.
    fn bindings(&self) -> &Resources;

    /// The comment before the declarations; empty without overrides.
    fn override_comment(&self) -> String {
        let r = self.bindings();
        match r.overrides.is_empty() || r.options.strip_comments {
            true => String::new(),
            false => "// Options that the host sets when it creates the pipeline.\n".to_owned(),
        }
    }

    /// The default of an override, as a literal.
    fn override_default(&self, of: &Override) -> String {
        let kind = of.ty.scalar_kind().unwrap_or(Scalar::F32);
        self.scalar_literal(kind, false, of.default_bits()).code
    }

    /// The range of an override as a comment, if the kernel states one.
    fn range_comment(&self, of: &Override) -> String {
        let range = of.range.filter(|_| !self.bindings().options.strip_comments);
        range.map_or(String::new(), |[low, high]| format!(" // {low} to {high}"))
    }

    /// Constants whose values a host defines as macros before the text; `declared` writes one by type, name and value.
    fn override_macros(&self, declared: impl Fn(&str, &str, &str) -> String) -> String {
        let mut out = self.override_comment();
        for (_, bound) in &self.bindings().overrides {
            let (of, define) = (&bound.of, &bound.define);
            let (default, range) = (self.override_default(of), self.range_comment(of));
            let constant = declared(&self.type_spelling(of.ty.into()), &of.name, define);
            out += &format!("#ifndef {define}\n#define {define} {default}\n#endif\n{constant}{range}\n");
        }
        out
    }
}

/// Implements the trait for the printers of languages.
macro_rules! printers {
    ($($printer:ident),*) => {
        $(
            impl PrintOverrides for super::$printer<'_> {
                fn bindings(&self) -> &Resources {
                    self.resources
                }
            }
        )*
    };
}

printers!(Wgsl, Glsl, Hlsl);
