//! The prelude's textures: their names, what they are to a shader, and their methods.

use crate::ir::{Scalar, Texture, TextureKind};

/// A type of the prelude that is bound as a texture.
#[derive(Debug, PartialEq, Eq)]
pub struct TextureType {
    /// Name in the prelude.
    pub name: &'static str,
    /// Kind of texture in the shader.
    pub kind: TextureKind,
    /// `true` if it has the output's size.
    pub framed: bool,
    /// `true` if its texels may be integers.
    pub integers: bool,
    methods: &'static [TextureMethod],
}

/// A method of a texture.
#[derive(Debug, PartialEq, Eq)]
pub struct TextureMethod {
    /// Name of the method.
    pub name: &'static str,
    /// Parameters in order.
    pub params: &'static [Param],
    /// Kind of result.
    pub gives: Gives,
}

/// Parameter of a texture's method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Param {
    /// A texel's coordinate, in integers.
    Coordinate,
    /// A place that a sampler reads at, in floats.
    Place,
    /// The number of a layer.
    Layer,
    /// The number of a sample of a texel.
    Sample,
    /// The number of a level.
    Level,
    /// A level, or what is between two of them.
    Detail,
    /// Difference of the place from that of the next pixel.
    Step(&'static str),
    /// A sampler that filters.
    Filtering,
    /// A sampler that compares.
    Comparing,
    /// The number of a component, a compile-time constant.
    Component,
    /// Reference value of a comparison.
    Reference,
}

impl Param {
    fn name(self) -> &'static str {
        match self {
            Param::Coordinate => "coord",
            Param::Place => "uv",
            Param::Layer => "layer",
            Param::Sample => "sample",
            Param::Level | Param::Detail => "level",
            Param::Step(name) => name,
            Param::Filtering | Param::Comparing => "sampler",
            Param::Component => "component",
            Param::Reference => "reference",
        }
    }
}

/// Result of a texture's method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gives {
    /// A texel.
    Texel,
    /// A number for each of four texels.
    Four,
    /// A number from 0 to 1.
    Share,
    /// Width and height, and depth where there is one.
    Size,
    /// Number of levels or layers.
    Count,
}

const fn method(name: &'static str, params: &'static [Param], gives: Gives) -> TextureMethod {
    TextureMethod { name, params, gives }
}

use Param::{Comparing, Component, Coordinate, Detail, Filtering, Layer, Level, Place, Reference, Sample, Step};

const SIZE: TextureMethod = method("size", &[], Gives::Size);
const LEVELS: TextureMethod = method("levels", &[], Gives::Count);
const LAYERS: TextureMethod = method("layers", &[], Gives::Count);
const LOAD: TextureMethod = method("load", &[Coordinate], Gives::Texel);
const LOAD_LAYER: TextureMethod = method("load", &[Coordinate, Layer], Gives::Texel);
const SAMPLE: TextureMethod = method("sample", &[Filtering, Place], Gives::Texel);
const SAMPLE_LEVEL: TextureMethod = method("sample_level", &[Filtering, Place, Detail], Gives::Texel);
const GATHER: TextureMethod = method("gather", &[Component, Filtering, Place], Gives::Four);
const COMPARE: TextureMethod = method("compare", &[Comparing, Place, Reference], Gives::Share);

/// Every texture of the prelude.
pub const TEXTURES: [TextureType; 10] = [
    TextureType {
        name: "Frame",
        kind: TextureKind::Flat,
        framed: true,
        integers: true,
        methods: &[LOAD, SAMPLE, GATHER, SIZE],
    },
    TextureType {
        name: "FrameLayers",
        kind: TextureKind::Layers,
        framed: true,
        integers: true,
        methods: &[LOAD_LAYER, SIZE],
    },
    TextureType {
        name: "Texture",
        kind: TextureKind::Flat,
        framed: false,
        integers: true,
        methods: &[
            LOAD,
            method("load_level", &[Coordinate, Level], Gives::Texel),
            SAMPLE,
            SAMPLE_LEVEL,
            method(
                "sample_grad",
                &[Filtering, Place, Step("ddx"), Step("ddy")],
                Gives::Texel,
            ),
            GATHER,
            SIZE,
            method("size_of_level", &[Level], Gives::Size),
            LEVELS,
        ],
    },
    TextureType {
        name: "TextureArray",
        kind: TextureKind::Layers,
        framed: false,
        integers: true,
        methods: &[
            LOAD_LAYER,
            method("sample", &[Filtering, Place, Layer], Gives::Texel),
            method("sample_level", &[Filtering, Place, Layer, Detail], Gives::Texel),
            SIZE,
            LAYERS,
            LEVELS,
        ],
    },
    TextureType {
        name: "Texture3D",
        kind: TextureKind::Volume,
        framed: false,
        integers: true,
        methods: &[LOAD, SAMPLE, SAMPLE_LEVEL, SIZE, LEVELS],
    },
    TextureType {
        name: "TextureCube",
        kind: TextureKind::Cube,
        framed: false,
        integers: false,
        methods: &[SAMPLE, SAMPLE_LEVEL, SIZE, LEVELS],
    },
    TextureType {
        name: "Multisampled",
        kind: TextureKind::Multisampled,
        framed: false,
        integers: false,
        methods: &[method("load", &[Coordinate, Sample], Gives::Texel), SIZE],
    },
    TextureType {
        name: "DepthTexture",
        kind: TextureKind::Depth,
        framed: false,
        integers: false,
        methods: &[
            LOAD,
            COMPARE,
            method("gather_compare", &[Comparing, Place, Reference], Gives::Four),
            SIZE,
        ],
    },
    TextureType {
        name: "DepthTextureArray",
        kind: TextureKind::DepthLayers,
        framed: false,
        integers: false,
        methods: &[
            LOAD_LAYER,
            method("compare", &[Comparing, Place, Layer, Reference], Gives::Share),
            SIZE,
            LAYERS,
        ],
    },
    TextureType {
        name: "DepthCube",
        kind: TextureKind::DepthCube,
        framed: false,
        integers: false,
        methods: &[COMPARE, SIZE],
    },
];

impl TextureType {
    /// The one that is called so.
    pub fn from_name(name: &str) -> Option<&'static TextureType> {
        TEXTURES.iter().find(|ty| ty.name == name)
    }

    /// That of a texture.
    pub fn from_texture(texture: &Texture) -> &'static TextureType {
        let found = TEXTURES
            .iter()
            .find(|ty| ty.kind == texture.kind && ty.framed == texture.framed);
        // Interpolated values of quads alone are textures that no kernel declares: they are frames.
        found.unwrap_or(&TEXTURES[0])
    }

    /// A method by its name and the number of its arguments.
    pub fn find_method(&self, name: &str, arguments: usize) -> Option<&'static TextureMethod> {
        let mut methods = self.methods.iter();
        methods.find(|method| method.name == name && method.params.len() == arguments)
    }

    /// A method by its name.
    pub fn method_named(&self, name: &str) -> Option<&'static TextureMethod> {
        self.methods.iter().find(|method| method.name == name)
    }

    /// The methods that it has for texels of a kind, as a list for people.
    pub fn describe_methods(&self, texel: Scalar) -> String {
        let of_kind = |method: &&TextureMethod| texel == Scalar::F32 || !method.is_filtered();
        let methods: Vec<String> = self
            .methods
            .iter()
            .filter(of_kind)
            .map(|m| self.format_method(m))
            .collect();
        match methods.split_last() {
            Some((last, [])) => last.clone(),
            Some((last, others)) => format!("{} and {last}", others.join(", ")),
            None => String::new(),
        }
    }

    /// A method as it is called.
    pub fn format_method(&self, method: &TextureMethod) -> String {
        let names = method.params.iter().map(|param| match param {
            Param::Place if self.kind.is_cube() => "direction",
            Param::Place if self.kind == TextureKind::Volume => "place",
            other => other.name(),
        });
        format!("`{}({})`", method.name, names.collect::<Vec<_>>().join(", "))
    }
}

impl TextureMethod {
    /// Returns whether a sampler filters the texels.
    pub fn is_filtered(&self) -> bool {
        self.params.contains(&Param::Filtering)
    }
}
