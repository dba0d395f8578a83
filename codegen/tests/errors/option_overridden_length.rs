// set: radius=3
// override: radius,tau
options! {
    pub struct Cfg {
        /// How far.
        pub radius: i32 [1..=4] = 2,
        /// How much.
        pub tau: f32 = 500.0,
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut taps = [Vec4::ZERO; cfg.radius as usize];
    for x in 0..cfg.radius {
        taps[x as usize] = color.load(pixel + ivec2(x, 0));
    }
    taps[0] * cfg.tau
}
