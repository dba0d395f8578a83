options! {
    pub struct Cfg {
        pub radius: i32 [0..=4] = 1,
        pub radius: f32 [0.0..=4.0] = 2.0,
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * cfg.radius as f32
}
