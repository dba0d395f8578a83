//! The messages between the lanes of a quad, as arrows.

use super::panel::LANES;
use super::svg::{GREY, INK, Svg, TextStyle};
use super::{Part, SMALL};
use crate::footprint::{Footprint, Messages};

const HEADING: f64 = 14.0;

/// Width of a lane's square.
const LANE: f64 = 64.0;

/// Distance between the squares.
const BETWEEN: f64 = 84.0;

/// Height of the heading.
const HEAD: f64 = HEADING + SMALL * 1.25 + 14.0;

/// Panel of the messages.
pub struct MessagePanel<'a> {
    footprint: &'a Footprint,
}

/// Returns the panel, if the kernel has lanes that send messages.
pub fn make_messages(footprint: &Footprint) -> Option<MessagePanel<'_>> {
    (footprint.lanes && !footprint.messages.is_empty()).then_some(MessagePanel { footprint })
}

impl Part for MessagePanel<'_> {
    fn size(&self) -> [f64; 2] {
        [2.0 * LANE + BETWEEN, 2.0 * LANE + BETWEEN + HEAD]
    }

    fn draw(&self, svg: &mut Svg, [x, y]: [f64; 2]) {
        let heading = TextStyle {
            bold: true,
            ..TextStyle::plain(HEADING)
        };
        svg.add_text([x, y + HEADING], heading, "messages");
        let remark = TextStyle {
            color: GREY,
            ..TextStyle::plain(SMALL)
        };
        svg.add_text(
            [x, y + HEADING + 1.3 * SMALL * 1.25],
            remark,
            "of each lane (scalars in them)",
        );
        let corner = [x, y + HEAD];
        for lane in 0..4u32 {
            let at = [lane % 2, lane / 2].map(|k| f64::from(k) * (LANE + BETWEEN));
            let at = [corner[0] + at[0], corner[1] + at[1]];
            let color = LANES[lane as usize];
            let look = format!(r#"fill="{color}" fill-opacity="0.4" stroke="{INK}" stroke-width="1.5""#);
            svg.add_rect(at, [LANE, LANE], &look);
            let style = TextStyle::centred(SMALL);
            svg.add_text(
                [at[0] + LANE / 2.0, at[1] + LANE / 2.0 - 2.0],
                style,
                &format!("lane {lane}"),
            );
            let reads: u32 = self.footprint.textures.iter().map(|of| reads_of(of, lane)).sum();
            let style = TextStyle {
                color: GREY,
                ..TextStyle::centred(SMALL - 1.0)
            };
            let noun = if reads == 1 { "read" } else { "reads" };
            svg.add_text(
                [at[0] + LANE / 2.0, at[1] + LANE / 2.0 + 13.0],
                style,
                &format!("{reads} {noun}"),
            );
        }
        for messages in &self.footprint.messages {
            self.draw_arrows(svg, corner, messages);
        }
    }
}

/// Number of reads of a lane at constant places.
fn reads_of(of: &crate::footprint::TextureReads, lane: u32) -> u32 {
    of.taps.iter().filter(|tap| tap.lane == lane).map(|tap| tap.reads).sum()
}

impl MessagePanel<'_> {
    fn draw_arrows(&self, svg: &mut Svg, [x, y]: [f64; 2], of: &Messages) {
        let (near, far, middle) = (LANE, LANE + BETWEEN, LANE / 2.0);
        let other = LANE + BETWEEN + middle;
        let label = format!("{} ({})", of.messages, of.values);
        let centre = LANE + BETWEEN / 2.0;
        // Start, end, and the label's place of each arrow.
        let arrows: [[[f64; 2]; 3]; 2] = match of.direction {
            [1, 0] => [[middle, middle - 7.0], [other, other + 18.0]]
                .map(|[along, text]| [[near + 5.0, along], [far - 5.0, along], [centre, text]]),
            [0, 1] => [middle, other].map(|along| [[along, near + 5.0], [along, far - 5.0], [along, centre + 4.0]]),
            _ => [
                [[near + 4.0, near + 4.0], [far - 4.0, far - 4.0], [centre, centre + 4.0]],
                [[far - 4.0, near + 4.0], [near + 4.0, far - 4.0], [centre, centre + 4.0]],
            ],
        };
        for [from, to, _] in arrows {
            draw_arrow(svg, [x + from[0], y + from[1]], [x + to[0], y + to[1]]);
        }
        let labels = if of.direction == [1, 1] {
            &arrows[..1]
        } else {
            &arrows[..]
        };
        for [_, _, text] in labels {
            let at = [x + text[0], y + text[1]];
            let width = super::svg::text_width(&label, SMALL) + 4.0;
            svg.add_rect(
                [at[0] - width / 2.0, at[1] - SMALL],
                [width, SMALL + 4.0],
                r##"fill="#ffffff""##,
            );
            svg.add_text(at, TextStyle::centred(SMALL), &label);
        }
    }
}

/// Draws an arrow with a head at either end.
fn draw_arrow(svg: &mut Svg, from: [f64; 2], to: [f64; 2]) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]).max(1e-6);
    let unit = along.map(|x| x / length);
    let head = |tip: [f64; 2], sign: f64| {
        let side = |turn: f64| {
            let back = [unit[0] * 8.0 * sign, unit[1] * 8.0 * sign];
            [
                tip[0] + back[0] - unit[1] * 4.0 * turn,
                tip[1] + back[1] + unit[0] * 4.0 * turn,
            ]
        };
        [side(1.0), tip, side(-1.0)]
    };
    let (start, end) = (head(from, 1.0), head(to, -1.0));
    let look = format!(r#"fill="none" stroke="{INK}" stroke-width="1.4""#);
    svg.add_path(&[&[from, to], &start, &end], &look);
}
