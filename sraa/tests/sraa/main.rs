//! Frames of a renderer with every preset, number of samples and kind of camera.

mod renderer;

use glam::Mat4;
use glam::camera::rh::proj::directx::{orthographic, perspective, perspective_infinite, perspective_infinite_reverse};
use renderer::{Picture, Renderer, clear, error, mean};
use straightline_kernels::sraa::{Pattern, Sraa as Kernel};
use straightline_sraa::{Error, Options, Preset, Projection, Samples, Sraa, wgpu};

const SIZE: [u32; 2] = [125, 94];

const ASPECT: f32 = 4.0 / 3.0;

fn read(matrix: Mat4) -> Projection {
    Projection::from_matrix(matrix.to_cols_array_2d()).expect("a projection")
}

/// Cameras of every kind that see the scene.
fn cameras() -> [(&'static str, Projection); 6] {
    [
        ("perspective", perspective(0.9, ASPECT, 0.1, 30.0)),
        ("infinite", perspective_infinite(0.9, ASPECT, 0.1)),
        ("reversed", perspective(0.9, ASPECT, 30.0, 0.1)),
        ("reversed infinite", perspective_infinite_reverse(0.9, ASPECT, 0.1)),
        ("parallel", orthographic(-2.4, 2.4, -1.8, 1.8, 0.1, 30.0)),
        ("parallel reversed", orthographic(-2.4, 2.4, -1.8, 1.8, 30.0, 0.1)),
    ]
    .map(|(name, matrix)| (name, read(matrix)))
}

fn supersampled(renderer: &Renderer, samples: Samples, projection: &Projection) -> Picture {
    let pictures: Vec<_> = samples
        .offsets()
        .iter()
        .map(|offset| renderer.shaded(SIZE, *offset, projection))
        .collect();
    mean(&pictures)
}

/// Errors against supersampling at the same samples, as shares of the error without antialiasing.
fn shares(renderer: &Renderer, samples: Samples, projection: &Projection) -> [f32; 5] {
    let reference = supersampled(renderer, samples, projection);
    let plain = error(&renderer.shaded(SIZE, [0.0; 2], projection), &reference);
    let mut sraa = Sraa::new(&renderer.device, SIZE, Preset::Paper, projection).expect("a device that runs SRAA");
    Preset::ALL.map(|preset| {
        let options = Options::new(preset).samples(samples);
        sraa.reset(SIZE, options, projection).expect("a device that runs SRAA");
        error(&renderer.antialiased(&sraa, projection), &reference) / plain
    })
}

/// Limits are twice what was found at most, so that a wrong sign, a swapped axis or a wrong unit of depth is noticed.
#[test]
fn every_preset_antialiases_under_every_camera() {
    let renderer = Renderer::new();
    for samples in [Samples::Four, Samples::Sixteen] {
        for (name, projection) in cameras() {
            let shares = shares(&renderer, samples, &projection);
            println!("{samples:?} {name}: {shares:.3?}");
            for (preset, (share, most)) in Preset::ALL
                .iter()
                .zip(shares.iter().zip([0.13, 0.17, 0.06, 0.005, 0.003]))
            {
                assert!(
                    *share < most,
                    "{samples:?}, {name}, {preset}: {share} of the error is left"
                );
            }
        }
    }
}

#[test]
fn another_size_camera_or_preset_is_as_if_new() {
    let renderer = Renderer::new();
    let [first, _, _, second, ..] = cameras().map(|(_, projection)| projection);
    let mut sraa = Sraa::new(&renderer.device, [40, 30], Preset::Fast, &first).expect("SRAA");
    let own = |options: Options, projection: &Projection| {
        let sraa = Sraa::new(&renderer.device, SIZE, options, projection).expect("SRAA");
        renderer.antialiased(&sraa, projection)
    };
    sraa.resize(SIZE, &first).expect("SRAA");
    assert_eq!(renderer.antialiased(&sraa, &first), own(Preset::Fast.into(), &first));
    sraa.set_projection(&renderer.queue, &second).expect("other shaders");
    assert_eq!(renderer.antialiased(&sraa, &second), own(Preset::Fast.into(), &second));
    let zoomed = read(perspective_infinite_reverse(0.5, ASPECT, 0.2));
    let options = Options::new(Preset::Full);
    sraa.reset(SIZE, options, &second).expect("SRAA");
    sraa.set_projection(&renderer.queue, &zoomed).expect("the same shaders");
    assert_eq!(renderer.antialiased(&sraa, &zoomed), own(options, &zoomed));
}

#[test]
fn pictures_of_one_pixel_or_row_are_pictures() {
    let renderer = Renderer::new();
    let (_, projection) = cameras()[3];
    for size in [[1, 1], [1, 33], [33, 1], [17, 16]] {
        for preset in Preset::ALL {
            let sraa = Sraa::new(&renderer.device, size, preset, &projection).expect("SRAA");
            let picture = renderer.antialiased(&sraa, &projection);
            assert!(
                picture.as_flattened().iter().all(|c| c.is_finite()),
                "{size:?} {preset}"
            );
        }
    }
}

/// Cleared targets are the sky, and the sky keeps its colour.
#[test]
fn a_scene_of_nothing_is_the_background() {
    let renderer = Renderer::new();
    for (name, projection) in cameras() {
        for preset in Preset::ALL {
            let sraa = Sraa::new(&renderer.device, SIZE, preset, &projection).expect("SRAA");
            let mut encoder = renderer
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            sraa.geometry().for_each(|pass| clear(pass, &mut encoder));
            sraa.encode_placing(&mut encoder);
            let background = wgpu::Color {
                r: 0.25,
                g: 0.5,
                b: 1.0,
                a: 1.0,
            };
            drop(sraa.begin_shading(&mut encoder, background));
            sraa.encode(&mut encoder);
            for pixel in renderer.read(encoder, sraa.resolved()) {
                let apart = pixel
                    .iter()
                    .zip([0.25, 0.5, 1.0])
                    .map(|(a, b)| (a - b).abs())
                    .fold(0.0, f32::max);
                assert!(apart < 1e-3, "{name}, {preset}: {pixel:?}");
            }
        }
    }
}

#[test]
fn sizes_that_are_none_are_refused() {
    let renderer = Renderer::new();
    let (_, projection) = cameras()[0];
    let limit = renderer.device.limits().max_texture_dimension_2d;
    for size in [[0, 4], [4, 0], [limit + 1, 4]] {
        let refused = Sraa::new(&renderer.device, size, Preset::Edges, &projection).map(|_| ());
        assert!(matches!(refused, Err(Error::Size { .. })), "{size:?}: {refused:?}");
    }
    let mut sraa = Sraa::new(&renderer.device, [4, 4], Preset::Edges, &projection).expect("SRAA");
    sraa.resize([0, 0], &projection).expect_err("a refusal");
    assert_eq!(sraa.size(), [4, 4]);
}

/// The crate's offsets are those that the kernel was generated with.
#[test]
fn samples_lie_where_the_kernel_has_them() {
    for (samples, pattern) in [(Samples::Four, Pattern::Latin4), (Samples::Sixteen, Pattern::Latin16)] {
        let kernel = Kernel {
            pattern,
            ..Default::default()
        };
        for (k, offset) in samples.offsets().iter().enumerate() {
            assert_eq!(kernel.offset(k).to_array(), *offset, "{samples:?} {k}");
        }
    }
}
