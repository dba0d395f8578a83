//! Plots as SVG: axes by plotters, and on them points that say what they are when pointed at.

use super::ReportError;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::prelude::*;
use std::fmt::Write;
use std::ops::Range;

/// Colours that are distinguishable with any colour vision (Okabe and Ito 2008).
pub const COLORS: [&str; 11] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#777777", "#7b3294", "#8c564b",
    "#bcbd22",
];

/// Largest number on an axis.
const LARGEST: f64 = 1e12;

/// A point.
#[derive(Clone, Debug)]
pub struct Dot {
    /// Place of the dot.
    pub at: (f64, f64),
    /// From where to where it may lie across or up, on the axis of the plot's whiskers.
    pub spread: Option<(f64, f64)>,
    /// Index into [`COLORS`].
    pub color: usize,
    /// Written beside it, where there is room.
    pub label: Option<String>,
    /// Shown when it is pointed at.
    pub title: String,
}

/// Points joined by a line.
#[derive(Clone, Debug)]
pub struct Line {
    /// In order.
    pub points: Vec<(f64, f64)>,
    /// Index into [`COLORS`].
    pub color: usize,
    /// True if the line is dashed.
    pub dashed: bool,
    /// Written at its right end.
    pub label: Option<String>,
}

/// Division of an axis.
#[derive(Clone, Debug)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By powers of two.
    Log,
    /// At 0, 1, 2, ..., which have these names.
    Names(Vec<String>),
}

/// A plot.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Width and height in pixels.
    pub size: (u32, u32),
    /// Quantities on the axes, across and up.
    pub axes: (String, String),
    /// Divisions of the axes.
    pub scales: (Scale, Scale),
    /// True if spreads go across, false if up.
    pub across: bool,
    /// Points.
    pub dots: Vec<Dot>,
    /// Lines.
    pub lines: Vec<Line>,
}

impl Plot {
    /// The plot as an `svg` element.
    ///
    /// # Errors
    ///
    /// [`ReportError::Plot`] if there is nothing to draw, or a number is not finite.
    pub fn to_svg(&self) -> Result<String, ReportError> {
        let (x, y) = (self.range(|p| p.0, 0)?, self.range(|p| p.1, 1)?);
        let mut text = String::new();
        let marks = {
            let area = SVGBackend::with_string(&mut text, self.size).into_drawing_area();
            area.fill(&WHITE).map_err(plot_error)?;
            match (&self.scales.0, &self.scales.1) {
                (Scale::Log, Scale::Log) => self.draw_chart(area, x.log_scale().base(2.0), y.log_scale().base(2.0)),
                (Scale::Log, _) => self.draw_chart(area, x.log_scale().base(2.0), y),
                (_, Scale::Log) => self.draw_chart(area, x, y.log_scale().base(2.0)),
                (_, _) => self.draw_chart(area, x, y),
            }?
        };
        let end = text.rfind("</svg>").unwrap_or(text.len());
        text.insert_str(end, &marks);
        // Fixed sizes would keep it from fitting a narrow window.
        Ok(text.replacen("<svg ", "<svg role=\"img\" ", 1))
    }

    fn scale(&self, axis: usize) -> &Scale {
        if axis == 0 { &self.scales.0 } else { &self.scales.1 }
    }

    /// Returns the range of an axis, with a margin.
    fn range(&self, pick: impl Fn(&(f64, f64)) -> f64, axis: usize) -> Result<Range<f64>, ReportError> {
        if let Scale::Names(names) = self.scale(axis) {
            return Ok(-0.5..names.len() as f64 - 0.5);
        }
        let mut values: Vec<f64> = self.dots.iter().map(|dot| pick(&dot.at)).collect();
        values.extend(self.lines.iter().flat_map(|line| &line.points).map(&pick));
        if self.across == (axis == 0) {
            values.extend(self.dots.iter().filter_map(|dot| dot.spread).flat_map(|(a, b)| [a, b]));
        }
        if values.is_empty() || !values.iter().all(|v| v.is_finite()) {
            return Err(ReportError::Plot(
                "there are no numbers, or some are not finite".to_owned(),
            ));
        }
        // Beyond any figure that a study measures, an axis has more divisions than can be drawn.
        if let Some(vast) = values.iter().find(|v| v.abs() > LARGEST) {
            let axis = if axis == 0 { &self.axes.0 } else { &self.axes.1 };
            return Err(ReportError::Plot(format!(
                "a value of {vast:e} on the axis `{axis}` is more than any study measures ({LARGEST:e}): the record is wrong, \
                 so measure again"
            )));
        }
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Ok(match self.scale(axis) {
            Scale::Log => low.max(1e-6) / 1.25..high.max(1e-6) * 1.4,
            _ => {
                let room = ((high - low) * 0.07).max(1e-3);
                low - room..high + room
            }
        })
    }

    /// Axes into the area; points and lines as text to go on top.
    fn draw_chart<'t, X, Y>(&self, area: DrawingArea<SVGBackend<'t>, Shift>, x: X, y: Y) -> Result<String, ReportError>
    where
        X: AsRangedCoord<Value = f64>,
        Y: AsRangedCoord<Value = f64>,
        X::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
        Y::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
    {
        let left = match &self.scales.1 {
            Scale::Names(names) => 20 + 7 * names.iter().map(|n| n.chars().count()).max().unwrap_or(0) as u32,
            _ => 56,
        };
        let mut chart = ChartBuilder::on(&area)
            .margin(10)
            .margin_right(if self.lines.iter().any(|l| l.label.is_some()) {
                150
            } else {
                16
            })
            .x_label_area_size(44)
            .y_label_area_size(left)
            .build_cartesian_2d(x, y)
            .map_err(plot_error)?;
        let named = |scale: &Scale, value: &f64| match scale {
            Scale::Names(names) if (value - value.round()).abs() < 1e-6 => {
                names.get(value.round() as usize).cloned().unwrap_or_default()
            }
            Scale::Names(_) => String::new(),
            _ => format_number(*value),
        };
        let count = |scale: &Scale| match scale {
            Scale::Names(names) => names.len() + 1,
            _ => 8,
        };
        chart
            .configure_mesh()
            .x_desc(&self.axes.0)
            .y_desc(&self.axes.1)
            .x_labels(count(&self.scales.0))
            .y_labels(count(&self.scales.1))
            .x_label_formatter(&|value| named(&self.scales.0, value))
            .y_label_formatter(&|value| named(&self.scales.1, value))
            .label_style(("sans-serif", 13).with_color(RGBColor(60, 60, 60)))
            .axis_desc_style(("sans-serif", 14))
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(228, 228, 228))
            .axis_style(RGBColor(120, 120, 120))
            .draw()
            .map_err(plot_error)?;
        let pixel = |at: (f64, f64)| chart.backend_coord(&at);
        let mut marks = String::new();
        let mut taken = Labels::default();
        for line in &self.lines {
            line.draw(&pixel, &mut marks, &mut taken);
        }
        for dot in &self.dots {
            dot.draw(&pixel, self.across, &mut marks);
            taken.cover(pixel(dot.at));
        }
        for dot in &self.dots {
            if let Some(label) = &dot.label {
                taken.place_beside(pixel(dot.at), label, self.size, &mut marks);
            }
        }
        area.present().map_err(plot_error)?;
        Ok(marks)
    }
}

/// Converts an error of plotters.
fn plot_error(error: impl std::fmt::Display) -> ReportError {
    ReportError::Plot(error.to_string())
}

/// A number in as few digits as say it.
pub fn format_number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        v if v >= 100.0 => format!("{value:.0}"),
        v if v >= 0.0995 => {
            let text = format!("{value:.2}");
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        v if v >= 0.001 => format!("{value:.4}").trim_end_matches('0').to_owned(),
        _ => format!("{value:.1e}"),
    }
}

impl Dot {
    fn draw(&self, pixel: &impl Fn((f64, f64)) -> (i32, i32), across: bool, marks: &mut String) {
        let (x, y) = pixel(self.at);
        let color = COLORS[self.color % COLORS.len()];
        if let Some((low, high)) = self.spread {
            let (a, b) = match across {
                true => (pixel((low, self.at.1)), pixel((high, self.at.1))),
                false => (pixel((self.at.0, low)), pixel((self.at.0, high))),
            };
            let _ = write!(
                marks,
                r#"<line x1="{}" y1="{}" x2="{}" y2="{}" stroke="{color}" stroke-width="2" opacity="0.45"/>"#,
                a.0, a.1, b.0, b.1
            );
        }
        let _ = write!(
            marks,
            r#"<circle cx="{x}" cy="{y}" r="4.5" fill="{color}" stroke="white"><title>{}</title></circle>"#,
            escape_xml(&self.title)
        );
    }
}

impl Line {
    fn draw(&self, pixel: &impl Fn((f64, f64)) -> (i32, i32), marks: &mut String, taken: &mut Labels) {
        let color = COLORS[self.color % COLORS.len()];
        let points: Vec<String> = self
            .points
            .iter()
            .map(|at| pixel(*at))
            .map(|(x, y)| format!("{x},{y}"))
            .collect();
        let _ = write!(
            marks,
            r#"<polyline points="{}" fill="none" stroke="{color}" stroke-width="1.5"{}/>"#,
            points.join(" "),
            if self.dashed {
                r#" stroke-dasharray="5 4" opacity="0.7""#
            } else {
                ""
            }
        );
        if let (Some(label), Some(end)) = (&self.label, self.points.last()) {
            taken.at_the_end(pixel(*end), label, color, marks);
        }
    }
}

/// Rectangles of the text drawn so far, so that no two labels cover each other.
#[derive(Default)]
struct Labels {
    taken: Vec<[i32; 4]>,
}

impl Labels {
    fn cover(&mut self, (x, y): (i32, i32)) {
        self.taken.push([x - 4, y - 4, x + 4, y + 4]);
    }

    fn is_free(&self, place: [i32; 4]) -> bool {
        self.taken
            .iter()
            .all(|t| place[2] < t[0] || place[0] > t[2] || place[3] < t[1] || place[1] > t[3])
    }

    /// To the right of a point, to its left, above or below; nowhere if all of that is taken.
    fn place_beside(&mut self, (x, y): (i32, i32), label: &str, size: (u32, u32), marks: &mut String) {
        let width = 7 * label.chars().count() as i32;
        for (left, base) in [
            (x + 8, y + 4),
            (x - 8 - width, y + 4),
            (x - width / 2, y - 9),
            (x - width / 2, y + 19),
            (x + 8, y - 9),
            (x + 8, y + 17),
        ] {
            let place = [left, base - 11, left + width, base + 3];
            if left > 0 && place[2] < size.0 as i32 && self.is_free(place) {
                self.taken.push(place);
                let _ = write!(
                    marks,
                    r#"<text x="{left}" y="{base}" font-family="sans-serif" font-size="12">{}</text>"#,
                    escape_xml(label)
                );
                return;
            }
        }
    }

    /// To the right of a line's end, moved down or up as far as it takes.
    fn at_the_end(&mut self, (x, y): (i32, i32), label: &str, color: &str, marks: &mut String) {
        let width = 7 * label.chars().count() as i32;
        for step in 0..40 {
            let base = y
                + 4
                + if step % 2 == 0 {
                    step / 2 * 7
                } else {
                    -(step + 1) / 2 * 7
                };
            let place = [x + 6, base - 10, x + 6 + width, base + 3];
            if self.is_free(place) {
                self.taken.push(place);
                let _ = write!(
                    marks,
                    r#"<text x="{}" y="{base}" font-family="sans-serif" font-size="12" fill="{color}">{}</text>"#,
                    x + 6,
                    escape_xml(label)
                );
                return;
            }
        }
    }
}

/// Text as XML wants it.
fn escape_xml(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(dots: Vec<Dot>) -> Plot {
        Plot {
            size: (400, 300),
            axes: ("time in ms".to_owned(), "PSNR in dB".to_owned()),
            scales: (Scale::Log, Scale::Linear),
            across: true,
            dots,
            lines: Vec::new(),
        }
    }

    fn dot(x: f64, y: f64) -> Dot {
        Dot {
            at: (x, y),
            spread: None,
            color: 0,
            label: Some("one & <two>".to_owned()),
            title: "t".to_owned(),
        }
    }

    #[test]
    fn points_lie_where_their_numbers_say() {
        let svg = plot(vec![dot(1.0, 30.0), dot(4.0, 40.0)]).to_svg().unwrap();
        let centre = |k: usize| -> Vec<i32> {
            let circle = svg.split("<circle ").nth(k + 1).unwrap();
            let value = |name: &str| {
                circle
                    .split(&format!("{name}=\""))
                    .nth(1)
                    .unwrap()
                    .split('"')
                    .next()
                    .unwrap()
            };
            vec![value("cx").parse().unwrap(), value("cy").parse().unwrap()]
        };
        assert!(centre(0)[0] < centre(1)[0] && centre(0)[1] > centre(1)[1], "{svg}");
        assert!(svg.contains("one &amp; &lt;two&gt;"));
    }

    #[test]
    fn nothing_and_nan_are_refused() {
        assert!(plot(Vec::new()).to_svg().is_err());
        assert!(plot(vec![dot(f64::NAN, 1.0)]).to_svg().is_err());
    }

    #[test]
    fn numbers_are_short() {
        let shown: Vec<String> = [0.0, 0.5, 2.0, 31.25, 512.0, 0.0125, 1e-6].map(format_number).to_vec();
        assert_eq!(shown, ["0", "0.5", "2", "31.25", "512", "0.0125", "1.0e-6"]);
    }

    #[test]
    fn labels_do_not_cover_each_other() {
        let mut labels = Labels::default();
        let mut marks = String::new();
        for _ in 0..3 {
            labels.place_beside((100, 100), "label", (400, 300), &mut marks);
        }
        let places = &labels.taken;
        assert!(places.len() >= 2);
        for (k, a) in places.iter().enumerate() {
            let others = Labels {
                taken: places[k + 1..].to_vec(),
            };
            assert!(others.is_free(*a));
        }
    }
}
