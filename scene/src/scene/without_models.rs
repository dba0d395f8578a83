//! Replacement for reading models in a build without it: every attempt is an error that names the feature.

use super::{EXTENSIONS, Scene, SceneError, Viewpoint};
use std::path::Path;

/// Reads no model: that needs the feature `models`.
///
/// # Errors
///
/// [`SceneError::NotBuilt`], or [`SceneError::UnknownExtension`] of what is no model.
pub fn load_scene(path: &Path) -> Result<Scene, SceneError> {
    load_seen(path, &Viewpoint::default())
}

/// As [`load()`].
///
/// # Errors
///
/// As [`load()`].
pub fn load_seen(path: &Path, _viewpoint: &Viewpoint) -> Result<Scene, SceneError> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    let path = path.to_owned();
    Err(match EXTENSIONS.contains(&extension.to_ascii_lowercase().as_str()) {
        true => SceneError::NotBuilt { path },
        false => SceneError::UnknownExtension { path },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_names_the_feature() {
        let text = |name: &str| load(Path::new(name)).err().map(|error| error.to_string());
        assert!(
            text("a/model.GLB").is_some_and(|text| text.contains("model.GLB") && text.contains("--features models"))
        );
        assert!(text("a/model.txt").is_some_and(|text| text.contains("ends with .gltf")));
    }
}
