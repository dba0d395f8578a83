//! Kernels that are generated again when their files change, while the program runs.

use crate::bound::Work;
use crate::pipeline::Pipeline;
use crate::plan::Plan;
use crate::{Bound, Error, Pass, PassOptions, Pending, Shader};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, SystemTime};
use straightline_codegen::KernelConfig;
use straightline_codegen::spec::DebugInfo;
use web_time::Instant;
use wgpu::Device;

/// Time between two looks at the files.
const INTERVAL: Duration = Duration::from_millis(100);

/// A pass whose kernel is generated again when one of its files changes.
///
/// Generator and driver run on another thread, and the old pass stays until the new one is there. It also stays if the
/// kernel has an error, or if it binds other resources than before.
///
/// ```no_run
/// use straightline_runtime::{Bound, Error, KernelConfig, PassOptions, Reloading, wgpu};
///
/// struct Glow {
///     reloading: Reloading,
///     bound: Bound,
/// }
///
/// impl Glow {
///     fn new(device: &wgpu::Device, [color, target]: [&wgpu::TextureView; 2]) -> Result<Self, Error> {
///         let config = KernelConfig::from_file("src/kernels/glow.rs").set("radius", 4);
///         let reloading = Reloading::new(device, config, &PassOptions::default())?;
///         let bound = reloading.pass().bind(&[("color", color)], target)?;
///         Ok(Glow { reloading, bound })
///     }
///
///     fn frame(&mut self, encoder: &mut wgpu::CommandEncoder) -> Result<(), Error> {
///         match self.reloading.poll() {
///             Ok(true) => self.reloading.renew(&mut self.bound)?,
///             Ok(false) => {}
///             Err(error) => eprintln!("{error}"),
///         }
///         self.bound.encode(encoder);
///         Ok(())
///     }
/// }
/// ```
#[derive(Debug)]
pub struct Reloading {
    device: Device,
    config: KernelConfig,
    options: PassOptions,
    pass: Pass,
    /// Plans of all passes that there were, by which their bindings are known.
    plans: Vec<Arc<Plan>>,
    interval: Duration,
    looked: Instant,
    /// Of each file, when its contents were last read.
    stamps: Vec<Option<Stamp>>,
    making: Option<Pending<Pass>>,
}

/// Time of modification and length; `None` of a file that is not there.
type Stamp = (SystemTime, u64);

impl Reloading {
    /// Generates the shader and makes its pass. Waits for both.
    ///
    /// # Errors
    ///
    /// [`Error::Generate`] for an error of the kernel; a chain and a set of variants are refused. Those of
    /// [`Pass::from_shader`].
    pub fn new(device: &Device, config: KernelConfig, options: &PassOptions) -> Result<Self, Error> {
        // Errors of wgpu then name the place in the kernel.
        let config = config.debug(DebugInfo::Map);
        let stamps = config.files().map(read_stamp).collect();
        let pass = make_pass(device, &config, options, None)?;
        Ok(Reloading {
            device: device.clone(),
            options: options.clone(),
            plans: vec![Arc::clone(&pass.plan)],
            pass,
            interval: INTERVAL,
            looked: Instant::now(),
            stamps,
            making: None,
            config,
        })
    }

    /// Looks at the files no more often than this; every 100 ms by default.
    pub fn interval(mut self, interval: Duration) -> Self {
        self.interval = interval;
        self
    }

    /// The pass that there is now.
    pub fn pass(&self) -> &Pass {
        &self.pass
    }

    /// Looks for a change, once a frame, and returns `true` if the pass has been replaced. Then
    /// [`renew`](Self::renew) each [`Bound`] of it. It does not wait: a pass that is being made is there in a later call.
    ///
    /// # Errors
    ///
    /// Once for each change: [`Error::Generate`] with the generator's message; [`Error::Changed`] if inputs, uniforms or
    /// targets are not those of the pass; those of [`Pass::from_shader`]. The pass stays.
    pub fn poll(&mut self) -> Result<bool, Error> {
        if let Some(making) = &mut self.making {
            let Some(made) = making.poll() else { return Ok(false) };
            self.making = None;
            self.pass = made?;
            self.plans.push(Arc::clone(&self.pass.plan));
            return Ok(true);
        }
        if self.looked.elapsed() < self.interval {
            return Ok(false);
        }
        self.looked = Instant::now();
        // Before the files are read: a change in between is seen by the next look.
        let stamps: Vec<Option<Stamp>> = self.config.files().map(read_stamp).collect();
        if stamps != self.stamps {
            self.stamps = stamps;
            let (device, config, options) = (self.device.clone(), self.config.clone(), self.options.clone());
            let plan = Arc::clone(&self.pass.plan);
            self.making = Some(Pending::start(move || {
                make_pass(&device, &config, &options, Some(&plan))
            }));
        }
        Ok(false)
    }

    /// Lets `bound` record the pass that there is now, with the inputs, targets and uniforms that it has.
    ///
    /// Values of uniforms stay as they were written, also where the kernel's defaults have changed.
    ///
    /// # Errors
    ///
    /// [`Error::NotOurs`] if another pass than one of this `Reloading` was bound. Nothing has changed then.
    pub fn renew(&self, bound: &mut Bound) -> Result<(), Error> {
        if !self.plans.iter().any(|plan| Arc::ptr_eq(plan, &bound.plan)) {
            return Err(Error::NotOurs {
                kernel: self.pass.kernel().to_owned(),
                bound: bound.kernel().to_owned(),
            });
        }
        bound.plan = Arc::clone(&self.pass.plan);
        match (&mut bound.work, &self.pass.pipeline) {
            (Work::Compute { pipeline, .. }, Pipeline::Compute { pipeline: new, .. }) => *pipeline = new.clone(),
            (Work::Draw { pipeline, .. }, Pipeline::Render(new)) => *pipeline = new.clone(),
            // Another stage is a change that was refused.
            _ => {}
        }
        Ok(())
    }
}

/// Generates a shader and makes its pass, if it binds what `plan` does.
fn make_pass(
    device: &Device,
    config: &KernelConfig,
    options: &PassOptions,
    plan: Option<&Plan>,
) -> Result<Pass, Error> {
    let emitted = config.emit().map_err(|error| Error::Generate {
        message: error.to_string(),
    })?;
    let (manifest, wgsl) = (&emitted.manifest, emitted.wgsl());
    let shader = match emitted.source_map.clone() {
        Some(map) => Shader::with_source_map(manifest, wgsl, map)?,
        None => Shader::from_manifest(manifest, wgsl)?,
    };
    if let Some(change) = plan.and_then(|plan| plan.find_layout_difference(&shader.plan)) {
        return Err(Error::Changed {
            kernel: shader.kernel().to_owned(),
            change,
        });
    }
    Pass::from_shader(device, &shader, options)
}

fn read_stamp(path: &Path) -> Option<Stamp> {
    let metadata = std::fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}
