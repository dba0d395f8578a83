// override: levels
// function: halved
options! {
    pub struct Cfg {
        /// Number of pictures.
        pub levels: u32 [1..=4] = 2,
    }
}

pub fn halved(cfg: &Cfg, color: &Texture<Vec4>) -> Texture<Vec4> {
    let mut small: Texture<Vec4> = draw(color.size(), |pixel| color.load(pixel));
    for _ in 0..cfg.levels {
        small = draw(small.size() / 2, |pixel| small.load(pixel * 2));
    }
    small
}
