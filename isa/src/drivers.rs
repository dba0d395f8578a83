//! Drivers of this machine, or of a folder of extracted packages.

use super::vendors::{Model, Vendor};
use std::env::consts::ARCH;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Environment variable with a folder of extracted packages.
pub const FOLDER_VARIABLE: &str = "STRAIGHTLINE_DRIVERS";

/// Folders that list drivers, by the loader's own rules, relative to the root.
const LISTS: [&str; 4] = [
    "etc/vulkan/icd.d",
    "usr/local/etc/vulkan/icd.d",
    "usr/local/share/vulkan/icd.d",
    "usr/share/vulkan/icd.d",
];

/// Names of other architectures in the names of manifests.
const ARCHITECTURES: [&str; 5] = ["x86_64", "i686", "i386", "aarch64", "armv7l"];

/// Place of drivers: a folder of extracted packages if there is one, then this machine.
#[derive(Clone, Debug)]
pub struct Drivers {
    folder: Option<PathBuf>,
    /// Root of this machine's files; tests have their own.
    pub(crate) root: PathBuf,
}

/// Driver of a vendor.
#[derive(Debug)]
pub(crate) struct Found {
    /// File that names the driver for Vulkan's loader.
    manifest: PathBuf,
    shim: Option<PathBuf>,
    /// Folders of the libraries, where they are not this machine's.
    libraries: Vec<PathBuf>,
    /// Program that loads libraries of the folder, C's among them.
    loader: Option<PathBuf>,
}

/// Reason why a vendor's compiler cannot be started.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Missing {
    Driver,
    Shim,
}

impl Drivers {
    /// Drivers of the folder in the environment variable `STRAIGHTLINE_DRIVERS`, and of this machine.
    pub fn from_env() -> Drivers {
        let folder = std::env::var_os(FOLDER_VARIABLE).filter(|folder| !folder.is_empty());
        Drivers {
            folder: folder.map(PathBuf::from),
            root: PathBuf::from("/"),
        }
    }

    /// Drivers of a folder into which packages were extracted, and of this machine.
    pub fn in_folder(folder: impl Into<PathBuf>) -> Drivers {
        Drivers {
            folder: Some(folder.into()),
            root: PathBuf::from("/"),
        }
    }

    /// Returns the driver of a vendor. One in the folder is preferred, if it can be told which GPU it shall compile for.
    pub(crate) fn find(&self, vendor: &Vendor) -> Result<Found, Missing> {
        let own = match &self.folder {
            None => Err(Missing::Driver),
            Some(folder) => find_below(folder, vendor, true),
        };
        match (own, find_below(&self.root, vendor, false)) {
            (Ok(found), _) | (_, Ok(found)) => Ok(found),
            (Err(Missing::Shim), _) | (_, Err(Missing::Shim)) => Err(Missing::Shim),
            (Err(Missing::Driver), Err(Missing::Driver)) => Err(Missing::Driver),
        }
    }
}

/// Folders of libraries, relative to the root.
fn library_folders() -> [String; 6] {
    let triple = format!("{ARCH}-linux-gnu");
    [
        format!("usr/lib/{triple}"),
        format!("lib/{triple}"),
        "usr/lib64".to_owned(),
        "lib64".to_owned(),
        "usr/lib".to_owned(),
        "lib".to_owned(),
    ]
}

fn find_below(root: &Path, vendor: &Vendor, is_extracted: bool) -> Result<Found, Missing> {
    let manifest = find_manifest(root, vendor).ok_or(Missing::Driver)?;
    let libraries: Vec<PathBuf> = library_folders().map(|folder| root.join(folder)).into();
    let find = |name: &str| {
        let mut all = libraries.iter().map(|folder| folder.join(name));
        all.find(|path| path.is_file())
    };
    let shim = find(vendor.shim);
    if shim.is_none() && vendor.forced.is_none() {
        return Err(Missing::Shim);
    }
    let loader = match ARCH {
        "aarch64" => "ld-linux-aarch64.so.1",
        _ => "ld-linux-x86-64.so.2",
    };
    Ok(Found {
        manifest,
        shim,
        loader: is_extracted.then(|| find(loader)).flatten(),
        libraries: if is_extracted { libraries } else { Vec::new() },
    })
}

fn find_manifest(root: &Path, vendor: &Vendor) -> Option<PathBuf> {
    let files = LISTS
        .iter()
        .flat_map(|list| std::fs::read_dir(root.join(list)).into_iter().flatten().flatten());
    let is_of_vendor = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let is_foreign = |other: &&&str| **other != ARCH && name.contains(**other);
        // `intel_hasvk_icd.json` is the driver of GPUs before Skylake.
        name.starts_with(&format!("{}_icd", vendor.manifest))
            && name.ends_with(".json")
            && ARCHITECTURES.iter().find(is_foreign).is_none()
    };
    let mut found: Vec<_> = files.map(|file| file.path()).filter(is_of_vendor).collect();
    found.sort();
    found.into_iter().next()
}

impl Found {
    /// Returns the command that runs a program whose driver compiles for a GPU.
    pub(crate) fn command(&self, program: &Path, vendor: &Vendor, model: &Model) -> Command {
        let libraries = join_paths(&self.libraries);
        let mut command = match &self.loader {
            None => Command::new(program),
            Some(loader) => {
                let mut command = Command::new(loader);
                command.arg("--library-path").arg(&libraries);
                if let Some(shim) = &self.shim {
                    command.arg("--preload").arg(shim);
                }
                command.arg(program);
                command
            }
        };
        if self.loader.is_none() {
            if !self.libraries.is_empty() {
                command.env("LD_LIBRARY_PATH", &libraries);
            }
            if let Some(shim) = &self.shim {
                command.env("LD_PRELOAD", shim);
            }
        }
        match (&self.shim, vendor.forced) {
            (None, Some(variable)) => drop(command.env(variable, model.value)),
            (Some(_), _) if !vendor.variable.is_empty() => drop(command.env(vendor.variable, model.value)),
            _ => {}
        }
        command
            .envs(vendor.further.iter().copied())
            .env("VK_DRIVER_FILES", &self.manifest)
            .env("VK_ICD_FILENAMES", &self.manifest)
            .env("MESA_SHADER_CACHE_DISABLE", "true");
        command
    }
}

fn join_paths(paths: &[PathBuf]) -> OsString {
    let existing = paths.iter().filter(|path| path.is_dir());
    std::env::join_paths(existing).unwrap_or_default()
}
