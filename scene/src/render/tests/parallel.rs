//! A parallel projection, by both renderers.

use super::*;
use crate::scene::Camera;
use glam::vec3;

/// The floor seen downwards at 45°, 8 units from the upper to the lower edge of the picture.
fn floor_from_above() -> Scene {
    let corners = [
        [-40.0, 0.0, 20.0],
        [40.0, 0.0, 20.0],
        [40.0, 0.0, -60.0],
        [-40.0, 0.0, -60.0],
    ];
    Scene {
        camera: Camera {
            position: [0.0, 10.0, 0.0],
            target: [0.0, 0.0, -10.0],
            up: [0.0, 1.0, 0.0],
            vertical_fov: 0.0,
            parallel_height: Some(8.0),
            near: 0.1,
        },
        ..plane_scene(corners, [0.0, 1.0, 0.0])
    }
}

#[test]
fn depth_is_linear_on_the_screen() {
    let size = uvec2(61, 37);
    let pixel_size = 8.0 / size.y as f32;
    for renderer in both_renderers(&floor_from_above(), size) {
        for offset in [Vec2::ZERO, vec2(0.375, -0.25)] {
            let (depth, normal) = renderer.draw_geometry(offset).expect("geometry");
            for pixel in pixels(size) {
                // The floor recedes by a unit of depth for each unit upwards in the picture.
                let up = (0.5 * size.y as f32 - (pixel.y as f32 + 0.5 + offset.y)) * pixel_size;
                // The floor is hit 10 √2 ahead of the camera in the middle.
                let expected = 200.0_f32.sqrt() + up;
                let z = depth.load(pixel);
                assert!(
                    (z - expected).abs() < 0.1 * pixel_size,
                    "{pixel} {offset}: {z} for {expected}"
                );
                let towards = normal.load(pixel).dot(vec3(0.0, 0.5_f32.sqrt(), 0.5_f32.sqrt()));
                assert!((towards - 1.0).abs() < 1.0e-5, "{pixel}: {}", normal.load(pixel));
            }
        }
    }
}

#[test]
fn what_is_before_the_near_plane_or_beyond_the_far_one_is_not_there() {
    let mut scene = floor_from_above();
    scene.camera.near = 200.0_f32.sqrt();
    for renderer in both_renderers(&scene, uvec2(16, 16)) {
        let (depth, _) = renderer.draw_geometry(Vec2::ZERO).expect("geometry");
        let sky: Vec<bool> = depth
            .texels()
            .chunks(16)
            .map(|row| row.iter().all(|z| *z == SKY_DEPTH))
            .collect();
        assert_eq!(sky, [[false; 8], [true; 8]].concat(), "the lower half is too near");
    }
    // The far plane is a thousand heights away.
    scene.camera.parallel_height = Some(0.01);
    scene.camera.near = 1.0;
    for renderer in both_renderers(&scene, uvec2(4, 4)) {
        let (depth, _) = renderer.draw_geometry(Vec2::ZERO).expect("geometry");
        assert!(depth.texels().iter().all(|z| *z == SKY_DEPTH), "{depth:?}");
    }
}

/// By planes, ground that recedes is one surface, so no pixel of it is moved.
#[test]
fn shading_is_placed_by_planes() {
    let scene = Scene::from_name("isometric").expect("a scene");
    let renderer = CpuRenderer::new(&scene, uvec2(160, 90)).expect("a renderer");
    let samples = crate::gbuffer::pattern_offsets("latin4").expect("a pattern");
    let moved = |renderer: &dyn Renderer| {
        let capture = capture_placed(renderer, &samples, PlacedBy::Planes).expect("a capture");
        let place = capture.place.expect("places");
        place
            .texels()
            .iter()
            .filter(|layer| **layer < samples.len() as u32)
            .count()
    };
    let found = moved(&renderer);
    assert!((20..2000).contains(&found), "{found} of 14400 pixels are moved");
    let floor = CpuRenderer::new(&floor_from_above(), uvec2(160, 90)).expect("a renderer");
    assert_eq!(moved(&floor), 0);
}
