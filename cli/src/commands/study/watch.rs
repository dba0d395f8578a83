//! How far a study is, with the time left; and Ctrl-C, which ends it and keeps what was measured.

use crate::failure::Failure;
use crate::scene;
use indicatif::ProgressBar;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use straightline_study::watch::Watch;

/// A bar on stderr, and whether Ctrl-C was pressed.
pub struct Progress {
    bar: ProgressBar,
    stop: Arc<AtomicBool>,
}

static STOP: OnceLock<Arc<AtomicBool>> = OnceLock::new();

impl Progress {
    /// Listens to Ctrl-C: the first one asks the study to stop, a second one ends the program.
    pub fn new() -> Result<Progress, Failure> {
        if let Some(stop) = STOP.get() {
            let stop = Arc::clone(stop);
            return Ok(Progress { bar: hidden(), stop });
        }
        let stop = Arc::new(AtomicBool::new(false));
        let pressed = Arc::clone(&stop);
        ctrlc::set_handler(move || {
            if pressed.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
            eprintln!("\nstopping; what was measured is kept (Ctrl-C again ends at once)");
        })
        .map_err(|error| Failure::Failed(format!("cannot listen to Ctrl-C: {error}")))?;
        let stop = Arc::clone(STOP.get_or_init(|| stop));
        Ok(Progress { bar: hidden(), stop })
    }
}

impl Progress {
    /// Takes the bar away, before something is printed.
    pub fn done(&mut self) {
        self.bar.finish_and_clear();
    }
}

fn hidden() -> ProgressBar {
    ProgressBar::hidden()
}

impl Watch for Progress {
    fn begin(&mut self, what: &str, steps: usize) {
        self.bar.finish_and_clear();
        self.bar = scene::bar(what);
        self.bar.set_length(steps as u64);
    }

    fn step(&mut self) {
        self.bar.inc(1);
    }

    fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
