//! Footprints of kernels, and their drawings.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use straightline_codegen::drawing::{Drawing, draw_footprint};
use straightline_codegen::footprint::{Footprint, Method, Tap, TextureReads, Unit, find_footprint};
use straightline_codegen::ir::{Op, QuadDirection};
use straightline_codegen::{Compiled, Kernel, Settings, Share, Transport, Unroll};
use straightline_kernels::CATALOGUE;

fn compile_builtin(name: &str, settings: &Settings) -> Compiled {
    let compiled = Kernel::builtin(name).and_then(|kernel| kernel.compile(settings));
    compiled.unwrap_or_else(|errors| panic!("{name}: {errors}"))
}

fn footprint_of(text: &str, settings: &Settings) -> Footprint {
    let compiled = Kernel::from_text("kernel.rs", text, "k").compile(settings);
    find_footprint(&compiled.unwrap_or_else(|errors| panic!("{errors}\n{text}")))
}

fn draw_compiled(compiled: &Compiled) -> String {
    draw_footprint(&Drawing {
        title: &compiled.kernel,
        subtitle: "",
        footprint: &find_footprint(compiled),
        samples: &[],
    })
}

/// Texels of loads, relative to the first pixel.
fn texel_of(tap: &Tap) -> [i32; 2] {
    tap.at.map(|x| x.floor() as i32)
}

fn weight_of(tap: &Tap, pixel: usize) -> f64 {
    tap.weights[pixel].as_ref().expect("a constant weight").iter().sum()
}

fn texture<'a>(footprint: &'a Footprint, name: &str) -> &'a TextureReads {
    let found = footprint.textures.iter().find(|of| of.texture == name);
    found.unwrap_or_else(|| panic!("no reads of {name}: {footprint:?}"))
}

const BOX: &str = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for y in -1..=1 {
        for x in -1..=1 {
            sum += color.load(pixel + ivec2(x, y));
        }
    }
    sum / 9.0
}";

#[test]
fn taps_of_a_box_have_a_ninth_each() {
    for settings in [Settings::new(), Settings::new().unroll(Unroll::None)] {
        let footprint = footprint_of(BOX, &settings);
        let color = texture(&footprint, "color");
        assert_eq!((color.reads, color.unit), (9, Unit::Texels(1.0)));
        let places: BTreeSet<[i32; 2]> = color.taps.iter().map(texel_of).collect();
        assert_eq!(places.len(), 9);
        assert!(places.iter().flatten().all(|x| (-1..=1).contains(x)));
        assert!(
            color
                .taps
                .iter()
                .all(|tap| (weight_of(tap, 0) - 1.0 / 9.0).abs() < 1e-7)
        );
        assert!(
            color
                .taps
                .iter()
                .all(|tap| tap.method == Method::Load && !tap.conditional)
        );
        assert!(color.elsewhere.is_empty() && !footprint.tested);
    }
}

/// A Gaussian is even, falls off, and keeps an even picture; the built-in convolution sharpens with the weights of its option.
#[test]
fn weights_are_those_of_the_kernel() {
    let filter = |name: &str| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../kernels/filters/{name}.rs"));
        let compiled = Kernel::from_file(&path, None).and_then(|kernel| kernel.compile(&Settings::new()));
        find_footprint(&compiled.unwrap_or_else(|errors| panic!("{errors}")))
    };
    let gaussian = filter("gaussian");
    let taps = &texture(&gaussian, "color").taps;
    let weights: Vec<f64> = taps.iter().map(|tap| weight_of(tap, 0)).collect();
    assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-6);
    assert!(
        weights
            .iter()
            .zip(weights.iter().rev())
            .all(|(a, b)| (a - b).abs() < 1e-7)
    );
    assert!(weights[..weights.len() / 2 + 1].is_sorted());
    let sharpened = filter("convolution");
    let taps = &texture(&sharpened, "color").taps;
    let at = |place: [i32; 2]| weight_of(taps.iter().find(|tap| texel_of(tap) == place).expect("a tap"), 0);
    assert_eq!(
        [at([0, 0]), at([1, 0]), at([2, 0]), at([1, 1])],
        [3.0, -0.25, -0.125, -0.125]
    );
}

#[test]
fn sraa_reads_its_samples_and_the_middles_around() {
    for (pattern, samples) in [("ordered4", 4), ("latin16", 16)] {
        let compiled = compile_builtin("sraa", &Settings::new().set("pattern", pattern));
        let footprint = find_footprint(&compiled);
        let depth = texture(&footprint, "depth");
        let mut layers: BTreeMap<[i32; 2], BTreeSet<u32>> = BTreeMap::new();
        for tap in &depth.taps {
            layers
                .entry(texel_of(tap))
                .or_default()
                .insert(tap.layer.expect("a sample"));
        }
        assert_eq!(layers.len(), 9);
        // The layer behind the samples is the pixel's centre, where shading lies.
        for (texel, layers) in &layers {
            let expected: BTreeSet<u32> = if *texel == [0, 0] {
                (0..=samples).collect()
            } else {
                [samples].into()
            };
            assert_eq!(*layers, expected, "{texel:?}");
        }
        assert_eq!(depth.reads, compiled.counts.reads["depth"]);
        assert_eq!(texture(&footprint, "color").taps.len(), 9);
    }
}

/// Each lane reads a quarter of the quad's footprint, and every pixel has its own 3×3 of it.
#[test]
fn lanes_of_a_convolution_part_its_footprint() {
    for radius in [1, 2, 3] {
        let compiled = compile_builtin("quad_convolution", &Settings::new().set("radius", radius.to_string()));
        let footprint = find_footprint(&compiled);
        assert!(footprint.lanes && footprint.pixels == [2, 2]);
        let taps = &texture(&footprint, "image").taps;
        let side = 2 * radius + 2;
        let places: BTreeSet<[i32; 2]> = taps.iter().map(texel_of).collect();
        assert_eq!(
            (taps.len(), places.len()),
            ((side * side) as usize, (side * side) as usize)
        );
        assert!(places.iter().flatten().all(|x| (-radius..side - radius).contains(x)));
        for lane in 0..4 {
            let own = taps.iter().filter(|tap| tap.lane == lane).count();
            assert_eq!(own as u32, compiled.counts.reads["image"]);
        }
        let weight = 1.0 / f64::from((2 * radius + 1).pow(2));
        for (pixel, place) in [[0, 0], [1, 0], [0, 1], [1, 1]].into_iter().enumerate() {
            for tap in taps {
                let is_near = (0..2).all(|axis| (texel_of(tap)[axis] - place[axis]).abs() <= radius);
                let expected = if is_near { weight } else { 0.0 };
                assert!((weight_of(tap, pixel) - expected).abs() < 1e-7, "{pixel} {tap:?}");
            }
        }
    }
}

#[test]
fn messages_are_the_swaps_of_the_graph() {
    for name in [
        "quad_convolution",
        "quad_bilateral",
        "quad_upsampling",
        "quad_ssao",
        "pcf",
        "pcss",
    ] {
        let compiled = compile_builtin(name, &Settings::new());
        let footprint = find_footprint(&compiled);
        for direction in QuadDirection::ALL {
            let swaps = compiled
                .graph
                .nodes
                .iter()
                .filter(|node| node.op == Op::QuadSwap(direction));
            let scalars: u32 = swaps.clone().map(|node| u32::from(node.ty.component_count())).sum();
            let of = footprint.messages.iter().find(|m| m.direction == direction.axis_bits());
            let found = of.map_or((0, 0), |m| (m.messages as usize, m.values));
            assert_eq!(found, (swaps.count(), scalars), "{name} {direction:?}");
        }
        let all: u32 = footprint.messages.iter().map(|m| m.messages).sum();
        assert_eq!(all, compiled.counts.messages, "{name}");
    }
}

/// Weights arrive through derivatives as through quad operations.
#[test]
fn transports_have_the_same_taps() {
    let with = |transport| compile_builtin("quad_convolution", &Settings::new().transport(transport));
    let [swaps, derivatives] = [Transport::Subgroup, Transport::Derivatives].map(|t| find_footprint(&with(t)));
    assert_eq!(swaps.textures, derivatives.textures);
    let block = find_footprint(&with(Transport::Block));
    assert!(!block.lanes && block.messages.is_empty() && block.pixels == [2, 2]);
    assert_eq!(texture(&block, "image").taps.len(), 16);
}

#[test]
fn blocks_and_workgroups_have_the_taps_of_their_pixels() {
    let block = footprint_of(BOX, &Settings::new().block(2, 2));
    assert_eq!((block.pixels, texture(&block, "color").taps.len()), ([2, 2], 16));
    let sum = |pixel| {
        texture(&block, "color")
            .taps
            .iter()
            .map(|tap| weight_of(tap, pixel))
            .sum::<f64>()
    };
    assert!((0..4).all(|pixel| (sum(pixel) - 1.0).abs() < 1e-6));
    let shared = footprint_of(BOX, &Settings::new().share(Share::Workgroup([8, 4])));
    let color = texture(&shared, "color");
    assert_eq!((color.taps.len(), color.shared.len()), (9, 1));
    assert_eq!((color.shared[0].first, color.shared[0].size), ([-1, -1], [10, 6]));
}

#[test]
fn filtered_reads_have_positions_and_weights() {
    let text = "pub fn k(image: &Texture<Vec4>, image_sampler: &Sampler, pixel: IVec2, resolution: UVec2) -> Vec4 {
        let size = resolution.as_vec2();
        let at = pixel.as_vec2() + 0.5;
        let left = image.sample(image_sampler, (at - vec2(1.2, 0.0)) / size);
        left * 0.75 + image.sample(image_sampler, (at + vec2(1.2, 0.5)) / size) * 0.25
    }";
    let footprint = footprint_of(text, &Settings::new());
    let image = texture(&footprint, "image");
    // The texture may have another size than the frame.
    assert_eq!(image.unit, Unit::Pixels);
    let found: Vec<([f64; 2], f64)> = image.taps.iter().map(|tap| (tap.at, weight_of(tap, 0))).collect();
    let near = |a: f64, b: f64| (a - b).abs() < 1e-5;
    assert!(
        near(found[0].0[0], -0.7) && near(found[0].0[1], 0.5) && near(found[0].1, 0.75),
        "{found:?}"
    );
    assert!(
        near(found[1].0[0], 1.7) && near(found[1].0[1], 1.0) && near(found[1].1, 0.25),
        "{found:?}"
    );
}

/// Comparisons of a shadow map lie around a place that is interpolated: 4×4 texels by one of each lane, 8×8 by four that are
/// mirrored locally, or simply.
#[test]
fn comparisons_of_a_quad_lie_around_a_place() {
    let with = |options: &[(&str, &str)]| {
        let settings = options
            .iter()
            .fold(Settings::new(), |all, (name, value)| all.set(name, *value));
        let footprint = find_footprint(&compile_builtin("pcf", &settings));
        let shadow = texture(&footprint, "shadow").clone();
        assert!(
            matches!(shadow.unit, Unit::Around(_)) && shadow.elsewhere.is_empty(),
            "{shadow:?}"
        );
        assert!(shadow.taps.iter().all(|tap| tap.method == Method::Compare));
        shadow.taps
    };
    let places = |taps: &[Tap]| taps.iter().map(|tap| (tap.at, tap.lane)).collect::<Vec<_>>();
    let four = with(&[("width", "four")]);
    assert_eq!(
        places(&four),
        [([0.0, 0.0], 0), ([2.0, 0.0], 1), ([0.0, 2.0], 2), ([2.0, 2.0], 3)]
    );
    assert!((0..4).all(|pixel| four.iter().all(|tap| weight_of(tap, pixel) == 0.25)));
    let lanes_of_rows = |taps: &[Tap]| taps.iter().map(|tap| tap.lane).collect::<Vec<_>>();
    let local = with(&[]);
    assert_eq!(lanes_of_rows(&local), [0, 1, 0, 1, 2, 3, 2, 3, 0, 1, 0, 1, 2, 3, 2, 3]);
    let simple = with(&[("mirroring", "simple")]);
    assert_eq!(lanes_of_rows(&simple), [0, 0, 1, 1, 0, 0, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3]);
}

/// Places that depend on other values are counted with their reason, and conditions are marked.
#[test]
fn other_reads_are_listed() {
    let text = "pub fn k(color: &Frame<Vec4>, moved: &Frame<Vec2>, taps: i32, pixel: IVec2) -> Vec4 {
        let by = moved.load(pixel);
        let mut sum = color.load(pixel + ivec2(by.x as i32, by.y as i32));
        for k in 0..taps {
            sum += color.load(pixel + ivec2(k, 0));
        }
        sum
    }";
    let compiled = Kernel::from_text("kernel.rs", text, "k").compile(&Settings::new());
    let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
    let footprint = find_footprint(&compiled);
    let places: Vec<&str> = texture(&footprint, "color")
        .elsewhere
        .iter()
        .map(|other| &*other.place)
        .collect();
    assert_eq!(
        places,
        [
            "places that depend on values that are read",
            "places that depend on the iteration of a loop"
        ]
    );
    let text = draw_compiled(&compiled);
    assert!(
        text.contains("color: 1 read at places that depend on the iteration of a loop"),
        "{text}"
    );
}

#[test]
fn a_kernel_without_reads_says_so() {
    let text = "pub fn k(pixel: IVec2) -> Vec4 { pixel.as_vec2().extend(0.0).extend(1.0) }";
    let compiled = Kernel::from_text("kernel.rs", text, "k").compile(&Settings::new());
    let text = draw_compiled(&compiled.unwrap_or_else(|errors| panic!("{errors}")));
    assert!(text.contains("The kernel reads no texture."), "{text}");
}

/// A kernel with thousands of taps is drawn by their density.
#[test]
fn drawings_have_a_bounded_size() {
    let text = "pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
        let mut sum = Vec4::ZERO;
        for y in -60..=60 {
            for x in -60..=60 {
                sum += color.load(pixel + ivec2(x, y));
            }
        }
        sum
    }";
    let kernel = Kernel::from_text("kernel.rs", text, "k");
    let compiled = kernel.compile(&Settings::new().unroll(Unroll::None));
    let compiled = compiled.unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(texture(&find_footprint(&compiled), "color").taps.len(), 121 * 121);
    let text = draw_compiled(&compiled);
    assert!(text.len() < 1 << 20, "{} bytes", text.len());
    assert!(
        text.contains("14641 reads") && text.contains("darker with more reads"),
        "{text}"
    );
}

#[test]
fn a_small_drawing_is_as_captured() {
    let compiled = Kernel::from_text("kernel.rs", BOX, "k").compile(&Settings::new());
    let drawn = draw_compiled(&compiled.unwrap_or_else(|errors| panic!("{errors}")));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/drawings/box.svg");
    if std::env::var_os("STRAIGHTLINE_BLESS").is_some() {
        std::fs::write(&path, &drawn).expect("a capture is written");
    }
    let captured = std::fs::read_to_string(&path).unwrap_or_default();
    assert_eq!(
        drawn, captured,
        "if it is meant, run STRAIGHTLINE_BLESS=1 cargo test --workspace --test codegen drawing::"
    );
}

/// Checks that every element is closed, attributes are quoted, and text is escaped.
fn check_xml(text: &str) -> Result<(), String> {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        let (before, tag) = rest.split_at(start);
        let entities = before.split('&').skip(1);
        for entity in entities {
            if !["lt;", "gt;", "amp;", "quot;"]
                .iter()
                .any(|known| entity.starts_with(known))
            {
                return Err(format!("`&{entity}`"));
            }
        }
        let end = tag.find('>').ok_or("an open tag")?;
        let (inside, after) = (&tag[1..end], &tag[end + 1..]);
        let name = inside.trim_matches('/').split([' ', '/']).next().unwrap_or_default();
        if inside.contains('<') || inside.matches('"').count() % 2 != 0 {
            return Err(format!("<{inside}>"));
        }
        if inside.starts_with('/') {
            (open.pop() == Some(name)).then_some(()).ok_or(format!("</{name}>"))?;
        } else if !inside.ends_with('/') {
            open.push(name);
        }
        rest = after;
    }
    if text.contains("NaN") || text.contains("inf\"") {
        return Err("a number that is not finite".to_owned());
    }
    (open.is_empty() && rest.trim().is_empty())
        .then_some(())
        .ok_or(format!("{open:?} is not closed"))
}

fn kernel_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<PathBuf> = paths
        .filter(|path| path.extension().is_some_and(|e| e == "rs"))
        .collect();
    paths.sort();
    paths
}

/// Every kernel has a well-formed drawing, the same each time, with as many reads as are counted where no loop or branch is left.
#[test]
fn every_kernel_has_a_drawing() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut kernels: Vec<(String, Kernel)> = Vec::new();
    for entry in CATALOGUE {
        let kernel = Kernel::builtin(entry.name);
        kernels.push((
            entry.name.to_owned(),
            kernel.unwrap_or_else(|errors| panic!("{errors}")),
        ));
    }
    for folder in ["examples/gallery", "examples/quads", "kernels/filters"] {
        for path in kernel_files(&root.join(folder)) {
            let kernel = Kernel::from_file(&path, None);
            let kernel = kernel.unwrap_or_else(|errors| panic!("{}: {errors}", path.display()));
            kernels.push((path.display().to_string(), kernel));
        }
    }
    assert!(kernels.len() > 50);
    for (name, kernel) in kernels {
        let compiled = kernel.compile(&Settings::new());
        let compiled = compiled.unwrap_or_else(|errors| panic!("{name}: {errors}"));
        let footprint = find_footprint(&compiled);
        if compiled.counts.basic_blocks == 1 {
            let lanes = if footprint.lanes { 4 } else { 1 };
            let mut reads: BTreeMap<&str, u32> = BTreeMap::new();
            for of in &footprint.textures {
                *reads.entry(&of.texture).or_default() += of.reads / lanes;
            }
            let counted = compiled.counts.reads.iter();
            let textures = |name: &str| compiled.graph.textures.iter().any(|texture| texture.name == name);
            let counted = counted
                .filter(|(name, _)| textures(name))
                .map(|(name, n)| (&**name, *n));
            assert_eq!(reads, counted.collect(), "{name}");
        }
        let text = draw_compiled(&compiled);
        check_xml(&text).unwrap_or_else(|why| panic!("{name}: {why}"));
        assert!(text.len() < 1 << 17, "{name}: {} bytes", text.len());
        assert_eq!(text, draw_compiled(&compiled), "{name}");
    }
}
