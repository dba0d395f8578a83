//! Pictures within the page: each once, as the background of a class, so that sliders and details can share it.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::{UVec2, Vec4, uvec2};
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;
use straightline_kernels::prelude::Frame;
use straightline_scene::picture::{self, PictureError};

/// Largest part of a picture that is shown: a page with eleven scenes has to be loaded by a browser.
const WINDOW: UVec2 = UVec2::new(480, 270);

/// Part that is shown enlarged.
const DETAIL: UVec2 = UVec2::new(36, 24);

/// Number of details of each picture.
const DETAILS: usize = 3;

/// All pictures of a page.
#[derive(Debug, Default)]
pub(super) struct Pictures {
    css: String,
    count: usize,
}

/// A picture that the page shows.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Shown {
    /// Name of the method.
    name: String,
    /// Class that has it as its background.
    class: String,
}

/// Pictures of one scene, all of the same part.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Compared {
    size: [u32; 2],
    /// Upper left corners of the details, from the part's own.
    details: Vec<[u32; 2]>,
    detail: [u32; 2],
    /// Each with the parts of a second.
    pictures: Vec<Shown>,
}

impl Pictures {
    /// Rules of a style sheet.
    pub(super) fn css(&self) -> &str {
        &self.css
    }

    /// Shows the part of the pictures in which `first` is most wrong: `files` are names with paths from `folder`.
    pub(super) fn compare_worst_part(
        &mut self,
        folder: &Path,
        reference: &str,
        files: &[(&str, &str)],
    ) -> Result<Option<Compared>, PictureError> {
        let mut frames = Vec::new();
        for (name, file) in files.iter().copied().chain([("256× reference", reference)]) {
            frames.push((name, picture::read_picture(&folder.join(file))?));
        }
        let (Some((_, first)), Some((_, best))) = (frames.first(), frames.last()) else {
            return Ok(None);
        };
        if frames.iter().any(|(_, frame)| frame.size() != best.size()) {
            return Ok(None);
        }
        let size = best.size().min(WINDOW);
        let wrong = Wrong::from_frames(first, best);
        let corner = wrong
            .worst_corner(size, UVec2::ZERO, best.size(), &[])
            .unwrap_or_default();
        let mut details: Vec<UVec2> = Vec::new();
        for _ in 0..DETAILS {
            details.extend(wrong.worst_corner(DETAIL, corner, corner + size, &details));
        }
        let pictures: Result<Vec<Shown>, PictureError> = frames
            .iter()
            .map(|(name, frame)| self.embed_picture(name, &crop_frame(frame, corner, size)))
            .collect();
        Ok(Some(Compared {
            size: size.to_array(),
            details: details.iter().map(|d| (*d - corner).to_array()).collect(),
            detail: DETAIL.to_array(),
            pictures: pictures?,
        }))
    }

    fn embed_picture(&mut self, name: &str, frame: &Frame<Vec4>) -> Result<Shown, PictureError> {
        let class = format!("picture{}", self.count);
        self.count += 1;
        let png = STANDARD.encode(picture::png_bytes(frame)?);
        let _ = writeln!(
            self.css,
            ".{class}{{background-image:url(data:image/png;base64,{png})}}"
        );
        Ok(Shown {
            name: name.to_owned(),
            class,
        })
    }
}

/// Summed squared errors, so that those of any rectangle are four reads.
struct Wrong {
    size: UVec2,
    sums: Vec<f64>,
}

impl Wrong {
    fn from_frames(test: &Frame<Vec4>, reference: &Frame<Vec4>) -> Wrong {
        let size = reference.size();
        let stride = size.x as usize + 1;
        let mut sums = vec![0.0; stride * (size.y as usize + 1)];
        for (index, (a, b)) in test.texels().iter().zip(reference.texels()).enumerate() {
            let (x, y) = (index % size.x as usize, index / size.x as usize);
            let off = f64::from((*a - *b).truncate().length_squared());
            let at = |x: usize, y: usize| y * stride + x;
            sums[at(x + 1, y + 1)] = off + sums[at(x, y + 1)] + sums[at(x + 1, y)] - sums[at(x, y)];
        }
        Wrong { size, sums }
    }

    fn sum(&self, from: UVec2, to: UVec2) -> f64 {
        let at = |x: u32, y: u32| self.sums[y as usize * (self.size.x as usize + 1) + x as usize];
        at(to.x, to.y) + at(from.x, from.y) - at(to.x, from.y) - at(from.x, to.y)
    }

    /// The rectangle of `size` between `from` and `to` with the largest error that does not touch those `taken`.
    fn worst_corner(&self, size: UVec2, from: UVec2, to: UVec2, taken: &[UVec2]) -> Option<UVec2> {
        let last = to.checked_sub(size)?;
        let step = 4;
        let mut worst = None;
        for y in (from.y..=last.y).step_by(step) {
            for x in (from.x..=last.x).step_by(step) {
                let corner = uvec2(x, y);
                let apart = |other: &UVec2| {
                    (corner.as_ivec2() - other.as_ivec2())
                        .abs()
                        .cmpge(size.as_ivec2())
                        .any()
                };
                let sum = self.sum(corner, corner + size);
                if taken.iter().all(apart) && worst.is_none_or(|(most, _)| sum > most) {
                    worst = Some((sum, corner));
                }
            }
        }
        worst.map(|(_, corner)| corner)
    }
}

fn crop_frame(frame: &Frame<Vec4>, corner: UVec2, size: UVec2) -> Frame<Vec4> {
    let width = frame.size().x as usize;
    let rows = (corner.y..corner.y + size.y).flat_map(|y| {
        let start = y as usize * width + corner.x as usize;
        frame.texels()[start..start + size.x as usize].iter().copied()
    });
    Frame::new(size, rows.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_part_is_found() {
        let size = uvec2(64, 32);
        let flat = Frame::new(size, vec![Vec4::ZERO; 64 * 32]);
        let mut texels = flat.texels().to_vec();
        texels[20 * 64 + 41] = Vec4::ONE;
        texels[4 * 64 + 5] = Vec4::splat(0.5);
        let wrong = Wrong::from_frames(&Frame::new(size, texels), &flat);
        let part = uvec2(8, 8);
        let worst = wrong.worst_corner(part, UVec2::ZERO, size, &[]).unwrap();
        assert!((worst.x..worst.x + 8).contains(&41) && (worst.y..worst.y + 8).contains(&20));
        let second = wrong.worst_corner(part, UVec2::ZERO, size, &[worst]).unwrap();
        assert!((second.x..second.x + 8).contains(&5) && (second.y..second.y + 8).contains(&4));
        assert_eq!(wrong.worst_corner(uvec2(65, 8), UVec2::ZERO, size, &[]), None);
    }
}
