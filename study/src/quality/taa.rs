//! Temporal antialiasing as engines have it (Karis 2014, Salvi 2016).
//!
//! Each frame is drawn at another place of its pixels and blended into the mean of the frames before. The mean is read where
//! motion says that the surface was, by a Catmull-Rom filter, and clipped to the colours around the pixel.

use glam::{IVec2, UVec2, Vec2, Vec3, Vec4, ivec2, vec2, vec3};
use rayon::prelude::*;
use straightline_kernels::prelude::Frame;

/// Number of places at which frames are drawn in turn.
pub const TURNS: usize = 8;

/// Share of the newest frame in the mean.
const BLEND: f32 = 0.1;

/// Number of standard deviations to each side that the mean of earlier frames may differ from the colours around.
const DEVIATIONS: f32 = 1.0;

/// Least standard deviation, so that it can be divided by.
const LEAST_DEVIATION: f32 = 1.0e-7;

/// Place at which a frame is drawn, in pixels from the centre: Halton's sequence in bases 2 and 3.
pub fn jitter(frame: usize) -> Vec2 {
    let turn = frame % TURNS + 1;
    vec2(radical_inverse(turn, 2), radical_inverse(turn, 3)) - 0.5
}

/// The digits of `number` in a base, mirrored at the point.
fn radical_inverse(mut number: usize, base: usize) -> f32 {
    let (mut value, mut digit) = (0.0, 1.0);
    while number > 0 {
        digit /= base as f32;
        value += digit * (number % base) as f32;
        number /= base;
    }
    value
}

/// Motion at the nearest of the nine pixels around each. So the edge of an object moves with the object.
pub fn dilate(motion: &Frame<Vec2>, depth: &Frame<f32>) -> Frame<Vec2> {
    let size = motion.size();
    map_pixels(size, |pixel| {
        let nearest = around(pixel).min_by(|a, b| depth.load(*a).total_cmp(&depth.load(*b)));
        motion.load(nearest.unwrap_or(pixel))
    })
}

/// Blends a frame into the mean of those before. `motion` is where each pixel's surface was, less where it is, in pixels.
pub fn accumulate(mean: &Frame<Vec4>, frame: &Frame<Vec4>, motion: &Frame<Vec2>) -> Frame<Vec4> {
    let size = frame.size();
    map_pixels(size, |pixel| {
        let own = frame.load(pixel);
        let place = pixel.as_vec2() + 0.5 + motion.load(pixel);
        let inside = place.cmpge(Vec2::ZERO).all() && place.cmplt(size.as_vec2()).all();
        // Also false if the motion is not a number.
        match inside {
            true => {
                let earlier = clip_to_surroundings(read_between(mean, place), frame, pixel);
                earlier.lerp(own, BLEND)
            }
            false => own,
        }
    })
}

/// Reads a picture at a place by the Catmull-Rom filter of 4×4 texels.
fn read_between(picture: &Frame<Vec4>, place: Vec2) -> Vec4 {
    let from = place - 0.5;
    let first = from.floor();
    let [x, y] = (from - first).to_array().map(catmull_rom);
    let mut sum = Vec4::ZERO;
    for (row, y) in (-1..).zip(y) {
        for (column, x) in (-1..).zip(x) {
            sum += x * y * picture.load(first.as_ivec2() + ivec2(column, row));
        }
    }
    sum
}

/// Weights of the four texels around a place, `t` after the second of them.
fn catmull_rom(t: f32) -> [f32; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        -0.5 * t + t2 - 0.5 * t3,
        1.0 - 2.5 * t2 + 1.5 * t3,
        0.5 * t + 2.0 * t2 - 1.5 * t3,
        -0.5 * t2 + 0.5 * t3,
    ]
}

/// Moves a colour towards the mean of the nine pixels around, into the box that their standard deviations make.
fn clip_to_surroundings(color: Vec4, frame: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let (mut sum, mut squares) = (Vec3::ZERO, Vec3::ZERO);
    for at in around(pixel) {
        let near = to_ycocg(frame.load(at).truncate());
        sum += near;
        squares += near * near;
    }
    let mean = sum / 9.0;
    let deviation = (squares / 9.0 - mean * mean).max(Vec3::ZERO).map(f32::sqrt);
    let away = to_ycocg(color.truncate()) - mean;
    let outside = (away.abs() / (DEVIATIONS * deviation).max(Vec3::splat(LEAST_DEVIATION))).max_element();
    from_ycocg(mean + away / outside.max(1.0)).extend(color.w)
}

fn to_ycocg(color: Vec3) -> Vec3 {
    vec3(
        color.dot(vec3(0.25, 0.5, 0.25)),
        color.dot(vec3(0.5, 0.0, -0.5)),
        color.dot(vec3(-0.25, 0.5, -0.25)),
    )
}

fn from_ycocg(color: Vec3) -> Vec3 {
    let rest = color.x - color.z;
    vec3(rest + color.y, color.x + color.z, rest - color.y)
}

/// The nine pixels around one, itself first.
fn around(pixel: IVec2) -> impl Iterator<Item = IVec2> {
    let others = (0..9).filter(|k| *k != 4).map(|k| ivec2(k % 3 - 1, k / 3 - 1));
    [IVec2::ZERO].into_iter().chain(others).map(move |away| pixel + away)
}

fn map_pixels<T: Copy + Send>(size: UVec2, texel: impl Fn(IVec2) -> T + Sync) -> Frame<T> {
    let rows = (0..size.y as i32).into_par_iter();
    let texels = rows.flat_map_iter(|y| (0..size.x as i32).map(|x| texel(ivec2(x, y))).collect::<Vec<_>>());
    Frame::new(size, texels.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use straightline_oracle::metrics::psnr;

    const SIZE: UVec2 = UVec2::new(48, 40);

    fn still() -> Frame<Vec2> {
        map_pixels(SIZE, |_| Vec2::ZERO)
    }

    /// Slanted stripes, several pixels wide: one place in each pixel is seen.
    fn stripes(offset: Vec2) -> Frame<Vec4> {
        map_pixels(SIZE, |pixel| {
            let along = (pixel.as_vec2() + 0.5 + offset).dot(vec2(0.9, 0.37));
            let bright = if (along / 7.0).rem_euclid(1.0) < 0.5 { 0.9 } else { 0.1 };
            Vec4::new(bright, 0.5 * bright, 0.2, 1.0)
        })
    }

    fn mean_of(pictures: impl Iterator<Item = Frame<Vec4>>) -> Frame<Vec4> {
        let pictures: Vec<Frame<Vec4>> = pictures.collect();
        straightline_scene::capture::mean_frame(&pictures).expect("pictures")
    }

    #[test]
    fn a_still_converges_to_the_supersampled_picture() {
        let places = (0..256).map(|k| (vec2((k % 16) as f32, (k / 16) as f32) + 0.5) / 16.0 - 0.5);
        let reference = mean_of(places.map(stripes));
        let mut mean = stripes(jitter(0));
        for frame in 1..40 {
            mean = accumulate(&mean, &stripes(jitter(frame)), &still());
        }
        let [once, temporal] = [&stripes(Vec2::ZERO), &mean].map(|picture| psnr(picture, &reference));
        println!("{once:.2} dB shaded once, {temporal:.2} dB over forty frames");
        assert!(temporal > once + 6.0, "{temporal} dB, shaded once {once} dB");
        let all = mean_of((0..TURNS).map(|frame| stripes(jitter(frame))));
        assert!(psnr(&mean, &all) > once + 8.0, "{} dB", psnr(&mean, &all));
    }

    #[test]
    fn a_picture_of_one_colour_stays_as_it_is() {
        let color = Vec4::new(0.3, 0.7, 11.0, 1.0);
        let even = map_pixels(SIZE, |_| color);
        let motion = map_pixels(SIZE, |pixel| vec2(0.37 * pixel.x as f32, -0.21 * pixel.y as f32));
        for texel in accumulate(&even, &even, &motion).texels() {
            assert!((*texel - color).abs().max_element() < 1.0e-5, "{texel}");
        }
    }

    /// A bright square leaves a wall of which every pixel is known to be at rest.
    #[test]
    fn no_ghost_stays_where_something_was() {
        let wall = |pixel: IVec2| 0.2 + 0.02 * ((pixel.x + pixel.y) % 3) as f32;
        let is_square = |pixel: IVec2, left: i32| (left..left + 10).contains(&pixel.x) && (10..30).contains(&pixel.y);
        let frame = |left: i32| {
            map_pixels(SIZE, |pixel| {
                let bright = if is_square(pixel, left) { 1.0 } else { wall(pixel) };
                Vec4::new(bright, bright, bright, 1.0)
            })
        };
        let mut mean = frame(5);
        for _ in 0..20 {
            mean = accumulate(&mean, &frame(5), &still());
        }
        let moved = accumulate(&mean, &frame(22), &still());
        let ghost = |picture: &Frame<Vec4>| {
            let uncovered = (5..15).flat_map(|x| (10..30).map(move |y| ivec2(x, y)));
            let off = uncovered.map(|pixel| (picture.load(pixel).x - wall(pixel)).abs());
            off.fold(0.0, f32::max)
        };
        assert!(ghost(&mean) > 0.7, "the square was there: {}", ghost(&mean));
        assert!(ghost(&moved) < 0.05, "{}", ghost(&moved));
    }

    #[test]
    fn what_comes_from_outside_of_the_picture_is_new() {
        let (before, now) = (map_pixels(SIZE, |_| Vec4::ZERO), stripes(Vec2::ZERO));
        for beyond in [vec2(-60.0, 0.0), vec2(0.0, 41.0), Vec2::NAN] {
            let motion = map_pixels(SIZE, |_| beyond);
            assert_eq!(accumulate(&before, &now, &motion), now, "{beyond}");
        }
    }

    /// The mean moves along by fractions of a pixel, and its edges stay where the object is.
    #[test]
    fn the_mean_follows_motion() {
        let step = vec2(0.4, 0.3);
        let at = |frame: usize| stripes(step * frame as f32);
        let motion = map_pixels(SIZE, |_| step);
        let mut mean = at(0);
        for frame in 1..20 {
            mean = accumulate(&mean, &at(frame), &motion);
        }
        let mut unmoved = at(0);
        for frame in 1..20 {
            unmoved = accumulate(&unmoved, &at(frame), &still());
        }
        let places = (0..256).map(|k| (vec2((k % 16) as f32, (k / 16) as f32) + 0.5) / 16.0 - 0.5);
        let reference = mean_of(places.map(|place| stripes(place + step * 19.0)));
        let [followed, unmoved] = [&mean, &unmoved].map(|picture| psnr(picture, &reference));
        println!("{followed:.2} dB along the motion, {unmoved:.2} dB without it");
        assert!(followed > unmoved + 3.0, "{followed} dB, without motion {unmoved} dB");
    }

    #[test]
    fn an_edge_moves_with_what_is_in_front() {
        let is_front = |pixel: IVec2| pixel.x < 20;
        let depth = map_pixels(SIZE, |pixel| if is_front(pixel) { 1.0 } else { 5.0 });
        let motion = map_pixels(SIZE, |pixel| if is_front(pixel) { vec2(3.0, 0.0) } else { Vec2::ZERO });
        let dilated = dilate(&motion, &depth);
        let columns = [18, 19, 20, 21].map(|x| dilated.load(ivec2(x, 7)).x);
        assert_eq!(columns, [3.0, 3.0, 3.0, 0.0]);
    }

    #[test]
    fn places_are_spread_over_the_pixel() {
        let places: Vec<Vec2> = (0..TURNS).map(jitter).collect();
        assert_eq!(places[0], vec2(0.0, 1.0 / 3.0 - 0.5));
        assert_eq!(jitter(TURNS + 3), places[3]);
        for axis in [0, 1] {
            let mut cells: Vec<i32> = places.iter().map(|place| ((place[axis] + 0.5) * 4.0) as i32).collect();
            cells.sort_unstable();
            cells.dedup();
            assert_eq!(cells, [0, 1, 2, 3], "{places:?}");
        }
    }
}
