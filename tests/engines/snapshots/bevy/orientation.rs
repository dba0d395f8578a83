//! Orientation for Bevy 0.19: A mixture of the pixel, the one to its right and the one two rows below.
//!
//! Written by straightline 0.1.0; do not edit. See README.md.

use bevy::core_pipeline::fullscreen_material::{FullscreenMaterial, FullscreenMaterialPlugin};
use bevy::prelude::*;
use bevy::render::extract_component::ExtractComponent;
use bevy::render::render_resource::ShaderType;
use bevy::shader::ShaderRef;

/// Filters what cameras with the component [`Orientation`] render.
pub struct OrientationPlugin;

impl Plugin for OrientationPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins(FullscreenMaterialPlugin::<Orientation>::default());
    }
}

/// Put it on a camera.
#[derive(Component, ExtractComponent, Clone, Copy, ShaderType)]
pub struct Orientation {
    /// Weight of the pixel two rows below.
    pub below: f32,
}

impl Default for Orientation {
    fn default() -> Self {
        Orientation {
            below: 0.5,
        }
    }
}

impl FullscreenMaterial for Orientation {
    fn fragment_shader() -> ShaderRef {
        "shaders/orientation.wgsl".into()
    }
}
