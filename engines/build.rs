//! Generates the tables of built-in engines from the folders in `templates/`: the description in each `engine.toml`, and
//! the other files as text. The tables are separate, so that a program that renders no template contains none.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// File that marks a folder as an engine.
const DESCRIPTION: &str = "engine.toml";

fn main() -> io::Result<()> {
    let templates = Path::new(&env::var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?).join("templates");
    println!("cargo:rerun-if-changed={}", templates.display());
    let mut descriptions = String::from("&[\n");
    let mut sources = descriptions.clone();
    for engine in sorted_entries(&templates)? {
        println!("cargo:rerun-if-changed={}", engine.display());
        let description = fs::read_to_string(engine.join(DESCRIPTION))?;
        // Read here, a program needs no reader of TOML for it.
        let description: serde_json::Value = toml::from_str(&description).map_err(io::Error::other)?;
        let description = description.to_string();
        writeln!(descriptions, "    ({:?}, {description:?}),", entry_name(&engine)).map_err(io::Error::other)?;
        writeln!(sources, "    ({:?}, &[", entry_name(&engine)).map_err(io::Error::other)?;
        for file in sorted_entries(&engine)?
            .iter()
            .filter(|file| entry_name(file) != DESCRIPTION)
        {
            let path = file.display().to_string();
            writeln!(sources, "        ({:?}, include_str!({path:?})),", entry_name(file)).map_err(io::Error::other)?;
        }
        sources += "    ]),\n";
    }
    let out = PathBuf::from(env::var("OUT_DIR").map_err(io::Error::other)?);
    fs::write(out.join("descriptions.rs"), descriptions + "]\n")?;
    fs::write(out.join("templates.rs"), sources + "]\n")
}

/// Lists the contents of a folder, in order of name.
fn sorted_entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    let mut paths = entries.collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}

fn entry_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
