//! Random chains of passes, compared with what rustc makes of them.

use super::Rustc;
use crate::random::Random;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::process::Command;
use straightline_bench::execute::{Inputs, interpret_chain};
use straightline_codegen::chain::{Chain, ChainSpec, Fuse};
use straightline_codegen::{Format, ShaderSpec, Unroll};
use straightline_kernels::prelude::{Frame, UVec2, Vec4, uvec2};

/// Sizes of the frames that chains run on.
const SIZES: [UVec2; 5] = [uvec2(1, 1), uvec2(5, 3), uvec2(8, 8), uvec2(1, 7), uvec2(18, 17)];

/// Value of the uniform.
const STRENGTH: f32 = 0.625;

/// Functions that the passes of random chains call.
const LIBRARY: &str = "
fn tap(from: &Texture<Vec4>, at: IVec2, radius: i32) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for x in -radius..=radius {
        sum += from.load(at + ivec2(x, -x)) * 0.25;
    }
    sum
}

fn place(pixel: IVec2, size: UVec2) -> Vec2 {
    (pixel.as_vec2() + 0.5) / size.as_vec2()
}

fn softened(from: &Texture<Vec4>, gain: f32) -> Texture<Vec4> {
    let rows: Texture<Vec4> = draw(from.size(), |p| from.load(p) * gain - from.load(p + ivec2(1, 0)));
    rows
}
";

/// A chain that is being written.
struct Maker {
    random: Random,
    text: String,
    /// Variables that hold pictures.
    pictures: Vec<String>,
    count: usize,
}

/// Returns the text of the chain `chain` of a seed.
pub fn make_chain(seed: u64) -> String {
    let mut maker = Maker {
        random: Random(seed),
        text: String::new(),
        pictures: vec!["color".to_owned()],
        count: 0,
    };
    for _ in 0..maker.random.between(2, 5) {
        maker.statement();
    }
    let size = maker.size();
    let body = maker.body();
    let text = &maker.text;
    format!(
        "{LIBRARY}\npub fn chain(color: &Texture<Vec4>, linear: &Sampler, strength: f32) -> Texture<Vec4> {{\n{text}    \
         draw({size}, |pixel| {body})\n}}\n"
    )
}

impl Maker {
    fn statement(&mut self) {
        match self.random.below(7) {
            0..=2 => self.draw(),
            3 => self.repeat(),
            4 => self.choose(),
            5 => {
                let (name, from) = (self.name(), self.picture());
                let _ = writeln!(self.text, "    let {name} = softened(&{from}, strength + 0.5);");
                self.pictures.push(name);
            }
            _ => self.list(),
        }
    }

    fn name(&mut self) -> String {
        self.count += 1;
        format!("p{}", self.count)
    }

    /// A picture, as an expression of type `Texture` or a reference to one.
    fn picture(&mut self) -> String {
        let picture = self.random.pick(&self.pictures);
        // The input is a reference already, which rustc takes as well.
        picture
    }

    fn size(&mut self) -> String {
        let of = self.picture();
        match self.random.below(8) {
            0..=2 => format!("{of}.size()"),
            3 => format!("{of}.size() / 2"),
            4 => format!("({of}.size() + 1) / 3"),
            5 => format!("({of}.size() * 2).min(UVec2::splat(12))"),
            6 => format!("uvec2({of}.size().x, 2)"),
            _ => "uvec2(4, 3)".to_owned(),
        }
    }

    /// A texel of a picture.
    fn texel(&mut self) -> String {
        let of = self.picture();
        let (x, y) = (self.random.between(-2, 2), self.random.between(-2, 2));
        match self.random.below(7) {
            0 | 1 => format!("{of}.load(pixel)"),
            2 => format!("{of}.load(pixel + ivec2({x}, {y}))"),
            3 => format!("{of}.load(pixel * 2)"),
            4 => format!("{of}.load(pixel / 2 - ivec2({x}, {y}))"),
            5 => format!("tap(&{of}, pixel, {})", self.random.between(0, 2)),
            _ => format!("{of}.sample(linear, place(pixel, {of}.size()))"),
        }
    }

    fn body(&mut self) -> String {
        let (a, b) = (self.texel(), self.texel());
        match self.random.below(6) {
            0 => a,
            1 => format!("{a} * strength + {b}"),
            2 => format!("{a} - {b}"),
            3 => format!("{a}.max({b} * 0.5)"),
            4 => format!("({a} + {b}) * 0.75"),
            _ => format!("if pixel.x > 1 {{ {a} }} else {{ {b} }}"),
        }
    }

    fn draw(&mut self) {
        let (name, size, body) = (self.name(), self.size(), self.body());
        let _ = writeln!(
            self.text,
            "    let {name}: Texture<Vec4> = draw({size}, |pixel| {body});"
        );
        self.pictures.push(name);
    }

    /// A picture that a loop draws again and again.
    fn repeat(&mut self) {
        let (name, size, first) = (self.name(), self.size(), self.body());
        let (body, times) = (self.body(), self.random.between(1, 3));
        let _ = writeln!(
            self.text,
            "    let mut {name}: Texture<Vec4> = draw({size}, |pixel| {first});"
        );
        let _ = writeln!(self.text, "    for k in 0..{times} {{");
        let _ = writeln!(self.text, "        let weight = strength / (k + 1) as f32;");
        let own = format!("{name}.load(pixel + ivec2(k, 1)) * weight + {body}");
        let _ = writeln!(
            self.text,
            "        {name} = draw({name}.size(), |pixel| {own});\n    }}"
        );
        self.pictures.push(name);
    }

    /// A picture of one of two kinds.
    fn choose(&mut self) {
        let (name, holds) = (self.name(), self.random.once_in(2));
        let [a, b] = [(); 2].map(|()| {
            let (size, body) = (self.size(), self.body());
            format!("draw({size}, |pixel| {body})")
        });
        let condition = if holds { "1 + 1 == 2" } else { "3 < 2" };
        let _ = writeln!(
            self.text,
            "    let {name}: Texture<Vec4> = if {condition} {{ {a} }} else {{ {b} }};"
        );
        self.pictures.push(name);
    }

    /// A list of smaller and smaller pictures, whose last one stays.
    fn list(&mut self) {
        let (name, size, first) = (self.name(), self.size(), self.body());
        let times = self.random.between(1, 3);
        let _ = writeln!(
            self.text,
            "    let {name}_0: Texture<Vec4> = draw({size}, |pixel| {first});"
        );
        let _ = writeln!(self.text, "    let mut list = vec![{name}_0];");
        let _ = writeln!(self.text, "    for k in 0..{times} {{");
        let body = "list[k].load(pixel * 2) + list[0].load(pixel) * strength";
        let _ = writeln!(
            self.text,
            "        let next: Texture<Vec4> = draw(list[k].size() / 2, |pixel| {body});\n        list.push(next);\n    }}"
        );
        let _ = writeln!(self.text, "    let {name} = list.pop().unwrap();");
        self.pictures.push(name);
    }
}

/// Texels of a frame: hashed coordinates, so that the program of rustc and this one have the same.
fn texel(k: u32) -> Vec4 {
    let each =
        |c: u32| (k.wrapping_mul(2_654_435_761).wrapping_add(c.wrapping_mul(40_503)) >> 20) as f32 / 1024.0 - 1.0;
    Vec4::new(each(1), each(2), each(3), each(4))
}

/// Text of [`texel`], of the hash and of the loop over sizes, in the program of rustc.
const HARNESS: &str = "
fn texel(k: u32) -> Vec4 {
    let each = |c: u32| (k.wrapping_mul(2_654_435_761).wrapping_add(c.wrapping_mul(40_503)) >> 20) as f32 / 1024.0 - 1.0;
    Vec4::new(each(1), each(2), each(3), each(4))
}

fn show(name: usize, size: UVec2, chain: impl Fn(&Texture<Vec4>, &Sampler, f32) -> Texture<Vec4>) {
    let color = Texture::new(size, (0..size.x * size.y).map(texel).collect());
    let made = chain(&color, &Sampler::default(), 0.625);
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for bits in made.texels().iter().flat_map(|texel| texel.to_array()) {
        hash = (hash ^ u64::from(bits.to_bits())).wrapping_mul(0x100_0000_01b3);
    }
    println!(\"{name} {} {} {hash:016x}\", made.size().x, made.size().y);
}
";

/// What a chain computes on one size, as a line of the program of rustc.
fn line(name: usize, size: UVec2, texels: impl Iterator<Item = f32>) -> String {
    let hash = texels.fold(0xcbf2_9ce4_8422_2325_u64, |hash, value| {
        (hash ^ u64::from(value.to_bits())).wrapping_mul(0x100_0000_01b3)
    });
    format!("{name} {} {} {hash:016x}", size.x, size.y)
}

/// Number of chains that were compared, and of those in which a picture was fused.
#[derive(Clone, Copy, Debug, Default)]
pub struct ChainTally {
    /// Chains compared.
    pub compared: usize,
    /// Chains of which a picture was computed where it is read.
    pub fused: usize,
    /// Chains of which workgroups computed several pictures.
    pub shared: usize,
}

/// Compares the chains of seeds with the program of rustc: stored, fused and looped, bit for bit.
///
/// # Errors
///
/// The first difference or refusal, with the chain.
pub fn compare_chains(rustc: &Rustc, seeds: std::ops::Range<u64>) -> Result<ChainTally, String> {
    let texts: Vec<String> = seeds.map(make_chain).collect();
    let mut source = "#![allow(unused)]\nuse straightline_kernels::prelude::*;\n".to_owned() + HARNESS;
    for (k, text) in texts.iter().enumerate() {
        let _ = writeln!(source, "mod c{k} {{ use straightline_kernels::prelude::*;\n{text}\n}}");
    }
    source += "fn main() {\n";
    for k in 0..texts.len() {
        for size in SIZES {
            let _ = writeln!(source, "show({k}, uvec2({}, {}), c{k}::chain);", size.x, size.y);
        }
    }
    source += "}\n";
    let program = rustc.compile(&source, &["--crate-type=bin"])?;
    let output = Command::new(&program).output().map_err(|e| e.to_string())?;
    let _ = std::fs::remove_file(&program);
    let expected = String::from_utf8_lossy(&output.stdout).into_owned();
    let mut expected = expected.lines();
    let mut tally = ChainTally::default();
    for (k, text) in texts.iter().enumerate() {
        let lines: Vec<&str> = expected.by_ref().take(SIZES.len()).collect();
        let [fused, shared] = compare_chain(k, text, &lines).map_err(|why| format!("{text}\n{why}"))?;
        tally.fused += usize::from(fused);
        tally.shared += usize::from(shared);
        tally.compared += 1;
    }
    Ok(tally)
}

/// Compares one chain; returns whether a picture of it was fused, and one shared.
fn compare_chain(k: usize, text: &str, expected: &[&str]) -> Result<[bool; 2], String> {
    let shader = || ShaderSpec::new().format(Format::Rgba32Float);
    let exact = |shader: ShaderSpec| ChainSpec::from(shader).pictures(Format::Rgba32Float);
    let specs = [
        exact(shader()),
        exact(shader()).fuse(Fuse::All),
        exact(shader()).fuse(Fuse::Auto),
        exact(shader()).fuse(Fuse::Share),
        exact(shader().unroll(Unroll::None)),
    ];
    let chain = Chain::from_text("chain.rs", text, "chain");
    let all = chain.compile(&specs[1]).map_err(|errors| errors.render(false))?.fused;
    let some: BTreeSet<String> = all.into_iter().step_by(2).collect();
    let named = exact(shader()).fuse(Fuse::inline(some.clone()));
    let (mut fused, mut shared) = (false, false);
    for spec in specs.iter().chain((!some.is_empty()).then_some(&named)) {
        let compiled = chain.compile(spec).map_err(|errors| errors.render(false))?;
        fused |= !compiled.fused.is_empty();
        shared |= !compiled.shared.is_empty();
        for (size, expected) in SIZES.iter().zip(expected) {
            let color = Frame::new(*size, (0..size.x * size.y).map(texel).collect());
            let inputs = Inputs::new(*size)
                .with_image("color", color)
                .with_uniform("strength", &[f64::from(STRENGTH)]);
            let found = interpret_chain::<f32>(&compiled, &inputs).map_err(|e| e.to_string())?;
            let texels = found[0].texels.iter().flatten().map(|value| *value as f32);
            let found = line(k, found[0].size, texels);
            if found != **expected {
                return Err(format!("at {size}, fused {}: {found} for {expected}", spec.fuse));
            }
        }
    }
    Ok([fused, shared])
}
