//! Elements of an SVG text.

use std::fmt::Write;

/// Font of all texts, with fallbacks.
const FONT: &str = "Helvetica Neue, Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif";

/// Colour of texts and outlines.
pub const INK: &str = "#1a1a1a";

/// Colour of grids and remarks.
pub const GREY: &str = "#6b6b6b";

/// An SVG text under construction.
#[derive(Debug, Default)]
pub struct Svg {
    body: String,
}

/// Alignment of a text at its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
}

/// Size, weight, colour and alignment of a text.
#[derive(Clone, Copy, Debug)]
pub struct TextStyle<'a> {
    pub size: f64,
    pub bold: bool,
    pub color: &'a str,
    pub anchor: Anchor,
    /// `true` for a white rim, over lines.
    pub rim: bool,
}

impl TextStyle<'_> {
    /// A plain text that begins at its position.
    pub fn plain(size: f64) -> TextStyle<'static> {
        TextStyle {
            size,
            bold: false,
            color: INK,
            anchor: Anchor::Start,
            rim: false,
        }
    }

    /// A plain text around its position.
    pub fn centred(size: f64) -> TextStyle<'static> {
        TextStyle {
            anchor: Anchor::Middle,
            ..TextStyle::plain(size)
        }
    }
}

impl Svg {
    /// Adds a rectangle from its upper left corner; `look` holds further attributes.
    pub fn add_rect(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], look: &str) {
        let [x, y, width, height] = [x, y, width, height].map(shorten_number);
        self.add_line(&format!(
            r#"<rect x="{x}" y="{y}" width="{width}" height="{height}" {look}/>"#
        ));
    }

    /// Adds a circle.
    pub fn add_circle(&mut self, [x, y]: [f64; 2], radius: f64, look: &str) {
        let [x, y, radius] = [x, y, radius].map(shorten_number);
        self.add_line(&format!(r#"<circle cx="{x}" cy="{y}" r="{radius}" {look}/>"#));
    }

    /// Adds straight strokes from point to point.
    pub fn add_path(&mut self, strokes: &[&[[f64; 2]]], look: &str) {
        let mut d = String::new();
        for points in strokes {
            for (k, point) in points.iter().enumerate() {
                let [x, y] = point.map(shorten_number);
                let _ = write!(d, "{}{x} {y}", if k == 0 { "M" } else { "L" });
            }
        }
        self.add_line(&format!(r#"<path d="{d}" {look}/>"#));
    }

    /// Adds a text on its baseline.
    pub fn add_text(&mut self, [x, y]: [f64; 2], style: TextStyle<'_>, text: &str) {
        let [x, y, size] = [x, y, style.size].map(shorten_number);
        let anchor = match style.anchor {
            Anchor::Start => "",
            Anchor::Middle => r#" text-anchor="middle""#,
        };
        let weight = if style.bold { r#" font-weight="bold""# } else { "" };
        let color = match style.color {
            INK => String::new(),
            other => format!(r#" fill="{other}""#),
        };
        let rim = match style.rim {
            true => r##" paint-order="stroke" stroke="#ffffff" stroke-width="2.5" stroke-linejoin="round""##,
            false => "",
        };
        let text = escape_text(text);
        self.add_line(&format!(
            r#"<text x="{x}" y="{y}" font-size="{size}"{anchor}{weight}{color}{rim}>{text}</text>"#
        ));
    }

    fn add_line(&mut self, line: &str) {
        self.body.push_str(line);
        self.body.push('\n');
    }

    /// Returns the whole text, on a white ground so that it is legible on a dark page.
    pub fn finish(self, [width, height]: [f64; 2], title: &str, description: &str) -> String {
        let [width, height] = [width, height].map(|x| shorten_number(x.ceil()));
        let (title, description) = (escape_text(title), escape_text(description));
        format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img" font-family="{FONT}" fill="{INK}">
<title>{title}</title>
<desc>{description}</desc>
<rect width="{width}" height="{height}" rx="6" fill="#ffffff"/>
{}</svg>
"##,
            self.body
        )
    }
}

/// Spells a number with two decimals at most.
fn shorten_number(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Escapes a text for XML, and drops characters that XML does not have.
fn escape_text(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() || ('\u{fffe}'..='\u{ffff}').contains(&c) => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Estimates the width of a text, a little above that of the fonts.
pub fn text_width(text: &str, size: f64) -> f64 {
    let of = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' => 0.3,
        ' ' | 'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '/' | '-' => 0.37,
        'm' | 'w' | 'M' | 'W' => 0.9,
        'A'..='Z' => 0.72,
        _ => 0.58,
    };
    text.chars().map(of).sum::<f64>() * size
}

/// Breaks a text into lines of a width.
pub fn wrap_lines(text: &str, size: f64, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if text_width(line, size) + text_width(word, size) + 0.4 * size <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
