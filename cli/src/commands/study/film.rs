//! `study film`: frames of a pan, with the methods side by side.

use super::error::{parse_method, to_failure, unknown_method};
use super::{ProgressBars, circumstances_of};
use crate::args::{CommonArgs, FilmArgs};
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::scene;
use glam::UVec2;
use std::collections::BTreeSet;
use std::path::Path;
use straightline_codegen::files;
use straightline_scene::picture;
use straightline_study::quality::{self, Film, Method, REFERENCE, Shooting};
use straightline_study::record::{FilmRecord, FilmedMethod, Record};

/// Methods that are filmed by default.
const USUAL: [&str; 3] = ["1x", "MLAA", "SRAA 4"];

/// Default width and height of each method's picture.
const SIZE: UVec2 = UVec2::new(480, 270);

/// Maximum number of pixels of a film: all frames stay in memory until it is written.
const MOST_PIXELS: u64 = 1 << 27;

/// Display time of a frame, in milliseconds.
const SHOWN: u16 = 50;

/// Films the pan, and writes frames, animation and record.
pub fn film_methods(common: &CommonArgs, args: &FilmArgs, progress: &mut ProgressBars) -> Result<(), Failure> {
    let known = quality::list_methods(false);
    let methods = match args.methods.is_empty() {
        true => choose_methods(&USUAL.map(str::to_owned), &known)?,
        false => choose_methods(&args.methods, &known)?,
    };
    let world = scene::load_scene(args.mesh.as_deref(), &args.scene)?;
    let name = args
        .mesh
        .as_ref()
        .map_or(args.scene.clone(), |path| path.display().to_string());
    let shooting = Shooting {
        size: common.size.unwrap_or(SIZE),
        frames: args.frames,
        step: args.step,
    };
    let each = u64::from(shooting.size.x) * u64::from(shooting.size.y) * (methods.len() as u64 + 1);
    if each * u64::from(shooting.frames) > MOST_PIXELS {
        return Err(Failure::Usage(format!(
            "{} frames of {} pictures of {}x{} pixels are too many to keep: ask for fewer frames, fewer methods or a smaller --size",
            shooting.frames,
            methods.len() + 1,
            shooting.size.x,
            shooting.size.y
        )));
    }
    let gpu = Gpu::require(&common.adapter)?;
    let film = quality::film_scene(&gpu.bench(), &world, &methods, &shooting, progress).map_err(to_failure)?;
    let record = FilmRecord {
        circumstances: circumstances_of(&gpu, shooting.size, 0),
        scene: name,
        step: shooting.step.to_array(),
        methods: filmed_methods(methods, &film),
    };
    let mut set = record.to_files(FilmRecord::STEM).map_err(Failure::from_error)?;
    set.insert(
        "film.png".to_owned(),
        picture::encode_animation(&film.frames, SHOWN).map_err(Failure::from_error)?,
    );
    for (k, frame) in film.frames.iter().enumerate() {
        set.insert(
            format!("frames/{k:04}.png"),
            picture::png_bytes(frame).map_err(Failure::from_error)?,
        );
    }
    files::write_all(&common.out, &set).map_err(Failure::from_error)?;
    print(&record, &common.out);
    Ok(())
}

/// Returns the requested methods: by name from `known`, or parsed as the user's own.
pub fn choose_methods(texts: &[String], known: &[Method]) -> Result<Vec<Method>, Failure> {
    let mut stems = BTreeSet::new();
    let mut methods = Vec::new();
    for text in texts {
        let found = known.iter().find(|method| method.name == *text);
        let method = match (found, text.contains('=')) {
            (Some(known), _) => known.clone(),
            (None, true) => parse_method(text)?,
            (None, false) => {
                return Err(Failure::Usage(format!(
                    "{}\none of your own is NAME=KERNEL[,OPTION=VALUE]...",
                    unknown_method(text, known)
                )));
            }
        };
        if !stems.insert(method.file_stem()) {
            return Err(Failure::Usage(format!("the method `{}` is given twice", method.name)));
        }
        methods.push(method);
    }
    Ok(methods)
}

fn filmed_methods(methods: Vec<Method>, film: &Film) -> Vec<FilmedMethod> {
    let filmed = methods.into_iter().zip(&film.errors);
    filmed
        .map(|(method, errors)| FilmedMethod {
            options: method.options().to_vec(),
            method: method.name,
            errors: errors.clone(),
        })
        .collect()
}

fn print(record: &FilmRecord, out: &Path) {
    outln!("{}", record.summarise().to_text());
    let names: Vec<&str> = record.methods.iter().map(|method| method.method.as_str()).collect();
    outln!(
        "{} frames of {}, {} by {} pixels apart; row by row {} and {REFERENCE}, the reference. The root of the mean \
         squared error of what changes from a frame to the next, in colours of 0 to 1 at 8 bits.",
        record.methods.first().map_or(0, |method| method.errors.len() + 1),
        record.scene,
        record.step[0],
        record.step[1],
        names.join(", ")
    );
    outln!(
        "film.png (animated), frames, film.json and film.csv are in {}.",
        out.display()
    );
}
