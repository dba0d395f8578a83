//! The example that mimics scattering by a wide penumbra.

use super::shadows::{MAP, PLANE, coordinates, draw, map, shadow, unsure};
use super::*;
use straightline_tests::quads;

#[path = "../../../../examples/quads/scatter.rs"]
pub(super) mod kernel;

use kernel::{Scatter, scatter};

#[test]
fn a_wide_penumbra_has_its_colours() {
    let gpu = bench();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/quads/scatter.rs");
    let cfg = Scatter::default();
    let light = |[x, y]: [i64; 2]| {
        let coord = |p: [i64; 2]| PLANE.at(p);
        let quad = [0, 1, 2, 3].map(|k| coord([x / 2 * 2 + k % 2, y / 2 * 2 + k / 2]));
        let mean: [f64; 3] = std::array::from_fn(|k| quad.iter().map(|c| c[k]).sum::<f64>() / 4.0);
        let texels = [mean[0] * f64::from(MAP.x), mean[1] * f64::from(MAP.y)];
        let lit = quads::pcf_bilinear(&shadow("box", 4.0), 8, texels, cfg.spread.into(), mean[2]);
        let [green, blue] = [cfg.green, cfg.blue].map(|begin| {
            let begin = f64::from(begin);
            ((lit - begin) / (1.0 - begin)).max(0.0)
        });
        [lit, green, blue, 1.0]
    };
    let size = uvec2(24, 18);
    let coord = coordinates(size, PLANE);
    let inputs = Inputs::new(size)
        .with_image("shadow", map())
        .with_image("coord", coord.clone());
    let texture = DepthTexture::new(MAP, map().texels().iter().map(|t| t.x).collect());
    let coords = components(&coord, Vec4::truncate);
    let sampler = ComparisonSampler::default();
    let expected = defined(size, light);
    let coloured = expected.iter().filter(|texel| texel[0] > texel[2] + 0.05).count();
    assert!(coloured > expected.len() / 10, "{coloured} pixels have a colour");
    let found = native(size, |pixel| scatter(&cfg, &texture, &sampler, coords.load(pixel)));
    let image = Frame::new(size, found.iter().map(|t| Vec4::from_array(*t)).collect());
    let (share, off) = unsure(&image, &expected, 4.0e-4);
    assert!(share <= 0.02, "natively {:.1} % of the pixels are off", share * 100.0);
    println!("scatter | {off:.1e}");
    for transport in [Transport::Subgroup, Transport::Derivatives] {
        let drawn = draw(&gpu, &compile(file, &[], Unroll::Full, Some(transport)), &inputs, PLANE);
        let (share, off) = unsure(&drawn, &expected, 0.03);
        assert!(
            share <= 0.02,
            "{transport}: {:.1} % of the pixels are off",
            share * 100.0
        );
        println!("scatter {transport} | {off:.1e}");
    }
}
