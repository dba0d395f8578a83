//! The runner of OpenGL itself, on shaders whose pictures are known by a formula.

use straightline_bench::execute::{Address, Comparison, SamplerState};
use straightline_codegen::Format;
use straightline_kernels::prelude::{Frame, Vec4};
use straightline_tests::gl::{Context, Program, Texture, Varying};

/// Neither side a multiple of a workgroup's or of a row's alignment.
const SIZE: [u32; 2] = [7, 5];

fn desktop() -> Context {
    Context::desktop().unwrap_or_else(|e| panic!("this test needs OpenGL: {e}"))
}

fn es() -> Context {
    Context::es().unwrap_or_else(|e| panic!("this test needs OpenGL ES: {e}"))
}

/// Builds a picture from a function of the pixel.
fn picture(of: impl Fn(u32, u32) -> [f32; 4]) -> Vec<[f32; 4]> {
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    pixels.map(|(x, y)| of(x, y)).collect()
}

fn frame(texels: Vec<[f32; 4]>) -> Frame<Vec4> {
    Frame::new(SIZE.into(), texels.into_iter().map(Vec4::from).collect())
}

#[track_caller]
fn expect(context: &Context, program: &Program<'_>, expected: &[[f32; 4]]) {
    let found = context.run(program).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(found, expected, "{}", program.text);
}

/// Two textures, one of them an array, and uniforms of three types; the same body in both languages.
const FRAGMENT: &str = "
uniform sampler2D color;
uniform sampler2DArray layers;
uniform ivec2 shift;
uniform float gain;
uniform uvec3 offset;
out vec4 result;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(color, 0);
    vec4 own = texelFetch(color, clamp(pixel + shift, ivec2(0), size - 1), 0);
    result = gain * own + texelFetch(layers, ivec3(pixel, 1), 0) + vec4(offset, 0.0);
}
";

fn fragment<'a>(text: &'a str) -> (Program<'a>, Vec<[f32; 4]>) {
    let color = |x: u32, y: u32| [x as f32, y as f32, 0.1, -3.0];
    let layer = |k: u32| {
        frame(picture(move |x, y| {
            [(k * 100 + 10 * y + x) as f32, 0.25, 1.0e-7, 1.0e30]
        }))
    };
    let program = Program::fragment(text, SIZE)
        .texture(Texture::image("color", &frame(picture(color))))
        .texture(Texture::array("layers", &[layer(0), layer(1), layer(2)]))
        .uniform("shift", [2, -1])
        .uniform("gain", 0.5)
        .uniform("offset", [1u32, 2, 3]);
    let expected = picture(|x, y| {
        let own = color((x + 2).min(SIZE[0] - 1), y.max(1) - 1);
        let layer = [(100 + 10 * y + x) as f32, 0.25, 1.0e-7, 1.0e30];
        let offset = [1.0, 2.0, 3.0, 0.0];
        [0, 1, 2, 3].map(|k| 0.5 * own[k] + layer[k] + offset[k])
    });
    (program, expected)
}

#[test]
fn fragments_read_textures_and_uniforms() {
    let text = format!("#version 330\n{FRAGMENT}");
    let (program, expected) = fragment(&text);
    expect(&desktop(), &program, &expected);
    let precisions =
        "precision highp float;\nprecision highp int;\nprecision highp sampler2DArray;\nprecision highp sampler2D;";
    for version in ["300", "310", "320"] {
        let text = format!("#version {version} es\n{precisions}\n{FRAGMENT}");
        let (program, expected) = fragment(&text);
        expect(&es(), &program, &expected);
    }
}

/// An image, a uniform block and storage buffers by name and by number.
const COMPUTE: &str = "
layout(local_size_x = 4, local_size_y = 2) in;
layout(rgba32f, binding = 2) uniform writeonly highp image2D destination;
layout(std140, binding = 5) uniform Parameters {
    vec2 scale;
    int bias;
};
layout(std430, binding = 1) readonly buffer Weights {
    float weights[];
};
layout(std430, binding = 3) readonly buffer Rows {
    vec4 rows[];
};

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(destination)))) {
        return;
    }
    vec2 scaled = vec2(pixel) * scale;
    imageStore(destination, pixel, vec4(scaled, weights[pixel.x], float(bias)) + rows[pixel.y]);
}
";

fn bytes(components: &[f32]) -> Vec<u8> {
    components.iter().flat_map(|c| c.to_ne_bytes()).collect()
}

fn compute<'a>(text: &'a str) -> (Program<'a>, Vec<[f32; 4]>) {
    let mut parameters = bytes(&[2.0, 0.25]);
    parameters.extend(7i32.to_ne_bytes());
    parameters.extend([0; 4]);
    let weights: Vec<f32> = (0..SIZE[0]).map(|x| 1.0 / (1.0 + x as f32)).collect();
    let row = |y: u32| [0.0, 0.0, -(y as f32), 0.5];
    let program = Program::compute(text, SIZE, [4, 2], 2)
        .block("Parameters", parameters)
        .buffer("Weights", bytes(&weights))
        .buffer(3, bytes(&(0..SIZE[1]).flat_map(row).collect::<Vec<_>>()));
    let expected = picture(|x, y| [2.0 * x as f32, 0.25 * y as f32, weights[x as usize] - y as f32, 7.5]);
    (program, expected)
}

#[test]
fn computes_write_images() {
    for version in ["430", "450"] {
        let text = format!("#version {version}\n{COMPUTE}");
        let (program, expected) = compute(&text);
        expect(&desktop(), &program, &expected);
    }
    for version in ["310", "320"] {
        let text = format!("#version {version} es\n{COMPUTE}");
        let (program, expected) = compute(&text);
        expect(&es(), &program, &expected);
    }
}

/// Conversion of a value by each format, in both stages.
#[test]
fn pictures_of_every_format() {
    let third = 1.0 / 3.0;
    let formats = [
        (Format::Rgba32Float, "rgba32f", third),
        (Format::Rgba16Float, "rgba16f", half::f16::from_f32(third).to_f32()),
        (Format::Rgba8Unorm, "rgba8", 85.0 / 255.0),
    ];
    for (format, name, stored) in formats {
        for (context, version) in [(desktop(), "430"), (es(), "310 es")] {
            let text = format!(
                "#version {version}
                precision highp float;
                layout(local_size_x = 1) in;
                layout({name}, binding = 0) uniform writeonly highp image2D destination;
                void main() {{
                    imageStore(destination, ivec2(gl_GlobalInvocationID.xy), vec4(1.0 / 3.0));
                }}"
            );
            let program = Program::compute(&text, SIZE, [1, 1], 0).format(format);
            expect(&context, &program, &picture(|_, _| [stored; 4]));
            let text = format!(
                "#version {version}
                precision highp float;
                out vec4 result;
                void main() {{ result = vec4(1.0 / 3.0); }}"
            );
            let program = Program::fragment(&text, SIZE).format(format);
            expect(&context, &program, &picture(|_, _| [stored; 4]));
        }
    }
}

#[test]
fn linear_filtering_weighs_four_texels() {
    let sampler = |address| SamplerState {
        linear: true,
        address,
        ..SamplerState::default()
    };
    let body = "
        uniform sampler2D color;
        out vec4 result;
        void main() { result = textureLod(color, (floor(gl_FragCoord.xy) - 0.5) / 2.0, 0.0); }
    ";
    // Pixels 1 and 2 read at the centres of the two texels, pixel 0 at that of the texel beyond the border.
    let texels = vec![
        [0.0, 1.0, 4.0, 0.0],
        [1.0, 1.0, 8.0, 0.0],
        [0.0, 3.0, 4.0, 0.0],
        [1.0, 3.0, 8.0, 0.0],
    ];
    for (context, version) in [(desktop(), "330"), (es(), "300 es\nprecision highp float;")] {
        let text = format!("#version {version}\n{body}");
        for (address, beyond) in [(Address::Clamp, 0.0), (Address::Repeat, 1.0), (Address::Mirror, 0.0)] {
            let color = Texture::new("color", [2, 2], texels.clone()).sampler(sampler(address));
            let found = context.run(&Program::fragment(&text, SIZE).texture(color));
            let found = found.unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(found[SIZE[0] as usize + 1], texels[0], "{version} {address:?}");
            assert_eq!(found[SIZE[0] as usize + 2], texels[1], "{version} {address:?}");
            assert_eq!(found[2 * SIZE[0] as usize + 1], texels[2], "{version} {address:?}");
            assert_eq!(found[SIZE[0] as usize][0], beyond, "{version} {address:?}");
        }
        let between = text.replace("(floor(gl_FragCoord.xy) - 0.5) / 2.0", "vec2(0.5, 0.375)");
        let color = Texture::new("color", [2, 2], texels.clone()).sampler(sampler(Address::Clamp));
        let program = Program::fragment(&between, SIZE).texture(color);
        expect(&context, &program, &picture(|_, _| [0.5, 1.5, 6.0, 0.0]));
    }
}

#[test]
fn shadows_are_compared() {
    let body = "
        uniform sampler2DShadow depth;
        out vec4 result;
        void main() {
            vec2 place = gl_FragCoord.xy / vec2(textureSize(depth, 0));
            result = vec4(textureLod(depth, vec3(place, 0.5), 0.0));
        }
    ";
    // 0.5 is among them.
    let depth = |x: u32| 0.25 + x as f32 / 8.0;
    let depths = picture(|x, _| [depth(x), f32::NAN, f32::NAN, f32::NAN]);
    let precisions = "precision highp float;\nprecision highp sampler2DShadow;";
    for (context, version) in [(desktop(), "330".to_owned()), (es(), format!("300 es\n{precisions}"))] {
        let text = format!("#version {version}\n{body}");
        let comparisons = [
            Comparison::LessEqual,
            Comparison::Less,
            Comparison::GreaterEqual,
            Comparison::Greater,
        ];
        for comparison in comparisons {
            let passes = |depth: f32| match comparison {
                Comparison::LessEqual => 0.5 <= depth,
                Comparison::Less => 0.5 < depth,
                Comparison::GreaterEqual => 0.5 >= depth,
                Comparison::Greater => 0.5 > depth,
            };
            let state = SamplerState {
                linear: false,
                comparison,
                ..SamplerState::default()
            };
            let texture = Texture::new("depth", SIZE, depths.clone()).sampler(state).compares();
            let program = Program::fragment(&text, SIZE).texture(texture);
            let expected = picture(|x, _| [f32::from(u8::from(passes(depth(x)))); 4]);
            expect(&context, &program, &expected);
        }
    }
}

#[test]
fn varyings_are_interpolated() {
    let body = "in vec3 normal;\nout vec4 result;\nvoid main() { result = vec4(normal, 1.0); }";
    let located = format!("layout(location = 3) {body}").replace("in vec3", "in highp vec3");
    let cases = [
        (desktop(), format!("#version 330\n{body}"), None),
        (desktop(), format!("#version 430\n{located}"), Some(3)),
        (es(), format!("#version 300 es\nprecision highp float;\n{body}"), None),
        (
            es(),
            format!("#version 310 es\nprecision highp float;\n{located}"),
            Some(3),
        ),
    ];
    for (context, text, location) in cases {
        let program = Program::fragment(&text, SIZE).varying(Varying {
            name: "normal".to_owned(),
            location,
            components: 3,
            corners: [[1.0, 0.0, 0.0, 9.0], [1.0, 7.0, 0.0, 9.0], [1.0, 0.0, -5.0, 9.0]],
        });
        let found = context.run(&program).unwrap_or_else(|e| panic!("{e}"));
        let expected = picture(|x, y| [1.0, x as f32 + 0.5, -(y as f32 + 0.5), 1.0]);
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1.0e-5, "{found} and {expected}:\n{text}");
        }
    }
}

/// Errors name the problem and its place.
#[test]
fn refusals_quote_the_text() {
    let context = desktop();
    let refused = |program: Program<'_>, said: &[&str]| {
        let error = context.run(&program).expect_err(program.text);
        for part in said {
            assert!(error.contains(part), "{error}");
        }
    };
    let bad = "#version 330\nout vec4 result;\nvoid main() {\n    result = vec4(missing);\n}";
    refused(
        Program::fragment(bad, SIZE),
        &[
            "the compiler refuses it",
            "`missing'",
            "   4     result = vec4(missing);",
        ],
    );
    let bad = "#version 330\nin vec2 place;\nout vec4 result;\nvoid main() {\n    result = place.xyxy;\n}";
    refused(
        Program::fragment(bad, SIZE),
        &["no varying is given for the input `place`"],
    );
    let place = Varying {
        name: "place".to_owned(),
        location: None,
        components: 3,
        corners: [[0.0; 4]; 3],
    };
    refused(
        Program::fragment(bad, SIZE).varying(place),
        &["the linker refuses it", "place", "   5     result = place.xyxy;"],
    );
    let buffers = format!("#version 430\n{COMPUTE}");
    let of = |place: &str| Program::compute(&buffers, SIZE, [4, 2], 2).buffer(place, vec![0; 4]);
    refused(of("weights"), &["`weights` is not a buffer of the text"]);
    let good = "#version 330\nuniform vec2 pair;\nuniform sampler2D color;\nout vec4 result;\nvoid main() { result = texelFetch(color, ivec2(pair), 0); }";
    refused(
        Program::fragment(good, SIZE).uniform("pairs", 1.0),
        &["`pairs` is not a name of the text"],
    );
    refused(
        Program::fragment(good, SIZE).uniform("pair", 1.0),
        &["setting the uniform `pair`", "GL_INVALID_OPERATION"],
    );
    let few = Texture::new("color", SIZE, vec![[0.0; 4]; 3]);
    refused(
        Program::fragment(good, SIZE).texture(few),
        &["`color` of 7x5: expected 35 texels, found 3"],
    );
    refused(
        Program::fragment("void main() {}", SIZE),
        &["does not begin with `#version`"],
    );
    // None of that stays behind.
    let text = format!("#version 330\n{FRAGMENT}");
    let (program, expected) = fragment(&text);
    expect(&context, &program, &expected);
}

/// Contexts of several threads do not disturb each other, nor do two of one thread.
#[test]
fn contexts_live_side_by_side() {
    let (first, second) = (desktop(), es());
    println!(
        "{}\n{}",
        first.driver().expect("it works"),
        second.driver().expect("it works")
    );
    std::thread::scope(|scope| {
        for _ in 0..3 {
            scope.spawn(|| {
                let text = format!("#version 430\n{COMPUTE}");
                let (program, expected) = compute(&text);
                let context = desktop();
                for _ in 0..5 {
                    expect(&context, &program, &expected);
                }
            });
        }
        let text = format!("#version 330\n{FRAGMENT}");
        let (program, expected) = fragment(&text);
        expect(&first, &program, &expected);
        drop(second);
        expect(&first, &program, &expected);
    });
}
