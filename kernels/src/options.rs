//! `options!`: the choices of a kernel, declared once for rustc and for the generator.

/// Declares a kernel's options: a struct whose fields each have a default, and numbers a range.
///
/// Natively this is the struct and its `Default`. The generator reads the same text to learn each option's
/// name, meaning, values, range and default, so that a new option is one new line. A number whose default is
/// `uniform(x)` is left to run time, where it is x until it is set, unless a setting makes it known.
///
/// ```
/// # use straightline_kernels::prelude::uniform;
/// # #[derive(Clone, Copy, Debug, PartialEq, Eq)] pub enum Shape { Round, Square }
/// straightline_kernels::options! {
///     /// What a glow is made of.
///     pub struct Glow {
///         /// The shape of the halo.
///         pub shape: Shape = Shape::Round,
///         /// How far light spreads, in pixels.
///         pub radius: f32 [0.5..=32.0] = 4.0,
///         /// How much of it there is.
///         pub amount: f32 [0.0..=1.0] = uniform(0.5),
///     }
/// }
/// assert_eq!(Glow::default().radius, 4.0);
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
    };
}
