//! Every kernel of the page, through the messages that the page sends.

use serde_json::{Value, json};
use straightline_codegen::emit::Target;
use straightline_codegen::spec::KNOBS;
use straightline_codegen::{Kernel, Overrides, ShaderSpec};
use straightline_page_module::{Message, answer, page_entries};

/// Returns the module's answer.
fn ask(json: Value, bytes: &[u8]) -> Result<Message, Value> {
    let request = Message {
        json,
        bytes: bytes.to_vec(),
    };
    let mut given = Message::decode(&answer(&request.encode())).expect("an answer is a message");
    match given.json.get_mut("ok") {
        Some(ok) => Ok(Message {
            json: ok.take(),
            bytes: given.bytes,
        }),
        None => Err(given.json["refused"].clone()),
    }
}

/// The first reason of a refusal.
fn reason(refused: &Value) -> &str {
    refused["errors"][0]["message"].as_str().expect("a message")
}

const SIZE: [u32; 2] = [24, 16];

/// Kernels whose picture the page cannot draw, with what it says.
const UNDRAWN: [(&str, &str); 2] = [("pcf", "shadow map"), ("pcss", "shadow map")];

fn unroll(id: &str) -> &'static str {
    page_entries()
        .iter()
        .find(|entry| entry.id == id)
        .map_or("full", |entry| entry.unroll)
}

fn compile(id: &str) -> Value {
    let shaders = json!([
        { "stage": "compute", "format": "rgba16float", "target": ["wgsl", "glsl450", "hlsl", "msl"] },
        { "stage": "fragment", "format": "rgba16float", "target": ["essl300"] },
    ]);
    let asked =
        json!({ "do": "compile", "kernel": { "id": id }, "shader": { "unroll": unroll(id) }, "shaders": shaders });
    ask(asked, &[])
        .unwrap_or_else(|refused| panic!("{id}: {}", refused["text"]))
        .json
}

#[test]
fn every_kernel_compiles_in_every_language() {
    let catalogue = ask(json!({ "do": "catalogue" }), &[]).expect("a catalogue").json;
    assert_eq!(
        catalogue["kernels"].as_array().expect("a list").len(),
        page_entries().len()
    );
    let mut webgl = 0;
    for entry in page_entries() {
        let compiled = compile(entry.id);
        let compute = &compiled["shaders"][0];
        for target in ["wgsl", "glsl450", "hlsl", "msl"] {
            assert!(
                compute["texts"][target].is_string(),
                "{}: {}",
                entry.id,
                compute["refused"]
            );
        }
        assert!(
            compute["manifest"]["counts"]["statements"].as_u64() > Some(0),
            "{}",
            entry.id
        );
        let fragment = &compiled["shaders"][1];
        webgl += usize::from(fragment["texts"]["essl300"].is_string());
        // Every number that is set at run time has a value to begin with.
        for binding in compute["manifest"]["bindings"].as_array().expect("bindings") {
            for field in binding["fields"]
                .as_array()
                .filter(|_| binding["type"] == "uniform")
                .into_iter()
                .flatten()
            {
                let name = field["name"].as_str().expect("a name");
                let scene = ["ray_corner", "ray_right", "ray_down", "origin", "near", "far"].contains(&name);
                let known = entry.uniforms.iter().any(|u| u.name == name);
                assert!(known || scene || !field["default"].is_null(), "{}: `{name}`", entry.id);
            }
        }
    }
    // Neither those of pixel quads, nor those that ask for the size of a target and read no texture of that size.
    assert!(webgl >= 33, "{webgl}");
}

#[test]
fn every_kernel_draws_or_says_why_not() {
    for entry in page_entries() {
        let uniforms: serde_json::Map<String, Value> = entry
            .uniforms
            .iter()
            .map(|u| (u.name.to_owned(), json!(u.value)))
            .collect();
        let about = json!({ "kernel": { "id": entry.id }, "size": SIZE, "shader": { "unroll": entry.unroll } });
        let ask_for = |what: &str, uniforms: Value| {
            let mut request = about.clone();
            request["do"] = json!(what);
            request["uniforms"] = uniforms;
            ask(request, &[])
        };
        let inputs = ask_for("inputs", json!({}));
        if let Some((_, why)) = UNDRAWN.iter().find(|(id, _)| *id == entry.id) {
            let refused = inputs.expect_err(entry.id);
            assert!(reason(&refused).contains(why), "{refused}");
            continue;
        }
        let inputs = inputs.unwrap_or_else(|refused| panic!("{}: {}", entry.id, refused["text"]));
        for texture in inputs.json["textures"].as_array().expect("textures") {
            let number = |name: &str| texture[name].as_u64().expect("a number");
            let texel = match texture["format"].as_str() {
                Some("r32float" | "rg16float") => 4,
                Some("r16float") => 2,
                Some("rgba16float") => 8,
                _ => 16,
            };
            assert_eq!(
                number("width") * number("height") * number("layers") * texel,
                number("length"),
                "{texture}"
            );
            assert!(
                number("offset") + number("length") <= inputs.bytes.len() as u64,
                "{texture}"
            );
        }
        let mut all = inputs.json["uniforms"].as_object().expect("uniforms").clone();
        all.extend(uniforms);
        let picture = ask_for("interpret", Value::Object(all))
            .unwrap_or_else(|refused| panic!("{}: {}", entry.id, refused["text"]));
        assert_eq!(picture.bytes.len(), (SIZE[0] * SIZE[1] * 16) as usize);
        let floats: Vec<f32> = picture
            .bytes
            .chunks_exact(4)
            .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
            .collect();
        assert!(floats.iter().all(|v| v.is_finite()), "{} is not finite", entry.id);
        let varied = floats.chunks_exact(4).any(|texel| texel != &floats[..4]);
        assert!(varied, "{} is all one colour", entry.id);
    }
}

#[test]
fn sraa_reads_the_scene_in_every_encoding() {
    let picture = |options: Value| {
        let request = json!({ "kernel": { "id": "sraa" }, "size": [48, 30], "shader": { "set": options } });
        let mut asked = request.clone();
        asked["do"] = json!("inputs");
        let uniforms = ask(asked, &[]).unwrap_or_else(|r| panic!("{}", r["text"])).json["uniforms"].clone();
        let mut asked = request;
        asked["do"] = json!("interpret");
        asked["uniforms"] = uniforms;
        let bytes = ask(asked, &[]).unwrap_or_else(|r| panic!("{}", r["text"])).bytes;
        bytes
            .chunks_exact(4)
            .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
            .collect::<Vec<f32>>()
    };
    let plain = picture(json!({}));
    // Other encodings of the same surfaces must give the same picture, except for their rounding.
    for options in [
        json!({ "layout": "superresolution" }),
        json!({ "normals": "unorm" }),
        json!({ "normals": "octahedral" }),
        json!({ "normals": "packed" }),
        json!({ "normals": "packed", "layout": "superresolution" }),
    ] {
        let other = picture(options.clone());
        let off = plain.iter().zip(&other).filter(|(a, b)| (*a - *b).abs() > 0.02).count();
        assert!(off * 50 < plain.len(), "{options}: {off} of {}", plain.len());
    }
    for depth in ["perspective", "reversed", "reversed-infinite"] {
        let other = picture(json!({ "depth": depth, "difference": "relative", "depth-scale": "10" }));
        let same = picture(json!({ "difference": "relative", "depth-scale": "10" }));
        let off = same.iter().zip(&other).filter(|(a, b)| (*a - *b).abs() > 0.02).count();
        assert!(off * 20 < same.len(), "{depth}: {off} of {}", same.len());
    }
    let request = json!({ "do": "inputs", "kernel": { "id": "sraa" }, "size": SIZE, "shader": { "set": { "layout": "multisampled" } } });
    assert!(reason(&ask(request, &[]).expect_err("no such texture")).contains("multisampled"));
}

#[test]
fn an_edited_text_is_compiled_and_its_errors_have_places() {
    let source = ask(json!({ "do": "source", "kernel": { "id": "kernels/kuwahara" } }), &[])
        .expect("a source")
        .json;
    let text = source["files"][0]["text"].as_str().expect("a text");
    let edited = |text: &str| {
        json!({ "do": "compile", "kernel": { "id": "kernels/kuwahara", "function": "kuwahara",
            "files": [{ "path": "kuwahara.rs", "text": text }] },
            "shaders": [{ "stage": "compute", "format": "rgba16float", "target": ["wgsl"] }] })
    };
    let shader = |given: &Value| given["shaders"][0]["texts"]["wgsl"].as_str().expect("WGSL").to_owned();
    let body = |text: String| text[text.find("@compute").expect("an entry point")..].to_owned();
    let plain = ask(edited(text), &[]).expect("as it is").json;
    let wider = ask(edited(&text.replace("= 3", "= 4")), &[]).expect("a change").json;
    assert_ne!(body(shader(&plain)), body(shader(&wider)));
    let broken = text.replace("variance < least", "variance < leest");
    let refused = ask(edited(&broken), &[]).expect_err("a slip");
    let place = &refused["errors"][0]["place"];
    let from = place["from"].as_u64().expect("a place") as usize;
    assert!(broken[from..].starts_with("leest"), "{refused}");
}

#[test]
fn a_visitors_picture_is_filtered() {
    let pixels: Vec<u8> = (0..8 * 4).flat_map(|k| [k as u8 * 7, 255 - k as u8, 40, 255]).collect();
    ask(json!({ "do": "picture", "width": 8, "height": 4 }), &pixels).expect("a picture");
    let request = json!({ "do": "interpret", "kernel": { "id": "kernels/median" }, "size": [8, 4] });
    let median = ask(request, &[]).expect("a picture").bytes;
    let reference = ask(json!({ "do": "reference", "samples": 1 }), &[]).expect("a picture");
    assert_eq!(reference.json, json!({ "width": 8, "height": 4 }));
    assert_ne!(median, reference.bytes);
    let wrong = ask(json!({ "do": "picture", "width": 9, "height": 4 }), &pixels).expect_err("too few bytes");
    assert!(reason(&wrong).contains("9x4"), "{wrong}");
    ask(json!({ "do": "picture", "width": 0, "height": 0 }), &[]).expect("the scene again");
    let scene = ask(json!({ "do": "reference", "samples": 4, "scene": true }), &[]).expect("the scene");
    assert_eq!(scene.json["width"], 480);
}

#[test]
fn nonsense_is_refused() {
    for bytes in [&b""[..], b"\xff\xff\xff\xff", b"\x02\0\0\0{}"] {
        let given = Message::decode(&answer(bytes)).expect("an answer");
        assert!(given.json["refused"]["text"].is_string());
    }
    let refused = ask(json!({ "do": "compile", "kernel": { "id": "nothing" } }), &[]).expect_err("no such kernel");
    assert!(reason(&refused).contains("nothing"));
    let request = json!({ "do": "compile", "kernel": { "id": "sraa" }, "shader": { "set": { "pattern": "round" } } });
    assert!(
        ask(request, &[]).expect_err("no such value")["text"]
            .as_str()
            .expect("text")
            .contains("round")
    );
}

#[test]
fn a_kernel_is_had_as_the_folder_of_an_engine() {
    let catalogue = ask(json!({ "do": "catalogue" }), &[]).expect("a catalogue").json;
    let engines = catalogue["engines"].as_array().expect("a list");
    assert!(engines.len() >= 16 && engines.iter().any(|e| e["title"] == "three.js"));
    let folder = |engine: &str, id: &str| {
        let asked =
            json!({ "do": "engine", "engine": engine, "kernel": { "id": id }, "shader": { "unroll": unroll(id) } });
        let context = ask(asked, &[])?.json;
        let request = Message::from_json(json!({ "engine": engine, "context": context })).encode();
        let made = Message::decode(&straightline_page_templates::answer(&request)).expect("an answer is a message");
        Ok::<Value, Value>(made.json["ok"].clone())
    };
    for engine in engines {
        let name = engine["name"].as_str().expect("a name");
        let files = folder(name, "kernels/kuwahara").unwrap_or_else(|refused| panic!("{name}: {refused}"));
        assert!(files["README.md"].is_string(), "{name}: {files}");
    }
    let three = folder("three", "kernels/kuwahara").expect("a folder");
    let pass = three["kuwahara-pass.js"].as_str().expect("a pass");
    assert!(
        pass.contains("class KuwaharaPass") && pass.contains("RawShaderMaterial"),
        "{pass}"
    );
    let refused = folder("mpv", "sraa").expect_err("three textures");
    assert!(reason(&refused).contains("does not fit mpv"), "{refused}");
    let nobody = folder("../secrets", "sraa").expect_err("no engine");
    assert!(reason(&nobody).contains("there is no engine"), "{nobody}");
    for request in [
        Message::from_json(json!({ "engine": "../secrets", "context": {} })).encode(),
        Vec::new(),
    ] {
        let made = Message::decode(&straightline_page_templates::answer(&request)).expect("an answer is a message");
        assert!(made.json["refused"]["text"].is_string(), "{}", made.json);
    }
}

/// A message has every setting of a shader that a `build.rs` has, and makes the same text of it.
#[test]
fn messages_have_every_knob() {
    let text = std::fs::read_to_string("../../kernels/filters/gaussian.rs").expect("a kernel");
    let kernel = Kernel::from_text("kernels/filters/gaussian.rs", &text, "gaussian");
    for knob in KNOBS {
        let spec = knob.example(ShaderSpec::new().targets([Target::Wgsl]));
        let request = json!({
            "do": "compile", "shader": spec, "shaders": [Overrides::of_changed(&spec)],
            "kernel": { "id": "kernels/gaussian", "function": "gaussian",
                "files": [{ "path": "kernels/filters/gaussian.rs", "text": text }] },
        });
        let mut browser = spec.clone();
        browser.emit.enable_subgroups = true;
        match (ask(request, &[]), browser.compile(&kernel)) {
            (Ok(answer), Ok(compiled)) => {
                let shader = &answer.json["shaders"][0];
                for target in browser.emit.targets.clone() {
                    let alone = browser.emit.clone().targets([target]);
                    let (text, refused) = (
                        &shader["texts"][target.to_string()],
                        &shader["refused"][target.to_string()],
                    );
                    match compiled.emit(&alone) {
                        Ok(emitted) => assert_eq!(
                            text.as_str().map(str::as_bytes),
                            Some(&*emitted.files[&target]),
                            "{}",
                            knob.name
                        ),
                        Err(_) => assert!(refused.is_string(), "{}: {refused}", knob.name),
                    }
                }
            }
            (Err(refused), Err(errors)) => {
                let text = refused["text"].as_str().expect("a text");
                assert!(text.contains(errors.first_message()), "{}: {text}", knob.name);
            }
            (asked, compiled) => panic!("{}: {:?}, {:?}", knob.name, asked.err(), compiled.err()),
        }
    }
}
