// override: radius
// unroll-loop: k.x=full
options! {
    pub struct Cfg {
        /// How far.
        pub radius: i32 [1..=4] = 2,
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for x in -cfg.radius..=cfg.radius {
        sum += color.load(pixel + ivec2(x, 0));
    }
    sum
}
