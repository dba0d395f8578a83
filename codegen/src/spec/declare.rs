//! The macro that turns the declaration of the knobs into types, builders and [`KNOBS`](super::KNOBS).

/// Declares the knobs of a shader, grouped by the half of the description that they belong to.
///
/// A declaration consists of the documentation, field, type, default, name as text with a placeholder for its value in
/// messages, the method that sets it, and an example of that method's arguments.
macro_rules! knobs {
    ($(
        $(#[$meta:meta])*
        $half:ident in $path:ident {
            $(
                $(#[doc = $doc:literal])+
                $field:ident: $ty:ty = $default:expr, $name:literal $([$value:literal])?,
                $builder:ident($($arg:ident: $arg_ty:ty),*) |$slot:ident| $set:expr,
                example ($($example:expr),*);
            )*
        }
    )*) => {
        $(
            $(#[$meta])*
            #[derive(Clone, Debug, PartialEq, Eq)]
            #[non_exhaustive]
            pub struct $half {
                $( $(#[doc = $doc])+ pub $field: $ty, )*
            }

            impl $half {
                /// Every knob at its default.
                pub fn new() -> Self {
                    $half { $( $field: $default, )* }
                }

                $(
                    $(#[doc = $doc])+
                    ///
                    /// ```
                    #[doc = concat!("# use straightline_codegen::{emit::*, *};")]
                    #[doc = concat!("# use std::time::Duration;")]
                    #[doc = concat!("let asked = ", stringify!($half), "::new().", stringify!($builder), "(", stringify!($($example),*), ");")]
                    #[doc = concat!("assert_ne!(asked, ", stringify!($half), "::new());")]
                    /// ```
                    pub fn $builder(mut self, $($arg: $arg_ty),*) -> Self {
                        let $slot = &mut self.$field;
                        $set;
                        self
                    }
                )*
            }

            impl Default for $half {
                fn default() -> Self {
                    Self::new()
                }
            }

            impl ShaderSpec {
                $(
                    #[doc = concat!("Sets [`", stringify!($half), "::", stringify!($field), "`].")]
                    ///
                    $(#[doc = $doc])+
                    pub fn $builder(mut self, $($arg: $arg_ty),*) -> Self {
                        self.$path = self.$path.$builder($($arg),*);
                        self
                    }
                )*
            }

            impl KernelConfig {
                $(
                    $(#[doc = $doc])+
                    ///
                    /// ```
                    #[doc = concat!("# use straightline_codegen::{emit::*, *};")]
                    #[doc = concat!("# use std::time::Duration;")]
                    #[doc = concat!("let shaders = Config::new().kernel(\"sraa\", |k| k.", stringify!($builder), "(", stringify!($($example),*), "));")]
                    /// ```
                    pub fn $builder(mut self, $($arg: $arg_ty),*) -> Self {
                        self.spec = self.spec.$builder($($arg),*);
                        self
                    }
                )*
            }
        )*

        /// Every knob, in the order of declaration: those of [`Settings`], then those of [`EmitOptions`].
        pub const KNOBS: &[Knob] = &[$($(
            Knob {
                name: $name,
                value: concat!("" $(, $value)?),
                doc: concat!($($doc, "\n"),+),
                part: Part::$half,
                arity: <$ty as KnobValue>::ARITY,
                read: |spec| spec.$path.$field.texts(),
                write: |spec, texts| {
                    spec.$path.$field = KnobValue::from_texts(texts)?;
                    Ok(())
                },
                example: |spec| spec.$builder($($example),*),
                call: concat!(".", stringify!($builder), "(", stringify!($($example),*), ")"),
            },
        )*)*];
    };
}

pub(super) use knobs;
