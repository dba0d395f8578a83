// The base of a structure was read before the values of the fields, one of which changes it.
// expect 0 0: 2 0 2 0

#[derive(Clone, Copy)]
struct Pair {
    first: f32,
    second: i32,
}
impl Pair {
    fn change(&mut self) -> i32 {
        self.first += 1.0;
        2
    }
}
pub fn k(a: &Frame<Vec4>, pixel: IVec2) -> Vec4 {
    let mut pair = Pair { first: 1.0, second: 0 };
    pair = Pair { second: pair.change(), ..pair };
    vec4(pair.first, 0.0, pair.second as f32, 0.0)
}
