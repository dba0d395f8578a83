//! Chains that are constants, and chains that are read from files.

use crate::chains::{glowing, run};
use crate::common::{self, chains, ramp, view};

use chains::{BLEND, DOWN, glow};
use common::{Fixture, Gpu, Stage};
use std::borrow::Cow::Borrowed;
use straightline_runtime::manifest::text_hash;
use straightline_runtime::{Chain, ChainShaders, PassOptions, Shader};

#[test]
fn a_chain_is_read_from_files() {
    let gpu = Gpu::new();
    let size = [9, 5];
    let json = glow().to_json();
    let mut asked = Vec::new();
    let files = |name: &str| {
        asked.push(name.to_owned());
        let kernel = if name == "down" { &DOWN } else { &BLEND };
        let Fixture { manifest, wgsl } = kernel.emit(Stage::Compute);
        Some((manifest, wgsl))
    };
    let chain = Chain::from_json(&gpu.device, &json, files, &PassOptions::default()).expect("a chain");
    assert_eq!(asked, ["down", "blend"]);
    assert_eq!(chain.plan(), &glow());
    let (color, target) = (view(&gpu.upload(size, 1, &ramp(size, 1))), gpu.target(size));
    run(
        &gpu,
        &chain.bind(&[("color", &color)], &view(&target)).expect("to bind"),
    );
    assert_eq!(gpu.download(&target), glowing(size));

    let none = |_: &str| None::<(String, String)>;
    let refused = |json: &str| {
        let made = Chain::from_json(&gpu.device, json, none, &PassOptions::default());
        made.expect_err("a refusal").to_string()
    };
    assert!(refused(&json).starts_with("chain `chain`: shader `down`: its files are not given"));
    let other = refused(&json.replace("\"schema\": 1", "\"schema\": 9"));
    assert_eq!(
        other,
        "chain schema 9, but this reader knows schema 1: generate the chain again"
    );
    let bad = refused(&json.replace("\"from\": \"half\"", "\"from\": \"out\""));
    assert!(
        bad.starts_with("chain `chain`: pass `out`: reads `out` before it is written"),
        "{bad}"
    );
}

/// A chain as a build script writes it.
mod generated {
    use super::{Borrowed, ChainShaders, Shader, text_hash};
    use straightline_runtime::plan::{
        CHAIN_SCHEMA, ChainPlan, Dimension, Extent, Format, InputKind, InputPlan, Loops, OutputPlan, PassPlan,
        PicturePlan, Plan, ReadPlan, SampleType, SizeOp, SizeRule, SizeTerm, StagePlan, TexturePlan,
    };

    const WGSL: &str = "@group(0) @binding(0) var big: texture_2d<f32>;
        @fragment
        fn down(@builtin(position) position: vec4f) -> @location(0) vec4f {
            return textureLoad(big, min(2 * vec2i(position.xy), vec2i(textureDimensions(big)) - 1), 0);
        }";

    static SHADER: Shader<'static> = Shader::generated(
        WGSL,
        text_hash(WGSL),
        Loops::Unproven(Borrowed("by hand")),
        Plan {
            kernel: Borrowed("down"),
            entry_point: Borrowed("down"),
            stage: StagePlan::Fragment,
            block: [1, 1],
            features: Borrowed(&[]),
            inputs: Borrowed(&[InputPlan {
                name: Borrowed("big"),
                group: 0,
                binding: 0,
                kind: InputKind::Texture(TexturePlan {
                    dimension: Dimension::D2,
                    sample_type: SampleType::Unfilterable,
                    components: 4,
                    layers: 1,
                    samples: 1,
                    extent: Extent::Any,
                }),
            }]),
            uniforms: Borrowed(&[]),
            region: None,
            overrides: Borrowed(&[]),
            varyings: Borrowed(&[]),
            outputs: Borrowed(&[OutputPlan {
                name: Borrowed("output"),
                place: None,
                format: Format::Rgba32Float,
                tile: None,
            }]),
        },
    );

    pub static CHAIN: ChainShaders = ChainShaders::generated(
        ChainPlan {
            schema: CHAIN_SCHEMA,
            chain: Borrowed("quarter"),
            inputs: Borrowed(&[Borrowed("color")]),
            pictures: Borrowed(&[
                PicturePlan {
                    name: Borrowed("half"),
                    size: SizeRule(Borrowed(&[
                        SizeTerm::Of(Borrowed("color")),
                        SizeTerm::Number([2, 2]),
                        SizeTerm::Apply(SizeOp::Div),
                    ])),
                    format: Format::Rgba32Float,
                    memory: Some(0),
                },
                PicturePlan {
                    name: Borrowed("result"),
                    size: SizeRule(Borrowed(&[
                        SizeTerm::Of(Borrowed("color")),
                        SizeTerm::Number([4, 4]),
                        SizeTerm::Apply(SizeOp::Div),
                    ])),
                    format: Format::Rgba32Float,
                    memory: None,
                },
            ]),
            passes: Borrowed(&[
                PassPlan {
                    name: Borrowed("half"),
                    shader: Borrowed("down"),
                    reads: Borrowed(&[ReadPlan {
                        name: Borrowed("big"),
                        from: Borrowed("color"),
                    }]),
                    writes: Borrowed(&[Borrowed("half")]),
                },
                PassPlan {
                    name: Borrowed("result"),
                    shader: Borrowed("down"),
                    reads: Borrowed(&[ReadPlan {
                        name: Borrowed("big"),
                        from: Borrowed("half"),
                    }]),
                    writes: Borrowed(&[Borrowed("result")]),
                },
            ]),
        },
        &[("down", &SHADER)],
    );
}

#[test]
fn a_chain_is_a_constant() {
    fn is_shared<T: Send + Sync>(value: T) -> T {
        value
    }
    let gpu = Gpu::new();
    let chain = Chain::new(&gpu.device, &generated::CHAIN, &PassOptions::default()).expect("a chain");
    let chain = is_shared(chain);
    assert_eq!(chain.plan(), generated::CHAIN.plan());
    let color = view(&gpu.upload([8, 4], 1, &ramp([8, 4], 1)));
    let target = gpu.target([2, 1]);
    let bound = is_shared(chain.bind(&[("color", &color)], &view(&target)).expect("to bind"));
    // The bound chain outlives the chain.
    drop(chain);
    run(&gpu, &bound);
    assert_eq!(gpu.download(&target), [ramp([8, 4], 1)[0], ramp([8, 4], 1)[4]]);
}
