//! FLIP and SSIM against NVIDIA's `flip-evaluator` 1.7 and scikit-image 0.26, which computed the numbers here from the same
//! bytes; and against formulas.

use super::{flip, flip_map, ssim, worst_error};
use glam::{Vec3, Vec4, uvec2, vec4};
use straightline_kernels::prelude::Frame;
use straightline_scene::picture::srgb;

/// Steps and slopes; `moved`, one pixel to the left and with a little noise.
fn test_picture(width: u32, height: u32, moved: bool) -> Frame<Vec4> {
    let byte = |x: u32, y: u32, c: u32| {
        let (at, noise) = match moved {
            true => (x + 1, (x * 7 + y * 13 + c * 29) % 11),
            false => (x, 0),
        };
        (at * 3 + y * 5 + c * 40 + 60 * ((at / 8 + y / 8) % 2) + noise) % 256
    };
    let light = |x, y, c| srgb::to_linear(byte(x, y, c) as f32 / 255.0);
    let texels = (0..width * height).map(|k| {
        let (x, y) = (k % width, k / width);
        vec4(light(x, y, 0), light(x, y, 1), light(x, y, 2), 1.0)
    });
    Frame::new(uvec2(width, height), texels.collect())
}

fn plain_picture(side: u32, grey: f32) -> Frame<Vec4> {
    let light = srgb::to_linear(grey);
    Frame::new(
        uvec2(side, side),
        vec![vec4(light, light, light, 1.0); (side * side) as usize],
    )
}

#[test]
fn equal_pictures() {
    let picture = test_picture(64, 48, false);
    assert!(flip(&picture, &picture) == 0.0);
    assert!((ssim(&picture, &picture) - 1.0).abs() < 1e-12);
}

#[test]
fn as_others_compute_it() {
    let (test, reference) = (test_picture(64, 48, true), test_picture(64, 48, false));
    let (found, expected) = (flip(&test, &reference), 0.366_564_6);
    assert!((found - expected).abs() < 2e-6, "{found}");
    let largest = flip_map(&test, &reference).into_iter().fold(0.0, f32::max);
    assert!((largest - 0.983_289_8).abs() < 1e-5, "{largest}");
    let (found, expected) = (ssim(&test, &reference), 0.525_761_182_7);
    assert!((found - expected).abs() < 1e-6, "{found}");
    // Smaller than a window of SSIM and than a filter of FLIP.
    let (test, reference) = (test_picture(9, 30, true), test_picture(9, 30, false));
    let (found, expected) = (flip(&test, &reference), 0.319_057_5);
    assert!((found - expected).abs() < 2e-6, "{found}");
    assert!((0.2..0.9).contains(&ssim(&test, &reference)));
}

#[test]
fn similarity_of_even_pictures_is_that_of_their_means() {
    let expected = |a: f64, b: f64| (2.0 * a * b + 1e-4) / (a * a + b * b + 1e-4);
    for side in [1, 5, 11, 20] {
        let found = ssim(&plain_picture(side, 0.25), &plain_picture(side, 0.75));
        assert!((found - expected(0.25, 0.75)).abs() < 1e-6, "{side}: {found}");
    }
}

#[test]
fn what_is_not_finite_is_as_wrong_as_can_be() {
    let reference = plain_picture(21, 0.5);
    let broken = |value: f32| {
        let mut texels = reference.texels().to_vec();
        texels[10 * 21 + 10].y = value;
        Frame::new(reference.size(), texels)
    };
    let map = flip_map(&broken(f32::NAN), &reference);
    assert_eq!(map[10 * 21 + 10], 1.0);
    for value in [f32::NAN, f32::INFINITY] {
        // A bad pixel is as wrong as black on grey or worse, in either picture; and the window around it counts -1 of 11 x 11.
        let black = broken(0.0);
        for (test, right) in [(&broken(value), &reference), (&reference, &broken(value))] {
            assert!(flip(test, right) > flip(&black, &reference), "{value}");
            assert!(ssim(test, right) < ssim(&black, &reference), "{value}");
        }
        assert!(flip(&broken(value), &broken(value)) > 0.0);
    }
}

#[test]
fn colour_is_clamped_to_what_a_display_shows() {
    let scaled = |by: f32| Frame::new(uvec2(20, 20), vec![vec4(by, by, -by, 1.0); 400]);
    assert_eq!(flip(&scaled(1.0), &scaled(50.0)), 0.0);
    assert!((ssim(&scaled(1.0), &scaled(50.0)) - 1.0).abs() < 1e-12);
}

#[test]
fn one_pixel_in_a_thousand_is_worse() {
    let black = Frame::new(uvec2(100, 40), vec![Vec4::W; 4000]);
    // Four pixels of 4000 are worse than the fifth.
    let errors = [0.9, 0.8, 0.7, 0.6, 0.25];
    let mut texels = vec![Vec4::W; 4000];
    for (k, error) in errors.into_iter().enumerate() {
        texels[700 * k] = Vec3::splat(error).extend(1.0);
    }
    let found = worst_error(&Frame::new(uvec2(100, 40), texels), &black);
    assert!((found - 0.25).abs() < 1.0e-6, "{found}");
    assert_eq!(worst_error(&black, &black), 0.0);
}
