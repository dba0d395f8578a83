//! The web page in which kernels are chosen, edited and seen: its files, as they are hosted.
//!
//! The generator in it, `straightline.wasm`, is `page/module` compiled to WebAssembly; it is made apart, since a library cannot
//! hold what is compiled for another machine. `page/build` makes both in one go.

use std::collections::BTreeMap;

/// Name of the generator among the page's files.
pub const MODULE: &str = "straightline.wasm";

macro_rules! files {
    ($($name:literal),+ $(,)?) => {
        &[$(($name, include_bytes!(concat!("../static/", $name)))),+]
    };
}

/// The page's files but for the generator, by name.
pub const FILES: &[(&str, &[u8])] = files![
    "archive.js",
    "code.js",
    "controls.js",
    "counts.js",
    "drawing.js",
    "editor.js",
    "generator.js",
    "highlight.js",
    "icon.svg",
    "index.html",
    "link.js",
    "main.js",
    "page.css",
    "picture.js",
    "pixels.js",
    "theme.js",
    "view.js",
    "webgl2.js",
    "webgpu.js",
    "worker.js",
];

/// Why bytes are not the page's generator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ModuleError {
    /// They are not WebAssembly.
    #[error("it is no WebAssembly module")]
    NotWasm,
    /// They are, and lack what the page calls.
    #[error("it does not export `{0}`, which the page calls")]
    NotThePages(&'static str),
}

/// What the page calls in the generator.
const EXPORTS: [&str; 4] = ["memory", "request", "call", "answered"];

/// Every file of the page by name, the generator among them.
///
/// # Errors
///
/// `module` is not the generator compiled for the page.
pub fn files(module: Vec<u8>) -> Result<BTreeMap<String, Vec<u8>>, ModuleError> {
    let exported = exports(&module).ok_or(ModuleError::NotWasm)?;
    if let Some(missing) = EXPORTS.into_iter().find(|name| !exported.contains(&name.as_bytes())) {
        return Err(ModuleError::NotThePages(missing));
    }
    let own = FILES.iter().map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec()));
    Ok(own.chain([(MODULE.to_owned(), module)]).collect())
}

/// Names that a module exports; `None` if it is none.
fn exports(module: &[u8]) -> Option<Vec<&[u8]>> {
    const EXPORT_SECTION: u8 = 7;
    let mut rest = module.strip_prefix(b"\0asm\x01\0\0\0")?;
    while let Some((kind, after)) = rest.split_first() {
        let (length, after) = number(after)?;
        let (mut section, after) = after.split_at_checked(length)?;
        rest = after;
        if *kind != EXPORT_SECTION {
            continue;
        }
        let (count, first) = number(section)?;
        section = first;
        let mut names = Vec::new();
        for _ in 0..count {
            let (length, after) = number(section)?;
            let (name, after) = after.split_at_checked(length)?;
            names.push(name);
            // What kind of thing it is, and its index.
            section = number(after.get(1..)?)?.1;
        }
        return Some(names);
    }
    Some(Vec::new())
}

/// An unsigned number of seven bits a byte, and what follows it.
fn number(bytes: &[u8]) -> Option<(usize, &[u8])> {
    let mut value = 0_usize;
    for (k, byte) in bytes.iter().enumerate().take(5) {
        value |= usize::from(byte & 127) << (7 * k);
        if byte & 128 == 0 {
            return Some((value, &bytes[k + 1..]));
        }
    }
    None
}
