// set: radius=1
// set: radius=2
options! {
    pub struct Cfg {
        pub radius: i32 [0..=4] = 1,
        pub count: u32 = 1,
        pub any: i32 = 1,
        pub share: f32 = 1.0,
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * (cfg.radius + cfg.any) as f32 * cfg.count as f32 * cfg.share
}
