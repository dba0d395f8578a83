//! Light of lamps and of an environment, and the shadows of balls. `shade.wgsl` says the same.

use super::frame::Lighting;
use glam::Vec3;

/// A place of a surface, in world space, with unit vectors of its normal and towards the eye.
pub(super) struct Receiver {
    pub place: Vec3,
    pub normal: Vec3,
    pub view: Vec3,
}

/// Light that reaches the eye: what a white surface scatters, and highlights.
#[derive(Default)]
pub(super) struct Light {
    pub diffuse: Vec3,
    pub specular: Vec3,
}

/// Returns the light of all lamps. `gloss` is the share that is reflected at a cosine of the angle from the normal to halfway
/// between lamp and eye.
pub(super) fn light(lighting: &Lighting, on: &Receiver, shadows: bool, gloss: impl Fn(f32) -> f32) -> Light {
    let mut sum = Light::default();
    let lamps = lighting.lamp_places.iter().zip(&lighting.lamp_colors);
    for (lamp, color) in lamps.take(lighting.counts.x as usize) {
        let towards = lamp.truncate() - on.place;
        let distance = towards.dot(towards);
        let direction = towards * (1.0 / distance.sqrt());
        let mut facing = on.normal.dot(direction).max(0.0) * lamp.w / (lamp.w + distance);
        if shadows {
            facing *= visibility(lighting, on.place, towards, 1.0);
        }
        let halfway = (on.view + direction).normalize();
        sum.diffuse += color.truncate() * facing;
        sum.specular += color.truncate() * (facing * gloss(on.normal.dot(halfway).max(0.0)));
    }
    sum
}

/// Returns 0 if a ball is in the way from `place` to `place + towards * until`, else 1. A ball does not shade its own surface where
/// that faces the light.
pub(super) fn visibility(lighting: &Lighting, place: Vec3, towards: Vec3, until: f32) -> f32 {
    let shades = &lighting.shades[..lighting.counts.y as usize];
    let in_the_way = shades.iter().any(|ball| {
        let centre = ball.truncate() - place;
        let nearest = centre.dot(towards) / towards.dot(towards);
        let beside = centre - towards * nearest;
        nearest > 0.0 && nearest < until && beside.dot(beside) < ball.w
    });
    if in_the_way { 0.0 } else { 1.0 }
}

/// Returns an environment's light on a white surface: spherical harmonics of its normal, up to the second order.
pub(super) fn environment(lighting: &Lighting, n: Vec3) -> Vec3 {
    let basis = [
        1.0,
        n.x,
        n.y,
        n.z,
        n.x * n.y,
        n.y * n.z,
        3.0 * n.z * n.z - 1.0,
        n.x * n.z,
        n.x * n.x - n.y * n.y,
    ];
    let terms = lighting.environment.iter().zip(basis);
    let sum: Vec3 = terms.map(|(factor, value)| factor.truncate() * value).sum();
    sum.max(Vec3::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Lamp, Scene, Shade};
    use glam::{Vec2, uvec2, vec3};

    fn lighting(lamps: Vec<Lamp>, shades: Vec<Shade>) -> Lighting {
        let scene = Scene {
            lamps,
            shades,
            ..Scene::from_name("floor").expect("a scene")
        };
        scene.check().expect("a scene that can be drawn");
        Lighting::new(&scene, uvec2(4, 4))
    }

    fn ball(centre: [f32; 3], radius: f32) -> Shade {
        Shade { centre, radius }
    }

    #[test]
    fn a_ball_shades_what_lies_behind_it_and_not_its_own_lit_side() {
        let lighting = lighting(vec![], vec![ball([0.0, 2.0, 0.0], 0.5)]);
        let sees = |place: Vec3, towards: Vec3, until: f32| visibility(&lighting, place, towards, until);
        assert_eq!(sees(Vec3::ZERO, Vec3::Y, f32::INFINITY), 0.0);
        assert_eq!(sees(vec3(0.49, 0.0, 0.0), Vec3::Y, f32::INFINITY), 0.0);
        assert_eq!(sees(vec3(0.51, 0.0, 0.0), Vec3::Y, f32::INFINITY), 1.0);
        // A lamp between surface and ball, and a ball behind the surface.
        assert_eq!(sees(Vec3::ZERO, Vec3::Y, 1.0), 1.0);
        assert_eq!(sees(vec3(0.0, 4.0, 0.0), Vec3::Y, f32::INFINITY), 1.0);
        // Its own surface, all around.
        for k in 0..64 {
            let out = Vec2::from_angle(k as f32 * std::f32::consts::TAU / 64.0);
            let place = vec3(0.0, 2.0, 0.0) + 0.5 * vec3(out.x, out.y, 0.0);
            let facing = out.y;
            if facing.abs() > 1.0e-3 {
                assert_eq!(
                    sees(place, Vec3::Y, f32::INFINITY),
                    f32::from(u8::from(facing > 0.0)),
                    "{k}"
                );
            }
        }
    }

    #[test]
    fn half_of_a_lamps_light_is_left_at_its_reach() {
        let lamp = Lamp {
            place: [0.0, 3.0, 0.0],
            color: [2.0, 1.0, 0.5],
            reach: 3.0,
        };
        let floor = Receiver {
            place: Vec3::ZERO,
            normal: Vec3::Y,
            view: Vec3::Y,
        };
        let lit =
            |shades: Vec<Shade>, shadows: bool| light(&lighting(vec![lamp], shades), &floor, shadows, |s| s * 0.1);
        let open = lit(vec![], true);
        assert_eq!(
            (open.diffuse, open.specular),
            (vec3(1.0, 0.5, 0.25), vec3(0.1, 0.05, 0.025))
        );
        let between = ball([0.0, 1.0, 0.0], 0.5);
        assert_eq!(lit(vec![between], true).diffuse, Vec3::ZERO);
        assert_eq!(lit(vec![between], false).diffuse, open.diffuse);
    }

    #[test]
    fn an_environment_is_what_its_factors_say_and_never_negative() {
        let mut lighting = lighting(vec![], vec![]);
        lighting.environment[0] = glam::Vec4::splat(0.2);
        lighting.environment[2] = glam::Vec4::splat(0.3);
        assert_eq!(environment(&lighting, Vec3::X), Vec3::splat(0.2));
        assert_eq!(environment(&lighting, Vec3::Y), Vec3::splat(0.5));
        assert_eq!(environment(&lighting, -Vec3::Y), Vec3::ZERO);
    }

    #[test]
    fn more_lamps_than_there_is_room_for_are_refused() {
        let lamp = Lamp {
            place: [0.0; 3],
            color: [1.0; 3],
            reach: 1.0,
        };
        let refused = |change: fn(&mut Scene, Lamp)| {
            let mut scene = Scene::from_name("floor").expect("a scene");
            change(&mut scene, lamp);
            scene.check().expect_err("a refusal").to_string()
        };
        assert!(refused(|scene, lamp| scene.lamps = vec![lamp; 5]).contains("5 lamps"));
        assert!(refused(|scene, _| scene.shades = vec![ball([0.0; 3], 1.0); 9]).contains("9 shades"));
        assert!(refused(|scene, lamp| scene.lamps = vec![Lamp { reach: 0.0, ..lamp }]).contains("reach"));
        assert!(refused(|scene, _| scene.shades = vec![ball([f32::NAN; 3], 1.0)]).contains("not finite"));
        assert!(refused(|scene, _| scene.environment[3][1] = f32::INFINITY).contains("environment"));
    }
}
