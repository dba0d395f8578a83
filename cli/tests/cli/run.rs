//! `run` on kernels of all kinds, and what it was not given.

use crate::common;

use common::{example, fails, here, is_empty, scratch, straightline, write};
use std::path::Path;

#[test]
fn any_kernel_runs_on_a_picture() {
    let folder = scratch("run");
    let picture = here("docs/detail.png");
    let out = folder.join("out.png");
    let out = out.to_str().unwrap();
    let run = |more: &[&str]| {
        let kernel = example("median");
        let mut words = vec!["run", kernel.as_str(), "--out", out];
        words.extend(more);
        straightline(&words)
    };
    for more in [
        &["--input", picture.as_str(), "--size", "64x48", "--executor", "cpu"][..],
        &["--input", picture.as_str(), "--executor", "gpu", "--unroll", "2"][..],
    ] {
        let finished = run(more);
        let said = String::from_utf8_lossy(&finished.stderr).into_owned();
        // The interpreter wants a picture of the output's size for a `Frame`.
        if more.contains(&"64x48") {
            assert!(
                !finished.status.success() && said.contains("has the output's size"),
                "{said}"
            );
        } else {
            assert!(finished.status.success(), "{said}");
            assert!(Path::new(out).exists());
        }
    }
}

#[test]
fn run_names_what_it_was_not_given() {
    let folder = scratch("run-wrong");
    let out = folder.join("out.png");
    let out = out.to_str().unwrap();
    let picture = here("docs/detail.png");
    let two = example("joint_bilateral_upsampling");
    let one = example("median");
    fails(
        &["run", &two, "--input", &picture, "--out", out],
        2,
        &["which texture", "low_depth"],
    );
    fails(
        &["run", &one, "--input", "colour=x.png", "--out", out],
        2,
        &["no texture `colour`", "color"],
    );
    fails(
        &["run", &one, "--input", "nowhere.png", "--out", out],
        1,
        &["nowhere.png"],
    );
    fails(
        &["run", &one, "--input", &picture, "--out", "picture.jpg"],
        2,
        &["picture.jpg", ".png"],
    );
    fails(
        &["run", &one, "--input", &picture, "--uniform", "sigma=2", "--out", out],
        2,
        &["no uniform `sigma`"],
    );
    fails(
        &["run", &one, "--input", &picture, "--precision", "f64", "--out", out],
        2,
        &["--executor cpu"],
    );
    assert!(is_empty(&folder));
}

#[test]
fn a_nan_is_traced_to_its_line() {
    let folder = scratch("nan");
    let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {\n    let here = color.load(pixel);\n    let mut sum = 0.0;\n    for tap in 0..3 {\n        let ratio = tap as f32 / (here.x * 0.0);\n        sum += ratio;\n    }\n    Vec4::splat(sum)\n}\n";
    let kernel = write(&folder, "k.rs", text);
    let picture = here("docs/kernels.png");
    let out = folder.join("out.png");
    for unroll in ["full", "none"] {
        let words = [
            "run",
            &kernel,
            "--input",
            &picture,
            "--out",
            out.to_str().unwrap(),
            "--executor",
            "cpu",
            "--check-finite",
            "--unroll",
            unroll,
        ];
        fails(&words, 1, &["`ratio` became NaN in `div`", "tap 0", "k.rs:5"]);
    }
    assert!(!out.exists());
}

/// A kernel that reads nothing but numbers.
const CIRCLES: &str = "pub fn circles(resolution: UVec2, scale: f32, count: u32, shift: IVec2, pixel: IVec2) -> Vec4 {\n    let at = (pixel + shift).as_vec2() / resolution.as_vec2();\n    Vec4::splat((at.length() * scale * count as f32).sin())\n}\n";

#[test]
fn a_kernel_without_textures_runs_at_a_size() {
    let folder = scratch("run-no-texture");
    let kernel = write(&folder, "circles.rs", CIRCLES);
    let out = folder.join("out.png");
    let out = out.to_str().unwrap();
    for executor in ["cpu", "gpu"] {
        let run = |more: &[&str]| {
            let mut words = vec!["run", kernel.as_str(), "--out", out, "--executor", executor];
            words.extend(more);
            words.iter().map(|word| (*word).to_owned()).collect::<Vec<String>>()
        };
        let refused = |more: &[&str], status: i32, says: &[&str]| {
            let words = run(more);
            fails(&words.iter().map(String::as_str).collect::<Vec<_>>(), status, says);
            assert!(!Path::new(out).exists());
        };
        refused(&[], 2, &["--size"]);
        refused(&["--size", "8x8", "--input", "x.png"], 2, &["no texture"]);
        let size = ["--size", "8x8"];
        let with = |more: &[&'static str]| [&size[..], more].concat();
        let unset = ["uniform `count`", "no default", "add --uniform count=VALUE"];
        refused(&with(&["--uniform", "scale=1"]), 2, &unset);
        let rest = ["--uniform", "shift=1", "--uniform", "scale=2"];
        let count = |value: &'static str| [&size[..], &rest[..], &["--uniform", value]].concat();
        refused(&count("count=1.5"), 2, &["`1.5` for `count`", "no whole number", "u32"]);
        refused(&count("count=-1"), 2, &["`-1` for `count`", "0 to 4294967295"]);
        refused(&count("count=99999999999"), 2, &["does not fit into a u32"]);
        refused(&count("count=1,2"), 2, &["takes one number, not 2"]);
        refused(&count("scale=3"), 2, &["`scale` is given twice"]);
        refused(&with(&["--uniform", "scale=1e39"]), 2, &["does not fit into an f32"]);
        let words = run(&count("count=3"));
        let finished = straightline(&words.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(
            finished.status.success(),
            "{}",
            String::from_utf8_lossy(&finished.stderr)
        );
        std::fs::remove_file(out).unwrap();
    }
}

#[test]
fn shadow_filters_read_their_coordinates() {
    let folder = scratch("run-shadows");
    let out = folder.join("out.png");
    let out = out.to_str().unwrap();
    let picture = here("docs/detail.png");
    let (shadow, coord) = (format!("shadow={picture}"), format!("coord={picture}"));
    for kernel in ["pcf", "pcss"] {
        for executor in ["cpu", "gpu"] {
            let words = [
                "run",
                kernel,
                "--input",
                &shadow,
                "--input",
                &coord,
                "--executor",
                executor,
                "--out",
                out,
            ];
            let finished = straightline(&words);
            assert!(
                finished.status.success(),
                "{}",
                String::from_utf8_lossy(&finished.stderr)
            );
            std::fs::remove_file(out).unwrap();
        }
        let words = ["run", kernel, "--input", &shadow, "--stage", "fragment", "--out", out];
        fails(&words, 2, &["interpolates `coord`", "--stage compute"]);
    }
    // `study loops` gives them the test card.
    let report = folder.join("study");
    let words = [
        "study", "loops", "--quick", "--from", "pcf", "--from", "pcss", "--size", "16x16", "--rounds", "1", "--out",
    ];
    let finished = straightline(&[&words[..], &[report.to_str().unwrap()]].concat());
    assert!(
        finished.status.success(),
        "{}",
        String::from_utf8_lossy(&finished.stderr)
    );
}

#[test]
fn edge_filters_read_the_layers_of_a_capture() {
    let folder = scratch("run-layers");
    let out = folder.join("out.png");
    let out = out.to_str().unwrap();
    let frame = here("examples/captures/spheres");
    let layer = |name: &str, layer: &str| format!("{name}={frame}/{name}.exr{layer}");
    let color = layer("color", "");
    let run = |depth: &str, normal: &str| {
        let (depth, normal) = (layer("depth", depth), layer("normal", normal));
        let words = [
            "run",
            "stalker",
            "--set",
            "depth=linear",
            "--input",
            &depth,
            "--input",
            &normal,
            "--input",
            &color,
            "--executor",
            "cpu",
            "--out",
            out,
        ];
        straightline(&words)
    };
    let finished = run(":centre", ":centre");
    assert!(
        finished.status.success(),
        "{}",
        String::from_utf8_lossy(&finished.stderr)
    );
    for (depth, normal, says) in [
        ("", ":centre", "takes one layer"),
        (":sample9", ":centre", "no layer `sample9`"),
    ] {
        let refused = run(depth, normal);
        let said = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert!(
            !refused.status.success() && said.contains(says) && said.contains("centre"),
            "{said}"
        );
    }
}

#[test]
fn the_fragment_stage_knows_the_size_of_what_it_reads() {
    let folder = scratch("run-resolution");
    // `k` reads its texture, `size` alone asks for its size.
    let text = "pub fn k(color: &Frame<Vec4>, resolution: UVec2, pixel: IVec2) -> Vec4 {\n    let at = pixel.as_vec2() / resolution.as_vec2();\n    color.load(pixel) * at.x\n}\npub fn size(color: &Frame<Vec4>, resolution: UVec2, pixel: IVec2) -> Vec4 {\n    (pixel.as_vec2() / resolution.as_vec2()).extend(0.0).extend(1.0)\n}\n";
    let file = write(&folder, "k.rs", text);
    for function in ["k", "size"] {
        sized(&format!("{file}::{function}"), &folder);
    }
}

fn sized(kernel: &str, folder: &Path) {
    let picture = here("docs/detail.png");
    let out = folder.join("out.png");
    for stage in ["compute", "fragment"] {
        let words = [
            "run",
            kernel,
            "--input",
            &picture,
            "--stage",
            stage,
            "--out",
            out.to_str().unwrap(),
        ];
        let finished = straightline(&words);
        assert!(
            finished.status.success(),
            "{}",
            String::from_utf8_lossy(&finished.stderr)
        );
    }
}

/// A picture of a colour for each pixel, as a file.
fn picture(folder: &Path, name: &str, size: glam::UVec2, of: impl Fn(u32, u32) -> glam::Vec4) -> String {
    let of = &of;
    let texels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| of(x, y)));
    let path = folder.join(name);
    let frame = straightline_kernels::prelude::Frame::new(size, texels.collect());
    straightline_scene::picture::write_picture(&path, &frame).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn volumes_cubes_and_integers_come_from_files() {
    use glam::{UVec2, Vec4, uvec2, vec4};
    let folder = scratch("run-textures");
    let kernel = write(
        &folder,
        "kernel.rs",
        "pub fn kernel(color: &Frame<Vec4>, table: &Texture3D<Vec3>, around: &TextureCube<Vec4>, ids: &Texture<UVec2>, linear: &Sampler, \
         pixel: IVec2) -> Vec4 {\n    let here = color.load(pixel).truncate();\n    let size = table.size().x as f32;\n    let graded = \
         table.sample(linear, (here * (size - 1.0) + 0.5) / size);\n    let up = around.sample(linear, vec3(0.0, 1.0, 0.0)).x;\n    \
         (graded * up).extend(ids.load(ivec2(0, 0)).y as f32 / 128.0)\n}\n",
    );
    let out = folder.join("out.exr");
    let out = out.to_str().unwrap();
    let color = picture(&folder, "color.exr", uvec2(4, 2), |x, y| {
        vec4(x as f32 / 4.0, y as f32, 0.5, 1.0)
    });
    // A table that swaps red and blue, as a table and as a strip of its slices.
    let swapped = |r: u32, g: u32, b: u32| vec4(b as f32, g as f32, r as f32, 1.0);
    let mut table = "LUT_3D_SIZE 2\n".to_owned();
    for k in 0..8 {
        let colour = swapped(k & 1, k >> 1 & 1, k >> 2);
        table += &format!("{} {} {}\n", colour.x, colour.y, colour.z);
    }
    let table = write(&folder, "swap.cube", &table);
    let strip = picture(&folder, "strip.exr", uvec2(4, 2), |x, y| swapped(x & 1, y, x >> 1));
    let faces: Vec<String> = (0..6)
        .map(|k| {
            let value = if k == 2 { 0.5 } else { 0.0 };
            picture(&folder, &format!("face{k}.exr"), UVec2::splat(3), |_, _| {
                Vec4::splat(value)
            })
        })
        .collect();
    let faces = faces.join(",");
    let ids = picture(&folder, "ids.png", uvec2(2, 2), |_, _| vec4(1.0, 0.0, 1.0, 1.0));
    let run = |table: &str, around: &str, ids: &str, executor: &str| {
        let inputs = [
            format!("color={color}"),
            format!("table={table}"),
            format!("around={around}"),
            format!("ids={ids}"),
        ];
        let mut words = vec!["run", kernel.as_str(), "--executor", executor, "--out", out];
        inputs.iter().for_each(|input| words.extend(["--input", input]));
        straightline(&words)
    };
    for executor in ["cpu", "gpu"] {
        for table in [&table, &strip] {
            let finished = run(table, &faces, &ids, executor);
            let said = String::from_utf8_lossy(&finished.stderr).into_owned();
            assert!(finished.status.success(), "{said}");
            let found = straightline_scene::picture::read_picture(Path::new(out)).unwrap();
            for (k, texel) in found.texels().iter().enumerate() {
                let (x, y) = ((k % 4) as f32 / 4.0, (k / 4) as f32);
                let expected = vec4(0.25, y * 0.5, x * 0.5, 0.0);
                assert!((*texel - expected).abs().max_element() < 0.01, "{k}: {texel}");
            }
            std::fs::remove_file(out).unwrap();
        }
    }
    let broken = write(&folder, "broken.cube", "LUT_3D_SIZE 2\n0 0 0\n");
    for (table, around, ids, says) in [
        (&table, "nowhere.exr", &ids, "nowhere.exr"),
        (&table, color.as_str(), &ids, "six square pictures"),
        (&color, faces.as_str(), &color, "texels of integers are read from PNG"),
        (&broken, faces.as_str(), &ids, "1 colours, and 2 steps a side need 8"),
        (&ids, faces.as_str(), &ids, "is no volume `table`"),
    ] {
        let finished = run(table, around, ids, "cpu");
        let said = String::from_utf8_lossy(&finished.stderr).into_owned();
        assert!(!finished.status.success() && said.contains(says), "{says}: {said}");
        assert!(!Path::new(out).exists());
    }
}

/// A kernel that gives three values.
const SEVERAL: &str = "pub struct GBuffer {\n    pub albedo: Vec4,\n    pub normal: Vec3,\n    pub depth: f32,\n}\npub fn g(color: &Frame<Vec4>, pixel: IVec2) -> GBuffer {\n    let here = color.load(pixel);\n    GBuffer { albedo: here, normal: here.zyx(), depth: here.w * 0.5 }\n}\n";

#[test]
fn every_value_of_a_kernel_is_written_where_it_is_named() {
    let folder = scratch("run-several");
    let kernel = write(&folder, "g.rs", SEVERAL);
    let picture = here("docs/detail.png");
    let path = |name: &str| folder.join(name).display().to_string();
    let (albedo, normal, depth) = (path("albedo.exr"), path("normal.exr"), path("depth.exr"));
    let named = [format!("normal={normal}"), format!("depth={depth}")];
    for executor in [["--executor", "cpu"], ["--executor", "gpu"]] {
        let mut words = vec![
            "run",
            kernel.as_str(),
            "--input",
            picture.as_str(),
            "--out",
            albedo.as_str(),
        ];
        words.extend(named.iter().flat_map(|out| ["--out", out.as_str()]));
        words.extend(executor);
        let said = common::finishes(&words);
        for path in [&albedo, &normal, &depth] {
            assert!(said.contains(path.as_str()), "{said}");
            std::fs::remove_file(path).expect("it was written");
        }
    }
    let run = |outs: &[&str], says: &[&str]| {
        let mut words = vec!["run", kernel.as_str(), "--input", picture.as_str()];
        words.extend(outs.iter().flat_map(|out| ["--out", out]));
        fails(&words, 2, says);
    };
    let other = format!("colour={normal}");
    run(&[&other], &["gives no `colour`; it gives albedo, normal, depth"]);
    let again = format!("albedo={normal}");
    run(&[&albedo, &again], &["`albedo` is to be written twice"]);
    run(&[&albedo, &format!("depth={albedo}")], &["give each a file of its own"]);
    run(&["depth=depth.txt"], &["neither .png nor .exr"]);
    assert!(!Path::new(&albedo).exists());
}

/// A kernel that only counts.
const COUNTS: &str = "pub fn h(color: &Frame<Vec4>, bins: &AtomicBuffer<u32>, pixel: IVec2) {\n    bins.add((color.load(pixel).x * 15.0) as usize, 1);\n}\n";

#[test]
fn buffers_that_a_kernel_writes_are_written_as_text() {
    let folder = scratch("run-counts");
    let kernel = write(&folder, "h.rs", COUNTS);
    let picture = here("docs/detail.png");
    let bins = folder.join("bins.csv").display().to_string();
    let out = format!("bins={bins}");
    let mut texts = Vec::new();
    for executor in ["cpu", "gpu"] {
        let words = [
            "run",
            &kernel,
            "--input",
            &picture,
            "--buffer",
            "bins=0*16",
            "--out",
            &out,
            "--executor",
            executor,
        ];
        common::finishes(&words);
        texts.push(std::fs::read_to_string(&bins).expect("the counts"));
    }
    assert_eq!(texts[0], texts[1]);
    let counts: Vec<u64> = texts[0].lines().map(|line| line.parse().expect("a count")).collect();
    assert!(counts.len() == 16 && counts.iter().sum::<u64>() > 1000, "{counts:?}");
    let run = |out: &str, says: &[&str]| {
        fails(
            &[
                "run",
                &kernel,
                "--input",
                &picture,
                "--buffer",
                "bins=0*16",
                "--out",
                out,
            ],
            2,
            says,
        );
    };
    run("picture.png", &["gives no picture, and writes bins: say NAME=FILE.csv"]);
    run("bins=bins.png", &["neither .csv nor .txt"]);
}

/// Gives a NaN, which `--check-finite` refuses, where the texture is not `level`.
const DATA: &str = "pub fn data(depth: &Frame<f32>, level: f32, pixel: IVec2) -> Vec4 {\n    let right = if (depth.load(pixel) - level).abs() < 0.002 { 1.0 } else { 0.0 };\n    Vec4::splat(right / right)\n}\n";

/// Gives a NaN as `DATA` does, where the colour is not `level`.
const COLOR: &str = "pub fn colour(color: &Frame<Vec4>, level: f32, pixel: IVec2) -> Vec4 {\n    let right = if (color.load(pixel).y - level).abs() < 0.002 { 1.0 } else { 0.0 };\n    Vec4::splat(right / right)\n}\n";

#[test]
fn a_png_is_data_or_a_colour_as_the_texture_says_or_the_command() {
    let folder = scratch("run-transfer");
    let grey = write(
        &folder,
        "grey.rs",
        "pub fn grey(pixel: IVec2) -> Vec4 {\n    Vec4::splat(0.5).with_w(1.0)\n}\n",
    );
    let picture = folder.join("grey.png").display().to_string();
    let made = [
        "run",
        grey.as_str(),
        "--size",
        "4x4",
        "--executor",
        "cpu",
        "--out",
        picture.as_str(),
    ];
    assert!(straightline(&made).status.success());
    let (data, color) = (write(&folder, "data.rs", DATA), write(&folder, "colour.rs", COLOR));
    let out = folder.join("out.png").display().to_string();
    // 188 of 255 in the file, which is half as bright as white.
    let (stored, light) = (188.0 / 255.0, 0.503);
    for (kernel, end, level, says) in [
        (&data, "", stored, "read as it is"),
        (&data, ",linear", stored, ""),
        (&data, ",srgb", light, ""),
        (&color, "", light, "read as sRGB"),
        (&color, ",linear", stored, ""),
        (&color, ",srgb", light, ""),
    ] {
        let (input, level) = (format!("{picture}{end}"), format!("level={level}"));
        let ran = straightline(&[
            "run",
            kernel,
            "--input",
            &input,
            "--uniform",
            &level,
            "--executor",
            "cpu",
            "--check-finite",
            "--out",
            &out,
        ]);
        let said = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert!(ran.status.success(), "{kernel} {input} {level}: {said}");
        assert!(
            said.contains(says) && (!says.is_empty() || !said.contains("read as")),
            "{said}"
        );
    }
    let exr = folder.join("grey.exr").display().to_string();
    fails(
        &[
            "run",
            &color,
            "--input",
            &format!("{exr},srgb"),
            "--uniform",
            "level=1",
            "--out",
            &out,
        ],
        2,
        &["`,srgb` is of a PNG", "grey.exr"],
    );
}
