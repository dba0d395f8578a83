//! Chains of several passes for engines: those that take them, what they refuse, and names that are words of an engine.

use super::hostile::HOSTILE;
use super::{as_kept, blesses, code, readable, refusal, snapshots};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use straightline_codegen::chain::{Chain, CompiledChain};
use straightline_codegen::{OptionInfo, ShaderSpec};
use straightline_engines::{ChainRequest, Engine, EngineError, engine_names};

/// Engines that take chains.
const TAKING: [&str; 3] = ["libretro", "three", "webgpu"];

/// A chain for engines.
struct Subject {
    compiled: CompiledChain,
    options: Vec<OptionInfo>,
}

impl Subject {
    fn new(chain: &Chain, set: &[(&str, &str)]) -> Subject {
        let spec = set
            .iter()
            .fold(ShaderSpec::new(), |spec, (name, value)| spec.set(name, value));
        let compiled = chain.compile(&spec.into());
        Subject {
            compiled: compiled.unwrap_or_else(|errors| panic!("{}:\n{errors}", chain.name())),
            options: chain.options().unwrap_or_else(|errors| panic!("{errors}")),
        }
    }

    /// A chain in a file of the repository, with further files.
    fn of_file(path: &str, sources: &[&str], set: &[(&str, &str)]) -> Subject {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let text = std::fs::read_to_string(root.join(path)).unwrap_or_else(|e| panic!("{path}: {e}"));
        let name = path.rsplit('/').next().unwrap_or_default().trim_end_matches(".rs");
        let chain = Chain::from_text(path, &text, name);
        let chain = sources.iter().fold(chain, |chain, source| {
            chain
                .with_file(&root.join(source))
                .unwrap_or_else(|errors| panic!("{errors}"))
        });
        Subject::new(&chain, set)
    }

    /// A chain in a text.
    fn of_text(name: &str, text: &str) -> Subject {
        let text = format!("use straightline_kernels::prelude::*;\n{text}");
        Subject::new(&Chain::from_text("chain.rs", &text, name), &[])
    }

    fn files(&self, engine: &str, binds: &[(&str, &str)]) -> Result<BTreeMap<String, String>, EngineError> {
        let request = ChainRequest::new(&self.compiled, &self.options);
        let request = binds
            .iter()
            .fold(request, |request, (name, word)| request.bind(name, word));
        let files = Engine::find(engine)?.render_chain_files(&request)?;
        let texts = files.into_iter();
        Ok(texts
            .map(|(name, bytes)| (name, String::from_utf8(bytes).expect("text")))
            .collect())
    }

    fn refused(&self, engine: &str, binds: &[(&str, &str)]) -> String {
        match self.files(engine, binds) {
            Err(EngineError::Kernel(errors)) => refusal(&errors),
            Err(error) => panic!("{engine}: {error}"),
            Ok(files) => panic!("{engine} takes it: {:?}", files.keys()),
        }
    }
}

const GALLERY: [&str; 3] = [
    "examples/gallery/smaa_edges.rs",
    "examples/gallery/smaa_weights.rs",
    "examples/gallery/smaa_blend.rs",
];

fn subjects() -> [(&'static str, Subject); 4] {
    [
        ("bloom", Subject::of_file("examples/chains/bloom.rs", &[], &[])),
        ("smaa", Subject::of_file("examples/chains/smaa.rs", &GALLERY, &[])),
        (
            "blur",
            Subject::of_file("examples/chains/blur.rs", &[], &[("radius", "2")]),
        ),
        ("halves", Subject::of_file("tests/engines/kernels/halves.rs", &[], &[])),
    ]
}

/// Each chain on each engine: the files that are written, or why not and what would fit.
#[test]
fn every_chain_is_emitted_or_refused_by_name() {
    let mut table = String::new();
    let subjects = subjects();
    for engine in engine_names() {
        for (name, subject) in &subjects {
            let outcome = match subject.files(engine, &[]) {
                Ok(files) => files.into_keys().collect::<Vec<_>>().join(", "),
                Err(EngineError::Kernel(errors)) => refusal(&errors),
                Err(error) => panic!("{name} for {engine}: {error}"),
            };
            table += &format!("{engine}, {name}: {outcome}\n");
        }
        let takes = Engine::builtin(engine).is_some_and(|engine| engine.description().chain.is_some());
        assert_eq!(takes, TAKING.contains(&engine), "{engine}");
    }
    as_kept(&snapshots().join("fits-chains.txt"), &table);
}

/// Every shader of every pass is read by a compiler of its language, in what the engine puts around it.
#[test]
fn compilers_read_every_pass() {
    for (name, subject) in subjects() {
        let (passes, shaders) = (subject.compiled.passes.len(), subject.compiled.kernels.len());
        for engine in TAKING {
            let files = subject.files(engine, &[]).unwrap_or_else(|e| panic!("{name}: {e}"));
            let read = readable::check_chain(engine, &files).unwrap_or_else(|e| panic!("{name} for {engine}: {e}"));
            let wanted = match engine {
                "libretro" => passes,
                "three" => 2 * shaders,
                _ => shaders,
            };
            assert_eq!(read, wanted, "{name} for {engine}");
        }
    }
}

/// The folder of one small chain, engine by engine.
#[test]
fn folders_of_chains_are_as_they_were() {
    let subject = Subject::of_file("examples/chains/bloom.rs", &[], &[("levels", "1")]);
    for engine in TAKING {
        let folder = snapshots().join("chains").join(engine);
        let files = subject.files(engine, &[]).unwrap_or_else(|e| panic!("{engine}: {e}"));
        if blesses() && folder.exists() {
            std::fs::remove_dir_all(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        }
        for (name, text) in &files {
            let tags = text.contains("{{") || text.contains("{%");
            assert!(!tags, "{engine}: {name} has tags of a template");
            as_kept(&folder.join(name), text);
        }
        let kept = std::fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
        assert_eq!(kept.count(), files.len(), "{engine}: files that are not emitted");
    }
}

/// A chain of two passes, whose sizes, texels and results these are.
fn two_passes(size: &str, texel: &str, value: &str, result: &str) -> Subject {
    Subject::of_text(
        "pair",
        &format!(
            "pub fn pair(color: &Texture<Vec4>) -> Texture<Vec4> {{
                let first: Texture<{texel}> = draw({size}, |pixel| {value});
                draw({result}, |pixel| color.load(pixel) + first.load(pixel).x as f32)
            }}"
        ),
    )
}

#[test]
fn what_an_engine_cannot_run_is_refused_by_name() {
    let color = "color.load(pixel)";
    let half = || two_passes("color.size()", "Vec4", color, "color.size() / 2");
    let said = half().refused("three", &[]);
    let wanted = "[E0801] `pair` does not fit three.js: it returns `result` of size `color.size() / 2`, and three.js draws to a \
                  target of the picture's size";
    assert!(said.starts_with(wanted), "{said}");
    assert!(said.ends_with("these engines take it: webgpu"), "{said}");
    assert!(half().refused("libretro", &[]).contains("returns `result`"));

    let integers = two_passes(
        "color.size()",
        "UVec2",
        "uvec2(color.load(pixel).x as u32, 1)",
        "color.size()",
    );
    for engine in ["three", "libretro"] {
        let said = integers.refused(engine, &[]);
        assert!(said.contains("stores `first` in rg32uint, and"), "{said}");
    }

    let odd = |size: &str| two_passes(size, "Vec4", color, "color.size()");
    let said = odd("color.size() - 2").refused("libretro", &[]);
    let wanted =
        "draws `first`, of size `color.size() - 2`, and libretro takes multiples of what the pass before draws";
    assert!(
        said.contains(wanted) && said.contains("such as `color.size() / 2`"),
        "{said}"
    );
    assert!(said.contains("these engines take it: three, webgpu"), "{said}");
    // After a picture of constant size, the picture's size is lost.
    let said = odd("uvec2(16, 16)").refused("libretro", &[]);
    assert!(said.contains("draws `result`, of size `color.size()`"), "{said}");
    assert!(odd("color.size() * 3 / 2").files("libretro", &[]).is_ok());

    let late = Subject::of_text(
        "late",
        "pub fn late(color: &Texture<Vec4>) -> (Texture<Vec4>, Texture<Vec4>) {
            let first: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
            let second: Texture<Vec4> = draw(color.size(), |pixel| first.load(pixel));
            (first, second)
        }",
    );
    let said = late.refused("three", &[]);
    assert!(said.contains("it gives 2 values, and three.js takes 1"), "{said}");
    let files = late.files("webgpu", &[]).unwrap_or_else(|e| panic!("{e}"));
    assert!(files["late.js"].contains("reads: { first: { target: 0 } }, target: 1"));
    assert!(files["README.md"].contains("Later passes read it, so it needs the usage `TEXTURE_BINDING`."));

    let uniform = Subject::of_text(
        "tint",
        "pub fn tint(color: &Texture<Vec4>, shade: Vec4) -> Texture<Vec4> {
            let first: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel) * shade);
            draw(color.size(), |pixel| first.load(pixel))
        }",
    );
    let said = uniform.refused("libretro", &[]);
    assert!(
        said.contains("it has the uniform `shade` of type vec4f, and libretro takes f32"),
        "{said}"
    );
}

/// Inputs have meanings by their names in the chain, whatever the passes call them.
#[test]
fn inputs_of_chains_have_meanings() {
    let subject = Subject::of_text(
        "outer",
        "fn inner(source: &Texture<Vec4>) -> Texture<Vec4> {
            draw(source.size(), |pixel| source.load(pixel) * 0.5)
        }
        pub fn outer(before: &Texture<Vec4>, depth: &Texture<f32>) -> Texture<Vec4> {
            let half = inner(before);
            let color = inner(&half);
            draw(before.size(), |pixel| color.load(pixel) * depth.load(pixel))
        }",
    );
    let said = subject.refused("three", &[]);
    assert!(
        said.contains("reads `depth`, and three.js has no depth: only single kernels get"),
        "{said}"
    );
    let said = subject.refused("three", &[("depth", "own")]);
    assert!(said.contains("reads `before`, and its name does not say"), "{said}");
    let said = subject.refused("three", &[("source", "color")]);
    assert!(said.contains("its inputs are `before`, `depth`"), "{said}");
    let binds = [("depth", "own"), ("before", "color")];
    let files = subject.files("three", &binds).unwrap_or_else(|e| panic!("{e}"));
    let pass = &files["outer-pass.js"];
    assert!(pass.contains("if (name === \"before\") return readBuffer;"), "{pass}");
    assert!(
        pass.contains("source: this.picture,") && pass.contains("source: drawn[0],"),
        "{pass}"
    );
    assert!(pass.contains("depth: own.depth,"), "{pass}");
}

/// Words of engines, of JavaScript, of GLSL and of presets, as names of everything in a chain.
#[test]
fn names_of_chains_may_be_words_of_engines() {
    const WORDS: [&str; 18] = [
        "Source",
        "Original",
        "PassOutput0",
        "push",
        "global",
        "shaders",
        "textures",
        "parameters",
        "alias0",
        "scale_x0",
        "TEXTURES",
        "THREE",
        "default",
        "constructor",
        "texture",
        "sampler2D",
        "DRAWN_SIZE",
        "__proto__",
    ];
    for (k, word) in WORDS.iter().enumerate() {
        let [table, amount, picture] = [7, 11, 13].map(|step| WORDS[(k + step) % WORDS.len()]);
        let text = format!(
            "pub fn {word}(color: &Texture<Vec4>, {table}: &Texture<Vec4>, linear: &Sampler, {amount}: f32) -> Texture<Vec4> {{
                let {picture}: Texture<Vec4> = draw(color.size(), |pixel| {{
                    color.load(pixel) * {table}.sample(linear, vec2(0.5, 0.5)) * {amount}
                }});
                draw(color.size(), |pixel| {picture}.sample(linear, vec2(0.25, 0.5)) + color.load(pixel) * {amount})
            }}"
        );
        let subject = Subject::of_text(word, &text);
        for engine in TAKING {
            let files = subject.files(engine, &[(table, "own")]);
            let files = files.unwrap_or_else(|e| panic!("{engine}:\n{text}\n{e}"));
            readable::check_chain(engine, &files).unwrap_or_else(|e| panic!("{engine}:\n{text}\n{e}"));
            if let Some((_, preset)) = files.iter().find(|(name, _)| name.ends_with(".slangp")) {
                let keys = preset
                    .lines()
                    .filter_map(|line| line.split_once(" = "))
                    .map(|(key, _)| key);
                let mut known = BTreeSet::new();
                assert!(keys.into_iter().all(|key| known.insert(key)), "{preset}");
            }
        }
    }
}

/// Whatever the words of a chain's documentation, the code of each file is that of a chain with plain ones.
#[test]
fn words_of_chains_stay_words() {
    let documented = |words: &str, option: &str| {
        Subject::of_text(
            "words",
            &format!(
                "options! {{ #[doc = {option:?}] pub struct O {{ #[doc = {option:?}] pub amount: f32 [0.0..=1.0] = uniform(0.5), }} }}
                #[doc = {words:?}]
                pub fn words(cfg: &O, color: &Texture<Vec4>) -> Texture<Vec4> {{
                    let half: Texture<Vec4> = draw(color.size() / 2, |pixel| color.load(pixel * 2) * cfg.amount);
                    draw(color.size(), |pixel| half.load(pixel / 2))
                }}"
            ),
        )
    };
    let plain = documented("Plain.", "Plain.");
    for (k, words) in HOSTILE.iter().enumerate() {
        let hostile = documented(words, HOSTILE[(k + 1) % HOSTILE.len()]);
        for engine in TAKING {
            let [wanted, found] = [&plain, &hostile].map(|subject| {
                let files = subject.files(engine, &[]);
                files.unwrap_or_else(|e| panic!("{engine}: {e}"))
            });
            readable::check_chain(engine, &found).unwrap_or_else(|e| panic!("{engine}, {words:?}: {e}"));
            assert!(wanted.keys().eq(found.keys()), "{engine}");
            for (name, text) in found.iter().filter(|(name, _)| *name != "README.md") {
                let [wanted, found] = [&wanted[name], text].map(|text| {
                    code::without_words(name, text)
                        .unwrap_or_else(|e| panic!("{engine}, {name}, {words:?}: {e}\n{text}"))
                });
                assert_eq!(found, wanted, "{engine}, {name}, {words:?}:\n{text}");
            }
            let tags = ["<script", "</script", "<img", "<!--"];
            assert!(tags.iter().all(|tag| !found["README.md"].contains(tag)), "{engine}");
        }
    }
}

/// A folder of a user's own takes chains too, and what is wrong with its table is said.
#[test]
fn folders_of_users_take_chains() {
    let folder = std::env::temp_dir().join(format!("straightline-chain-engine-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let put = |name: &str, text: &str| std::fs::write(folder.join(name), text).expect("a file");
    put("t.tera", "{{ name }}");
    put(
        "whole.tera",
        "{% for p in passes %}{{ p.name }} {{ p.width }}\n{% endfor %}",
    );
    put("one.tera", "{{ pass.name }} runs {{ shader.shader.function }}");
    let subject = two_passes("color.size() / 2", "Vec4", "color.load(pixel)", "color.size()");
    let tried = |chain: &str| {
        let head =
            "title = \"Mine\"\nabout = \"a text\"\n[shaders.a]\nlanguage = \"wgsl\"\n[files]\n\"t.tera\" = \"t\"\n";
        put("engine.toml", &format!("{head}{chain}"));
        subject.files(&folder.to_string_lossy(), &[])
    };
    let files = "[chain.files]\n\"whole.tera\" = \"{{ name }}.txt\"\n";
    for (chain, said) in [
        ("[chain.files]\n", "[chain]: it names no file"),
        (
            &*format!("[chain]\nshaders = [\"b\"]\n{files}"),
            "[chain]: there is no shader `b`",
        ),
        (
            &*format!("[chain]\nmeanings = [\"depth\"]\n{files}"),
            "[chain]: the engine has no meaning `depth`",
        ),
        (
            &*format!("[chain.formats]\nrgb565 = \"a\"\n{files}"),
            "[chain]: `rgb565` is no format",
        ),
        ("[chain.files]\n\"none.tera\" = \"a\"\n", "cannot read"),
    ] {
        let message = tried(chain).expect_err("it is wrong").to_string();
        assert!(message.contains(said), "{message}");
    }
    let made = tried(&format!(
        "{files}[chain.pass_files]\n\"one.tera\" = \"{{{{ pass.file }}}}.txt\"\n"
    ));
    let made = made.unwrap_or_else(|e| panic!("{e}"));
    let whole = "first Math.max(1, Math.floor(of(\"color\").width / 2))\nresult of(\"color\").width\n";
    let texts: Vec<(&str, &str)> = made.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    assert_eq!(
        texts,
        [
            ("0-first.txt", "first runs pair_first"),
            ("1-result.txt", "result runs pair"),
            ("pair.txt", whole)
        ]
    );
    std::fs::remove_dir_all(&folder).expect("the folder");
}
