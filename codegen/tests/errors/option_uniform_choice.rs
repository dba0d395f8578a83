#[derive(Clone, Copy, PartialEq)]
enum Shape {
    Round,
    Square,
}

options! {
    pub struct Cfg {
        /// What.
        pub shape: Shape = uniform(Shape::Round),
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    if cfg.shape == Shape::Round { color.load(pixel) } else { Vec4::ZERO }
}
