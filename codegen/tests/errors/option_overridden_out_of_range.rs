// set: radius=9
// override: radius
options! {
    pub struct Cfg {
        /// How far.
        pub radius: i32 [1..=4] = 2,
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel + ivec2(cfg.radius, 0))
}
