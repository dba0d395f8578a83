//! Choice between candidates of a shader by their times on the device.

mod text;
mod timing;

use crate::{Bound, Error, Pass, PassOptions, Shader};
use std::path::Path;
use straightline_manifest::hash_of_text;
use wgpu::{Device, Queue};

/// Most bytes of a file of choices that are read.
const MAX_BYTES: u64 = 1 << 24;

/// A candidate of a shader: one of several texts that compute the same, such as `looped`.
#[derive(Clone, Copy, Debug)]
pub struct Candidate<'a> {
    /// Name of the candidate.
    pub name: &'a str,
    /// The candidate's shader.
    pub shader: &'a Shader<'a>,
}

/// The fastest candidates of shaders, by device: what was timed before, which a program can keep in a file and ship.
///
/// A [`choose`](Self::choose) times the candidates of a shader once for each GPU and version of its driver.
///
/// ```no_run
/// # use std::path::Path;
/// # use straightline_runtime::{Choices, Error, Candidate, Pass, PassOptions, wgpu};
/// # fn start(
/// #     device: &wgpu::Device, queue: &wgpu::Queue, candidates: &[Candidate<'_>], image: &wgpu::TextureView, target: &wgpu::TextureView,
/// # ) -> Result<Pass, Error> {
/// let file = Path::new("cache/choices.txt");
/// let mut choices = Choices::read(file).unwrap_or_default();
/// let chosen = choices.choose((device, queue), candidates, &PassOptions::default(), |pass| pass.bind(&[("image", image)], target))?;
/// choices.write(file)?;
/// # Ok(chosen.pass)
/// # }
/// ```
///
/// Generated code has this as `Pass::choose`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Choices {
    entries: Vec<Choice>,
}

/// The fastest candidate of a shader on a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The kernel's name.
    pub kernel: String,
    /// Hash of the texts of all candidates.
    hash: String,
    /// The GPU with its driver and version, as [`Choices::device_name`] has it; or all GPUs of a vendor, `vendor 10de`.
    pub device: String,
    /// Name of the fastest candidate.
    pub name: String,
    /// Median times of all candidates, for people: `default 0.213 ms, looped 0.410 ms`.
    pub times: String,
}

/// A pass of the candidate that was chosen.
#[derive(Debug)]
pub struct Chosen {
    /// The pass.
    pub pass: Pass,
    /// Name of the candidate.
    pub name: String,
    /// Origin of the choice.
    pub reason: Reason,
    /// Candidates that this device cannot run, each with its error. Empty if the choice was remembered.
    pub skipped: Vec<(String, Error)>,
}

/// Origin of a choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reason {
    /// The choice was remembered.
    Remembered,
    /// All candidates that the device can run were timed.
    Timed,
    /// There was nothing to time: the device can run one candidate only, or the program is in a browser, which does not wait.
    Untimed,
}

impl Choices {
    /// No choice yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Reads a file that [`write`](Self::write) wrote. Without a file there is no choice yet.
    ///
    /// # Errors
    ///
    /// [`Error::Read`] and [`Error::Choices`]. A program can go on with [`new`](Self::new): choices can be made again.
    pub fn read(path: &Path) -> Result<Self, Error> {
        match straightline_files::read_file(path, MAX_BYTES) {
            Ok(bytes) => String::from_utf8_lossy(&bytes).parse(),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(Self::new()),
            Err(error) => Err(Error::Read {
                path: path.to_owned(),
                source: error,
            }),
        }
    }

    /// Writes all choices to a file, which is replaced once everything is written. Creates its folder.
    ///
    /// # Errors
    ///
    /// [`Error::Write`].
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        Ok(straightline_files::write_file(path, self.to_string().as_bytes())?)
    }

    /// Adds the choices of `other` that are missing here, such as those that a program is shipped with.
    pub fn add(&mut self, other: Choices) {
        for choice in other.entries {
            if !self.entries.iter().any(|own| own.is_about_same(&choice)) {
                self.entries.push(choice);
            }
        }
    }

    /// All choices.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Choice> {
        self.entries.iter()
    }

    /// Name of a device in choices: GPU, backend, driver and its version.
    pub fn device_name(device: &Device) -> String {
        let info = device.adapter_info();
        let name = format!("{}, {}, {} {}", info.name, info.backend, info.driver, info.driver_info);
        name.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    /// Returns the remembered choice between these candidates on a device. One for the device itself precedes one for its vendor.
    pub fn find(&self, device: &Device, candidates: &[Candidate<'_>]) -> Option<&Choice> {
        let hash = hash_of_candidates(candidates);
        let of = |name: &str| self.entries.iter().find(|one| one.hash == hash && one.device == name);
        of(&Self::device_name(device)).or_else(|| of(&vendor_name(device.adapter_info().vendor)))
    }

    /// Makes the pass of the fastest candidate on this device: the remembered one, or else the fastest of all that the device can
    /// run, which is then remembered.
    ///
    /// To time the candidates, `bind` binds each to the same inputs and targets, of the size that matters. They run in turn for
    /// about a second, and at least three times. So the targets are written, and buffers that the kernel changes are changed
    /// several times. With the feature [`TIMESTAMP_QUERY`](wgpu::Features::TIMESTAMP_QUERY) the GPU measures, otherwise the
    /// clock does while nothing else should run. The first candidate is kept unless another one is more than 2 % faster.
    ///
    /// # Errors
    ///
    /// Errors of `bind`; the first candidate's error if the device can run no candidate; [`Error::DeviceLost`], [`Error::TimerRead`].
    pub fn choose(
        &mut self,
        (device, queue): (&Device, &Queue),
        candidates: &[Candidate<'_>],
        options: &PassOptions,
        mut bind: impl FnMut(&Pass) -> Result<Bound, Error>,
    ) -> Result<Chosen, Error> {
        let make = |candidate: &Candidate<'_>| Pass::from_shader(device, candidate.shader, options);
        let remembered = self
            .find(device, candidates)
            .and_then(|choice| candidates.iter().find(|candidate| candidate.name == choice.name));
        // A candidate that was made elsewhere may need a feature that this device was created without.
        if let Some(candidate) = remembered
            && let Ok(pass) = make(candidate)
        {
            return Ok(Chosen::new(pass, candidate, Reason::Remembered));
        }
        let (mut made, mut skipped) = (Vec::new(), Vec::new());
        for candidate in candidates {
            match make(candidate) {
                Ok(pass) => made.push((candidate, pass)),
                Err(error @ Error::DeviceLost { .. }) => return Err(error),
                Err(error) => skipped.push((candidate.name.to_owned(), error)),
            }
        }
        if made.is_empty() {
            let first = skipped.into_iter().next();
            return Err(first.map_or(Error::NoCandidates, |(_, error)| error));
        }
        let (at, reason) = if made.len() < 2 || cfg!(target_arch = "wasm32") {
            (0, Reason::Untimed)
        } else {
            let bound = made.iter().map(|(_, pass)| bind(pass)).collect::<Result<Vec<_>, _>>()?;
            let times = timing::time_in_turn(device, queue, &bound)?;
            let fastest = timing::find_fastest(&times);
            let names = made.iter().map(|(candidate, _)| candidate.name);
            self.remember(Choice {
                kernel: made[0].1.kernel().to_owned(),
                hash: hash_of_candidates(candidates),
                device: Self::device_name(device),
                name: made[fastest].0.name.to_owned(),
                times: text::list_times(names, &times),
            });
            (fastest, Reason::Timed)
        };
        let (candidate, pass) = made.swap_remove(at);
        Ok(Chosen {
            skipped,
            ..Chosen::new(pass, candidate, reason)
        })
    }

    /// Adds a choice for all GPUs of a vendor that have none of their own, replacing the vendor's earlier one. `vendor` is the
    /// number that wgpu has as `AdapterInfo::vendor`, `costs` is for people.
    pub fn add_for_vendor(&mut self, vendor: u32, candidates: &[Candidate<'_>], name: &str, costs: &str) {
        self.remember(Choice {
            kernel: candidates.first().map_or("", |first| first.shader.kernel()).to_owned(),
            hash: hash_of_candidates(candidates),
            device: vendor_name(vendor),
            name: name.to_owned(),
            times: costs.to_owned(),
        });
    }

    fn remember(&mut self, choice: Choice) {
        self.entries.retain(|own| !own.is_about_same(&choice));
        self.entries.push(choice);
    }
}

impl Choice {
    /// Returns whether both are about the same candidates on the same device.
    fn is_about_same(&self, other: &Choice) -> bool {
        (&self.hash, &self.device) == (&other.hash, &other.device)
    }
}

impl Chosen {
    fn new(pass: Pass, candidate: &Candidate<'_>, reason: Reason) -> Self {
        Chosen {
            pass,
            name: candidate.name.to_owned(),
            reason,
            skipped: Vec::new(),
        }
    }
}

/// Name of all GPUs of a vendor in choices.
fn vendor_name(vendor: u32) -> String {
    format!("vendor {vendor:04x}")
}

/// Hash of the names and texts of all candidates: a choice holds for these alone.
fn hash_of_candidates(candidates: &[Candidate<'_>]) -> String {
    let all = candidates
        .iter()
        .map(|candidate| format!("{} {:016x}\n", candidate.name, candidate.shader.hash));
    hash_of_text(&all.collect::<String>())
}
