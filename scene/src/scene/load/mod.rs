//! Reading models made elsewhere.

mod accessor;
mod assemble;
mod gltf;
mod obj;
mod parse;
mod surface;
mod texture;

use super::{Camera, Scene, SceneError, Sky, Sun, Viewpoint};
use glam::Vec3;
use std::path::Path;
use straightline_files as files;

/// Most triangles that are read from a file.
pub const MAX_TRIANGLES: usize = 1 << 25;

/// Reads a model, by the extension of `path`: glTF 2.0 (`gltf` with the files that it names, or `glb`) or Wavefront OBJ
/// (with its material libraries). Upper or lower case.
///
/// - Every triangle of the default scene is read, at its node's place; skins, morph targets and animations are not applied,
///   points and lines not drawn.
/// - A surface's colour is the base colour (`Kd` in OBJ, taken as linear) times the vertices' own, times the base colour
///   texture (PNG or JPEG), filtered, which repeats. Where the texture's alpha is below glTF's cutoff, or one half of what
///   is blended there and of OBJ (the alpha of `map_Kd`, or the brightness of `map_d`), there is a hole: nothing is drawn
///   half transparent.
/// - Missing normals are made: the faces' own for glTF, as it asks, and for OBJ smoothed across edges of less than 55°.
/// - The model is moved and scaled so that its bounding box is centred on the origin and has a diagonal of 10 units, so
///   that steps between its surfaces are of the size that filters expect; and the camera has the whole box in a picture
///   that is not higher than wide.
///
/// # Errors
///
/// [`SceneError`] names the file and what is wrong with it. Nothing in a file makes this panic.
pub fn load_scene(path: &Path) -> Result<Scene, SceneError> {
    load_seen(path, &Viewpoint::default())
}

/// [`load_scene()`], seen from elsewhere. The viewpoint is in the file's own world space, before the model is moved and scaled.
///
/// # Errors
///
/// As [`load_scene()`], and [`SceneError::Unusable`] for a viewpoint from which nothing can be seen.
pub fn load_seen(path: &Path, viewpoint: &Viewpoint) -> Result<Scene, SceneError> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    let (parts, textures) = match extension.to_ascii_lowercase().as_str() {
        "gltf" | "glb" => gltf::read_gltf(path)?,
        "obj" => obj::read_obj(path)?,
        _ => return Err(SceneError::UnknownExtension { path: path.to_owned() }),
    };
    let malformed = |problem| SceneError::Malformed {
        path: path.to_owned(),
        problem,
    };
    let mesh = assemble::assemble_parts(parts).map_err(malformed)?;
    if mesh.triangles.is_empty() {
        return Err(SceneError::NoTriangles { path: path.to_owned() });
    }
    let bounds = mesh.bounds();
    let scene = Scene {
        vertices: mesh.vertices,
        triangles: mesh.triangles,
        textures,
        sun: Sun {
            direction: Vec3::new(0.35, 0.75, 0.55).normalize().into(),
            color: [0.75, 0.71, 0.64],
        },
        sky: Sky {
            zenith: [0.17, 0.29, 0.50],
            horizon: [0.55, 0.64, 0.72],
            ground: [0.16, 0.14, 0.12],
            haze: 0.0,
        },
        environment: Default::default(),
        lamps: Vec::new(),
        shades: Vec::new(),
        camera: viewpoint.camera(
            |fov| Camera::framing(bounds[0], bounds[1], fov),
            |point| mesh.place.to_scene(point),
        ),
    };
    scene.check()?;
    Ok(scene)
}

/// Longest file of a model that is read, in bytes: it, its buffers, its materials and its textures each.
const MAX_BYTES: u64 = 1 << 32;

fn read_file(path: &Path) -> Result<Vec<u8>, SceneError> {
    files::read_file(path, MAX_BYTES).map_err(|source| SceneError::Io {
        path: path.to_owned(),
        source,
    })
}

#[cfg(test)]
mod tests;
