//! Cost of recording a frame on the CPU: `cargo run --release -p straightline-tests --bin encode [-- FILE.json]`.
//!
//! Compares SRAA 4 through `Pass::bind`, through explicit wgpu calls, and bound anew every frame, with SMAA by the crate
//! `smaa`. All run in turn and are measured in CPU time of the recording thread, which excludes a software driver's own
//! threads.

use cpu_time::ThreadTime;
use serde_json::{Value, json};
use smaa::{SmaaMode, SmaaTarget};
use std::error::Error;
use std::process::ExitCode;
use std::time::{Duration, SystemTime};
use straightline_codegen::files;
use straightline_manifest::Manifest;
use straightline_runtime::{Bound, Pass};
use wgpu::{CommandEncoder, TextureFormat, TextureUsages, TextureViewDimension};

const WGSL: &str = include_str!("../../../shaders-out/sraa4.wgsl");
const MANIFEST: &str = include_str!("../../../shaders-out/sraa4.json");

/// Small, so that the shader's own time matters least: the recording does not depend on the size.
const SIZE: u32 = 64;

/// Frames that are timed together.
const FRAMES: usize = 64;

/// Measured repetitions of each, after one that does not count.
const ROUNDS: usize = 41;

fn main() -> ExitCode {
    let mut words = std::env::args().skip(1);
    let (file, more) = (words.next(), words.next());
    if more.is_some() || file.as_deref().is_some_and(|file| file.starts_with('-')) {
        eprintln!("usage: encode [FILE.json]");
        return ExitCode::from(2);
    }
    match run(file.as_deref()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(file: Option<&str>) -> Result<(), Box<dyn Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))?;
    let frame = Frame::new(&device);
    let manifest = Manifest::from_json(MANIFEST)?;
    let pass = Pass::new(&device, &manifest, WGSL)?;
    let bound = frame.bind(&pass)?;
    let handwritten = Handwritten::new(&device, &manifest, &frame)?;
    let mut smaa = SmaaTarget::new(
        &device,
        &queue,
        SIZE,
        SIZE,
        TextureFormat::Rgba16Float,
        SmaaMode::Smaa1X,
    );

    let gpu = Gpu { device, queue };
    let mut rows = [
        Row::new("bound once"),
        Row::new("wgpu calls written out"),
        Row::new("bound every frame"),
        Row::new("smaa, three passes"),
    ];
    for round in 0..=ROUNDS {
        for turn in 0..rows.len() {
            // Every other round runs them in reverse, so that none always follows the same one.
            let k = if round % 2 == 0 { turn } else { rows.len() - 1 - turn };
            let times = match k {
                0 => gpu.recorded(|encoder| bound.encode(encoder))?,
                1 => gpu.recorded(|encoder| handwritten.encode(encoder))?,
                2 => gpu.recorded(|encoder| frame.bind(&pass).expect("it was bound before").encode(encoder))?,
                // SMAA has an encoder of its own, and submits.
                _ => gpu.timed(|| {
                    for _ in 0..FRAMES {
                        smaa.start_frame(&gpu.device, &gpu.queue, &frame.shown).resolve();
                    }
                })?,
            };
            if round > 0 {
                rows[k].add(times);
            }
        }
    }
    let info = adapter.get_info();
    println!(
        "{} ({} {}), microseconds of CPU time a frame, median of {ROUNDS} rounds of {FRAMES} frames",
        info.name, info.driver, info.driver_info
    );
    println!(
        "{:24} {:>10} {:>14} {:>14}",
        "", "recorded", "and finished", "and submitted"
    );
    for row in &rows {
        let [recorded, finished, submitted] = row.medians();
        println!(
            "{:24} {:>10} {:>14} {:>14}",
            row.name,
            shown(recorded),
            shown(finished),
            shown(submitted)
        );
    }
    if let Some(file) = file {
        let record = json!({
            "command": format!("cargo run{} -p straightline-tests --bin encode -- {file}", profile()),
            "date": humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
            "adapter": format!("{} ({} {}, {})", info.name, info.driver, info.driver_info, info.backend),
            "processor": processor(),
            "clock": "CPU time of the recording thread",
            "shader": "shaders-out/sraa4.wgsl",
            "size": [SIZE, SIZE],
            "frames": FRAMES,
            "rounds": ROUNDS,
            "rows": rows.iter().map(Row::to_json).collect::<Vec<_>>(),
        });
        let text = serde_json::to_string_pretty(&record)? + "\n";
        files::write_file(file.as_ref(), text.as_bytes())?;
    }
    Ok(())
}

/// The option that says how this was built.
fn profile() -> &'static str {
    if cfg!(debug_assertions) { "" } else { " --release" }
}

fn processor() -> String {
    let told = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = told.lines().find_map(|line| line.strip_prefix("model name"));
    name.map_or("unknown", |name| name.trim_start_matches([' ', '\t', ':']))
        .to_owned()
}

fn shown(time: Option<f64>) -> String {
    time.map_or("–".to_owned(), |time| format!("{time:.2}"))
}

/// Microseconds a frame of each round: recorded; with the encoder made and finished; and submitted.
struct Row {
    name: &'static str,
    times: [Vec<f64>; 3],
}

impl Row {
    fn new(name: &'static str) -> Self {
        Row {
            name,
            times: Default::default(),
        }
    }

    fn add(&mut self, times: [Option<Duration>; 3]) {
        for (all, time) in self.times.iter_mut().zip(times) {
            all.extend(time.map(|time| time.as_secs_f64() * 1e6 / FRAMES as f64));
        }
    }

    fn medians(&self) -> [Option<f64>; 3] {
        self.times.each_ref().map(|times| {
            let mut sorted = times.clone();
            sorted.sort_by(f64::total_cmp);
            sorted.get(sorted.len() / 2).copied()
        })
    }

    fn to_json(&self) -> Value {
        let rounded = |time: &f64| (time * 1e3).round() / 1e3;
        let extremes = |times: &Vec<f64>| {
            let (min, max) = times
                .iter()
                .fold((f64::MAX, 0.0f64), |(a, b), t| (a.min(*t), b.max(*t)));
            (!times.is_empty()).then(|| [rounded(&min), rounded(&max)])
        };
        let [recorded, finished, submitted] = self.medians().map(|median| median.as_ref().map(rounded));
        json!({
            "name": self.name,
            "recorded_us": recorded,
            "recorded_us_range": extremes(&self.times[0]),
            "finished_us": finished,
            "submitted_us": submitted,
        })
    }
}

struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
}

impl Gpu {
    /// The time that `record` takes for all frames, each in an encoder of its own; with the encoders; with the submissions.
    fn recorded(&self, mut record: impl FnMut(&mut CommandEncoder)) -> Result<[Option<Duration>; 3], Box<dyn Error>> {
        let begin = ThreadTime::now();
        let new = |_| {
            self.device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
        };
        let mut encoders: Vec<CommandEncoder> = (0..FRAMES).map(new).collect();
        let made = begin.elapsed();
        encoders.iter_mut().for_each(&mut record);
        let recorded = begin.elapsed() - made;
        let buffers: Vec<_> = encoders.into_iter().map(CommandEncoder::finish).collect();
        let finished = begin.elapsed();
        for buffer in buffers {
            self.queue.submit([buffer]);
        }
        let submitted = begin.elapsed();
        self.wait()?;
        Ok([recorded, finished, submitted].map(Some))
    }

    /// The time of work that submits.
    fn timed(&self, work: impl FnOnce()) -> Result<[Option<Duration>; 3], Box<dyn Error>> {
        let begin = ThreadTime::now();
        work();
        let time = begin.elapsed();
        self.wait()?;
        Ok([None, None, Some(time)])
    }

    /// Waits for the device, though not for ever.
    fn wait(&self) -> Result<(), Box<dyn Error>> {
        self.device.poll(wgpu::PollType::Wait {
            submission_index: None,
            timeout: Some(Duration::from_secs(60)),
        })?;
        Ok(())
    }
}

/// Textures that SRAA 4 reads and writes, and that SMAA writes.
struct Frame {
    color: wgpu::TextureView,
    depth: wgpu::TextureView,
    normal: wgpu::TextureView,
    target: wgpu::TextureView,
    shown: wgpu::TextureView,
}

impl Frame {
    fn new(device: &wgpu::Device) -> Self {
        let view = |format, depth_or_array_layers, usage| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d {
                    width: SIZE,
                    height: SIZE,
                    depth_or_array_layers,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: (depth_or_array_layers > 1).then_some(TextureViewDimension::D2Array),
                ..Default::default()
            })
        };
        let read = TextureUsages::TEXTURE_BINDING;
        Frame {
            color: view(TextureFormat::Rgba16Float, 1, read),
            depth: view(TextureFormat::R32Float, 5, read),
            normal: view(TextureFormat::Rgba16Float, 5, read),
            target: view(TextureFormat::Rgba16Float, 1, TextureUsages::STORAGE_BINDING),
            shown: view(TextureFormat::Rgba16Float, 1, TextureUsages::RENDER_ATTACHMENT),
        }
    }

    fn inputs(&self) -> [(&str, &wgpu::TextureView); 3] {
        [("color", &self.color), ("depth", &self.depth), ("normal", &self.normal)]
    }

    fn bind(&self, pass: &Pass) -> Result<Bound, straightline_runtime::Error> {
        pass.bind(&self.inputs(), &self.target)
    }
}

/// Hand-written version of the same pass, without a runtime.
struct Handwritten {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    workgroups: [u32; 2],
}

impl Handwritten {
    fn new(device: &wgpu::Device, manifest: &Manifest, frame: &Frame) -> Result<Self, Box<dyn Error>> {
        let texture = |view_dimension| wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension,
            multisampled: false,
        };
        let types = [
            ("color", texture(TextureViewDimension::D2), &frame.color),
            ("depth", texture(TextureViewDimension::D2Array), &frame.depth),
            ("normal", texture(TextureViewDimension::D2Array), &frame.normal),
        ];
        let output = wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: TextureFormat::Rgba16Float,
            view_dimension: TextureViewDimension::D2,
        };
        let number = |name: &str| {
            manifest
                .binding(name)
                .map(|binding| binding.binding)
                .ok_or(format!("no `{name}`"))
        };
        let mut bound = Vec::new();
        for (name, ty, view) in types {
            bound.push((number(name)?, ty, view));
        }
        let place = manifest
            .outputs
            .first()
            .and_then(|output| output.binding)
            .ok_or("no output")?;
        bound.push((place, output, &frame.target));
        let entries: Vec<_> = bound
            .iter()
            .map(|(binding, ty, _)| wgpu::BindGroupLayoutEntry {
                binding: *binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: *ty,
                count: None,
            })
            .collect();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &entries,
        });
        let entries: Vec<_> = bound
            .iter()
            .map(|(binding, _, view)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: wgpu::BindingResource::TextureView(view),
            })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &entries,
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(WGSL.into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            })),
            module: &module,
            entry_point: Some(&manifest.entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let [x, y, _] = manifest.workgroup_size.ok_or("no workgroup size")?;
        Ok(Handwritten {
            pipeline,
            group,
            workgroups: [SIZE.div_ceil(x), SIZE.div_ceil(y)],
        })
    }

    fn encode(&self, encoder: &mut CommandEncoder) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("sraa"),
            timestamp_writes: None,
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.dispatch_workgroups(self.workgroups[0], self.workgroups[1], 1);
    }
}
