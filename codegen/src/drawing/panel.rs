//! A panel of one texture: its texels around the pixel, with those that are read.

use super::cells::{Cell, Grid, is_between, is_drawn};
use super::svg::{GREY, INK, Svg, TextStyle, text_width, wrap_lines};
use super::{Drawing, Part, SMALL};
use crate::footprint::{Footprint, Tap, TextureReads, Unit};
use std::collections::BTreeSet;

/// Colours of the four lanes, distinguishable with any colour vision (Okabe and Ito 2008). The first is that of kernels
/// without lanes.
pub const LANES: [&str; 4] = ["#0072b2", "#e69f00", "#009e73", "#cc79a7"];

/// Colour of negative weights.
pub const NEGATIVE: &str = "#d55e00";

/// Colour of texels in the memory of a workgroup.
pub const SHARED: &str = "#f0e442";

const HEADING: f64 = 14.0;

/// Smallest square with a number in it.
const LEAST_NUMBERED: f64 = 24.0;

/// Largest number of marks of filtered reads or samples in a panel.
const MOST_MARKS: usize = 1500;

struct Panel<'a> {
    of: &'a TextureReads,
    footprint: &'a Footprint,
    samples: &'a [[f64; 2]],
    grid: Grid,
    remarks: Vec<String>,
    /// Layers that are read, if there are several.
    layers: BTreeSet<u32>,
}

/// Returns a panel for each texture, or one with the pixel alone.
pub fn make_panels<'a>(drawing: &Drawing<'a>) -> Vec<Box<dyn Part + 'a>> {
    let footprint = drawing.footprint;
    let panels = footprint.textures.iter().filter(|of| !of.taps.is_empty());
    panels
        .map(|of| {
            let layers: BTreeSet<u32> = of.taps.iter().filter_map(|tap| tap.layer).collect();
            let grid = Grid::around(of, footprint.pixels, !layers.is_empty());
            let width = grid.size()[0].max(150.0);
            Box::new(Panel {
                of,
                footprint,
                samples: drawing.samples,
                remarks: wrap_lines(&remark_on(of, &grid, &layers, footprint.lanes), SMALL, width),
                grid,
                layers,
            }) as Box<dyn Part + 'a>
        })
        .collect()
}

/// Returns the line below a panel's name.
fn remark_on(of: &TextureReads, grid: &Grid, layers: &BTreeSet<u32>, lanes: bool) -> String {
    let reads: u32 = of.taps.iter().map(|tap| tap.reads).sum();
    let mut text = format!("{reads} read{}", if reads == 1 { "" } else { "s" });
    if reads < of.reads {
        text += &format!(" of {}", of.reads);
    }
    let of_lane = |lane| {
        let taps = of.taps.iter().filter(|tap| tap.lane == lane);
        taps.map(|tap| tap.reads).sum::<u32>()
    };
    if lanes && (0..4).all(|lane| of_lane(lane) * 4 == reads) {
        text += &format!(", {} a lane", reads / 4);
    }
    if layers.len() > 1 {
        text += &format!(", of {} layers or samples", layers.len());
    }
    if of.level > 0 {
        text += &format!(", level {}", of.level);
    }
    match of.unit {
        Unit::Texels(1.0) => {}
        Unit::Texels(scale) if scale < 1.0 => text += &format!("; a texel is {0}×{0} pixels", 1.0 / scale),
        Unit::Texels(scale) => text += &format!("; a pixel is {scale}×{scale} texels"),
        Unit::Around(causes) => text += &format!("; around a place that depends on {causes}"),
        Unit::Pixels => text += "; squares are pixels of the frame",
    }
    if grid.texels > 1 {
        text += &format!("; a square is {0}×{0} texels, darker with more reads", grid.texels);
    }
    text
}

impl Part for Panel<'_> {
    fn size(&self) -> [f64; 2] {
        let [width, height] = self.grid.size();
        let head = text_width(&self.of.texture, HEADING);
        let widest = self
            .remarks
            .iter()
            .map(|line| text_width(line, SMALL))
            .fold(head, f64::max);
        [width.max(widest), height + self.head_height()]
    }

    fn draw(&self, svg: &mut Svg, [x, y]: [f64; 2]) {
        let heading = TextStyle {
            bold: true,
            ..TextStyle::plain(HEADING)
        };
        svg.add_text([x, y + HEADING], heading, &self.of.texture);
        for (k, line) in self.remarks.iter().enumerate() {
            let style = TextStyle {
                color: GREY,
                ..TextStyle::plain(SMALL)
            };
            svg.add_text([x, y + HEADING + (k as f64 + 1.3) * SMALL * 1.25], style, line);
        }
        let corner = [x, y + self.head_height()];
        self.draw_shared(svg, corner);
        self.draw_cells(svg, corner);
        self.draw_pixels(svg, corner);
        self.draw_marks(svg, corner);
    }
}

impl Panel<'_> {
    fn head_height(&self) -> f64 {
        HEADING + self.remarks.len() as f64 * SMALL * 1.25 + 14.0
    }

    fn is_of_samples(&self) -> bool {
        !self.layers.is_empty()
    }

    fn draw_shared(&self, svg: &mut Svg, corner: [f64; 2]) {
        for shared in &self.of.shared {
            let at = add(corner, self.grid.to_panel(shared.first.map(f64::from)));
            let size = shared
                .size
                .map(|n| f64::from(n) * self.grid.cell / f64::from(self.grid.texels));
            svg.add_rect(at, size, &format!(r#"fill="{SHARED}" fill-opacity="0.45""#));
        }
    }

    fn draw_cells(&self, svg: &mut Svg, corner: [f64; 2]) {
        let (grid, cells) = (&self.grid, self.grid.fill_cells(&self.of.taps));
        let most_reads = cells.values().map(|cell| cell.reads).max().unwrap_or(1);
        let weights = cells.values().filter_map(|cell| cell.weight);
        let largest = weights.map(f64::abs).fold(0.0, f64::max);
        let size = [grid.cell, grid.cell];
        let place = |[row, column]: [u32; 2]| add(corner, [f64::from(column) * grid.cell, f64::from(row) * grid.cell]);
        for (square, cell) in &cells {
            let opacity = match cell.weight {
                _ if grid.texels > 1 => 0.15 + 0.75 * f64::from(cell.reads) / f64::from(most_reads),
                _ if self.is_of_samples() => 0.14,
                _ if cell.lanes.len() > 1 => 0.25,
                Some(weight) if largest > 0.0 => 0.16 + 0.54 * weight.abs() / largest,
                _ => 0.4,
            };
            let color = match cell.weight {
                Some(weight) if weight < 0.0 => NEGATIVE,
                _ if cell.lanes.len() == 1 => LANES[cell.lanes[0] as usize % 4],
                _ => GREY,
            };
            if !self.of.shared.is_empty() {
                svg.add_rect(place(*square), size, r##"fill="#ffffff""##);
            }
            svg.add_rect(
                place(*square),
                size,
                &format!(r#"fill="{color}" fill-opacity="{opacity:.2}""#),
            );
        }
        self.draw_lines(svg, corner);
        for (square, cell) in &cells {
            self.draw_content(svg, place(*square), cell);
        }
    }

    fn draw_lines(&self, svg: &mut Svg, [x, y]: [f64; 2]) {
        let ([columns, rows], [width, height]) = (self.grid.count, self.grid.size());
        let mut strokes: Vec<[[f64; 2]; 2]> = Vec::new();
        for k in 0..=columns {
            let at = x + f64::from(k) * self.grid.cell;
            strokes.push([[at, y], [at, y + height]]);
        }
        for k in 0..=rows {
            let at = y + f64::from(k) * self.grid.cell;
            strokes.push([[x, at], [x + width, at]]);
        }
        let strokes: Vec<&[[f64; 2]]> = strokes.iter().map(|s| &s[..]).collect();
        let thin = if self.grid.cell < 14.0 { 0.4 } else { 0.8 };
        svg.add_path(
            &strokes,
            &format!(r##"fill="none" stroke="#b4b4b4" stroke-width="{thin}""##),
        );
    }

    /// Draws the weight, the number of reads, and the lanes of a texel.
    fn draw_content(&self, svg: &mut Svg, [x, y]: [f64; 2], cell: &Cell) {
        let width = self.grid.cell;
        if self.grid.texels > 1 || width < LEAST_NUMBERED {
            return;
        }
        if cell.conditional {
            let inset = [width - 6.0, width - 6.0];
            let look = format!(r#"fill="none" stroke="{GREY}" stroke-width="1" stroke-dasharray="3 2""#);
            svg.add_rect([x + 3.0, y + 3.0], inset, &look);
        }
        if self.is_of_samples() {
            return;
        }
        if let Some(weight) = cell.weight {
            let text = spell_weight(weight);
            let size = (width * 0.3).min(width * 0.84 / text_width(&text, 1.0));
            svg.add_text(
                [x + width / 2.0, y + width / 2.0 + size * 0.35],
                TextStyle::centred(size),
                &text,
            );
        }
        let between = self.of.taps.iter().any(is_between);
        if cell.lanes.len() > 1 {
            let step = (width * 0.18).min(9.0);
            for lane in &cell.lanes {
                let place = [f64::from(lane % 2), f64::from(lane / 2)].map(|k| (k - 0.5) * step);
                let at = [x + width - step * 1.2 + place[0], y + width - step * 1.2 + place[1]];
                svg.add_circle(at, step * 0.42, &format!(r#"fill="{}""#, LANES[*lane as usize % 4]));
            }
        } else if cell.reads > 1 && !between {
            let style = TextStyle {
                color: GREY,
                ..TextStyle::centred(width * 0.2)
            };
            svg.add_text([x + width * 0.72, y + width * 0.32], style, &format!("×{}", cell.reads));
        }
    }

    fn draw_pixels(&self, svg: &mut Svg, corner: [f64; 2]) {
        let (grid, [columns, rows]) = (&self.grid, self.footprint.pixels);
        if matches!(self.of.unit, Unit::Around(_)) {
            return;
        }
        let width = grid.scale * grid.cell / f64::from(grid.texels);
        for row in 0..rows {
            for column in 0..columns {
                let at = grid.to_panel([f64::from(column) * grid.scale, f64::from(row) * grid.scale]);
                let stroke = if columns * rows > 1 { 1.5 } else { 2.5 };
                let look = format!(r#"fill="none" stroke="{INK}" stroke-width="{stroke}""#);
                svg.add_rect(add(corner, at), [width, width], &look);
            }
        }
        let weighed = self
            .of
            .taps
            .iter()
            .any(|tap| tap.weights.first().is_some_and(Option::is_some));
        if columns * rows > 1 && weighed && grid.texels == 1 {
            let look = format!(r#"fill="none" stroke="{INK}" stroke-width="3.5""#);
            svg.add_rect(add(corner, grid.to_panel([0.0, 0.0])), [width, width], &look);
        }
    }

    /// Draws samples, and positions of filtered reads.
    fn draw_marks(&self, svg: &mut Svg, corner: [f64; 2]) {
        let drawn = self.of.taps.iter().filter(|tap| is_drawn(tap));
        let marked: Vec<&Tap> = drawn.filter(|tap| self.is_of_samples() || is_between(tap)).collect();
        if self.grid.texels > 1 || marked.len() > MOST_MARKS {
            return;
        }
        if self.is_of_samples() {
            self.draw_unread(svg, corner, &marked);
        }
        let cell = self.grid.cell;
        for tap in marked {
            let color = LANES[tap.lane as usize % 4];
            let Some(layer) = tap.layer else {
                let [x, y] = add(corner, self.grid.to_panel(tap.at));
                let r = (cell * 0.13).clamp(2.0, 6.0);
                let around: &[[f64; 2]] = &[[x, y - r], [x + r, y], [x, y + r], [x - r, y], [x, y - r]];
                let look = format!(r##"fill="{color}" stroke="#ffffff" stroke-width="0.8""##);
                svg.add_path(&[around], &look);
                if let (Some(weight), true) = (first_weight(tap), cell >= LEAST_NUMBERED) {
                    let style = TextStyle {
                        rim: true,
                        ..TextStyle::centred((cell * 0.26).min(12.0))
                    };
                    svg.add_text([x, y - r - 2.0], style, &spell_weight(weight));
                }
                continue;
            };
            let at = add(corner, self.grid.to_panel(self.sample_place(tap, layer)));
            let (radius, size) = self.sample_size();
            svg.add_circle(
                at,
                radius,
                &format!(r##"fill="{color}" stroke="#ffffff" stroke-width="0.8""##),
            );
            if cell >= LEAST_NUMBERED {
                // A number above a sample at the texel's upper border would lie on that border.
                let above = at[1] - radius - 2.0 - size;
                let border = corner[1] + self.grid.to_panel(tap.at.map(f64::floor))[1];
                let baseline = if above < border {
                    at[1] + radius + size
                } else {
                    at[1] - radius - 2.0
                };
                let style = TextStyle {
                    rim: true,
                    ..TextStyle::centred(size)
                };
                svg.add_text([at[0], baseline], style, &layer.to_string());
            }
        }
    }

    /// Draws rings at samples of the texels that are not read.
    fn draw_unread(&self, svg: &mut Svg, corner: [f64; 2], read: &[&Tap]) {
        let [columns, rows] = self.grid.count;
        if (self.samples.len() * columns as usize * rows as usize) > MOST_MARKS {
            return;
        }
        let taken: BTreeSet<([i32; 2], u32)> = read
            .iter()
            .filter_map(|tap| Some((tap.at.map(|x| x.floor() as i32), tap.layer?)))
            .collect();
        for row in 0..rows as i32 {
            for column in 0..columns as i32 {
                let texel = [column + self.grid.first[0], row + self.grid.first[1]];
                for (k, sample) in self.samples.iter().enumerate() {
                    if taken.contains(&(texel, k as u32)) {
                        continue;
                    }
                    let at = [0, 1].map(|axis| f64::from(texel[axis]) + 0.5 + sample[axis]);
                    let at = add(corner, self.grid.to_panel(at));
                    let radius = self.sample_size().0 * 0.85;
                    svg.add_circle(at, radius, r##"fill="#ffffff" stroke="#9a9a9a" stroke-width="1""##);
                }
            }
        }
    }

    /// Radius of a sample, and size of its number.
    fn sample_size(&self) -> (f64, f64) {
        let samples = self.samples.len().max(self.layers.len());
        let radius = self.grid.cell * if samples > 8 { 0.038 } else { 0.06 };
        (
            radius.clamp(1.5, 6.0),
            (self.grid.cell * if samples > 8 { 0.1 } else { 0.14 }).clamp(5.0, 12.0),
        )
    }

    /// Place of a sample: by the pattern, or in a row of squares.
    fn sample_place(&self, tap: &Tap, layer: u32) -> [f64; 2] {
        let texel = tap.at.map(f64::floor);
        let offset = match self.samples {
            [] => {
                let rank = self.layers.iter().position(|other| *other == layer).unwrap_or(0);
                let side = (self.layers.len() as f64).sqrt().ceil().max(1.0);
                let [column, row] = [rank as f64 % side, (rank as f64 / side).floor()];
                let rows = (self.layers.len() as f64 / side).ceil();
                [(column + 0.5) / side - 0.5, (row + 0.5) / rows - 0.5 + 0.04]
            }
            known => known.get(layer as usize).copied().unwrap_or([0.0, 0.0]),
        };
        [0, 1].map(|axis| texel[axis] + 0.5 + offset[axis])
    }
}

fn first_weight(tap: &Tap) -> Option<f64> {
    tap.weights.first()?.as_ref()?.first().copied()
}

fn add(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// Denominators of weights that are spelled as fractions: those of boxes, tents and binomial filters.
const DENOMINATORS: [u32; 18] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 16, 25, 27, 32, 49, 64, 81, 121, 256];

/// Spells a weight: a fraction of small numbers, or three digits.
pub fn spell_weight(weight: f64) -> String {
    let (sign, size) = (if weight < 0.0 { "−" } else { "" }, weight.abs());
    if size < 1e-9 {
        return "0".to_owned();
    }
    for below in DENOMINATORS {
        let above = size * f64::from(below);
        if above <= 99.5 && above.round() >= 1.0 && (above - above.round()).abs() < 2e-6 * f64::from(below) {
            return match below {
                1 => format!("{sign}{above:.0}"),
                _ => format!("{sign}{above:.0}/{below}"),
            };
        }
    }
    let digits = match size {
        size if size >= 10.0 => 1,
        size if size >= 1.0 => 2,
        size if size >= 0.001 => 3,
        _ => return format!("{sign}{size:.0e}"),
    };
    let text = format!("{size:.digits$}");
    format!("{sign}{}", text.strip_prefix('0').unwrap_or(&text))
}
