mod near {
    pub struct Tap {
        pub weight: f32,
    }
}

mod far {
    pub struct Tap {
        pub weight: f32,
        pub offset: f32,
    }
}

pub fn k(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let tap = Tap { weight: 1.0 };
    color.load(pixel) * tap.weight
}
