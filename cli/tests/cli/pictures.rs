//! `test`: pictures of kernels, compared with golden files.

use crate::common;

use common::{fails, finishes, scratch, straightline, write};
use std::path::Path;

/// A kernel that brightens a picture, with a test of this body.
fn file_of(body: &str) -> String {
    format!(
        "use straightline_kernels::prelude::*;\n\n/// A picture, as bright as `gain` says.\npub fn bright(image: &Texture<Vec4>, \
         linear: &Sampler, gain: f32, resolution: UVec2, pixel: IVec2) -> Vec4 {{\n    let uv = (pixel.as_vec2() + 0.5) / \
         resolution.as_vec2();\n    let color = image.sample(linear, uv) * gain;\n    debug_assert!(color.x <= 1.0);\n    \
         color.truncate().extend(1.0)\n}}\n\n#[cfg(test)]\nmod tests {{\n    use super::*;\n    use straightline_kernels::testing::*;\n\n    \
         #[test]\n    fn ramp() {{\n        {body}\n    }}\n}}\n"
    )
}

const RAMP: &str = "let size = uvec2(8, 4);\n        let shift = 0.0;\n        let ramp: Texture<Vec4> = draw(uvec2(4, 4), |at| \
                    (vec2(at.x as f32 / 8.0, at.y as f32 / 8.0) + shift).extend(0.25).extend(1.0));\n        let linear = Sampler { \
                    address: Address::Repeat, ..Sampler::default() };\n        ";

fn ramp(gain: &str, tolerance: &str) -> String {
    file_of(&format!(
        "{RAMP}assert_picture(\"ramp.png\", size, |pixel| bright(&ramp, &linear, {gain}, size, pixel), {tolerance});"
    ))
}

fn printed(arguments: &[&str]) -> String {
    String::from_utf8_lossy(&straightline(arguments).stdout).into_owned()
}

#[test]
fn pictures_are_blessed_and_compared_by_interpreter_and_driver() {
    let folder = scratch("pictures-passes");
    let path = write(&folder, "bright.rs", &ramp("1.0", "exactly()"));
    let said = printed(&["test", &path, "--without-gpu"]);
    for part in [
        "error[E0103]: there is no golden file `",
        "ramp.png` yet",
        "= help: write it by `straightline test ",
        "tests::ramp --bless`",
    ] {
        assert!(said.contains(part), "{part} is missing:\n{said}");
    }
    assert!(!folder.join("ramp.png").exists());
    finishes(&["test", &path, "--without-gpu", "--bless"]);
    let info = folder.join("bright.info").display().to_string();
    finishes(&["test", &path, "--without-gpu", "--coverage", &info]);
    let counts = std::fs::read_to_string(info).expect("it is written");
    assert!(
        counts.contains("FNDA:32,bright") && counts.contains("DA:7,32"),
        "{counts}"
    );
    // A driver weighs texels by multiples of 1/256.
    let path = write(&folder, "bright.rs", &ramp("1.0", "absolute(3.0 / 255.0)"));
    let said = finishes(&["test", &path]);
    assert!(
        said.contains("by the interpreter and ") && said.contains("1 passed"),
        "{said}"
    );
    let drawn = straightline_kernels::pictures::read_drawn(&folder.join("ramp.png"), true).expect("a PNG");
    assert_eq!((drawn.size, drawn.texels.len()), ([8, 4], 32));
    // Across the edge, the ramp repeats: half of 3/8 is in the first column, a quarter of it by the filter.
    let light = (0.25 * 3.0 / 8.0) as f32;
    let byte = straightline_kernels::pictures::srgb::from_linear(light);
    assert!((drawn.texels[0][0] - byte).abs() < 0.5 / 255.0, "{:?}", drawn.texels[0]);
}

#[test]
fn a_picture_that_differs_is_reported_in_every_format() {
    let folder = scratch("pictures-differ");
    let path = write(&folder, "bright.rs", &ramp("1.0", "psnr(40.0)"));
    finishes(&["test", &path, "--without-gpu", "--bless"]);
    let path = write(&folder, "bright.rs", &ramp("0.9", "psnr(40.0)"));
    let xml = folder.join("results.xml");
    let arguments = ["test", &path, "--without-gpu", "--junit", xml.to_str().expect("UTF-8")];
    fails(&arguments, 1, &["error: 1 of 1 test failed"]);
    let said = printed(&arguments);
    for part in [
        "error[E0511]: `tests::ramp` draws another picture by the interpreter, f32",
        "bright.rs:22:24",
        " dB; 32 pixels differ, most at (",
        "; `psnr(40.0)` is asked",
        "ramp.actual.png`, the difference in `",
        "--bless`",
    ] {
        assert!(said.contains(part), "{part} is missing:\n{said}");
    }
    let read = |name: &str| straightline_kernels::pictures::read_drawn(&folder.join(name), true);
    let size = |name: &str| read(name).map(|drawn| drawn.size);
    assert_eq!(
        (size("ramp.actual.png"), size("ramp.difference.png")),
        (Ok([8, 4]), Ok([8, 4]))
    );
    let xml = std::fs::read_to_string(xml).expect("it is written");
    assert!(xml.contains("draws another picture"), "{xml}");
    let lines = printed(&["test", &path, "--without-gpu", "--json"]);
    let events = lines
        .lines()
        .map(|line| serde_json::from_str::<serde_json::Value>(line).expect("JSON"));
    let failed = events
        .into_iter()
        .find(|event| event["event"] == "failed")
        .expect("a failure");
    assert!(
        failed["psnr"].as_f64().is_some_and(|psnr| (20.0..40.0).contains(&psnr)),
        "{failed}"
    );
    assert!(
        failed["inputs"][0]
            .as_str()
            .is_some_and(|text| text.starts_with("let pixel = ivec2(")),
        "{failed}"
    );
    // A wider tolerance takes it, and the blessed file is the new picture.
    let path = write(&folder, "bright.rs", &ramp("0.9", "psnr(20.0)"));
    finishes(&["test", &path, "--without-gpu"]);
    finishes(&["test", &path, "--without-gpu", "--bless"]);
    let path = write(&folder, "bright.rs", &ramp("0.9", "exactly()"));
    finishes(&["test", &path, "--without-gpu"]);
}

#[test]
fn assertions_in_a_kernel_name_the_pixel() {
    let folder = scratch("pictures-assertion");
    let path = write(&folder, "bright.rs", &ramp("4.0", "psnr(40.0)"));
    for arguments in [&["test", &path, "--without-gpu"][..], &["test", &path, "--bless"]] {
        let said = printed(arguments);
        for part in [
            "error[E0511]: `tests::ramp` fails by the interpreter, f32",
            "bright.rs:7:5",
            "`color.x` is 1.125",
            "let pixel = ivec2(5, 0);",
        ] {
            assert!(said.contains(part), "{part} is missing:\n{said}");
        }
    }
    assert!(!folder.join("ramp.png").exists());
}

#[test]
fn pictures_of_files_are_read_as_colours_or_data() {
    let folder = scratch("pictures-files");
    let write_png = |name: &str| {
        let texels = [[0, 64, 128, 255], [255, 192, 32, 128]];
        let mut file = Vec::new();
        straightline_kernels::pictures::png::encode_rgba8(&mut file, [2, 1], texels.as_flattened()).expect("a PNG");
        std::fs::create_dir_all(folder.join(Path::new(name).parent().expect("a folder"))).expect("a folder");
        std::fs::write(folder.join(name), file).expect("it is written");
    };
    write_png("in/chart.png");
    write_png("same.png");
    let text = "use straightline_kernels::prelude::*;\n#[cfg(test)]\nmod tests {\n    use super::*;\n    use straightline_kernels::testing::*;\n    \
                #[test]\n    fn same() {\n        let chart: Frame<Vec4> = read_picture(\"in/chart.png\");\n        \
                assert_picture(\"same.png\", uvec2(2, 1), |pixel| chart.load(pixel), exactly());\n    }\n    \
                #[test]\n    fn data() {\n        let chart: Texture<Vec3> = read_linear(\"in/chart.png\");\n        \
                assert_picture(\"data.png\", uvec2(2, 1), |pixel| chart.load(pixel).z, exactly());\n    }\n}\n";
    let path = write(&folder, "same.rs", text);
    finishes(&["test", &path, "same"]);
    finishes(&["test", &path, "data", "--bless"]);
    let drawn = straightline_kernels::pictures::read_drawn(&folder.join("data.png"), false).expect("a PNG");
    assert!((drawn.texels[0][1] - 128.0 / 255.0).abs() < 0.01, "{drawn:?}");
    // A file of another size, and none.
    write_png("wide.png");
    let wide = text.replace("uvec2(2, 1)", "uvec2(4, 1)").replace("Frame", "Texture");
    let path = write(&folder, "wide.rs", &wide);
    let said = printed(&["test", &path, "same", "--without-gpu"]);
    assert!(said.contains("is 2×1 pixels, and the test draws 4×1"), "{said}");
    let path = write(&folder, "none.rs", &text.replace("in/chart", "in/none"));
    let said = printed(&["test", &path, "same", "--without-gpu"]);
    assert!(said.contains("error[E0103]") && said.contains("none.rs:8:47"), "{said}");
    // The frame's texture must be as large as the picture.
    let path = write(&folder, "frame.rs", &text.replace("uvec2(2, 1)", "uvec2(3, 1)"));
    let said = printed(&["test", &path, "same", "--without-gpu"]);
    assert!(said.contains("could not be run"), "{said}");
}
