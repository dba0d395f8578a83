//! `shaders-out/` holds what the generator emits today, and every file of it is valid to a second compiler.
//!
//! After a change of the generator: `STRAIGHTLINE_BLESS=1 cargo test --workspace --test shaders drift::`, and read the
//! difference.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use straightline_codegen::{Unroll, default_set, files};
use straightline_manifest::{Manifest, Stage};
use straightline_tests::compilers;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders-out")
}

#[test]
fn shaders_out_is_up_to_date() {
    let expected = default_set::emit_files().expect("the default set is emitted");
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        files::write_all(&folder(), &expected).expect("shaders-out is written");
    }
    let bless = "run STRAIGHTLINE_BLESS=1 cargo test --workspace --test shaders drift::";
    for (name, contents) in &expected {
        let present = std::fs::read(folder().join(name)).unwrap_or_default();
        assert!(
            present == *contents,
            "shaders-out/{name} is not what the generator emits: {bless}"
        );
    }
    let names: BTreeSet<String> = expected.into_keys().collect();
    for entry in std::fs::read_dir(folder()).expect("shaders-out is there") {
        let name = entry
            .expect("a folder entry")
            .file_name()
            .to_string_lossy()
            .into_owned();
        assert!(
            name == "README.md" || names.contains(&name),
            "shaders-out/{name} is emitted no more: delete it"
        );
    }
}

/// A fragment shader is one basic block. A compute shader reads and filters in one; the others are the tests of the frame,
/// around a return or a store with the last sum that it stores.
#[test]
fn each_shader_computes_in_one_basic_block() {
    for entry in default_set::ENTRIES.iter().filter(|entry| entry.unroll == Unroll::Full) {
        let path = folder().join(format!("{}.spv", entry.stem));
        let words = compilers::words(&std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())));
        let stem = entry.stem;
        assert_eq!(compilers::instructions(&words, compilers::FUNCTION).len(), 1, "{stem}");
        let blocks = compilers::blocks(&words);
        if entry.stage == Stage::Fragment {
            assert_eq!(blocks.len(), 1, "{stem}");
        }
        let reading = blocks
            .iter()
            .filter(|opcodes| opcodes.iter().any(compilers::reads_texel));
        assert_eq!(reading.count(), 1, "{stem}: {blocks:?}");
        let large = blocks.iter().filter(|opcodes| opcodes.len() > 16);
        assert_eq!(large.count(), 1, "{stem}: {blocks:?}");
    }
}

#[test]
fn emission_is_deterministic() {
    assert!(
        default_set::emit_files().expect("emitted") == default_set::emit_files().expect("emitted"),
        "two runs differ"
    );
}

#[test]
fn glslang_accepts_the_glsl() {
    check(&["comp", "frag"], |path| {
        let of_opengl = path
            .file_stem()
            .is_some_and(|stem| stem.to_string_lossy().contains('.'));
        if of_opengl { Ok(()) } else { compilers::glsl(path) }
    });
}

#[test]
fn glslang_accepts_the_glsl_of_opengl() {
    let opengl = |path: &Path| {
        [".430.", ".330.", ".es310.", ".es300."]
            .iter()
            .any(|v| path.to_string_lossy().contains(v))
    };
    let checked = std::fs::read_dir(folder())
        .expect("shaders-out is there")
        .filter(|entry| {
            let path = entry.as_ref().expect("a folder entry").path();
            let checked = opengl(&path);
            if checked {
                compilers::opengl(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
            }
            checked
        });
    assert!(checked.count() >= 12, "some versions are not there");
}

#[test]
fn spirv_val_accepts_the_spirv() {
    check(&["spv"], compilers::spirv);
}

/// Checks the WGSL with Tint, if it is on the path.
#[test]
fn tint_accepts_the_wgsl() {
    check(&["wgsl"], |path| {
        let text = std::fs::read_to_string(path).map_err(|e| e.to_string())?;
        if text.contains("quadSwap") {
            // Tint asks for a line that naga refuses; texts with it are read by the tests of emission.
            return Ok(());
        }
        compilers::tint(path)
    });
}

#[test]
fn glslang_accepts_the_hlsl() {
    check(&["hlsl"], |path| {
        let json = std::fs::read_to_string(path.with_extension("json")).map_err(|e| e.to_string())?;
        let manifest = Manifest::from_json(&json).map_err(|e| e.to_string())?;
        compilers::hlsl(path, manifest.stage, &manifest.entry_point)
    });
}

fn check(extensions: &[&str], compiler: impl Fn(&Path) -> Result<(), String>) {
    let mut checked = 0;
    for entry in std::fs::read_dir(folder()).expect("shaders-out is there") {
        let path = entry.expect("a folder entry").path();
        if path.extension().is_some_and(|e| extensions.iter().any(|x| e == *x)) {
            compiler(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
            checked += 1;
        }
    }
    assert!(checked >= 6, "only {checked} files were there to check");
}
