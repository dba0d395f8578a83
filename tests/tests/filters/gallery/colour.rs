//! Curves and colour spaces by their definitions.

use super::world::World;
use glam::{DMat2, DMat3, DVec2, DVec3, DVec4};

/// Rows of numbers as a matrix.
fn rows(rows: [[f64; 3]; 3]) -> DMat3 {
    DMat3::from_cols_array_2d(&rows).transpose()
}

/// Björn Ottosson's matrices as he prints them; back by their inverses.
pub fn oklab_grade(w: &World, x: i64, y: i64) -> DVec4 {
    let cones = rows([
        [0.412_221_470_8, 0.536_332_536_3, 0.051_445_992_9],
        [0.211_903_498_2, 0.680_699_545_1, 0.107_396_956_6],
        [0.088_302_461_9, 0.281_718_837_6, 0.629_978_700_5],
    ]);
    let lab = rows([
        [0.210_454_255_3, 0.793_617_785_0, -0.004_072_046_8],
        [1.977_998_495_1, -2.428_592_205_0, 0.450_593_709_9],
        [0.025_904_037_1, 0.782_771_766_2, -0.808_675_766_0],
    ]);
    let here = w.picture("color").rgba(x, y);
    let mut colour = lab * (cones * here.truncate()).map(f64::cbrt);
    let turned = DMat2::from_angle(w.number("turn")) * DVec2::new(colour.y, colour.z) * w.number("chroma");
    colour = DVec3::new(colour.x * w.number("lightness"), turned.x, turned.y);
    let back = cones.inverse() * (lab.inverse() * colour).map(|v| v.powi(3));
    back.extend(here.w)
}

pub fn aces(w: &World, x: i64, y: i64) -> DVec4 {
    let input = rows([
        [0.59719, 0.35458, 0.04823],
        [0.07600, 0.90834, 0.01566],
        [0.02840, 0.13383, 0.83777],
    ]);
    let output = rows([
        [1.60475, -0.53108, -0.07367],
        [-0.10208, 1.10813, -0.00605],
        [-0.00327, -0.07276, 1.07602],
    ]);
    let here = w.picture("color").rgba(x, y);
    let fitted = (input * here.truncate() * 2f64.powf(w.number("exposure")))
        .map(|v| (v * v + 0.0245786 * v - 0.000090537) / (0.983729 * v * v + 0.4329510 * v + 0.238081));
    let shown = (output * fitted).map(|v| v.clamp(0.0, 1.0)).map(|v| match v {
        v if v <= 0.0031308 => 12.92 * v,
        v => 1.055 * v.powf(1.0 / 2.4) - 0.055,
    });
    shown.extend(here.w)
}
