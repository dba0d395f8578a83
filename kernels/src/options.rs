//! `options!`: the options of a kernel, declared once for rustc and for the generator.

use crate::{OptionText, kebab};
use std::fmt::Debug;

/// A kernel's options struct, declared by [`options!`](crate::options). A `build.rs` sets options from it.
pub trait KernelOptions: Default {
    /// Names and values of the options that differ from their defaults, in the generator's spelling.
    fn changed(&self) -> Vec<OptionText>;
}

/// Option name of a field: `search_threshold` becomes `search-threshold`.
#[doc(hidden)]
pub fn option_name(field: &str) -> String {
    field.trim_start_matches("r#").replace('_', "-")
}

/// Value of a field in the generator's spelling: an enum's variant in kebab case, an array's numbers separated by commas.
#[doc(hidden)]
pub fn option_text(value: &impl Debug) -> String {
    let text = format!("{value:?}");
    match text.strip_prefix('[').and_then(|text| text.strip_suffix(']')) {
        Some(numbers) => numbers.replace(' ', ""),
        None => kebab(&text),
    }
}

/// Declares a kernel's options: a struct whose fields each have a default, and, if numeric, a range.
///
/// Natively this is the struct and its `Default`. The generator reads the same text for each option's
/// name, description, values, range and default, so that a new option is one new line. A number whose default is
/// `uniform(x)` is set at run time, x unless the host changes it; a setting turns it into a compile-time constant.
///
/// ```
/// # use straightline_kernels::prelude::uniform;
/// # #[derive(Clone, Copy, Debug, PartialEq, Eq)] pub enum Shape { Round, Square }
/// straightline_kernels::options! {
///     /// Options of a glow.
///     pub struct Glow {
///         /// Shape of the halo.
///         pub shape: Shape = Shape::Round,
///         /// Radius of the halo, in pixels.
///         pub radius: f32 [0.5..=32.0] = 4.0,
///         /// Brightness of the halo.
///         pub amount: f32 [0.0..=1.0] = uniform(0.5),
///     }
/// }
/// assert_eq!(Glow::default().radius, 4.0);
///
/// use straightline_kernels::KernelOptions;
/// let wide = Glow { shape: Shape::Square, radius: 8.0, ..Glow::default() };
/// let set = wide.changed().into_iter().map(|(name, value)| format!("{name}={value}"));
/// assert_eq!(set.collect::<Vec<_>>(), ["shape=square", "radius=8.0"]);
/// ```
#[macro_export]
macro_rules! options {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $( $(#[$field_meta:meta])* pub $field:ident : $ty:ty $([$range:expr])? = $default:expr ),* $(,)?
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            $( $(#[$field_meta])* pub $field: $ty, )*
        }

        impl Default for $name {
            fn default() -> Self {
                $name { $( $field: $default, )* }
            }
        }

        impl $crate::KernelOptions for $name {
            fn changed(&self) -> Vec<$crate::OptionText> {
                let unset = Self::default();
                let mut changed = Vec::new();
                $(
                    if self.$field != unset.$field {
                        let value = $crate::option_text(&self.$field);
                        changed.push(($crate::option_name(stringify!($field)), value));
                    }
                )*
                changed
            }
        }
    };
}
