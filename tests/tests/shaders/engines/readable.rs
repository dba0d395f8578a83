//! Has compilers read the shaders of an engine's folder, in what the engine puts around them.

use std::collections::BTreeMap;
use std::path::PathBuf;
use straightline_codegen::Stage;
use straightline_tests::compilers;

type Files = BTreeMap<String, String>;

/// Has the shaders of a folder read; says how many there are.
///
/// # Errors
///
/// What the first compiler that refuses one says of it.
pub fn check(engine: &str, files: &Files) -> Result<usize, String> {
    let ending = |end: &str| {
        let found = files.iter().find(|(name, _)| name.ends_with(end));
        found.map(|(_, text)| text.as_str()).ok_or(format!("no file *{end}"))
    };
    let es = "#version 300 es\n";
    match engine {
        "webgl2" => essl(&literal(ending(".js")?, "FRAGMENT")?)?,
        "webgpu" => wgsl(&format!(
            "{}{}",
            literal(ending(".js")?, "VERTEX")?,
            literal(ending(".js")?, "FRAGMENT")?
        ))?,
        "three" => {
            essl(&format!("{es}{}", literal(ending("-pass.js")?, "FRAGMENT")?))?;
            wgsl(&between(ending("-node.js")?, "wgslFn(`", "`);")?)?;
        }
        "postprocessing" => {
            let effect = literal(ending(".js")?, "FRAGMENT")?;
            let around = "precision highp float;\nuniform highp sampler2D inputBuffer;\nuniform vec2 resolution;\nuniform vec2 texelSize;\n\
                uniform float cameraNear, cameraFar, time;\nfloat readDepth(const in vec2 uv) { return uv.x; }\n\
                float getViewZ(const in float depth) { return depth; }\nout vec4 colour;\n";
            let main = "void main() { mainImage(vec4(0.0), vec2(0.0), colour); }\n";
            essl(&format!("{es}{around}{effect}{main}"))?;
        }
        "babylon" => essl(&between(ending(".js")?, "FragmentShader\"] = `", "`;")?)?,
        "playcanvas" => {
            let around = "precision highp float;\nlayout(location = 0) out highp vec4 pc_fragColor;\n#define gl_FragColor pc_fragColor\n";
            essl(&format!("{es}{around}{}", literal(ending(".mjs")?, "FRAGMENT_GLSL")?))?;
        }
        "pixi" => {
            essl(&literal(ending(".js")?, "FRAGMENT")?)?;
            wgsl(&literal(ending(".js")?, "WGSL")?)?;
        }
        "opengl" => c(files)?,
        "panda3d" => python(ending(".py")?)?,
        "mpv" => mpv(ending(".glsl")?)?,
        "libretro" => slang(ending(".slang")?)?,
        "godot" => godot(ending(".gdshader")?)?,
        "bevy" => wgsl(ending(".wgsl")?)?,
        "unity" => unity(ending(".shader")?, ending(".hlsl")?)?,
        "reshade" => reshade(ending(".fx")?)?,
        "unreal" => unreal(ending(".usf")?)?,
        other => return Err(format!("no compiler for `{other}`")),
    }
    Ok(1)
}

/// Has the shaders of a chain's folder read; says how many there are.
///
/// # Errors
///
/// As of [`check`].
pub fn check_chain(engine: &str, files: &Files) -> Result<usize, String> {
    let ending = |end: &str| {
        let found = files.iter().find(|(name, _)| name.ends_with(end));
        found.map(|(_, text)| text.as_str()).ok_or(format!("no file *{end}"))
    };
    let mut count = 0;
    match engine {
        "webgpu" => {
            let vertex = literal(ending(".js")?, "VERTEX")?;
            for text in all_between(ending(".js")?, "        code: `", "`,\n")? {
                wgsl(&format!("{vertex}{text}"))?;
                count += 1;
            }
        }
        "three" => {
            for text in all_between(ending("-pass.js")?, "    `\n", "`,\n")? {
                essl(&format!("#version 300 es\n{text}"))?;
                count += 1;
            }
            for text in all_between(ending("-node.js")?, "    wgslFn(`", "`),\n")? {
                wgsl(&text)?;
                count += 1;
            }
        }
        "libretro" => {
            for (_, text) in files.iter().filter(|(name, _)| name.ends_with(".slang")) {
                slang(text)?;
                count += 1;
            }
        }
        other => return Err(format!("`{other}` takes no chains")),
    }
    Ok(count)
}

/// Every text between two others.
fn all_between(text: &str, before: &str, behind: &str) -> Result<Vec<String>, String> {
    let parts = text.split(before).skip(1);
    parts
        .map(|part| between(&format!("{before}{part}"), before, behind))
        .collect()
}

/// Text between two others, the last of which ends it first.
fn between(text: &str, before: &str, behind: &str) -> Result<String, String> {
    let rest = text.split_once(before).ok_or(format!("no `{before}`"))?.1;
    let found = rest.split_once(behind).ok_or(format!("no `{behind}`"))?.0;
    // As JavaScript reads what is between backquotes.
    Ok(found.replace("\\`", "`").replace("\\${", "${").replace("\\\\", "\\"))
}

/// The value of a constant of JavaScript.
fn literal(text: &str, name: &str) -> Result<String, String> {
    between(text, &format!("const {name} = `"), "`;")
}

fn essl(text: &str) -> Result<(), String> {
    opengl(text, "frag")
}

/// glslang on GLSL of OpenGL.
fn opengl(text: &str, ending: &str) -> Result<(), String> {
    let path = temporary(&format!("{}.{ending}", number()));
    std::fs::write(&path, text).map_err(|e| e.to_string())?;
    let read = compilers::opengl(&path);
    std::fs::remove_file(&path).map_err(|e| e.to_string())?;
    read
}

/// A number for a file that no other has.
fn number() -> u32 {
    use std::sync::atomic::{AtomicU32, Ordering};
    static NEXT: AtomicU32 = AtomicU32::new(0);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

fn temporary(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("straightline-engines-{}-{name}", std::process::id()))
}

/// naga on WGSL.
fn wgsl(text: &str) -> Result<(), String> {
    // Browsers ask for the line, and naga does not know it.
    let text = text.replace("enable subgroups;", "");
    let parsed = naga::front::wgsl::parse_str(&text);
    parsed.map(drop).map_err(|error| error.emit_to_string(&text))
}

/// A C compiler on the header, with all its warnings.
fn c(files: &Files) -> Result<(), String> {
    let (_, text) = files.iter().find(|(name, _)| name.ends_with(".h")).ok_or("no header")?;
    let function = between(text, "static const char ", "_vertex[]")?;
    let uses = format!(
        "int main(void) {{ return {function}_vertex[0] + {function}_fragment[0] + !{function}_samplers[0].name; }}\n"
    );
    let path = temporary(&format!("{}.c", number()));
    std::fs::write(&path, format!("{text}{text}{uses}")).map_err(|e| e.to_string())?;
    let flags = [
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-Wno-unused-const-variable",
        "-pedantic",
        "-Wno-overlength-strings",
        "-fsyntax-only",
    ];
    let ran = std::process::Command::new("cc").args(flags).arg(&path).output();
    let ran = ran.map_err(|e| format!("cannot run cc ({e}): install Debian's gcc"))?;
    std::fs::remove_file(&path).map_err(|e| e.to_string())?;
    match ran.status.success() {
        true => Ok(()),
        false => Err(String::from_utf8_lossy(&ran.stderr).into_owned()),
    }
}

/// Both shaders of a module of Python.
fn python(text: &str) -> Result<(), String> {
    for (name, stage) in [("VERTEX", "vert"), ("FRAGMENT", "frag")] {
        let (_, rest) = text.split_once(&format!("{name} = \"\"\"")).ok_or("no shader")?;
        let (shader, _) = rest.split_once("\"\"\"").ok_or("no end of the shader")?;
        opengl(&shader.replace("\\\"", "\"").replace("\\\\", "\\"), stage)?;
    }
    Ok(())
}

/// Compiles a text with the definitions of mpv and libplacebo, and their `main`.
fn mpv(text: &str) -> Result<(), String> {
    let hook = text.split_once("//!HOOK MAIN").ok_or("no hook")?.1;
    let parameters = text.lines().filter_map(|line| line.strip_prefix("//!PARAM "));
    let parameters: String = parameters.map(|name| format!("const float {name} = 1.0;\n")).collect();
    let around = "#version 450\nlayout(set = 0, binding = 0) uniform sampler2D HOOKED_raw;\nlayout(location = 0) in vec2 HOOKED_pos;\n\
        #define HOOKED_tex(pos) textureLod(HOOKED_raw, pos, 0.0)\n#define HOOKED_size vec2(64.0)\n#define HOOKED_pt vec2(0.015625)\n\
        const int frame = 3;\nlayout(location = 0) out vec4 colour;\n";
    let main = "void main() { colour = hook(); }\n";
    compilers::compiled_glsl(&format!("{around}{parameters}{hook}{main}"), "frag").map(drop)
}

/// A slang file is two shaders: what stands before the first stage is in both.
fn slang(text: &str) -> Result<(), String> {
    let (common, stages) = text.split_once("#pragma stage vertex").ok_or("no vertex stage")?;
    let (vertex, fragment) = stages.split_once("#pragma stage fragment").ok_or("no fragment stage")?;
    compilers::compiled_glsl(&format!("{common}{vertex}"), "vert")?;
    compilers::compiled_glsl(&format!("{common}{fragment}"), "frag").map(drop)
}

/// Godot's language, after its own words are taken out of it: hints, the type of shader, the names of what it gives.
fn godot(text: &str) -> Result<(), String> {
    let line = |line: &str| match line.split_once(" : ") {
        Some((declared, hints)) if declared.starts_with("uniform") => match hints.split_once(" = ") {
            Some((_, value)) => format!("{declared} = {value}\n"),
            None => format!("{declared};\n"),
        },
        _ if line.starts_with("shader_type") || line.starts_with("render_mode") => String::new(),
        _ => format!("{line}\n"),
    };
    let body: String = text.lines().map(line).collect();
    let around =
        "#version 330\nout vec4 COLOR;\n#define FRAGCOORD gl_FragCoord\nuniform float TIME;\n#define fragment main\n";
    opengl(&format!("{around}{body}"), "frag")
}

/// The program of URP's shader, with the include in its place.
fn unity(shader: &str, include: &str) -> Result<(), String> {
    let program = between(shader, "HLSLPROGRAM", "ENDHLSL")?;
    // The include stands after the functions that it calls.
    let own = |line: &str| line.trim_start().starts_with("#include") && !line.contains("Packages/");
    let lines = program.lines().map(|line| if own(line) { include } else { line });
    let lines = lines.filter(|line| !line.trim_start().starts_with("#pragma") && !line.contains("Packages/"));
    let body = lines.collect::<Vec<_>>().join("\n");
    let library = "Texture2D<float4> _BlitTexture;\nfloat4 _BlitTexture_TexelSize, _Time, _ProjectionParams, _ZBufferParams, unity_OrthoParams;\n\
        float4x4 UNITY_MATRIX_V, UNITY_MATRIX_P, UNITY_MATRIX_I_P;\nSamplerState sampler_LinearClamp;\n\
        struct Varyings { float4 positionCS : SV_POSITION; };\n\
        float LoadSceneDepth(uint2 pixel) { return _BlitTexture.Load(int3(pixel, 0)).x; }\n\
        float3 LoadSceneNormals(uint2 pixel) { return _BlitTexture.Load(int3(pixel, 0)).xyz; }\n\
        float LinearEyeDepth(float depth, float4 terms) { return 1.0 / (terms.z * depth + terms.w); }\n";
    compilers::compiled_hlsl(&format!("{library}{body}"), Stage::Fragment, "Frag").map(drop)
}

/// ReShade's effect up to its technique, which is no HLSL.
fn reshade(text: &str) -> Result<(), String> {
    let (body, technique) = text.split_once("\ntechnique ").ok_or("no technique")?;
    let shader = between(technique, "PixelShader = ", ";")?;
    let mut annotated = false;
    let lines = body.lines().filter(|line| {
        let begins = line.starts_with("uniform") && line.ends_with('<');
        annotated |= begins;
        let ends = line.starts_with('>');
        annotated &= !ends;
        begins || !(annotated || ends || line.starts_with("#include"))
    });
    let lines = lines.map(
        |line| match line.split_once(" <").filter(|_| line.starts_with("uniform")) {
            Some((declared, _)) => format!("{declared};"),
            None => line.to_owned(),
        },
    );
    let body = lines.collect::<Vec<_>>().join("\n");
    let around = "#define BUFFER_WIDTH 64\n#define BUFFER_HEIGHT 64\nTexture2D<float4> back;\nSamplerState state;\n\
        #define BUFFER_RCP_WIDTH 0.015625\n#define BUFFER_RCP_HEIGHT 0.015625\n#define RESHADE_DEPTH_LINEARIZATION_FAR_PLANE 1000.0\n\
        namespace ReShade { static const int BackBuffer = 0; float GetLinearizedDepth(float2 uv) { return uv.x; } }\n\
        float4 tex2Dfetch(int s, int2 p) { return back.Load(int3(p, 0)); }\n\
        float4 tex2Dlod(int s, float4 p) { return back.SampleLevel(state, p.xy, p.w); }\n";
    compilers::compiled_hlsl(&format!("{around}{body}"), Stage::Fragment, &shader).map(drop)
}

/// Material of Unreal with a Custom node.
fn unreal(text: &str) -> Result<(), String> {
    let head = text
        .lines()
        .find(|line| line.starts_with("float4 ") && line.contains("(float2 position"));
    let head = head.ok_or("no function")?;
    let function = between(head, "float4 ", "(")?;
    let given = head.matches(", ").count();
    let around = "struct Views { float4 ViewSizeAndInvSize; float4x4 TranslatedWorldToView; };\nuniform Views View;\n\
        Texture2D<float4> post;\nSamplerState state;\nfloat2 ViewportUVToSceneTextureUV(float2 uv, uint id) { return uv; }\n\
        float4 SceneTextureLookup(float2 uv, int id, bool filtered) { return post.SampleLevel(state, uv, 0.0); }\n";
    let main = format!(
        "float4 node(float4 place : SV_Position) : SV_Target {{ return {function}(place.xy{}); }}\n",
        ", 1.0".repeat(given)
    );
    let body = text.replace("#pragma once", "");
    compilers::compiled_hlsl(&format!("{around}{body}{main}"), Stage::Fragment, "node").map(drop)
}

/// Compiles a text with the code that Shadertoy puts around an image.
///
/// # Errors
///
/// What the compiler says.
pub fn shadertoy(text: &str) -> Result<(), String> {
    let around = "#version 300 es\nprecision highp float;\nprecision highp int;\nuniform sampler2D iChannel0;\nuniform vec3 iResolution;\nout vec4 colour;\n";
    let main = "void main() { mainImage(colour, gl_FragCoord.xy); }\n";
    essl(&format!("{around}{text}{main}"))
}
