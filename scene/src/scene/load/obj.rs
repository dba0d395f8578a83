//! Wavefront OBJ with its material libraries.

use super::assemble::{MeshPart, Normals, Paint};
use super::read_file;
use super::texture::{Library, alpha_cutoff, decode_image};
use crate::scene::{Image, SceneError, Textures};
use glam::{Vec3, vec2, vec3};
use std::cell::RefCell;
use std::path::{Path, PathBuf};
use tobj::{LoadError, Material, Mesh};

/// Colour of faces without a material, or with a material that has no colour: a light grey.
const PLAIN: Vec3 = Vec3::splat(0.6);

const OPTIONS: tobj::LoadOptions = tobj::LoadOptions {
    single_index: true,
    triangulate: true,
    ignore_points: true,
    ignore_lines: true,
};

/// Every object of the file, and its textures.
pub(super) fn read_obj(path: &Path) -> Result<(Vec<MeshPart>, Textures), SceneError> {
    let bytes = read_file(path)?;
    check_faces(path, &bytes)?;
    let base = path.parent().unwrap_or(Path::new(""));
    // The first library that cannot be read; the parser itself forgets which it was.
    let failure = RefCell::new(None);
    let library = |name: &Path| {
        read_library(&base.join(name)).map_err(|(reason, error)| {
            failure.borrow_mut().get_or_insert(error);
            reason
        })?
    };
    let mut rest = bytes.as_slice();
    let loaded = tobj::load_obj_buf(&mut rest, &OPTIONS, library);
    let (models, materials) = loaded.map_err(|error| {
        let read = &bytes[..bytes.len() - rest.len()];
        let line = read.iter().filter(|byte| **byte == b'\n').count();
        SceneError::Malformed {
            path: path.to_owned(),
            problem: format!("in line {line}, or in an object that ends there: {error}"),
        }
    })?;
    if let Some(error) = failure.into_inner() {
        return Err(error);
    }
    // Any error here is the one just returned.
    let materials = materials.unwrap_or_default();
    let mut library = Library::new();
    let part = |model: tobj::Model| {
        let material = model.mesh.material_id.and_then(|id| materials.get(id));
        let paint = read_paint(&model.mesh, material, base, &mut library)?;
        Ok(to_part(model, material, paint))
    };
    let parts: Result<Vec<MeshPart>, SceneError> = models.into_iter().map(part).collect();
    Ok((parts?, library.finish()))
}

/// Reads a material library. Of an error, the second form is worth showing.
fn read_library(path: &Path) -> Result<tobj::MTLLoadResult, (LoadError, SceneError)> {
    let bytes = read_file(path).map_err(|error| (LoadError::OpenFileFailed, error))?;
    check_colours(path, &bytes).map_err(|error| (LoadError::MaterialParseError, error))?;
    match tobj::load_mtl_buf(&mut bytes.as_slice()) {
        Ok(materials) => Ok(Ok(materials)),
        Err(error) => {
            let malformed = SceneError::Malformed {
                path: path.to_owned(),
                problem: error.to_string(),
            };
            Err((error, malformed))
        }
    }
}

/// Most corners of a face. No modelled surface has a polygon of more.
const MAX_CORNERS: usize = 1 << 16;

/// Refuses faces that the parser would take too long for, or compute places beyond any list of.
fn check_faces(path: &Path, bytes: &[u8]) -> Result<(), SceneError> {
    for (at, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        if !matches!(words.next(), Some(b"f" | b"l")) {
            continue;
        }
        let mut corners = 0;
        let digits = |word: &[u8]| {
            word.split(|byte| !byte.is_ascii_digit())
                .map(<[u8]>::len)
                .max()
                .unwrap_or(0)
        };
        for word in words {
            corners += 1;
            if digits(word) > 12 {
                return Err(in_line(path, at, "a corner's number has more than 12 digits"));
            }
        }
        if corners > MAX_CORNERS {
            let problem = format!("a face has {corners} corners, and at most {MAX_CORNERS} are read");
            return Err(in_line(path, at, &problem));
        }
    }
    Ok(())
}

/// Refuses colours of fewer than three numbers, on which the parser panics.
fn check_colours(path: &Path, bytes: &[u8]) -> Result<(), SceneError> {
    let text = String::from_utf8_lossy(bytes);
    for (at, line) in text.split('\n').enumerate() {
        let mut words = line.split_whitespace();
        let Some(name @ ("Ka" | "Kd" | "Ks" | "Ke")) = words.next() else {
            continue;
        };
        let found = words.count();
        if found < 3 {
            return Err(in_line(
                path,
                at,
                &format!("`{name}` takes three numbers, and there are {found}"),
            ));
        }
    }
    Ok(())
}

fn in_line(path: &Path, at: usize, problem: &str) -> SceneError {
    SceneError::Malformed {
        path: path.to_owned(),
        problem: format!("in line {}: {problem}", at + 1),
    }
}

fn to_part(model: tobj::Model, material: Option<&Material>, paint: Option<Paint>) -> MeshPart {
    let vectors = |numbers: &[f32]| -> Vec<Vec3> { numbers.chunks_exact(3).map(Vec3::from_slice).collect() };
    let mesh = &model.mesh;
    MeshPart {
        name: format!("object `{}`", model.name),
        positions: vectors(&mesh.positions),
        normals: match mesh.normals.as_slice() {
            [] => Normals::Smooth,
            normals => Normals::Given(vectors(normals)),
        },
        colors: vertex_colors(mesh, material),
        paint,
        triangles: mesh.indices.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
    }
}

/// Linear colour of each vertex.
fn vertex_colors(mesh: &Mesh, material: Option<&Material>) -> Vec<Vec3> {
    let count = mesh.positions.len() / 3;
    let mut colors = vec![material.and_then(|m| m.diffuse).map_or(PLAIN, Vec3::from); count];
    for (color, own) in colors.iter_mut().zip(mesh.vertex_color.chunks_exact(3)) {
        // A vertex's own colour stands for itself, unless a material is there to be tinted.
        let ground = if material.is_some() { *color } else { Vec3::ONE };
        *color = ground * vec3(own[0], own[1], own[2]);
    }
    colors
}

/// The texture of a material's colour, its holes by its own alpha or by another texture's brightness.
fn read_paint(
    mesh: &Mesh,
    material: Option<&Material>,
    base: &Path,
    library: &mut Library<[Option<PathBuf>; 2]>,
) -> Result<Option<Paint>, SceneError> {
    // Some exporters write the paths of the system that they run on.
    let path = |name: &String| base.join(name.replace('\\', "/"));
    let names = material.map(|m| [&m.diffuse_texture, &m.dissolve_texture]);
    let key = names.map(|names| names.map(|name| name.as_ref().map(path)));
    let Some(key) = key.filter(|key| key.iter().any(Option::is_some) && !mesh.texcoords.is_empty()) else {
        return Ok(None);
    };
    let image = match library.get(&key) {
        Some(image) => image,
        None => add(library, key)?,
    };
    // Here v points up.
    let uvs = mesh.texcoords.chunks_exact(2).map(|uv| vec2(uv[0], 1.0 - uv[1]));
    Ok(Some(library.add_paint(image, uvs.collect())))
}

fn add(library: &mut Library<[Option<PathBuf>; 2]>, key: [Option<PathBuf>; 2]) -> Result<Image, SceneError> {
    let malformed = |path: &PathBuf, problem| SceneError::Malformed {
        path: path.clone(),
        problem,
    };
    let picture = |path: &PathBuf| decode_image(&read_file(path)?).map_err(|problem| malformed(path, problem));
    let [color, holes] = [
        key[0].as_ref().map(picture).transpose()?,
        key[1].as_ref().map(picture).transpose()?,
    ];
    let both = match (color, holes) {
        (Some(color), None) => color,
        (color, Some(holes)) => {
            let mut color = color.unwrap_or_else(|| image::RgbaImage::from_pixel(1, 1, image::Rgba([255; 4])));
            if color.dimensions() != holes.dimensions() {
                let (width, height) = holes.dimensions();
                color = image::imageops::resize(&color, width, height, image::imageops::FilterType::Triangle);
            }
            for (texel, hole) in color.pixels_mut().zip(holes.pixels()) {
                texel.0[3] = hole.0[0];
            }
            color
        }
        (None, None) => unreachable!("a key names a texture"),
    };
    let cutoff = alpha_cutoff(&both);
    let named = key.iter().flatten().next().cloned().unwrap_or_default();
    library
        .add(key, &both, cutoff)
        .map_err(|problem| malformed(&named, problem))
}
