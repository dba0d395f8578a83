//! Scenes and methods where SRAA loses.

use crate::record::{Family, MethodErrors, SceneErrors};

/// Differences in dB and in FLIP that count as equal.
const EVEN_DB: f64 = 0.05;
const EVEN_FLIP: f64 = 0.000_1;

/// Lists the methods that beat SRAA with default options, for each number of samples: no antialiasing, picture filters and
/// edge filters. Returns one sentence for each of those methods.
pub fn list_losses(scene: &SceneErrors) -> Vec<String> {
    let ours = scene.methods.iter().filter(|m| {
        let variant = m.method.contains(',');
        m.family == Family::Sraa && !variant
    });
    let others = |m: &&MethodErrors| matches!(m.family, Family::None | Family::Picture | Family::Edge);
    let mut all = Vec::new();
    for own in ours {
        for other in scene.methods.iter().filter(others) {
            let lost = describe_losses(own, other);
            if !lost.is_empty() {
                all.push(format!("{} loses to {}: {}", own.method, other.method, lost.join(", ")));
            }
        }
    }
    all
}

fn describe_losses(own: &MethodErrors, other: &MethodErrors) -> Vec<String> {
    let by = |own: Option<f64>, other: Option<f64>| match (own, other) {
        (Some(own), Some(other)) if other - own > EVEN_DB => Some(other - own),
        _ => None,
    };
    let places = [
        ("in all", by(Some(own.psnr), Some(other.psnr))),
        ("at geometry edges", by(own.psnr_geometry, other.psnr_geometry)),
        ("at shading edges", by(own.psnr_shading, other.psnr_shading)),
        ("in flat regions", by(own.psnr_flat, other.psnr_flat)),
    ];
    let lost = places
        .into_iter()
        .filter_map(|(place, by)| by.map(|db| format!("{db:.1} dB {place}")));
    let flip = own.flip - other.flip;
    let seen = (flip > EVEN_FLIP).then(|| format!("{flip:.4} of FLIP"));
    lost.chain(seen).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Shares;

    fn method(name: &str, family: Family, psnr: f64, shading: Option<f64>, flip: f64) -> MethodErrors {
        MethodErrors {
            method: name.to_owned(),
            family,
            options: Vec::new(),
            psnr,
            ssim: 1.0,
            flip,
            psnr_geometry: Some(psnr),
            psnr_shading: shading,
            psnr_flat: None,
            worst: None,
            gap_closed: None,
            temporal: None,
            time: None,
            bytes: 0,
            extra: None,
            non_finite: 0,
            picture: None,
        }
    }

    #[test]
    fn what_is_lost_is_said_with_its_place() {
        let scene = SceneErrors {
            scene: "floor".to_owned(),
            purpose: String::new(),
            shares: Shares {
                geometry: 0.0,
                shading: 0.0,
                flat: 1.0,
                unseen: 0.0,
            },
            reference: None,
            methods: vec![
                method("1x", Family::None, 30.0, Some(25.0), 0.03),
                method("SRAA 4", Family::Sraa, 35.0, Some(24.0), 0.02),
                method("SRAA 4, depth", Family::Sraa, 10.0, Some(10.0), 0.5),
                method("SMAA", Family::Picture, 33.0, None, 0.01),
                method("4x", Family::Supersampling, 40.0, Some(40.0), 0.001),
            ],
            absent: Vec::new(),
            gaps: Vec::new(),
        };
        assert_eq!(
            list_losses(&scene),
            [
                "SRAA 4 loses to 1x: 1.0 dB at shading edges",
                "SRAA 4 loses to SMAA: 0.0100 of FLIP"
            ]
        );
    }
}
