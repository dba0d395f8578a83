//! Makes the table of built-in engines from the folders in `templates/`: every file of each, embedded as text.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let templates = Path::new(&env::var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?).join("templates");
    println!("cargo:rerun-if-changed={}", templates.display());
    let mut table = String::from("&[\n");
    for engine in sorted(&templates)? {
        println!("cargo:rerun-if-changed={}", engine.display());
        writeln!(table, "    ({:?}, &[", name(&engine)).map_err(io::Error::other)?;
        for file in sorted(&engine)? {
            let path = file.display().to_string();
            writeln!(table, "        ({:?}, include_str!({path:?})),", name(&file)).map_err(io::Error::other)?;
        }
        table += "    ]),\n";
    }
    table += "]\n";
    let out = PathBuf::from(env::var("OUT_DIR").map_err(io::Error::other)?);
    fs::write(out.join("builtin.rs"), table)
}

/// What a folder holds, in order of name.
fn sorted(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    let mut paths = entries.collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
