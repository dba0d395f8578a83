//! Unfit views are errors that name them. Each case is checked for both stages where it exists, and the
//! encoder is finished and submitted afterwards: nothing half-recorded may be left in it.

use crate::common;

use common::{COPY, Fixture, Gpu, Kernel, LAYERS, STAGES, Stage, array_view, ramp, view};
use straightline_runtime::{Error, Pass, ViewProblem, wgpu};
use wgpu::{TextureFormat, TextureUsages, TextureView};

const SIZE: [u32; 2] = [16, 9];
const READ: TextureUsages = TextureUsages::TEXTURE_BINDING;

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

/// The problem with input `name`.
fn input_problem(error: Error, wanted: &str) -> ViewProblem {
    match error {
        Error::Input { name, problem, .. } if name == wanted => problem,
        other => panic!("not about input `{wanted}`: {other}"),
    }
}

fn target_problem(error: Error) -> ViewProblem {
    match error {
        Error::Target { problem, .. } => problem,
        other => panic!("not about the target: {other}"),
    }
}

#[test]
fn names_are_checked_both_ways() {
    let gpu = Gpu::new();
    let (color, depth) = (
        view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1))),
        gpu.upload(SIZE, 3, &ramp(SIZE, 3)),
    );
    let depth = array_view(&depth);
    let target = view(&gpu.target(SIZE));
    for stage in STAGES {
        let pass = pass(&gpu, &LAYERS, stage);
        let error = refuse(&pass, &[("color", &color)], &target);
        assert!(
            matches!(&error, Error::MissingInput { name, .. } if name == "depth"),
            "{error}"
        );
        assert!(error.to_string().contains("`color` and `depth`"), "{error}");
        let error = refuse(
            &pass,
            &[("color", &color), ("colour", &color), ("depth", &depth)],
            &target,
        );
        assert!(
            matches!(&error, Error::UnknownInput { name, .. } if name == "colour"),
            "{error}"
        );
        assert!(error.to_string().contains("`color` and `depth`"), "{error}");
        let error = refuse(
            &pass,
            &[("color", &color), ("depth", &depth), ("color", &color)],
            &target,
        );
        assert!(
            matches!(&error, Error::DuplicateInput { name, .. } if name == "color"),
            "{error}"
        );
    }
}

#[test]
fn inputs_of_the_wrong_shape() {
    let gpu = Gpu::new();
    let color = view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1)));
    let target = view(&gpu.target(SIZE));
    for stage in STAGES {
        let pass = pass(&gpu, &LAYERS, stage);
        let with_depth = |depth: &TextureView| {
            input_problem(refuse(&pass, &[("color", &color), ("depth", depth)], &target), "depth")
        };
        let depth = array_view(&gpu.texture(SIZE, 3, TextureFormat::R32Float, READ));
        // Made of a stack, the default view is an array; this one is not.
        let stack = gpu.texture(SIZE, 3, TextureFormat::R32Float, READ);
        let one = stack.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            array_layer_count: Some(1),
            ..Default::default()
        });
        assert!(
            matches!(with_depth(&one), ViewProblem::Dimension { .. }),
            "{}",
            with_depth(&one)
        );
        let few = array_view(&gpu.texture(SIZE, 2, TextureFormat::R32Float, READ));
        assert_eq!(with_depth(&few), ViewProblem::Layers { needed: 3, found: 2 });
        let small = array_view(&gpu.texture([16, 8], 3, TextureFormat::R32Float, READ));
        assert_eq!(
            with_depth(&small),
            ViewProblem::Size {
                input: [16, 8],
                target: SIZE
            }
        );
        assert_eq!(
            with_depth(&small).to_string(),
            "is 16x8, but the target is 16x9: this input has the size of the target"
        );

        let with_color = |color: &TextureView| {
            input_problem(refuse(&pass, &[("color", color), ("depth", &depth)], &target), "color")
        };
        let array = array_view(&gpu.texture(SIZE, 1, TextureFormat::Rgba32Float, READ));
        assert!(matches!(with_color(&array), ViewProblem::Dimension { ref found, .. } if found == "2d-array"));
        let descriptor = |sample_count, dimension, depth| wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: SIZE[0],
                height: SIZE[1],
                depth_or_array_layers: depth,
            },
            mip_level_count: 1,
            sample_count,
            dimension,
            format: TextureFormat::Rgba16Float,
            usage: READ | TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        };
        let samples = gpu.device.create_texture(&descriptor(4, wgpu::TextureDimension::D2, 1));
        assert_eq!(with_color(&view(&samples)), ViewProblem::Multisampled { samples: 4 });
        let solid = wgpu::TextureDescriptor {
            usage: READ,
            ..descriptor(1, wgpu::TextureDimension::D3, 4)
        };
        let solid = gpu.device.create_texture(&solid);
        assert!(matches!(with_color(&view(&solid)), ViewProblem::Dimension { ref found, .. } if found.contains("3d")));
    }
}

#[test]
fn inputs_of_the_wrong_format_or_usage() {
    let gpu = Gpu::new();
    let target = view(&gpu.target(SIZE));
    for stage in STAGES {
        let pass = pass(&gpu, &COPY, stage);
        let with = |format, usage| {
            let color = view(&gpu.texture(SIZE, 1, format, usage));
            input_problem(refuse(&pass, &[("color", &color)], &target), "color")
        };
        for format in [
            TextureFormat::Rgba8Uint,
            TextureFormat::Rgba32Sint,
            TextureFormat::Stencil8,
        ] {
            assert_eq!(with(format, READ), ViewProblem::NotFloat { format });
        }
        for (format, found) in [
            (TextureFormat::R32Float, 1),
            (TextureFormat::Rg16Float, 2),
            (TextureFormat::Rg11b10Ufloat, 3),
            (TextureFormat::Depth32Float, 1),
        ] {
            assert_eq!(
                with(format, READ),
                ViewProblem::Components {
                    format,
                    needed: 4,
                    found
                }
            );
        }
        let problem = with(TextureFormat::Rgba16Float, TextureUsages::COPY_DST);
        assert_eq!(
            problem,
            ViewProblem::Usage {
                missing: "TEXTURE_BINDING"
            }
        );
    }
}

#[test]
fn a_stencil_is_not_a_depth() {
    let gpu = Gpu::new();
    let kernel = Kernel {
        name: "show",
        bindings: &[r#"{"group": 0, "binding": 1, "name": "depth", "type": "texture",
            "view_dimension": "2d", "multisampled": false, "sample_type": "unfilterable-float", "components": 1, "layers": 1, "samples": 1,
            "extent": "output"}"#],
        declarations: "@group(0) @binding(1) var depth: texture_2d<f32>;",
        result: "textureLoad(depth, pixel, 0)",
    };
    let pass = pass(&gpu, &kernel, Stage::Compute);
    let both = gpu.texture(SIZE, 1, TextureFormat::Depth24PlusStencil8, READ);
    let target = view(&gpu.target(SIZE));
    for aspect in [wgpu::TextureAspect::All, wgpu::TextureAspect::StencilOnly] {
        let depth = both.create_view(&wgpu::TextureViewDescriptor {
            aspect,
            ..Default::default()
        });
        let problem = input_problem(refuse(&pass, &[("depth", &depth)], &target), "depth");
        assert!(matches!(problem, ViewProblem::Refused { .. }), "{problem}");
    }
}

#[test]
fn targets_that_cannot_be_written() {
    let gpu = Gpu::new();
    let color = view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1)));
    for (stage, usage, name) in [
        (Stage::Compute, TextureUsages::STORAGE_BINDING, "STORAGE_BINDING"),
        (Stage::Fragment, TextureUsages::RENDER_ATTACHMENT, "RENDER_ATTACHMENT"),
    ] {
        let pass = pass(&gpu, &COPY, stage);
        let with = |target: &TextureView| target_problem(refuse(&pass, &[("color", &color)], target));
        let half = view(&gpu.texture(SIZE, 1, TextureFormat::Rgba16Float, usage));
        assert!(matches!(
            with(&half),
            ViewProblem::Format {
                needed: TextureFormat::Rgba32Float,
                found: TextureFormat::Rgba16Float,
                ..
            }
        ));
        let unwritable = view(&gpu.texture(SIZE, 1, TextureFormat::Rgba32Float, READ));
        assert_eq!(with(&unwritable), ViewProblem::Usage { missing: name });
        // Only wgpu knows that these views are unfit.
        let stack = array_view(&gpu.texture(SIZE, 2, TextureFormat::Rgba32Float, usage));
        assert!(matches!(with(&stack), ViewProblem::Refused { .. }), "{}", with(&stack));
        let levels = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: SIZE[0],
                height: SIZE[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 2,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TextureFormat::Rgba32Float,
            usage,
            view_formats: &[],
        });
        assert!(matches!(with(&view(&levels)), ViewProblem::Refused { .. }));
    }
}

#[test]
fn a_target_view_of_another_srgb_ness() {
    let gpu = Gpu::new();
    let color = view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1)));
    let Fixture { manifest, wgsl } = COPY.emit(Stage::Fragment);
    let manifest = manifest.replace("rgba32float", "rgba8unorm");
    let pass = Pass::from_json(&gpu.device, &manifest, &wgsl).expect("a pass");
    let srgb = gpu.texture(SIZE, 1, TextureFormat::Rgba8UnormSrgb, TextureUsages::RENDER_ATTACHMENT);
    let problem = target_problem(refuse(&pass, &[("color", &color)], &view(&srgb)));
    assert!(matches!(problem, ViewProblem::Refused { .. }), "{problem}");
}

#[test]
fn an_input_that_is_the_target() {
    let gpu = Gpu::new();
    for stage in STAGES {
        let pass = pass(&gpu, &COPY, stage);
        let image = gpu.target(SIZE);
        let error = refuse(&pass, &[("color", &view(&image))], &view(&image));
        assert_eq!(input_problem(error, "color"), ViewProblem::IsTarget);
        // A layer of a stack that is also the target: wgpu refuses it.
        let usage = READ | TextureUsages::STORAGE_BINDING | TextureUsages::RENDER_ATTACHMENT;
        let stack = gpu.texture(SIZE, 2, TextureFormat::Rgba32Float, usage);
        let layer = stack.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            array_layer_count: Some(1),
            ..Default::default()
        });
        let error = refuse(&pass, &[("color", &layer)], &layer);
        assert!(matches!(error, Error::Combination { .. }), "{error}");
    }
}

#[test]
fn a_target_larger_than_a_dispatch() {
    let limits = wgpu::Limits {
        max_compute_workgroups_per_dimension: 2,
        ..Default::default()
    };
    let gpu = Gpu::with(wgpu::Features::empty(), limits);
    let pass = pass(&gpu, &COPY, Stage::Compute);
    for (size, fits) in [([16, 16], true), ([17, 1], false), ([1, 17], false)] {
        let color = view(&gpu.upload(size, 1, &ramp(size, 1)));
        let target = view(&gpu.target(size));
        if fits {
            pass.bind(&[("color", &color)], &target)
                .expect("to bind")
                .encode(&mut gpu.encoder());
        } else {
            let problem = target_problem(refuse(&pass, &[("color", &color)], &target));
            assert_eq!(problem, ViewProblem::TooLarge { size: 17, max: 16 });
        }
    }
}

#[test]
fn views_of_another_device() {
    let gpu = Gpu::new();
    let other = gpu.sibling();
    let (color, foreign) = (
        view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1))),
        view(&other.upload(SIZE, 1, &ramp(SIZE, 1))),
    );
    let (target, foreign_target) = (view(&gpu.target(SIZE)), view(&other.target(SIZE)));
    for stage in STAGES {
        let pass = pass(&gpu, &COPY, stage);
        let problem = input_problem(refuse(&pass, &[("color", &foreign)], &target), "color");
        assert!(matches!(problem, ViewProblem::Refused { .. }), "{problem}");
        let problem = target_problem(refuse(&pass, &[("color", &color)], &foreign_target));
        assert!(matches!(problem, ViewProblem::Refused { .. }), "{problem}");
    }
}

#[test]
fn a_lost_device() {
    for stage in STAGES {
        let gpu = Gpu::new();
        let pass = pass(&gpu, &COPY, stage);
        let color = view(&gpu.upload(SIZE, 1, &ramp(SIZE, 1)));
        let target = view(&gpu.target(SIZE));
        let bound = pass
            .bind(&[("color", &color)], &target)
            .expect("to bind while the device lives");
        gpu.device.destroy();
        // Recording cannot fail, on a lost device either.
        bound.encode(&mut gpu.encoder());
        for _ in 0..2 {
            let error = refuse(&pass, &[("color", &color)], &target);
            assert!(matches!(error, Error::DeviceLost { .. }), "{error}");
            gpu.device
                .poll(wgpu::PollType::wait_indefinitely())
                .expect("an idle device");
        }
    }
}
