//! Software drivers of Vulkan, and where their libraries lie.

use crate::open;
use ash::Entry;
use std::path::{Path, PathBuf};

/// A software driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Driver {
    /// Mesa's lavapipe.
    Lavapipe,
    /// Google's SwiftShader, which comes with Chromium.
    SwiftShader,
}

/// Folders of the manifests that name drivers' libraries: the loader's, and Chromium's.
const FOLDERS: [&str; 6] = [
    "/etc/vulkan/icd.d",
    "/usr/local/share/vulkan/icd.d",
    "/usr/share/vulkan/icd.d",
    "/usr/lib/chromium",
    "/usr/lib64/chromium-browser",
    "/usr/lib/chromium-browser",
];

impl Driver {
    /// All of them.
    pub const ALL: [Driver; 2] = [Driver::Lavapipe, Driver::SwiftShader];

    /// Beginning of the name of its manifest, and the package of Debian that has it.
    fn names(self) -> [&'static str; 2] {
        match self {
            Driver::Lavapipe => ["lvp_icd", "mesa-vulkan-drivers"],
            Driver::SwiftShader => ["vk_swiftshader_icd", "chromium"],
        }
    }

    /// The library that its manifest names.
    fn library(self) -> Result<PathBuf, String> {
        let [prefix, package] = self.names();
        let files = FOLDERS
            .iter()
            .flat_map(|folder| std::fs::read_dir(folder).into_iter().flatten().flatten());
        let found = files.map(|file| file.path()).find(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with(prefix) && name.ends_with(".json") && !name.contains("i686")
        });
        let manifest = found.ok_or_else(|| format!("no {self}: install Debian's {package}"))?;
        let failed = |e: &dyn std::fmt::Display| format!("{}: {e}", manifest.display());
        let text = std::fs::read_to_string(&manifest).map_err(|e| failed(&e))?;
        let json: serde_json::Value = serde_json::from_str(&text).map_err(|e| failed(&e))?;
        let library = json["ICD"]["library_path"].as_str();
        let library = library.ok_or_else(|| failed(&"names no library"))?;
        Ok(match library.contains('/') {
            // Relative to the manifest, unless it is absolute.
            true => manifest.parent().unwrap_or(Path::new("/")).join(library),
            false => PathBuf::from(library),
        })
    }

    /// Loads its library.
    ///
    /// # Errors
    ///
    /// It is not installed: what to install.
    pub(super) fn entry(self) -> Result<Entry, String> {
        open::entry(&self.library()?)
    }

    /// An adapter of wgpu on this driver alone, whatever other drivers the machine has.
    ///
    /// # Errors
    ///
    /// The driver is not installed, or has no device.
    pub fn adapter(self) -> Result<wgpu::Adapter, String> {
        open::adapter(self.entry()?).map_err(|e| format!("{self}: {e}"))
    }
}

impl std::fmt::Display for Driver {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Driver::Lavapipe => "lavapipe",
            Driver::SwiftShader => "SwiftShader",
        })
    }
}
