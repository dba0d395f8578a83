//! `scenes`: the built-in scenes and their purpose.

use crate::args::ScenesArgs;
use crate::failure::Failure;
use serde_json::json;
use straightline_scene::scene::{FURTHER, NAMES};

/// Prints every scene's name and purpose.
pub fn print_scenes(args: &ScenesArgs) -> Result<(), Failure> {
    let all = NAMES.into_iter().chain(FURTHER);
    if args.json {
        let scenes: Vec<_> = all
            .map(|(name, purpose)| json!({ "name": name, "purpose": purpose }))
            .collect();
        outln!("{:#}", json!({ "scenes": scenes }));
        return Ok(());
    }
    for (name, purpose) in all {
        outln!("{name:<10} {purpose}");
    }
    Ok(())
}
