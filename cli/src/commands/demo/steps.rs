//! Files that are written one after the other, each with a line of progress.

use crate::args::DemoArgs;
use crate::failure::Failure;
use glam::Vec4;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;
use straightline_codegen::files;
use straightline_kernels::prelude::Frame;
use straightline_scene::picture;

/// The folder, and the time of the step that is under way.
pub struct Steps {
    folder: PathBuf,
    began: Instant,
    quiet: bool,
}

impl Steps {
    /// Finds out that the folder can be written, and says what will be there.
    pub fn begin(args: &DemoArgs) -> Result<Steps, Failure> {
        let steps = Steps {
            folder: args.out.clone(),
            began: Instant::now(),
            quiet: args.json,
        };
        if !steps.quiet {
            errln!(
                "shaders, pictures and a table of their cost, in the folder {}:",
                args.out.display()
            );
        }
        files::try_folder(&steps.folder).map_err(Failure::from_error)?;
        Ok(steps)
    }

    /// Writes files as one set, all or none.
    pub fn write(&mut self, set: BTreeMap<String, Vec<u8>>, name: &str) -> Result<(), Failure> {
        files::write_all(&self.folder, &set).map_err(Failure::from_error)?;
        self.done(name);
        Ok(())
    }

    /// Writes a picture, under its name in small letters.
    pub fn write_picture(&mut self, name: &str, frame: &Frame<Vec4>) -> Result<(), Failure> {
        let file = format!("{}.png", name.to_lowercase().replace(' ', "-"));
        let bytes = picture::png_bytes(frame).map_err(Failure::from_error)?;
        self.write(BTreeMap::from([(file.clone(), bytes)]), &file)
    }

    /// Says that a step is done, and how long it took.
    pub fn done(&mut self, name: &str) {
        if !self.quiet {
            errln!("  {name} ({:.1} s)", self.began.elapsed().as_secs_f64());
        }
        self.began = Instant::now();
    }
}
