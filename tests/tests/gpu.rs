//! Emitted shaders on a real driver against a brute force in f64 that shares no code with the kernel.

mod common;

use common::*;
use std::collections::BTreeSet;
use straightline_codegen::emit::Target;
use straightline_codegen::{Compiled, Format, Stage, Unroll};
use straightline_kernels::prelude::*;
use straightline_runtime::{Pass, wgpu};
use straightline_study::oracle::{self, SraaInputs, SraaParams};
use wgpu::{TextureFormat, TextureUsages};

/// Most that a result may be off, for colours in 0..1 and before output rounding.
const BOUND: f64 = 1.0 / 1024.0;

struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
}

impl Gpu {
    fn new() -> Gpu {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .unwrap_or_else(|e| {
                panic!("this test needs a GPU adapter; without a GPU install Debian's mesa-vulkan-drivers: {e}")
            });
        let device = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()));
        let (device, queue) =
            device.unwrap_or_else(|e| panic!("the adapter {} gives no device: {e}", adapter.get_info().name));
        Gpu { device, queue }
    }

    fn texture(&self, size: UVec2, layers: u32, usage: TextureUsages) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: size.x,
                height: size.y,
                depth_or_array_layers: layers,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TextureFormat::Rgba32Float,
            usage,
            view_formats: &[],
        })
    }

    fn upload(&self, size: UVec2, layers: &[Vec<Vec4>], array: bool) -> wgpu::TextureView {
        let texture = self.texture(
            size,
            layers.len() as u32,
            TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
        );
        let bytes: Vec<u8> = layers
            .iter()
            .flatten()
            .flat_map(|c| c.to_array())
            .flat_map(f32::to_le_bytes)
            .collect();
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size.x * 16),
            rows_per_image: Some(size.y),
        };
        self.queue
            .write_texture(texture.as_image_copy(), &bytes, layout, texture.size());
        let dimension = if array {
            wgpu::TextureViewDimension::D2Array
        } else {
            wgpu::TextureViewDimension::D2
        };
        texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(dimension),
            ..Default::default()
        })
    }

    fn run(&self, compiled: &Compiled, stage: Stage, inputs: &Inputs) -> Frame<Vec4> {
        let emitted = compiled
            .emit(stage, Format::Rgba32Float, &BTreeSet::from([Target::Wgsl]))
            .expect("emitted");
        let wgsl = String::from_utf8(emitted.files[&Target::Wgsl].clone()).expect("text");
        let pass = Pass::new(&self.device, &emitted.manifest, &wgsl).unwrap_or_else(|e| panic!("{e}"));
        let depth: Vec<Vec<Vec4>> = layers(&inputs.gbuffer.depth, |d| vec4(d, 0.0, 0.0, 0.0));
        let normal: Vec<Vec<Vec4>> = layers(&inputs.gbuffer.normal, |n: Vec3| n.extend(0.0));
        let all = [
            ("depth", self.upload(inputs.size, &depth, true)),
            ("normal", self.upload(inputs.size, &normal, true)),
            (
                "color",
                self.upload(inputs.size, &[inputs.color.texels().to_vec()], false),
            ),
        ];
        let wanted: Vec<&str> = pass.inputs().collect();
        let bound: Vec<_> = all
            .iter()
            .filter(|(n, _)| wanted.contains(n))
            .map(|(n, v)| (*n, v))
            .collect();
        let usage = TextureUsages::STORAGE_BINDING | TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
        let target = self.texture(inputs.size, 1, usage);
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let view = target.create_view(&wgpu::TextureViewDescriptor::default());
        pass.encode(&mut encoder, &bound, &view)
            .unwrap_or_else(|e| panic!("{e}"));
        self.queue.submit([encoder.finish()]);
        self.download(&target)
    }

    fn download(&self, texture: &wgpu::Texture) -> Frame<Vec4> {
        let size = uvec2(texture.width(), texture.height());
        let row = (size.x * 16).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row * size.y),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row),
            rows_per_image: None,
        };
        let copy = wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout,
        };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), copy, texture.size());
        self.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the copy is done");
        let bytes = buffer.get_mapped_range(..).expect("mapped");
        let texel = |b: &[u8]| {
            let lane = |k: usize| f32::from_le_bytes([b[4 * k], b[4 * k + 1], b[4 * k + 2], b[4 * k + 3]]);
            vec4(lane(0), lane(1), lane(2), lane(3))
        };
        let lines = bytes.chunks_exact(row as usize);
        Frame::new(
            size,
            lines
                .flat_map(|line| line[..size.x as usize * 16].chunks_exact(16).map(texel))
                .collect(),
        )
    }
}

fn layers<T: Copy>(stack: &FrameLayers<T>, texel: impl Fn(T) -> Vec4) -> Vec<Vec<Vec4>> {
    stack
        .layers()
        .iter()
        .map(|l| l.texels().iter().map(|t| texel(*t)).collect())
        .collect()
}

fn exact(options: &[(String, String)], inputs: &Inputs) -> Vec<[f64; 4]> {
    let mut params = SraaParams::default();
    for (name, value) in options {
        params.set(name, value).unwrap_or_else(|e| panic!("{e}"));
    }
    let inputs = SraaInputs {
        color: &inputs.color,
        depth: &inputs.gbuffer.depth,
        normal: Some(&inputs.gbuffer.normal),
    };
    oracle::sraa(&inputs, &params)
}

/// The largest difference, over pixels where the exact result is finite and `paper`'s sum does not underflow.
fn difference(options: &[(String, String)], inputs: &Inputs, result: &Frame<Vec4>) -> f64 {
    let mut params = SraaParams::default();
    for (name, value) in options {
        params.set(name, value).unwrap_or_else(|e| panic!("{e}"));
    }
    let read = SraaInputs {
        color: &inputs.color,
        depth: &inputs.gbuffer.depth,
        normal: Some(&inputs.gbuffer.normal),
    };
    let paper = options.iter().any(|(_, v)| v == "paper");
    let lost = oracle::all_weights_underflow(&read, &params);
    let mut largest = 0.0f64;
    for (k, (a, b)) in result.texels().iter().zip(exact(options, inputs)).enumerate() {
        if paper && lost[k] {
            continue;
        }
        for (x, y) in a.to_array().into_iter().zip(b) {
            assert!(x.is_finite(), "pixel {k} is {a}, {options:?}");
            largest = largest.max((f64::from(x) - y).abs());
        }
    }
    largest
}

#[test]
fn all_options_match_the_brute_force() {
    let gpu = Gpu::new();
    let inputs = surfaces(uvec2(61, 47), 17, 5);
    let mut worst = (0.0, String::new());
    for (_, options) in all_options() {
        for (stage, unroll) in [
            (Stage::Compute, Unroll::Full),
            (Stage::Fragment, Unroll::Full),
            (Stage::Compute, Unroll::None),
        ] {
            let off = difference(&options, &inputs, &gpu.run(&compile(&options, unroll), stage, &inputs));
            let what = format!("{options:?} {stage:?} {unroll:?}");
            assert!(off <= BOUND, "off by {off:e}: {what}");
            if off > worst.0 {
                worst = (off, what);
            }
        }
    }
    println!("largest difference to f64: {:e} ({})", worst.0, worst.1);
}

#[test]
fn any_size_from_one_pixel() {
    let gpu = Gpu::new();
    for size in [uvec2(1, 1), uvec2(1, 7), uvec2(9, 1), uvec2(8, 8), uvec2(17, 33)] {
        let inputs = surfaces(size, 5, 11);
        for stage in [Stage::Compute, Stage::Fragment] {
            let off = difference(&[], &inputs, &gpu.run(&compile(&[], Unroll::Full), stage, &inputs));
            assert!(off <= BOUND, "{size} {stage:?}: off by {off:e}");
        }
    }
}

#[test]
fn a_bad_colour_spreads_no_further_than_its_weight() {
    let gpu = Gpu::new();
    let mut inputs = surfaces(uvec2(16, 16), 5, 2);
    // One surface to the left, another to the right of column 8, far apart: nothing crosses.
    let size = inputs.size;
    let column = |k: usize| k as u32 % size.x;
    let depth: Vec<f32> = (0..256).map(|k| if column(k) < 8 { 1.0 } else { 9.0 }).collect();
    let layers = (0..5).map(|_| Frame::new(size, depth.clone())).collect();
    inputs.gbuffer.depth = FrameLayers::new(layers);
    inputs.gbuffer.normal = FrameLayers::new((0..5).map(|_| Frame::new(size, vec![Vec3::Z; 256])).collect());
    let texels = (0..256)
        .map(|k| {
            if column(k) < 8 {
                Vec4::ONE
            } else {
                Vec4::splat(f32::INFINITY)
            }
        })
        .collect();
    inputs.color = Frame::new(size, texels);
    let result = gpu.run(&compile(&[], Unroll::Full), Stage::Compute, &inputs);
    for (k, texel) in result.texels().iter().enumerate().filter(|(k, _)| column(*k) < 8) {
        assert!(
            (*texel - Vec4::ONE).abs().max_element() < 1.0e-6,
            "pixel {k} is {texel}"
        );
    }
}

/// Arrays of kept loops are variables that are changed in place: begun anew, chosen, and read before they change.
#[test]
fn arrays_of_kept_loops_hold_what_the_graph_says() {
    let gpu = Gpu::new();
    let inputs = surfaces(uvec2(12, 9), 1, 3);
    let begun_anew = "let mut a = [1.0, 2.0, 3.0];
        for k in 0..3 {
            total += a[k];
            a = [5.0, 6.0, 7.0];
            a[k] = shade.x;
            total += a[0] + a[2];
        }";
    let chosen = "let mut a = [1.0, 2.0, 3.0];
        for k in 0..3 {
            if shade.x * (k as f32) > 0.4 {
                a[k] += shade.y;
            } else {
                a = [0.5, 0.25, 0.125];
            }
            total += a[0] - a[1] + a[2];
        }";
    let kept_or_begun = "let mut a = [1.0, 2.0, 3.0];
        for k in 0..3 {
            if shade.x > 0.5 {
                a = [9.0, 8.0, 7.0];
            }
            a[k] += 1.0;
            total += a[2 - k];
        }";
    for (name, body) in [("begun_anew", begun_anew), ("chosen", chosen), ("kept_or_begun", kept_or_begun)] {
        let text = format!(
            "pub fn {name}(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {{
                let shade = color.load(pixel);
                let mut total = 0.0;
                {body}
                Vec4::splat(total)
            }}"
        );
        let kernel = straightline_codegen::Kernel::from_text("test.rs", &text, name);
        let settings = |unroll| straightline_codegen::Settings { unroll, ..Default::default() };
        let compiled = [Unroll::Full, Unroll::None]
            .map(|unroll| kernel.compile(&settings(unroll)).unwrap_or_else(|e| panic!("{e}")));
        let [unrolled, looped] = [0, 1].map(|k| interpret(&compiled[k], &inputs, &[]));
        same_bits(&unrolled, &looped).unwrap_or_else(|e| panic!("{name}: {e}"));
        let result = gpu.run(&compiled[1], Stage::Compute, &inputs);
        for (k, (a, b)) in result.texels().iter().zip(&looped).enumerate() {
            assert!((*a - Vec4::from_array(*b)).abs().max_element() < 1.0e-4, "{name}, pixel {k}: {a} and {b:?}");
        }
    }
}
