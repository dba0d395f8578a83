//! Filters that share their work over the four pixels of a quad, based on E. Penner, "Shader Amortization using Pixel Quad
//! Message Passing" (GPU Pro 2, 2011), with its errors corrected. The documentation of each filter lists the corrections.
//!
//! Each takes `pixel: Quad<IVec2>` and returns the colours of the four pixels. The reads of each lane and the messages between
//! lanes depend on the filter; see its documentation.
//!
//! Each returns finite colours for every input. A bad input in one lane affects no other. [`guards::Guards`] omits the tests.

pub mod bilateral;
pub mod convolution;
mod coordinates;
pub mod guards;
pub mod pcf;
pub mod pcss;
pub mod ssao;
mod surface;
pub mod upsampling;
