//! The arguments of `run` and `watch`.

use super::{AdapterArgs, ChainArgs, EmitArgs, KernelArgs, pair, size};
use clap::{Args, ValueEnum};
use glam::UVec2;
use straightline_codegen::Stage;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Executor {
    /// wgpu runs the emitted shader
    Gpu,
    /// The interpreter runs the shader's graph
    Cpu,
}

/// Inputs for a kernel and the size of its output.
#[derive(Debug, Clone, Args)]
pub struct GivenArgs {
    /// Picture for a texture of the kernel, NAME=FILE; NAME may be omitted for a kernel with one texture; may be given
    /// several times
    ///
    /// The file is a PNG or an EXR. FILE.exr:LAYER is one layer of a file, such as depth.exr:centre of a capture. Several
    /// files for one texture are its layers, in order. For a cube they are its faces +X, -X, +Y, -Y, +Z, -Z; for a volume
    /// its slices. A volume may also be a .cube table, or one picture with its slices side by side. An integer texture
    /// takes the numbers of a PNG as stored. For a texture of one or two components a PNG holds data from 0 to 1, otherwise
    /// a colour in sRGB. FILE,linear and FILE,srgb override that; normals in a PNG need FILE,linear.
    #[arg(long, value_name = "[NAME=]FILE[,FILE...]")]
    pub input: Vec<String>,
    /// Value of a uniform or override: NAME=NUMBER, or NAME=X,Y,Z for a vector; may be given several times
    #[arg(long, value_name = "NAME=NUMBERS", value_parser = pair)]
    pub uniform: Vec<(String, String)>,
    /// Elements of a buffer: NAME=A,B,C, or NAME=0*256 for 256 equal elements; may be given several times
    #[arg(long, value_name = "NAME=NUMBERS", value_parser = pair)]
    pub buffer: Vec<(String, String)>,
    /// Width and height of the output; by default those of the first input that has the output's size
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<UVec2>,
    /// Executor that computes the pixels
    #[arg(long, value_enum, default_value = "gpu")]
    pub executor: Executor,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

#[derive(Debug, Args)]
pub struct RunArgs {
    #[command(flatten)]
    pub kernel: KernelArgs,
    #[command(flatten)]
    pub chain: ChainArgs,
    #[command(flatten)]
    pub given: GivenArgs,
    /// Picture to write, [NAME=]FILE: .png (8 bits, sRGB) or .exr (linear floats); may be given several times
    ///
    /// Without NAME the first value of a kernel with several outputs is written. A buffer that the kernel writes goes to a
    /// .csv or .txt file, one element a line.
    #[arg(long, value_name = "[NAME=]FILE", required = true)]
    pub out: Vec<String>,
    /// Precision of floats: f16 or f32, on the CPU also f64
    #[arg(long, value_name = "PRECISION", default_value = "f32", value_parser = ["f16", "f32", "f64"])]
    pub precision: String,
    /// On the CPU, report the operation that produced the first NaN or infinity, and fail if there is one
    #[arg(long)]
    pub check_finite: bool,
    /// Pipeline stage on the GPU
    #[arg(long, value_name = "STAGE", default_value = "compute", value_parser = |s: &str| s.parse::<Stage>())]
    pub stage: Stage,
}

#[derive(Debug, Args)]
pub struct WatchArgs {
    #[command(flatten)]
    pub emit: EmitArgs,
    /// Also run the kernel and write its picture, .png or .exr, for an image viewer that reloads it
    #[arg(long, value_name = "FILE", help_heading = "Options of the picture")]
    pub picture: Option<String>,
    #[command(flatten, next_help_heading = "Options of the picture")]
    pub given: GivenArgs,
}

impl WatchArgs {
    /// Returns the arguments of `run` that make the picture; `None` if no picture was requested.
    pub fn to_run_args(&self) -> Option<RunArgs> {
        let picture = self.picture.clone()?;
        let spec = self.emit.shader_spec();
        Some(RunArgs {
            kernel: self.emit.kernel.clone(),
            chain: self.emit.chain.clone(),
            given: self.given.clone(),
            out: vec![picture],
            precision: spec.emit.precision.to_string(),
            check_finite: false,
            stage: spec.emit.stage,
        })
    }
}
