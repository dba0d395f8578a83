use straightline_codegen::ir::interp::{Bindings, Image, Interpreter};
use straightline_codegen::*;
use straightline_codegen::emit::Target;

fn go(name: &str, text: &str) {
    println!("==== {name}");
    let mut first: Option<[f32; 4]> = None;
    for (unroll, branches) in [(Unroll::Full, Branches::AsLoops), (Unroll::Full, Branches::Keep), (Unroll::None, Branches::AsLoops), (Unroll::None, Branches::Select), (Unroll::Partial(2), Branches::AsLoops)] {
        let settings = Settings { unroll, branches, ..Settings::default() };
        let c = match Kernel::from_text("k.rs", text, "k").compile(&settings) { Ok(c) => c, Err(e) => { println!("{unroll} REFUSED {}", e.render(false)); continue; } };
        let image = Image::new([2, 1], vec![vec![[0.25, 0.5, 3.0, 4.0]; 2]]).unwrap();
        let b = Bindings::new().texture("color", &image).uniform("n", &[5.0]);
        let i = Interpreter::new(&c.graph, &c.schedule, [2, 1], &b).unwrap();
        let v = i.pixel(0, 0, &mut i.scratch());
        let same = match first { None => { first = Some(v); true } Some(f) => f.map(f32::to_bits) == v.map(f32::to_bits) };
        println!("{unroll} {branches:?}: {v:?} {}", if same { "" } else { "DIFFERS" });
        for l in &c.loops { println!("   {} {} {:?}", l.path(), l.unroll, l.reason); }
        match c.emit(&EmitOptions::new().targets(Target::ALL)) {
            Err(e) => println!("EMIT {e}"),
            Ok(e) => if unroll == Unroll::None && branches == Branches::AsLoops || (branches == Branches::Keep && std::env::var_os("KEEP").is_some()) {
                let t = String::from_utf8(e.files[&Target::Wgsl].to_vec()).unwrap();
                let a = t.find("@compute").unwrap_or(0);
                println!("{}", &t[a..]);
            }
        }
    }
}

#[test]
fn all() {
    let only = std::env::var("ONLY").ok();
    for path in std::fs::read_dir("/tmp/kernels").unwrap().map(|e| e.unwrap().path()) {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        if only.as_ref().is_some_and(|o| !name.contains(o.as_str())) { continue; }
        go(&name, &std::fs::read_to_string(&path).unwrap());
    }
}
