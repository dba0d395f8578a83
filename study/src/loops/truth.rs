//! Inputs of a kernel, and its expected result.

use super::{Input, LoopsError, Subject};
use glam::{UVec2, Vec4};
use straightline_bench::execute::{Bench, Inputs, interpret_kernel, test_inputs};
use straightline_codegen::Compiled;
use straightline_oracle::oracle::{self, SraaParams};
use straightline_scene::capture::{Capture, ShadingSample};
use straightline_scene::gbuffer;
use straightline_scene::render::{self, GpuRenderer};
use straightline_scene::scene::Scene;

/// The scene that SRAA is run on.
const SCENE: &str = "roof";

/// Source of inputs of one size; a scene is drawn once.
pub struct Truth<'a> {
    bench: &'a Bench,
    size: UVec2,
    captures: Vec<(String, Capture)>,
}

impl<'a> Truth<'a> {
    /// Creates the source for pictures of `size`.
    pub fn new(bench: &'a Bench, size: UVec2) -> Self {
        Truth {
            bench,
            size,
            captures: Vec::new(),
        }
    }

    /// Returns the inputs of a kernel.
    ///
    /// # Errors
    ///
    /// If the scene cannot be drawn.
    pub fn inputs(&mut self, subject: &Subject, full: &Compiled) -> Result<Inputs, LoopsError> {
        match subject.input {
            // A compute invocation computes a whole quad, and reads from textures what a fragment shader interpolates.
            Input::TestCard => {
                let mut inputs = test_inputs(&full.in_blocks().graph, self.size);
                for (name, lanes) in &subject.uniforms {
                    inputs.uniforms.retain(|(known, _)| known != name);
                    inputs = inputs.with_uniform(name, lanes);
                }
                Ok(inputs)
            }
            Input::Roof => {
                let pattern = full.options.choice("pattern").unwrap_or_default();
                let known = self.captures.iter().position(|(name, _)| name == pattern);
                let at = match known {
                    Some(at) => at,
                    None => {
                        let capture = self.capture(pattern)?;
                        self.captures.push((pattern.to_owned(), capture));
                        self.captures.len() - 1
                    }
                };
                Ok(gbuffer::sraa_inputs(&self.captures[at].1, &full.options)?)
            }
        }
    }

    fn capture(&self, pattern: &str) -> Result<Capture, LoopsError> {
        let samples = gbuffer::pattern_offsets(pattern).unwrap_or_default();
        let scene = Scene::from_name(SCENE)?;
        let renderer = GpuRenderer::new(self.bench.device(), self.bench.queue(), &scene, self.size)?;
        Ok(render::capture_scene(&renderer, &samples, ShadingSample::Centre)?)
    }
}

/// Returns the name of an input for a record. For the test card it includes the values of uniforms that were set, or have
/// no default.
pub fn input_name(subject: &Subject, full: &Compiled, inputs: &Inputs) -> String {
    match subject.input {
        Input::Roof => format!("the scene `{SCENE}`"),
        Input::TestCard => {
            let uniforms = full.graph.uniforms.iter();
            let stated = uniforms.filter_map(|uniform| {
                let given = subject.uniforms.iter().any(|(name, _)| *name == uniform.name);
                let (_, lanes) = inputs.uniforms.iter().find(|(name, _)| *name == uniform.name)?;
                let lanes: Vec<String> = lanes.iter().map(f64::to_string).collect();
                (given || uniform.default.is_none()).then(|| format!("{} = {}", uniform.name, lanes.join(",")))
            });
            let stated: Vec<String> = stated.collect();
            match stated.is_empty() {
                true => "the test card".to_owned(),
                false => format!("the test card with {}", stated.join(", ")),
            }
        }
    }
}

/// Returns the expected result of a kernel, in `f64`: each pixel's colour; `None` where 32 bits may decide otherwise.
///
/// # Errors
///
/// If an input is missing.
pub fn expected_colors(
    subject: &Subject,
    full: &Compiled,
    inputs: &Inputs,
) -> Result<Vec<Option<[f64; 4]>>, LoopsError> {
    match subject.input {
        Input::TestCard => Ok(interpret_kernel::<f64>(full, inputs, false)?
            .texels
            .into_iter()
            .map(Some)
            .collect()),
        Input::Roof => {
            let params = SraaParams::from_options(&full.options)?;
            let resolved = oracle::resolve_sraa(inputs, &params)?;
            Ok(resolved
                .into_iter()
                .map(|pixel| pixel.sure.then_some(pixel.color))
                .collect())
        }
    }
}

/// Returns the largest difference of any colour, and the largest without the thousandth of the pixels that differ most. The
/// difference of a finite and a non-finite number is the largest `f64`.
pub fn largest_differences(found: &[Vec4], exact: &[Option<[f64; 4]>]) -> (f64, f64) {
    let apart = |a: f64, b: f64| match (a.is_finite(), b.is_finite()) {
        (true, true) => (a - b).abs(),
        (false, false) => 0.0,
        _ => f64::MAX,
    };
    let off = |(found, exact): (&Vec4, &Option<[f64; 4]>)| {
        let exact = (*exact)?;
        Some((0..4).map(|k| apart(f64::from(found[k]), exact[k])).fold(0.0, f64::max))
    };
    let mut all: Vec<f64> = found.iter().zip(exact).filter_map(off).collect();
    all.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let last = all.len().saturating_sub(1);
        all.get((last as f64 * share) as usize).copied().unwrap_or(0.0)
    };
    (at(1.0), at(0.999))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_thousandth_that_differs_most_is_left_out() {
        let exact: Vec<_> = (0..1001).map(|k| Some([f64::from(k), 0.0, 0.0, 0.0])).collect();
        let mut found: Vec<Vec4> = (0..1001).map(|k| Vec4::new(k as f32, 0.0, 0.0, 0.25)).collect();
        found[500].x += 3.0;
        assert_eq!(largest_differences(&found, &exact), (3.0, 0.25));
        found[3].y = f32::NAN;
        assert_eq!(largest_differences(&found, &exact).0, f64::MAX);
        let mut unsure = exact.clone();
        unsure[3] = None;
        assert_eq!(largest_differences(&found, &unsure).0, 3.0);
    }
}
