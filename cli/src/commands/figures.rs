//! `figures`: reproduces the pictures of the publications.

use super::quads::pictures;
use super::study::ProgressBars;
use super::study::error::to_failure;
use crate::args::FiguresArgs;
use crate::failure::Failure;
use crate::gpu::Gpu;
use crate::scene;
use std::collections::BTreeMap;
use std::time::Duration;
use straightline_codegen::files;
use straightline_scene::picture;
use straightline_study::quads;
use straightline_study::quality::{FIGURES, Figure};
use straightline_table::Table;

/// Figures of the chapter: names and subjects.
const OF_THE_CHAPTER: [(&str, &str); 2] = [
    ("pqa-03", "half resolution brought up by one read a pixel"),
    (
        "pqa-07",
        "8x8 shadows by four comparisons a pixel, and a gradient that hides the quads",
    ),
];

/// Makes all requested figures, and writes them together.
pub fn write_figures(args: &FiguresArgs) -> Result<(), Failure> {
    let known: Vec<&str> = FIGURES
        .iter()
        .map(|figure| figure.name)
        .chain(OF_THE_CHAPTER.map(|(name, _)| name))
        .collect();
    if let Some(unknown) = args.figures.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(Failure::Usage(format!(
            "there is no figure `{unknown}`; there are {}",
            known.join(", ")
        )));
    }
    files::try_folder(&args.out).map_err(Failure::from_error)?;
    let wanted = |name: &str| args.figures.is_empty() || args.figures.iter().any(|asked| asked == name);
    let gpu = Gpu::require(&args.adapter)?;
    let bench = gpu.bench();
    let mut progress = ProgressBars::new();
    let (mut set, mut rows) = (BTreeMap::new(), Vec::new());
    let chosen: Vec<&Figure> = FIGURES.iter().filter(|figure| wanted(figure.name)).collect();
    for figure in chosen {
        let made = figure
            .render_panes(&bench, args.size, &mut progress)
            .map_err(to_failure)?;
        let bytes = picture::png_bytes(&made.picture).map_err(Failure::from_error)?;
        set.insert(format!("{}.png", figure.name), bytes);
        let psnr: Vec<String> = made
            .psnr
            .iter()
            .map(|(name, db)| format!("{name} {db:.1} dB"))
            .collect();
        rows.push([figure.name.to_owned(), figure.shows.to_owned(), psnr.join("; ")]);
    }
    if OF_THE_CHAPTER.iter().any(|(name, _)| wanted(name)) {
        // Minimal timing: only the pictures are needed.
        let setup = quads::Setup {
            size: args.size,
            texels: 512,
            rounds: 1,
            least: Duration::ZERO,
        };
        let studied = quads::study_quads(&bench, &scene::load_scene(None, "roof")?, &setup, &mut progress)
            .map_err(Failure::from_error)?;
        let of_quads = [
            pictures::occlusion_details(&studied),
            pictures::shadow_details(&bench, &studied)?,
        ];
        for ((name, shows), made) in OF_THE_CHAPTER.iter().zip(of_quads) {
            if wanted(name) {
                let bytes = picture::png_bytes(&made).map_err(Failure::from_error)?;
                set.insert(format!("{name}.png"), bytes);
                rows.push([*name, *shows, ""].map(str::to_owned));
            }
        }
    }
    drop(progress);
    files::write_all(&args.out, &set).map_err(Failure::from_error)?;
    let table = Table::of(rows)
        .column("figure", |[figure, ..]| figure.clone())
        .column("what it shows", |[_, shows, _]| shows.clone())
        .column("of the whole picture", |[.., part]| part.clone())
        .finish();
    outln!("{}", table.to_text());
    outln!("The pictures are in {}.", args.out.display());
    Ok(())
}
