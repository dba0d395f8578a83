//! `scenes`: the built-in scenes, and what each is for.

use crate::args::ScenesArgs;
use crate::failure::Failure;
use serde_json::json;
use straightline_testbed::scene::NAMES;

/// Prints every scene's name and purpose.
pub fn run(args: &ScenesArgs) -> Result<(), Failure> {
    if args.json {
        let scenes = NAMES.map(|(name, purpose)| json!({ "name": name, "purpose": purpose }));
        outln!("{:#}", json!({ "scenes": scenes }));
        return Ok(());
    }
    for (name, purpose) in NAMES {
        outln!("{name:<10} {purpose}");
    }
    Ok(())
}
