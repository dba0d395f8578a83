//! The Rust that binds a shader compiles, whatever its uniforms are called.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use straightline_codegen::chain::Fuse;
use straightline_codegen::emit::{self, Module, Modules, Parameters, Target};
use straightline_codegen::{Config, EmitOptions, Format, Kernel, Settings, Share, Stage, Unroll};

/// As much of the runtime as bindings name, beside what their constants are made of, which is the runtime's own.
const RUNTIME: &str = r#"
pub use shader::Shader;
pub mod wgpu {
    pub struct Device; pub struct Queue; pub struct CommandEncoder; pub struct RenderPass<'a>(pub &'a ());
    #[derive(Debug)] pub struct TextureView; #[derive(Debug)] pub struct Sampler; #[derive(Debug)] pub struct Buffer;
    pub struct BindGroupLayoutDescriptor<'a> { pub label: Option<&'a str>, pub entries: &'a [BindGroupLayoutEntry] }
    pub struct BindGroupLayoutEntry { pub binding: u32, pub visibility: ShaderStages, pub ty: BindingType, pub count: Option<u32> }
    pub struct ShaderStages; impl ShaderStages { pub const COMPUTE: ShaderStages = ShaderStages; pub const FRAGMENT: ShaderStages = ShaderStages; }
    pub struct BufferSize; impl BufferSize { pub const fn new(_: u64) -> Option<BufferSize> { None } }
    pub enum BindingType {
        Buffer { ty: BufferBindingType, has_dynamic_offset: bool, min_binding_size: Option<BufferSize> },
        Texture { sample_type: TextureSampleType, view_dimension: TextureViewDimension, multisampled: bool },
        Sampler(SamplerBindingType),
        StorageTexture { access: StorageTextureAccess, format: TextureFormat, view_dimension: TextureViewDimension },
    }
    pub enum BufferBindingType { Uniform, Storage { read_only: bool } }
    pub enum TextureSampleType { Float { filterable: bool }, Depth, Sint, Uint }
    pub enum TextureViewDimension { D2, D2Array, D3, Cube }
    pub enum SamplerBindingType { Filtering, Comparison }
    pub enum StorageTextureAccess { WriteOnly } pub enum TextureFormat { Rgba16Float }
}
#[derive(Debug)] pub struct Error;
pub struct Resource<'a>(pub &'a ());
impl<'a> From<&'a wgpu::Buffer> for Resource<'a> { fn from(_: &'a wgpu::Buffer) -> Self { Resource(&()) } }
impl<'a> From<&'a wgpu::Sampler> for Resource<'a> { fn from(_: &'a wgpu::Sampler) -> Self { Resource(&()) } }
impl<'a> From<&'a wgpu::TextureView> for Resource<'a> { fn from(_: &'a wgpu::TextureView) -> Self { Resource(&()) } }
#[derive(Default)] pub struct PassOptions;
pub struct OverrideValue;
impl From<f32> for OverrideValue { fn from(_: f32) -> Self { OverrideValue } }
impl From<i32> for OverrideValue { fn from(_: i32) -> Self { OverrideValue } }
impl From<u32> for OverrideValue { fn from(_: u32) -> Self { OverrideValue } }
impl From<bool> for OverrideValue { fn from(_: bool) -> Self { OverrideValue } }
impl PassOptions { pub fn override_option(self, _: &str, _: impl Into<OverrideValue>) -> Self { self } }
#[derive(Debug)] pub struct Passes;
impl Passes {
    pub fn new(_: &wgpu::Device, _: PassOptions) -> Passes { Passes }
    pub fn get(&mut self, _: &Shader<'_>) -> Result<&Pass, Error> { Ok(&Pass) }
}
pub struct Candidate<'a> { pub name: &'a str, pub shader: &'a Shader<'a> }
pub struct Choices; pub struct Chosen { pub pass: Pass }
impl Choices {
    pub fn choose(&mut self, _: (&wgpu::Device, &wgpu::Queue), _: &[Candidate<'_>], _: &PassOptions, _: impl FnMut(&Pass) -> Result<Bound, Error>) -> Result<Chosen, Error> { Ok(Chosen { pass: Pass }) }
}
#[derive(Debug)] pub struct Pass;
impl Pass {
    pub fn from_shader(_: &wgpu::Device, _: &Shader<'_>, _: &PassOptions) -> Result<Pass, Error> { Ok(Pass) }
    pub fn bind_with(&self, _: &[(&str, Resource<'_>)], _: impl Into<Targets>, _: &BindOptions<'_>) -> Result<Bound, Error> { Ok(Bound) }
}
#[derive(Default)] pub struct BindOptions<'a> { pub uniforms: &'a [u8] }
impl<'a> BindOptions<'a> {
    pub fn uniforms(self, uniforms: &'a [u8]) -> Self { BindOptions { uniforms } }
    pub fn region(self, _: Region) -> Self { self }
}
pub struct Region;
pub struct Targets;
impl From<&wgpu::TextureView> for Targets { fn from(_: &wgpu::TextureView) -> Self { Targets } }
impl<const N: usize> From<&[(&str, &wgpu::TextureView); N]> for Targets { fn from(_: &[(&str, &wgpu::TextureView); N]) -> Self { Targets } }
impl From<&[(&str, &wgpu::TextureView)]> for Targets { fn from(_: &[(&str, &wgpu::TextureView)]) -> Self { Targets } }
#[derive(Debug)] pub struct Bound;
impl Bound {
    pub fn encode(&self, _: &mut wgpu::CommandEncoder) {}
    pub fn write_at(&self, _: &wgpu::Queue, _: u32, _: &[u8]) {}
}
pub struct DrawOptions<'a>(pub &'a ());
#[derive(Debug)] pub struct Draw;
impl Draw {
    pub fn from_shader(_: &wgpu::Device, _: &Shader<'_>, _: &DrawOptions<'_>) -> Result<Draw, Error> { Ok(Draw) }
    pub fn bind_with(&self, _: &[(&str, Resource<'_>)], _: &BindOptions<'_>) -> Result<BoundDraw, Error> { Ok(BoundDraw) }
}
#[derive(Debug)] pub struct BoundDraw;
impl BoundDraw {
    pub fn set(&self, _: &mut wgpu::RenderPass<'_>) {}
    pub fn write_at(&self, _: &wgpu::Queue, _: u32, _: &[u8]) {}
}
"#;

/// Arguments of rustc for a file of bindings.
const BINDINGS: [&str; 6] = [
    "--extern",
    "straightline_runtime=libstraightline_runtime.rmeta",
    "-L",
    ".",
    // As a crate may.
    "-F",
    "unsafe_code",
];

fn rustc(folder: &Path, file: &str, arguments: &[&str]) {
    let said = try_rustc(folder, file, arguments);
    let text = std::fs::read_to_string(folder.join(file)).unwrap_or_default();
    said.unwrap_or_else(|said| panic!("{said}\n{text}"));
}

/// The messages of rustc, if it refuses a file.
fn try_rustc(folder: &Path, file: &str, arguments: &[&str]) -> Result<(), String> {
    let run = Command::new("rustc")
        .current_dir(folder)
        .args([
            "--edition",
            "2024",
            "--crate-type",
            "lib",
            "--emit",
            "metadata",
            "-D",
            "warnings",
        ])
        .args(arguments)
        .arg(file)
        .output()
        .expect("rustc is on the path");
    match run.status.success() {
        true => Ok(()),
        false => Err(String::from_utf8_lossy(&run.stderr).into_owned()),
    }
}

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("straightline-bindings-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// The runtime that bindings are compiled against, in a folder.
fn runtime(folder: &Path) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let module = |name: &str| {
        let path = root.join("runtime/src").join(format!("{name}.rs"));
        format!("#[path = {path:?}] pub mod {name};\n")
    };
    let text = format!("{}{}{RUNTIME}", module("plan"), module("shader"));
    std::fs::write(folder.join("straightline_runtime.rs"), text).expect("written");
    let manifest = root.join("manifest/src/lib.rs");
    rustc(
        folder,
        &manifest.to_string_lossy(),
        &["--crate-name", "straightline_manifest"],
    );
    rustc(
        folder,
        "straightline_runtime.rs",
        &[
            "--crate-name",
            "straightline_runtime",
            "--extern",
            "straightline_manifest=libstraightline_manifest.rmeta",
            "-A",
            "dead_code",
        ],
    );
}

/// Has rustc compile the bindings of a kernel `k`, unless its text is refused before.
fn compiles(folder: &Path, file: &str, text: &str) -> Result<(), String> {
    compiles_with(folder, file, text, &Settings::default())
}

fn compiles_with(folder: &Path, file: &str, text: &str, settings: &Settings) -> Result<(), String> {
    let compiled = Kernel::from_text("kernel.rs", text, "k").compile(settings);
    let compiled = compiled.map_err(|e| e.to_string())?;
    // A kernel with interpolated values is a fragment shader.
    let stage = match compiled.graph.varyings.is_empty() {
        true => Stage::Compute,
        false => Stage::Fragment,
    };
    let emitted = compiled
        .emit(&EmitOptions::new().stage(stage))
        .map_err(|e| e.to_string())?;
    let wgsl = String::from_utf8(emitted.files[&Target::Wgsl].clone()).map_err(|e| e.to_string())?;
    let module = Module {
        name: "shader",
        compiled: &compiled,
        manifest: &emitted.manifest,
        wgsl: &wgsl,
    };
    for (file, contents) in emitted.named_files("shader") {
        std::fs::write(folder.join(file), contents).expect("written");
    }
    std::fs::write(
        folder.join(file),
        emit::render_bindings(&Modules {
            shaders: vec![module],
            ..Default::default()
        })
        .map_err(|e| e.to_string())?,
    )
    .expect("written");
    rustc(folder, file, &BINDINGS);
    Ok(())
}

/// Elements of buffers are structures of the layout that rustc checks; textures of every kind are in the layout.
#[test]
fn bindings_compile_whatever_is_read() {
    let folder = folder("read");
    runtime(&folder);
    let reads = [
        "pub struct Inputs { position: Vec3, kind: u32, powers: [f32; 3], turned: Mat3, tints: [Vec3; 2], last: IVec2 }
        pub fn k(lights: &Buffer<Inputs>, others: &Buffer<Inputs>, gain: f32, pixel: IVec2) -> Vec4 {
            let light = lights.load(1);
            let tint = light.tints[pixel.x as usize] + light.turned * light.position;
            tint.extend(others.load(2).powers[1] * gain)
        }",
        "pub fn k(a: &Texture3D<Vec4>, b: &TextureCube<f32>, c: &TextureArray<i32>, d: &DepthTextureArray, e: &DepthCube, f: &Texture<UVec2>,
            s: &Sampler, t: &ComparisonSampler, pixel: IVec2) -> Vec4 {
            let place = pixel.as_vec2().extend(1.0);
            let shadow = d.compare(t, place.xy(), 1, 0.5) + e.compare(t, place, 0.5);
            a.load(pixel.extend(0)) + b.sample(s, place) + c.load(pixel, 1) as f32 + shadow + f.load(pixel).y as f32
        }",
        "pub fn k(grade: Mat3, turns: &[Mat2; 2], palette: &[Vec3; 4], weights: &[f32; 3], pixel: IVec2) -> Vec4 {
            let step = (pixel.x & 3) as usize;
            let turned = turns[1] * palette[step].xy() * weights[2];
            (grade * palette[2]).extend(turned.x + turned.y)
        }",
        // Without a target.
        "pub fn k(color: &Frame<Vec4>, brightest: &StorageBuffer<f32>, gain: f32, pixel: IVec2) {
            brightest.store((pixel.x & 7) as usize, color.load(pixel).x * gain);
        }",
        // Drawn behind a vertex shader: with all, and with nothing to read but what is interpolated.
        "pub fn k(shadow: &DepthTexture, compare: &ComparisonSampler, bias: f32, coord: Quad<Vec3>, shade: Quad<f32>) -> Quad<Vec4> {
            let lit = shadow.compare(compare, coord.truncate(), coord.z() - bias);
            Vec4::ONE * (lit * shade).average()
        }",
        "pub fn k(place: Quad<Vec2>) -> Quad<Vec4> {
            Vec4::ONE * place.average().x()
        }",
    ];
    for (k, text) in reads.into_iter().enumerate() {
        compiles(&folder, &format!("bindings_{k}.rs"), text).unwrap_or_else(|e| panic!("{e}"));
    }
    std::fs::remove_dir_all(&folder).expect("removed");
}

#[test]
fn bindings_compile_with_overrides_of_every_type() {
    let folder = folder("overrides");
    runtime(&folder);
    let text = "
        options! {
            /// Options.
            pub struct Cfg {
                /// One.
                pub tau: f32 [-1.0..=1.0e9] = -0.5,
                /// Two.
                pub dyn_: i32 = -2147483648,
                /// Three.
                pub Default: u32 = 4294967295,
                /// Four.
                pub on: bool = true,
            }
        }
        pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
            let gain = if cfg.on { cfg.tau } else { cfg.dyn_ as f32 };
            color.load(pixel) * gain * cfg.Default as f32
        }";
    let all = Settings::default().override_options(["tau", "dyn-", "Default", "on"]);
    compiles_with(&folder, "bindings.rs", text, &all).unwrap_or_else(|e| panic!("{e}"));
    let written = std::fs::read_to_string(folder.join("bindings.rs")).expect("written");
    assert!(
        written.contains("tau: -0.5") && written.contains("range: Some([-1f64, 1000000000f64])"),
        "{written}"
    );
    std::fs::remove_dir_all(&folder).expect("removed");
}

/// A shader with candidates has the modules of all of them, each text once, and a pass that chooses.
#[test]
fn bindings_of_candidates_compile() {
    let folder = folder("candidates");
    runtime(&folder);
    let text = "
        /// A blur.
        pub fn blur(color: &Frame<Vec4>, gain: f32, pixel: IVec2) -> Vec4 {
            let mut sum = Vec4::ZERO;
            for y in -1..=1 {
                for x in -1..=1 {
                    sum += color.load(pixel + ivec2(x, y));
                }
            }
            sum * gain
        }";
    std::fs::write(folder.join("blur.rs"), text).expect("written");
    let config = Config::new().out_dir(&folder).file_with(folder.join("blur.rs"), |k| {
        // The candidates are of settings that come later, too.
        k.candidate("looped", |s| s.unroll(Unroll::None))
            .candidate("whole", |s| s.unroll(Unroll::Full))
            .candidate("shared", |s| s.share(Share::WORKGROUP))
            .workgroup(16, 4)
    });
    config.compile().unwrap_or_else(|e| panic!("{e}"));
    rustc(&folder, "straightline.rs", &BINDINGS);
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect("written");
    let written = read("straightline.rs");
    for part in [
        "pub mod blur_looped {",
        "pub mod blur_shared {",
        "/// `whole` has the same text as `default`.",
        "pub static CANDIDATES: [straightline_runtime::Candidate<'static>; 3] = [",
        "pub fn choose(",
    ] {
        assert!(written.contains(part), "{part}\n{written}");
    }
    assert!(!written.contains("mod blur_whole"), "{written}");
    assert_eq!(
        read("blur.candidates.txt"),
        "# candidates for blur\ndefault blur\nlooped blur_looped\nshared blur_shared\n"
    );
    assert!(read("blur_looped.wgsl").contains("@workgroup_size(16, 4, 1)"));
    std::fs::remove_dir_all(&folder).expect("removed");
}

/// Options of every type vary, under names that Rust has for other things, with values that are no names.
#[test]
fn bindings_of_variants_compile() {
    let folder = folder("variants");
    runtime(&folder);
    let text = "
        options! {
            /// Options.
            pub struct Cfg {
                /// One.
                pub tau: f32 [-1.0..=1.0e9] = -0.5,
                /// Two.
                pub result: i32 = 1,
                /// Three.
                pub on: bool = true,
                /// Four.
                pub variant: Kind = Kind::DepthNormals,
            }
        }
        /// Kinds.
        pub enum Kind {
            /// A.
            DepthNormals,
            /// B.
            Self_,
        }
        /// A filter.
        pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
            let gain = if cfg.on { cfg.tau } else { cfg.result as f32 };
            match cfg.variant {
                Kind::DepthNormals => color.load(pixel) * gain,
                Kind::Self_ => color.load(pixel) + gain,
            }
        }";
    std::fs::write(folder.join("k.rs"), text).expect("written");
    let config = Config::new().out_dir(&folder).file_with(folder.join("k.rs"), |k| {
        k.variants(|v| {
            v.set("tau", [-0.5, 0.5, 1e7])
                .set("result", [-1, 1])
                .set("on", [true, false])
                .set("variant", ["depth-normals", "self_"])
        })
    });
    config.compile().unwrap_or_else(|e| panic!("{e}"));
    rustc(&folder, "straightline.rs", &BINDINGS);
    let written = std::fs::read_to_string(folder.join("straightline.rs")).expect("written");
    // Options that are not read decide nothing: `result` with `on`, `tau` without it.
    for part in [
        "24 combinations of options, 10 shaders",
        "pub enum ResultValue {",
        "pub enum VariantValue {",
        "Minus0_5,",
        "pub on: bool,",
        "SelfValue,",
        "pub const ALL: [Variant; 24]",
    ] {
        assert!(written.contains(part), "{part}\n{written}");
    }
    let table = std::fs::read_to_string(folder.join("k.variants.txt")).expect("written");
    assert!(table.starts_with("k: 24 combinations, 10 shaders, "), "{table}");
    // The shader of the other `result`, which is not read.
    let shared = "tau=-0.5 result=1 on=true variant=depth-normals k_minus_0_5_minus_1_true_depth_normals 753 0 1";
    let mut rows = table
        .lines()
        .map(|row| row.split_whitespace().collect::<Vec<_>>().join(" "));
    assert!(rows.any(|row| row == shared), "{table}");
    std::fs::remove_dir_all(&folder).expect("removed");
}

/// Constants are of the text that they were generated with.
#[test]
fn bindings_of_another_text_do_not_compile() {
    let folder = folder("changed");
    runtime(&folder);
    let text = "pub fn k(color: &Frame<Vec4>, gain: f32, pixel: IVec2) -> Vec4 { color.load(pixel) * gain }";
    compiles(&folder, "bindings.rs", text).unwrap_or_else(|e| panic!("{e}"));
    let wgsl = std::fs::read_to_string(folder.join("shader.wgsl")).expect("written");
    let write = |text: String| std::fs::write(folder.join("shader.wgsl"), text).expect("written");
    write(wgsl.replace("@workgroup_size(16, 16", "@workgroup_size(8, 16"));
    let said = try_rustc(&folder, "bindings.rs", &BINDINGS).expect_err("another text");
    assert!(said.contains("was changed since its bindings were generated"), "{said}");
    // As a checkout on Windows has it.
    write(wgsl.replace('\n', "\r\n"));
    rustc(&folder, "bindings.rs", &BINDINGS);
    std::fs::remove_dir_all(&folder).expect("removed");
}

/// rustc takes no bare carriage return and no mark of writing direction in documentation.
#[test]
fn bindings_compile_whatever_is_documented() {
    let folder = folder("words");
    runtime(&folder);
    for (k, words) in [
        "a\\rb */ c \\\\",
        "\\u{202e}back\\u{2066}",
        "line\\nline\\u{2028}line",
        "\\\"quoted\\\" `${x}` */",
    ]
    .into_iter()
    .enumerate()
    {
        let text = format!(
            "#[doc = \"{words}\"]\npub fn k(color: &Frame<Vec4>, gain: f32, pixel: IVec2) -> Vec4 {{ color.load(pixel) * gain }}"
        );
        compiles(&folder, &format!("words_{k}.rs"), &text).unwrap_or_else(|e| panic!("{e}"));
    }
    std::fs::remove_dir_all(&folder).expect("removed");
}

#[test]
fn bindings_compile_whatever_uniforms_are_called() {
    let folder = folder("names");
    runtime(&folder);
    let names = [
        "Pass",
        "Some",
        "Ok",
        "None",
        "Err",
        "MANIFEST",
        "WGSL",
        "ENTRY_POINT",
        "padding_0",
        "padding_1",
        "value_0",
        "bytes",
        "queue",
        "value",
        "Inputs",
        "Error",
        "Resource",
        "wgpu",
        "dyn",
        "gen",
        "place",
        "u32",
        "Self_",
        "Default",
        "to_bytes",
    ];
    for (k, name) in names.into_iter().enumerate() {
        let text = format!(
            "pub fn k(color: &Frame<Vec4>, first: f32, {name}: Vec2, last: Vec3, pixel: IVec2) -> Vec4 {{
                color.load(pixel) * first + {name}.x * last.y
            }}"
        );
        // Some are no names of Rust's, or of a shading language's: those are refused before.
        let _ = compiles(&folder, &format!("bindings_{k}.rs"), &text);
    }
    std::fs::remove_dir_all(&folder).expect("removed");
}

/// Writes the bindings of the kernels beside them, and of a built-in one, as a build script does.
fn write(out: &Path) {
    let kernel = |name: &str| format!("tests/bindings/kernels/{name}.rs");
    let written = Config::new()
        .file_with(kernel("all"), |k| k.format(Format::Rgba32Float))
        .file_with(kernel("all"), |k| {
            k.name("tile").region(true).group(1).binding("color", 7)
        })
        .file_with(kernel("graded"), |k| k.format(Format::Rgba32Float))
        .file_with(kernel("drawn"), |k| k.stage(Stage::Fragment))
        .file_with(kernel("several"), |k| k.stage(Stage::Fragment))
        .file_with(kernel("lit"), |k| {
            k.format(Format::Rgba32Float).parameters(Parameters::Immediate)
        })
        .file(kernel("waiting"))
        .file_with(kernel("glow"), |k| k.format(Format::Rgba32Float))
        .file_with(kernel("levels"), |k| {
            k.format(Format::Rgba32Float).fuse(Fuse::Share).most_outputs(2)
        })
        .file_with(kernel("faded"), |k| {
            let k = k.format(Format::Rgba32Float).set("strength", 0.75);
            k.override_options(["strength", "inverted"])
        })
        .kernel("sraa", |k| {
            let k = k.set("pattern", "latin4").set("metric", "depth").set("tau", "uniform");
            k.unroll(Unroll::None).format(Format::Rgba32Float)
        })
        .plain_bindings()
        .out_dir(out)
        .compile();
    written.unwrap_or_else(|e| panic!("{e}"));
}

fn files(folder: &Path) -> BTreeMap<String, String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let named = paths.filter(|path| path.is_file()).map(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        (name, std::fs::read_to_string(&path).expect("a text"))
    });
    named.collect()
}

#[test]
fn captured_bindings_are_up_to_date() {
    let captured = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bindings");
    let out = std::env::temp_dir().join(format!("straightline-captured-{}", std::process::id()));
    std::fs::create_dir_all(&out).expect("a folder");
    write(&out);
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        write(&captured);
    }
    let (written, present) = (files(&out), files(&captured));
    std::fs::remove_dir_all(&out).expect("removed");
    for (name, text) in &written {
        assert!(
            present.get(name) == Some(text),
            "codegen/tests/bindings/{name} is not what is generated: STRAIGHTLINE_BLESS=1 cargo test --workspace --test codegen \
             bindings::"
        );
    }
    assert_eq!(written.len(), present.len(), "a file is generated no more: delete it");
}
