// override: shape,weights
#[derive(Clone, Copy, PartialEq)]
enum Shape {
    Round,
    Square,
}

options! {
    pub struct Cfg {
        /// Shape of the window.
        pub shape: Shape = Shape::Round,
        /// Weights from left to right.
        pub weights: [f32; 3] = [1.0, 2.0, 1.0],
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    if cfg.shape == Shape::Round { color.load(pixel) * cfg.weights[0] } else { Vec4::ZERO }
}
