//! Inputs of a kernel: pictures, layers of captures, numbers.

use super::transfer::{self, Transfer};
use super::values;
use crate::args::{Executor, GivenArgs};
use crate::failure::Failure;
use glam::{UVec2, Vec4};
use std::path::Path;
use straightline_bench::execute::{self, Inputs};
use straightline_codegen::ir::{Buffer, Graph, Override, Scalar, Texture, TextureKind, Type, Uniform};
use straightline_codegen::{Compiled, Stage, shorten};
use straightline_kernels::prelude::Frame;
use straightline_scene::picture;

/// Everything that a kernel or a chain takes, by name.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// Name of the kernel or chain.
    pub name: String,
    pub textures: Vec<Texture>,
    /// Values of the host, among them the overrides.
    pub uniforms: Vec<Uniform>,
    /// Overrides, for their ranges.
    pub overrides: Vec<Override>,
    pub buffers: Vec<Buffer>,
}

impl Wanted {
    /// Lists what a kernel takes.
    pub fn by_kernel(compiled: &Compiled) -> Wanted {
        let graph = &compiled.graph;
        Wanted {
            name: compiled.kernel.clone(),
            textures: graph.textures.clone(),
            uniforms: host_values(graph),
            overrides: graph.overrides.clone(),
            buffers: graph.buffers.clone(),
        }
    }
}

/// Reads all inputs on the command line for the kernel in the form in which it runs.
pub fn read_inputs(given: &GivenArgs, stage: Stage, compiled: &Compiled) -> Result<Inputs, Failure> {
    // A compute invocation computes a whole quad, and reads from textures what a fragment shader interpolates.
    let compiled = match (given.executor, stage) {
        (Executor::Gpu, Stage::Fragment) => {
            refuse_varyings(compiled)?;
            std::borrow::Cow::Borrowed(compiled)
        }
        _ => compiled.in_blocks(),
    };
    let wanted = Wanted::by_kernel(&compiled);
    let mut inputs = read_given(given, &wanted)?;
    inputs.size = given.size.or_else(|| output_size(&wanted, &inputs)).ok_or_else(|| {
        Failure::Usage(
            "the output's size is that of a picture, and none is given: say --size, such as 640x360".to_owned(),
        )
    })?;
    if let Some(name) = execute::find_unset_uniform(&compiled, &inputs) {
        return Err(unset_uniform(&compiled.kernel, name));
    }
    Ok(inputs)
}

/// Returns the error for a uniform that was given no value.
pub fn unset_uniform(kernel: &str, name: &str) -> Failure {
    Failure::Usage(format!(
        "the uniform `{name}` of `{kernel}` has no default: add --uniform {name}=VALUE"
    ))
}

/// Reads all inputs on the command line, without a size of the output.
pub fn read_given(given: &GivenArgs, wanted: &Wanted) -> Result<Inputs, Failure> {
    let mut inputs = Inputs::default();
    for text in &given.input {
        let (texture, path) = texture_and_path(wanted, text)?;
        let (path, asked) = transfer::split_transfer(path);
        for path in split_paths(path) {
            match texture.scalar {
                Scalar::F32 => {
                    let transfer = transfer::choose_transfer(asked, texture, path)?;
                    for picture in read_pictures(path, texture, transfer)? {
                        add_picture(&mut inputs.images, texture, picture)?;
                    }
                }
                _ if asked == Some(Transfer::Srgb) => {
                    return Err(Failure::Usage(format!(
                        "the texels of `{}` are integers, read as they are stored: leave `,srgb` out",
                        texture.name
                    )));
                }
                _ => {
                    let picture = picture::read_integers(Path::new(path)).map_err(Failure::from_error)?;
                    add_picture(&mut inputs.integers, texture, picture)?;
                }
            }
        }
    }
    for texture in &wanted.textures {
        complete_texture(&mut inputs, texture)?;
    }
    for (name, text) in &given.uniform {
        let Some(uniform) = wanted.uniforms.iter().find(|u| u.name == *name) else {
            return Err(unknown_input(
                wanted,
                "uniform",
                name,
                wanted.uniforms.iter().map(|u| u.name.as_str()),
            ));
        };
        if inputs.uniforms.iter().any(|(known, _)| known == name) {
            return Err(Failure::Usage(format!("the uniform `{name}` is given twice")));
        }
        let value = values::parse_uniform(name, uniform.ty, text)?;
        let range = wanted
            .overrides
            .iter()
            .find(|of| of.name == *name)
            .and_then(|of| of.range);
        if let Some([low, high]) = range.filter(|[low, high]| !(*low..=*high).contains(&value[0])) {
            return Err(Failure::Usage(format!("`{name}` is {low} to {high}, not {}", value[0])));
        }
        inputs = inputs.with_uniform(name, &value);
    }
    for (name, text) in &given.buffer {
        let Some(buffer) = wanted.buffers.iter().find(|b| b.name == *name) else {
            return Err(unknown_input(
                wanted,
                "buffer",
                name,
                wanted.buffers.iter().map(|b| b.name.as_str()),
            ));
        };
        if inputs.buffers.iter().any(|(known, _)| known == name) {
            return Err(Failure::Usage(format!("the buffer `{name}` is given twice")));
        }
        inputs = inputs.with_buffer(name, values::parse_buffer(name, &buffer.element, text)?);
    }
    Ok(inputs)
}

/// Rejects fragment shaders with interpolated inputs: `run` draws no mesh.
fn refuse_varyings(compiled: &Compiled) -> Result<(), Failure> {
    let Some(varying) = compiled.graph.varyings.first() else {
        return Ok(());
    };
    Err(Failure::Usage(format!(
        "the fragment stage interpolates `{}` over triangles, and `run` draws none: use --stage compute, which reads it from a \
         picture, --input {}=FILE",
        varying.name, varying.name
    )))
}

/// Returns the size of the first picture for a texture that has the output's size, else of the first picture.
fn output_size(wanted: &Wanted, inputs: &Inputs) -> Option<UVec2> {
    let framed = |name: &str| wanted.textures.iter().any(|t| t.framed && t.name == name);
    let sizes = |name: &String, size: Option<UVec2>| size.map(|size| (framed(name), size));
    let images = inputs.images.iter();
    let images = images.filter_map(|(name, layers)| sizes(name, layers.first().map(Frame::size)));
    let integers = inputs.integers.iter();
    let integers = integers.filter_map(|(name, layers)| sizes(name, layers.first().map(Frame::size)));
    let all: Vec<(bool, UVec2)> = images.chain(integers).collect();
    let chosen = all.iter().find(|(framed, _)| *framed).or_else(|| all.first());
    chosen.map(|(_, size)| *size)
}

/// Parses `NAME=FILE` or `FILE`.
fn texture_and_path<'a, 't>(wanted: &'a Wanted, text: &'t str) -> Result<(&'a Texture, &'t str), Failure> {
    let textures = &wanted.textures;
    let names = || textures.iter().map(|t| t.name.as_str());
    if let Some((name, path)) = text.split_once('=') {
        if let Some(texture) = textures.iter().find(|t| t.name == name) {
            return Ok((texture, path));
        }
        if !Path::new(text).exists() {
            return Err(unknown_input(wanted, "texture", name, names()));
        }
    }
    match &textures[..] {
        [only] => Ok((only, text)),
        [] => Err(Failure::Usage(format!(
            "`{}` reads no texture: leave --input out, and say the output's --size",
            wanted.name
        ))),
        _ => Err(Failure::Usage(format!(
            "say which texture `{}` is for, NAME=FILE: `{}` has {}",
            shorten(text),
            wanted.name,
            join_names(names())
        ))),
    }
}

/// Returns the pictures of a file for a texture: the picture itself, or the layer of FILE:LAYER. If the texture takes
/// several, an EXR file of layers without a colour returns all of them.
fn read_pictures(path: &str, texture: &Texture, transfer: Transfer) -> Result<Vec<Frame<Vec4>>, Failure> {
    if !Path::new(path).exists()
        && let Some((file, layer)) = path.rsplit_once(':')
        && file.to_ascii_lowercase().ends_with(".exr")
    {
        return Ok(vec![
            picture::read_layer(Path::new(file), layer).map_err(Failure::from_error)?,
        ]);
    }
    let path = Path::new(path);
    let table = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("cube"));
    if table && texture.kind == TextureKind::Volume {
        return picture::read_cube(path).map_err(Failure::from_error);
    }
    let layers = picture::layer_names(path).map_err(Failure::from_error)?;
    if layers.is_empty() {
        let read = match transfer {
            Transfer::Srgb => picture::read_picture(path),
            Transfer::Linear => picture::read_linear(path),
        };
        return Ok(vec![read.map_err(Failure::from_error)?]);
    }
    if layers.len() > 1 && !takes_several(texture) {
        return Err(Failure::Usage(format!(
            "the texture `{}` takes one layer, and {} has {}: name one, as {}:{}",
            texture.name,
            path.display(),
            join_names(layers.iter().map(String::as_str)),
            path.display(),
            layers.last().map_or("", String::as_str)
        )));
    }
    let read = |layer: &String| picture::read_layer(path, layer).map_err(Failure::from_error);
    layers.iter().map(read).collect()
}

/// Splits a list of files at its commas, unless the whole text names one file.
fn split_paths(text: &str) -> Vec<&str> {
    match text.contains(',') && !Path::new(text).exists() {
        true => text.split(',').collect(),
        false => vec![text],
    }
}

/// Returns whether a texture consists of several pictures.
fn takes_several(texture: &Texture) -> bool {
    texture.kind.is_indexed() || texture.kind.is_cube() || texture.kind == TextureKind::Volume
}

/// Splits a strip of a volume's slices, and rejects faces that do not form a cube.
fn complete_texture(inputs: &mut Inputs, texture: &Texture) -> Result<(), Failure> {
    let Some((name, layers)) = inputs.images.iter_mut().find(|(name, _)| *name == texture.name) else {
        return Ok(());
    };
    let size = layers.first().map_or(UVec2::ZERO, Frame::size);
    if texture.kind == TextureKind::Volume && layers.len() == 1 {
        *layers = picture::slice_strip(&layers[0]).ok_or_else(|| {
            Failure::Usage(format!(
                "one picture of {}x{} is no volume `{name}`: give a .cube table, its slices in order, or a picture of them side by \
                 side, as wide as its height squared",
                size.x, size.y
            ))
        })?;
    }
    if texture.kind.is_cube() && (layers.len() != 6 || size.x != size.y) {
        return Err(Failure::Usage(format!(
            "`{name}` is a cube, and takes six square pictures, +X, -X, +Y, -Y, +Z, -Z, not {} of {}x{}",
            layers.len(),
            size.x,
            size.y
        )));
    }
    Ok(())
}

/// Appends a picture to those of a texture.
fn add_picture<T: Copy>(
    images: &mut Vec<(String, Vec<Frame<T>>)>,
    texture: &Texture,
    picture: Frame<T>,
) -> Result<(), Failure> {
    let name = &texture.name;
    match images.iter_mut().find(|(known, _)| known == name) {
        Some((_, layers)) if takes_several(texture) => {
            if layers[0].size() != picture.size() {
                return Err(Failure::Usage(format!(
                    "the layers of `{name}` have different sizes: {} and {}",
                    layers[0].size(),
                    picture.size()
                )));
            }
            layers.push(picture);
        }
        Some(_) => return Err(Failure::Usage(format!("the texture `{name}` takes one picture"))),
        None => images.push((name.clone(), vec![picture])),
    }
    Ok(())
}

/// Values that a host sets: uniforms, and overrides with their defaults. A boolean is a number.
pub fn host_values(graph: &Graph) -> Vec<Uniform> {
    let overrides = graph.overrides.iter().map(|of| Uniform {
        name: of.name.clone(),
        ty: if of.ty == Type::BOOL { Type::U32 } else { of.ty },
        default: Some(of.default),
        part: None,
    });
    graph.uniforms.iter().cloned().chain(overrides).collect()
}

fn unknown_input<'a>(wanted: &Wanted, what: &str, name: &str, known: impl Iterator<Item = &'a str>) -> Failure {
    Failure::Usage(format!(
        "`{}` has no {what} `{}`; it has {}",
        wanted.name,
        shorten(name),
        join_names(known)
    ))
}

fn join_names<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.collect();
    if names.is_empty() {
        "none".to_owned()
    } else {
        names.join(", ")
    }
}
