use super::*;

const SIZE: UVec2 = uvec2(96, 54);

fn moved(by: Vec3) -> Scene {
    let mut scene = Scene::named("railings").expect("a scene");
    for end in [&mut scene.camera.position, &mut scene.camera.target] {
        *end = (Vec3::from(*end) + by).into();
    }
    scene
}

fn draw(scene: Scene, jitter: Vec2) -> Moment {
    Moment::draw(scene, SIZE, jitter).expect("a picture")
}

#[test]
fn in_a_still_what_is_seen_lay_where_the_earlier_frame_was_not_jittered() {
    let (now, then) = (draw(moved(Vec3::ZERO), PLACES[1]), draw(moved(Vec3::ZERO), PLACES[2]));
    for texel in motion(&now, &then).expect("motion").texels() {
        assert!((texel.truncate().truncate() + PLACES[2]).length() < 1.0e-4, "{texel}");
        assert!(texel.z.abs() < 1.0e-2, "{texel}");
    }
}

/// The surface is there: at the nearest shading sample of then it has the depth that is foretold, but at edges.
#[test]
fn motion_leads_to_the_same_surface_in_the_earlier_frame() {
    let then = draw(moved(Vec3::ZERO), PLACES[0]);
    let now = draw(moved(vec3(0.11, 0.03, -0.08)), PLACES[3]);
    let (motion, mut found, mut inside) = (motion(&now, &then).expect("motion"), 0, 0);
    let mut farthest = 0.0f32;
    for (k, texel) in motion.texels().iter().enumerate() {
        let pixel = uvec2(k as u32 % SIZE.x, k as u32 / SIZE.x).as_vec2() + 0.5;
        let there = (pixel + now.jitter + vec2(texel.x, texel.y)).floor().as_ivec2();
        if there.cmpge(glam::IVec2::ZERO).all() && there.cmplt(SIZE.as_ivec2()).all() {
            let depth = now.depth.texels()[k];
            inside += 1;
            farthest = farthest.max(vec2(texel.x, texel.y).length());
            found += u32::from((then.depth.load(there) - depth - texel.z).abs() <= 0.05 * depth);
        }
    }
    assert!(farthest > 1.0, "nothing moved by more than {farthest} pixels");
    assert!(inside > 4500 && found * 10 > inside * 9, "{found} of {inside} pixels");
}
