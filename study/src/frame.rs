//! Time of a whole frame against its error: geometry, shading at a given cost, and the filter, combined from two records of
//! one scene.
//!
//! `budget` times the passes of a frame, and `study error` the filters and their errors. The cost of shading depends on the
//! game, so it is a parameter: a method that shades n samples of a pixel pays it n times.

use crate::record::{Circumstances, Family, Frame, FrameMethod, FrameRecord, MethodErrors, PassTimes, QualityRecord};

/// Default costs of shading one sample of every pixel, in milliseconds.
pub const SHADING_MS: [f64; 3] = [1.0, 5.0, 20.0];

/// Reason why two records cannot be combined.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FrameError {
    /// The records differ in a property that must be equal.
    #[error("the records differ in their {what}: {passes} and {errors}; take both with the same")]
    Differ {
        /// Property that differs.
        what: &'static str,
        /// Value in the record of passes.
        passes: String,
        /// Value in the record of filters and errors.
        errors: String,
    },
    /// The scene of the passes is not in the record of errors.
    #[error("`{scene}` is none of the scenes of the errors: {known}")]
    Scene {
        /// Scene of the passes.
        scene: String,
        /// Scenes of the other record.
        known: String,
    },
    /// A method is not in the record of errors.
    #[error("`{name}` is none of the methods of the errors")]
    Method {
        /// Name of the method.
        name: String,
    },
    /// A pass is missing.
    #[error("the record of passes has no `{name}` with {samples} samples: run `budget --record` again")]
    Pass {
        /// Name of the pass.
        name: &'static str,
        /// Samples of the pass.
        samples: u32,
    },
}

/// The requested frames.
#[derive(Clone, Debug)]
pub struct FrameRequest {
    /// Costs of shading one sample of every pixel, in milliseconds.
    pub shading_ms: Vec<f64>,
    /// Names of the methods; empty for all.
    pub only: Vec<String>,
}

/// Parts of a method's frame.
struct Parts {
    geometry_ms: f64,
    shaded: u32,
    filter_ms: f64,
}

/// Combines the frames of every method of a scene, at each cost of shading.
///
/// # Errors
///
/// [`FrameError`], if the records are not of one scene, size and adapter.
pub fn combine_frames(
    passes: &PassTimes,
    errors: &QualityRecord,
    request: &FrameRequest,
    command: String,
) -> Result<FrameRecord, FrameError> {
    check_circumstances(&passes.circumstances, &errors.circumstances)?;
    let scene = errors.scenes.iter().find(|scene| scene.scene == passes.scene);
    let scene = scene.ok_or_else(|| FrameError::Scene {
        scene: passes.scene.clone(),
        known: errors
            .scenes
            .iter()
            .map(|s| s.scene.as_str())
            .collect::<Vec<_>>()
            .join(", "),
    })?;
    let mut methods = Vec::new();
    let mut absent = Vec::new();
    let shading_ms = &request.shading_ms;
    if let Some(name) = request
        .only
        .iter()
        .find(|name| !scene.methods.iter().any(|m| m.method == **name))
    {
        return Err(FrameError::Method { name: name.clone() });
    }
    let is_asked = |m: &&MethodErrors| request.only.is_empty() || request.only.contains(&m.method);
    for method in scene.methods.iter().filter(is_asked) {
        match parts(method, passes)? {
            Ok(parts) => methods.push(at_costs(method, &parts, shading_ms)),
            Err(why) => absent.push((method.method.clone(), why.to_owned())),
        }
    }
    methods.sort_by(|a: &FrameMethod, b| b.error.total_cmp(&a.error));
    for k in 0..shading_ms.len() {
        mark_best(&mut methods, k);
    }
    Ok(FrameRecord {
        command,
        passes: passes.circumstances.clone(),
        errors: errors.circumstances.clone(),
        scene: passes.scene.clone(),
        shading_ms: shading_ms.clone(),
        own_shading_ms: pass_time(passes, "deferred shading", 1)?,
        methods,
        absent,
    })
}

fn check_circumstances(passes: &Circumstances, errors: &Circumstances) -> Result<(), FrameError> {
    let size = |of: &Circumstances| format!("{}x{}", of.size[0], of.size[1]);
    let all = [
        ("adapter", passes.adapter.clone(), errors.adapter.clone()),
        ("processor", passes.processor.clone(), errors.processor.clone()),
        ("size", size(passes), size(errors)),
    ];
    match all.into_iter().find(|(_, passes, errors)| passes != errors) {
        None => Ok(()),
        Some((what, passes, errors)) => Err(FrameError::Differ { what, passes, errors }),
    }
}

fn pass_time(passes: &PassTimes, name: &'static str, samples: u32) -> Result<f64, FrameError> {
    let of = |p: &&crate::record::TimedPass| p.name == name && p.samples == samples;
    let found = passes.passes.iter().find(of);
    found.map(|p| p.ms.median).ok_or(FrameError::Pass { name, samples })
}

/// Returns the parts of a method's frame, or the reason why they are unknown.
fn parts(method: &MethodErrors, passes: &PassTimes) -> Result<Result<Parts, &'static str>, FrameError> {
    let main = |samples| pass_time(passes, "main G-buffer", samples);
    let filter_ms = method.time.as_ref().map(|time| time.median_ms);
    Ok(match method.family {
        Family::None => Ok(Parts {
            geometry_ms: main(1)?,
            shaded: 1,
            filter_ms: 0.0,
        }),
        Family::Edge | Family::Picture => filter_ms.ok_or("it was not timed").and_then(|filter_ms| {
            Ok(Parts {
                geometry_ms: main(1).map_err(|_| "its G-buffer was not timed")?,
                shaded: 1,
                filter_ms,
            })
        }),
        Family::Supersampling => match method.method.as_str() {
            "4x" | "16x" => {
                let samples = if method.method == "4x" { 4 } else { 16 };
                Ok(Parts {
                    geometry_ms: main(samples)?,
                    shaded: samples,
                    filter_ms: pass_time(passes, "box filter", samples)?,
                })
            }
            _ => Err("its one pass draws and shades, so that another cost of shading is not known of it"),
        },
        Family::Sraa => match (samples_beside(method), filter_ms) {
            (Err(why), _) => Err(why),
            (_, None) => Err("it was not timed"),
            (Ok(samples), Some(filter_ms)) => Ok(Parts {
                geometry_ms: main(1)? + further_samples(method, samples, passes)?,
                shaded: shading_sample_count(method),
                filter_ms,
            }),
        },
        Family::Own => Err("its passes are not known"),
    })
}

fn find_option<'m>(method: &'m MethodErrors, name: &str) -> Option<&'m str> {
    let found = method.options.iter().find(|(option, _)| option == name);
    found.map(|(_, value)| value.as_str())
}

/// Returns the number of SRAA's samples beyond the main G-buffer.
fn samples_beside(method: &MethodErrors) -> Result<u32, &'static str> {
    if find_option(method, "shading") == Some("placed") || find_option(method, "extra") == Some("true") {
        return Err("the passes that shade where it asks for are not timed");
    }
    let samples = match find_option(method, "pattern") {
        None | Some("latin4" | "ordered4") => 4,
        Some("latin16" | "standard16" | "ordered16") => 16,
        _ => return Err("a pass with its number of samples is not timed"),
    };
    match (find_option(method, "shading"), samples) {
        // The main G-buffer contains the first of them.
        (Some("sample0"), 4) => Ok(3),
        _ => Ok(samples),
    }
}

/// Returns the time to draw samples beyond the main G-buffer: one pass each, or one multisampled pass where the hardware
/// has the pattern and that is faster.
fn further_samples(method: &MethodErrors, samples: u32, passes: &PassTimes) -> Result<f64, FrameError> {
    let one_by_one = pass_time(passes, "depth and normals", samples)?;
    let is_hardwares = matches!(find_option(method, "pattern"), None | Some("latin4"));
    let at_once = pass_time(passes, "depth and normals, multisampled", samples).ok();
    Ok(at_once
        .filter(|_| is_hardwares)
        .map_or(one_by_one, |ms| ms.min(one_by_one)))
}

fn shading_sample_count(method: &MethodErrors) -> u32 {
    let listed = find_option(method, "shaded").filter(|_| find_option(method, "shading") == Some("listed"));
    listed.map_or(1, |list| list.split(',').count() as u32)
}

fn at_costs(method: &MethodErrors, parts: &Parts, shading_ms: &[f64]) -> FrameMethod {
    let frame = |shading: &f64| Frame {
        ms: parts.geometry_ms + f64::from(parts.shaded) * shading + parts.filter_ms,
        is_best: false,
    };
    FrameMethod {
        method: method.method.clone(),
        family: method.family,
        options: method.options.clone(),
        geometry_ms: parts.geometry_ms,
        shaded: parts.shaded,
        filter_ms: parts.filter_ms,
        psnr: method.psnr,
        error: 10f64.powf(-method.psnr / 20.0),
        bytes: method.bytes,
        frames: shading_ms.iter().map(frame).collect(),
    }
}

/// Marks the methods that no other beats in both time and error, at one cost of shading.
fn mark_best(methods: &mut [FrameMethod], cost: usize) {
    let points: Vec<(f64, f64)> = methods.iter().map(|m| (m.frames[cost].ms, m.error)).collect();
    for (own, method) in points.iter().zip(methods) {
        let beats = |other: &(f64, f64)| other.0 <= own.0 && other.1 <= own.1 && other != own;
        method.frames[cost].is_best = !points.iter().any(beats);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Interval;
    use straightline_bench::execute::Times;

    fn circumstances(size: [u32; 2]) -> Circumstances {
        serde_json::from_value(serde_json::json!({
            "command": "", "date": "", "adapter": "a", "processor": "p", "clock": "wall-clock", "size": size, "rounds": 3, "complete": true
        }))
        .unwrap()
    }

    fn method(name: &str, family: Family, options: &[(&str, &str)], psnr: f64, ms: Option<f64>) -> MethodErrors {
        let time = ms.map(|ms| Times {
            median_ms: ms,
            min_ms: ms,
            max_ms: ms,
            rounds: 3,
            rounds_ms: Vec::new(),
        });
        MethodErrors {
            method: name.to_owned(),
            family,
            options: options
                .iter()
                .map(|(k, v)| ((*k).to_owned(), (*v).to_owned()))
                .collect(),
            psnr,
            ssim: 1.0,
            flip: 0.0,
            psnr_geometry: None,
            psnr_shading: None,
            psnr_flat: None,
            worst: None,
            gap_closed: None,
            temporal: None,
            time,
            bytes: 8,
            extra: None,
            non_finite: 0,
            picture: None,
        }
    }

    fn records() -> (PassTimes, QualityRecord) {
        let passes = [
            ("main G-buffer", 1, 2.0),
            ("main G-buffer", 4, 8.0),
            ("main G-buffer", 16, 32.0),
            ("depth and normals", 3, 3.0),
            ("depth and normals", 4, 4.0),
            ("depth and normals", 16, 16.0),
            ("depth and normals, multisampled", 4, 3.5),
            ("deferred shading", 1, 1.5),
            ("box filter", 4, 0.5),
            ("box filter", 16, 2.0),
        ];
        let passes = passes.map(|(name, samples, ms)| crate::record::TimedPass {
            name: name.to_owned(),
            samples,
            ms: Interval {
                median: ms,
                low: ms,
                high: ms,
            },
        });
        let methods = vec![
            method("1x", Family::None, &[], 30.0, None),
            method("SMAA", Family::Picture, &[], 33.0, Some(3.0)),
            method("slow", Family::Picture, &[], 31.0, Some(9.0)),
            method("SRAA 4", Family::Sraa, &[], 38.0, Some(2.0)),
            method(
                "two",
                Family::Sraa,
                &[("shading", "listed"), ("shaded", "0,3")],
                39.0,
                Some(2.5),
            ),
            method("first", Family::Sraa, &[("shading", "sample0")], 37.0, Some(1.5)),
            method("placed", Family::Sraa, &[("shading", "placed")], 40.0, Some(5.0)),
            method("eight", Family::Sraa, &[("pattern", "standard8")], 40.0, Some(5.0)),
            method("4x", Family::Supersampling, &[], 40.0, None),
            method("MSAA 4", Family::Supersampling, &[], 38.0, None),
        ];
        let scene = serde_json::json!({
            "scene": "roof", "purpose": "", "reference": null, "absent": [], "gaps": [],
            "shares": { "geometry": 0.0, "shading": 0.0, "flat": 1.0, "unseen": 0.0 },
            "methods": methods,
        });
        (
            PassTimes {
                circumstances: circumstances([64, 64]),
                scene: "roof".to_owned(),
                passes: passes.to_vec(),
            },
            QualityRecord {
                circumstances: circumstances([64, 64]),
                timed_on: Vec::new(),
                pan_frames: 0,
                scenes: vec![serde_json::from_value(scene).unwrap()],
            },
        )
    }

    fn at(shading_ms: &[f64]) -> FrameRequest {
        FrameRequest {
            shading_ms: shading_ms.to_vec(),
            only: Vec::new(),
        }
    }

    #[test]
    fn only_methods_that_are_asked_for_have_frames() {
        let (passes, errors) = records();
        let only = |name: &str| FrameRequest {
            only: vec![name.to_owned()],
            ..at(&[1.0])
        };
        let record = combine_frames(&passes, &errors, &only("4x"), String::new()).unwrap();
        assert_eq!((record.methods.len(), record.absent.len()), (1, 0));
        let error = combine_frames(&passes, &errors, &only("5x"), String::new())
            .unwrap_err()
            .to_string();
        assert!(error.contains("`5x`"), "{error}");
    }

    #[test]
    fn frames_are_the_sums_of_their_parts() {
        let (passes, errors) = records();
        let record = combine_frames(&passes, &errors, &at(&[1.0, 20.0]), String::new()).unwrap();
        let ms = |name: &str| -> Vec<f64> {
            let method = record.methods.iter().find(|m| m.method == name).unwrap();
            method.frames.iter().map(|frame| frame.ms).collect()
        };
        assert_eq!(ms("1x"), [3.0, 22.0]);
        assert_eq!(ms("SMAA"), [6.0, 25.0]);
        assert_eq!(ms("SRAA 4"), [2.0 + 3.5 + 1.0 + 2.0, 2.0 + 3.5 + 20.0 + 2.0]);
        assert_eq!(ms("two"), [2.0 + 3.5 + 2.0 + 2.5, 2.0 + 3.5 + 40.0 + 2.5]);
        assert_eq!(ms("first"), [2.0 + 3.0 + 1.0 + 1.5, 2.0 + 3.0 + 20.0 + 1.5]);
        assert_eq!(ms("4x"), [8.0 + 4.0 + 0.5, 8.0 + 80.0 + 0.5]);
        let absent: Vec<&str> = record.absent.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(absent, ["placed", "eight", "MSAA 4"]);
        let best = |k: usize| -> Vec<&str> {
            let best = record.methods.iter().filter(|m| m.frames[k].is_best);
            best.map(|m| m.method.as_str()).collect()
        };
        assert_eq!(best(0), ["1x", "SMAA", "first", "SRAA 4", "two", "4x"]);
        assert!(!best(1).contains(&"slow") && best(1).contains(&"SRAA 4"));
    }

    #[test]
    fn records_of_different_things_are_refused() {
        let (mut passes, errors) = records();
        passes.circumstances = circumstances([32, 32]);
        let error = combine_frames(&passes, &errors, &at(&[1.0]), String::new())
            .unwrap_err()
            .to_string();
        assert!(error.contains("size: 32x32 and 64x64"), "{error}");
        passes.circumstances = circumstances([64, 64]);
        passes.scene = "stair".to_owned();
        let error = combine_frames(&passes, &errors, &at(&[1.0]), String::new())
            .unwrap_err()
            .to_string();
        assert!(error.contains("`stair`") && error.contains("roof"), "{error}");
        passes.scene = "roof".to_owned();
        passes.passes.clear();
        let error = combine_frames(&passes, &errors, &at(&[1.0]), String::new())
            .unwrap_err()
            .to_string();
        assert!(error.contains("main G-buffer"), "{error}");
    }
}
