//! Rectangles of an image: a pass over a part of it, so that a large one is filtered in tiles.

use crate::Error;
use crate::uniforms::filled_buffer;
use std::fmt;

/// A rectangle of pixels that a pass filters: where it lies in the inputs, and where it goes in the target.
///
/// The inputs may be a tile of a larger image. A filter then sees what it would see of the whole if the tile has the
/// pixels around the rectangle that the filter reads too: for SRAA, one more on each side where the image goes on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Region {
    /// The upper left pixel in the inputs; the lower left one for a shader whose rows count from below.
    pub first: [u32; 2],
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The upper left pixel in the target; the lower left one for a shader whose rows count from below.
    pub place: [u32; 2],
}

impl Region {
    /// Returns a region that has the same rectangle in inputs and target.
    pub fn at(first: [u32; 2], size: [u32; 2]) -> Self {
        Region {
            first,
            size,
            place: first,
        }
    }

    /// Rejects an empty rectangle, and one that leaves the inputs or the target.
    pub(crate) fn check(self, kernel: &str, inputs: Option<[u32; 2]>, target: [u32; 2]) -> Result<(), Error> {
        let refuse = |problem: String| {
            Err(Error::Region {
                kernel: kernel.to_owned(),
                region: self,
                problem,
            })
        };
        if self.size.contains(&0) {
            return refuse("it has no pixels: leave the call out".to_owned());
        }
        let beyond = |from: [u32; 2], whole: [u32; 2]| {
            (0..2).any(|axis| u64::from(from[axis]) + u64::from(self.size[axis]) > u64::from(whole[axis]))
        };
        if let Some([width, height]) = inputs.filter(|size| beyond(self.first, *size)) {
            return refuse(format!(
                "it leaves the inputs, which are {width}x{height}: make it smaller"
            ));
        }
        if beyond(self.place, target) {
            let [width, height] = target;
            return refuse(format!(
                "it leaves the target, which is {width}x{height}: make it smaller"
            ));
        }
        Ok(())
    }

    /// A buffer as the shader reads it. Each bound region has its own: all encoders of one submission would see the last
    /// value of a shared one.
    pub(crate) fn create_buffer(self, device: &wgpu::Device, kernel: &str) -> Result<wgpu::Buffer, Error> {
        let refused = |description| Error::Region {
            kernel: kernel.to_owned(),
            region: self,
            problem: description,
        };
        let mut bytes = [0u8; straightline_manifest::REGION_SIZE as usize];
        let lanes = [self.first, self.size, self.place].concat();
        for (place, lane) in bytes.chunks_exact_mut(4).zip(lanes) {
            place.copy_from_slice(&lane.to_le_bytes());
        }
        filled_buffer(device, kernel, straightline_manifest::REGION, &bytes, refused)
    }
}

impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([x, y], [width, height], [to_x, to_y]) = (self.first, self.size, self.place);
        write!(f, "{width}x{height} at ({x}, {y}) to ({to_x}, {to_y})")
    }
}
