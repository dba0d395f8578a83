//! Runs GLSL of OpenGL and of OpenGL ES without a display, and returns the picture. Where there is no GPU, the driver is Mesa's
//! llvmpipe, in software.
//!
//! ```no_run
//! use straightline_tests::gl::{Context, Program, Texture};
//!
//! let text = "#version 330
//! uniform sampler2D color;
//! uniform float gain;
//! out vec4 result;
//! void main() {
//!     result = gain * texelFetch(color, ivec2(gl_FragCoord.xy), 0);
//! }";
//! let color = Texture::new("color", [2, 1], vec![[1.0; 4], [2.0; 4]]);
//! let program = Program::fragment(text, [2, 1]).texture(color).uniform("gain", 0.5);
//! assert_eq!(Context::desktop()?.run(&program)?, [[0.5; 4], [1.0; 4]]);
//! # Ok::<(), String>(())
//! ```

// The bindings of EGL and OpenGL are C functions, found by name when the library is loaded: each call is unsafe. What makes the
// calls sound is stated once for all of them: `Context` keeps its context current while it calls, is not sent to another thread,
// and only passes names that this context has made and slices whose lengths have been compared with the sizes stated.
#![allow(unsafe_code)]

mod context;
mod draw;
mod emitted;
mod link;
mod program;

pub use context::Context;
pub use emitted::{run as run_emitted, run_output};
pub use program::{Place, Program, Stage, Texture, Uniform, Varying};
