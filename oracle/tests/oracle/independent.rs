//! Independence of the judges: neither this crate nor any of its dependencies evaluates, emits or runs kernels.

use cargo_metadata::{CargoOpt, DependencyKind, MetadataCommand};
use std::collections::BTreeSet;

/// Crates that evaluate, emit or run kernels.
const JUDGED: [&str; 4] = [
    "straightline-bench",
    "straightline-codegen",
    "straightline-evaluator",
    "straightline-runtime",
];

#[test]
fn the_oracle_depends_on_no_code_that_it_judges() {
    let metadata = MetadataCommand::new()
        .manifest_path(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml"))
        .features(CargoOpt::AllFeatures)
        .other_options(["--locked", "--filter-platform", "x86_64-unknown-linux-gnu"].map(str::to_owned))
        .exec()
        .expect("the workspace's metadata");
    let nodes = metadata.resolve.as_ref().expect("a resolved graph").nodes.iter();
    let root = metadata
        .packages
        .iter()
        .find(|package| package.name == "straightline-oracle");
    let mut ahead = vec![&root.expect("this crate").id];
    let mut met = BTreeSet::new();
    while let Some(id) = ahead.pop() {
        let name = metadata[id].name.as_str();
        if met.insert(name) {
            let node = nodes
                .clone()
                .find(|node| node.id == *id)
                .expect("a node for each package");
            let normal = node.deps.iter().filter(|dependency| {
                let mut kinds = dependency.dep_kinds.iter();
                kinds.any(|kind| kind.kind != DependencyKind::Development)
            });
            ahead.extend(normal.map(|dependency| &dependency.pkg));
        }
    }
    assert!(met.contains("straightline-scene"), "{met:?}");
    for judged in JUDGED {
        assert!(
            metadata.packages.iter().any(|package| package.name == judged),
            "{judged} is no crate"
        );
        assert!(!met.contains(judged), "straightline-oracle depends on {judged}");
    }
}
