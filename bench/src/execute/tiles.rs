//! Large images in tiles: memory for one tile and its surroundings, the same bits as in one go.

use super::{Bench, ExecuteError, Inputs};
use glam::{IVec2, UVec2, Vec4, uvec2};
use straightline_codegen::{Compiled, Stage};
use straightline_kernels::prelude::Frame;
use straightline_runtime::Region;

/// A rectangle of an image, and what a filter reads of it for that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// The rectangle's upper left pixel in the image.
    pub first: UVec2,
    /// Width and height of the rectangle.
    pub size: UVec2,
    /// Upper left pixel of the inputs: the rectangle's, less the apron where the image goes on.
    pub inputs_first: UVec2,
    /// Size of the inputs.
    pub inputs_size: UVec2,
}

/// The tiles of an image, row by row: `side` × `side` pixels or what is left, with `apron` pixels around them.
pub fn split_tiles(size: UVec2, side: u32, apron: u32) -> impl Iterator<Item = Tile> {
    let side = side.max(1);
    let rows = (0..size.y).step_by(side as usize);
    let corners = rows.flat_map(move |y| (0..size.x).step_by(side as usize).map(move |x| uvec2(x, y)));
    corners.map(move |first| {
        let end = (first + side).min(size);
        let inputs_first = first.saturating_sub(UVec2::splat(apron));
        Tile {
            first,
            size: end - first,
            inputs_first,
            inputs_size: (end + apron).min(size) - inputs_first,
        }
    })
}

/// Cuts a tile's inputs out of those of the whole image. An image that is a multiple of the frame's size, as a superresolution
/// buffer, is cut likewise, and a buffer of whole frames; those of another size are taken whole. `origin` tells kernels where
/// the tile lies.
pub fn crop_inputs(inputs: &Inputs, tile: &Tile) -> Inputs {
    let cut = |image: &Frame<Vec4>| {
        let scale = image.size() / inputs.size;
        if scale.min_element() == 0 || scale * inputs.size != image.size() {
            return image.clone();
        }
        let (first, size) = ((tile.inputs_first * scale).as_ivec2(), tile.inputs_size * scale);
        let pixels = (0..size.y as i32).flat_map(|y| (0..size.x as i32).map(move |x| IVec2::new(x, y)));
        Frame::new(size, pixels.map(|pixel| image.load(first + pixel)).collect())
    };
    let images = inputs.images.iter();
    let images = images.map(|(name, layers)| (name.clone(), layers.iter().map(cut).collect()));
    let cut = |elements: &Vec<[f64; 4]>| {
        let frame = inputs.size.element_product() as usize;
        if !elements.len().is_multiple_of(frame) {
            return elements.clone();
        }
        let [x, y] = tile.inputs_first.to_array().map(|n| n as usize);
        let [width, height] = tile.inputs_size.to_array().map(|n| n as usize);
        let rows = elements.chunks(inputs.size.x as usize).enumerate();
        let rows = rows.filter(|(k, _)| (y..y + height).contains(&(k % inputs.size.y as usize)));
        rows.flat_map(|(_, row)| &row[x..x + width]).copied().collect()
    };
    let buffers = inputs
        .buffers
        .iter()
        .map(|(name, elements)| (name.clone(), cut(elements)));
    let origin = tile.inputs_first.as_dvec2();
    Inputs {
        size: tile.inputs_size,
        images: images.collect(),
        buffers: buffers.collect(),
        ..inputs.clone()
    }
    .with_uniform("origin", &[origin.x, origin.y])
}

impl Bench {
    /// A kernel on an image of `size`, tile by tile: `inputs` gives what a tile reads, `output` gets its pixels. No more
    /// than one tile is on the device at a time. `apron` is how far from its pixel the kernel reads.
    ///
    /// # Errors
    ///
    /// If the kernel cannot be emitted, or a tile cannot be run; the first error of `inputs`.
    pub fn in_tiles(
        &self,
        (compiled, stage): (&Compiled, Stage),
        size: UVec2,
        (side, apron): (u32, u32),
        mut inputs: impl FnMut(&Tile) -> Result<Inputs, ExecuteError>,
        mut output: impl FnMut(&Tile, Frame<Vec4>),
    ) -> Result<(), ExecuteError> {
        let options = self.emit_options(stage).region(true);
        let (pass, manifest) = self.emit_pass(compiled, &options)?;
        for tile in split_tiles(size, side, apron) {
            let uploaded = self.upload(&manifest, &inputs(&tile)?)?;
            let target = self.create_target(tile.size, pass.target_format());
            let view = target.create_view(&wgpu::TextureViewDescriptor::default());
            let region = Region {
                first: (tile.first - tile.inputs_first).to_array(),
                size: tile.size.to_array(),
                place: [0, 0],
            };
            let mut encoder = self
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            uploaded.bind_region(&pass, &view, region)?.encode(&mut encoder);
            self.queue.submit([encoder.finish()]);
            output(&tile, self.download(&target)?);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_the_image_once() {
        for (size, side) in [
            (uvec2(1, 1), 1),
            (uvec2(7, 5), 3),
            (uvec2(16, 8), 8),
            (uvec2(3, 40), 64),
        ] {
            let mut seen = vec![0; (size.x * size.y) as usize];
            for tile in split_tiles(size, side, 1) {
                assert!(tile.inputs_first.cmple(tile.first).all());
                assert!((tile.inputs_first + tile.inputs_size).cmple(size).all());
                for y in 0..tile.size.y {
                    for x in 0..tile.size.x {
                        let at = tile.first + uvec2(x, y);
                        seen[(at.y * size.x + at.x) as usize] += 1;
                    }
                }
            }
            assert!(seen.iter().all(|count| *count == 1), "{size} {side}");
        }
    }
}
