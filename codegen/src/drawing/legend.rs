//! The legend of a drawing: its marks, and reads that have no place in it.

use super::Drawing;
use super::cells::is_between;
use super::panel::{LANES, NEGATIVE, SHARED};
use super::svg::{GREY, INK, Svg, TextStyle, wrap_lines};
use crate::footprint::{Footprint, Tap, TextureReads, Unit};
use std::collections::BTreeSet;

const SIZE: f64 = 12.5;
const LINE: f64 = 19.0;
const SWATCH: f64 = 13.0;

/// Mark before a line of the legend.
enum Mark {
    None,
    /// Squares of these colours.
    Squares(Vec<&'static str>),
    Outline(f64),
    Dashes,
    Diamond,
    Sample,
    Ring,
}

/// Draws the legend. Returns the position below it.
pub fn draw_legend(svg: &mut Svg, drawing: &Drawing<'_>, [x, y]: [f64; 2], width: f64) -> f64 {
    let mut y = y;
    for (mark, text) in list_items(drawing) {
        let wide = match &mark {
            Mark::None => 0.0,
            Mark::Squares(colors) => colors.len() as f64 * (SWATCH + 3.0) + 5.0,
            _ => SWATCH + 8.0,
        };
        draw_mark(svg, &mark, [x, y]);
        for line in wrap_lines(&text, SIZE, width - wide) {
            svg.add_text([x + wide, y + SWATCH - 2.0], TextStyle::plain(SIZE), &line);
            y += LINE;
        }
    }
    y
}

fn draw_mark(svg: &mut Svg, mark: &Mark, [x, y]: [f64; 2]) {
    let (middle, size) = ([x + SWATCH / 2.0, y + SWATCH / 2.0], [SWATCH, SWATCH]);
    match mark {
        Mark::None => {}
        Mark::Squares(colors) => {
            for (k, color) in colors.iter().enumerate() {
                let at = [x + k as f64 * (SWATCH + 3.0), y];
                svg.add_rect(at, size, &format!(r#"fill="{color}" fill-opacity="0.45""#));
            }
        }
        Mark::Outline(stroke) => {
            svg.add_rect(
                [x, y],
                size,
                &format!(r#"fill="none" stroke="{INK}" stroke-width="{stroke}""#),
            );
        }
        Mark::Dashes => {
            let look = format!(r#"fill="none" stroke="{GREY}" stroke-width="1" stroke-dasharray="3 2""#);
            svg.add_rect([x, y], size, &look);
        }
        Mark::Diamond => {
            let ([a, b], r) = (middle, 5.0);
            let around: &[[f64; 2]] = &[[a, b - r], [a + r, b], [a, b + r], [a - r, b], [a, b - r]];
            svg.add_path(&[around], &format!(r#"fill="{}""#, LANES[0]));
        }
        Mark::Sample => svg.add_circle(middle, 4.5, &format!(r#"fill="{}""#, LANES[0])),
        Mark::Ring => svg.add_circle(middle, 4.0, r##"fill="#ffffff" stroke="#9a9a9a" stroke-width="1""##),
    }
}

fn list_items(drawing: &Drawing<'_>) -> Vec<(Mark, String)> {
    let footprint = drawing.footprint;
    let taps = || footprint.textures.iter().flat_map(|of| &of.taps);
    let weights = || taps().filter_map(|tap| tap.weights.first()?.as_ref()).flatten();
    let (weighed, [columns, rows]) = (weights().next().is_some(), footprint.pixels);
    let several = columns * rows > 1;
    let mut items = Vec::new();
    let shaded = taps().any(|tap| !is_between(tap) && tap.weights.first().is_some_and(Option::is_some));
    let shade = if shaded {
        ", the darker the larger its weight"
    } else {
        ""
    };
    let has_taps = taps().next().is_some();
    if has_taps && footprint.lanes {
        items.push((
            Mark::Squares(LANES.to_vec()),
            format!("texels that lanes 0, 1, 2 and 3 read{shade}"),
        ));
        let shares = |of: &TextureReads| {
            let lanes = of
                .taps
                .iter()
                .filter(|tap| tap.layer.is_none())
                .map(|tap| (tap.at.map(f64::to_bits), tap.lane));
            let lanes: BTreeSet<_> = lanes.collect();
            lanes.iter().zip(lanes.iter().skip(1)).any(|(a, b)| a.0 == b.0)
        };
        if footprint.textures.iter().any(shares) {
            items.push((
                Mark::Squares(vec![GREY]),
                "texel that the lanes of the dots read".to_owned(),
            ));
        }
    } else if has_taps {
        items.push((Mark::Squares(vec![LANES[0]]), format!("texel that is read{shade}")));
    }
    if weights().any(|weight| *weight < 0.0) {
        items.push((Mark::Squares(vec![NEGATIVE]), "texel with a negative weight".to_owned()));
    }
    let around = |of: &&TextureReads| !matches!(of.unit, Unit::Around(_)) && !of.taps.is_empty();
    let has_pixel = footprint.textures.iter().any(|of| around(&of));
    if has_pixel {
        let pixels = match (footprint.lanes, several) {
            (true, _) => "the pixels of the quad".to_owned(),
            (false, true) => format!("the {columns}×{rows} pixels of an invocation"),
            (false, false) => "the pixel".to_owned(),
        };
        items.push((Mark::Outline(1.5), pixels));
    }
    if weighed && several && !has_pixel {
        items.push((Mark::None, "The weights are those of the upper left pixel.".to_owned()));
    } else if weighed && several {
        items.push((Mark::Outline(3.0), "the pixel whose weights are given".to_owned()));
    }
    if taps().any(|tap| tap.layer.is_some()) {
        items.push((Mark::Sample, "layer or sample that is read, with its number".to_owned()));
        if !drawing.samples.is_empty() {
            items.push((Mark::Ring, "sample that is not read".to_owned()));
        }
    }
    if taps().any(|tap| is_between(tap) && tap.layer.is_none()) {
        items.push((Mark::Diamond, "position of a filtered read, between texels".to_owned()));
    }
    if taps().any(|tap| tap.conditional) {
        items.push((Mark::Dashes, "read under a runtime condition".to_owned()));
    }
    if let Some(shared) = footprint.textures.iter().flat_map(|of| &of.shared).next() {
        let [width, height] = shared.workgroup;
        let text = format!(
            "texels that a workgroup of {width}×{height} pixels reads into its memory; the pixel is the workgroup's first"
        );
        items.push((Mark::Squares(vec![SHARED]), text));
    }
    items.extend(list_remarks(footprint).into_iter().map(|text| (Mark::None, text)));
    items
}

/// Lines about reads that have no place in the drawing.
fn list_remarks(footprint: &Footprint) -> Vec<String> {
    let mut lines = Vec::new();
    if footprint.textures.is_empty() {
        lines.push("The kernel reads no texture.".to_owned());
    }
    for of in &footprint.textures {
        for other in &of.elsewhere {
            lines.push(format!(
                "{}: {} at {}",
                of.texture,
                count_reads(other.reads),
                other.place
            ));
        }
    }
    for memory in &footprint.memories {
        let kind = if memory.workgroup { "workgroup memory" } else { "buffer" };
        lines.push(format!("{} ({kind}): {}", memory.name, count_reads(memory.reads)));
    }
    if footprint.tested {
        lines.push("Weights hold where no comparison or clamp of the kernel replaces the value.".to_owned());
    }
    lines
}

/// Describes a drawing in a sentence, for readers who do not see it.
pub fn describe_footprint(footprint: &Footprint) -> String {
    let describe = |of: &TextureReads| {
        let near: u32 = of.taps.iter().map(|tap: &Tap| tap.reads).sum();
        format!(
            "{}: {} at constant places of {}",
            of.texture,
            near,
            count_reads(of.reads)
        )
    };
    let textures: Vec<String> = footprint.textures.iter().map(describe).collect();
    match textures.is_empty() {
        true => "No texture is read.".to_owned(),
        false => format!("Texels that one invocation reads. {}.", textures.join("; ")),
    }
}

fn count_reads(n: u32) -> String {
    format!("{n} read{}", if n == 1 { "" } else { "s" })
}
