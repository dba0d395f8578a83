//! Reading: regular files only, of a size that is known and bounded before anything of them is read.

use std::fs::{self, File, Metadata};
use std::io::{self, Read};
use std::path::Path;

/// Opens a regular file of at most `limit` bytes. A pipe would wait for its writer, and a device has no end.
///
/// # Errors
///
/// Errors of the system; the kind of a file that is not regular; the length of a file beyond the limit.
pub fn open_file(path: &Path, limit: u64) -> io::Result<File> {
    // Before it is opened: opening a pipe waits for its writer.
    check_metadata(&fs::metadata(path)?, limit)?;
    let file = File::open(path)?;
    check_metadata(&file.metadata()?, limit)?;
    Ok(file)
}

fn check_metadata(metadata: &Metadata, limit: u64) -> io::Result<()> {
    if metadata.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    if !metadata.is_file() {
        let problem = format!("it is {}, and only regular files are read", kind(metadata));
        return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
    }
    if metadata.len() > limit {
        return Err(too_long(metadata.len(), limit));
    }
    Ok(())
}

fn too_long(found: u64, limit: u64) -> io::Error {
    io::Error::new(
        io::ErrorKind::FileTooLarge,
        format!("it has {found} bytes, and at most {limit} are read"),
    )
}

#[cfg(unix)]
fn kind(metadata: &Metadata) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    let kind = metadata.file_type();
    if kind.is_fifo() {
        "a pipe"
    } else if kind.is_socket() {
        "a socket"
    } else {
        "a device"
    }
}

#[cfg(not(unix))]
fn kind(_: &Metadata) -> &'static str {
    "something else"
}

/// The contents of a regular file of at most `limit` bytes.
///
/// # Errors
///
/// As [`open_file`].
pub fn read_file(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let file = open_file(path, limit)?;
    let mut bytes = Vec::with_capacity(file.metadata()?.len() as usize);
    // A file may grow while it is read.
    file.take(limit + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 {
        found if found > limit => Err(too_long(found, limit)),
        _ => Ok(bytes),
    }
}

/// As [`read_file`], for text.
///
/// # Errors
///
/// As [`open_file`], and if it is not UTF-8, from which byte on.
pub fn read_text(path: &Path, limit: u64) -> io::Result<String> {
    String::from_utf8(read_file(path, limit)?).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        io::Error::new(io::ErrorKind::InvalidData, format!("it is not UTF-8 from byte {at} on"))
    })
}
