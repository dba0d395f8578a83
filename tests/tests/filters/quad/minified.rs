//! The examples that filter shadow maps from afar: as wide as the quad, and by cascades.

use super::shadows::{MAP, Plane, coordinates, draw, map, shadow, unsure};
use super::*;
use straightline_bench::execute::SamplerState;
use straightline_kernels::quad::pcf::{Gradient, Pcf, pcf};
use straightline_tests::quads::{self, Shadow};

#[path = "../../../../examples/quads/cascades.rs"]
mod cascades;
#[path = "../../../../examples/quads/minified.rs"]
mod kernel;

use kernel::{Minified, Remedy, minified};

const REMEDIES: [(Remedy, &str); 3] = [
    (Remedy::Dense, "dense"),
    (Remedy::Sparse, "sparse"),
    (Remedy::Levels, "levels"),
];

/// A plane whose pixels lie `step` texels of a map apart, at a slant.
fn from_afar(size: UVec2, step: f64) -> Plane {
    let [w, h] = [f64::from(size.x), f64::from(size.y)];
    Plane {
        origin: [0.087, 0.093, 0.41],
        right: [step / w, 0.1 * step / h, 0.0006],
        down: [-0.12 * step / w, 0.93 * step / h, 0.0009],
    }
}

/// The map and its smaller levels, each texel the mean of four.
fn levels(map: &Frame<Vec4>, count: usize) -> Vec<Frame<Vec4>> {
    let mut levels = vec![map.clone()];
    for _ in 1..count {
        let finer = &levels[levels.len() - 1];
        let size = finer.size() / 2;
        let mean = |k: u32| {
            let at = ivec2((k % size.x) as i32, (k / size.x) as i32) * 2;
            let four = [ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1)];
            four.iter().map(|o| finer.load(at + *o)).sum::<Vec4>() / 4.0
        };
        let coarser = Frame::new(size, (0..size.x * size.y).map(mean).collect());
        levels.push(coarser);
    }
    levels
}

fn texture(levels: &[Frame<Vec4>]) -> Texture<f32> {
    let of = |frame: &Frame<Vec4>| frame.texels().iter().map(|t| t.x).collect();
    Texture::with_levels(levels[0].size(), levels.iter().map(of).collect())
}

/// Places of a quad's pixels in texels, and its mean place with the mean depth.
fn quad_at(plane: Plane, size: UVec2, [x, y]: [i64; 2]) -> ([[f64; 2]; 4], [f64; 3]) {
    let quad = [0, 1, 2, 3].map(|k| plane.at([x / 2 * 2 + k % 2, y / 2 * 2 + k / 2]));
    let mean: [f64; 3] = std::array::from_fn(|k| quad.iter().map(|c| c[k]).sum::<f64>() / 4.0);
    let texels = |c: [f64; 3]| [c[0] * f64::from(size.x), c[1] * f64::from(size.y)];
    let [u, v] = texels(mean);
    (quad.map(texels), [u, v, mean[2]])
}

fn definition(remedy: Remedy, of: &[Shadow], quad: [[f64; 2]; 4], [u, v, depth]: [f64; 3]) -> f64 {
    let step = |a: usize, b: usize| (0..2).map(|k| (quad[a][k] - quad[b][k]).abs()).fold(0.0, f64::max);
    let widest = [step(0, 1), step(2, 3), step(0, 2), step(1, 3)]
        .into_iter()
        .fold(0.0, f64::max);
    let spread = (widest / 4.0).max(1.0);
    match remedy {
        Remedy::Dense => quads::pcf_bilinear(&of[0], 8, [u, v], 1.0, depth),
        Remedy::Sparse => quads::pcf_bilinear(&of[0], 8, [u, v], spread, depth),
        Remedy::Levels => {
            let level = spread.log2().round();
            let place = [u, v].map(|p| p / level.exp2());
            let of = &of[level as usize];
            let lit = |k: i64| {
                let at = [0, 1].map(|axis| {
                    let tap = if axis == 0 { k % 4 } else { k / 4 };
                    (place[axis] + (2 * tap - 3) as f64 + 0.5).floor() as i64
                });
                f64::from(u8::from(depth <= of.depth(at[0], at[1])))
            };
            (0..16).map(lit).sum::<f64>() / 16.0
        }
    }
}

/// As the definitions read it.
fn plain(frame: &Frame<Vec4>) -> Shadow {
    Shadow {
        size: [i64::from(frame.size().x), i64::from(frame.size().y)],
        depths: frame.texels().iter().map(|t| f64::from(t.x)).collect(),
        ..shadow("box", 4.0)
    }
}

fn point() -> Sampler {
    Sampler {
        filter: Filter::Nearest,
        mip: Filter::Nearest,
        ..Sampler::default()
    }
}

#[test]
fn filters_are_as_wide_as_the_quad() {
    let gpu = bench();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/quads/minified.rs");
    let size = uvec2(10, 8);
    let chain = levels(&map(), 4);
    let maps: Vec<Shadow> = chain.iter().map(plain).collect();
    let depth = DepthTexture::new(MAP, map().texels().iter().map(|t| t.x).collect());
    for step in [1.0, 3.0, 5.0, 9.0] {
        let plane = from_afar(MAP, step);
        let coord = coordinates(size, plane);
        let inputs = Inputs::new(size)
            .with_image("shadow", map())
            .with_image("coord", coord.clone())
            .with_levels("levels", chain.iter().map(|level| vec![level.clone()]).collect())
            .with_sampler(
                "nearest",
                SamplerState {
                    linear: false,
                    linear_mip: false,
                    ..SamplerState::default()
                },
            );
        let coords = components(&coord, Vec4::truncate);
        for (remedy, word) in REMEDIES {
            let expected = defined(size, |at| {
                let (quad, mean) = quad_at(plane, MAP, at);
                [definition(remedy, &maps, quad, mean); 4]
            });
            let sampler = ComparisonSampler::default();
            let found = native(size, |pixel| {
                let cfg = Minified { remedy };
                minified(&cfg, &depth, &sampler, &texture(&chain), &point(), coords.load(pixel))
            });
            let image = Frame::new(size, found.iter().map(|t| Vec4::from_array(*t)).collect());
            let (share, off) = unsure(&image, &expected, 4.0e-4);
            assert!(share <= 0.05, "{word}, {step}: natively {:.1} % are off", share * 100.0);
            let options = [("remedy", word)];
            for unroll in FORMS {
                let interpreted = interpret_kernel::<f32>(&compile(file, &options, unroll, None), &inputs, false);
                let interpreted = interpreted.expect("it runs");
                same_bits(&found, &interpreted.texels).unwrap_or_else(|e| panic!("{word} {unroll}: {e}"));
            }
            let mut shown = format!("minified {word}, {step} texels | {off:.1e}");
            for transport in [Transport::Subgroup, Transport::Derivatives] {
                let drawn = draw(
                    &gpu,
                    &compile(file, &options, Unroll::Full, Some(transport)),
                    &inputs,
                    plane,
                );
                let (share, off) = unsure(&drawn, &expected, 0.03);
                assert!(
                    share <= 0.05,
                    "{word}, {step} by {transport}: {:.1} % are off",
                    share * 100.0
                );
                shown += &format!(" | {off:.1e}");
            }
            println!("{shown}");
        }
    }
}

/// The mean difference of each filter from the light over all texels around each pixel, eight across and as many as twice
/// the quad is wide: the linear gradient is of use as long as a quad is not much wider than its filter.
#[test]
fn gradients_fail_from_afar_and_wide_filters_do_not() {
    let side = uvec2(512, 512);
    let grain = noise(side, 5);
    let texel = |k: u32| {
        let (x, y) = ((k % side.x) as f32, (k / side.x) as f32);
        let wave = (x * 0.11).sin() * (y * 0.09 + 1.0).cos();
        Vec4::splat(0.43 + 0.1 * wave + 0.02 * grain.texels()[k as usize].x)
    };
    let map = Frame::new(side, (0..side.x * side.y).map(texel).collect());
    let chain = levels(&map, 4);
    let depth = DepthTexture::new(side, map.texels().iter().map(|t| t.x).collect());
    let (whole, smaller) = (plain(&map), texture(&chain));
    println!("texels from pixel to pixel | dense | dense, gradient | sparse | levels");
    let mut table = Vec::new();
    for step in [1.0, 2.0, 4.0, 8.0, 16.0] {
        let size = UVec2::splat((360.0 / step) as u32 / 2 * 2).min(UVec2::splat(44));
        let plane = Plane {
            right: [step / 512.0, 0.0, 0.0004],
            down: [0.0, step / 512.0, 0.0003],
            ..from_afar(side, step)
        };
        let coords = components(&coordinates(size, plane), Vec4::truncate);
        let sampler = ComparisonSampler::default();
        let truth = defined(size, |at| {
            let own = plane.at(at);
            let width = f64::max(8.0, 4.0 * step);
            let lit = |k: i64| {
                let [i, j] = [k % 64, k / 64].map(|k| ((k as f64 + 0.5) / 64.0 - 0.5) * width);
                let texel = [(own[0] * 512.0 + i).floor() as i64, (own[1] * 512.0 + j).floor() as i64];
                f64::from(u8::from(own[2] <= whole.depth(texel[0], texel[1])))
            };
            [(0..4096).map(lit).sum::<f64>() / 4096.0; 4]
        });
        let mean_off = |found: &[[f32; 4]]| {
            let off = found.iter().zip(&truth).map(|(f, t)| (f64::from(f[0]) - t[0]).abs());
            off.sum::<f64>() / truth.len() as f64
        };
        let by_gradient = native(size, |pixel| {
            let cfg = Pcf {
                gradient: Gradient::Prewitt,
                ..Pcf::default()
            };
            let lookup = Texture::new(UVec2::ONE, vec![Vec4::ZERO]);
            pcf(&cfg, &depth, &sampler, &lookup, &Sampler::default(), coords.load(pixel))
        });
        let [dense, sparse, levels] = REMEDIES.map(|(remedy, _)| {
            let cfg = Minified { remedy };
            mean_off(&native(size, |pixel| {
                minified(&cfg, &depth, &sampler, &smaller, &point(), coords.load(pixel))
            }))
        });
        let row = [dense, mean_off(&by_gradient), sparse, levels];
        println!("{step} | {:.3} | {:.3} | {:.3} | {:.3}", row[0], row[1], row[2], row[3]);
        table.push(row);
    }
    let [dense, gradient, sparse, levels] = table[4];
    assert!(
        sparse < dense && levels < dense && sparse < gradient && levels < gradient,
        "{table:?}"
    );
}

/// The place and the size in texels of a cascade's filter, by definition: the finest that has all of it.
fn cascade_at([x, y]: [f64; 2], own: [f64; 2]) -> (i64, [f64; 2]) {
    let room = 1.0 - 10.0 / own[0].min(own[1]);
    let farthest = x.abs().max(y.abs());
    let k = (0..2).find(|k| farthest <= f64::from(1 << k) * room).unwrap_or(2);
    let place = [x, y].map(|p| p / f64::from(1 << k) * 0.5 + 0.5);
    let clamped = [0, 1].map(|axis| (place[axis] * own[axis]).clamp(5.0, own[axis] - 5.0));
    (k.into(), clamped)
}

#[test]
fn cascades_are_chosen_by_the_quad() {
    let gpu = bench();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/quads/cascades.rs");
    let atlas = uvec2(144, 40);
    let grain = noise(atlas, 8);
    let texel = |k: u32| {
        let (x, y) = ((k % atlas.x) as f32, (k / atlas.x) as f32);
        Vec4::splat(0.5 + 0.2 * (x * 0.31).sin() * (y * 0.23).cos() + 0.05 * grain.texels()[k as usize].x)
    };
    let map = Frame::new(atlas, (0..atlas.x * atlas.y).map(texel).collect());
    let depth = DepthTexture::new(atlas, map.texels().iter().map(|t| t.x).collect());
    let whole = plain(&map);
    let plane = Plane {
        origin: [-0.61, -0.43, 0.42],
        right: [0.211, 0.012, 0.006],
        down: [-0.017, 0.187, 0.005],
    };
    let size = uvec2(25, 17);
    let own = [48.0, 40.0];
    let light = |at: [i64; 2]| {
        let (_, [x, y, depth]) = quad_at(plane, UVec2::ONE, at);
        let (k, place) = cascade_at([x, y], own);
        let first = place.map(|p| (p - 0.5).floor() as i64 - 3);
        let texels = (0..64).map(|n| whole.depth(48 * k + first[0] + n % 8, first[1] + n / 8));
        let lit = texels.filter(|z| depth <= *z).count() as f64 / 64.0;
        ([lit; 4], k)
    };
    let taken: std::collections::BTreeSet<i64> = (0..17).flat_map(|y| (0..25).map(move |x| light([x, y]).1)).collect();
    assert_eq!(taken.len(), 3, "every cascade is read");
    let expected = defined(size, |at| light(at).0);
    let coord = coordinates(size, plane);
    let coords = components(&coord, Vec4::truncate);
    let inputs = Inputs::new(size)
        .with_image("shadow", map.clone())
        .with_image("coord", coord);
    let sampler = ComparisonSampler::default();
    let found = native(size, |pixel| {
        let corner = |p: Quad<IVec2>| Quad::new(p.lanes().map(|p| plane.at([p.x.into(), p.y.into()])));
        let place = corner(pixel).map(|c| vec3(c[0] as f32, c[1] as f32, c[2] as f32));
        cascades::cascades(&depth, &sampler, place)
    });
    let image = Frame::new(size, found.iter().map(|t| Vec4::from_array(*t)).collect());
    let (share, off) = unsure(&image, &expected, 4.0e-4);
    assert!(share <= 0.03, "natively {:.1} % are off", share * 100.0);
    let clamped = native(size, |pixel| cascades::cascades(&depth, &sampler, coords.load(pixel)));
    for unroll in FORMS {
        let interpreted = interpret_kernel::<f32>(&compile(file, &[], unroll, None), &inputs, false).expect("it runs");
        same_bits(&clamped, &interpreted.texels).unwrap_or_else(|e| panic!("{unroll}: {e}"));
    }
    let mut shown = format!("cascades | {off:.1e}");
    for transport in [Transport::Subgroup, Transport::Derivatives] {
        let drawn = draw(&gpu, &compile(file, &[], Unroll::Full, Some(transport)), &inputs, plane);
        let (share, off) = unsure(&drawn, &expected, 0.03);
        assert!(share <= 0.03, "by {transport}: {:.1} % are off", share * 100.0);
        shown += &format!(" | {off:.1e}");
    }
    println!("{shown}");
}
