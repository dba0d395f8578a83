// stage: fragment
use straightline_kernels::prelude::*;

// The old fn size_of_nothing was wrong.
pub fn k(image: &Texture<Vec4>, linear: &Sampler, resolution: UVec2, pixel: IVec2) -> Vec4 {
    image.sample(linear, (pixel.as_vec2() + 0.5) / resolution.as_vec2())
}
