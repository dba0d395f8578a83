//! Slanted surfaces with steps between them, slopes, creases and a sky, as a G-buffer sees them.

use super::options::{Options, value, values};
use super::{Random, compiled};
use glam::{UVec2, UVec4, Vec2, Vec3, Vec4, uvec2, vec2, vec3, vec4};
use straightline_bench::execute::Inputs;
use straightline_codegen::Unroll;
use straightline_kernels::prelude::{Frame, FrameLayers};
use straightline_oracle::oracle::SraaParams;
use straightline_scene::capture::{Capture, NormalSpace, ShadingSample};
use straightline_scene::gbuffer;
use straightline_scene::scene::{Camera, SKY_DEPTH};

/// Surfaces sampled where the options of a set say, with random colours.
pub fn capture(options: &Options, size: UVec2, seed: u64) -> Capture {
    let params = SraaParams::from_options(&values(options));
    let params = params.unwrap_or_else(|error| panic!("{error}"));
    let samples: Vec<Vec2> = params
        .sample_offsets()
        .into_iter()
        .map(|[x, y]| vec2(x as f32, y as f32))
        .collect();
    let shading = match value(options, "shading", "centre") {
        "centre" => ShadingSample::Centre,
        "placed" => ShadingSample::Placed,
        _ => ShadingSample::Sample(0),
    };
    let centre = matches!(shading, ShadingSample::Centre | ShadingSample::Placed);
    let mut random = Random(seed);
    let edges = edges(&mut random, size);
    let mut places = samples.clone();
    places.extend(centre.then_some(Vec2::ZERO));
    let layer = |offset: Vec2| -> Vec<(f32, Vec3)> {
        let pixels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| uvec2(x, y)));
        pixels
            .map(|pixel| surface(&edges, pixel.as_vec2() + 0.5 + offset))
            .collect()
    };
    let layers: Vec<Vec<(f32, Vec3)>> = places.iter().map(|place| layer(*place)).collect();
    let depth = layers.iter().map(|l| Frame::new(size, l.iter().map(|s| s.0).collect()));
    let normal = layers.iter().map(|l| Frame::new(size, l.iter().map(|s| s.1).collect()));
    Capture {
        size,
        samples,
        place: (shading == ShadingSample::Placed).then(|| places_of(&mut Random(seed), size, layers.len())),
        shading,
        normal_space: NormalSpace::View,
        camera: Some(Camera {
            position: [0.0; 3],
            target: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
            vertical_fov: 1.0,
            parallel_height: (value(options, "projection", "perspective") == "parallel").then_some(6.0),
            near: 0.1,
        }),
        color: colors(&mut random, size),
        colors: Vec::new(),
        albedo: Some(albedo(&mut Random(seed ^ 0xa1bed0), size, layers.len())),
        direct: Some(colors(&mut Random(seed ^ 0xd1ec7), size)),
        rest: Some(colors(&mut Random(seed ^ 0x4e57), size)),
        guide: Some(albedo(&mut Random(seed ^ 0x6_41de), size, layers.len())),
        depth: FrameLayers::new(depth.collect()),
        normal: Some(FrameLayers::new(normal.collect())),
        reference: None,
    }
}

/// Paint, some of it darker than is divided by, and shadow: hard, but for a penumbra here and there.
fn albedo(random: &mut Random, size: UVec2, layers: usize) -> FrameLayers<Vec4> {
    let texel = |random: &mut Random| {
        let lit = random.choose(&[0.0, 0.0, 1.0, 1.0, 0.3]);
        let mut channel = || (1.1 * random.unit() - 0.1).max(0.0);
        vec4(channel(), channel(), channel(), lit)
    };
    let mut layer = || Frame::new(size, (0..size.x * size.y).map(|_| texel(random)).collect());
    FrameLayers::new((0..layers).map(|_| layer()).collect())
}

/// A layer for each pixel.
fn places_of(random: &mut Random, size: UVec2, layers: usize) -> Frame<u32> {
    let layer = |_| (random.number() % layers as u64) as u32;
    Frame::new(size, (0..size.x * size.y).map(layer).collect())
}

/// Inputs of a shader with these options.
pub fn inputs(options: &Options, size: UVec2, seed: u64) -> Inputs {
    inputs_of(&capture(options, size, seed), options, seed)
}

/// A capture as a renderer leaves it that clears its buffers: where nothing is drawn normals are 0, and depth is `depth` if that is given.
pub fn cleared(mut capture: Capture, depth: Option<f32>) -> Capture {
    let normals = capture.normal.take().expect("normals");
    let bare = |layer: usize| -> Vec<bool> {
        let depths = capture.depth.layers()[layer].texels().iter();
        depths.map(|depth| *depth >= SKY_DEPTH).collect()
    };
    let layers = normals.layers().iter().enumerate().map(|(layer, normals)| {
        let texels = normals.texels().iter().zip(bare(layer));
        Frame::new(
            normals.size(),
            texels.map(|(n, bare)| if bare { Vec3::ZERO } else { *n }).collect(),
        )
    });
    capture.normal = Some(FrameLayers::new(layers.collect()));
    if let Some(depth) = depth {
        let layers = capture.depth.layers().iter().map(|depths| {
            let texels = depths.texels().iter();
            Frame::new(
                depths.size(),
                texels.map(|z| if *z >= SKY_DEPTH { depth } else { *z }).collect(),
            )
        });
        capture.depth = FrameLayers::new(layers.collect());
    }
    capture
}

/// Inputs of a shader with these options, from a capture.
pub fn inputs_of(capture: &Capture, options: &Options, seed: u64) -> Inputs {
    let size = capture.size;
    let compiled = compiled(options, Unroll::Full).unwrap_or_else(|errors| panic!("{options:?}:\n{errors}"));
    let mut alone = compiled.options;
    alone.remove("history");
    alone.remove("extra");
    let inputs = gbuffer::sraa_inputs(capture, &alone).unwrap_or_else(|error| panic!("{options:?}: {error}"));
    let mut random = Random(seed ^ 0x5eed);
    let inputs = inputs.with_layers("colors", (0..4).map(|_| colors(&mut random, size)).collect());
    let inputs = match value(options, "extra", "false") {
        "true" => with_extra(inputs, capture.samples.len(), size, seed),
        _ => inputs,
    };
    match value(options, "history", "0") {
        "0" => inputs,
        _ => with_history(inputs, size, seed),
    }
}

/// With a further shading sample in every second pixel, at any of `samples` samples.
fn with_extra(inputs: Inputs, samples: usize, size: UVec2, seed: u64) -> Inputs {
    let mut random = Random(seed ^ 0xe7_74a5);
    let mut texel = |_| UVec4::new((random.number() % (2 * samples as u64)) as u32, 0, 0, 1);
    let texels = (0..size.x * size.y).map(&mut texel).collect();
    let mut light = || colors(&mut random, size);
    let lights = [light(), light(), light()];
    let [color, direct, rest] = lights;
    inputs
        .with_integers("extra", vec![Frame::new(size, texels)])
        .with_image("extra_color", color)
        .with_image("extra_direct", direct)
        .with_image("extra_rest", rest)
}

/// With four earlier frames of the same surfaces, each moved by some pixels on the whole, and by as much more here and there as to show
/// another surface; one of them by whole pixels. This frame is shaded a little aside.
fn with_history(inputs: Inputs, size: UVec2, seed: u64) -> Inputs {
    let edges = edges(&mut Random(seed), size);
    let mut random = Random(seed ^ 0x0b501e7e);
    let (mut color, mut seen, mut motion, mut place) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut moves = Random(seed ^ 0x91ace);
    let pixels = || (0..size.y).flat_map(|y| (0..size.x).map(move |x| uvec2(x, y)));
    for frame in 0..4 {
        let moved = vec2(4.0 * random.unit() - 2.0, 4.0 * random.unit() - 2.0);
        let moved = if frame == 1 { moved.round() } else { moved };
        // A share of the sky's depth that 32 bits hold.
        let deeper = random.choose(&[0.0, 0.0625, 0.125]);
        color.push(colors(&mut random, size));
        let texel = |pixel: UVec2| {
            let (depth, normal) = surface(&edges, pixel.as_vec2() + 0.5 - moved);
            normal.extend(if depth < SKY_DEPTH { depth + deeper } else { depth })
        };
        seen.push(Frame::new(size, pixels().map(texel).collect()));
        let mut own = |_| match random.unit() < 0.2 {
            true => vec4(
                moved.x + 3.0 * random.unit(),
                moved.y - 9.0 * random.unit(),
                deeper,
                0.0,
            ),
            false => vec4(moved.x, moved.y, deeper, 0.0),
        };
        motion.push(Frame::new(size, pixels().map(&mut own).collect()));
        let mut moved = |_| match moves.unit() < 0.3 {
            true => vec4(moves.unit() - 0.5, moves.unit() - 0.5, 0.0, 0.0),
            false => Vec4::ZERO,
        };
        place.push(Frame::new(size, pixels().map(&mut moved).collect()));
    }
    inputs
        .with_layers("history_color", color)
        .with_layers("history_rest", (0..4).map(|_| colors(&mut random, size)).collect())
        .with_layers("history_surface", seen)
        .with_layers("history_motion", motion)
        .with_layers("history_place", place)
        .with_uniform("jitter", &[-0.125, 0.3125])
}

fn colors(random: &mut Random, size: UVec2) -> Frame<Vec4> {
    let color = |random: &mut Random| vec4(random.unit(), random.unit(), random.unit(), 1.0);
    Frame::new(size, (0..size.x * size.y).map(|_| color(random)).collect())
}

/// The border of a half plane that lies before what is behind it: direction, distance, depth, normal.
type Edge = (Vec2, f32, f32, Vec3);

fn edges(random: &mut Random, size: UVec2) -> Vec<Edge> {
    let mut edge = || {
        let angle = random.unit() * std::f32::consts::TAU;
        let normal = vec3(random.unit() - 0.5, random.unit() - 0.5, 0.3 + random.unit()).normalize();
        (
            Vec2::from_angle(angle),
            random.unit() * size.x as f32 - 0.3 * size.x as f32,
            1.0 + 9.0 * random.unit(),
            normal,
        )
    };
    (0..6).map(|_| edge()).collect()
}

fn surface(edges: &[Edge], at: Vec2) -> (f32, Vec3) {
    let mut found = (SKY_DEPTH, Vec3::Z);
    for (direction, distance, depth, normal) in edges {
        let side = direction.dot(at) - distance;
        if side > 0.0 && *depth < found.0 {
            found = (depth + 0.001 * side, *normal);
        }
    }
    found
}
