//! Results of tests in the XML of JUnit, as build servers read it.

use super::print::rendered;
use super::{Done, End};
use std::fmt::Write;
use std::time::Duration;
use straightline_codegen::testing::TestFile;

/// Returns the document: one suite, one element a test.
pub fn results_xml(shown: &str, file: &TestFile, all: &[Done<'_>], time: Duration) -> String {
    let failed = all.iter().filter(|done| done.has_failed()).count();
    let skipped = all.iter().filter(|done| matches!(done.end, End::Ignored)).count();
    let (name, seconds) = (escaped(shown), time.as_secs_f64());
    let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
    let _ = writeln!(
        text,
        "<testsuite name=\"{name}\" tests=\"{}\" failures=\"{failed}\" skipped=\"{skipped}\" time=\"{seconds:.3}\">",
        all.len()
    );
    let path = file.files.first().map_or("", |file| file.path.as_str());
    for done in all {
        let _ = write!(
            text,
            "  <testcase classname=\"{name}\" name=\"{}\" file=\"{}\" line=\"{}\" time=\"{:.3}\"",
            escaped(&done.test.path),
            escaped(path),
            done.test.span.line,
            done.time.as_secs_f64()
        );
        let _ = match (&done.end, done.errors()) {
            (End::Ignored, _) => writeln!(text, "><skipped/></testcase>"),
            (_, Some(errors)) => writeln!(
                text,
                ">\n    <failure message=\"{}\">{}</failure>\n  </testcase>",
                escaped(errors.first_message()),
                escaped(&rendered(errors, false))
            ),
            _ => writeln!(text, "/>"),
        };
    }
    text + "</testsuite>\n"
}

/// Text for an attribute or an element.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\n' | '\t' => out.push(c),
            // XML has no other control characters.
            c if c.is_control() => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn texts_are_escaped() {
        assert_eq!(
            escaped("a < \"b\" && c\u{1b}"),
            "a &lt; &quot;b&quot; &amp;&amp; c\u{fffd}"
        );
    }
}
