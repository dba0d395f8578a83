//! Hue, chroma and lightness adjustments in Oklab (Ottosson, A perceptual color space for image processing, 2020).

use straightline_kernels::prelude::*;

/// Converts from linear sRGB.
fn oklab(rgb: Vec3) -> Vec3 {
    let cones = mat3(
        vec3(0.412_221_47, 0.211_903_5, 0.088_302_46),
        vec3(0.536_332_54, 0.680_699_55, 0.281_718_84),
        vec3(0.051_445_995, 0.107_396_96, 0.629_978_7),
    ) * rgb;
    let lms = cones.map(f32::cbrt);
    mat3(
        vec3(0.210_454_26, 1.977_998_5, 0.025_904_037),
        vec3(0.793_617_8, -2.428_592_2, 0.782_771_77),
        vec3(-0.004_072_047, 0.450_593_7, -0.808_675_77),
    ) * lms
}

fn linear_srgb(lab: Vec3) -> Vec3 {
    let lms = vec3(
        lab.x + 0.396_337_78 * lab.y + 0.215_803_76 * lab.z,
        lab.x - 0.105_561_346 * lab.y - 0.063_854_17 * lab.z,
        lab.x - 0.089_484_18 * lab.y - 1.291_485_5 * lab.z,
    );
    let cones = lms * lms * lms;
    vec3(
        4.076_741_7 * cones.x - 3.307_711_6 * cones.y + 0.230_969_94 * cones.z,
        -1.268_438 * cones.x + 2.609_757_4 * cones.y - 0.341_319_38 * cones.z,
        -0.004_196_086_3 * cones.x - 0.703_418_6 * cones.y + 1.707_614_7 * cones.z,
    )
}

/// Rotates hue by `turn` radians and multiplies chroma by `chroma` and lightness by `lightness`.
pub fn oklab_grade(color: &Frame<Vec4>, turn: f32, chroma: f32, lightness: f32, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let lab = oklab(here.truncate());
    let turned = Mat2::from_angle(turn) * lab.yz() * chroma;
    linear_srgb(vec3(lab.x * lightness, turned.x, turned.y)).extend(here.w)
}
