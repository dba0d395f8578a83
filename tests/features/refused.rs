//// `macro_rules!`
macro_rules! doubled {
    ($x:expr) => {
        $x * 2.0
    };
}

pub fn macros(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    doubled!(color.load(pixel))
}

//// `Vec` and `Box`
pub fn allocated(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let taps: Vec<Vec4> = (0..3).map(|k| color.load(pixel + ivec2(k, 0))).collect();
    taps[0] + taps[1] + taps[2]
}

//// Texts
pub fn texts(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let name = "red";
    color.load(pixel) * name.len() as f32
}

//// `f64`
pub fn doubles(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let precise = color.load(pixel).x as f64;
    Vec4::splat((precise * 0.1) as f32)
}

//// `i64` and `u64`
pub fn other_integers(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let product = pixel.x as u64 * 3;
    color.load(pixel) * product as f32
}

//// `unsafe`
pub fn without_care(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let weights = [0.5, 0.25];
    let weight = unsafe { weights.get_unchecked(1) };
    color.load(pixel) * *weight
}

//// `unwrap` of a runtime value
pub fn unwrapped(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let here = color.load(pixel);
    let found = if here.x >= 0.0 { Some(here.y) } else { None };
    Vec4::splat(found.unwrap())
}

//// `static mut`
static mut COUNT: i32 = 0;

pub fn counted(color: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let count = unsafe { COUNT };
    color.load(pixel) * count as f32
}
