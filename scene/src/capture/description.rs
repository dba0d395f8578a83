//! `capture.json`.

use super::{Capture, CaptureError, DESCRIPTION, MAX_GEOMETRY_TEXELS, MAX_SAMPLES, layer_count};
use crate::picture;
use crate::scene::Camera;
use glam::{Mat3, UVec2, Vec2, Vec3, vec3};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Version of the layout of `capture.json`. A reader refuses a capture whose schema it does not know.
pub const SCHEMA: u32 = 1;

/// The only encoding of depth so far.
const LINEAR: &str = "linear";

/// Position in a pixel at which shading was sampled.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ShadingSample {
    /// At the geometry sample of this index: `{"sample": 0}`.
    Sample(usize),
    /// Several times a pixel, at the geometry samples of these indices, two or four: `{"samples": [0, 3]}`.
    Samples(Vec<usize>),
    /// At the pixel's centre: `"centre"`. The geometry there is one more layer, the last.
    Centre,
    /// In each pixel where `place.exr` says, at a geometry sample or at the pixel's centre: `"placed"`. The geometry at the
    /// centre is one more layer, the last.
    Placed,
}

/// Numbers of shading samples that can be listed: what SRAA reads.
pub const SEVERAL: [usize; 2] = [2, 4];

/// Space in which normals are given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum NormalSpace {
    /// The camera's: x right, y up, z towards the viewer.
    #[default]
    View,
    /// The world's, which the camera is in.
    World,
}

impl NormalSpace {
    /// The rays of a camera through a picture of `size` pixels, in this space: from the eye to depth 1 through the upper
    /// left corner, and how they change from pixel to pixel to the right and down. Of a parallel projection the first is
    /// the way to depth 1 along all rays, and the others are the ways from ray to ray.
    pub fn rays(self, camera: &Camera, size: UVec2) -> [Vec3; 3] {
        let extent = camera.half_extent(size);
        let step = 2.0 * extent / size.as_vec2();
        let first = match camera.parallel_height {
            Some(_) => Vec3::NEG_Z,
            None => vec3(-extent.x, extent.y, -1.0),
        };
        let rays = [first, vec3(step.x, 0.0, 0.0), vec3(0.0, -step.y, 0.0)];
        match self {
            NormalSpace::View => rays,
            // The inverse of a rotation is its transpose.
            NormalSpace::World => rays.map(|ray| Mat3::from_mat4(camera.view()).transpose() * ray),
        }
    }

    /// The other one.
    pub(crate) fn other(self) -> NormalSpace {
        match self {
            NormalSpace::View => NormalSpace::World,
            NormalSpace::World => NormalSpace::View,
        }
    }

    /// As it stands in `capture.json`.
    pub(crate) fn name(self) -> &'static str {
        match self {
            NormalSpace::View => "view",
            NormalSpace::World => "world",
        }
    }

    fn is_view(&self) -> bool {
        *self == NormalSpace::View
    }
}

/// The contents of `capture.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Description {
    schema: u32,
    size: [u32; 2],
    samples: Vec<[f32; 2]>,
    shading: ShadingSample,
    depth: String,
    #[serde(default, skip_serializing_if = "NormalSpace::is_view")]
    pub(super) normals: NormalSpace,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) camera: Option<Camera>,
}

impl Description {
    /// The description of `capture`, which need not be valid.
    pub(super) fn from_capture(capture: &Capture) -> Self {
        Description {
            schema: SCHEMA,
            size: capture.size.to_array(),
            samples: capture.samples.iter().map(|sample| sample.to_array()).collect(),
            shading: capture.shading.clone(),
            depth: LINEAR.to_owned(),
            normals: capture.normal_space,
            camera: capture.camera,
        }
    }

    /// Reads the text of the file `path`, which only errors need.
    pub(super) fn parse(path: &Path, text: &str) -> Result<Self, CaptureError> {
        #[derive(Deserialize)]
        struct Head {
            schema: u32,
        }
        let json = |source| CaptureError::Json {
            path: path.to_owned(),
            source,
        };
        let head: Head = serde_json::from_str(text).map_err(json)?;
        if head.schema != SCHEMA {
            return Err(CaptureError::Schema {
                path: path.to_owned(),
                found: head.schema,
            });
        }
        let description: Description = serde_json::from_str(text).map_err(json)?;
        description.check(path)?;
        Ok(description)
    }

    /// The text of the file.
    pub(super) fn to_json(&self) -> Result<String, serde_json::Error> {
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    pub(super) fn size(&self) -> UVec2 {
        self.size.into()
    }

    pub(super) fn sample_offsets(&self) -> Vec<Vec2> {
        self.samples.iter().map(|sample| (*sample).into()).collect()
    }

    pub(super) fn shading(&self) -> ShadingSample {
        self.shading.clone()
    }

    /// Refuses what no capture can be, before anything is allocated for it.
    pub(super) fn check(&self, path: &Path) -> Result<(), CaptureError> {
        let value = |field: &'static str, problem: String| {
            Err(CaptureError::Value {
                path: path.to_owned(),
                field,
                problem,
            })
        };
        if let Some(problem) = self.camera.and_then(|camera| camera.check_projection().err()) {
            return value("camera", problem);
        }
        if self.depth != LINEAR {
            return Err(CaptureError::DepthEncoding {
                path: path.to_owned(),
                found: self.depth.clone(),
            });
        }
        let count = self.samples.len();
        if count == 0 || count > MAX_SAMPLES {
            return value(
                "samples",
                format!("there are {count}, and there must be 1 to {MAX_SAMPLES}"),
            );
        }
        for (index, sample) in self.samples.iter().enumerate() {
            if !sample.iter().all(|axis| (-0.5..=0.5).contains(axis)) {
                let [x, y] = sample;
                let range = "-0.5 to 0.5 pixels from the pixel's centre";
                return value(
                    "samples",
                    format!("sample {index} is at [{x}, {y}], and each axis must be {range}"),
                );
            }
        }
        let shaded = match &self.shading {
            ShadingSample::Centre | ShadingSample::Placed => &[][..],
            ShadingSample::Sample(index) => std::slice::from_ref(index),
            ShadingSample::Samples(indices) => {
                if !SEVERAL.contains(&indices.len()) {
                    return value(
                        "shading",
                        format!("it lists {} samples, and there must be two or four", indices.len()),
                    );
                }
                if let Some(twice) = (1..indices.len()).find(|k| indices[..*k].contains(&indices[*k])) {
                    return value("shading", format!("it lists sample {} twice", indices[twice]));
                }
                indices
            }
        };
        if let Some(index) = shaded.iter().find(|index| **index >= count) {
            return value(
                "shading",
                format!("it names sample {index}, and there are 0 to {}", count - 1),
            );
        }
        let size = self.size();
        picture::check_size(path, size)?;
        let texels = u64::from(size.x) * u64::from(size.y) * layer_count(count, &self.shading) as u64;
        if texels > MAX_GEOMETRY_TEXELS {
            let layers = layer_count(count, &self.shading);
            let problem = format!(
                "{}×{} with {layers} layers are over {MAX_GEOMETRY_TEXELS} texels",
                size.x, size.y
            );
            return value("size", problem + ": capture a smaller picture or fewer samples");
        }
        Ok(())
    }
}

/// File that errors name as the one that states sizes and counts.
pub(super) const STATED_BY: &str = DESCRIPTION;

#[cfg(test)]
mod tests {
    use super::*;

    const DOCUMENT: &str = include_str!("../../../docs/captures.md");

    fn parse(text: &str) -> Result<Description, CaptureError> {
        Description::parse(Path::new("there/capture.json"), text)
    }

    fn documented() -> &'static str {
        let (_, rest) = DOCUMENT.split_once("```json\n").expect("an example");
        rest.split_once("```").expect("its end").0
    }

    #[test]
    fn the_documented_example_is_the_default_pattern() {
        let description = parse(documented()).unwrap();
        assert_eq!(description.size(), UVec2::new(1280, 720));
        assert_eq!(description.shading(), ShadingSample::Centre);
        let sixteenths: Vec<_> = description
            .sample_offsets()
            .iter()
            .map(|sample| (*sample * 16.0).to_array())
            .collect();
        assert_eq!(sixteenths, [[-2.0, -6.0], [6.0, -2.0], [-6.0, 2.0], [2.0, 6.0]]);
        assert!(description.camera.is_some());
    }

    #[test]
    fn what_is_written_is_read() {
        let mut description = parse(documented()).unwrap();
        description.shading = ShadingSample::Sample(3);
        let json = description.to_json().unwrap();
        assert!(json.contains("\"sample\": 3"), "{json}");
        assert_eq!(parse(&json).unwrap(), description);
    }

    #[test]
    fn several_shading_samples_and_the_world_are_written_and_read() {
        let mut description = parse(documented()).unwrap();
        (description.shading, description.normals) = (ShadingSample::Samples(vec![0, 3]), NormalSpace::World);
        let json = description.to_json().unwrap();
        assert!(
            json.contains("\"samples\": [\n      0") && json.contains("\"normals\": \"world\""),
            "{json}"
        );
        assert_eq!(parse(&json).unwrap(), description);
    }

    #[test]
    fn a_parallel_camera_has_a_height_and_no_angle() {
        let text = documented().replace("\"vertical_fov\": 1.0472", "\"parallel_height\": 6.0");
        let description = parse(&text).unwrap();
        let camera = description.camera.unwrap();
        assert_eq!(camera.parallel_height, Some(6.0));
        let size = UVec2::new(64, 32);
        let [forward, right, down] = NormalSpace::View.rays(&camera, size);
        assert_eq!(forward, Vec3::NEG_Z);
        // Six units for 32 rows of square pixels.
        assert!((right - 6.0 / 32.0 * Vec3::X).length() < 1.0e-6 && (down + 6.0 / 32.0 * Vec3::Y).length() < 1.0e-6);
        assert_eq!(parse(&description.to_json().unwrap()).unwrap(), description);
    }

    #[test]
    fn rays_of_the_world_are_those_of_the_view_turned() {
        let camera = Camera {
            position: [3.0, 2.0, 1.0],
            target: [-1.0, 0.5, 4.0],
            ..parse(documented()).unwrap().camera.unwrap()
        };
        let size = UVec2::new(64, 48);
        let [corner, right, down] = NormalSpace::World.rays(&camera, size);
        let towards = Vec3::from(camera.target) - Vec3::from(camera.position);
        // Through the middle of the picture, to depth 1.
        let middle = corner + 32.0 * right + 24.0 * down;
        assert!((middle - towards.normalize()).length() < 1.0e-6, "{middle}");
        assert!(right.y.abs() < 1.0e-7 && down.y < 0.0, "{right} {down}");
    }

    /// The error for the documented example with `from` replaced by `to`.
    fn error_after_edit(from: &str, to: &str) -> String {
        assert!(documented().contains(from), "{from}");
        parse(&documented().replace(from, to)).expect_err(to).to_string()
    }

    #[test]
    fn bad_descriptions_are_refused_with_place_and_reason() {
        for (from, to, reasons) in [
            ("\"size\"", "size", &["line 3 column"][..]),
            ("\"size\"", "\"sizes\"", &["unknown field `sizes`", "line 3 column"]),
            ("\"schema\": 1,", "", &["missing field `schema`"]),
            ("\"schema\": 1", "\"schema\": 7", &["schema 7", "schema 1"]),
            ("[1280, 720]", "[1280, -1]", &["line 3 column"]),
            ("[1280, 720]", "[0, 720]", &["0×720", "1 to 16384"]),
            ("[1280, 720]", "[99999, 1]", &["99999×1", "1 to 16384"]),
            (
                "[1280, 720]",
                "[16384, 16384]",
                &["16384×16384", "67108864 pixels in all"],
            ),
            ("[1280, 720]", "[8192, 8192]", &["size", "5 layers", "smaller"]),
            (
                "[-0.125, -0.375]",
                "[-0.125, -0.625]",
                &["sample 0 is at [-0.125, -0.625]", "-0.5 to 0.5"],
            ),
            ("[-0.125, -0.375]", "[1e38, 0]", &["sample 0", "-0.5 to 0.5"]),
            // No f32 holds it, so it is no sample that could be named, but a place in the file.
            ("[-0.125, -0.375]", "[1e39, 0]", &["out of range", "line 4 column"]),
            (
                "[[-0.125, -0.375], [0.375, -0.125], [-0.375, 0.125], [0.125, 0.375]]",
                "[]",
                &["there are 0", "1 to 64"],
            ),
            ("\"centre\"", "{\"sample\": 4}", &["sample 4", "0 to 3"]),
            ("\"centre\"", "{\"samples\": [0, 4]}", &["sample 4", "0 to 3"]),
            ("\"centre\"", "{\"samples\": [1, 1]}", &["sample 1 twice"]),
            (
                "\"centre\"",
                "{\"samples\": [0, 1, 2]}",
                &["lists 3 samples", "two or four"],
            ),
            ("\"centre\"", "\"corner\"", &["corner", "line 5 column"]),
            ("\"near\"", "\"nearest\"", &["unknown field `nearest`", "line 9 column"]),
            (
                "\"vertical_fov\": 1.0472",
                "\"parallel_height\": -2.0",
                &["camera", "parallel_height is -2", "above 0"],
            ),
            ("\"vertical_fov\": 1.0472, ", "", &["camera", "angle is 0 radians"]),
            ("\"linear\"", "\"reversed-z\"", &["`reversed-z`", "`linear`"]),
        ] {
            let message = error_after_edit(from, to);
            assert!(
                message.contains("there/capture.json") || message.contains("there\\capture.json"),
                "{message}"
            );
            for reason in reasons {
                assert!(message.contains(reason), "{to}: {message:?} lacks {reason:?}");
            }
        }
    }
}
