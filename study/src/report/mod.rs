//! A page of all records in a folder: plots, tables, pictures to compare. It needs nothing beside itself.

mod frame;
mod hard;
mod isa;
mod loops;
mod pictures;
mod plot;
mod quality;
mod tune;

use crate::record::{
    Circumstances, FrameRecord, HardRecord, IsaRecord, LoopsRecord, QualityRecord, Record, RecordError, TuneRecord,
};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use straightline_codegen::files;
use tera::{Context, Tera};

pub use frame::plot_frames as frame_plot;

/// Name of the page.
pub const PAGE: &str = "report.html";

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// A record cannot be read, or the page cannot be written.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A picture that a record names cannot be shown.
    #[error(transparent)]
    Picture(#[from] straightline_scene::picture::PictureError),
    /// There is no record.
    #[error("there is no record in `{}`: run `study loops`, `study error`, `study hard`, `study isa` or `tune` with this --out first", .0.display())]
    Empty(PathBuf),
    /// Figures that cannot be drawn.
    #[error("a plot cannot be drawn: {0}")]
    Plot(String),
    /// The page's own template.
    #[error("the page cannot be put together: {0}")]
    Template(String),
}

/// Makes `report.html` in `folder` from every record that lies there: `frame*.json`, `loops*.json`, `error*.json`,
/// `hard*.json`, `isa*.json` and `tune*.json`, with the pictures that they name. Returns its path.
///
/// # Errors
///
/// [`ReportError`]; the page is whole, or as it was before.
pub fn write_report(folder: &Path) -> Result<PathBuf, ReportError> {
    let html = render_page(folder)?.into_bytes();
    files::write_all(folder, &BTreeMap::from([(PAGE.to_owned(), html)])).map_err(RecordError::from)?;
    Ok(folder.join(PAGE))
}

/// The page as text.
///
/// # Errors
///
/// [`ReportError`].
pub fn render_page(folder: &Path) -> Result<String, ReportError> {
    let mut pictures = pictures::Pictures::default();
    let frame = load_sections(folder, |record: FrameRecord| frame::build_section(&record))?;
    let loops = load_sections(folder, |record: LoopsRecord| loops::build_section(&record))?;
    let quality = load_sections(folder, |record: QualityRecord| {
        quality::build_section(&record, folder, &mut pictures)
    })?;
    let hard = load_sections(folder, |record: HardRecord| Ok(hard::build_section(&record)))?;
    let isa = load_sections(folder, |record: IsaRecord| Ok(isa::build_section(&record)))?;
    let tune = load_sections(folder, |record: TuneRecord| tune::build_section(&record))?;
    if frame.is_empty()
        && loops.is_empty()
        && quality.is_empty()
        && hard.is_empty()
        && isa.is_empty()
        && tune.is_empty()
    {
        return Err(ReportError::Empty(folder.to_owned()));
    }
    let mut context = Context::new();
    context.insert("frame", &frame);
    context.insert("loops", &loops);
    context.insert("quality", &quality);
    context.insert("hard", &hard);
    context.insert("isa", &isa);
    context.insert("tune", &tune);
    context.insert("pictures", &pictures.css());
    context.insert("style", include_str!("page/style.css"));
    context.insert("script", include_str!("page/script.js"));
    render(&context)
}

fn render(context: &Context) -> Result<String, ReportError> {
    let failure = |error: tera::Error| {
        let mut text = error.to_string();
        let mut source = std::error::Error::source(&error);
        while let Some(inner) = source {
            text = format!("{text}: {inner}");
            source = inner.source();
        }
        ReportError::Template(text)
    };
    let mut tera = Tera::default();
    tera.add_raw_templates([
        ("shared.html", include_str!("page/shared.html")),
        ("frame.html", include_str!("page/frame.html")),
        ("loops.html", include_str!("page/loops.html")),
        ("error.html", include_str!("page/error.html")),
        ("hard.html", include_str!("page/hard.html")),
        ("isa.html", include_str!("page/isa.html")),
        ("tune.html", include_str!("page/tune.html")),
        ("page.html", include_str!("page/page.html")),
    ])
    .map_err(failure)?;
    tera.render("page.html", context).map_err(failure)
}

/// Section of the page on one record.
#[derive(Debug, Serialize)]
struct Section<T> {
    /// Name of the record's file.
    file: String,
    #[serde(flatten)]
    body: T,
}

/// Every record of a kind in the folder, in order of name.
fn load_sections<R: Record, T>(
    folder: &Path,
    mut body: impl FnMut(R) -> Result<T, ReportError>,
) -> Result<Vec<Section<T>>, ReportError> {
    let entries = std::fs::read_dir(folder).map_err(|source| {
        ReportError::Record(RecordError::Read {
            path: folder.to_owned(),
            source,
        })
    })?;
    let mut files: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| is_record_file(name, R::STEM))
        .collect();
    files.sort();
    let section = |file: String| {
        let body = body(R::read(&folder.join(&file))?)?;
        Ok(Section { file, body })
    };
    files.into_iter().map(section).collect()
}

/// Returns whether a file is `STEM.json` or `STEM-SOMETHING.json`.
fn is_record_file(file: &str, stem: &str) -> bool {
    file.strip_suffix(".json")
        .and_then(|name| name.strip_prefix(stem))
        .is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
}

/// The circumstances in a line, for the caption of a figure.
fn format_caption(circumstances: &Circumstances) -> String {
    let Circumstances {
        command,
        date,
        adapter,
        processor,
        clock,
        size: [width, height],
        rounds,
        intervals,
        complete,
    } = circumstances;
    let clock = match clock {
        straightline_bench::execute::Clock::GpuTimestamps => "GPU timestamps",
        straightline_bench::execute::Clock::WallClock => "wall clock",
    };
    let interrupted = if *complete {
        ""
    } else {
        " · interrupted: not all was measured"
    };
    format!(
        "{adapter} · {processor} · {width}×{height} · {rounds} rounds in turn, {clock}, {} · {} · {command}{interrupted}",
        intervals.display_name(),
        date.get(..10).unwrap_or(date)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_are_known_by_their_names() {
        assert!(is_record_file("loops.json", "loops") && is_record_file("loops-lavapipe.json", "loops"));
        assert!(
            !is_record_file("loops.csv", "loops")
                && !is_record_file("loopsy.json", "loops")
                && !is_record_file("error.json", "loops")
        );
    }

    #[test]
    fn an_empty_folder_has_no_page() {
        let folder = std::env::temp_dir().join(format!("straightline-report-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let error = render_page(&folder).unwrap_err().to_string();
        assert!(error.contains("no record") && error.contains("study loops"), "{error}");
        std::fs::write(folder.join("hard.json"), "{}").unwrap();
        let error = render_page(&folder).unwrap_err().to_string();
        assert!(
            error.contains("hard.json") && error.contains("missing field"),
            "{error}"
        );
        std::fs::remove_dir_all(&folder).unwrap();
        assert!(render_page(&folder).unwrap_err().to_string().contains("cannot read"));
    }
}
