//! Further shading samples: which pixels the kernel `sraa_extra` lists, what `sraa` makes of them, and both with a dispatch
//! in between whose size the list says.

use crate::common;

use common::{bench, device};
use glam::{IVec2, UVec2, UVec4, Vec2, Vec4, dvec2, ivec2, uvec2};
use std::collections::BTreeSet;
use straightline_bench::execute::{Bench, Inputs, Interpreted, interpret_kernel};
use straightline_codegen::{Compiled, Stage, Unroll};
use straightline_kernels::prelude::{AtomicBuffer, Frame, StorageBuffer};
use straightline_kernels::sraa::sraa_extra;
use straightline_oracle::metrics::psnr;
use straightline_oracle::oracle::{self, Placed, Resolved, SraaParams};
use straightline_scene::capture::ShadingSample;
use straightline_scene::render::{self, CpuRenderer, Extra, GpuRenderer, Listed, PlacedBy};
use straightline_scene::scene::Scene;
use straightline_scene::{gbuffer, picture};
use straightline_tests::sraa::options::{Options, completed, options, refusal, samples_needed, value, values};
use straightline_tests::sraa::{self, Random, native, surfaces};

const SIZE: UVec2 = uvec2(37, 29);

fn compiled(kernel: &str, options: &Options, unroll: Unroll) -> Compiled {
    sraa::kernel(kernel, options, unroll).unwrap_or_else(|errors| panic!("{options:?}:\n{errors}"))
}

fn params(set: &Options) -> SraaParams {
    SraaParams::from_options(&values(set)).expect("options")
}

/// With a list of `room` entries that is empty.
fn listing(inputs: Inputs, room: usize) -> Inputs {
    let counts = [0.0, 1.0, 1.0, 0.0].map(|count| [count, 0.0, 0.0, 1.0]);
    inputs
        .with_buffer("extra_counts", counts.to_vec())
        .with_buffer("extra_list", vec![[0.0; 4]; room])
}

/// Recorded list: an image, the class of pixels that count, and the list.
struct List {
    image: Vec<usize>,
    counts: Vec<usize>,
    entries: Vec<[usize; 2]>,
}

impl List {
    fn new(image: &[[f64; 4]], buffers: &[(String, Vec<[f64; 4]>)]) -> List {
        let buffer = |name: &str| {
            let found = buffers.iter().find(|(known, _)| known == name);
            &found.unwrap_or_else(|| panic!("no {name}")).1
        };
        List {
            image: image.iter().map(|texel| texel[0] as usize).collect(),
            counts: buffer("extra_counts").iter().map(|count| count[0] as usize).collect(),
            entries: buffer("extra_list")
                .iter()
                .map(|entry| [entry[0] as usize, entry[1] as usize])
                .collect(),
        }
    }

    fn of(found: &Interpreted<f32>) -> List {
        List::new(&found.targets[0].texels, &found.buffers)
    }

    /// That it is what pixels `wanted`, and no more than there is room for. Where all are sure, it has as many as it can have.
    fn judge(&self, wanted: &[Placed], samples: usize, what: &str) -> usize {
        let room = self.entries.len();
        let all_sure = wanted.iter().all(|placed| placed.sure);
        let wants = wanted.iter().filter(|placed| placed.sample < samples).count();
        let (count, listed) = (self.counts[3], self.counts[3].min(room));
        assert_eq!(self.counts[..3], [listed.div_ceil(64), 1, 1], "{what}");
        assert!(!all_sure || count == wants, "{what}: {count} of {wants}");
        let mut from_image = BTreeSet::new();
        for (k, (own, wanted)) in self.image.iter().zip(wanted).enumerate() {
            let at = [k % SIZE.x as usize, k / SIZE.x as usize];
            // With too little room anyone may be left out.
            assert!(
                !wanted.sure || *own == wanted.sample || (count > room && *own == samples),
                "{what} at {at:?}: {own}, not {wanted:?}"
            );
            if *own < samples {
                from_image.insert([at[0] + 65536 * at[1], *own]);
            }
        }
        let entries: BTreeSet<_> = self.entries[..listed].iter().copied().collect();
        assert_eq!(entries, from_image, "{what}");
        assert_eq!(entries.len(), listed, "{what}: an entry is there twice");
        listed
    }
}

/// Sets that say something of surfaces.
fn sets_of_surfaces() -> Vec<Options> {
    let sets: [&[(&str, &str)]; 12] = [
        &[],
        &[("pattern", "latin16"), ("difference", "relative"), ("depth-scale", "3")],
        &[("shading", "sample0")],
        &[("shading", "placed")],
        &[
            ("shading", "placed"),
            ("pattern", "standard8"),
            ("layout", "superresolution"),
        ],
        &[
            ("metric", "planes-normals"),
            ("difference", "relative"),
            ("depth-scale", "3"),
        ],
        &[("metric", "depth"), ("depth", "reversed-infinite")],
        &[("metric", "normals"), ("normals", "octahedral")],
        &[("normals", "packed"), ("shading", "placed")],
        &[("layout", "multisampled"), ("shading", "placed")],
        &[("layout", "split"), ("guards", "none")],
        &[("pattern", "listed"), ("search-threshold", "0.2"), ("turn", "chord")],
    ];
    sets.iter().map(|set| completed(options(set))).collect()
}

/// Random surfaces, and railings.
fn worlds(set: &Options) -> [Inputs; 2] {
    let renderer = CpuRenderer::new(&Scene::from_name("railings").expect("a scene"), SIZE).expect("a renderer");
    let shading = match value(set, "shading", "centre") {
        "placed" => ShadingSample::Placed,
        "sample0" => ShadingSample::Sample(0),
        _ => ShadingSample::Centre,
    };
    let samples: Vec<Vec2> = params(set)
        .sample_offsets()
        .into_iter()
        .map(|[x, y]| dvec2(x, y).as_vec2())
        .collect();
    let capture = render::capture_scene(&renderer, &samples, shading).expect("a capture");
    let railings = gbuffer::sraa_inputs(&capture, &compiled("sraa_extra", set, Unroll::Full).options).expect("inputs");
    [surfaces::inputs(set, SIZE, 7), railings]
}

#[test]
fn what_is_listed_is_what_the_definition_wants() {
    let bench = bench();
    let mut listed = 0;
    for (set, bare) in sets_of_surfaces()
        .iter()
        .flat_map(|set| worlds(set).map(|bare| (set, bare)))
    {
        let samples = params(set).sample_offsets().len();
        let wanted = oracle::extra_samples(&bare, &params(set)).unwrap_or_else(|e| panic!("{set:?}: {e}"));
        let sure = wanted.iter().filter(|placed| placed.sure).count();
        assert!(2 * sure > wanted.len(), "{set:?}: {sure} pixels are sure");
        // Room for all, and for few.
        for room in [wanted.len(), 5] {
            let inputs = listing(bare.clone(), room);
            for unroll in [Unroll::Full, Unroll::None] {
                let (compiled, what) = (compiled("sraa_extra", set, unroll), format!("{set:?} {unroll} {room}"));
                let interpreted =
                    interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
                listed += List::of(&interpreted).judge(&wanted, samples, &what);
                if samples_needed(set) <= 4 {
                    let found = bench.all_written(&compiled, Stage::Compute, &inputs);
                    let (targets, buffers) = found.unwrap_or_else(|e| panic!("{what}: {e}"));
                    List::new(&targets[0].texels, &buffers).judge(&wanted, samples, &format!("{what} on the device"));
                }
            }
        }
        natively(set, &bare, samples, &wanted);
    }
    assert!(listed > 300, "{listed} pixels were listed: too few to say anything");
}

/// As rustc compiles it.
fn natively(set: &Options, inputs: &Inputs, samples: usize, wanted: &[Placed]) {
    let (cfg, gbuffer, view) = (native::config(set), native::gbuffer(inputs), native::view(inputs));
    let place = native::numbers(inputs, "place");
    let counts = AtomicBuffer::new(vec![0u32, 1, 1, 0]);
    let list = StorageBuffer::new(vec![UVec2::ZERO; wanted.len()]);
    let pixels = (0..SIZE.y as i32).flat_map(|y| (0..SIZE.x as i32).map(move |x| ivec2(x, y)));
    let given = pixels.map(|pixel: IVec2| sraa_extra(&cfg, &gbuffer, &view, &place, &counts, &list, pixel));
    let list = List {
        image: given.map(|sample| sample as usize).collect(),
        counts: counts.elements().into_iter().map(|count| count as usize).collect(),
        entries: list
            .elements()
            .into_iter()
            .map(|entry| entry.to_array().map(|n| n as usize))
            .collect(),
    };
    list.judge(wanted, samples, &format!("{set:?} natively"));
}

/// The filter with everything that a further sample meets.
fn sets() -> Vec<Options> {
    let sets: [&[(&str, &str)]; 16] = [
        &[],
        &[("pattern", "latin16")],
        &[("search", "five"), ("difference", "relative"), ("depth-scale", "3")],
        &[("search", "seven"), ("shading", "placed")],
        &[("shading", "placed"), ("layout", "superresolution")],
        &[("shading", "sample0"), ("layout", "split")],
        &[("layout", "multisampled"), ("metric", "planes-normals")],
        &[("guards", "fallback")],
        &[("guards", "none"), ("non-finite", "spread")],
        &[("non-finite", "spread"), ("falloff", "gaussian"), ("radius", "1.5")],
        &[("demodulate", "albedo")],
        &[
            ("demodulate", "albedo"),
            ("rest", "true"),
            ("layout", "superresolution"),
        ],
        &[
            ("demodulate", "albedo-shadow"),
            ("shading", "placed"),
            ("search", "five"),
        ],
        &[
            ("demodulate", "albedo-shadow"),
            ("rest", "true"),
            ("guards", "fallback"),
        ],
        &[("history", "2")],
        &[("history", "3"), ("search", "five"), ("shading", "placed")],
    ];
    let own = |set: &&[(&str, &str)]| completed(options(&[*set, &[("extra", "true")][..]].concat()));
    let sets: Vec<Options> = sets.iter().map(own).collect();
    assert!(sets.iter().all(|set| refusal(set).is_none()));
    sets
}

/// The largest difference to the definition; fails if a value is not finite.
fn off(found: impl IntoIterator<Item = [f64; 4]>, expected: &[Resolved], what: &str) -> f64 {
    let (mut largest, mut compared) = (0.0f64, 0);
    for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
        let at = (k as u32 % SIZE.x, k as u32 / SIZE.x);
        assert!(found.iter().all(|axis| axis.is_finite()), "{what} at {at:?}: {found:?}");
        if expected.sure {
            compared += 1;
            for (a, b) in found.into_iter().zip(expected.color) {
                largest = largest.max((a - b).abs());
            }
        }
    }
    assert!(2 * compared > expected.len(), "{what}: {compared} pixels compared");
    largest
}

/// Every form's distance to the definition: the interpreter in f64, all that computes in f32, and the device.
fn every_form_off(bench: &Bench, set: &Options, inputs: &Inputs) -> [f64; 3] {
    let expected = oracle::resolve_sraa(inputs, &params(set)).unwrap_or_else(|e| panic!("{set:?}: {e}"));
    let [mut in_f64, mut in_f32, mut on_device] = [0.0f64; 3];
    for unroll in [Unroll::Full, Unroll::None] {
        let (compiled, what) = (compiled("sraa", set, unroll), format!("{set:?} {unroll}"));
        let exact = interpret_kernel::<f64>(&compiled, inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
        in_f64 = in_f64.max(off(exact.targets[0].texels.iter().copied(), &expected, &what));
        let single = interpret_kernel::<f32>(&compiled, inputs, false).unwrap_or_else(|e| panic!("{what}: {e}"));
        in_f32 = in_f32.max(off(single.targets[0].texels.iter().copied(), &expected, &what));
        if unroll == Unroll::Full && samples_needed(set) <= 4 {
            for stage in [Stage::Compute, Stage::Fragment] {
                let picture = bench.run(&compiled, stage, inputs);
                let picture = picture.unwrap_or_else(|e| panic!("{what} {stage:?}: {e}"));
                let texels = picture.texels().iter().map(|texel| texel.to_array().map(f64::from));
                on_device = on_device.max(off(texels, &expected, &format!("{what} {stage:?}")));
            }
        }
    }
    let texels = native::run(set, inputs).into_iter().map(|texel| texel.map(f64::from));
    in_f32 = in_f32.max(off(texels, &expected, &format!("{set:?} natively")));
    [in_f64, in_f32, on_device]
}

#[test]
fn every_form_gives_what_the_definition_says() {
    let bench = bench();
    let mut largest = [0.0f64; 3];
    for set in sets() {
        let found = every_form_off(&bench, &set, &surfaces::inputs(&set, SIZE, 11));
        largest = [0, 1, 2].map(|k| largest[k].max(found[k]));
    }
    let [in_f64, in_f32, on_device] = largest;
    println!("off the definition: {in_f64:.1e} in f64, {in_f32:.1e} in f32, {on_device:.1e} on the device");
    assert!(in_f64 < 1.0e-5 && in_f32 < 1.0e-4 && on_device < 1.0e-4);
}

/// Colours that are not finite, and numbers of samples that there are not.
#[test]
fn hard_further_samples_leave_no_trace() {
    let bench = bench();
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX];
    for set in sets()
        .into_iter()
        .filter(|set| !set.iter().any(|(_, value)| value == "spread"))
    {
        let mut inputs = surfaces::inputs(&set, SIZE, 13);
        let mut random = Random(5);
        for (name, frames) in &mut inputs.images {
            if name.starts_with("extra_") {
                let texels = frames[0].texels().iter().map(|texel| match random.unit() < 0.3 {
                    true => Vec4::splat(random.choose(&bad)),
                    false => *texel,
                });
                frames[0] = Frame::new(SIZE, texels.collect());
            }
        }
        for (name, frames) in &mut inputs.integers {
            if name == "extra" {
                let texels = frames[0].texels().iter().map(|texel| match random.unit() < 0.1 {
                    true => UVec4::new(u32::MAX, 0, 0, 1),
                    false => *texel,
                });
                frames[0] = Frame::new(SIZE, texels.collect());
            }
        }
        // The largest float is finite, and a sum of it need not be.
        let compiled = compiled("sraa", &set, Unroll::Full);
        let expected = oracle::resolve_sraa(&inputs, &params(&set)).unwrap_or_else(|e| panic!("{set:?}: {e}"));
        let interpreted = interpret_kernel::<f32>(&compiled, &inputs, false).unwrap_or_else(|e| panic!("{set:?}: {e}"));
        let picture = bench
            .run(&compiled, Stage::Compute, &inputs)
            .unwrap_or_else(|e| panic!("{set:?}: {e}"));
        let on_device = picture.texels().iter().map(|texel| texel.to_array().map(f64::from));
        let both = interpreted.targets[0].texels.iter().copied().zip(on_device);
        for (k, ((found, on_device), expected)) in both.zip(&expected).enumerate() {
            let large = expected.color.iter().any(|axis| axis.abs() > 1.0e30);
            for found in [found, on_device] {
                let off = found
                    .iter()
                    .zip(expected.color)
                    .map(|(a, b)| (a - b).abs())
                    .fold(0.0, f64::max);
                assert!(
                    large || !expected.sure || off < 1.0e-3,
                    "{set:?} at {k}: {found:?}, not {expected:?}"
                );
            }
        }
    }
}

/// The whole of it on a device: a list with an atomic counter, dispatches of as many workgroups as the list has, and the
/// filter. The same as the renderer does on the processor, and worth it.
#[test]
fn a_list_is_shaded_by_an_indirect_dispatch() {
    let (device, queue) = device();
    let bench = Bench::new(&device, &queue, false);
    let scene = Scene::from_name("railings").expect("a scene");
    let size = uvec2(160, 90);
    let renderer = GpuRenderer::new(&device, &queue, &scene, size).expect("a renderer");
    let samples = gbuffer::pattern_offsets("latin16").expect("a pattern");
    let sampled = [("pattern", "latin16"), ("shading", "placed")];
    let capture = render::capture_placed(&renderer, &samples, PlacedBy::Planes).expect("a capture");
    let budget = (size.x * size.y / 50) as usize;
    let wanted = render::shade_extra(&renderer, &capture, (size.x * size.y) as usize).expect("further samples");
    assert!(
        wanted.listed == wanted.wanted && wanted.listed > 50,
        "{} listed",
        wanted.listed
    );
    let few = render::shade_extra(&renderer, &capture, budget).expect("further samples");
    assert!(few.listed <= budget && few.wanted == wanted.wanted);

    let list = compiled("sraa_extra", &render::listing_options(&options(&sampled)), Unroll::Full);
    let inputs = listing(
        gbuffer::sraa_inputs(&capture, &list.options).expect("inputs"),
        (size.x * size.y) as usize,
    );
    let (pass, manifest) = bench.compile_pass(&list, Stage::Compute).expect("a pass");
    let uploaded = bench.upload(&manifest, &inputs).expect("uploads");
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
    let buffer = |size: u64, usage| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    };
    let counts = buffer(16, usage | wgpu::BufferUsages::INDIRECT);
    queue.write_buffer(&counts, 0, &[0u32, 1, 1, 0].map(u32::to_ne_bytes).concat());
    let entries = buffer(8 * u64::from(size.x * size.y), usage);
    let uploaded = uploaded
        .with_buffer("extra_counts", &counts)
        .with_buffer("extra_list", &entries);
    let chosen = bench.create_target(size, pass.target_format());
    let view = chosen.create_view(&wgpu::TextureViewDescriptor::default());
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    uploaded.bind(&pass, &view).expect("bound").encode(&mut encoder);
    queue.submit([encoder.finish()]);
    let color = Listed::new(&renderer)
        .and_then(|listed| listed.shade(&samples, &counts, &entries))
        .expect("shaded");

    let found: Vec<u32> = bench
        .read_texels(&chosen)
        .expect("an image")
        .iter()
        .map(|texel| texel[0] as u32)
        .collect();
    let same = found.iter().zip(wanted.sample.texels()).filter(|(a, b)| a == b).count();
    assert!(
        same * 1000 > 998 * found.len(),
        "{same} of {} pixels are alike",
        found.len()
    );
    for ((own, expected), (a, b)) in color
        .texels()
        .iter()
        .zip(wanted.color.texels())
        .zip(found.iter().zip(wanted.sample.texels()))
    {
        let expected = if (*a as usize) < samples.len() && a == b {
            *expected
        } else if a == b {
            Vec4::ZERO
        } else {
            continue;
        };
        assert!((*own - expected).abs().max_element() < 1.0e-5, "{own} not {expected}");
    }

    let reference = render::render_reference(&renderer, 16, &mut |_, _| {}).expect("a reference");
    let judged = |frame: &Frame<Vec4>| psnr(&picture::at_eight_bits(frame), &picture::at_eight_bits(&reference));
    let filtered = |more: &[(&str, &str)], with: &dyn Fn(&Compiled) -> Inputs| {
        let set = [PlacedBy::Planes.options(), &sampled, &[("search", "five")], more].concat();
        let kernel = compiled("sraa", &options(&set), Unroll::Full);
        let inputs = with(&kernel);
        judged(&bench.run(&kernel, Stage::Compute, &inputs).expect("a picture"))
    };
    let without = filtered(&[], &|kernel| {
        gbuffer::sraa_inputs(&capture, &kernel.options).expect("inputs")
    });
    let extra = |shaded: &Extra| {
        let inputs = |kernel: &Compiled| shaded.sraa_inputs(&capture, &kernel.options).expect("inputs");
        filtered(&[("extra", "true")], &inputs)
    };
    let on_processor = extra(&wanted);
    let on_device = extra(&Extra {
        sample: Frame::new(size, found.clone()),
        color: color.clone(),
        ..wanted.clone()
    });
    println!(
        "{} of {} pixels; {without:.2} dB without, {on_processor:.2} with, {on_device:.2} on the device",
        wanted.listed,
        found.len()
    );
    assert!((on_processor - on_device).abs() < 0.02, "{on_processor} {on_device}");
    assert!(on_device > without + 0.2, "{on_device} {without}");
}
