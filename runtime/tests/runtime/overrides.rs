//! Overrides: values that a pass is made with, and errors that name them.

use crate::common;

use common::{COLOR, Fixture, Gpu, Kernel, Stage, ramp, view};
use straightline_manifest::{Manifest, Override, OverrideType};
use straightline_runtime::{Error, OverrideValue, Pass, PassOptions};

const SIZE: [u32; 2] = [5, 3];

/// `color * gain + steps`, or the negative of that.
const OVERRIDDEN: Kernel = Kernel {
    name: "overridden",
    bindings: &[COLOR],
    declarations: "@id(4) override gain: f32 = 2.0;
        @id(1) override steps: i32 = -3;
        @id(2) override negative: bool = false;
        @group(0) @binding(0) var color: texture_2d<f32>;",
    result: "(textureLoad(color, pixel, 0) * gain + f32(steps)) * select(1.0, -1.0, negative)",
};

fn described() -> Vec<Override> {
    let of = |name: &str, id, ty, default, range| Override {
        name: name.to_owned(),
        id,
        define: format!("OVERRIDE_{}", name.to_uppercase()),
        ty,
        default,
        range,
    };
    vec![
        of("gain", 4, OverrideType::F32, 2.0, None),
        of("steps", 1, OverrideType::I32, -3.0, Some([-4.0, 8.0])),
        of("negative", 2, OverrideType::Bool, 0.0, None),
    ]
}

fn fixture(stage: Stage, overrides: Vec<Override>) -> (Manifest, String) {
    let Fixture { manifest, wgsl } = OVERRIDDEN.emit(stage);
    let mut manifest = Manifest::from_json(&manifest).expect("a manifest");
    manifest.overrides = overrides;
    (manifest, wgsl)
}

#[test]
fn values_change_the_picture_without_another_text() {
    let gpu = Gpu::new();
    let color = gpu.upload(SIZE, 1, &ramp(SIZE, 1));
    for stage in [Stage::Compute, Stage::Fragment] {
        let (manifest, wgsl) = fixture(stage, described());
        let run = |options: &PassOptions| {
            let pass = Pass::with_options(&gpu.device, &manifest, &wgsl, options).expect("a pass");
            let target = gpu.target(SIZE);
            let mut encoder = gpu.encoder();
            let bound = pass.bind(&[("color", &view(&color))], &view(&target)).expect("to bind");
            bound.encode(&mut encoder);
            gpu.submit(encoder);
            gpu.download(&target)
        };
        let expect = |gain: f32, steps: f32, sign: f32| -> Vec<[f32; 4]> {
            ramp(SIZE, 1)
                .iter()
                .map(|p| p.map(|v| (v * gain + steps) * sign))
                .collect()
        };
        let options = PassOptions::default;
        assert_eq!(run(&options()), expect(2.0, -3.0, 1.0), "{stage:?}, defaults");
        assert_eq!(
            run(&options().override_option("gain", 0.5)),
            expect(0.5, -3.0, 1.0),
            "{stage:?}"
        );
        let all = options().override_option("steps", 1).override_option("negative", true);
        // The last value of a name counts.
        assert_eq!(
            run(&all.override_option("steps", 8)),
            expect(2.0, 8.0, -1.0),
            "{stage:?}"
        );
    }
}

#[test]
fn values_that_an_override_cannot_have() {
    let gpu = Gpu::new();
    let (manifest, wgsl) = fixture(Stage::Compute, described());
    let refuse = |name: &str, value: OverrideValue| {
        let options = PassOptions::default().override_option(name, value);
        Pass::with_options(&gpu.device, &manifest, &wgsl, &options).expect_err("a refusal")
    };
    let error = refuse("gane", 1.0.into());
    assert!(
        matches!(&error, Error::UnknownOverride { name, .. } if name == "gane"),
        "{error}"
    );
    assert!(
        error.to_string().contains("it has `gain`, `steps` and `negative`"),
        "{error}"
    );
    let error = refuse("gain", 1.into());
    assert!(matches!(&error, Error::OverrideType { .. }), "{error}");
    assert!(
        error
            .to_string()
            .contains("`gain` of `overridden` is of type f32, but was given a value of type i32"),
        "{error}"
    );
    for value in [f32::NAN, f32::INFINITY] {
        let error = refuse("gain", value.into());
        assert!(matches!(&error, Error::OverrideValue { .. }), "{error}");
        assert!(error.to_string().contains("finite"), "{error}");
    }
    for steps in [-5, 9] {
        let error = refuse("steps", steps.into()).to_string();
        assert!(
            error.contains(&format!("`steps` of `overridden` cannot be {steps}: it takes -4 to 8")),
            "{error}"
        );
    }
}

#[test]
fn texts_with_other_overrides_than_the_manifest() {
    let gpu = Gpu::new();
    let refuse = |change: &dyn Fn(&mut Vec<Override>), says: &str| {
        let mut overrides = described();
        change(&mut overrides);
        let (manifest, wgsl) = fixture(Stage::Compute, overrides);
        let error = Pass::new(&gpu.device, &manifest, &wgsl).expect_err(says).to_string();
        assert!(error.contains(says), "{error}");
    };
    refuse(&|all| all[0].id = 7, "no override @id(7), where `gain` should be");
    refuse(
        &|all| all[0].default = 3.0,
        "default of the override `gain` is not the f32 3",
    );
    refuse(
        &|all| all[1].ty = OverrideType::U32,
        "the default -3 of `steps` is no u32",
    );
    refuse(
        &|all| all[1].default = 9.0,
        "the default 9 of `steps` is out of its range",
    );
    refuse(&|all| all[1].name = "gain".to_owned(), "`gain` is listed twice");
    refuse(&|all| all[1].id = 4, "number 4 is listed twice");
    refuse(&|all| _ = all.pop(), "it has 3 overrides, and the manifest lists 2");
}
