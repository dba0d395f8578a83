//! The forms of a kernel: compiled, and on a device.

use super::{LoopsError, Subject};
use crate::record::FormKind;
use std::rc::Rc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};
use straightline_bench::execute::{Bench, Inputs, Uploaded, Uploads};
use straightline_codegen::diagnostic::Errors;
use straightline_codegen::emit::{Emitted, Target};
use straightline_codegen::ir::print;
use straightline_codegen::{Compiled, EmitOptions, Format, Math, Precision, ReadOrder, Settings, Share, Stage, Unroll};
use straightline_runtime::{Pass, PassOptions};

/// A kernel in every available form, looped first, and the reasons for missing forms.
pub struct Forms {
    /// The form with all loops unrolled; also contained in `made`.
    pub full: Compiled,
    /// Forms that compile.
    pub made: Vec<(FormKind, Compiled)>,
    /// Missing forms, with the reason.
    pub absent: Vec<(FormKind, String)>,
}

impl Forms {
    /// Compiles a kernel in every form; `half` is `true` if the device has half precision.
    ///
    /// # Errors
    ///
    /// If the kernel is invalid, looped or unrolled, or its hand-written version is.
    pub fn from_subject(subject: &Subject, half: bool) -> Result<Forms, Errors> {
        let settings = |unroll| Settings::new().unroll(unroll).set_all(subject.options.clone());
        let unrolled = || settings(Unroll::Full);
        let full = subject.kernel.compile(&unrolled())?;
        let looped = subject.kernel.compile(&settings(Unroll::None))?;
        let has_loops = looped.in_blocks().counts.loops > 0;
        let message = |errors: Errors| errors.first_message().to_owned();
        let compile = |settings: Settings| subject.kernel.compile(&settings).map_err(message);
        // Forms that are another one under another name are left out.
        let unless = |compiled: Result<Compiled, String>, is_same: &dyn Fn(&Compiled) -> bool, why: &str| {
            compiled.and_then(|compiled| {
                if is_same(&compiled) {
                    Err(why.to_owned())
                } else {
                    Ok(compiled)
                }
            })
        };
        let (mut made, mut absent) = (Vec::new(), Vec::new());
        for kind in FormKind::ALL {
            let outcome: Result<Compiled, String> = match kind {
                FormKind::LoopedUnchecked | FormKind::Partial2 | FormKind::Partial4 if !has_loops => {
                    Err("no loop of it can be left in the shader".to_owned())
                }
                FormKind::Looped | FormKind::LoopedUnchecked => Ok(looped.clone()),
                FormKind::LoopedByHand | FormKind::LoopedByHandUnchecked => match &subject.by_hand {
                    Err(why) => Err(why.clone()),
                    Ok(by_hand) => {
                        let settings = Settings::new().unroll(Unroll::None).set_all(by_hand.options.clone());
                        Ok(by_hand.kernel.compile(&settings)?)
                    }
                },
                FormKind::Partial2 => compile(settings(Unroll::Partial(2))),
                FormKind::Partial4 => compile(settings(Unroll::Partial(4))),
                FormKind::FullUnshared => unless(
                    compile(unrolled().repeat_loads(true)),
                    &|unshared| read_count(unshared) == read_count(&full),
                    "the source asks for each read once, as the full form does",
                ),
                FormKind::Full => Ok(full.clone()),
                FormKind::FullBlock => compile(unrolled().block(2, 2)),
                FormKind::FullTile => compile(unrolled().share(Share::WORKGROUP)),
                FormKind::FullGather => unless(
                    compile(unrolled().reads(ReadOrder::Gather)),
                    &|compiled| compiled.gathered.is_empty(),
                    "no four texels of one component are read together",
                ),
                FormKind::FullFast => unless(
                    compile(unrolled().math(Math::Fast)),
                    &|fast| print(&fast.graph) == print(&full.graph),
                    "fast mathematics has nothing to do in it",
                ),
                FormKind::FullHalf if !half => Err("the device has no half precision (SHADER_F16)".to_owned()),
                FormKind::FullHalf => match full.emit(&emit_options(kind)) {
                    Ok(_) => Ok(full.clone()),
                    Err(errors) => Err(message(errors)),
                },
                FormKind::Floor => full.floor().map_err(message),
                FormKind::Slang => continue,
            };
            match outcome {
                Ok(compiled) => made.push((kind, compiled)),
                Err(why) => absent.push((kind, why)),
            }
        }
        Ok(Forms { full, made, absent })
    }
}

/// Returns the number of texture and buffer reads of one compute invocation.
fn read_count(compiled: &Compiled) -> u32 {
    compiled.in_blocks().counts.reads.values().sum()
}

/// Returns the way in which a form is written.
pub fn emit_options(kind: FormKind) -> EmitOptions {
    EmitOptions::new()
        .stage(Stage::Compute)
        .format(Format::Rgba32Float)
        .unbounded_loops(kind.is_unbounded())
        .precision(match kind {
            FormKind::FullHalf => Precision::F16,
            _ => Precision::F32,
        })
        .accept_loss(true)
        .targets([Target::Wgsl, Target::Spirv])
}

/// Beginning of every compute shader: invocations beyond the border return.
const BORDER: &str = "if any(pixel >= frame) {";

/// Beginning of compute shaders whose workgroups share memory: all invocations go on, and those beyond the border store
/// nothing.
const INSIDE: &str = "let inside = all(pixel < frame);";

/// Returns the shader with a unique text, so that no driver has it in a cache: invocations in a column beyond any picture
/// count as outside the border, too.
fn make_uncached(emitted: &Emitted) -> Emitted {
    static MADE: AtomicU32 = AtomicU32::new(0);
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    let number = (now.as_nanos() as u32).wrapping_add(MADE.fetch_add(1, Ordering::Relaxed));
    let column = (1 << 30) | (number >> 2);
    let mut unseen = emitted.clone();
    if let Some(wgsl) = unseen.files.get_mut(&Target::Wgsl) {
        let text = String::from_utf8_lossy(wgsl);
        let other = format!("if any(pixel >= frame) || pixel.x == {column} {{");
        let inside = format!("let inside = all(pixel < frame) && pixel.x != {column};");
        let text = text.replacen(BORDER, &other, 1).replacen(INSIDE, &inside, 1);
        *wgsl = text.into_bytes();
        // The hashes are those of the original text.
        unseen.manifest.hashes.clear();
    }
    unseen
}

/// A form on a device.
pub struct Ready {
    /// Kind of the form.
    pub kind: FormKind,
    /// The emitted shader.
    pub emitted: Emitted,
    /// The shader.
    pub pass: Pass,
    /// Inputs of the shader.
    pub uploaded: Rc<Uploaded>,
    /// Creation time of the pipeline and time of the first frame, for each time that the shader was created with a unique
    /// text.
    pub made: Vec<(Duration, Duration)>,
}

impl Ready {
    /// Returns the hash of the WGSL.
    pub fn hash(&self) -> Option<String> {
        self.emitted.manifest.hashes.get("wgsl").cloned()
    }

    /// Returns the size of the SPIR-V in bytes.
    pub fn spirv_bytes(&self) -> usize {
        self.emitted.files.get(&Target::Spirv).map_or(0, Vec::len)
    }

    /// Returns the milliseconds until the shader was ready: pipeline creation, plus the excess of the first frame over a
    /// frame of `frame_ms`, because software drivers compile only then. The median over all creations.
    pub fn pipeline_ms(&self, frame_ms: f64) -> f64 {
        let ms = |d: &Duration| d.as_secs_f64() * 1e3;
        let mut all: Vec<f64> = self
            .made
            .iter()
            .map(|(pipeline, frame)| ms(pipeline) + (ms(frame) - frame_ms).max(0.0))
            .collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(0.0)
    }
}

/// Uploads the forms of one kernel to a device; shared inputs are uploaded once.
pub struct Stand<'a> {
    bench: &'a Bench,
    inputs: &'a Inputs,
    uploads: Uploads<'a>,
}

impl<'a> Stand<'a> {
    /// Creates a stand without forms.
    pub fn new(bench: &'a Bench, inputs: &'a Inputs) -> Self {
        Stand {
            bench,
            inputs,
            uploads: Uploads::new(bench, inputs),
        }
    }

    /// Emits and creates a form, after creating it `times` times with unique texts, each up to its first frame.
    ///
    /// # Errors
    ///
    /// If it cannot be emitted or run.
    pub fn prepare_form(&mut self, kind: FormKind, compiled: &Compiled, times: u32) -> Result<Ready, LoopsError> {
        let emitted = compiled
            .emit(&emit_options(kind))
            .map_err(straightline_bench::execute::ExecuteError::from)?;
        let options = PassOptions::default().unbounded_loops(kind.is_unbounded());
        let mut made = Vec::new();
        for _ in 0..times.max(1) {
            let unseen = make_uncached(&emitted);
            let pass = self.bench.create_pass(&unseen, &options)?;
            let uploaded = self.uploads.upload_shared(&unseen.manifest)?;
            let first = self.time_frame(&pass, &uploaded)?;
            made.push((pass.creation_time(), first));
        }
        let pass = self.bench.create_pass(&emitted, &options)?;
        let uploaded = self.uploads.upload_shared(&emitted.manifest)?;
        Ok(Ready {
            kind,
            emitted,
            pass,
            uploaded,
            made,
        })
    }

    /// Returns the duration of a frame, by the wall clock.
    fn time_frame(&self, pass: &Pass, uploaded: &Uploaded) -> Result<Duration, LoopsError> {
        let bench = self.bench;
        let target = bench.create_target(self.inputs.size, pass.target_format());
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = bench
            .device()
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let bound = uploaded
            .bind(pass, &view)
            .map_err(straightline_bench::execute::ExecuteError::from)?;
        bound.encode(&mut encoder);
        // Earlier writes must not be part of the measured time.
        bench.wait()?;
        let start = Instant::now();
        bench.queue().submit([encoder.finish()]);
        bench.wait()?;
        Ok(start.elapsed())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use straightline_codegen::Kernel;

    #[test]
    fn a_text_is_unseen_each_time() {
        let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    \
                    let next = color.load(pixel + ivec2(0, 1)) + color.load(pixel + ivec2(1, 0));\n    \
                    color.load(pixel) * 0.5 + next\n}\n";
        for (block, share) in [
            ([1, 1], Share::Invocation),
            ([2, 2], Share::Invocation),
            ([1, 1], Share::WORKGROUP),
        ] {
            let settings = Settings::new().block(block[0], block[1]).share(share);
            let compiled = Kernel::from_text("k.rs", text, "k")
                .compile(&settings)
                .expect("a kernel");
            let emitted = compiled.emit(&EmitOptions::new()).expect("a shader");
            let wgsl = |emitted: &Emitted| emitted.files.get(&Target::Wgsl).cloned();
            let (first, second) = (make_uncached(&emitted), make_uncached(&emitted));
            assert!(
                wgsl(&first) != wgsl(&emitted) && wgsl(&first) != wgsl(&second),
                "{block:?}, {share}"
            );
        }
    }
}
