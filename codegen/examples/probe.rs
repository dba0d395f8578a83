use straightline_codegen::*;
fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let mut settings = Settings::default();
    let mut print = false;
    for a in &args { 
        if a == "-p" { print = true; continue; }
        if a == "none" { settings.unroll = Unroll::None; continue; }
        let (k, v) = a.split_once('=').unwrap(); settings.options.push((k.into(), v.into())); }
    let t = std::time::Instant::now();
    match Kernel::builtin("sraa").unwrap().compile(&settings) {
        Ok(c) => { if print { println!("{}", ir::print(&c.graph)); } println!("{:?} {:?} nodes {}", t.elapsed(), c.counts, c.graph.nodes.len()); }
        Err(e) => println!("{e}"),
    }
}
