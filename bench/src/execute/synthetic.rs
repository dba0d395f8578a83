//! Something for any kernel to read.

use super::Inputs;
use glam::{UVec2, UVec4, Vec2, Vec3, Vec4, vec2, vec3};
use rayon::prelude::*;
use straightline_codegen::ir::{Graph, Scalar, Texture, TextureKind};
use straightline_kernels::prelude::Frame;

/// Inputs for whatever a kernel reads, the same for the same kernel and size. Textures of the output's size show a test
/// card of edges, fine lines and noise; those of any size show it at half the resolution. What is called `depth` in some
/// way holds distances from 1 to 8 with steps between surfaces, what is called `normal` unit vectors. Buffers hold 64
/// numbers between 0 and 1; texels of integers are those of 0 to 255; uniforms without a default are 1, or the identity.
pub fn test_inputs(graph: &Graph, size: UVec2) -> Inputs {
    let mut inputs = Inputs::new(size);
    for texture in &graph.textures {
        let own = match texture.framed {
            true => size,
            false if texture.kind.is_cube() => UVec2::splat(size.min_element()),
            false => (size / 2).max(UVec2::ONE),
        };
        let layers = (0..4).map(|k| draw_test_layer(texture, own, k));
        // A texel has 4 samples, an array as many layers as any pattern and the pixel's centre, a cube its faces.
        let count = match texture.kind {
            TextureKind::Flat | TextureKind::Depth => 1,
            TextureKind::Multisampled => 4,
            TextureKind::Cube | TextureKind::DepthCube => 6,
            TextureKind::Layers | TextureKind::DepthLayers | TextureKind::Volume => 17,
        };
        let layers: Vec<Frame<Vec4>> = layers
            .chain((4..17).map(|k| draw_test_layer(texture, own, k)))
            .take(count)
            .collect();
        inputs = match texture.scalar {
            Scalar::F32 => inputs.with_layers(&texture.name, layers),
            _ => {
                let bits = |t: &Vec4| UVec4::from_array(t.to_array().map(|v| (v * 255.0) as u32));
                let integers = layers
                    .iter()
                    .map(|l| Frame::new(l.size(), l.texels().iter().map(bits).collect()));
                inputs.with_integers(&texture.name, integers.collect())
            }
        };
    }
    for buffer in &graph.buffers {
        let element = |k: u32| [0, 1, 2, 3].map(|lane| f64::from(hash_noise(k * 4 + lane)));
        let values = 64 * buffer.element.value_types().len() as u32;
        inputs = inputs.with_buffer(&buffer.name, (0..values).map(element).collect());
    }
    for uniform in graph.uniforms.iter().filter(|u| u.default.is_none()) {
        let axis = ["_x_axis", "_y_axis", "_z_axis", "_w_axis"];
        let lanes = match axis.iter().position(|a| uniform.name.ends_with(a)) {
            Some(one) => (0..4).map(|k| f64::from(u8::from(k == one))).collect(),
            None => vec![1.0],
        };
        inputs = inputs.with_uniform(&uniform.name, &lanes);
    }
    inputs
}

fn draw_test_layer(texture: &Texture, size: UVec2, layer: u32) -> Frame<Vec4> {
    let shift = 0.5 + vec2(hash_noise(2 * layer), hash_noise(2 * layer + 1)) - 0.5;
    let (is_depth, is_normal) = (texture.name.contains("depth"), texture.name.contains("normal"));
    let texel = |x: u32, y: u32| {
        let uv = (vec2(x as f32, y as f32) + shift) / size.as_vec2();
        let surface = Surface::surface_at(uv);
        if is_depth {
            Vec4::splat(surface.depth)
        } else if is_normal {
            // Of view space, where y is up.
            (surface.normal * vec3(1.0, -1.0, 1.0)).extend(0.0)
        } else if texture.components == 1 {
            Vec4::splat(surface.color.x)
        } else {
            let grain = 0.06 * (hash_noise(x + y * 8192 + layer * 77) - 0.5);
            (surface.color + grain).clamp(Vec3::ZERO, Vec3::ONE).extend(1.0)
        }
    };
    let texels = (0..size.x * size.y)
        .into_par_iter()
        .map(|k| texel(k % size.x, k / size.x));
    Frame::new(size, texels.collect())
}

/// The surface at a place of the test card.
struct Surface {
    depth: f32,
    normal: Vec3,
    color: Vec3,
}

impl Surface {
    fn surface_at(uv: Vec2) -> Surface {
        let from = uv - vec2(0.42, 0.5);
        let ball = vec2(from.x * 1.5, from.y).length() / 0.33;
        if ball < 1.0 {
            let normal = vec3(from.x * 1.5 / 0.33, from.y / 0.33, (1.0 - ball * ball).sqrt());
            let light = normal.dot(vec3(-0.5, -0.6, 0.62)).max(0.0);
            return Surface {
                depth: 3.0 - normal.z,
                normal,
                color: vec3(0.9, 0.45, 0.2) * (0.15 + 0.85 * light),
            };
        }
        if uv.x > 0.72 {
            // Lines that grow finer, at a slant.
            let line = ((uv.x * 60.0 + uv.y * 14.0) * (1.0 + uv.y)).sin();
            return Surface {
                depth: 2.0 + uv.y,
                normal: vec3(0.0, 0.6, 0.8),
                color: if line > 0.0 {
                    vec3(0.95, 0.95, 0.9)
                } else {
                    vec3(0.08, 0.1, 0.2)
                },
            };
        }
        let tile = ((uv.x * 9.0).floor() + (uv.y * 6.0).floor()).rem_euclid(2.0);
        Surface {
            depth: 4.0 + 4.0 * (1.0 - uv.y),
            normal: vec3(0.0, -0.89, 0.456),
            color: vec3(0.2, 0.5, 0.65) * (0.6 + 0.4 * tile) + vec3(0.0, 0.0, 0.2) * uv.y,
        }
    }
}

/// Between 0 and 1, the same for the same number (PCG).
fn hash_noise(k: u32) -> f32 {
    let state = k.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    ((word >> 22) ^ word) as f32 / u32::MAX as f32
}
