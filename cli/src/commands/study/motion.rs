//! `study motion`: methods over consecutive frames.

use super::error::to_failure;
use super::film::choose_methods;
use super::{ProgressBars, circumstances_of};
use crate::args::{CommonArgs, MotionArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::scene;
use glam::UVec2;
use straightline_study::quality;
use straightline_study::record::{Motion, MotionRecord, MovedScene, Record};

/// Scenes by default: thin objects in front of others, edges near and far, and paint.
const USUAL: [&str; 3] = ["railings", "roof", "posters"];

/// Default width and height, small enough for a software renderer.
const SIZE: UVec2 = UVec2::new(240, 135);

/// Compares, writes the record and prints it.
pub fn compare_motion(common: &CommonArgs, args: &MotionArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    let known = quality::methods_in_motion();
    let methods = match args.methods.is_empty() {
        true => known,
        false => choose_methods(&args.methods, &known)?,
    };
    let names: Vec<&str> = match args.scene.is_empty() {
        true => USUAL.to_vec(),
        false => args.scene.iter().map(String::as_str).collect(),
    };
    let scenes: Vec<_> = names
        .iter()
        .map(|name| scene::load_scene(None, name))
        .collect::<Result<_, _>>()?;
    let gpu = Gpu::require(&common.adapter)?;
    let size = common.size.unwrap_or(SIZE);
    let mut record = MotionRecord {
        circumstances: circumstances_of(&gpu, size, 0),
        frames: args.frames,
        scenes: Vec::new(),
    };
    for (name, world) in names.iter().zip(&scenes) {
        for motion in Motion::ALL {
            let filmed = (size, args.frames as usize);
            let found = quality::in_motion(&gpu.bench(), (world, motion), &methods, filmed, progress);
            record.scenes.push(MovedScene {
                scene: (*name).to_owned(),
                motion,
                methods: found.map_err(to_failure)?,
            });
        }
    }
    record.write(&common.out).map_err(Failure::from_error)?;
    outln!("{}", record.to_table().to_text());
    outln!(
        "{} frames each, against 64 samples a pixel: mean PSNR in dB, mean FLIP, and the root of the mean squared error of what \
         changes from a frame to the next. motion.json and motion.csv are in {}.",
        record.frames,
        common.out.display()
    );
    Ok(())
}
