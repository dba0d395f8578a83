//! A drawing of a kernel's footprint as SVG: a panel for each texture, the messages of a quad, and a legend.

mod cells;
mod legend;
mod messages;
mod panel;
mod svg;

use crate::footprint::Footprint;
use svg::{GREY, Svg, TextStyle, text_width, wrap_lines};

/// Distance between panels, and around everything, in pixels.
const GAP: f64 = 28.0;

/// Width beyond which panels continue in the next row.
const WIDTH: f64 = 940.0;

/// Minimum width, for titles and legends.
const LEAST_WIDTH: f64 = 420.0;

const TITLE: f64 = 18.0;
const SMALL: f64 = 12.0;

/// Subject of a drawing.
#[derive(Clone, Copy, Debug)]
pub struct Drawing<'a> {
    /// Name of the kernel.
    pub title: &'a str,
    /// Settings that are not at their defaults; may be empty.
    pub subtitle: &'a str,
    /// Reads and messages.
    pub footprint: &'a Footprint,
    /// Offsets of the samples of a texel from its middle, by layer, if they are known. A layer beyond them is the middle.
    pub samples: &'a [[f64; 2]],
}

/// A part of the drawing at its place.
trait Part {
    /// Width and height.
    fn size(&self) -> [f64; 2];
    /// Draws the part from its upper left corner.
    fn draw(&self, svg: &mut Svg, at: [f64; 2]);
}

/// Draws a footprint. Equal footprints have equal texts.
pub fn draw_footprint(drawing: &Drawing<'_>) -> String {
    let mut parts: Vec<Box<dyn Part + '_>> = panel::make_panels(drawing);
    if let Some(messages) = messages::make_messages(drawing.footprint) {
        parts.push(Box::new(messages));
    }
    let (places, [wide, high]) = place_parts(&parts);
    let width = wide.max(LEAST_WIDTH).max(text_width(drawing.title, TITLE));
    let mut svg = Svg::default();
    let mut y = GAP + TITLE * 0.6;
    let title = TextStyle {
        bold: true,
        ..TextStyle::plain(TITLE)
    };
    svg.add_text([GAP, y], title, drawing.title);
    for line in wrap_lines(drawing.subtitle, SMALL, width) {
        y += SMALL * 1.5;
        let style = TextStyle {
            color: GREY,
            ..TextStyle::plain(SMALL)
        };
        svg.add_text([GAP, y], style, &line);
    }
    y += GAP * 0.8;
    for (part, place) in parts.iter().zip(&places) {
        part.draw(&mut svg, [GAP + place[0], y + place[1]]);
    }
    y += high + GAP * 0.8;
    let y = legend::draw_legend(&mut svg, drawing, [GAP, y], width);
    let description = legend::describe_footprint(drawing.footprint);
    svg.finish([width + 2.0 * GAP, y + GAP * 0.5], drawing.title, &description)
}

/// Places parts side by side in rows. Returns the corners, and the size of all.
fn place_parts(parts: &[Box<dyn Part + '_>]) -> (Vec<[f64; 2]>, [f64; 2]) {
    let (mut x, mut y, mut row, mut widest) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
    let mut places = Vec::new();
    for part in parts {
        let [width, height] = part.size();
        if x > 0.0 && x + width > WIDTH {
            (x, y, row) = (0.0, y + row + GAP, 0.0);
        }
        places.push([x, y]);
        widest = widest.max(x + width);
        row = row.max(height);
        x += width + GAP;
    }
    (places, [widest, y + row])
}
