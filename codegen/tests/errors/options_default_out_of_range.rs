options! {
    pub struct Cfg {
        pub radius: i32 [0..=4] = 7,
        pub weights: [f32; 3] [0.0..=1.0] = [0.5, 1.5, 0.5],
        pub sigma: f32 [1.0..=0.0] = 0.5,
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * cfg.radius as f32
}
