//! Files and folders that are not whole yet, and their removal: on errors, and when the program is interrupted.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Paths that would be left over if the program ended now, in the order in which they were made.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Held while the files of a set are moved to their places.
static COMMIT: Mutex<()> = Mutex::new(());

fn lock<T>(mutex: &'static Mutex<T>) -> MutexGuard<'static, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps [`remove_unfinished`] waiting until a set of files is in its place.
pub(super) fn lock_commit() -> MutexGuard<'static, ()> {
    lock(&COMMIT)
}

/// Removes every unfinished file and folder of this program, once any set that is being moved to its place is there. For a
/// program that is interrupted and ends at once after this: any thread that makes or finishes a file from now on waits for
/// ever.
pub fn remove_unfinished() {
    std::mem::forget(lock(&COMMIT));
    let unfinished = lock(&UNFINISHED);
    for path in unfinished.iter().rev() {
        remove_path(path);
    }
    std::mem::forget(unfinished);
}

/// Removes a scrap with all that is in it, or a folder that was made for files if it is empty.
fn remove_path(path: &Path) {
    // A failed removal cannot be handled; the first error is the one to report.
    let _ = match fs::symlink_metadata(path) {
        Ok(metadata) if metadata.is_dir() && is_scrap(path) => fs::remove_dir_all(path),
        Ok(metadata) if metadata.is_dir() => fs::remove_dir(path),
        _ => fs::remove_file(path),
    };
}

fn is_scrap(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with('.') && name.contains(&format!("-{}-", std::process::id()))
}

fn forget_path(path: &Path) {
    let mut unfinished = lock(&UNFINISHED);
    if let Some(at) = unfinished.iter().rposition(|known| known == path) {
        unfinished.remove(at);
    }
}

/// A unique name beside a file or folder, under which that is created. An existing file there is removed on drop, unless it
/// was moved to its final place.
#[derive(Debug)]
pub struct Scrap(PathBuf);

impl Scrap {
    /// Reserves a name beside `path` with a suffix for its purpose, such as `partial`. Nothing is created yet.
    ///
    /// # Errors
    ///
    /// If the path does not end in a name.
    pub fn beside(path: &Path, purpose: &str) -> io::Result<Scrap> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let name = path.file_name().ok_or_else(|| {
            io::Error::new(
                io::ErrorKind::InvalidInput,
                "the path ends in no name; give one, such as `out` or `out.png`",
            )
        })?;
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{purpose}-{}-{number}", std::process::id()));
        let beside = path.with_file_name(hidden);
        lock(&UNFINISHED).push(beside.clone());
        Ok(Scrap(beside))
    }

    /// Path of the scrap.
    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Scrap {
    fn drop(&mut self) {
        remove_path(&self.0);
        forget_path(&self.0);
    }
}

/// Folders that were made for files. Those that are empty are removed when this is dropped, unless they are kept.
#[derive(Debug)]
#[must_use = "folders that are not kept are removed"]
pub struct Folders(Vec<PathBuf>);

impl Folders {
    /// Makes `folder` and those above it that are not there.
    ///
    /// # Errors
    ///
    /// What the system says; then none was made.
    pub fn make(folder: &Path) -> io::Result<Folders> {
        let mut made = Folders(Vec::new());
        made.add(folder)?;
        Ok(made)
    }

    /// Makes another folder, and those above it that are not there.
    ///
    /// # Errors
    ///
    /// What the system says.
    pub fn add(&mut self, folder: &Path) -> io::Result<()> {
        if folder.as_os_str().is_empty() {
            return Ok(());
        }
        let missing = folder
            .ancestors()
            .take_while(|path| !path.as_os_str().is_empty() && fs::symlink_metadata(path).is_err());
        let mut missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
        missing.reverse();
        lock(&UNFINISHED).extend(missing.iter().cloned());
        self.0.extend(missing);
        fs::create_dir_all(folder)
    }

    /// Leaves them where they are.
    pub fn keep(mut self) {
        for path in std::mem::take(&mut self.0) {
            forget_path(&path);
        }
    }
}

impl Drop for Folders {
    fn drop(&mut self) {
        for path in self.0.iter().rev() {
            let _ = fs::remove_dir(path);
            forget_path(path);
        }
    }
}
