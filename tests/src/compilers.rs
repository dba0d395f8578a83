//! Compilation of emitted text by compilers independent of naga: Tint for WGSL, if it is on the path; glslang for GLSL;
//! glslang and DXC for HLSL; spirv-val for SPIR-V, whose lines spirv-cross reads. MSL is not checked.

#![allow(dead_code)] // each test uses a part

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use straightline_codegen::Stage;
use straightline_codegen::emit::{Emitted, Target};

/// Languages that are checked by a compiler, and that every shader can be written in.
pub const READ: [Target; 4] = [Target::Wgsl, Target::Glsl450, Target::Spirv, Target::Hlsl];

/// Compiles every text of a shader by the compiler of its language.
///
/// # Errors
///
/// The message of the first compiler that rejects one.
pub fn read(emitted: &Emitted) -> Result<(), String> {
    let folder = Folder::new()?;
    let manifest = &emitted.manifest;
    let half = manifest.features.iter().any(|f| f == "shader-f16");
    let quads = manifest.features.iter().any(|f| f == "subgroup");
    for (target, bytes) in &emitted.files {
        let path = folder
            .0
            .join(format!("shader.{}", target.extension(manifest.stage, manifest.form)));
        let mut bytes = bytes.clone();
        let already = bytes.starts_with(b"enable subgroups;");
        if *target == Target::Wgsl && quads && !already {
            // Tint requires the directive that naga rejects.
            bytes = [b"enable subgroups;\n".as_slice(), &bytes].concat();
        }
        std::fs::write(&path, bytes).map_err(|e| format!("{}: {e}", path.display()))?;
        match target {
            Target::Wgsl => tint(&path)?,
            Target::Glsl450 => glsl(&path)?,
            Target::Spirv => spirv(&path)?,
            // glslang's HLSL has no half precision.
            Target::Hlsl if half => {
                let text = std::fs::read_to_string(&path).map_err(|e| e.to_string())?;
                dxc(&text, manifest.stage, &manifest.entry_point)?;
            }
            Target::Hlsl => hlsl(&path, manifest.stage, &manifest.entry_point)?,
            Target::Glsl430 | Target::Glsl330 | Target::Essl310 | Target::Essl300 => opengl(&path)?,
            Target::Msl => {}
            other => return Err(format!("no compiler reads {other}: name one here")),
        }
    }
    Ok(())
}

/// Runs Tint, if it is installed.
///
/// # Errors
///
/// Its message if it rejects the text.
pub fn tint(path: &Path) -> Result<(), String> {
    if has_tint() {
        run("tint", "", &["--format", "wgsl", "-o", "/dev/null"], path)
    } else {
        Ok(())
    }
}

/// Returns whether Tint is on the path.
pub fn has_tint() -> bool {
    static HAS: LazyLock<bool> = LazyLock::new(|| Command::new("tint").arg("--help").output().is_ok());
    *HAS
}

/// Runs glslang on GLSL, by the file's extension.
///
/// # Errors
///
/// Its message if it rejects the text.
pub fn glsl(path: &Path) -> Result<(), String> {
    let arguments = ["-V", "--target-env", "vulkan1.1", "--quiet", "-o", "/dev/null"];
    run("glslangValidator", "glslang-tools", &arguments, path)
}

/// glslang on GLSL and HLSL of compute shaders, each with its entry point, many at once: by glslc, which reads what is built in
/// once for all of them, where it is on the path. Beside each file lies the SPIR-V that it makes of it.
///
/// # Errors
///
/// What it says of the first text that it refuses.
pub fn all(folder: &Path, shaders: &[(PathBuf, String)]) -> Result<(), String> {
    if !has_glslc() {
        return shaders.iter().try_for_each(|(path, entry)| vulkan(path, entry));
    }
    let mut glslc = Command::new("glslc");
    glslc.current_dir(folder);
    glslc.args(["--target-env=vulkan1.1", "-fshader-stage=comp", "-c"]);
    for (path, entry) in shaders {
        if is_hlsl(path) {
            let text = std::fs::read_to_string(path).map_err(|e| e.to_string())?;
            dxc(&text, Stage::Compute, entry)?;
            std::fs::write(path, zeros_one_by_one(&text)).map_err(|e| e.to_string())?;
            glslc.args(["-x", "hlsl", &format!("-fentry-point={entry}")]);
        } else {
            glslc.args(["-x", "glsl", "-fentry-point=main"]);
        }
        glslc.arg(path);
    }
    let run = glslc.output().map_err(|e| format!("cannot run glslc ({e})"))?;
    match run.status.success() {
        true => Ok(()),
        false => Err(format!("glslc: {}", String::from_utf8_lossy(&run.stderr))),
    }
}

/// Returns whether glslc is on the path.
fn has_glslc() -> bool {
    static HAS: LazyLock<bool> = LazyLock::new(|| Command::new("glslc").arg("--version").output().is_ok());
    *HAS
}

/// The SPIR-V that glslang makes of GLSL for compute shaders, as words, of each text or why it is refused. The entry points are
/// `main`.
///
/// # Errors
///
/// It cannot be run.
pub fn compiled_glsl_all(texts: &[&str]) -> Result<Vec<Result<Vec<u32>, String>>, String> {
    let one_by_one = || texts.iter().map(|text| compiled_glsl(text, "comp")).collect();
    if !has_glslc() || texts.is_empty() {
        return Ok(one_by_one());
    }
    let folder = Folder::new()?;
    let mut shaders = Vec::new();
    for (k, text) in texts.iter().enumerate() {
        let path = folder.0.join(format!("{k}.comp"));
        std::fs::write(&path, text).map_err(|e| e.to_string())?;
        shaders.push((path, "main".to_owned()));
    }
    if all(&folder.0, &shaders).is_err() {
        return Ok(one_by_one());
    }
    let made = (0..texts.len()).map(|k| std::fs::read(folder.0.join(format!("{k}.comp.spv"))));
    Ok(made
        .map(|bytes| Ok(words(&bytes.map_err(|e| e.to_string())?)))
        .collect())
}

/// glslang on the GLSL or HLSL of a compute shader with this entry point, by the file's ending.
///
/// # Errors
///
/// What it says of a text that it refuses.
pub fn vulkan(path: &Path, entry: &str) -> Result<(), String> {
    match is_hlsl(path) {
        true => hlsl(path, Stage::Compute, entry),
        false => glsl(path),
    }
}

fn is_hlsl(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "hlsl")
}

/// glslang on GLSL of OpenGL, as the version that the text states.
///
/// # Errors
///
/// What it says of a text that it refuses.
pub fn opengl(path: &Path) -> Result<(), String> {
    run("glslangValidator", "glslang-tools", &["--quiet"], path)
}

/// glslang on many such texts at once.
///
/// # Errors
///
/// It refuses one of them.
pub fn opengl_all(paths: &[PathBuf]) -> Result<(), String> {
    let Some((last, first)) = paths.split_last() else {
        return Ok(());
    };
    let mut arguments = vec!["--quiet"];
    arguments.extend(first.iter().filter_map(|path| path.to_str()));
    run("glslangValidator", "glslang-tools", &arguments, last)
}

/// glslang and DXC on HLSL.
///
/// # Errors
///
/// What the first of them that refuses the text says.
pub fn hlsl(path: &Path, stage: Stage, entry: &str) -> Result<(), String> {
    let text = std::fs::read_to_string(path).map_err(|e| e.to_string())?;
    compiled_hlsl(&text, stage, entry).map(drop)
}

/// DXC on HLSL: in its default language version, and in that of 2021, where conditions of vectors are an error.
///
/// # Errors
///
/// What it says of a text that it refuses, or that it is not there.
pub fn dxc(text: &str, stage: Stage, entry: &str) -> Result<(), String> {
    [&[][..], &["-HV", "2021"]]
        .iter()
        .try_for_each(|version| by_dxc(text, stage, entry, version).map(drop))
}

/// The SPIR-V that DXC makes of HLSL, as words. Register `n` of any class, and of space 0, is binding `n` of set 0, and the entry
/// point keeps its name.
///
/// # Errors
///
/// What DXC says of a text that it refuses, or that it is not there.
pub fn spirv_by_dxc(text: &str, stage: Stage, entry: &str) -> Result<Vec<u32>, String> {
    let arguments = ["-spirv", "-fspv-target-env=vulkan1.1", "-fvk-use-dx-layout"];
    by_dxc(text, stage, entry, &arguments).map(|bytes| words(&bytes))
}

fn by_dxc(text: &str, stage: Stage, entry: &str, further: &[&str]) -> Result<Vec<u8>, String> {
    let profile = match stage {
        Stage::Compute => "cs_6_0",
        Stage::Fragment => "ps_6_0",
    };
    let arguments = [&["-T", profile, "-E", entry], further].concat();
    straightline_foreign::dxc::compile(text, &arguments)
        .map_err(|why| format!("DXC {} refuses it:\n{why}\n{text}", further.join(" ")))
}

fn zeros_one_by_one(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find("])0") {
        let before = &rest[..at];
        let begin = before.rfind('(').unwrap_or(0);
        let (ty, length) = before[begin + 1..].split_once('[').unwrap_or_default();
        let zeros = vec![format!("({ty})0"); length.parse().unwrap_or(0)];
        out += &before[..begin];
        out += &format!("{{{}}}", zeros.join(", "));
        rest = &rest[at + 3..];
    }
    out + rest
}

/// spirv-val.
///
/// # Errors
///
/// What it says of a module that it refuses.
pub fn spirv(path: &Path) -> Result<(), String> {
    run("spirv-val", "spirv-tools", &["--target-env", "vulkan1.1"], path)
}

/// The lines of sources that spirv-cross finds in SPIR-V, with the paths of their files.
///
/// # Errors
///
/// Its message if it cannot read the module.
pub fn lines_by_spirv_cross(spirv: &[u8]) -> Result<Vec<(String, u32)>, String> {
    let folder = Folder::new()?;
    let (module, text) = (folder.0.join("shader.spv"), folder.0.join("shader.glsl"));
    std::fs::write(&module, spirv).map_err(|e| e.to_string())?;
    let output = text.to_string_lossy().into_owned();
    let arguments = ["--vulkan-semantics", "--emit-line-directives", "--output", &output];
    run("spirv-cross", "spirv-cross", &arguments, &module)?;
    let text = std::fs::read_to_string(text).map_err(|e| e.to_string())?;
    let directive = |line: &str| {
        let (line, path) = line.trim().strip_prefix("#line ")?.split_once(' ')?;
        Some((path.trim_matches('"').to_owned(), line.parse().ok()?))
    };
    Ok(text.lines().filter_map(directive).collect())
}

fn run(tool: &str, package: &str, arguments: &[&str], path: &Path) -> Result<(), String> {
    let run = Command::new(tool).args(arguments).arg(path).output();
    let run = run.map_err(|e| format!("cannot run {tool} ({e}): install Debian's {package}"))?;
    if run.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&run.stdout).into_owned() + &String::from_utf8_lossy(&run.stderr);
    let text = std::fs::read(path).unwrap_or_default();
    Err(format!(
        "{tool} refuses it:\n{said}\n{}",
        String::from_utf8_lossy(&text)
    ))
}

/// A folder of its own that is gone when it is dropped.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Folder, String> {
        use std::sync::atomic::{AtomicU32, Ordering};
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let name = format!(
            "straightline-texts-{}-{}",
            std::process::id(),
            NEXT.fetch_add(1, Ordering::Relaxed)
        );
        let path = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(Folder(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that cannot be removed stays among the temporary files.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// The SPIR-V that glslang makes of GLSL for a stage, `comp` or `frag`, as words. Its entry point is `main`.
///
/// # Errors
///
/// What glslang says of a text that it refuses.
pub fn compiled_glsl(text: &str, stage: &str) -> Result<Vec<u32>, String> {
    compiled(text, &format!("shader.{stage}"), &[])
}

/// The SPIR-V that glslang makes of HLSL, as words. Register `n` of any class, and of space 0, is binding `n` of set 0, and
/// the entry point keeps its name.
///
/// glslang knows no `(float[9])0`, which other compilers of HLSL take, and is shown the zeros one by one. DXC reads the
/// text as it is.
///
/// # Errors
///
/// What glslang or DXC says of a text that it refuses.
pub fn compiled_hlsl(text: &str, stage: Stage, entry: &str) -> Result<Vec<u32>, String> {
    let name = match stage {
        Stage::Compute => "comp",
        Stage::Fragment => "frag",
    };
    let language = ["-D", "-S", name, "-e", entry];
    let words = compiled(&zeros_one_by_one(text), "shader.hlsl", &language)?;
    dxc(text, stage, entry)?;
    Ok(words)
}

/// The words that glslang makes of a text in a file of this name.
fn compiled(text: &str, file: &str, language: &[&str]) -> Result<Vec<u32>, String> {
    let folder = Folder::new()?;
    let (source, made) = (folder.0.join(file), folder.0.join("shader.spv"));
    std::fs::write(&source, text).map_err(|e| e.to_string())?;
    let made_name = made.to_string_lossy().into_owned();
    let common = ["-V", "--target-env", "vulkan1.1", "--quiet", "-o", &made_name];
    run(
        "glslangValidator",
        "glslang-tools",
        &[language, &common].concat(),
        &source,
    )?;
    let bytes = std::fs::read(&made).map_err(|e| e.to_string())?;
    Ok(words(&bytes))
}

/// The words of a SPIR-V file.
pub fn words(bytes: &[u8]) -> Vec<u32> {
    let words = bytes.chunks_exact(4);
    words.map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect()
}

/// `OpLabel`: begins a basic block.
pub const LABEL: u32 = 248;
/// `OpConstant`.
const CONSTANT: u32 = 43;

/// `OpFunction`: begins a function.
pub const FUNCTION: u32 = 54;

/// Opcodes of the instructions of each basic block.
pub fn blocks(words: &[u32]) -> Vec<Vec<u32>> {
    let mut blocks: Vec<Vec<u32>> = Vec::new();
    let mut at = 5;
    while at < words.len() {
        match words[at] & 0xffff {
            LABEL => blocks.push(Vec::new()),
            opcode => blocks.last_mut().into_iter().for_each(|block| block.push(opcode)),
        }
        at += (words[at] >> 16) as usize;
    }
    blocks
}

/// Returns whether an opcode reads a texel: `OpImageSampleImplicitLod` to `OpImageRead`.
pub fn reads_texel(opcode: &u32) -> bool {
    (87..=98).contains(opcode)
}

/// Operands of all instructions with an opcode.
pub fn instructions(words: &[u32], opcode: u32) -> Vec<&[u32]> {
    let mut found = Vec::new();
    let mut at = 5;
    while at < words.len() {
        let length = (words[at] >> 16) as usize;
        if words[at] & 0xffff == opcode {
            found.push(&words[at + 1..at + length]);
        }
        at += length;
    }
    found
}

/// The words of all constants of 32 bits.
pub fn constants(words: &[u32]) -> Vec<u32> {
    let constants = instructions(words, CONSTANT).into_iter();
    constants.map(|operands| operands[2]).collect()
}
