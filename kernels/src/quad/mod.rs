//! Filters whose work the four pixels of a quad share, after E. Penner, "Shader Amortization using Pixel Quad Message
//! Passing" (GPU Pro 2, 2011), with its slips mended; the notes on each say which.
//!
//! Each takes `pixel: Quad<IVec2>` and gives the colours of the four pixels. What each lane reads, and what it tells the
//! others, is the filter's own affair: see the notes.
//!
//! Each gives finite colours whatever it reads, and a lane with a bad input spoils no other; [`guards::Guards`] takes the tests out.

pub mod bilateral;
pub mod convolution;
mod coordinates;
pub mod guards;
pub mod pcf;
pub mod pcss;
pub mod ssao;
mod surface;
pub mod upsampling;
