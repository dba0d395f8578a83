//! Methods made ready on a device, to be run and timed.

use super::methods::{Method, MethodKind};
use super::resolves;
use super::shot::Shot;
use super::{QualityError, check_stopped};
use crate::baselines::{Smaa, Transfer, apply_mlaa, fxaa_kernel};
use crate::progress::Progress;
use crate::turns::run_in_turn;
use glam::{UVec2, Vec3, Vec4, vec4};
use std::time::Instant;
use straightline_bench::execute::{Bench, ExecuteError, Inputs, Job, Timed, Uploaded, Work, texture_bytes};
use straightline_codegen::{Compiled, Kernel, Settings, Stage};
use straightline_kernels::OptionText;
use straightline_kernels::prelude::Frame;
use straightline_manifest::{BindingKind, Dimension, Manifest};
use straightline_runtime::Pass;
use straightline_scene::capture::{Capture, ShadingSample};
use straightline_scene::encode::NormalEncoding;
use straightline_scene::gbuffer;
use straightline_scene::picture;

/// Bytes of a pixel of full floats, which pictures are read and written in.
const PICTURE: u64 = 16;

/// Bytes that a geometry sample has where SRAA reads it: depth in one full float, a normal in four.
const GEOMETRY: u64 = 4 + 16;

enum Runner {
    /// Made of the samples that the renderer gives, after its definition; and what resolves the same samples on the device, to be
    /// timed, if anything does.
    Resolved(Vec<Shader>),
    /// The filter, which comes last, and before it the kernels that say where pixels are shaded, if it is placed, and which are once more.
    Kernel(Vec<Shader>),
    Smaa(Box<Smaa>),
    /// On the processor.
    Mlaa,
    /// The filter with a mask, and MLAA.
    Merged(Box<Shader>),
}

/// Area that a kernel is dispatched for.
#[derive(Clone, Copy)]
enum Area {
    Frame,
    /// A pixel a tile of 16×16.
    Tiles,
    /// A pixel a row of tiles, from sums of tiles.
    Rows,
    /// One pixel, from sums of rows of tiles.
    Whole,
}

impl Area {
    /// Returns the size of a target for a frame of `size`.
    fn target(self, size: UVec2) -> UVec2 {
        let tiles = size.map(|side| side.div_ceil(16));
        match self {
            Area::Frame => size,
            Area::Tiles => tiles,
            Area::Rows => UVec2::new(1, tiles.y),
            Area::Whole => UVec2::ONE,
        }
    }

    /// Returns the size of the sums that the kernel reads, if it reads sums.
    fn sums(self, size: UVec2) -> Option<UVec2> {
        match self {
            Area::Frame | Area::Tiles => None,
            Area::Rows => Some(Area::Tiles.target(size)),
            Area::Whole => Some(Area::Rows.target(size)),
        }
    }
}

/// Kernels that scale a guide, one after the other.
const FIT: [(&str, Area); 3] = [
    ("sraa_fit_sums", Area::Tiles),
    ("sraa_fit_rows", Area::Rows),
    ("sraa_fit", Area::Whole),
];

struct Shader {
    compiled: Compiled,
    area: Area,
    pass: Pass,
    manifest: Manifest,
}

/// Methods on a device.
pub struct Filters<'a> {
    bench: &'a Bench,
    methods: &'a [Method],
    runners: Vec<Runner>,
    /// Of each method, once a shot has been uploaded.
    bytes: Option<Vec<u64>>,
}

impl<'a> Filters<'a> {
    /// Compiles the kernels of all methods, for pictures of `size` pixels.
    pub fn new(
        bench: &'a Bench,
        methods: &'a [Method],
        size: UVec2,
        progress: &mut dyn Progress,
    ) -> Result<Filters<'a>, QualityError> {
        let mut runners = Vec::new();
        for method in methods {
            check_stopped(progress)?;
            runners.push(make_runner(bench, method, size)?);
            progress.step();
        }
        Ok(Filters {
            bench,
            methods,
            runners,
            bytes: None,
        })
    }

    /// The picture that method `k` makes of a shot, linear.
    pub fn filter_shot(&mut self, k: usize, shot: &Shot) -> Result<Frame<Vec4>, QualityError> {
        let method = &self.methods[k];
        match (&mut self.runners[k], method.kind) {
            (Runner::Smaa(smaa), _) => Ok(smaa.run(&display_picture(shot.any_capture()?))?),
            (Runner::Mlaa, _) => Ok(by_mlaa(&display_picture(shot.any_capture()?))),
            (Runner::Kernel(shaders), kind) => {
                let filter = shaders.last();
                let filter = filter.ok_or_else(|| QualityError::NotDrawn(method.name.clone()))?;
                let filtered = filter.filter_shot(self.bench, method, shot)?;
                Ok(match kind {
                    MethodKind::Fxaa(transfer) => transfer.decode_picture(&filtered),
                    _ => filtered,
                })
            }
            (Runner::Merged(shader), _) => {
                let filtered = shader.filter_shot(self.bench, method, shot)?;
                Ok(merge_mlaa(&filtered, shot.capture_for(method)?))
            }
            (Runner::Resolved(_), _) => resolves::resolve_picture(method, shot),
        }
    }

    /// Bytes that each method reads and writes of a shot, as they lie on the device. All shots have one size, so the first tells.
    ///
    /// Of what is no filter here: its samples' geometry as SRAA would read it and their colours, and the target.
    pub fn traffic_bytes(&mut self, shot: &Shot) -> Result<Vec<u64>, QualityError> {
        if self.bytes.is_none() {
            self.bytes = Some(self.count_bytes(shot)?);
        }
        Ok(self.bytes.clone().unwrap_or_default())
    }

    fn count_bytes(&self, shot: &Shot) -> Result<Vec<u64>, QualityError> {
        let size = shot.any_capture()?.size;
        let pixels = u64::from(size.x) * u64::from(size.y);
        let mut all = Vec::new();
        for (method, runner) in self.methods.iter().zip(&self.runners) {
            all.push(match (runner, method.kind) {
                (Runner::Smaa(smaa), _) => smaa.traffic_bytes(),
                (Runner::Kernel(shaders), _) => {
                    let each = shaders
                        .iter()
                        .map(|shader| shader.traffic_bytes(self.bench, method, shot));
                    each.sum::<Result<u64, _>>()?
                }
                (Runner::Mlaa, _) => 2 * PICTURE * pixels,
                (Runner::Merged(shader), _) => shader.traffic_bytes(self.bench, method, shot)? + 2 * PICTURE * pixels,
                (Runner::Resolved(_), MethodKind::Plain) => PICTURE * pixels,
                (Runner::Resolved(_), MethodKind::Supersampled(n)) => {
                    (n as u64 * (GEOMETRY + PICTURE) + PICTURE) * pixels
                }
                // Depth and normal of every sample, which of two aggregates it is of, and what is known of those.
                (Runner::Resolved(_), MethodKind::Aggregated) => {
                    let samples = gbuffer::pattern_offsets(method.pattern()).map_or(0, |samples| samples.len() as u64);
                    (samples * GEOMETRY + 2 * (GEOMETRY + PICTURE) + PICTURE) * pixels
                }
                // Four bits a sample say whose colour it has.
                (Runner::Resolved(_), MethodKind::Covered) => (4 * (GEOMETRY + PICTURE) + PICTURE + 8) * pixels,
                (Runner::Resolved(_), _) => (4 * (GEOMETRY + PICTURE) + PICTURE) * pixels,
            });
        }
        Ok(all)
    }

    /// Times all filters in turn on one shot. The second value says which shader of the first each method is.
    pub fn time_filters(
        &mut self,
        shot: &Shot,
        rounds: u32,
        progress: &mut dyn Progress,
    ) -> Result<(Timed, Vec<Option<usize>>), QualityError> {
        let mut uploads = Vec::new();
        for (method, runner) in self.methods.iter().zip(&mut self.runners) {
            let each = |shaders: &[Shader]| -> Result<Vec<_>, QualityError> {
                let shaders = shaders.iter();
                shaders
                    .map(|shader| shader.upload_shot(self.bench, method, shot))
                    .collect()
            };
            uploads.push(match runner {
                Runner::Kernel(shaders) => each(shaders)?,
                Runner::Merged(shader) => each(std::slice::from_ref(&**shader))?,
                Runner::Resolved(shaders) if shaders.is_empty() => Vec::new(),
                Runner::Resolved(shaders) => {
                    let inputs = resolves::resolve_inputs(method, shot)?;
                    let given = shaders.iter().zip(&inputs);
                    given
                        .map(|(shader, inputs)| Ok((inputs.size, self.bench.upload(&shader.manifest, inputs)?)))
                        .collect::<Result<_, QualityError>>()?
                }
                Runner::Smaa(smaa) => {
                    smaa.run(&display_picture(shot.any_capture()?))?;
                    Vec::new()
                }
                Runner::Mlaa => Vec::new(),
            });
        }
        let given = Transfer::Srgb.encode_picture(&display_picture(shot.any_capture()?));
        let (mut works, mut places): (Vec<Work<'_>>, Vec<Option<usize>>) = (Vec::new(), Vec::new());
        for (runner, uploads) in self.runners.iter_mut().zip(&uploads) {
            let work = match runner {
                Runner::Resolved(shaders) if shaders.is_empty() => {
                    places.push(None);
                    continue;
                }
                Runner::Kernel(shaders) | Runner::Resolved(shaders) => {
                    one_after_the_other(self.bench, shaders, uploads)?
                }
                Runner::Smaa(smaa) => Box::new(|| smaa.time_passes()),
                Runner::Merged(shader) => {
                    let mut filter = one_after_the_other(self.bench, std::slice::from_ref(&**shader), uploads)?;
                    let given = &given;
                    Box::new(move || {
                        let filtered = filter()?;
                        let start = Instant::now();
                        apply_mlaa(given);
                        Ok(filtered + start.elapsed())
                    })
                }
                Runner::Mlaa => Box::new(|| {
                    let start = Instant::now();
                    apply_mlaa(&given);
                    Ok(start.elapsed())
                }),
            };
            places.push(Some(works.len()));
            works.push(work);
        }
        let timed = run_in_turn(self.bench, &mut works, rounds, progress)?;
        drop(works);
        Ok((timed, places))
    }
}

fn make_runner(bench: &Bench, method: &Method, size: UVec2) -> Result<Runner, QualityError> {
    let kernel = match method.kind {
        MethodKind::Sraa | MethodKind::Merged => Kernel::builtin("sraa")?,
        MethodKind::Edge(name) => Kernel::builtin(name)?,
        MethodKind::Own => method
            .kernel
            .clone()
            .ok_or_else(|| QualityError::NotDrawn(method.name.clone()))?,
        MethodKind::Fxaa(_) => fxaa_kernel(),
        MethodKind::Mlaa => return Ok(Runner::Mlaa),
        MethodKind::Smaa(transfer) => return Ok(Runner::Smaa(Box::new(Smaa::new(bench, size, transfer)?))),
        MethodKind::Plain
        | MethodKind::Multisampled
        | MethodKind::Directional
        | MethodKind::Classified
        | MethodKind::Covered
        | MethodKind::Aggregated
        | MethodKind::Supersampled(_) => {
            let passes = resolves::resolve_kernels(method);
            let shaders = passes.iter().map(|kernel| Shader::new(bench, kernel, &[]));
            return Ok(Runner::Resolved(shaders.collect::<Result<_, _>>()?));
        }
    };
    let shader = Shader::new(bench, &kernel, method.options())?;
    Ok(match method.shading_sample() {
        _ if method.kind == MethodKind::Merged => Runner::Merged(Box::new(shader)),
        shading => {
            let mut shaders = Vec::new();
            if shading == ShadingSample::Placed {
                let placing = method.placing_options()?;
                shaders.push(Shader::new(bench, &Kernel::builtin("sraa_place")?, &placing)?);
            }
            if method.fits_guide() {
                for (name, area) in FIT {
                    shaders.push(Shader::of_area(bench, &Kernel::builtin(name)?, method.options(), area)?);
                }
            }
            if method.reads_guide() {
                for name in ["sraa_residual", "sraa_guide"] {
                    shaders.push(Shader::new(bench, &Kernel::builtin(name)?, method.options())?);
                }
            }
            if method.has_extra() {
                let listing = method.listing_options()?;
                shaders.push(Shader::new(bench, &Kernel::builtin("sraa_extra")?, &listing)?);
            }
            shaders.push(shader);
            Runner::Kernel(shaders)
        }
    })
}

/// Times passes that follow on each other, together.
fn one_after_the_other<'a>(
    bench: &Bench,
    shaders: &'a [Shader],
    uploads: &'a [(UVec2, Uploaded)],
) -> Result<Work<'a>, ExecuteError> {
    let jobs = shaders.iter().zip(uploads).map(|(shader, (size, uploaded))| Job {
        pass: &shader.pass,
        uploaded,
        size: *size,
    });
    bench.sequence_work(&jobs.collect::<Vec<_>>())
}

/// Filters a linear picture by MLAA.
fn by_mlaa(shown: &Frame<Vec4>) -> Frame<Vec4> {
    Transfer::Srgb.decode_picture(&apply_mlaa(&Transfer::Srgb.encode_picture(shown)))
}

/// A filtered picture, and MLAA's where a mask kept the pixel as it was shaded.
fn merge_mlaa(filtered: &Frame<Vec4>, capture: &Capture) -> Frame<Vec4> {
    let by_picture = by_mlaa(&display_picture(capture));
    let pixels = filtered
        .texels()
        .iter()
        .zip(capture.color.texels())
        .zip(by_picture.texels());
    let texels = pixels.map(|((filtered, own), by_picture)| match filtered == own {
        true => *by_picture,
        false => *filtered,
    });
    Frame::new(filtered.size(), texels.collect())
}

impl Shader {
    fn new(bench: &Bench, kernel: &Kernel, options: &[OptionText]) -> Result<Shader, QualityError> {
        Shader::of_area(bench, kernel, options, Area::Frame)
    }

    fn of_area(bench: &Bench, kernel: &Kernel, options: &[OptionText], area: Area) -> Result<Shader, QualityError> {
        let settings = Settings::new().set_all(options.to_vec());
        let compiled = kernel.compile(&settings)?;
        // A shader for the whole frame takes its frames to be as large as its targets.
        let emitted = bench.emit_options(Stage::Compute).region(matches!(area, Area::Tiles));
        let (pass, manifest) = bench.emit_pass(&compiled, &emitted)?;
        Ok(Shader {
            compiled,
            area,
            pass,
            manifest,
        })
    }

    fn traffic_bytes(&self, bench: &Bench, method: &Method, shot: &Shot) -> Result<u64, QualityError> {
        let (inputs, uploaded) = self.upload_inputs(bench, method, shot)?;
        let target = bench.create_target(inputs.size, self.pass.target_format());
        Ok(uploaded.byte_size() + texture_bytes(&target))
    }

    /// Filters a shot.
    fn filter_shot(&self, bench: &Bench, method: &Method, shot: &Shot) -> Result<Frame<Vec4>, QualityError> {
        let (size, uploaded) = self.upload_shot(bench, method, shot)?;
        Ok(bench.picture_of(&self.pass, &uploaded, size)?)
    }

    /// Uploads the method's inputs, to the device alone: as floats in memory they are several times as large.
    fn upload_shot(&self, bench: &Bench, method: &Method, shot: &Shot) -> Result<(UVec2, Uploaded), QualityError> {
        let (inputs, uploaded) = self.upload_inputs(bench, method, shot)?;
        Ok((inputs.size, uploaded))
    }

    fn upload_inputs(&self, bench: &Bench, method: &Method, shot: &Shot) -> Result<(Inputs, Uploaded), QualityError> {
        let capture = shot.capture_for(method)?;
        let mut inputs = match method.kind {
            _ if self.area.sums(capture.size).is_some() => Inputs::new(capture.size),
            MethodKind::Edge(_) => one_a_pixel(capture, &self.compiled)?,
            MethodKind::Fxaa(transfer) => of_the_picture(capture, transfer),
            MethodKind::Own => gbuffer_of(capture, &self.manifest)?,
            _ => match shot.extra_for(method) {
                None => gbuffer::sraa_inputs(capture, &self.compiled.options)?,
                Some(extra) => extra.sraa_inputs(capture, &self.compiled.options)?,
            },
        };
        if let Some(size) = self.area.sums(capture.size) {
            // Of a time, not of a picture: what the sums are does not matter.
            let sums = Frame::new(size, vec![Vec4::ONE; (size.x * size.y) as usize]);
            inputs = inputs.with_image("both", sums.clone()).with_image("own", sums);
        }
        inputs.size = self.area.target(capture.size);
        let uploaded = bench.upload(&self.manifest, &inputs)?;
        Ok((inputs, uploaded))
    }
}

fn of_the_picture(capture: &Capture, transfer: Transfer) -> Inputs {
    Inputs::new(capture.size).with_image("color", transfer.encode_picture(&display_picture(capture)))
}

/// The picture that a display is sent, which filters of pictures read: then their 16 bits, or whatever they compute in, give
/// back the bytes of what they do not change.
fn display_picture(capture: &Capture) -> Frame<Vec4> {
    picture::at_eight_bits(&capture.color)
}

/// Depth and normals where the picture was shaded. Normals as the filter's option says, with 8 bits if they are not floats.
/// Depth as a projection without a far plane stores it, reversed: what both edge filters are set for.
fn one_a_pixel(capture: &Capture, compiled: &Compiled) -> Result<Inputs, QualityError> {
    let layers = capture.shaded_layers();
    let [layer] = layers[..] else {
        return Err(QualityError::Capture(
            "the capture is shaded several times a pixel, and edge filters read one sample".to_owned(),
        ));
    };
    let missing =
        || QualityError::Capture("the capture has no normals (normal.exr), which edge filters need".to_owned());
    let normals = capture.normal.as_ref().ok_or_else(missing)?;
    let near = capture.camera.map_or(NEAR, |camera| camera.near);
    let depth = capture.depth.layers()[layer].texels().iter();
    let depth = depth.map(|z| Vec4::splat(near / z.max(near))).collect();
    let encoding = match compiled.options.choice("normals") {
        Some("unorm") => NormalEncoding::Rgb8,
        Some("octahedral") => NormalEncoding::Octahedral8,
        _ => NormalEncoding::Float,
    };
    let stored = |n: &Vec3| {
        let [x, y, z] = encoding.encode(n.to_array().map(f64::from)).map(|c| c as f32);
        vec4(x, y, z, 0.0)
    };
    let normal = normals.layers()[layer].texels().iter().map(stored).collect();
    Ok(Inputs::new(capture.size)
        .with_image("depth", Frame::new(capture.size, depth))
        .with_image("normal", Frame::new(capture.size, normal))
        .with_image("color", capture.color.clone()))
}

/// Returns the inputs of a kernel of the user's: the linear picture; depths along the view in the scene's units, and normals,
/// where the
/// picture was shaded, or of all samples if it reads layers.
fn gbuffer_of(capture: &Capture, manifest: &Manifest) -> Result<Inputs, QualityError> {
    let mut inputs = Inputs::new(capture.size);
    for binding in &manifest.bindings {
        let BindingKind::Texture { dimension, .. } = &binding.kind else {
            continue;
        };
        let layers = match dimension {
            Dimension::D2Array => (0..capture.samples.len()).collect(),
            _ => capture.shaded_layers().into_iter().take(1).collect::<Vec<usize>>(),
        };
        let frames: Option<Vec<Frame<Vec4>>> = match (binding.name.as_str(), &capture.normal) {
            ("color", _) => Some(vec![capture.color.clone()]),
            ("depth", _) => Some(of_layers(capture.depth.layers(), &layers, |z| Vec4::splat(*z))),
            ("normal", Some(normal)) => Some(of_layers(normal.layers(), &layers, |n| n.extend(0.0))),
            _ => None,
        };
        let frames = frames.ok_or_else(|| {
            let there = if capture.normal.is_some() {
                "`color`, `depth` and `normal`"
            } else {
                "`color` and `depth`"
            };
            QualityError::Capture(format!(
                "the kernel `{}` reads `{}`; what there is to read is {there}",
                manifest.kernel, binding.name
            ))
        })?;
        inputs.images.push((binding.name.clone(), frames));
    }
    Ok(inputs)
}

fn of_layers<T: Copy>(all: &[Frame<T>], chosen: &[usize], texel: impl Fn(&T) -> Vec4) -> Vec<Frame<Vec4>> {
    let frame = |k: &usize| Frame::new(all[*k].size(), all[*k].texels().iter().map(&texel).collect());
    chosen.iter().map(frame).collect()
}

/// Near plane of a capture that does not tell.
const NEAR: f32 = 0.1;
