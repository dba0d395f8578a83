//! The kernel as rustc compiles it.

use super::options::Options;
use glam::{UVec2, Vec3, ivec2, vec2};
use straightline_bench::execute::Inputs;
use straightline_kernels::prelude::{Buffer, Frame, FrameLayers, Multisampled, Texture, Vec4};
use straightline_kernels::sraa::{
    Colors, Demodulate, Depth, Difference, Estimate, Falloff, GBuffer, Guards, Guide, History, Layout, Mask, Metric,
    NonFinite, Normalisation, Normals, Pattern, Plane, Projection, Resolve, Search, Shading, Sraa, Turn, Variation,
    View, sraa,
};

/// Every pixel, by the native kernel.
pub fn run(options: &Options, inputs: &Inputs) -> Vec<[f32; 4]> {
    let (cfg, gbuffer, view, colors) = (config(options), gbuffer(inputs), view(inputs), colors(inputs));
    let history = history(inputs);
    let size = inputs.size.as_ivec2();
    let pixels = (0..size.y).flat_map(|y| (0..size.x).map(move |x| ivec2(x, y)));
    pixels
        .map(|pixel| sraa(&cfg, &gbuffer, &view, &colors, &history, pixel).to_array())
        .collect()
}

/// The kernel's own options.
pub fn config(options: &Options) -> Sraa {
    let mut cfg = Sraa::default();
    for (name, value) in options {
        set(&mut cfg, name, value);
    }
    cfg
}

macro_rules! one_of {
    ($value:expr, $ty:ident: $($text:literal => $variant:ident),*) => {
        match $value { $( $text => $ty::$variant, )* other => panic!("no value `{other}`") }
    };
}

fn set(cfg: &mut Sraa, name: &str, value: &str) {
    match name {
        "pattern" => {
            cfg.pattern = one_of!(value, Pattern: "ordered4" => Ordered4, "latin4" => Latin4, "standard8" => Standard8,
                "ordered16" => Ordered16, "latin16" => Latin16, "standard16" => Standard16, "listed" => Listed);
        }
        "offsets" => cfg.offsets = leaked(value, |text| text.parse().ok()),
        "latin" => cfg.latin = value == "true",
        "shading" => {
            cfg.shading = one_of!(value, Shading: "sample0" => Sample0, "centre" => Centre, "listed" => Listed,
                "placed" => Placed);
        }
        "shaded" => cfg.shaded = leaked(value, |text| text.parse().ok()),
        "metric" => {
            cfg.metric = one_of!(value, Metric: "planes-normals" => PlanesNormals, "depth-normals" => DepthNormals,
                "normals" => Normals, "depth" => Depth);
        }
        "difference" => {
            cfg.difference = one_of!(value, Difference: "absolute" => Absolute, "relative" => Relative);
        }
        "projection" => {
            cfg.projection = one_of!(value, Projection: "perspective" => Perspective, "parallel" => Parallel);
        }
        "depth" => {
            cfg.depth = one_of!(value, Depth: "linear" => Linear, "perspective" => Perspective, "reversed" => Reversed,
                "reversed-infinite" => ReversedInfinite);
        }
        "normals" => {
            cfg.normals = one_of!(value, Normals: "float" => Float, "unorm" => Unorm, "octahedral" => Octahedral,
                "packed" => Packed);
        }
        "layout" => {
            cfg.layout = one_of!(value, Layout: "layers" => Layers, "superresolution" => Superresolution,
                "multisampled" => Multisampled, "split" => Split);
        }
        "falloff" => cfg.falloff = one_of!(value, Falloff: "none" => None, "tent" => Tent, "gaussian" => Gaussian),
        "normalisation" => {
            cfg.normalisation = one_of!(value, Normalisation: "paper" => Paper, "epsilon" => Epsilon,
                "shifted" => Shifted);
        }
        "resolve" => {
            cfg.resolve = one_of!(value, Resolve: "box" => Box, "tent" => Tent, "gaussian" => Gaussian,
                "mitchell" => Mitchell, "lanczos" => Lanczos)
        }
        "extra" => cfg.extra = value == "true",
        "search" => cfg.search = one_of!(value, Search: "none" => None, "five" => Five, "seven" => Seven),
        "search-threshold" => cfg.search_threshold = number(value),
        "unseen" => cfg.unseen = number(value),
        "demodulate" => {
            cfg.demodulate =
                one_of!(value, Demodulate: "none" => None, "albedo" => Albedo, "albedo-shadow" => AlbedoShadow);
        }
        "history" => cfg.history = value.parse().expect("a number"),
        "albedo-floor" => cfg.albedo_floor = number(value),
        "unseen-floor" => cfg.unseen_floor = number(value),
        "rest" => cfg.rest = value == "true",
        "guide" => cfg.guide = one_of!(value, Guide: "none" => None, "add" => Add),
        "fitted" => cfg.fitted = value == "true",
        "estimate" => {
            cfg.estimate = one_of!(value, Estimate: "given" => Given, "diffuse" => Diffuse, "emissive" => Emissive);
        }
        "mask" => cfg.mask = one_of!(value, Mask: "none" => None, "select" => Select, "branch" => Branch),
        "variation" => cfg.variation = one_of!(value, Variation: "around" => Around, "within" => Within),
        "guards" => cfg.guards = one_of!(value, Guards: "inline" => Inline, "fallback" => Fallback, "none" => None),
        "turn" => cfg.turn = one_of!(value, Turn: "cosine" => Cosine, "chord" => Chord),
        "renormalise" => cfg.renormalise = value == "true",
        "non-finite" => cfg.non_finite = one_of!(value, NonFinite: "spread" => Spread, "skip" => Skip),
        "tau" => cfg.tau = number(value),
        "depth-scale" => cfg.depth_scale = number(value),
        "radius" => cfg.radius = number(value),
        "resolve-radius" => cfg.resolve_radius = number(value),
        "plane" => cfg.plane = one_of!(value, Plane: "sample" => Sample, "tap" => Tap),
        "sharpness" => cfg.sharpness = number(value),
        "sigma" => cfg.sigma = number(value),
        "mask-threshold" => cfg.mask_threshold = number(value),
        "mask-step" => cfg.mask_step = number(value),
        other => panic!("no option `{other}`"),
    }
}

fn number(text: &str) -> f32 {
    text.parse().unwrap_or_else(|_| panic!("`{text}` is no number"))
}

/// Options are data of the program; those of a test are made up as it goes.
fn leaked<T>(text: &str, parse: impl Fn(&str) -> Option<T>) -> &'static [T] {
    let parts = text.split(',').map(|part| parse(part).expect("a number"));
    Vec::leak(parts.collect())
}

/// G-buffer of the inputs that are present.
pub fn gbuffer(inputs: &Inputs) -> GBuffer {
    let mut gbuffer = GBuffer::unread();
    for (name, images) in &inputs.images {
        let first = &images[0];
        match name.as_str() {
            "depth" => gbuffer.depth = FrameLayers::new(images.iter().map(first_of).collect()),
            "normal" => gbuffer.normal = FrameLayers::new(images.clone()),
            "packed" => gbuffer.packed = FrameLayers::new(images.clone()),
            "depth_grid" => gbuffer.depth_grid = scalars(first),
            "normal_grid" => gbuffer.normal_grid = texture(first),
            "packed_grid" => gbuffer.packed_grid = texture(first),
            "depth_samples" => gbuffer.depth_samples = Multisampled::new(images.iter().map(scalars).collect()),
            "normal_samples" => gbuffer.normal_samples = Multisampled::new(images.iter().map(texture).collect()),
            "packed_samples" => gbuffer.packed_samples = Multisampled::new(images.iter().map(texture).collect()),
            "centre_depth" => gbuffer.centre_depth = first_of(first),
            "centre_normal" => gbuffer.centre_normal = first.clone(),
            "centre_packed" => gbuffer.centre_packed = first.clone(),
            _ => {}
        }
    }
    if let Some((_, elements)) = inputs.buffers.iter().find(|(known, _)| known == "depth_buffer") {
        gbuffer.depth_buffer = Buffer::new(elements.iter().map(|element| element[0] as f32).collect());
    }
    gbuffer
}

fn colors(inputs: &Inputs) -> Colors {
    let images = |name: &str| {
        let found = inputs.images.iter().find(|(known, _)| known == name);
        found.map(|(_, images)| images.clone()).expect("colours are there")
    };
    let mut colors = Colors {
        color: images("color").remove(0),
        colors: FrameLayers::new(images("colors")),
        place: numbers(inputs, "place"),
        extra: numbers(inputs, "extra"),
        ..Colors::unread()
    };
    for (name, images) in &inputs.images {
        let first = &images[0];
        match name.as_str() {
            "albedo" => colors.albedo = FrameLayers::new(images.clone()),
            "albedo_grid" => colors.albedo_grid = texture(first),
            "albedo_samples" => colors.albedo_samples = Multisampled::new(images.iter().map(texture).collect()),
            "centre_albedo" => colors.centre_albedo = first.clone(),
            "direct" => colors.direct = first.clone(),
            "rest" => colors.rest = first.clone(),
            "extra_color" => colors.extra_color = first.clone(),
            "extra_direct" => colors.extra_direct = first.clone(),
            "extra_rest" => colors.extra_rest = first.clone(),
            "guide_mean" => colors.guide_mean = first.clone(),
            _ => {}
        }
    }
    colors
}

/// Earlier frames, if there are any.
fn history(inputs: &Inputs) -> History {
    let mut history = History::unread();
    for (name, images) in &inputs.images {
        let layers = FrameLayers::new(images.clone());
        match name.as_str() {
            "history_color" => history.history_color = layers,
            "history_rest" => history.history_rest = layers,
            "history_surface" => history.history_surface = layers,
            "history_motion" => history.history_motion = layers,
            "history_place" => history.history_place = layers,
            _ => {}
        }
    }
    if let Some((_, lanes)) = inputs.uniforms.iter().find(|(known, _)| known == "jitter") {
        history.jitter = vec2(lanes[0] as f32, lanes[1] as f32);
    }
    history
}

/// An image of numbers, as where each pixel is shaded; if there is none, a texel that is not read.
pub fn numbers(inputs: &Inputs, name: &str) -> Frame<u32> {
    match inputs.integers.iter().find(|(known, _)| known == name) {
        Some((_, images)) => Frame::new(images[0].size(), images[0].texels().iter().map(|t| t.x).collect()),
        None => Frame::new(UVec2::ONE, vec![0]),
    }
}

/// The view's numbers.
pub fn view(inputs: &Inputs) -> View {
    let lanes = |name: &str| {
        let found = inputs.uniforms.iter().find(|(known, _)| known == name);
        found.map(|(_, lanes)| lanes.clone()).expect("the view is there")
    };
    let vector = |name: &str| Vec3::from_slice(&lanes(name).iter().map(|lane| *lane as f32).collect::<Vec<_>>());
    let origin = lanes("origin");
    View {
        ray_corner: vector("ray_corner"),
        ray_right: vector("ray_right"),
        ray_down: vector("ray_down"),
        ray_forward: vector("ray_forward"),
        origin: ivec2(origin[0] as i32, origin[1] as i32),
        near: lanes("near")[0] as f32,
        far: lanes("far")[0] as f32,
    }
}

fn first_of(image: &Frame<Vec4>) -> Frame<f32> {
    Frame::new(image.size(), image.texels().iter().map(|t| t.x).collect())
}

fn scalars(image: &Frame<Vec4>) -> Texture<f32> {
    Texture::new(image.size(), image.texels().iter().map(|t| t.x).collect())
}

fn texture(image: &Frame<Vec4>) -> Texture<Vec4> {
    Texture::new(image.size(), image.texels().to_vec())
}
