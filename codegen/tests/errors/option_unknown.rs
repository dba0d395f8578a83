// set: radios=2
enum Shape {
    Round,
    Square,
}

options! {
    pub struct Cfg {
        /// How far.
        pub radius: i32 [1..=4] = 2,
        /// What.
        pub shape: Shape = Shape::Round,
        /// Whether.
        pub on: bool = true,
        /// Which.
        pub weights: [f32; 3] = [1.0, 2.0, 1.0],
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * cfg.radius as f32
}
