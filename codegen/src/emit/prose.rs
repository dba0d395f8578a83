//! Documentation of kernels in comments. Only this module makes it safe to print.

/// A text as one line that ends no comment and starts none, in any language that templates write.
///
/// | in the text | in the line | because of |
/// | --- | --- | --- |
/// | line ends of any kind, control characters | one space | a `//` or `#` comment ends there: U+0085, U+2028 and U+2029 too in WGSL and JavaScript |
/// | marks of writing direction, byte order marks | nothing | a reader would see another text than the compiler; rustc refuses them |
/// | `*/`, `/*` | `* /`, `/ *` | comments of C, JavaScript and C#, which nest in Rust and WGSL |
/// | `\` | `/` | at the end of a line, the next one would be part of the comment in C, GLSL and HLSL |
/// | `??/` | `?? /` | the trigraph of `\` in C |
pub fn single_line_comment(text: &str) -> String {
    let harmless = text.chars().filter(|c| !is_invisible(*c)).map(|c| match c {
        '\\' => '/',
        c if c.is_control() => ' ',
        c => c,
    });
    let harmless: String = harmless.collect();
    let mut line = String::with_capacity(harmless.len());
    for word in harmless.split_whitespace() {
        if !line.is_empty() {
            line.push(' ');
        }
        for c in word.chars() {
            let opens_or_ends = matches!((line.chars().next_back(), c), (Some('*'), '/') | (Some('/'), '*'));
            if opens_or_ends || (c == '/' && line.ends_with("??")) {
                line.push(' ');
            }
            line.push(c);
        }
    }
    line
}

/// Returns whether a character is an invisible mark of writing direction or byte order.
fn is_invisible(c: char) -> bool {
    matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{61c}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_is_one_line_that_nothing_ends() {
        for (text, line) in [
            ("Blurs.", "Blurs."),
            (
                "a\nb\r\nc\u{2028}d\u{2029}e\u{85}f\u{b}g\u{c}h\u{0}i",
                "a b c d e f g h i",
            ),
            ("from dark*/bright /* nested", "from dark* /bright / * nested"),
            ("/*/ **/", "/ * / ** /"),
            ("C:\\new\\", "C:/new/"),
            ("ends *\\", "ends * /"),
            ("ends \\\\ word\\s", "ends // word/s"),
            ("trigraph ??/", "trigraph ?? /"),
            ("\u{feff}right \u{202e}tfel", "right tfel"),
            ("", ""),
        ] {
            assert_eq!(single_line_comment(text), line, "{text:?}");
            assert_eq!(single_line_comment(line), line, "twice: {text:?}");
        }
    }
}
