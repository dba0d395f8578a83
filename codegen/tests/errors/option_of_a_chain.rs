// set: levelz=3
options! {
    /// Options.
    pub struct Levels {
        /// Passes.
        pub levels: i32 [1..=4] = 2,
    }
}

pub fn k(cfg: &Levels, color: &Texture<Vec4>) -> Texture<Vec4> {
    let mut current: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    for _ in 0..cfg.levels {
        current = draw(color.size(), |pixel| current.load(pixel) * 0.5);
    }
    current
}
