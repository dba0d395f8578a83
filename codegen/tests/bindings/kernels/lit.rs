use straightline_kernels::prelude::*;

/// A picture in the light of two colours, whose weights are set with every frame.
pub fn lit(color: &Frame<Vec4>, near: Vec3, weight: f32, turn: Mat2, pixel: IVec2) -> Vec4 {
    let turned = turn * vec2(weight, 1.0 - weight);
    (color.load(pixel).truncate() * near * turned.x + near * turned.y).extend(1.0)
}
