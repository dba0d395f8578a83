//! The pictures of the SRAA paper, reproduced with the built-in scenes.

use super::filters::Filters;
use super::methods::{Method, list_methods};
use super::shot::{Shot, render_supersampled};
use super::{QualityError, SIDE, check_stopped};
use crate::builtin::load_builtin;
use crate::progress::Progress;
use glam::{UVec2, Vec2, Vec4};
use straightline_bench::execute::Bench;
use straightline_kernels::prelude::Frame;
use straightline_oracle::metrics::psnr;
use straightline_scene::capture::Capture;
use straightline_scene::gbuffer;
use straightline_scene::picture;
use straightline_scene::render::GpuRenderer;
use straightline_scene::scene::{SKY_DEPTH, Scene};

/// A picture of the paper.
#[derive(Clone, Copy, Debug)]
pub struct Figure {
    /// Name of its file, without extension: the number of the original.
    pub name: &'static str,
    /// Subject of the paper's figure.
    pub shows: &'static str,
    /// The built-in scene that is drawn.
    pub scene: &'static str,
    /// Parts side by side. The last is a reference of 256 samples a pixel, except with [`Pane::Interleaved`].
    pub panes: &'static [Pane],
}

/// A part of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pane {
    /// The picture of a method, by its name in `study error`.
    Method(&'static str),
    /// Inputs of SRAA, in one large texture: distances (near is bright) and normals.
    Interleaved,
}

use Pane::{Interleaved, Method as Of};

/// All figures; the others of the paper are drawings and charts.
pub const FIGURES: &[Figure] = &[
    Figure {
        name: "sraa-01",
        shows: "1x, SRAA and 16x",
        scene: "roof",
        panes: &[Of("1x"), Of("SRAA 16"), Of("16x")],
    },
    Figure {
        name: "sraa-02",
        shows: "MLAA blurs edges too far; SRAA cannot reconstruct what no sample sees",
        scene: "roof",
        panes: &[Of("1x"), Of("MLAA"), Of("SRAA 4"), Of("SRAA 4 and MLAA")],
    },
    Figure {
        name: "sraa-04",
        shows: "distance by normals, by depth and by both",
        scene: "creases",
        panes: &[Of("1x"), Of("SRAA 4, normals"), Of("SRAA 4, depth"), Of("SRAA 4")],
    },
    Figure {
        name: "sraa-05",
        shows: "distance by depth, and by planes",
        scene: "grooves",
        panes: &[
            Of("1x"),
            Of("SRAA 4, depth"),
            Of("SRAA 4"),
            Of("SRAA 4, planes and normals"),
        ],
    },
    Figure {
        name: "sraa-06",
        shows: "four G-buffers interleaved to one",
        scene: "roof",
        panes: &[Interleaved],
    },
    Figure {
        name: "sraa-07",
        shows: "much geometry, little shading",
        scene: "tubes",
        panes: &[Of("1x"), Of("SRAA 4"), Of("SRAA 16"), Of("16x")],
    },
    Figure {
        name: "sraa-08",
        shows: "where shading changes within a surface, the picture is that of 1x",
        scene: "sparkle",
        panes: &[Of("1x"), Of("SRAA 4"), Of("SRAA 16"), Of("16x")],
    },
    Figure {
        name: "sraa-09",
        shows: "fences by alpha test, and no blur in textures",
        scene: "railings",
        panes: &[Of("1x"), Of("SRAA 4"), Of("SRAA 16"), Of("16x")],
    },
    Figure {
        name: "sraa-10",
        shows: "what is thinner than a pixel: MLAA loses it",
        scene: "wires",
        panes: &[Of("1x"), Of("MLAA"), Of("SRAA 4"), Of("SRAA 16")],
    },
    Figure {
        name: "sraa-11",
        shows: "more geometry samples come nearer to supersampling",
        scene: "roof",
        panes: &[Of("SRAA 4"), Of("SRAA 8, standard"), Of("SRAA 16"), Of("16x")],
    },
];

/// Width and height of the detail, in texels.
const DETAIL: u32 = 64;

/// Factor of enlargement.
const ZOOM: u32 = 5;

/// Result of drawing a figure.
#[derive(Clone, Debug)]
pub struct Made {
    /// The panes side by side under their names.
    pub picture: Frame<Vec4>,
    /// Name of each method, and the PSNR of its whole picture against the reference, in dB.
    pub psnr: Vec<(String, f64)>,
}

impl Figure {
    /// Draws the figure's scene at `size`, and shows the detail where 1x has the largest error.
    ///
    /// # Errors
    ///
    /// [`QualityError`], if something cannot be drawn or run, or `progress` requests a stop.
    pub fn render_panes(&self, bench: &Bench, size: UVec2, progress: &mut dyn Progress) -> Result<Made, QualityError> {
        let listed = self.pane_methods();
        progress.begin(self.name, listed.len() + SIDE as usize);
        let scene = Scene::from_name(self.scene).map_err(|error| QualityError::Capture(error.to_string()))?;
        let renderer = GpuRenderer::new(bench.device(), bench.queue(), &scene, size)?;
        let shot = Shot::draw(&renderer, &listed.iter().collect::<Vec<_>>(), progress)?;
        let reference = render_supersampled(&renderer, SIDE, Vec2::ZERO, progress)?;
        let reference = picture::at_eight_bits(&reference);
        let plain = picture::at_eight_bits(&shot.any_capture()?.color);
        let corner = picture::find_busiest_square(&plain, &reference, DETAIL);
        if self.panes.contains(&Interleaved) {
            let picture = interleave_samples(shot.any_capture()?, corner)?;
            return Ok(Made {
                picture,
                psnr: Vec::new(),
            });
        }
        let mut filters = Filters::new(bench, &listed, size, progress)?;
        let mut pictures = Vec::new();
        for (k, method) in listed.iter().enumerate() {
            check_stopped(progress)?;
            pictures.push((
                method.name.as_str(),
                picture::at_eight_bits(&filters.filter_shot(k, &shot)?),
            ));
        }
        let psnr = pictures
            .iter()
            .map(|(name, frame)| ((*name).to_owned(), psnr(frame, &reference)));
        let psnr = psnr.collect();
        pictures.push(("256x", reference));
        let panes: Vec<(&str, &Frame<Vec4>)> = pictures.iter().map(|(name, frame)| (*name, frame)).collect();
        Ok(Made {
            picture: picture::compare_details(&panes, corner, DETAIL, ZOOM),
            psnr,
        })
    }

    /// Returns the methods of the panes, in order; panes of geometry need a capture too.
    fn pane_methods(&self) -> Vec<Method> {
        let all = list_methods(false);
        let named = |pane: &Pane| {
            let name = match pane {
                Of(name) => *name,
                Interleaved => "SRAA 4",
            };
            all.iter().find(|method| method.name == name).cloned()
        };
        self.panes.iter().filter_map(named).collect()
    }
}

/// Returns the detail, with 2x2 texels for each pixel.
fn interleave_samples(capture: &Capture, corner: UVec2) -> Result<Frame<Vec4>, QualityError> {
    let options = load_builtin("sraa")?.option_values(&[("layout".to_owned(), "superresolution".to_owned())])?;
    let inputs = gbuffer::sraa_inputs(capture, &options)?;
    let grid = |name: &str, shown: &dyn Fn(Vec4) -> Vec4| {
        let found = inputs.images.iter().find(|(known, _)| known == name);
        let layers = found.map(|(_, layers)| layers);
        let grid = layers.and_then(|layers| layers.first());
        let grid = grid.ok_or_else(|| QualityError::NotDrawn(name.to_owned()))?;
        let shown: Vec<Vec4> = grid.texels().iter().map(|texel| shown(*texel)).collect();
        Ok::<_, QualityError>(Frame::new(grid.size(), shown))
    };
    let depths = capture.depth.layers().iter().flat_map(|layer| layer.texels());
    let (nearest, farthest) = depths
        .filter(|depth| **depth < SKY_DEPTH)
        .fold((f32::MAX, f32::MIN), |(low, high), depth| {
            (low.min(*depth), high.max(*depth))
        });
    // On a logarithmic scale, or near surfaces would take all the shades.
    let near = |texel: Vec4| {
        let share = (farthest / texel.x.clamp(nearest, farthest)).ln() / (farthest / nearest).ln();
        Vec4::splat(share.powf(2.2)).with_w(1.0)
    };
    let facing = |texel: Vec4| (0.5 + 0.5 * texel).powf(2.2).with_w(1.0);
    let (depth, normal) = (grid("depth_grid", &near)?, grid("normal_grid", &facing)?);
    let panes = [("depth", &depth), ("normal", &normal)];
    Ok(picture::compare_details(&panes, corner * 2, 2 * DETAIL, ZOOM))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_pane_is_there() {
        let names: BTreeSet<&str> = FIGURES.iter().map(|figure| figure.name).collect();
        assert_eq!(names.len(), FIGURES.len());
        for figure in FIGURES {
            assert_eq!(figure.pane_methods().len(), figure.panes.len(), "{}", figure.name);
            assert!(Scene::from_name(figure.scene).is_ok(), "{}", figure.name);
        }
    }
}
