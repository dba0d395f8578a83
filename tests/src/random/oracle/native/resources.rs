//! Resources that kernels may read besides `a`, `b`, `p`, `q`, `r` and their pixel, by the names of their parameters. The
//! tests use this file as a module, and as text in the program that runs kernels natively, so that both read the same
//! values.

use straightline_kernels::prelude::*;

/// Every resource whose type the prelude has; those of types of a kernel's own are made of the same numbers.
#[derive(Debug)]
pub struct Resources {
    floats: Vec<f32>,
    bits: Vec<u32>,
    pub bu: Buffer<u32>,
    pub bi: Buffer<i32>,
    pub bv: Buffer<Vec4>,
    pub bw: Buffer<IVec2>,
    pub fu: Frame<u32>,
    pub fi: Frame<IVec2>,
    pub ff: Frame<f32>,
    pub fv: Frame<Vec3>,
    pub fw: Frame<UVec4>,
    pub fl: FrameLayers<Vec2>,
    pub tm: Texture<Vec4>,
    pub ti: Texture<IVec4>,
    pub ta: TextureArray<Vec4>,
    pub tv: Texture3D<Vec4>,
    pub tc: TextureCube<Vec4>,
    pub ts: Multisampled<Vec4>,
    pub td: DepthTexture,
    pub tda: DepthTextureArray,
    pub tdc: DepthCube,
    pub s: Sampler,
    pub sc: ComparisonSampler,
}

impl Resources {
    /// Made of numbers, and of bits, each list of which is read round and round.
    pub fn new(size: UVec2, floats: &[f32], bits: &[u32]) -> Resources {
        let float = |k: usize| floats[k % floats.len()];
        let bit = |k: usize| bits[k % bits.len()];
        let vector = |k: usize| vec4(float(k), float(k + 1), float(k + 2), float(k + 3));
        let many =
            |count: u32, from: usize| -> Vec<Vec4> { (0..count as usize).map(|k| vector(from + 3 * k)).collect() };
        let depth = |k: usize| (float(k).abs() * 0.0625).min(1.0);
        let depths = |count: u32, from: usize| -> Vec<f32> { (0..count as usize).map(|k| depth(from + k)).collect() };
        let pixels = (size.x * size.y) as usize;
        let levels =
            |from| Texture::with_levels(uvec2(5, 3), vec![many(15, from), many(2, from + 1), many(1, from + 2)]);
        let face = |k: usize| Texture::with_levels(uvec2(4, 4), vec![many(16, 5 * k), many(4, k), many(1, 2 * k)]);
        let faces = [0, 1, 2, 3, 4, 5];
        let filter = |bits: u32| [Filter::Nearest, Filter::Linear][bits as usize % 2];
        Resources {
            floats: floats.to_vec(),
            bits: bits.to_vec(),
            bu: Buffer::new((0..5).map(|k| bit(k + 1)).collect()),
            bi: Buffer::new((0..4).map(|k| bit(k + 7) as i32).collect()),
            bv: Buffer::new(many(3, 9)),
            bw: Buffer::new((0..6).map(|k| ivec2(bit(k) as i32, bit(k + 20) as i32)).collect()),
            fu: Frame::new(size, (0..pixels).map(|k| bit(2 * k)).collect()),
            fi: Frame::new(
                size,
                (0..pixels)
                    .map(|k| ivec2(bit(k) as i32 >> 20, bit(3 * k) as i32))
                    .collect(),
            ),
            ff: Frame::new(size, (0..pixels).map(|k| float(k + 30)).collect()),
            fv: Frame::new(size, (0..pixels).map(|k| vector(k + 11).truncate()).collect()),
            fw: Frame::new(
                size,
                (0..pixels)
                    .map(|k| uvec4(bit(k), bit(k + 1), bit(k + 2), bit(k + 9)))
                    .collect(),
            ),
            fl: FrameLayers::new(
                (0..3)
                    .map(|layer| {
                        Frame::new(
                            size,
                            (0..pixels)
                                .map(|k| vector(k + 7 * layer).truncate().truncate())
                                .collect(),
                        )
                    })
                    .collect(),
            ),
            tm: levels(3),
            ti: Texture::new(
                uvec2(3, 4),
                (0..12)
                    .map(|k| uvec4(bit(k), bit(2 * k), bit(k + 5), 7).as_ivec4())
                    .collect(),
            ),
            ta: TextureArray::new(vec![levels(0), levels(21), levels(40)]),
            tv: Texture3D::with_levels(uvec3(3, 2, 2), vec![many(12, 17), many(1, 4)]),
            tc: TextureCube::new(faces.map(face)),
            ts: Multisampled::new((0..4).map(|k| Texture::new(uvec2(3, 3), many(9, 6 * k))).collect()),
            td: DepthTexture::new(uvec2(3, 3), depths(9, 13)),
            tda: DepthTextureArray::new(
                (0..2)
                    .map(|k| DepthTexture::new(uvec2(4, 3), depths(12, 9 * k)))
                    .collect(),
            ),
            tdc: DepthCube::new(faces.map(|k| DepthTexture::new(uvec2(2, 2), depths(4, 4 * k)))),
            s: Sampler {
                filter: filter(bits[0]),
                address: [Address::Clamp, Address::Repeat, Address::Mirror][bits[1] as usize % 3],
                mip: filter(bits[2] >> 1),
            },
            sc: ComparisonSampler {
                filter: filter(bits[3]),
                comparison: Comparison::default(),
            },
        }
    }

    /// A number.
    pub fn float(&self, k: usize) -> f32 {
        self.floats[k % self.floats.len()]
    }

    /// 32 bits.
    pub fn bit(&self, k: usize) -> u32 {
        self.bits[k % self.bits.len()]
    }
}
