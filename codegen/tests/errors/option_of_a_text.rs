options! {
    pub struct Cfg {
        pub name: &str = "x",
    }
}

pub fn k(cfg: &Cfg, color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    color.load(pixel)
}
