//! Kernels that are called otherwise, and what they are called.

use std::path::Path;
use straightline_codegen::default_set::ENTRIES;
use straightline_codegen::{Branches, Kernel, Settings};
use straightline_kernels::prelude::{UVec2, uvec2};
use straightline_tests::renamed::{Source, WORDS};

/// Size of what they are run on.
pub const SIZE: UVec2 = uvec2(12, 10);

/// Kernels with something in every role: what is read, what is written at any place, what threads share, what engines take.
pub const ROLES: [(&str, &str); 4] = [
    (
        "reads",
        "pub struct Light { pub direction: Vec4, pub power: f32, pub table: [f32; 3] }
pub struct Camera { pub eye: Vec4, pub gain: f32, pub near: f32 }
pub struct Given { pub first: Vec4, pub second: f32 }
options! { pub struct Knobs { pub strength: f32 [0.0..=1.0] = uniform(0.5), pub steps: i32 [1..=4] = 2, pub enabled: bool = true } }
pub fn reads(cfg: &Knobs, camera: &Camera, color: &Frame<Vec4>, image: &Texture<Vec4>, shadow: &DepthTexture, linear: &Sampler, less: \
     &ComparisonSampler, lights: &Buffer<Light>, weights: &Buffer<f32>, flag: bool, curve: [f32; 3], turn: Mat2, pixel: IVec2) -> Given {
    let uv = (pixel.as_vec2() + 0.5) / image.size().as_vec2();
    let mut sum = color.load(pixel) * camera.gain + camera.eye * camera.near;
    for step in 0..cfg.steps {
        let light = lights.load(step as usize);
        sum += light.direction * light.power * light.table[1] * cfg.strength * weights.load((step as usize) % weights.len());
    }
    let lit = shadow.compare(less, uv, 0.5) + image.sample(linear, turn * uv).x;
    let kept = if flag && cfg.enabled { sum + curve[0] * curve[2] } else { sum * curve[1] };
    Given { first: kept + image.load(pixel / 2) * (pixel.x / 3) as f32, second: lit.cbrt() }
}
",
    ),
    (
        "writes",
        "pub fn writes(color: &Frame<Vec4>, bins: &AtomicBuffer<u32>, kept: &StorageBuffer<f32>, painted: &StorageTexture<Vec4>, gain: f32, pixel: IVec2) -> \
     Vec4 {
    let texel = color.load(pixel) * gain;
    bins.add((pixel.x % 3) as usize, 1u32);
    kept.store((pixel.x + pixel.y * 12) as usize, texel.x);
    painted.store(pixel, texel * 2.0);
    texel
}
",
    ),
    (
        "shares",
        "pub fn shares(color: &Frame<Vec4>, cells: &Shared<[f32; 64]>, gain: f32, group: &Workgroup<64, 1>) -> PerThread<Vec4> {
    group.each(|thread| cells.store(thread.index, color.load(thread.pixel).x * gain));
    group.each(|thread| Vec4::splat(cells.load(63 - thread.index)))
}
",
    ),
    (
        "filters",
        "options! { pub struct Knobs { pub strength: f32 [0.0..=1.0] = uniform(0.5), pub reach: f32 [0.0..=4.0] = uniform(1.0) } }
pub fn filters(cfg: &Knobs, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = color.load(pixel) * cfg.reach;
    for step in -1..=1 { sum += color.load(pixel + ivec2(step, 0)) * cfg.strength; }
    sum
}
",
    ),
];

/// Source of a kernel with names in each of [`ROLES`].
pub fn roles(name: &str, text: &str) -> Source {
    Source {
        texts: vec![text.to_owned()],
        function: name.to_owned(),
        settings: Settings::default(),
    }
}

/// Every kernel of `shaders-out/` and of the gallery.
pub fn sources() -> Vec<(String, Source)> {
    let mut all = Vec::new();
    for entry in ENTRIES {
        let kernel = Kernel::builtin(entry.kernel).unwrap_or_else(|e| panic!("{e}"));
        let mut texts: Vec<String> = kernel.files().iter().map(|file| file.text.clone()).collect();
        // The kernel's own file first.
        let own = texts
            .iter()
            .position(|text| text.contains(&format!("pub fn {}(", entry.kernel)));
        texts.swap(0, own.expect("the kernel's file"));
        let options = entry.options.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned()));
        let settings = Settings::new()
            .set_all(options)
            .unroll(entry.unroll)
            .transport(entry.transport);
        let function = entry.kernel.to_owned();
        all.push((
            entry.stem.to_owned(),
            Source {
                texts,
                function,
                settings,
            },
        ));
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/gallery");
    let found = std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut files: Vec<_> = found.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "rs"));
    files.sort();
    for path in files {
        let kernel = Kernel::from_file(&path, None).unwrap_or_else(|e| panic!("{e}"));
        let source = |branches: Branches| Source {
            texts: vec![kernel.files()[0].text.clone()],
            function: kernel.name().to_owned(),
            settings: Settings::new().branches(branches),
        };
        // Some need a branch in the shader.
        let selected = source(Branches::Select);
        let source = match selected.compile() {
            Ok(_) => selected,
            Err(_) => source(Branches::Keep),
        };
        all.push((kernel.name().to_owned(), source));
    }
    all
}

/// Names without end: words of languages, names that are made of those given before, and letters.
pub struct Words {
    state: u64,
    given: Vec<String>,
}

impl Words {
    /// From a seed.
    pub fn new(seed: u64) -> Words {
        Words {
            state: seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x2545_f491_4f6c_dd1d,
            given: Vec::new(),
        }
    }

    /// The words of languages in order, again and again, from one on.
    pub fn listed(self) -> impl Iterator<Item = String> {
        WORDS.iter().map(|word| (*word).to_owned()).cycle()
    }

    fn below(&mut self, n: usize) -> usize {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 7;
        self.state ^= self.state << 17;
        (self.state >> 33) as usize % n
    }

    fn letters(&mut self) -> String {
        const LETTERS: [&str; 16] = [
            "a", "b", "e", "_", "x", "Z", "0", "9", "é", "ü", "λ", "я", "名", "__", "gl", "n",
        ];
        let first = ["a", "_", "Q", "é", "ж", "字"][self.below(6)];
        let length = [2, 3, 5, 9, 40, 300][self.below(6)];
        let rest: String = (0..length).map(|_| LETTERS[self.below(LETTERS.len())]).collect();
        format!("{first}{rest}")
    }
}

impl Iterator for Words {
    type Item = String;

    fn next(&mut self) -> Option<String> {
        let name = match self.below(8) {
            0..4 => WORDS[self.below(WORDS.len())].to_owned(),
            4 | 5 if !self.given.is_empty() => {
                let of = self.below(self.given.len());
                let other = self.below(self.given.len());
                let (of, other) = (self.given[of].clone(), self.given[other].clone());
                match self.below(12) {
                    0 => format!("{of}_"),
                    1 => format!("_{of}"),
                    2 => format!("size_of_{of}"),
                    3 => format!("{of}_{other}"),
                    4 => format!("{of}_buffer"),
                    5 => format!("{of}Sampler"),
                    6 => of.to_uppercase(),
                    7 => format!("load_{of}"),
                    8 => format!("{of}_2"),
                    9 => format!("{of}_kernel"),
                    10 => format!("set_{of}"),
                    _ => format!("{of}_texels"),
                }
            }
            _ => self.letters(),
        };
        self.given.push(name.clone());
        Some(name)
    }
}
