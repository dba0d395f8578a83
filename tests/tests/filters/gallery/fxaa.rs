//! FXAA 3.11 as its author wrote it: NVIDIA's shader, from the text that Debian's `libjs-three` holds, run by OpenGL.

use straightline_bench::execute::SamplerState;
use straightline_kernels::prelude::*;
use straightline_tests::gl::{Context, Program, Texture, Varying};

const FILE: &str = "/usr/share/javascript/three/examples/js/shaders/FXAAShader.js";

/// The picture of the reference, quality preset 39, which reads the brightness where its author has it: in the fourth component.
pub fn reference(color: &Frame<Vec4>) -> Frame<Vec4> {
    let luma = |t: Vec3| 0.299 * t.x + 0.587 * t.y + 0.114 * t.z;
    let with_luma = color.texels().iter().map(|t| t.truncate().extend(luma(t.truncate())));
    let with_luma = Frame::new(color.size(), with_luma.collect());
    let (size, texel) = (color.size().to_array(), Vec2::ONE / color.size().as_vec2());
    let text = text();
    let program = Program::fragment(&text, size)
        .texture(Texture::image("tDiffuse", &with_luma).sampler(SamplerState::default()))
        .uniform("resolution", texel.to_array())
        .varying(Varying {
            name: "vUv".to_owned(),
            location: None,
            components: 2,
            corners: [[0.0; 4], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]],
        });
    let context = Context::desktop().unwrap_or_else(|e| panic!("this test needs OpenGL: {e}"));
    let shown = context.run(&program).unwrap_or_else(|e| panic!("{FILE}: {e}"));
    Frame::new(color.size(), shown.into_iter().map(Vec4::from).collect())
}

/// The shader in GLSL 3.30, with the preset and the brightness chosen.
fn text() -> String {
    let script = std::fs::read_to_string(FILE).unwrap_or_else(|e| {
        panic!("{FILE}: {e}; it is in Debian's package `libjs-three`: apt-get install libjs-three")
    });
    let (_, shader) = script.split_once("fragmentShader: [").expect("a fragment shader");
    let (lines, _) = shader.split_once("].join(").expect("its end");
    let line = |line: &str| {
        Some(
            line.trim()
                .strip_prefix('"')?
                .trim_end_matches(',')
                .strip_suffix('"')?
                .to_owned(),
        )
    };
    let lines: Vec<String> = lines.lines().filter_map(line).collect();
    let mut text = format!(
        "#version 330\n#define FXAA_GATHER4_ALPHA 0\nout vec4 result;\n{}",
        lines.join("\n")
    );
    for (there, here) in [
        ("#define FXAA_QUALITY_PRESET 12", "#define FXAA_QUALITY_PRESET 39"),
        ("#define FXAA_GREEN_AS_LUMA 1", "#define FXAA_GREEN_AS_LUMA 0"),
        ("varying vec2", "in vec2"),
        ("texture2D(", "texture("),
        ("gl_FragColor", "result"),
    ] {
        assert!(text.contains(there), "{FILE} has no `{there}`");
        text = text.replace(there, here);
    }
    text
}
