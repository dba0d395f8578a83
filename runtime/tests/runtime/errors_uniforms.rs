//! Uniforms that are missing, unknown or of another type or size are errors that name them.

use crate::common;

use common::{ADD, COPY, Fixture, Gpu, Kernel, Stage, ramp, view};
use straightline_runtime::{BindOptions, Error, Pass, UniformValue, wgpu};
use wgpu::TextureView;

const SIZE: [u32; 2] = [16, 9];

fn pass(gpu: &Gpu, kernel: &Kernel, stage: Stage) -> Pass {
    let Fixture { manifest, wgsl } = kernel.emit(stage);
    Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass")
}

/// Binds resources that must be rejected.
fn refuse(pass: &Pass, inputs: &[(&str, &TextureView)], target: &TextureView) -> Error {
    let error = pass.bind(inputs, target).expect_err("a refusal");
    assert!(error.to_string().contains(&format!("`{}`", pass.kernel())), "{error}");
    error
}

#[test]
fn uniforms_that_are_unset_unknown_or_of_another_type() {
    let gpu = Gpu::new();
    let color = view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1)));
    let target = view(&gpu.target(SIZE));
    let pass = pass(&gpu, &ADD, Stage::Compute);
    let with = |options: &BindOptions| pass.bind_with(&[("color", &color)], &target, options);
    let error = refuse(&pass, &[("color", &color)], &target);
    assert!(
        matches!(&error, Error::UniformUnset { name, .. } if name == "offset"),
        "{error}"
    );
    let options = || BindOptions::default().uniform("offset", [0.0; 4]);
    let bound = with(&options()).expect("all uniforms have values");
    // Binding with a value and writing it later must report the same error.
    let both = |name: &'static str, value: UniformValue| {
        let early = with(&options().uniform(name, value.clone())).expect_err("a refusal");
        let late = bound.write_uniform(&gpu.queue, name, value).expect_err("a refusal");
        assert_eq!(early.to_string(), late.to_string());
        late
    };
    let error = both("tau", 1.0.into()).to_string();
    assert!(
        error.contains("no uniform `tau`; it has `offset`, `scale` and `steps`"),
        "{error}"
    );
    let error = both("steps", 1.0.into());
    assert!(
        matches!(&error, Error::UniformType { needed, given, .. } if needed == "i32" && given == "f32"),
        "{error}"
    );
    both("offset", [1.0, 2.0].into());
    for (bytes, given) in [([0; 48].as_slice(), 48), (&[0; 24], 24)] {
        let early = with(&options().uniforms(bytes)).expect_err("another size");
        let late = bound.write_uniforms(&gpu.queue, bytes).expect_err("another size");
        for error in [early, late] {
            assert!(
                matches!(error, Error::UniformSize { needed: 32, given: found, .. } if found == given),
                "{error}"
            );
        }
    }
}

#[test]
fn a_struct_for_a_kernel_without_uniforms() {
    let gpu = Gpu::new();
    let color = view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1)));
    let target = view(&gpu.target(SIZE));
    let pass = pass(&gpu, &COPY, Stage::Compute);
    let bound = pass.bind(&[("color", &color)], &target).expect("to bind");
    for bytes in [&[][..], &[0; 16]] {
        let options = BindOptions::default().uniforms(bytes);
        let early = pass.bind_with(&[("color", &color)], &target, &options);
        for error in [early.err(), bound.write_uniforms(&gpu.queue, bytes).err()] {
            assert!(matches!(error, Some(Error::NoUniforms { .. })), "{error:?}");
        }
    }
}

/// A matrix and an array of which the shader reads parts, as the generator would emit it.
const GRADE: Kernel = Kernel {
    name: "grade",
    bindings: &[
        r#"{"group": 0, "binding": 0, "name": "params", "type": "uniform", "buffer_type": "uniform", "size": 48, "fields": [
        {"name": "grade_x_axis", "type": "vec2f", "offset": 0, "size": 8, "part": {"of": "grade", "type": "mat2x2f", "index": 0}},
        {"name": "grade_y_axis", "type": "vec2f", "offset": 8, "size": 8, "part": {"of": "grade", "type": "mat2x2f", "index": 1}},
        {"name": "palette_0", "type": "vec3f", "offset": 16, "size": 12, "part": {"of": "palette", "type": "array<vec3f, 4>", "index": 0}},
        {"name": "palette_3", "type": "vec3f", "offset": 32, "size": 12, "part": {"of": "palette", "type": "array<vec3f, 4>", "index": 3}}]}"#,
    ],
    declarations: "struct Params { grade_x_axis: vec2f, grade_y_axis: vec2f, palette_0: vec3f, palette_3: vec3f }
        @group(0) @binding(0) var<uniform> params: Params;",
    result: "select(vec4f(params.palette_0, params.palette_3.z), vec4f(params.grade_x_axis, params.grade_y_axis), pixel.x == 0)",
};

#[test]
fn matrices_and_arrays_are_one_value() {
    let gpu = Gpu::new();
    let pass = pass(&gpu, &GRADE, Stage::Compute);
    let image = gpu.target([2, 1]);
    let target = view(&image);
    let none = &[] as &[(&str, &TextureView)];
    let palette = |first: f32| {
        let colors = [0.0, 1.0, 2.0, 3.0].map(|k| [first + 3.0 * k, first + 3.0 * k + 1.0, first + 3.0 * k + 2.0]);
        UniformValue::vectors(&colors).expect("four colours")
    };
    let grade = [[1.0, 2.0], [3.0, 4.0]];
    // A value that lacks a part is not set; the message has the name that a caller knows.
    let error = pass
        .bind_with(
            none,
            &target,
            &BindOptions::default()
                .uniform("palette", palette(10.0))
                .uniform("grade_x_axis", [1.0, 2.0]),
        )
        .expect_err("a column is missing");
    assert!(
        matches!(&error, Error::UniformUnset { name, .. } if name == "grade"),
        "{error}"
    );
    let options = BindOptions::default()
        .uniform("palette", palette(10.0))
        .uniform("grade", grade);
    let bound = pass.bind_with(none, &target, &options).expect("to bind");
    let run = || {
        let mut encoder = gpu.encoder();
        bound.encode(&mut encoder);
        gpu.submit(encoder);
        gpu.download(&image)
    };
    assert_eq!(run(), [[1.0, 2.0, 3.0, 4.0], [10.0, 11.0, 12.0, 21.0]]);
    bound
        .write_uniform(&gpu.queue, "grade", [[5.0, 6.0], [7.0, 8.0]])
        .expect("a matrix");
    bound
        .write_uniform(&gpu.queue, "palette", palette(-9.0))
        .expect("an array");
    bound
        .write_uniform(&gpu.queue, "palette_3", [0.0, 0.0, 0.5])
        .expect("a part");
    assert_eq!(run(), [[5.0, 6.0, 7.0, 8.0], [-9.0, -8.0, -7.0, 0.5]]);
    let error = bound
        .write_uniform(&gpu.queue, "grade", [[0.0; 3]; 3])
        .expect_err("another matrix");
    assert!(
        matches!(&error, Error::UniformType { needed, given, .. } if needed == "mat2x2f" && given == "mat3x3f"),
        "{error}"
    );
    let error = bound
        .write_uniform(&gpu.queue, "gain", 1.0)
        .expect_err("no such uniform");
    assert!(error.to_string().ends_with("it has `grade` and `palette`"), "{error}");
}
