//! Pipeline caches in files.

use crate::Error;
use crate::guard::run_scoped;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use straightline_manifest::{hash_of_bytes, hash_of_text};
use wgpu::{Device, PipelineCache, PipelineCacheDescriptor};

/// Most bytes of a file that is read.
const MAX_BYTES: u64 = 1 << 28;

/// Hexadecimal digits before the data: their hash, which wgpu's own header lacks.
const HASH_DIGITS: usize = 16;

/// A [`wgpu::PipelineCache`] that is read from a file and saved to it, so that the driver need not compile again what it
/// compiled in an earlier run.
///
/// It needs Vulkan, and a device with the feature [`PIPELINE_CACHE`](wgpu::Features::PIPELINE_CACHE). Everywhere else
/// [`cache`](Self::cache) is `None`, and passes are made without one. A file that is damaged or of another driver is
/// replaced by an empty cache, and [`origin`](Self::origin) has the reason.
///
/// ```no_run
/// # use straightline_runtime::{Error, Pass, PassOptions, PipelineCacheFile, Shader, wgpu::Device};
/// # #[allow(unsafe_code)]
/// fn make(device: &Device, shader: &Shader<'_>, folder: &std::path::Path) -> Result<Pass, Error> {
///     // SAFETY: only this program writes to its own cache folder.
///     let file = unsafe { PipelineCacheFile::open(device, folder) };
///     let pass = Pass::from_shader(device, shader, &PassOptions::default().pipeline_cache(file.cache()))?;
///     file.save()?;
///     Ok(pass)
/// }
/// ```
#[derive(Debug)]
pub struct PipelineCacheFile {
    /// The cache with its file; `None` where there are no caches.
    cache: Option<(PipelineCache, PathBuf)>,
    origin: CacheOrigin,
}

/// Origin of the cache of a [`PipelineCacheFile`].
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CacheOrigin {
    /// There is no cache, because the device has none.
    Unavailable {
        /// Reason.
        reason: String,
    },
    /// The cache started empty, because there was no file.
    New,
    /// The cache holds the data of the file.
    File,
    /// The cache started empty, because the file cannot be used. [`PipelineCacheFile::save`] replaces the file.
    Replaced {
        /// Reason.
        reason: String,
    },
}

/// For a log: ``new pipeline cache: the file cannot be used: it is damaged``.
impl fmt::Display for CacheOrigin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CacheOrigin::Unavailable { reason } => write!(f, "no pipeline cache: {reason}"),
            CacheOrigin::New => f.write_str("new pipeline cache: there is no file yet"),
            CacheOrigin::File => f.write_str("pipeline cache of the file"),
            CacheOrigin::Replaced { reason } => write!(f, "new pipeline cache: the file cannot be used: {reason}"),
        }
    }
}

impl PipelineCacheFile {
    /// Opens the cache for the driver of `device` in `folder`, which need not exist. The file's name holds the GPU and a
    /// hash of the driver's name and version, so that several can share a folder.
    ///
    /// Never fails: [`origin`](Self::origin) tells what was found.
    ///
    /// # Safety
    ///
    /// Files of this name in `folder` must have been written by [`save`](Self::save). Their hash and wgpu's header
    /// reveal damage and files of other drivers, but not forgery, and a driver may trust the data. Use a folder that
    /// only this user can write to, not a shared temporary folder.
    #[allow(unsafe_code)]
    pub unsafe fn open(device: &Device, folder: &Path) -> Self {
        let unavailable = |reason: &str| PipelineCacheFile {
            cache: None,
            origin: CacheOrigin::Unavailable {
                reason: reason.to_owned(),
            },
        };
        let info = device.adapter_info();
        let Some(key) = wgpu::util::pipeline_cache_key(&info) else {
            return unavailable("only Vulkan has pipeline caches");
        };
        if !device.features().contains(wgpu::Features::PIPELINE_CACHE) {
            return unavailable("the device was created without the feature PIPELINE_CACHE");
        }
        let driver = hash_of_text(&format!("{}\n{}", info.driver, info.driver_info));
        let path = folder.join(format!("{key}-{driver}.bin"));
        let create = |data: Option<&[u8]>| {
            let descriptor = PipelineCacheDescriptor {
                label: Some("straightline"),
                data,
                fallback: false,
            };
            // SAFETY: by this function's contract, `PipelineCache::get_data` returned the data.
            let cache = run_scoped(device, || unsafe { device.create_pipeline_cache(&descriptor) });
            cache.map_err(|error| error.to_string().trim().to_owned())
        };
        let read = match straightline_files::read_file(&path, MAX_BYTES) {
            Ok(bytes) => take_data(&bytes).and_then(|data| create(Some(data))).map(Some),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error.to_string()),
        };
        let (cache, origin) = match read {
            Ok(Some(cache)) => (Ok(cache), CacheOrigin::File),
            Ok(None) => (create(None), CacheOrigin::New),
            Err(reason) => (create(None), CacheOrigin::Replaced { reason }),
        };
        match cache {
            Ok(cache) => PipelineCacheFile {
                cache: Some((cache, path)),
                origin,
            },
            Err(reason) => unavailable(&reason),
        }
    }

    /// The cache, for [`PassOptions::pipeline_cache`](crate::PassOptions::pipeline_cache) and for pipelines of the
    /// caller's; `None` if the device has none.
    pub fn cache(&self) -> Option<&PipelineCache> {
        self.cache.as_ref().map(|(cache, _)| cache)
    }

    /// Origin of the cache, for a log.
    pub fn origin(&self) -> &CacheOrigin {
        &self.origin
    }

    /// The file; `None` if the device has no cache.
    pub fn path(&self) -> Option<&Path> {
        self.cache.as_ref().map(|(_, path)| path.as_path())
    }

    /// Writes the cache to its file, which is replaced once everything is written. Creates the folder. Does nothing if
    /// the device has no cache. Call it after the pipelines are made, on any thread.
    ///
    /// # Errors
    ///
    /// [`Error::Write`]. The earlier file is unchanged then.
    pub fn save(&self) -> Result<(), Error> {
        let Some((cache, path)) = &self.cache else {
            return Ok(());
        };
        if let Some(data) = cache.get_data() {
            let contents = [hash_of_bytes(&data).into_bytes(), data].concat();
            straightline_files::write_file(path, &contents)?;
        }
        Ok(())
    }
}

/// The data of a file, if they have the hash before them.
fn take_data(bytes: &[u8]) -> Result<&[u8], String> {
    match bytes.split_at_checked(HASH_DIGITS) {
        Some((hash, data)) if hash == hash_of_bytes(data).as_bytes() => Ok(data),
        _ => Err("it is damaged, or was not written by this crate".to_owned()),
    }
}
