//! A device, and comparisons.

#![allow(dead_code)] // each test uses a part

pub mod forms;

use std::path::PathBuf;
use std::process::Command;
use straightline_bench::execute;
use straightline_codegen::emit::Emitted;
use straightline_kernels::prelude::{IVec2, IVec3, IVec4, UVec2, UVec3, UVec4, Vec2, Vec3, Vec4};
#[allow(unused_imports)] // each test uses a part
pub use straightline_tests::sraa::Random;

/// wgpu without OpenGL: an instance with it opens EGL's one display, and closes it for the whole process when it goes.
pub fn instance() -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::PRIMARY;
    wgpu::Instance::new(descriptor)
}

/// A device of any adapter.
pub fn bench() -> execute::Bench {
    let (device, queue) = device();
    execute::Bench::new(&device, &queue, false)
}

/// A device of any adapter, with the features that kernels can use.
pub fn device() -> (wgpu::Device, wgpu::Queue) {
    let instance = instance();
    let adapter =
        pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).unwrap_or_else(|e| {
            panic!("this test needs a GPU adapter; without a GPU install Debian's mesa-vulkan-drivers: {e}")
        });
    let descriptor = wgpu::DeviceDescriptor {
        required_features: adapter.features()
            & (wgpu::Features::FLOAT32_FILTERABLE
                | wgpu::Features::SUBGROUP
                | wgpu::Features::SHADER_F16
                | wgpu::Features::TIMESTAMP_QUERY),
        // Several targets, and those of full floats, are more than WebGPU promises.
        required_limits: wgpu::Limits {
            max_color_attachment_bytes_per_sample: adapter.limits().max_color_attachment_bytes_per_sample,
            max_storage_textures_per_shader_stage: adapter.limits().max_storage_textures_per_shader_stage,
            ..wgpu::Limits::default()
        },
        ..Default::default()
    };
    let device = pollster::block_on(adapter.request_device(&descriptor));
    device.unwrap_or_else(|e| panic!("the adapter {} gives no device: {e}", adapter.get_info().name))
}

/// Compares bit for bit; any NaN equals any other.
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

/// Compares bit for bit; any NaN equals any other.
pub fn same_texels(a: &[[f64; 4]], b: &[[f64; 4]]) -> Result<(), String> {
    if a.len() != b.len() {
        return Err(format!("{} pixels and {}", a.len(), b.len()));
    }
    for (k, (x, y)) in a.iter().zip(b).enumerate() {
        for (p, q) in x.iter().zip(y) {
            if p.to_bits() != q.to_bits() && !(p.is_nan() && q.is_nan()) {
                return Err(format!("pixel {k}: {x:?} and {y:?}"));
            }
        }
    }
    Ok(())
}

/// Conversion of a value to a target's texel: missing components are 0, and the fourth is 1.
pub trait Texel {
    fn texel(&self) -> [f64; 4];
}

fn whole(components: &[f64]) -> [f64; 4] {
    std::array::from_fn(|k| components.get(k).copied().unwrap_or(f64::from(u8::from(k == 3))))
}

macro_rules! texel_of {
    ($($number:ty),*; $($vector:ty),*) => {
        $(impl Texel for $number {
            fn texel(&self) -> [f64; 4] {
                whole(&[f64::from(*self)])
            }
        })*
        $(impl Texel for $vector {
            fn texel(&self) -> [f64; 4] {
                whole(&self.to_array().map(f64::from))
            }
        })*
    };
}

texel_of!(f32, i32, u32; Vec2, Vec3, Vec4, IVec2, IVec3, IVec4, UVec2, UVec3, UVec4);

/// Shaders in files, for compilers that share nothing with naga.
pub struct Shaders {
    folder: PathBuf,
    pub glsl: Vec<PathBuf>,
    pub spirv: Vec<PathBuf>,
}

impl Shaders {
    /// None yet, in a folder of this name.
    pub fn new(folder: &str) -> Shaders {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(folder);
        std::fs::create_dir_all(&folder).expect("a folder for shaders");
        Shaders {
            folder,
            glsl: Vec::new(),
            spirv: Vec::new(),
        }
    }

    /// Writes the GLSL and the SPIR-V.
    pub fn write(&mut self, emitted: &Emitted, stem: &str) {
        for (name, contents) in emitted.named_files(stem) {
            let path = self.folder.join(&name);
            let files = match name.rsplit('.').next() {
                Some("comp" | "frag") => &mut self.glsl,
                Some("spv") => &mut self.spirv,
                _ => continue,
            };
            std::fs::write(&path, contents).expect("a shader is written");
            files.push(path);
        }
    }

    /// Has two compilers read them.
    pub fn read(&self) {
        other_compilers(&self.glsl, &self.spirv);
    }
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
