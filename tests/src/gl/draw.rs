//! Binds what a program reads, runs it, and reads the picture back.

use super::link::link;
use super::program::{Place, Program, Stage, Texture, Uniform};
use glow::HasContext;
use straightline_bench::execute::{Address, Comparison};
use straightline_codegen::Format;
use straightline_manifest::Component;

/// The picture that a program computes. The context must be current.
pub fn run(gl: &glow::Context, program: &Program<'_>) -> Result<Vec<[f32; 4]>, String> {
    let mut objects = Objects { gl, all: Vec::new() };
    let linked = link(&mut objects, program)?;
    // SAFETY: see the module.
    unsafe { gl.use_program(Some(linked)) };
    for (unit, texture) in (0..).zip(&program.textures) {
        bind_texture(&mut objects, program.text, linked, unit, texture)?;
    }
    for (name, value) in &program.uniforms {
        set_uniform(gl, program.text, linked, name, value)?;
    }
    for (slot, (name, bytes)) in (0..).zip(&program.blocks) {
        require_name(program.text, name)?;
        // SAFETY: see the module.
        let index = unsafe { gl.get_uniform_block_index(linked, name) };
        if let Some(index) = index {
            // SAFETY: see the module.
            unsafe { gl.uniform_block_binding(linked, index, slot) };
            bind_buffer(&mut objects, glow::UNIFORM_BUFFER, slot, bytes)?;
        }
    }
    for (place, bytes) in &program.buffers {
        let binding = binding_of(program.text, place)?;
        bind_buffer(&mut objects, glow::SHADER_STORAGE_BUFFER, binding, bytes)?;
    }
    describe(gl, "binding the inputs")?;
    picture(&mut objects, program)
}

/// Runs the program in use over a picture of its own, and reads that back.
fn picture(objects: &mut Objects<'_>, program: &Program<'_>) -> Result<Vec<[f32; 4]>, String> {
    let gl = objects.gl;
    let [width, height] = program.size.map(|side| side as i32);
    let (target, framebuffer, vertices) = (objects.texture()?, objects.framebuffer()?, objects.vertex_array()?);
    let format = internal(program.format);
    let mut others = Vec::new();
    for (_, format) in &program.other_images {
        let texture = objects.texture()?;
        // SAFETY: see the module.
        unsafe {
            gl.active_texture(glow::TEXTURE0 + program.textures.len() as u32);
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            gl.tex_storage_2d(glow::TEXTURE_2D, 1, internal(*format), width, height);
        }
        others.push(texture);
    }
    let attachment = glow::COLOR_ATTACHMENT0 + program.location;
    // SAFETY: see the module.
    let status = unsafe {
        // A unit that no input is on, so that binding the target takes none away.
        gl.active_texture(glow::TEXTURE0 + program.textures.len() as u32);
        gl.bind_texture(glow::TEXTURE_2D, Some(target));
        gl.tex_storage_2d(glow::TEXTURE_2D, 1, format, width, height);
        gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
        gl.framebuffer_texture_2d(glow::FRAMEBUFFER, attachment, glow::TEXTURE_2D, Some(target), 0);
        // Of all that a fragment shader gives, the one at this location.
        let mut drawn = vec![glow::NONE; program.location as usize];
        drawn.push(attachment);
        gl.draw_buffers(&drawn);
        gl.read_buffer(attachment);
        gl.check_framebuffer_status(glow::FRAMEBUFFER)
    };
    if status != glow::FRAMEBUFFER_COMPLETE {
        return Err(format!("the driver draws no picture of {}", program.format));
    }
    // SAFETY: see the module.
    unsafe {
        gl.viewport(0, 0, width, height);
        gl.disable(glow::DITHER);
        if program.format.component_type() == Component::Float {
            gl.clear_color(0.0, 0.0, 0.0, 0.0);
            gl.clear(glow::COLOR_BUFFER_BIT);
        }
        match program.stage {
            Stage::Fragment => {
                gl.bind_vertex_array(Some(vertices));
                gl.draw_arrays(glow::TRIANGLES, 0, 3);
            }
            Stage::Compute { covered, image } => {
                gl.bind_image_texture(image, Some(target), 0, false, 0, glow::WRITE_ONLY, format);
                for ((binding, format), texture) in program.other_images.iter().zip(&others) {
                    gl.bind_image_texture(
                        *binding,
                        Some(*texture),
                        0,
                        false,
                        0,
                        glow::WRITE_ONLY,
                        internal(*format),
                    );
                }
                let [x, y] = [0, 1].map(|k| program.size[k].div_ceil(covered[k].max(1)));
                gl.dispatch_compute(x, y, 1);
                gl.memory_barrier(glow::ALL_BARRIER_BITS);
            }
        }
    }
    describe(gl, "running it")?;
    let texels = program.size.map(|side| side as usize).iter().product::<usize>();
    let picture = match program.format {
        // ES reads what is not float as bytes only.
        Format::Rgba8Unorm => {
            let bytes = read(gl, program.size, glow::RGBA, glow::UNSIGNED_BYTE, texels * 4);
            bytes.iter().map(|byte| f32::from(*byte) / 255.0).collect()
        }
        format => {
            let (layout, ty) = match format.component_type() {
                Component::Float => (glow::RGBA, glow::FLOAT),
                Component::Uint => (glow::RGBA_INTEGER, glow::UNSIGNED_INT),
                Component::Sint => (glow::RGBA_INTEGER, glow::INT),
            };
            let bytes = read(gl, program.size, layout, ty, texels * 16);
            let components = bytes.chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]]);
            components
                .map(|b| match format.component_type() {
                    Component::Float => f32::from_ne_bytes(b),
                    Component::Uint => u32::from_ne_bytes(b) as f32,
                    Component::Sint => i32::from_ne_bytes(b) as f32,
                })
                .collect::<Vec<f32>>()
        }
    };
    describe(gl, "reading the picture back")?;
    Ok(picture.chunks_exact(4).map(|c| [c[0], c[1], c[2], c[3]]).collect())
}

/// A format as OpenGL numbers it.
fn internal(format: Format) -> u32 {
    match format {
        Format::Rgba8Unorm => glow::RGBA8,
        Format::Rgba16Float => glow::RGBA16F,
        Format::Rgba32Float => glow::RGBA32F,
        Format::R32Float => glow::R32F,
        Format::Rg32Float => glow::RG32F,
        Format::R32Uint => glow::R32UI,
        Format::Rg32Uint => glow::RG32UI,
        Format::Rgba32Uint => glow::RGBA32UI,
        Format::R32Sint => glow::R32I,
        Format::Rg32Sint => glow::RG32I,
        Format::Rgba32Sint => glow::RGBA32I,
    }
}

/// The bytes of the framebuffer's texels, which are so many.
fn read(gl: &glow::Context, [width, height]: [u32; 2], layout: u32, ty: u32, length: usize) -> Vec<u8> {
    let mut bytes = vec![0; length];
    let pixels = glow::PixelPackData::Slice(Some(&mut bytes));
    // SAFETY: four components of `ty` a texel are as many bytes as there are; rows of them need no padding to 4 bytes.
    unsafe { gl.read_pixels(0, 0, width as i32, height as i32, layout, ty, pixels) };
    bytes
}

fn bind_texture(
    objects: &mut Objects<'_>,
    text: &str,
    linked: glow::Program,
    unit: u32,
    texture: &Texture,
) -> Result<(), String> {
    let Texture {
        name,
        size,
        layers,
        texels,
        sampler,
        compares,
    } = texture;
    require_name(text, name)?;
    let gl = objects.gl;
    let [width, height] = size.map(|side| side as i32);
    let needed = size[0] as usize * size[1] as usize * layers.unwrap_or(1) as usize;
    if texels.len() != needed || needed == 0 {
        let layers = layers.map_or(String::new(), |layers| format!(", {layers} layers"));
        return Err(format!(
            "texture `{name}` of {width}x{height}{layers}: expected {needed} texels, found {}",
            texels.len()
        ));
    }
    let filters = "GL_OES_texture_float_linear";
    if sampler.linear && !compares && gl.version().is_embedded && !gl.supported_extensions().contains(filters) {
        return Err(format!(
            "texture `{name}` is filtered, and the driver does not have {filters}"
        ));
    }
    if *compares && layers.is_some() {
        return Err(format!("texture `{name}`: arrays are not compared"));
    }
    let components = if *compares { 1 } else { 4 };
    let components = texels.iter().flat_map(|texel| &texel[..components]);
    let bytes: Vec<u8> = components.flat_map(|component| component.to_ne_bytes()).collect();
    let bytes = glow::PixelUnpackData::Slice(Some(&bytes));
    let (stored, given) = match compares {
        true => (glow::DEPTH_COMPONENT32F, glow::DEPTH_COMPONENT),
        false => (glow::RGBA32F, glow::RGBA),
    };
    let target = match layers {
        Some(_) => glow::TEXTURE_2D_ARRAY,
        None => glow::TEXTURE_2D,
    };
    let made = objects.texture()?;
    // SAFETY: see the module; the slice holds every texel.
    unsafe {
        gl.active_texture(glow::TEXTURE0 + unit);
        gl.bind_texture(target, Some(made));
        match *layers {
            Some(layers) => {
                let depth = layers as i32;
                gl.tex_storage_3d(target, 1, stored, width, height, depth);
                gl.tex_sub_image_3d(target, 0, 0, 0, 0, width, height, depth, given, glow::FLOAT, bytes);
            }
            None => {
                gl.tex_storage_2d(target, 1, stored, width, height);
                gl.tex_sub_image_2d(target, 0, 0, 0, width, height, given, glow::FLOAT, bytes);
            }
        }
        let set = |parameter, value: u32| gl.tex_parameter_i32(target, parameter, value as i32);
        let filter = if sampler.linear { glow::LINEAR } else { glow::NEAREST };
        set(glow::TEXTURE_MIN_FILTER, filter);
        set(glow::TEXTURE_MAG_FILTER, filter);
        let beyond = match sampler.address {
            Address::Clamp => glow::CLAMP_TO_EDGE,
            Address::Repeat => glow::REPEAT,
            Address::Mirror => glow::MIRRORED_REPEAT,
        };
        set(glow::TEXTURE_WRAP_S, beyond);
        set(glow::TEXTURE_WRAP_T, beyond);
        if *compares {
            let comparison = match sampler.comparison {
                Comparison::Less => glow::LESS,
                Comparison::LessEqual => glow::LEQUAL,
                Comparison::Greater => glow::GREATER,
                Comparison::GreaterEqual => glow::GEQUAL,
            };
            set(glow::TEXTURE_COMPARE_MODE, glow::COMPARE_REF_TO_TEXTURE);
            set(glow::TEXTURE_COMPARE_FUNC, comparison);
        }
        let location = gl.get_uniform_location(linked, name);
        gl.uniform_1_i32(location.as_ref(), unit as i32);
    }
    describe(gl, &format!("binding the texture `{name}`"))
}

fn set_uniform(
    gl: &glow::Context,
    text: &str,
    linked: glow::Program,
    name: &str,
    value: &Uniform,
) -> Result<(), String> {
    require_name(text, name)?;
    // SAFETY: see the module. The linker drops what the shader does not use, and then there is no location to set.
    unsafe {
        let location = gl.get_uniform_location(linked, name);
        let at = location.as_ref();
        match value {
            Uniform::Float(v) => match v.len() {
                1 => gl.uniform_1_f32_slice(at, v),
                2 => gl.uniform_2_f32_slice(at, v),
                3 => gl.uniform_3_f32_slice(at, v),
                _ => gl.uniform_4_f32_slice(at, v),
            },
            Uniform::Int(v) => match v.len() {
                1 => gl.uniform_1_i32_slice(at, v),
                2 => gl.uniform_2_i32_slice(at, v),
                3 => gl.uniform_3_i32_slice(at, v),
                _ => gl.uniform_4_i32_slice(at, v),
            },
            Uniform::Uint(v) => match v.len() {
                1 => gl.uniform_1_u32_slice(at, v),
                2 => gl.uniform_2_u32_slice(at, v),
                3 => gl.uniform_3_u32_slice(at, v),
                _ => gl.uniform_4_u32_slice(at, v),
            },
        }
    }
    describe(gl, &format!("setting the uniform `{name}` to {value:?}"))
}

/// Binding of a storage buffer, read from the text, as OpenGL ES cannot move a block to another binding.
fn binding_of(text: &str, place: &Place) -> Result<u32, String> {
    let name = match place {
        Place::Binding(binding) => return Ok(*binding),
        Place::Block(name) => name,
    };
    let declared = text.split([';', '}']).find_map(|statement| {
        let (qualifiers, _) = statement.split_once('{')?;
        qualifiers
            .trim_end()
            .strip_suffix(name.as_str())?
            .trim_end()
            .strip_suffix("buffer")
    });
    let declared = declared.ok_or_else(|| format!("`{name}` is not a buffer of the text:\n{text}"))?;
    let binding = declared.split_once("binding").and_then(|(_, rest)| {
        let number = rest.trim_start().strip_prefix('=')?.trim_start();
        let end = number.find(|c: char| !c.is_ascii_digit())?;
        number[..end].parse().ok()
    });
    binding.ok_or_else(|| format!("the buffer `{name}` states no binding:\n{text}"))
}

fn bind_buffer(objects: &mut Objects<'_>, target: u32, slot: u32, bytes: &[u8]) -> Result<(), String> {
    let buffer = objects.buffer()?;
    // SAFETY: see the module.
    unsafe {
        objects.gl.bind_buffer_base(target, slot, Some(buffer));
        objects.gl.buffer_data_u8_slice(target, bytes, glow::STATIC_DRAW);
    }
    Ok(())
}

/// Refuses a name that the text does not have. One that it has may still be unknown to OpenGL, where the linker dropped it.
fn require_name(text: &str, name: &str) -> Result<(), String> {
    let mut words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    match words.any(|word| word == name) {
        true => Ok(()),
        false => Err(format!("`{name}` is not a name of the text:\n{text}")),
    }
}

/// Returns the errors of OpenGL since the last query.
pub fn describe(gl: &glow::Context, doing: &str) -> Result<(), String> {
    // SAFETY: see the module.
    let error = unsafe { gl.get_error() };
    let name = match error {
        glow::NO_ERROR => return Ok(()),
        glow::INVALID_ENUM => "GL_INVALID_ENUM",
        glow::INVALID_VALUE => "GL_INVALID_VALUE",
        glow::INVALID_OPERATION => "GL_INVALID_OPERATION",
        glow::INVALID_FRAMEBUFFER_OPERATION => "GL_INVALID_FRAMEBUFFER_OPERATION",
        glow::OUT_OF_MEMORY => "GL_OUT_OF_MEMORY",
        _ => "an unknown error",
    };
    // Others may wait behind the first; they are no news for the next program.
    // SAFETY: see the module.
    while unsafe { gl.get_error() } != glow::NO_ERROR {}
    Err(format!("{doing}: {name}"))
}

/// Objects of a context that are deleted when this is dropped.
pub struct Objects<'g> {
    pub gl: &'g glow::Context,
    all: Vec<Object>,
}

enum Object {
    Program(glow::Program),
    Shader(glow::Shader),
    Texture(glow::Texture),
    Buffer(glow::Buffer),
    Framebuffer(glow::Framebuffer),
    VertexArray(glow::VertexArray),
}

impl Objects<'_> {
    fn keep<T: Copy>(&mut self, made: Result<T, String>, object: impl FnOnce(T) -> Object) -> Result<T, String> {
        if let Ok(made) = made {
            self.all.push(object(made));
        }
        made
    }

    pub fn program(&mut self) -> Result<glow::Program, String> {
        // SAFETY: see the module, also for what follows.
        let made = unsafe { self.gl.create_program() };
        self.keep(made, Object::Program)
    }

    pub fn shader(&mut self, stage: u32) -> Result<glow::Shader, String> {
        let made = unsafe { self.gl.create_shader(stage) };
        self.keep(made, Object::Shader)
    }

    fn texture(&mut self) -> Result<glow::Texture, String> {
        let made = unsafe { self.gl.create_texture() };
        self.keep(made, Object::Texture)
    }

    fn buffer(&mut self) -> Result<glow::Buffer, String> {
        let made = unsafe { self.gl.create_buffer() };
        self.keep(made, Object::Buffer)
    }

    fn framebuffer(&mut self) -> Result<glow::Framebuffer, String> {
        let made = unsafe { self.gl.create_framebuffer() };
        self.keep(made, Object::Framebuffer)
    }

    fn vertex_array(&mut self) -> Result<glow::VertexArray, String> {
        let made = unsafe { self.gl.create_vertex_array() };
        self.keep(made, Object::VertexArray)
    }
}

impl Drop for Objects<'_> {
    fn drop(&mut self) {
        // SAFETY: see the module. What is bound of them is unbound as it is deleted.
        unsafe {
            self.gl.use_program(None);
            for object in self.all.drain(..).rev() {
                match object {
                    Object::Program(it) => self.gl.delete_program(it),
                    Object::Shader(it) => self.gl.delete_shader(it),
                    Object::Texture(it) => self.gl.delete_texture(it),
                    Object::Buffer(it) => self.gl.delete_buffer(it),
                    Object::Framebuffer(it) => self.gl.delete_framebuffer(it),
                    Object::VertexArray(it) => self.gl.delete_vertex_array(it),
                }
            }
        }
    }
}
