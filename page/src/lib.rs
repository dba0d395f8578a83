//! The web page in which kernels are chosen, edited and seen: its files, as they are hosted.
//!
//! The generator in it, `straightline.wasm`, is `page/module` compiled to WebAssembly, and `templates.wasm`, which renders
//! folders for engines and is loaded when one is asked for, is `page/templates`. They are made apart, since a library
//! cannot hold what is compiled for another machine. `page/build` makes all in one go.

use std::collections::BTreeMap;

/// Name of the generator among the page's files.
pub const GENERATOR: &str = "straightline.wasm";

/// Name of the module that renders folders for engines.
pub const TEMPLATES: &str = "templates.wasm";

macro_rules! files {
    ($($name:literal),+ $(,)?) => {
        &[$(($name, include_bytes!(concat!("../static/", $name)))),+]
    };
}

/// The page's files but for the modules, by name.
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

/// Reason why bytes are not a module of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ModuleError {
    /// They are not WebAssembly.
    #[error("it is no WebAssembly module")]
    NotWasm,
    /// A module without a function that the page calls.
    #[error("it does not export `{0}`, which the page calls")]
    NotThePages(&'static str),
}

/// Exports of a module that the page uses.
const EXPORTS: [&str; 4] = ["memory", "request", "call", "answered"];

/// A WebAssembly module with all functions that the page calls.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Module(Vec<u8>);

impl Module {
    /// Wraps the bytes of a module.
    ///
    /// # Errors
    ///
    /// If they are not a module, or lack a function that the page calls.
    pub fn new(bytes: Vec<u8>) -> Result<Module, ModuleError> {
        let exported = exported_names(&bytes).ok_or(ModuleError::NotWasm)?;
        match EXPORTS.into_iter().find(|name| !exported.contains(&name.as_bytes())) {
            Some(missing) => Err(ModuleError::NotThePages(missing)),
            None => Ok(Module(bytes)),
        }
    }
}

/// Every file of the page by name, the modules among them.
pub fn page_files(generator: Module, templates: Module) -> BTreeMap<String, Vec<u8>> {
    let own = FILES.iter().map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec()));
    let modules = [(GENERATOR, generator), (TEMPLATES, templates)];
    own.chain(modules.map(|(name, Module(bytes))| (name.to_owned(), bytes)))
        .collect()
}

/// Names that a module exports; `None` if it is none.
fn exported_names(module: &[u8]) -> Option<Vec<&[u8]>> {
    const EXPORT_SECTION: u8 = 7;
    let mut rest = module.strip_prefix(b"\0asm\x01\0\0\0")?;
    while let Some((kind, after)) = rest.split_first() {
        let (length, after) = read_number(after)?;
        let (mut section, after) = after.split_at_checked(length)?;
        rest = after;
        if *kind != EXPORT_SECTION {
            continue;
        }
        let (count, first) = read_number(section)?;
        section = first;
        let mut names = Vec::new();
        for _ in 0..count {
            let (length, after) = read_number(section)?;
            let (name, after) = after.split_at_checked(length)?;
            names.push(name);
            // The kind of the export comes first, then its index.
            section = read_number(after.get(1..)?)?.1;
        }
        return Some(names);
    }
    Some(Vec::new())
}

/// Reads an unsigned number with seven bits a byte; returns it and the remaining bytes.
fn read_number(bytes: &[u8]) -> Option<(usize, &[u8])> {
    let mut value = 0_usize;
    for (k, byte) in bytes.iter().enumerate().take(5) {
        value |= usize::from(byte & 127) << (7 * k);
        if byte & 128 == 0 {
            return Some((value, &bytes[k + 1..]));
        }
    }
    None
}
