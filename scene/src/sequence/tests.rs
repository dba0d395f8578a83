use super::*;

const SIZE: UVec2 = uvec2(96, 54);

fn moved_scene(by: Vec3) -> Scene {
    let mut scene = Scene::from_name("railings").expect("a scene");
    for end in [&mut scene.camera.position, &mut scene.camera.target] {
        *end = (Vec3::from(*end) + by).into();
    }
    scene
}

fn draw_moment(scene: Scene, jitter: Vec2) -> Moment {
    Moment::draw(scene, SIZE, jitter, &PLACES, None).expect("a picture")
}

/// Depths where the pixels' shading samples lie that are not moved.
fn centre_depths(moment: &Moment) -> &Frame<f32> {
    &moment.capture.depth.layers()[PLACES.len()]
}

#[test]
fn in_a_still_what_is_seen_lay_where_the_earlier_frame_was_not_jittered() {
    let (now, then) = (
        draw_moment(moved_scene(Vec3::ZERO), PLACES[1]),
        draw_moment(moved_scene(Vec3::ZERO), PLACES[2]),
    );
    for texel in motion_vectors(&now, &then).expect("motion").texels() {
        assert!((texel.truncate().truncate() + PLACES[2]).length() < 1.0e-4, "{texel}");
        assert!(texel.z.abs() < 1.0e-2, "{texel}");
    }
}

/// A frame of then that is shaded just there shows the surface, at the depth that is foretold, but where it was hidden.
#[test]
fn motion_leads_to_the_same_surface_in_the_earlier_frame() {
    let moves = vec3(0.11, 0.03, -0.08);
    let then = draw_moment(moved_scene(Vec3::ZERO), PLACES[0]);
    let now = draw_moment(moved_scene(moves), PLACES[3]);
    let motion = motion_vectors(&now, &then).expect("motion");
    let (mut farthest, mut inside, mut found) = (0.0f32, 0, 0);
    for k in (0..motion.texels().len()).step_by(61) {
        let texel = motion.texels()[k];
        let way = vec2(texel.x, texel.y);
        let pixel = uvec2(k as u32 % SIZE.x, k as u32 / SIZE.x).as_vec2() + 0.5;
        // In the raster that is not jittered.
        let place = pixel + now.jitter + way + then.jitter;
        let there = place.floor();
        if there.cmplt(Vec2::ZERO).any() || there.cmpge(SIZE.as_vec2()).any() {
            continue;
        }
        let shaded_there = draw_moment(moved_scene(Vec3::ZERO), place - there - 0.5);
        let foretold = centre_depths(&now).texels()[k] + texel.z;
        inside += 1;
        farthest = farthest.max(way.length());
        found += u32::from((centre_depths(&shaded_there).load(there.as_ivec2()) - foretold).abs() <= 0.001 * foretold);
    }
    assert!(farthest > 1.0, "nothing moved by more than {farthest} pixels");
    assert!(inside > 70 && found * 100 > inside * 90, "{found} of {inside} pixels");
}

#[test]
fn a_pixel_that_is_shaded_elsewhere_has_the_motion_of_what_is_seen_there() {
    let (before, after) = (moved_scene(Vec3::ZERO), moved_scene(vec3(0.11, 0.03, -0.08)));
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    let then = draw_moment(before, PLACES[0]);
    for by in [PlacedBy::Depths, PlacedBy::Planes] {
        let placed = Moment::draw(after.clone(), SIZE, PLACES[3], &samples, Some(by)).expect("a picture");
        let found = motion_vectors(&placed, &then).expect("motion");
        let moved = placed.moved_places();
        let mut elsewhere = 0;
        for (layer, place) in samples.iter().copied().chain([PLACES[3]]).enumerate() {
            let shaded_there = draw_moment(after.clone(), place);
            let there = motion_vectors(&shaded_there, &then).expect("motion");
            for k in (0..found.texels().len()).filter(|k| placed.shaded_layer(*k) == layer) {
                assert_eq!(found.texels()[k], there.texels()[k]);
                assert_eq!(placed.capture.color.texels()[k], shaded_there.capture.color.texels()[k]);
                assert_eq!(moved.texels()[k], (place - PLACES[3]).extend(0.0).extend(0.0));
                elsewhere += usize::from(layer < samples.len());
            }
        }
        assert!(elsewhere > 30, "{by:?}: {elsewhere} pixels are shaded elsewhere");
    }
}

/// Colours are kept as differences from the guide where each pixel is shaded.
#[test]
fn a_frame_with_a_guide_keeps_differences() {
    let samples = gbuffer::pattern_offsets("latin4").expect("a pattern");
    let draw = || {
        let scene = moved_scene(Vec3::ZERO);
        Moment::draw(scene, SIZE, PLACES[1], &samples, Some(PlacedBy::Planes)).expect("a picture")
    };
    let plain = draw();
    let guided = draw().with_guide::<Box<dyn std::error::Error>>(&OptionValues::default());
    let guided = guided.expect("a guide");
    let guide = guided.capture.guide.as_ref().expect("a guide");
    for (k, kept) in guided.kept_light().texels().iter().enumerate() {
        let there = guide.layers()[guided.shaded_layer(k)].texels()[k];
        let difference = plain.capture.color.texels()[k] - there.truncate().extend(0.0);
        assert!((*kept - difference).abs().max_element() < 1.0e-6, "{kept} at {k}");
    }
}
