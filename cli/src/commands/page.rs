//! `page`: the web page.

use crate::args::PageArgs;
use crate::failure::Failure;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use straightline_codegen::files;
use straightline_page::Module;

/// Maximum size of a module, in bytes.
const LARGEST: u64 = 1 << 28;

/// Writes the page's files, all or none.
pub fn write_page(args: &PageArgs) -> Result<(), Failure> {
    files::try_folder(&args.out).map_err(Failure::from_error)?;
    let [generator, templates] = match (&args.module, &args.templates) {
        (Some(generator), Some(templates)) => [generator.clone(), templates.clone()],
        _ => build_modules()?,
    };
    let all = straightline_page::page_files(read_module(&generator)?, read_module(&templates)?);
    files::write_all(&args.out, &all).map_err(Failure::from_error)?;
    outln!("{}", args.out.join("index.html").display());
    errln!(
        "note: browsers open it from a server, not from a file: python3 -m http.server --directory {}",
        args.out.display()
    );
    Ok(())
}

/// Reads a module and checks that it belongs to the page.
fn read_module(path: &Path) -> Result<Module, Failure> {
    let bytes = files::read_file(path, LARGEST)
        .map_err(|why| Failure::Failed(format!("cannot read the module `{}`: {why}", path.display())))?;
    Module::new(bytes).map_err(|why| {
        Failure::Failed(format!(
            "`{}` is no module of the page: {why}; page/build makes them",
            path.display()
        ))
    })
}

/// Crates of the generator and of the templates.
const CRATES: [&str; 2] = ["straightline-page-module", "straightline-page-templates"];

/// Builds both modules with cargo, from the surrounding source checkout; returns their paths.
fn build_modules() -> Result<[PathBuf; 2], Failure> {
    let root = find_checkout().ok_or_else(|| {
        Failure::Failed(
            "the page needs the generator as WebAssembly, and this is no checkout of Straightline's source to build it from: run it in one, \
             or give the modules that page/build has made, --module straightline.wasm --templates templates.wasm"
                .to_owned(),
        )
    })?;
    errln!("note: building the generator for wasm32-unknown-unknown, which takes some minutes the first time");
    for name in CRATES {
        build(&root, name)?;
    }
    // Cargo runs in the root, so a relative path is resolved from there.
    let target = root.join(std::env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| "target".into()));
    let folder = target.join(TARGET).join("page");
    Ok(CRATES.map(|name| folder.join(format!("{}.wasm", name.replace('-', "_")))))
}

/// Builds the module of one crate with cargo.
fn build(root: &Path, name: &str) -> Result<(), Failure> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(cargo)
        .current_dir(root)
        .args(["rustc", "--package", name, "--lib", "--profile", "page"])
        .args(["--crate-type", "cdylib", "--target", TARGET])
        .env("CARGO_ENCODED_RUSTFLAGS", compiler_flags(root))
        .stdout(Stdio::null())
        .status()
        .map_err(|why| Failure::Failed(format!("cannot run cargo: {why}; page/build names the other ways")))?;
    match status.success() {
        true => Ok(()),
        false => Err(Failure::Failed(format!(
            "`{name}` was not built for {TARGET} (above cargo says why). If the target is missing: rustup target add {TARGET}; on Debian \
             without rustup, page/build uses rust-web's"
        ))),
    }
}

const TARGET: &str = "wasm32-unknown-unknown";

/// Returns the compiler flags of page/build. The linker puts the stack first, so that a stack overflow traps; the stack
/// size is in bytes. Paths are remapped: a hosted module must not reveal the build folders.
fn compiler_flags(root: &Path) -> OsString {
    let home = |name: &str| std::env::var_os(name).map(PathBuf::from);
    let cargo = home("CARGO_HOME").or_else(|| {
        home("HOME")
            .or_else(|| home("USERPROFILE"))
            .map(|home| home.join(".cargo"))
    });
    let mut flags = OsString::from("-Clink-arg=-zstack-size=4194304");
    for (folder, name) in [(cargo.as_deref(), "/cargo"), (Some(root), "/straightline")] {
        if let Some(folder) = folder {
            flags.push("\x1f--remap-path-prefix=");
            flags.push(folder);
            flags.push("=");
            flags.push(name);
        }
    }
    flags
}

/// Returns the root of the source checkout around the working directory.
fn find_checkout() -> Option<PathBuf> {
    let here = std::env::current_dir().ok()?;
    let is_root = |folder: &&Path| folder.join("page/module/Cargo.toml").is_file();
    here.ancestors().find(is_root).map(Path::to_owned)
}
