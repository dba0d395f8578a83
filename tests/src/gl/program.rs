//! A shader with all that it reads.

use straightline_bench::execute::SamplerState;
use straightline_codegen::Format;
use straightline_kernels::prelude::Frame;

/// A shader with all that it reads, to be run by [`Context::run`](super::Context::run).
#[derive(Clone, Debug)]
pub struct Program<'a> {
    /// GLSL that begins with its `#version`.
    pub text: &'a str,
    /// Stage that computes the result.
    pub stage: Stage,
    /// Width and height of the picture.
    pub size: [u32; 2],
    /// Storage format of the picture's texels; 32 bits a component unless stated.
    pub format: Format,
    /// Images that a compute shader writes too, by their bindings.
    pub other_images: Vec<(u32, Format)>,
    /// Location of the value of a fragment shader that the picture shows.
    pub location: u32,
    /// Textures by the names of their samplers.
    pub textures: Vec<Texture>,
    /// Uniforms outside of blocks.
    pub uniforms: Vec<(String, Uniform)>,
    /// Uniform blocks, by the block's name, with the bytes of their `std140` layout.
    pub blocks: Vec<(String, Vec<u8>)>,
    /// Storage buffers.
    pub buffers: Vec<(Place, Vec<u8>)>,
    /// Values that are interpolated over the picture; of fragment shaders only.
    pub varyings: Vec<Varying>,
}

/// The stage of a shader.
#[derive(Clone, Copy, Debug)]
pub enum Stage {
    /// Writes its only `out vec4` for each pixel.
    Fragment,
    /// Writes an `image2D`.
    Compute {
        /// Pixels that one workgroup computes, across and down: its size, times the block of pixels that an invocation computes.
        covered: [u32; 2],
        /// The image's `layout(binding = ...)`.
        image: u32,
    },
}

/// A texture of 32-bit floats, without smaller levels.
#[derive(Clone, Debug)]
pub struct Texture {
    /// Name of the sampler in the text.
    pub name: String,
    /// Width and height.
    pub size: [u32; 2],
    /// Layers of a `sampler2DArray`; `None` for a texture that is no array.
    pub layers: Option<u32>,
    /// Row by row from `y = 0`, layer by layer.
    pub texels: Vec<[f32; 4]>,
    /// State of the sampler. The nearest texel, clamped to the border, unless stated.
    pub sampler: SamplerState,
    /// `true` if it is read through a `sampler2DShadow`: a depth texture of the texels' first components, which are clamped
    /// to 0..=1.
    pub compares: bool,
}

/// Binding of a storage buffer.
#[derive(Clone, Debug)]
pub enum Place {
    /// At the binding that the text states for the block of this name.
    Block(String),
    /// At this binding.
    Binding(u32),
}

/// The value of a uniform: one to four components.
#[derive(Clone, Debug)]
pub enum Uniform {
    /// `float`, `vec2`, ...
    Float(Vec<f32>),
    /// `int`, `ivec2`, ...
    Int(Vec<i32>),
    /// `uint`, `uvec2`, ...
    Uint(Vec<u32>),
}

/// A value that is interpolated over the picture.
#[derive(Clone, Debug)]
pub struct Varying {
    /// Name of the fragment shader's input.
    pub name: String,
    /// Location of `layout(location = ...)`, if the text states one.
    pub location: Option<u32>,
    /// Components, 1 to 4.
    pub components: usize,
    /// Values at three corners of the picture: where x and y are least, where x is greatest, and where y is greatest.
    pub corners: [[f32; 4]; 3],
}

impl<'a> Program<'a> {
    /// A fragment shader, drawn over a picture of `size`.
    pub fn fragment(text: &'a str, size: [u32; 2]) -> Self {
        Self::new(text, size, Stage::Fragment)
    }

    /// A compute shader that writes a picture of `size` to the image at a binding; one workgroup computes `covered` pixels.
    pub fn compute(text: &'a str, size: [u32; 2], covered: [u32; 2], image: u32) -> Self {
        Self::new(text, size, Stage::Compute { covered, image })
    }

    fn new(text: &'a str, size: [u32; 2], stage: Stage) -> Self {
        Program {
            text,
            stage,
            size,
            format: Format::Rgba32Float,
            location: 0,
            other_images: Vec::new(),
            textures: Vec::new(),
            uniforms: Vec::new(),
            blocks: Vec::new(),
            buffers: Vec::new(),
            varyings: Vec::new(),
        }
    }

    /// With a picture of another format; of a compute shader, that which the image's `layout` names.
    pub fn format(mut self, format: Format) -> Self {
        self.format = format;
        self
    }

    /// With another image that a compute shader writes, at a binding.
    pub fn other_image(mut self, binding: u32, format: Format) -> Self {
        self.other_images.push((binding, format));
        self
    }

    /// With the picture that a fragment shader gives at a location.
    pub fn location(mut self, location: u32) -> Self {
        self.location = location;
        self
    }

    /// With a texture.
    pub fn texture(mut self, texture: Texture) -> Self {
        self.textures.push(texture);
        self
    }

    /// With a uniform that is in no block.
    pub fn uniform(mut self, name: &str, value: impl Into<Uniform>) -> Self {
        self.uniforms.push((name.to_owned(), value.into()));
        self
    }

    /// With the bytes of a uniform block.
    pub fn block(mut self, name: &str, bytes: Vec<u8>) -> Self {
        self.blocks.push((name.to_owned(), bytes));
        self
    }

    /// With a storage buffer, by the block's name or its binding.
    pub fn buffer(mut self, place: impl Into<Place>, bytes: Vec<u8>) -> Self {
        self.buffers.push((place.into(), bytes));
        self
    }

    /// With a value that is interpolated.
    pub fn varying(mut self, varying: Varying) -> Self {
        self.varyings.push(varying);
        self
    }
}

impl Texture {
    /// A texture of one image, read texel by texel unless something else is said.
    pub fn new(name: &str, size: [u32; 2], texels: Vec<[f32; 4]>) -> Self {
        Texture {
            name: name.to_owned(),
            size,
            layers: None,
            texels,
            sampler: SamplerState {
                linear: false,
                ..SamplerState::default()
            },
            compares: false,
        }
    }

    /// A texture of one image.
    pub fn image(name: &str, image: &Frame<glam::Vec4>) -> Self {
        let texels = image.texels().iter().map(|texel| texel.to_array());
        Self::new(name, image.size().to_array(), texels.collect())
    }

    /// An array of images, all of the first one's size.
    pub fn array(name: &str, images: &[Frame<glam::Vec4>]) -> Self {
        let size = images.first().map_or([0; 2], |image| image.size().to_array());
        let texels = images.iter().flat_map(Frame::texels).map(|texel| texel.to_array());
        Self::new(name, size, texels.collect()).layers(images.len() as u32)
    }

    /// As a `sampler2DArray` of so many layers.
    pub fn layers(mut self, layers: u32) -> Self {
        self.layers = Some(layers);
        self
    }

    /// Sampled in this way; its comparison is that of a `sampler2DShadow`.
    pub fn sampler(mut self, state: SamplerState) -> Self {
        self.sampler = state;
        self
    }

    /// As a `sampler2DShadow`, which compares by the sampler's comparison.
    pub fn compares(mut self) -> Self {
        self.compares = true;
        self
    }
}

impl From<&str> for Place {
    fn from(name: &str) -> Self {
        Place::Block(name.to_owned())
    }
}

impl From<u32> for Place {
    fn from(binding: u32) -> Self {
        Place::Binding(binding)
    }
}

macro_rules! uniforms {
    ($($component:ty => $variant:ident),*) => {$(
        impl From<$component> for Uniform {
            fn from(value: $component) -> Self {
                Uniform::$variant(vec![value])
            }
        }

        impl<const N: usize> From<[$component; N]> for Uniform {
            fn from(components: [$component; N]) -> Self {
                Uniform::$variant(components.into())
            }
        }
    )*};
}

uniforms!(f32 => Float, i32 => Int, u32 => Uint);
