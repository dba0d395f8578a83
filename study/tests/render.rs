//! The two renderers draw the same, at any size, and offsets mean what they say.

use glam::{UVec2, Vec2, uvec2, vec2};
use straightline_study::render::{CpuRenderer, GpuRenderer, RenderError, Renderer, reference};
use straightline_study::scene::{SKY_DEPTH, builtin};

fn gpu(size: UVec2) -> GpuRenderer {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
    let adapter = adapter.unwrap_or_else(|e| {
        panic!("this test needs a GPU adapter; without a GPU install Debian's mesa-vulkan-drivers: {e}")
    });
    let (device, queue) =
        pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).expect("a device");
    GpuRenderer::new(&device, &queue, &builtin(), size).expect("the scene is drawn")
}

fn cpu(size: UVec2) -> CpuRenderer {
    CpuRenderer::new(&builtin(), size).expect("the scene is drawn")
}

#[test]
fn both_draw_the_same_but_for_a_few_edges() {
    let size = uvec2(321, 181);
    let (gpu, cpu) = (gpu(size), cpu(size));
    for offset in [Vec2::ZERO, vec2(-0.125, 0.375)] {
        let ((d1, n1), (d2, n2)) = (
            gpu.geometry(offset).expect("drawn"),
            cpu.geometry(offset).expect("drawn"),
        );
        let (c1, c2) = (gpu.shaded(offset).expect("drawn"), cpu.shaded(offset).expect("drawn"));
        let differ = (0..d1.texels().len()).filter(|k| {
            let depth = (d1.texels()[*k] - d2.texels()[*k]).abs() > 1.0e-3 * d2.texels()[*k];
            let normal = n1.texels()[*k].distance(n2.texels()[*k]) > 1.0e-3;
            depth || normal || (c1.texels()[*k] - c2.texels()[*k]).abs().max_element() > 1.0e-2
        });
        let share = differ.count() as f64 / d1.texels().len() as f64;
        println!("{:.3} % of pixels differ at {offset}", 100.0 * share);
        assert!(share < 0.005, "{:.2} % of pixels differ at {offset}", 100.0 * share);
    }
}

#[test]
fn a_whole_offset_shifts_the_picture() {
    let size = uvec2(96, 54);
    for renderer in [&cpu(size) as &dyn Renderer, &gpu(size)] {
        let (here, shifted) = (
            renderer.shaded(Vec2::ZERO).expect("drawn"),
            renderer.shaded(vec2(1.0, 0.0)).expect("drawn"),
        );
        let at = |frame: &straightline_kernels::prelude::Frame<glam::Vec4>, x: u32, y: u32| {
            frame.texels()[(y * size.x + x) as usize]
        };
        let inside = (0..size.y).flat_map(|y| (0..size.x - 1).map(move |x| (x, y)));
        let differ = inside.filter(|(x, y)| (at(&shifted, *x, *y) - at(&here, x + 1, *y)).abs().max_element() > 1.0e-3);
        let differ = differ.count();
        assert!(differ < 30, "{differ} pixels differ");
    }
}

#[test]
fn the_smallest_pictures_are_drawn() {
    for size in [uvec2(1, 1), uvec2(1, 9), uvec2(7, 1)] {
        for renderer in [&cpu(size) as &dyn Renderer, &gpu(size)] {
            let (depth, _) = renderer.geometry(Vec2::ZERO).expect("drawn");
            assert_eq!(depth.size(), size);
            assert!(depth.texels().iter().all(|d| *d > 0.0 && *d <= SKY_DEPTH));
        }
    }
}

#[test]
fn a_reference_is_the_mean_of_its_samples() {
    let cpu = cpu(uvec2(40, 23));
    let mut told = Vec::new();
    let mean = reference(&cpu, 2, &mut |done, total| told.push((done, total))).expect("drawn");
    assert_eq!(told.last(), Some(&(4, 4)));
    let quarter = 0.25;
    let offsets = [
        vec2(-quarter, -quarter),
        vec2(quarter, -quarter),
        vec2(-quarter, quarter),
        vec2(quarter, quarter),
    ];
    let frames = offsets.map(|o| cpu.shaded(o).expect("drawn"));
    for (k, texel) in mean.texels().iter().enumerate() {
        let by_hand = frames.iter().map(|f| f.texels()[k]).sum::<glam::Vec4>() * 0.25;
        assert!((*texel - by_hand).abs().max_element() < 1.0e-6);
    }
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    assert!(matches!(
        CpuRenderer::new(&builtin(), uvec2(0, 4)),
        Err(RenderError::Size { .. })
    ));
    let renderer = cpu(uvec2(4, 4));
    assert!(matches!(
        renderer.shaded(vec2(f32::NAN, 0.0)),
        Err(RenderError::Offset { .. })
    ));
    assert!(matches!(renderer.mean(&[]), Err(RenderError::NoOffsets)));
}
