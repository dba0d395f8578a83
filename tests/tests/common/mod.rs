//! Scenes of random surfaces and every option set of the SRAA kernel.

#![allow(dead_code)] // each test uses a part

use std::path::PathBuf;
use std::process::Command;
use straightline_codegen::{Compiled, Kernel, Settings, Unroll};
use straightline_kernels::prelude::*;
use straightline_kernels::sraa::{Falloff, GBuffer, Metric, Normalisation, Pattern, Shading, Sraa};
use straightline_study::execute;

/// What a frame's resolve reads.
pub struct Inputs {
    pub size: UVec2,
    pub gbuffer: GBuffer,
    pub color: Frame<Vec4>,
}

/// A small deterministic generator (SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In 0..1.
    pub fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1 << 24) as f32
    }
}

/// Slanted surfaces with steps between them, slopes, creases and a sky: what a G-buffer of `layers` layers holds.
pub fn surfaces(size: UVec2, layers: usize, seed: u64) -> Inputs {
    let mut random = Random(seed);
    let edges: Vec<(Vec2, f32, f32, Vec3)> = (0..6)
        .map(|_| {
            let angle = random.unit() * std::f32::consts::TAU;
            let normal = vec3(random.unit() - 0.5, random.unit() - 0.5, 0.3 + random.unit()).normalize();
            (
                Vec2::from_angle(angle),
                random.unit() * size.x as f32 - 0.3 * size.x as f32,
                1.0 + 9.0 * random.unit(),
                normal,
            )
        })
        .collect();
    let offsets: Vec<Vec2> = (0..layers)
        .map(|_| vec2(random.unit() - 0.5, random.unit() - 0.5))
        .collect();
    let surface = |at: Vec2| {
        let mut found = (1.0e6, Vec3::Z);
        for (direction, distance, depth, normal) in &edges {
            let side = direction.dot(at) - distance;
            if side > 0.0 && *depth < found.0 {
                found = (depth + 0.001 * side, *normal);
            }
        }
        found
    };
    let layer = |k: usize| {
        let at = |p: usize| vec2((p as u32 % size.x) as f32, (p as u32 / size.x) as f32) + 0.5 + offsets[k];
        (0..(size.x * size.y) as usize)
            .map(|p| surface(at(p)))
            .collect::<Vec<_>>()
    };
    let layers: Vec<Vec<(f32, Vec3)>> = (0..layers).map(layer).collect();
    let depth = layers
        .iter()
        .map(|l| Frame::new(size, l.iter().map(|s| s.0).collect()))
        .collect();
    let normal = layers
        .iter()
        .map(|l| Frame::new(size, l.iter().map(|s| s.1).collect()))
        .collect();
    let color = (0..size.x * size.y)
        .map(|_| vec4(random.unit(), random.unit(), random.unit(), 1.0))
        .collect();
    Inputs {
        size,
        gbuffer: GBuffer {
            depth: FrameLayers::new(depth),
            normal: FrameLayers::new(normal),
        },
        color: Frame::new(size, color),
    }
}

/// Every combination of the kernel's choices, as the kernel's own options and as the generator's.
pub fn all_options() -> Vec<(Sraa, Vec<(String, String)>)> {
    let mut all = Vec::new();
    for (pattern, p) in [
        (Pattern::Ordered4, "ordered4"),
        (Pattern::Latin4, "latin4"),
        (Pattern::Ordered16, "ordered16"),
        (Pattern::Latin16, "latin16"),
    ] {
        for (shading, s) in [(Shading::Sample0, "sample0"), (Shading::Centre, "centre")] {
            for (metric, m) in [(Metric::DepthNormals, "depth-normals"), (Metric::Depth, "depth")] {
                for (falloff, f) in [(Falloff::None, "none"), (Falloff::Tent, "tent")] {
                    for (normalisation, n) in [(Normalisation::Paper, "paper"), (Normalisation::Shifted, "shifted")] {
                        let cfg = Sraa {
                            pattern,
                            shading,
                            metric,
                            falloff,
                            normalisation,
                            ..Sraa::default()
                        };
                        let set = [
                            ("pattern", p),
                            ("shading", s),
                            ("metric", m),
                            ("falloff", f),
                            ("normalisation", n),
                        ];
                        all.push((cfg, set.map(|(k, v)| (k.to_owned(), v.to_owned())).to_vec()));
                    }
                }
            }
        }
    }
    all
}

pub fn compile(options: &[(String, String)], unroll: Unroll) -> Compiled {
    let settings = Settings {
        options: options.to_vec(),
        unroll,
        ..Settings::default()
    };
    Kernel::builtin("sraa")
        .and_then(|k| k.compile(&settings))
        .unwrap_or_else(|errors| panic!("{errors}"))
}

/// The inputs by name: depth, normal, color.
pub fn images(inputs: &Inputs) -> execute::Inputs {
    fn layers<T: Copy>(stack: &FrameLayers<T>, texel: impl Fn(T) -> Vec4) -> Vec<Frame<Vec4>> {
        let layer = |l: &Frame<T>| Frame::new(l.size(), l.texels().iter().map(|t| texel(*t)).collect());
        stack.layers().iter().map(layer).collect()
    }
    execute::Inputs::new(inputs.size)
        .layers("depth", layers(&inputs.gbuffer.depth, |d| vec4(d, 0.0, 0.0, 0.0)))
        .layers("normal", layers(&inputs.gbuffer.normal, |n| n.extend(0.0)))
        .image("color", inputs.color.clone())
}

/// Every pixel of a compiled kernel, by the interpreter.
pub fn interpret(compiled: &Compiled, inputs: &Inputs, uniforms: &[(&str, f64)]) -> Vec<[f32; 4]> {
    let mut images = images(inputs);
    for (name, value) in uniforms {
        images = images.uniform(name, &[*value]);
    }
    execute::interpret(compiled, &images, false)
        .expect("all inputs are bound")
        .texels
}

/// A device of any adapter.
pub fn bench() -> execute::Bench {
    let (device, queue) = device();
    execute::Bench::new(&device, &queue, false)
}

/// A device of any adapter, with what kernels can use of it.
pub fn device() -> (wgpu::Device, wgpu::Queue) {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter =
        pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).unwrap_or_else(|e| {
            panic!("this test needs a GPU adapter; without a GPU install Debian's mesa-vulkan-drivers: {e}")
        });
    let descriptor = wgpu::DeviceDescriptor {
        required_features: adapter.features() & (wgpu::Features::FLOAT32_FILTERABLE | wgpu::Features::SUBGROUP),
        ..Default::default()
    };
    let device = pollster::block_on(adapter.request_device(&descriptor));
    device.unwrap_or_else(|e| panic!("the adapter {} gives no device: {e}", adapter.get_info().name))
}

/// The same, bit for bit; any NaN equals any other.
pub fn same_bits(a: &[[f32; 4]], b: &[[f32; 4]]) -> Result<(), String> {
    for (k, (x, y)) in a.iter().zip(b).enumerate() {
        for (p, q) in x.iter().zip(y) {
            if p.to_bits() != q.to_bits() && !(p.is_nan() && q.is_nan()) {
                return Err(format!("pixel {k}: {x:?} and {y:?}"));
            }
        }
    }
    Ok(())
}

/// Has two compilers that share nothing with naga read GLSL and SPIR-V files.
pub fn other_compilers(glsl: &[PathBuf], spirv: &[PathBuf]) {
    let arguments = ["-V", "--target-env", "vulkan1.1", "-o", "/dev/null"];
    run("glslangValidator", "glslang-tools", &arguments, glsl);
    run("spirv-val", "spirv-tools", &["--target-env", "vulkan1.1"], spirv);
}

fn run(tool: &str, package: &str, arguments: &[&str], files: &[PathBuf]) {
    for file in files {
        let run = Command::new(tool).args(arguments).arg(file).output();
        let run = run.unwrap_or_else(|e| panic!("cannot run {tool} ({e}): install Debian's {package}"));
        let said = String::from_utf8_lossy(&run.stdout).into_owned() + &String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success(), "{tool} refuses {}:\n{said}", file.display());
    }
}
