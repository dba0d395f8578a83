//! Asking a compiler in a process of its own.

use super::Family;
use super::figures::Report;
use super::serve::{Answer, Request};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use thiserror::Error;

/// Reason why a compiler returns nothing.
#[derive(Debug, Error)]
pub enum IsaError {
    /// Mesa's driver for AMD GPUs is not installed.
    #[error("no Vulkan driver for AMD GPUs; on Debian: apt-get install libvulkan1 mesa-vulkan-drivers")]
    NoDriver,
    /// The process could not be started, or it ended.
    #[error("the compiler for {0} cannot be asked: {1}")]
    Process(Family, std::io::Error),
    /// The driver has no such GPU.
    #[error("the driver does not compile for {0}: {1}")]
    Family(Family, String),
    /// The driver of this machine's GPU reports nothing.
    #[error("the driver of this machine's GPU cannot be asked: {0}")]
    Device(String),
    /// The shader is refused.
    #[error("for {0}: {1}")]
    Shader(Family, String),
}

/// A compiler for one family of GPUs.
#[derive(Debug)]
pub struct Compiler {
    family: Family,
    device: String,
    process: Child,
    requests: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

/// Folders that list drivers, by the loader's own rules.
const LISTS: [&str; 4] = [
    "/etc/vulkan/icd.d",
    "/usr/local/etc/vulkan/icd.d",
    "/usr/local/share/vulkan/icd.d",
    "/usr/share/vulkan/icd.d",
];

/// The file that names Mesa's driver for AMD GPUs.
fn find_driver() -> Option<PathBuf> {
    let files = LISTS
        .iter()
        .flat_map(|list| std::fs::read_dir(list).into_iter().flatten().flatten());
    let mut found: Vec<_> = files
        .map(|file| file.path())
        .filter(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            name.starts_with("radeon_icd") && name.ends_with(".json") && !name.contains("i686")
        })
        .collect();
    found.sort();
    found.into_iter().next()
}

impl Compiler {
    /// Starts a compiler: `program` with `arguments` must call [`serve`](super::serve()).
    ///
    /// # Errors
    ///
    /// There is no driver, it does not know the family, or the program cannot be started.
    pub fn start(program: &Path, arguments: &[&str], family: Family) -> Result<Compiler, IsaError> {
        let failed = |e| IsaError::Process(family, e);
        let mut command = Command::new(program);
        if family != Family::Device {
            let driver = find_driver().ok_or(IsaError::NoDriver)?;
            command
                .env("RADV_FORCE_FAMILY", family.name())
                .env("VK_DRIVER_FILES", &driver)
                .env("VK_ICD_FILENAMES", &driver)
                .env("MESA_SHADER_CACHE_DISABLE", "true");
        }
        // Ctrl-C is for the asking program, which keeps what it has.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut process = command
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(failed)?;
        let (requests, answers) = (process.stdin.take(), process.stdout.take());
        let answers = answers.ok_or_else(|| failed(std::io::ErrorKind::BrokenPipe.into()))?;
        let mut compiler = Compiler {
            family,
            device: String::new(),
            process,
            requests,
            answers: BufReader::new(answers),
        };
        compiler.device = match compiler.read_answer()? {
            Answer::Device(name) => name,
            Answer::Error(why) if family == Family::Device => return Err(IsaError::Device(why)),
            Answer::Error(why) => return Err(IsaError::Family(family, why)),
            Answer::Report(_) => return Err(failed(std::io::ErrorKind::InvalidData.into())),
        };
        Ok(compiler)
    }

    /// The GPU that is compiled for, and the driver's version.
    pub fn device(&self) -> &str {
        &self.device
    }

    /// The family that is compiled for.
    pub fn family(&self) -> Family {
        self.family
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
        let failed = |e| IsaError::Process(self.family, e);
        let line = serde_json::to_string(&request).map_err(|e| failed(e.into()))?;
        let requests = self
            .requests
            .as_mut()
            .ok_or_else(|| failed(std::io::ErrorKind::BrokenPipe.into()))?;
        writeln!(requests, "{line}")
            .and_then(|()| requests.flush())
            .map_err(failed)?;
        match self.read_answer()? {
            Answer::Report(report) => Ok(report),
            Answer::Error(why) => Err(IsaError::Shader(self.family, why)),
            Answer::Device(_) => Err(IsaError::Process(self.family, std::io::ErrorKind::InvalidData.into())),
        }
    }

    fn read_answer(&mut self) -> Result<Answer, IsaError> {
        let failed = |e| IsaError::Process(self.family, e);
        let mut line = String::new();
        if self.answers.read_line(&mut line).map_err(failed)? == 0 {
            return Err(failed(std::io::Error::other(
                "the driver ended; this version of it may not know the family",
            )));
        }
        serde_json::from_str(&line).map_err(|e| failed(e.into()))
    }
}

impl Drop for Compiler {
    fn drop(&mut self) {
        // Closing the requests ends the process; this waits only for that.
        self.requests.take();
        let _ = self.process.wait();
    }
}
