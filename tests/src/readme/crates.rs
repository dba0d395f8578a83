//! Dependencies between the crates.

use std::collections::BTreeMap;
use std::path::Path;
use straightline_table::{Column, Table};

/// A row for each member of the workspace: the other members that it is built with, and those of its tests alone.
pub fn needs(files: &[&Path]) -> Result<Table, String> {
    let workspace = files.first().ok_or("the table has no workspace")?;
    let root = workspace.parent().unwrap_or(Path::new("."));
    let members = read(workspace)?;
    let members = members.get("workspace").and_then(|w| w.get("members")?.as_array());
    let mut names = BTreeMap::new();
    for member in members
        .ok_or("the workspace has no members")?
        .iter()
        .filter_map(toml::Value::as_str)
    {
        let manifest = read(&root.join(member).join("Cargo.toml"))?;
        let name = manifest.get("package").and_then(|p| p.get("name")?.as_str());
        let name = name.ok_or_else(|| format!("`{member}` has no name"))?;
        names.insert(name.to_owned(), (member.to_owned(), manifest.clone()));
    }
    let needed = |own: &str, manifest: &toml::Table, tables: &[&str]| -> String {
        let all = tables.iter().filter_map(|table| manifest.get(*table)?.as_table());
        let mut folders: Vec<&str> = all
            .flat_map(|table| table.keys())
            .filter_map(|name| Some(names.get(name)?.0.as_str()))
            // Tests that need a feature of their own crate.
            .filter(|folder| *folder != own)
            .collect();
        folders.sort_unstable();
        folders.dedup();
        folders.join(", ")
    };
    let mut rows: Vec<(usize, &str, String, String)> = names
        .values()
        .map(|(folder, manifest)| {
            let built = needed(folder, manifest, &["dependencies", "build-dependencies"]);
            let tested = needed(folder, manifest, &["dev-dependencies"]);
            let count = built.split(", ").filter(|name| !name.is_empty()).count();
            (count, folder.as_str(), built, tested)
        })
        .collect();
    rows.sort();
    let shown = |names: &str| (!names.is_empty()).then(|| names.to_owned());
    Ok(Table::of(&rows)
        .column("crate", |(_, folder, ..)| format!("`{folder}`"))
        .column(Column::from("is built with").left(), |(_, _, built, _)| shown(built))
        .column(Column::from("and tested with").left(), |(.., tested)| shown(tested))
        .finish())
}

fn read(path: &Path) -> Result<toml::Table, String> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    text.parse().map_err(|error| format!("{}: {error}", path.display()))
}
