//! Places of errors in the kernel's source, by a source map.

use crate::Error;
use std::fmt::Write as _;
use straightline_manifest::{MappedStatement, SourceMap};

/// Adds to an error of the text or the pipeline the statements of the kernel that its lines come from:
/// `in the kernel: blur.rs:12:9, tap 3: weight * color`.
pub(crate) fn locate_error(mut error: Error, map: &SourceMap) -> Error {
    if let Error::Shader { description, .. } | Error::Pipeline { description, .. } = &mut error {
        let mut known: Vec<&MappedStatement> = Vec::new();
        for line in quoted_lines(description) {
            known.extend(map.at_line("wgsl", line).filter(|found| !known.contains(found)));
        }
        for statement in known {
            let _ = write!(description, "\nin the kernel: {}", map.describe(statement));
        }
    }
    error
}

/// Lines of the text that a message of naga quotes, by the heads of its quotations: `┌─ wgsl:12:9`.
fn quoted_lines(description: &str) -> Vec<u32> {
    let heads = description.lines().filter_map(|line| line.split_once("┌─ "));
    let line_of = |place: &str| place.trim_end().rsplit(':').nth(1)?.parse().ok();
    heads.filter_map(|(_, place)| line_of(place)).collect()
}
