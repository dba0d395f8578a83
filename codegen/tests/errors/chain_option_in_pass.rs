/// Sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left.
    Left,
    /// Right.
    Right,
}

options! {
    /// Options.
    pub struct Sides {
        /// Side.
        pub side: Side = Side::Left,
    }
}

pub fn k(cfg: &Sides, color: &Texture<Vec4>) -> Texture<Vec4> {
    let side = cfg.side;
    draw(color.size(), |pixel| if side == Side::Left { color.load(pixel) } else { color.load(-pixel) })
}
