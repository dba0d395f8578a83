//! probe
use straightline_codegen::*;
use straightline_manifest::*;
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let mut settings = Settings::default();
    let mut targets = std::collections::BTreeSet::new();
    let mut stage = Stage::Compute;
    for a in &args { 
        if a == "none" { settings.unroll = Unroll::None; continue; }
        if a == "fragment" { stage = Stage::Fragment; continue; }
        if let Ok(t) = a.parse() { targets.insert(t); continue; }
        let (k, v) = a.split_once('=').unwrap(); settings.options.push((k.into(), v.into())); }
    let c = Kernel::builtin("sraa").unwrap().compile(&settings).unwrap();
    match c.emit(stage, Format::Rgba16Float, &targets) {
        Ok(e) => for (t, f) in e.files { println!("=== {t} {}", f.len()); if t != emit::Target::Spirv { println!("{}", String::from_utf8(f).unwrap()); } },
        Err(e) => println!("{e}"),
    }
}
