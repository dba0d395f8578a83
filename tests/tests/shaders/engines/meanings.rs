//! Inputs by meaning: every engine has one, converted to the declared type, or refuses it by name. The picture is never
//! bound to anything else.

use super::{Subject, as_kept, blesses, readable};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use straightline_codegen::{Kernel, Settings};
use straightline_engines::meaning::Holds;
use straightline_engines::{Engine, EngineError, MEANINGS, Meaning, OWN, Request, engine_names};

/// A kernel with these parameters beside `pixel`, whose result is the sum of what it reads.
fn kernel(parameters: &[(&str, &str)]) -> Subject {
    let declared: Vec<String> = parameters.iter().map(|(name, ty)| format!("{name}: {ty}")).collect();
    let read = parameters.iter().map(|(name, ty)| match *ty {
        "&Frame<Vec4>" => format!("{name}.load(pixel)"),
        "&Frame<Vec3>" => format!("{name}.load(pixel).extend(1.0)"),
        "&Frame<Vec2>" => format!("{name}.load(pixel).extend(1.0).extend(1.0)"),
        "&Frame<f32>" => format!("Vec4::splat({name}.load(pixel))"),
        "Mat4" => format!("{name} * Vec4::ONE"),
        "f32" => format!("Vec4::splat({name})"),
        _ => format!("Vec4::splat({name} as f32)"),
    });
    let text = format!(
        "use straightline_kernels::prelude::*;\n/// A sum.\npub fn sum({}, pixel: IVec2) -> Vec4 {{\n    {}\n}}\n",
        declared.join(", "),
        read.collect::<Vec<_>>().join(" + ")
    );
    let kernel = Kernel::from_text("sum.rs", &text, "sum");
    let compiled = kernel.compile(&Settings::default());
    Subject {
        name: "sum",
        compiled: compiled.unwrap_or_else(|e| panic!("{text}\n{e}")),
        options: kernel.options().unwrap_or_else(|e| panic!("{e}")),
    }
}

/// A kernel that reads the picture and something with this meaning, by this name.
fn with_meaning(meaning: &Meaning, name: &str) -> Subject {
    match meaning.is_picture() {
        true => kernel(&[(name, "&Frame<Vec4>")]),
        false => kernel(&[("color", "&Frame<Vec4>"), (name, meaning.holds.declared())]),
    }
}

fn engines() -> impl Iterator<Item = Engine> {
    engine_names().map(|name| Engine::builtin(name).expect("an engine"))
}

/// Returns whether users of an engine bind every input by its own name.
fn binds_by_name(engine: &Engine) -> bool {
    engine.description().meanings.is_empty()
}

fn context_of(
    engine: &Engine,
    subject: &Subject,
    binds: &[(&str, &str)],
) -> Result<straightline_engines::context::Context, EngineError> {
    let request = Request::new(&subject.compiled, &subject.options);
    let request = binds
        .iter()
        .fold(request, |request, (name, word)| request.bind(name, word));
    engine.context(&request)
}

/// Message, notes and help of a refusal.
fn refusal(error: EngineError) -> String {
    match error {
        EngineError::Kernel(errors) => super::refusal(&errors),
        other => panic!("{other}"),
    }
}

/// Every meaning on every engine: bound by its name and every other name, and read by a compiler of the engine's language,
/// or refused by name.
#[test]
fn every_meaning_is_bound_or_refused_by_name() {
    for engine in engines() {
        let description = engine.description();
        for meaning in &MEANINGS {
            for name in meaning.aliases.iter().chain([&meaning.name]) {
                let shown = format!("{name} on {}", engine.name());
                let subject = with_meaning(meaning, name);
                let found = context_of(&engine, &subject, &[]);
                if binds_by_name(&engine) {
                    let context = found.unwrap_or_else(|e| panic!("{shown}: {e}"));
                    let own = context
                        .own
                        .iter()
                        .map(|t| &t.name)
                        .chain(context.uniforms.iter().map(|u| &u.of));
                    assert!(
                        context.picture.is_none() && own.into_iter().any(|own| own == name),
                        "{shown}"
                    );
                    continue;
                }
                if !description.meanings.contains_key(meaning.name) {
                    let said = refusal(found.expect_err(&shown));
                    let wanted = format!("reads `{name}`, and {} has no {}", description.title, meaning.name);
                    assert!(said.contains(&wanted) && said.starts_with("[E0801]"), "{shown}: {said}");
                    let offers_own = said.contains(&format!("`--bind {name}={OWN}`"));
                    let takes_own = !meaning.holds.is_texture() || description.limits.own_textures.unwrap_or(true);
                    assert_eq!(offers_own, takes_own, "{shown}: {said}");
                    continue;
                }
                let context = found.unwrap_or_else(|e| panic!("{shown}: {e}"));
                assert!(context.meanings[meaning.name], "{shown}");
                assert!(
                    context.own.is_empty() && context.uniforms.is_empty(),
                    "{shown}: it is left to the user"
                );
                if meaning.is_picture() {
                    assert_eq!(
                        context.picture.map(|picture| picture.name).as_deref(),
                        Some(*name),
                        "{shown}"
                    );
                }
                for (shader, of) in &context.shaders {
                    let expression = description.meanings[meaning.name].expressions.get(shader);
                    let Some(expression) = expression else {
                        assert!(meaning.is_picture(), "{shown}: no expression for {shader}");
                        continue;
                    };
                    let expression = expression.replace("{column}", "0");
                    let arguments = of.arguments.iter().filter_map(|a| a.expression.as_ref());
                    let reads = of.reads.iter().filter_map(|r| r.expression.as_ref());
                    let globals = of.globals.iter().map(|g| &g.expression);
                    let mut all = arguments.chain(reads).chain(globals);
                    assert!(
                        all.any(|text| text.contains(&expression)),
                        "{shown}: {shader} does not read it"
                    );
                }
                let request = Request::new(&subject.compiled, &subject.options);
                let files = engine.render_files(&request).unwrap_or_else(|e| panic!("{shown}: {e}"));
                let texts = files
                    .into_iter()
                    .map(|(name, bytes)| (name, String::from_utf8(bytes).expect("text")));
                readable::check(engine.name(), &texts.collect()).unwrap_or_else(|e| panic!("{shown}: {e}"));
            }
        }
    }
}

/// A kernel of depth alone gets no colours anywhere.
#[test]
fn depth_alone_is_never_the_picture() {
    let subject = kernel(&[("depth", "&Frame<f32>")]);
    let mut bound = BTreeSet::new();
    for engine in engines() {
        let name = engine.name();
        match context_of(&engine, &subject, &[]) {
            Ok(context) => {
                assert!(context.picture.is_none(), "{name}");
                assert_eq!(context.meanings["depth"], !binds_by_name(&engine), "{name}");
                bound.insert(name.to_owned());
            }
            Err(error) => {
                let said = refusal(error);
                assert!(
                    said.contains("reads `depth`, and") && said.contains("has no depth"),
                    "{name}: {said}"
                );
            }
        }
    }
    let wanted = [
        "babylon",
        "opengl",
        "panda3d",
        "postprocessing",
        "reshade",
        "three",
        "unity",
        "unreal",
        "webgl2",
        "webgpu",
    ];
    assert!(bound.iter().map(String::as_str).eq(wanted), "{bound:?}");
}

/// Inputs with names of their own are refused with the option that settles it, and then bound.
#[test]
fn renamed_inputs_are_bound_by_the_option() {
    let subject = kernel(&[("before", "&Frame<Vec4>"), ("z", "&Frame<f32>"), ("t", "f32")]);
    let binds = [("before", "color"), ("z", "depth"), ("t", "time")];
    for engine in engines().filter(|engine| !binds_by_name(engine)) {
        let name = engine.name();
        let meanings = &engine.description().meanings;
        let single = kernel(&[("before", "&Frame<Vec4>")]);
        let said = refusal(context_of(&engine, &single, &[]).expect_err(name));
        assert!(
            said.contains("`--bind before=color` makes it the picture"),
            "{name}: {said}"
        );
        let context = context_of(&engine, &single, &[("before", "color")]).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(
            context.picture.map(|picture| picture.name).as_deref(),
            Some("before"),
            "{name}"
        );
        let all = context_of(&engine, &subject, &binds);
        match binds.iter().find(|(_, word)| !meanings.contains_key(*word)) {
            Some((input, word)) => {
                let said = refusal(all.expect_err(name));
                assert!(
                    said.contains(&format!("reads `{input}`, and")) && said.contains(word),
                    "{name}: {said}"
                );
            }
            None => {
                let context = all.unwrap_or_else(|e| panic!("{name}: {e}"));
                assert!(context.own.is_empty() && context.uniforms.is_empty(), "{name}");
            }
        }
    }
}

/// A further texture is the user's, and `own` makes it so whatever its name.
#[test]
fn own_textures_are_left_to_the_user() {
    let subject = kernel(&[
        ("color", "&Frame<Vec4>"),
        ("depth", "&Frame<f32>"),
        ("table", "&Frame<Vec4>"),
    ]);
    for engine in engines().filter(|engine| !binds_by_name(engine)) {
        let name = engine.name();
        let found = context_of(&engine, &subject, &[("depth", OWN)]);
        if engine.description().limits.own_textures == Some(false) {
            let said = refusal(found.expect_err(name));
            assert!(said.contains("binds 3 textures"), "{name}: {said}");
            let pair = kernel(&[("depth", "&Frame<f32>")]);
            let said = refusal(context_of(&engine, &pair, &[("depth", OWN)]).expect_err(name));
            assert!(said.contains("reads `depth`, a texture of yours"), "{name}: {said}");
            continue;
        }
        let context = found.unwrap_or_else(|e| panic!("{name}: {e}"));
        let own: Vec<&str> = context.own.iter().map(|texture| texture.name.as_str()).collect();
        assert_eq!(own, ["depth", "table"], "{name}");
    }
}

/// Wrong types, two inputs of one meaning, unknown words and unknown inputs are refused, with the text to write.
#[test]
fn wrong_bindings_are_named() {
    let three = Engine::builtin("three").expect("an engine");
    let color = ("color", "&Frame<Vec4>");
    for (parameters, binds, wanted) in [
        (
            vec![color, ("depth", "&Frame<Vec4>")],
            vec![],
            "declare `depth: &Frame<f32>`; `--bind depth=own`",
        ),
        (vec![color, ("time", "u32")], vec![], "declare `time: f32`"),
        (
            vec![color, ("image", "&Frame<Vec4>")],
            vec![],
            "reads both `color` and `image` as color; ",
        ),
        (
            vec![color],
            vec![("color", "colours")],
            "binds `color` as `colours`, which is no meaning",
        ),
        (
            vec![color],
            vec![("z", "depth")],
            "does not read `z`, which `--bind z=depth` binds",
        ),
        (
            vec![("a", "&Frame<f32>")],
            vec![("a", "normal")],
            "declare `a: &Frame<Vec3>`",
        ),
    ] {
        let said = refusal(context_of(&three, &kernel(&parameters), &binds).expect_err(wanted));
        assert!(said.contains(wanted), "{said}");
    }
    let webgl = Engine::builtin("webgl2").expect("an engine");
    let said = refusal(context_of(&webgl, &kernel(&[color]), &[("color", "color")]).expect_err("by name"));
    assert!(said.contains("takes every input by its own name"), "{said}");
}

/// Reads that an engine cannot convert are refused by name.
#[test]
fn filtered_depth_is_refused_by_name() {
    let text = "use straightline_kernels::prelude::*;\npub fn soft(color: &Frame<Vec4>, depth: &Frame<f32>, linear: &Sampler, pixel: IVec2) -> Vec4 {\n    \
        color.load(pixel) * depth.sample(linear, pixel.as_vec2() / 64.0)\n}\n";
    let kernel = Kernel::from_text("soft.rs", text, "soft");
    let subject = Subject {
        name: "soft",
        compiled: kernel.compile(&Settings::default()).unwrap_or_else(|e| panic!("{e}")),
        options: Vec::new(),
    };
    let three = Engine::builtin("three").expect("an engine");
    let said = refusal(context_of(&three, &subject, &[]).expect_err("a refusal"));
    assert!(
        said.contains("filters `depth`") && said.contains("`depth.load(pixel)`"),
        "{said}"
    );
}

/// `engine.toml` says where each meaning comes from, in each of its shaders.
#[test]
fn descriptions_name_meanings_and_shaders() {
    for engine in engines() {
        let (name, description) = (engine.name(), engine.description());
        for (word, source) in &description.meanings {
            let meaning = Meaning::find(word).unwrap_or_else(|| panic!("{name}: {word}"));
            assert!(
                !source.stored.is_empty() && !source.stored.ends_with('.'),
                "{name}: {word}"
            );
            let wanted: BTreeSet<&String> = match meaning.is_picture() {
                true => BTreeSet::new(),
                false => description.shaders.keys().collect(),
            };
            assert_eq!(
                source.expressions.keys().collect::<BTreeSet<_>>(),
                wanted,
                "{name}: {word}"
            );
            let has_column = source.expressions.values().all(|text| text.contains("{column}"));
            assert!(meaning.holds != Holds::Matrix || has_column, "{name}: {word}");
        }
        for word in description.lacks.keys() {
            assert!(
                Meaning::find(word).is_some() && !description.meanings.contains_key(word),
                "{name}: {word}"
            );
        }
    }
}

/// The tables of `docs/engines.md` are those of the descriptions.
#[test]
fn documents_list_the_meanings() {
    let mut meanings = "| meaning | input | value | other names |\n| --- | --- | --- | --- |\n".to_owned();
    for meaning in &MEANINGS {
        let aliases: Vec<String> = meaning.aliases.iter().map(|name| format!("`{name}`")).collect();
        let (name, declared) = (meaning.name, meaning.holds.declared());
        meanings += &format!(
            "| `{name}` | `{declared}` | {} | {} |\n",
            meaning.doc,
            aliases.join(", ")
        );
    }
    let (mut table, mut by_name) = ("| engine | provides |\n| --- | --- |\n".to_owned(), Vec::new());
    for engine in engines() {
        if binds_by_name(&engine) {
            by_name.push(engine.name().to_owned());
            continue;
        }
        let has = |meaning: &&Meaning| engine.description().meanings.contains_key(meaning.name);
        let names = MEANINGS.iter().filter(has).map(|meaning| format!("`{}`", meaning.name));
        table += &format!("| {} | {} |\n", engine.name(), names.collect::<Vec<_>>().join(", "));
    }
    table += &format!("| {} | every input by its own name |\n", by_name.join(", "));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/engines.md");
    let mut document = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    for (mark, text) in BTreeMap::from([("meanings", &meanings), ("engines by meaning", &table)]) {
        let begin = format!("<!-- {mark} -->\n");
        let (before, rest) = document
            .split_once(&begin)
            .unwrap_or_else(|| panic!("no mark `{mark}`"));
        let (_, behind) = rest.split_once("<!-- end -->").expect("the end");
        document = format!("{before}{begin}{text}<!-- end -->{behind}");
    }
    match blesses() {
        true => std::fs::write(&path, document).unwrap_or_else(|e| panic!("{}: {e}", path.display())),
        false => as_kept(&path, &document),
    }
}
