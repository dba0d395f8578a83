//! Subject of tuning: one view of a scene, sampled in several ways, and its reference.

use super::TuneError;
use crate::progress::Progress;
use glam::{UVec2, Vec2, Vec4};
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_scene::capture::{Capture, ShadingSample};
use straightline_scene::gbuffer;
use straightline_scene::render::{self, Placed, PlacedBy, Renderer};

/// Patterns that a scene is sampled in, the most samples first.
pub const PATTERNS: [&str; 3] = ["latin16", "standard8", "latin4"];

/// Side of the grid of samples that a scene's reference is the mean of: 256 a pixel.
const REFERENCE_SIDE: u32 = 16;

/// Parts of a scene that are drawn for variants beyond the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Beyond {
    /// Shading where the kernel `sraa_place` says.
    pub placing: bool,
    /// Albedo and visibility at every sample, the direct light, and what does not follow the albedo.
    pub light: bool,
}

impl Beyond {
    /// Everything.
    pub const ALL: Beyond = Beyond {
        placing: true,
        light: true,
    };
    /// Nothing.
    pub const NONE: Beyond = Beyond {
        placing: false,
        light: false,
    };
}

/// A view, in as many captures as it has sets of geometry samples, the largest set first.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The scene's name, or the capture's path.
    pub name: String,
    /// Captures of one view with the same colours; at least one.
    pub captures: Vec<Capture>,
    /// The shading of each capture where geometry asks for it, or none of any.
    pub placed: Vec<Placed>,
    /// Result of a perfect filter.
    pub reference: Option<Frame<Vec4>>,
    /// Description of the reference.
    pub referred_to: String,
}

impl Subject {
    /// A scene, sampled in `patterns` and shaded at the pixels' centres, with its 256× reference, and what `beyond` asks for. `None` if
    /// the progress stops it before all is drawn.
    ///
    /// # Errors
    ///
    /// What the renderer refuses.
    pub fn of_scene(
        name: &str,
        renderer: &dyn Renderer,
        patterns: &[&str],
        beyond: Beyond,
        progress: &mut dyn Progress,
    ) -> Result<Option<Subject>, TuneError> {
        let (mut captures, mut placed) = (Vec::new(), Vec::new());
        progress.begin("geometry", patterns.len());
        for pattern in patterns {
            let samples = gbuffer::pattern_offsets(pattern).unwrap_or_default();
            let mut capture = render::capture_scene(renderer, &samples, ShadingSample::Centre)?;
            if beyond.light {
                render::add_albedo(&mut capture, renderer)?;
            }
            if beyond.placing {
                placed.extend(render::shade_placed(&capture, renderer, PlacedBy::Planes)?);
            }
            captures.push(capture);
            progress.step();
            if progress.is_stopped() {
                return Ok(None);
            }
        }
        progress.begin("reference", REFERENCE_SIDE as usize);
        let reference = render::render_reference(renderer, REFERENCE_SIDE, &mut |_, _| progress.step())?;
        if progress.is_stopped() {
            return Ok(None);
        }
        Ok(Some(Subject {
            name: name.to_owned(),
            captures,
            placed,
            reference: Some(reference),
            referred_to: format!("the mean of {} samples a pixel", REFERENCE_SIDE * REFERENCE_SIDE),
        }))
    }

    /// A capture with all of its samples, with half of them and with a quarter, as long as four are left. Of one whose shading is
    /// placed all samples stay: pixels are shaded at any of them.
    pub fn of_capture(name: &str, mut capture: Capture) -> Subject {
        let reference = capture.reference.take();
        let referred_to = match &reference {
            Some(_) => "the capture's reference",
            None => "the picture of the most general variant: the capture has no reference",
        };
        let mut counts = vec![capture.samples.len()];
        for share in [2, 4] {
            let fewer = capture.samples.len() / share;
            if fewer >= 4 && capture.shading != ShadingSample::Placed {
                counts.push(fewer);
            }
        }
        let captures = counts.iter().map(|count| fewer_samples(&capture, *count)).collect();
        Subject {
            name: name.to_owned(),
            captures,
            placed: Vec::new(),
            reference,
            referred_to: referred_to.to_owned(),
        }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> UVec2 {
        self.captures.first().map_or(UVec2::ZERO, |capture| capture.size)
    }
}

/// The capture with `count` of its geometry samples, as far apart as can be; those that were shaded are among them.
fn fewer_samples(capture: &Capture, count: usize) -> Capture {
    if count >= capture.samples.len() {
        return capture.clone();
    }
    let mut kept = match &capture.shading {
        ShadingSample::Sample(k) => vec![*k],
        ShadingSample::Samples(several) => several.clone(),
        ShadingSample::Centre | ShadingSample::Placed => vec![0],
    };
    while kept.len() < count {
        let gap = |k: &usize| {
            let gaps = kept
                .iter()
                .map(|other| sample_distance(capture.samples[*k], capture.samples[*other]));
            gaps.fold(f32::INFINITY, f32::min)
        };
        let left = (0..capture.samples.len()).filter(|k| !kept.contains(k));
        match left.max_by(|a, b| gap(a).total_cmp(&gap(b)).then(b.cmp(a))) {
            Some(farthest) => kept.push(farthest),
            None => break,
        }
    }
    // In their old order, then the centre, if that was shaded.
    kept.sort_unstable();
    let mut layers = kept.clone();
    layers.extend(capture.samples.len()..capture.layer_count());
    let depth = layers.iter().map(|k| capture.depth.layers()[*k].clone()).collect();
    let normal = capture.normal.as_ref().map(|normal| {
        let kept = layers.iter().map(|k| normal.layers()[*k].clone());
        FrameLayers::new(kept.collect())
    });
    let colors_of = |all: &Option<FrameLayers<Vec4>>| {
        let kept = |all: &FrameLayers<Vec4>| layers.iter().map(|k| all.layers()[*k].clone()).collect();
        all.as_ref().map(|all| FrameLayers::new(kept(all)))
    };
    let place = |old: &usize| kept.iter().position(|k| k == old).unwrap_or(0);
    Capture {
        size: capture.size,
        samples: kept.iter().map(|k| capture.samples[*k]).collect(),
        shading: match &capture.shading {
            ShadingSample::Centre => ShadingSample::Centre,
            ShadingSample::Placed => ShadingSample::Placed,
            ShadingSample::Sample(old) => ShadingSample::Sample(place(old)),
            ShadingSample::Samples(old) => ShadingSample::Samples(old.iter().map(place).collect()),
        },
        normal_space: capture.normal_space,
        camera: capture.camera,
        color: capture.color.clone(),
        colors: capture.colors.clone(),
        place: capture.place.clone(),
        depth: FrameLayers::new(depth),
        normal,
        albedo: colors_of(&capture.albedo),
        direct: capture.direct.clone(),
        rest: capture.rest.clone(),
        guide: colors_of(&capture.guide),
        reference: None,
    }
}

/// Distance of two samples in a picture in which every pixel has them.
fn sample_distance(a: Vec2, b: Vec2) -> f32 {
    let away = (a - b).abs();
    away.min(1.0 - away).length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3, uvec2};
    use straightline_scene::capture::NormalSpace;

    fn capture(samples: Vec<Vec2>, shading: ShadingSample) -> Capture {
        let size = uvec2(2, 1);
        let layers = samples.len() + usize::from(shading == ShadingSample::Centre);
        let depth = (0..layers).map(|k| Frame::new(size, vec![k as f32; 2]));
        let normal = (0..layers).map(|k| Frame::new(size, vec![Vec3::splat(k as f32); 2]));
        let albedo = (0..layers).map(|k| Frame::new(size, vec![Vec4::splat(k as f32); 2]));
        Capture {
            size,
            shading,
            normal_space: NormalSpace::View,
            camera: None,
            color: Frame::new(size, vec![Vec4::ONE; 2]),
            colors: Vec::new(),
            place: None,
            depth: FrameLayers::new(depth.collect()),
            normal: Some(FrameLayers::new(normal.collect())),
            albedo: Some(FrameLayers::new(albedo.collect())),
            direct: Some(Frame::new(size, vec![Vec4::ONE; 2])),
            rest: None,
            guide: None,
            reference: None,
            samples,
        }
    }

    fn pattern(name: &str) -> Vec<Vec2> {
        gbuffer::pattern_offsets(name).unwrap()
    }

    #[test]
    fn a_capture_is_thinned_and_its_layers_follow() {
        for shading in [
            ShadingSample::Centre,
            ShadingSample::Sample(5),
            ShadingSample::Samples(vec![14, 3]),
        ] {
            let whole = capture(pattern("latin16"), shading);
            let subject = Subject::of_capture("frame", whole.clone());
            let counts: Vec<usize> = subject.captures.iter().map(|c| c.samples.len()).collect();
            assert_eq!(counts, [16, 8, 4]);
            for thin in &subject.captures {
                assert_eq!(thin.depth.layers().len(), thin.layer_count());
                assert!(thin.direct.is_some() && thin.rest.is_none());
                let albedo = thin.albedo.as_ref().unwrap().layers();
                for (own, depth) in albedo.iter().zip(thin.depth.layers()) {
                    assert_eq!(own.texels()[0].x, depth.texels()[0]);
                }
                assert_eq!(albedo.len(), thin.layer_count());
                for (sample, layer) in thin.samples.iter().zip(thin.depth.layers()) {
                    let place = whole.samples.iter().position(|s| s == sample).unwrap();
                    assert_eq!(layer.texels()[0], place as f32);
                }
                let shaded = thin.shaded_layers().into_iter();
                let shaded: Vec<usize> = shaded.map(|k| thin.depth.layers()[k].texels()[0] as usize).collect();
                assert_eq!(shaded, whole.shaded_layers());
                assert_eq!(thin.shaded_offsets(), whole.shaded_offsets());
            }
            let least = |c: &Capture| {
                let pairs = c.samples.iter().flat_map(|a| c.samples.iter().map(move |b| (a, b)));
                let gaps = pairs.filter(|(a, b)| a != b).map(|(a, b)| sample_distance(*a, *b));
                gaps.fold(f32::INFINITY, f32::min)
            };
            assert!(least(&subject.captures[2]) > 0.35, "{:?}", subject.captures[2].samples);
        }
    }

    #[test]
    fn four_samples_stay_four() {
        let subject = Subject::of_capture("frame", capture(pattern("latin4"), ShadingSample::Centre));
        assert_eq!(subject.captures.len(), 1);
        assert!(subject.referred_to.contains("most general"), "{}", subject.referred_to);
    }
}
