//! Terms that a search over a kernel's variants left out of a shader, and their cost.

use serde::{Deserialize, Serialize};

/// A shader tuned to one scene: the cheapest one within a budget of error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tuned {
    /// The scene or capture that decided. On others the shader may be off by more.
    pub scene: String,
    /// Width and height of its picture in pixels.
    pub size: [u32; 2],
    /// `psnr`, in dB, or `flip`, the mean of FLIP.
    pub metric: String,
    /// Budget: error beyond the best variant's that may be accepted, by the metric.
    pub max_error: f64,
    /// The best variant's error.
    pub best: f64,
    /// This shader's error.
    pub error: f64,
    /// The most general variant's error.
    pub general: f64,
    /// Adapter on which the shader was timed.
    pub adapter: String,
    /// Speedup over the most general variant: the middle of all rounds.
    pub speedup: f64,
    /// Terms that the most general variant has and this one has not, and terms beyond that variant that were tried.
    pub left_out: Vec<LeftOut>,
    /// Terms that this variant has beyond the most general one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub needed: Vec<LeftOut>,
}

/// A term that a shader does without, or that it needs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LeftOut {
    /// Name of the term: normals, planes, 16 samples, f32, placing, ...
    pub term: String,
    /// Cost of doing without the term, by the metric: dB or mean FLIP, a loss being positive.
    pub cost: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Manifest;

    const OLDER: &str = include_str!("../../shaders-out/sraa4.json");

    #[test]
    fn a_manifest_without_it_reads_and_writes_as_ever() {
        let manifest = Manifest::from_json(OLDER).expect("an older manifest is read");
        assert_eq!(manifest.tuned, None);
        assert_eq!(manifest.to_json(), OLDER);
    }

    #[test]
    fn what_was_left_out_comes_back() {
        let mut manifest = Manifest::from_json(OLDER).expect("a manifest");
        manifest.tuned = Some(Tuned {
            scene: "floor".to_owned(),
            size: [640, 360],
            metric: "psnr".to_owned(),
            max_error: 0.5,
            best: 41.5,
            error: 41.25,
            general: 41.375,
            adapter: "some adapter".to_owned(),
            speedup: 2.5,
            left_out: vec![LeftOut {
                term: "normals".to_owned(),
                cost: 0.125,
            }],
            needed: Vec::new(),
        });
        let text = manifest.to_json();
        assert!(!text.contains("needed"), "{text}");
        assert_eq!(Manifest::from_json(&text).expect("it reads its own"), manifest);
        if let Some(tuned) = &mut manifest.tuned {
            tuned.needed = vec![LeftOut {
                term: "placing".to_owned(),
                cost: 1.25,
            }];
        }
        let text = manifest.to_json();
        assert_eq!(Manifest::from_json(&text).expect("it reads its own"), manifest);
        assert!(Manifest::from_json(&text.replace("\"left_out\"", "\"omitted\"")).is_err());
    }
}
