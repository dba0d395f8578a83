// override: tau
// target: msl
options! {
    pub struct Cfg {
        /// How much.
        pub tau: f32 = 500.0,
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel) * cfg.tau
}
