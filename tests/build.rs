//! Turns the examples in the language documentation into modules, so that rustc compiles them.

use std::fmt::Write;
use std::path::Path;

fn main() {
    let mut text = String::new();
    for page in ["kernel-language.md", "semantics.md"] {
        let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs").join(page);
        println!("cargo::rerun-if-changed={}", page.display());
        text += &std::fs::read_to_string(&page).expect("a page of docs/");
    }
    let mut modules = String::new();
    let mut table = String::from("pub const EXAMPLES: &[Example] = &[\n");
    for source in blocks(&text) {
        let (module, example) = example(&source);
        modules += &module;
        let _ = writeln!(table, "    {example},");
    }
    table += "];\n";
    modules += "pub mod features {\n";
    table += "pub const FEATURES: &[(&str, Example)] = &[\n";
    for (title, source) in features() {
        let (module, example) = example(&source);
        modules += &module;
        let _ = writeln!(
            table,
            "    ({title:?}, {}),",
            example.replace("native: ", "native: features::")
        );
    }
    modules += "}\n";
    table += "];\n";
    let out = Path::new(&std::env::var_os("OUT_DIR").expect("set by cargo")).join("examples.rs");
    std::fs::write(out, modules + &table).expect("the build folder can be written");
}

/// Returns the module of an example, and its entry in a table.
fn example(source: &str) -> (String, String) {
    let file = syn::parse_file(source).unwrap_or_else(|e| panic!("an example is not Rust: {e}\n{source}"));
    let kernel = file.items.iter().find_map(|item| match item {
        syn::Item::Fn(f) if matches!(f.vis, syn::Visibility::Public(_)) => Some(f),
        _ => None,
    });
    let kernel = kernel.unwrap_or_else(|| panic!("an example has no `pub fn`:\n{source}"));
    let name = &kernel.sig.ident;
    let arguments: Vec<String> = kernel.sig.inputs.iter().map(argument).collect();
    let module = format!(
        "pub mod {name} {{\n#![allow(dead_code, unused, unsafe_code, static_mut_refs, clippy::all)]\nuse straightline_kernels::prelude::*;\n{source}\n\
         pub fn native(w: &crate::language::World, at: IVec2) -> Vec<[f64; 4]> {{ let given = {name}({}); {} }}\n}}\n",
        arguments.join(", "),
        texels(&file, &kernel.sig.output)
    );
    let example = format!("Example {{ name: \"{name}\", source: {source:?}, native: {name}::native }}");
    (module, example)
}

/// Returns the constructs of `features/` by their titles.
fn features() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("features");
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut found = Vec::new();
    // In the order of the page.
    for name in [
        "control",
        "patterns",
        "closures",
        "lazy",
        "values",
        "numbers",
        "indices",
        "slices",
        "items",
        "overloads",
        "instances",
        "constants",
        "orders",
        "names",
        "authors",
        "ports",
        "shading",
        "noises",
        "refused",
    ] {
        let path = folder.join(format!("{name}.rs"));
        println!("cargo::rerun-if-changed={}", path.display());
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        for part in text.split("//// ").skip(1) {
            let (title, source) = part.split_once('\n').expect("a title has a line of its own");
            found.push((title.to_owned(), source.to_owned()));
        }
    }
    found
}

/// Returns the text of every block marked as Rust.
fn blocks(page: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut open: Option<String> = None;
    for line in page.lines() {
        match &mut open {
            None if line == "```rust" => open = Some(String::new()),
            Some(_) if line == "```" => found.extend(open.take()),
            Some(block) => *block += &format!("{line}\n"),
            None => {}
        }
    }
    found
}

/// Returns code that converts a kernel's result to texels: one for each field of a structure, or one for a single value.
fn texels(file: &syn::File, output: &syn::ReturnType) -> String {
    let texel = |value: &str| format!("crate::language::Texel::texel(&{value})");
    let syn::ReturnType::Type(_, ty) = output else {
        panic!("a kernel gives something")
    };
    if let syn::Type::Tuple(parts) = &**ty {
        let parts: Vec<String> = (0..parts.elems.len()).map(|k| texel(&format!("given.{k}"))).collect();
        return format!("vec![{}]", parts.join(", "));
    }
    let named = match &**ty {
        syn::Type::Path(path) => path.path.get_ident(),
        _ => None,
    };
    let structure = file.items.iter().find_map(|item| match item {
        syn::Item::Struct(s) if Some(&s.ident) == named => Some(s),
        _ => None,
    });
    let Some(structure) = structure else {
        return format!("vec![{}]", texel("given"));
    };
    let fields = structure.fields.iter().filter_map(|field| field.ident.as_ref());
    let parts: Vec<String> = fields.map(|field| texel(&format!("given.{field}"))).collect();
    format!("vec![{}]", parts.join(", "))
}

/// Returns the argument for a parameter, by its name and type.
fn argument(input: &syn::FnArg) -> String {
    let syn::FnArg::Typed(typed) = input else {
        panic!("a kernel is no method")
    };
    let syn::Pat::Ident(name) = &*typed.pat else {
        panic!("a parameter has a name")
    };
    let name = name.ident.to_string();
    match (name.as_str(), &*typed.ty) {
        ("pixel", _) => "at".to_owned(),
        ("cfg", _) => "&Default::default()".to_owned(),
        ("scene", _) => "&Scene { color: &w.color, layers: &w.layers, tint: w.tint, strength: w.strength }".to_owned(),
        ("lights", _) => "&Buffer::new(w.lights.iter().map(|l| Light { position: l.xyz(), kind: l.w as u32, falloff: Falloff { radius: \
             8.0 + l.x, powers: [l.y, l.z, 0.5] }, turned: w.grade, tints: [l.yxz(), l.zzy()], spots: [Spot { place: l.xy(), strength: l.z }, Spot { place: l.zy(), strength: l.x }] \
             }).collect())"
            .to_owned(),
        (_, syn::Type::Reference(_)) => format!("&w.{name}"),
        _ => format!("w.{name}"),
    }
}
