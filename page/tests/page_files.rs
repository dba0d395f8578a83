//! The page's files: all there, and nothing that leads out of them.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use straightline_page::{FILES, GENERATOR, Module, ModuleError, TEMPLATES, page_files};

fn text(name: &str) -> &'static str {
    let (_, bytes) = FILES.iter().find(|(known, _)| *known == name).expect(name);
    std::str::from_utf8(bytes).expect("text")
}

/// The smallest module that exports these functions.
fn module(exports: &[&str]) -> Vec<u8> {
    let mut section = vec![exports.len() as u8];
    for (index, name) in exports.iter().enumerate() {
        section.push(name.len() as u8);
        section.extend(name.as_bytes());
        section.extend([0, index as u8]);
    }
    let mut bytes = b"\0asm\x01\0\0\0".to_vec();
    // A section of the author's own before it.
    bytes.extend([0, 3, 1, b'x', 9]);
    bytes.extend([7, section.len() as u8]);
    bytes.extend(section);
    bytes
}

#[test]
fn every_static_file_is_part_of_the_page() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("static");
    let there = fs::read_dir(folder).expect("the folder").map(|entry| {
        let entry = entry.expect("an entry");
        entry.file_name().into_string().expect("a name")
    });
    let known: BTreeSet<String> = FILES.iter().map(|(name, _)| (*name).to_owned()).collect();
    assert_eq!(there.collect::<BTreeSet<String>>(), known);
}

#[test]
fn every_reference_leads_to_a_file_of_the_page() {
    let mut found = 0;
    for (name, _) in FILES {
        let text = text(name);
        // Imports, attributes and URLs alike are relative, in quotes.
        for part in text.split("\"./").skip(1) {
            let end = part.find('"').expect("an end");
            let target = &part[..end];
            assert!(
                [GENERATOR, TEMPLATES].contains(&target) || FILES.iter().any(|(known, _)| *known == target),
                "{name}: {target}"
            );
            found += 1;
        }
    }
    assert!(found > 20, "{found}");
    for (name, _) in FILES
        .iter()
        .filter(|(name, _)| name.ends_with(".js") && *name != "worker.js" && *name != "main.js")
    {
        let imported = FILES
            .iter()
            .any(|(other, _)| text(other).contains(&format!("from \"./{name}\"")));
        assert!(imported, "nothing imports {name}");
    }
}

#[test]
fn nothing_leads_out_of_the_page() {
    for (name, _) in FILES {
        for outside in ["http://", "https://", "\"//", "url(", "@import"] {
            let text = text(name).replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
            assert!(!text.contains(outside), "{name} has {outside}");
        }
    }
    assert!(
        text("index.html").contains("default-src 'none'"),
        "the browser holds it to that"
    );
}

#[test]
fn every_element_that_is_looked_up_is_there() {
    let page = text("index.html");
    let mut found = 0;
    for script in ["main.js", "code.js"] {
        for part in text(script).split("find(\"").skip(1) {
            let id = &part[..part.find('"').expect("an end")];
            assert!(page.contains(&format!("id=\"{id}\"")), "{script}: #{id}");
            found += 1;
        }
    }
    assert!(found > 30, "{found}");
}

#[test]
fn the_modules_are_part_of_the_files() {
    let whole = module(&["memory", "request", "call", "answered"]);
    let taken = Module::new(whole.clone()).expect("the page's");
    let all = page_files(taken.clone(), taken);
    assert_eq!(all.len(), FILES.len() + 2);
    assert_eq!(all[GENERATOR], whole);
    assert_eq!(all[TEMPLATES], whole);
}

#[test]
fn what_is_no_module_of_the_page_is_refused() {
    assert_eq!(Module::new(Vec::new()), Err(ModuleError::NotWasm));
    assert_eq!(Module::new(b"#!/bin/sh".to_vec()), Err(ModuleError::NotWasm));
    assert_eq!(
        Module::new(b"\0asm\x01\0\0\0".to_vec()),
        Err(ModuleError::NotThePages("memory"))
    );
    assert_eq!(
        Module::new(module(&["memory", "call"])),
        Err(ModuleError::NotThePages("request"))
    );
    let whole = module(&["memory", "request", "call", "answered"]);
    for end in 9..whole.len() {
        assert!(Module::new(whole[..end].to_vec()).is_err(), "cut at {end}");
    }
}
