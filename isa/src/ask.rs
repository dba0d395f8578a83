//! Asking a compiler in a process of its own.

use super::Gpu;
use super::drivers::{Drivers, FOLDER_VARIABLE, Missing};
use super::figures::Report;
use super::serve::{Answer, Request};
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, Stdio};
use std::thread::JoinHandle;
use thiserror::Error;

/// Reason why a compiler returns nothing.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum IsaError {
    /// Mesa's driver for the vendor's GPUs is not installed.
    #[error(
        "{gpu}: there is no Vulkan driver for GPUs of {}. Install {install}; or extract them to a folder, and set \
         {FOLDER_VARIABLE} to it", gpu.vendor_title()
    )]
    NoDriver {
        /// The GPU that was asked for.
        gpu: Gpu,
        /// Packages to install.
        install: &'static str,
    },
    /// The library that stands in for the kernel's part of the driver is not installed.
    #[error(
        "{gpu}: without the GPU the driver needs {shim}, which is not there. Install {install}; or extract them to a \
         folder, and set {FOLDER_VARIABLE} to it"
    )]
    NoShim {
        /// The GPU that was asked for.
        gpu: Gpu,
        /// Name of the library.
        shim: &'static str,
        /// Packages to install.
        install: &'static str,
    },
    /// The process could not be started, or it ended.
    #[error("the compiler for {0} cannot be asked: {1}")]
    Process(Gpu, std::io::Error),
    /// The driver has no such GPU.
    #[error("the driver does not compile for {0}: {1}")]
    Gpu(Gpu, String),
    /// The driver compiles for another GPU.
    #[error("the driver does not compile for {gpu}: its device is `{device}`")]
    OtherGpu {
        /// The GPU that was asked for.
        gpu: Gpu,
        /// The driver's name for the one that it has.
        device: String,
    },
    /// The driver of this machine's GPU reports nothing.
    #[error("the driver of this machine's GPU cannot be asked: {0}")]
    Device(String),
    /// The shader is refused.
    #[error("for {0}: {1}")]
    Shader(Gpu, String),
}

impl IsaError {
    /// Returns whether the reason holds for all GPUs of the vendor: something is not installed.
    pub fn is_of_vendor(&self) -> bool {
        matches!(self, IsaError::NoDriver { .. } | IsaError::NoShim { .. })
    }
}

/// A compiler for one GPU.
#[derive(Debug)]
pub struct Compiler {
    gpu: Gpu,
    device: String,
    process: Child,
    requests: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
    /// Reads what the driver says beside its answers.
    errors: Option<JoinHandle<String>>,
}

/// Most bytes of a driver's own words that are kept.
const MOST_WORDS: usize = 4096;

impl Compiler {
    /// Starts a compiler: `program` with `arguments` must call [`serve`](super::serve()). The driver is that of the folder in
    /// the environment variable `STRAIGHTLINE_DRIVERS`, or of this machine.
    ///
    /// # Errors
    ///
    /// There is no driver, it does not know the GPU, or the program cannot be started.
    pub fn start(program: &Path, arguments: &[&str], gpu: Gpu) -> Result<Compiler, IsaError> {
        Compiler::start_from(&Drivers::from_env(), program, arguments, gpu)
    }

    /// Starts a compiler with a driver from a stated place, otherwise as [`Compiler::start`].
    ///
    /// # Errors
    ///
    /// As [`Compiler::start`].
    pub fn start_from(drivers: &Drivers, program: &Path, arguments: &[&str], gpu: Gpu) -> Result<Compiler, IsaError> {
        let failed = |e| IsaError::Process(gpu, e);
        let mut command = match gpu.rows() {
            None => Command::new(program),
            Some((vendor, model)) => {
                let found = drivers.find(vendor).map_err(|missing| match missing {
                    Missing::Driver => IsaError::NoDriver {
                        gpu,
                        install: vendor.install,
                    },
                    Missing::Shim => IsaError::NoShim {
                        gpu,
                        shim: vendor.shim,
                        install: vendor.install,
                    },
                })?;
                found.command(program, vendor, model)
            }
        };
        // Ctrl-C is for the asking program, which keeps what it has.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut process = command
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(failed)?;
        let (requests, answers) = (process.stdin.take(), process.stdout.take());
        let errors = process.stderr.take();
        let answers = answers.ok_or_else(|| failed(std::io::ErrorKind::BrokenPipe.into()))?;
        let mut compiler = Compiler {
            gpu,
            device: String::new(),
            process,
            requests,
            answers: BufReader::new(answers),
            errors: errors.map(|errors| std::thread::spawn(move || read_end(errors))),
        };
        compiler.device = match compiler.read_answer()? {
            Answer::Device(name) => name,
            Answer::Error(why) if gpu == Gpu::DEVICE => return Err(IsaError::Device(why)),
            Answer::Error(why) => return Err(IsaError::Gpu(gpu, why)),
            Answer::Report(_) => return Err(failed(std::io::ErrorKind::InvalidData.into())),
        };
        let is_other = |says: &str| !compiler.device.to_uppercase().contains(&says.to_uppercase());
        match gpu.rows() {
            Some((_, model)) if is_other(model.says) => Err(IsaError::OtherGpu {
                gpu,
                device: compiler.device.clone(),
            }),
            _ => Ok(compiler),
        }
    }

    /// The driver's name for the GPU that is compiled for, and the driver's version.
    pub fn device(&self) -> &str {
        &self.device
    }

    /// The GPU that is compiled for.
    pub fn gpu(&self) -> Gpu {
        self.gpu
    }

    /// Compiles an entry point, compute or fragment, of a SPIR-V module.
    ///
    /// # Errors
    ///
    /// The driver refuses it, or ended.
    pub fn compile(&mut self, spirv: &[u8], entry: &str) -> Result<Report, IsaError> {
        let words = spirv.as_chunks::<4>().0.iter();
        let request = Request {
            words: words.map(|word| u32::from_le_bytes(*word)).collect(),
            entry: entry.to_owned(),
        };
        let gpu = self.gpu;
        let failed = |e| IsaError::Process(gpu, e);
        let line = serde_json::to_string(&request).map_err(|e| failed(e.into()))?;
        let requests = self
            .requests
            .as_mut()
            .ok_or_else(|| failed(std::io::ErrorKind::BrokenPipe.into()))?;
        if let Err(error) = writeln!(requests, "{line}").and_then(|()| requests.flush()) {
            return Err(self.explain_end(error));
        }
        match self.read_answer()? {
            Answer::Report(report) => Ok(report),
            Answer::Error(why) => Err(IsaError::Shader(gpu, why)),
            Answer::Device(_) => Err(failed(std::io::ErrorKind::InvalidData.into())),
        }
    }

    fn read_answer(&mut self) -> Result<Answer, IsaError> {
        let failed = |e| IsaError::Process(self.gpu, e);
        let mut line = String::new();
        match self.answers.read_line(&mut line) {
            Ok(0) => Err(self.explain_end(std::io::ErrorKind::UnexpectedEof.into())),
            Ok(_) => serde_json::from_str(&line).map_err(|e| failed(e.into())),
            Err(error) => Err(failed(error)),
        }
    }

    /// Error for a process that ended, with its last words.
    fn explain_end(&mut self, error: std::io::Error) -> IsaError {
        let said = self.errors.take().and_then(|reader| {
            self.requests.take();
            reader.join().ok()
        });
        let lines = || said.iter().flat_map(|said| said.lines()).map(str::trim);
        let is_error = |line: &&str| line.to_lowercase().contains("error");
        let last = lines().rfind(is_error).or(lines().rfind(|line| !line.is_empty()));
        let why = match last {
            Some(line) => format!("the driver ended: {line}"),
            None => format!("the driver ended without a word ({error}); this version of it may not know the GPU"),
        };
        IsaError::Process(self.gpu, std::io::Error::other(why))
    }
}

/// Reads to the end, and keeps the last bytes.
fn read_end(mut errors: ChildStderr) -> String {
    let (mut kept, mut buffer) = (Vec::new(), [0; 1024]);
    while let Ok(count @ 1..) = errors.read(&mut buffer) {
        kept.extend_from_slice(&buffer[..count]);
        let excess = kept.len().saturating_sub(MOST_WORDS);
        kept.drain(..excess);
    }
    String::from_utf8_lossy(&kept).into_owned()
}

impl Drop for Compiler {
    fn drop(&mut self) {
        // Closing the requests ends the process; this waits only for that.
        self.requests.take();
        let _ = self.process.wait();
    }
}
