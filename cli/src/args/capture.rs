//! Arguments of `capture`, `resolve` and `compare`, and the view arguments of every command that renders a scene of
//! choice.

use super::{AdapterArgs, Executor, SettingsArgs, size};
use clap::{Args, ValueEnum};
use glam::{UVec2, Vec3};
use std::path::PathBuf;
use straightline_codegen::{Stage, shorten};

/// Scene to render and its camera.
#[derive(Debug, Args)]
pub struct ViewArgs {
    /// Built-in scene to render; `scenes` lists them
    #[arg(long, value_name = "NAME", default_value = "roof")]
    pub scene: String,
    /// Model to render instead of a built-in scene: .gltf, .glb or .obj
    #[arg(long, value_name = "FILE", conflicts_with = "scene")]
    pub mesh: Option<PathBuf>,
    /// Camera position: x, y and z, in the model's own space, y up; by default a point from which all of the model is
    /// visible
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    pub eye: Option<Vec3>,
    /// Point at the centre of the picture, in the same space; by default the centre of the model
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    pub target: Option<Vec3>,
    /// Vertical field of view in degrees, 1 to 170
    #[arg(long, value_name = "DEGREES", value_parser = degrees)]
    pub fov: Option<f32>,
}

#[cfg(feature = "study")]
impl ViewArgs {
    /// Returns the scene's name, or that of the model's file.
    pub fn scene_name(&self) -> String {
        let model = self.mesh.as_deref().and_then(std::path::Path::file_name);
        model.map_or_else(|| self.scene.clone(), |name| name.to_string_lossy().into_owned())
    }
}

/// Metric that distinguishes surfaces when shading samples are placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PlacedByArg {
    /// Planes and normals: metric=planes-normals difference=relative depth-scale=10 unseen=0.003
    Planes,
    /// Depths and normals: difference=relative depth-scale=3
    Depths,
}

#[derive(Debug, Args)]
pub struct CaptureArgs {
    #[command(flatten)]
    pub view: ViewArgs,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: UVec2,
    /// Geometry samples in a pixel: ordered4, latin4, standard8, ordered16, latin16, standard16, or x and y of each
    /// sample in pixels from the centre: -0.25,0.1,0.25,-0.1
    #[arg(long, value_name = "PATTERN", default_value = "latin4", allow_hyphen_values = true)]
    pub pattern: String,
    /// Shading samples in a pixel: centre, sample0, placed (by `sraa_place`), or listed in --shaded
    #[arg(long, value_name = "WHERE", default_value = "centre")]
    pub shading: String,
    /// With --shading placed: metric that distinguishes surfaces, by the options of docs/sraa.md; by default planes
    /// if the pattern has a name
    #[arg(long, value_enum, value_name = "WHAT")]
    pub placed_by: Option<PlacedByArg>,
    /// With --shading listed: the geometry samples that are shaded, counted from 0: one, two or four
    #[arg(long, value_name = "SAMPLES", value_delimiter = ',')]
    pub shaded: Vec<usize>,
    /// Also write the albedo of every geometry sample with its shadow, the direct light, and highlights and haze, as
    /// `demodulate` needs
    #[arg(long)]
    pub albedo: bool,
    /// Also write an estimate of the colour at every geometry sample, from the sun, its shadow and highlight, and one
    /// constant of ambient light, as `guide=add` needs
    #[arg(long)]
    pub guide: bool,
    /// Also render the reference with this many shaded samples a pixel, 16 or 256
    #[arg(long, value_name = "SAMPLES", value_parser = ["16", "256"])]
    pub reference: Option<String>,
    /// Folder to write
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

#[derive(Debug, Args)]
pub struct ResolveArgs {
    /// Folder of the captured frame (see docs/captures.md)
    #[arg(long, value_name = "DIR")]
    pub capture: PathBuf,
    /// Picture to write: .png (8 bits, sRGB) or .exr (linear floats)
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    #[command(flatten)]
    pub options: SettingsArgs,
    /// Executor that computes the pixels
    #[arg(long, value_enum, default_value = "gpu")]
    pub executor: Executor,
    /// Pipeline stage, on the GPU
    #[arg(long, value_name = "STAGE", default_value = "compute", value_parser = |s: &str| s.parse::<Stage>())]
    pub stage: Stage,
    /// Print the error against the capture's reference
    #[arg(long)]
    pub reference: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub adapter: AdapterArgs,
}

#[derive(Debug, Args)]
pub struct CompareArgs {
    /// Picture to judge: .png (sRGB) or .exr (linear floats)
    #[arg(value_name = "PICTURE")]
    pub picture: PathBuf,
    /// Reference picture of the same size: .png or .exr
    #[arg(value_name = "REFERENCE")]
    pub reference: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Parses a point in space.
fn point(text: &str) -> Result<Vec3, String> {
    let axes: Option<Vec<f32>> = text.split(',').map(|axis| axis.trim().parse().ok()).collect();
    let axes = axes.and_then(|axes| <[f32; 3]>::try_from(axes).ok());
    match axes.map(Vec3::from).filter(|point| point.is_finite()) {
        Some(point) => Ok(point),
        None => Err(format!(
            "`{}` is not a point: give x, y and z, such as 1.5,2,-4",
            shorten(text)
        )),
    }
}

/// Parses a field of view in degrees.
fn degrees(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(angle) if (1.0..=170.0).contains(&angle) => Ok(angle),
        _ => Err(format!(
            "`{}` is no angle of view: give degrees from 1 to 170, such as 50",
            shorten(text)
        )),
    }
}
