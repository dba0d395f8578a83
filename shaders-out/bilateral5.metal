// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

metal::int2 naga_f2i32(metal::float2 value) {
    return static_cast<metal::int2>(metal::clamp(value, -2147483600.0, 2147483500.0));
}


struct quad_bilateralInput {
};
struct quad_bilateralOutput {
    metal::float4 member [[color(0)]];
};
fragment quad_bilateralOutput quad_bilateral(
  metal::float4 position [[position]]
, metal::texture2d<float, metal::access::sample> image [[texture(0)]]
) {
    metal::int2 pixel = naga_f2i32(metal::floor(position.xy));
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(image.get_width(), image.get_height()));
    metal::int2 outwards = naga_f2i32((static_cast<metal::float2>(pixel & metal::int2(1)) * 2.0) - metal::float2(1.0));
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::float4 own = image.read(metal::uint2(metal::clamp(pixel, metal::int2(0), last)), 0);
    bool counts = metal::all(metal::abs(own.xyz) < metal::float3(300000000000000000000000000000000000000.0));
    float bounded = (metal::abs(own.w) < 1000000000000000000000000000000.0) ? own.w : 1000000000000000000000000000000.0;
    metal::float4 centre = counts ? metal::float4(own.xyz, bounded) : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed = metal::quad_shuffle_xor(centre, 1u);
    metal::float4 unnamed_1 = metal::quad_shuffle_xor(centre, 2u);
    metal::float4 unnamed_2 = metal::quad_shuffle_xor(centre, 3u);
    float z_j0i0k0_ = (centre.w - centre.w) / 0.1;
    float weight_j0i0k0_ = metal::exp2((z_j0i0k0_ * z_j0i0k0_) * -0.7213475);
    metal::float4 sum_j0i0k0_ = metal::float4(0.0) + metal::float4((centre.xyz - centre.xyz) * weight_j0i0k0_, weight_j0i0k0_);
    float z_j0i0k1_ = (unnamed.w - centre.w) / 0.1;
    float weight_j0i0k1_ = metal::exp2(((z_j0i0k1_ * z_j0i0k1_) + 0.25) * -0.7213475);
    metal::float4 weighed_j0i0k1_ = metal::float4((unnamed.xyz - centre.xyz) * weight_j0i0k1_, weight_j0i0k1_);
    float z_j0i0k2_ = (unnamed_1.w - centre.w) / 0.1;
    float weight_j0i0k2_ = metal::exp2(((z_j0i0k2_ * z_j0i0k2_) + 0.25) * -0.7213475);
    metal::float4 weighed_j0i0k2_ = metal::float4((unnamed_1.xyz - centre.xyz) * weight_j0i0k2_, weight_j0i0k2_);
    float z_j0i0k3_ = (unnamed_2.w - centre.w) / 0.1;
    float weight_j0i0k3_ = metal::exp2(((z_j0i0k3_ * z_j0i0k3_) + 0.5) * -0.7213475);
    metal::float4 weighed_j0i0k3_ = metal::float4((unnamed_2.xyz - centre.xyz) * weight_j0i0k3_, weight_j0i0k3_);
    metal::float4 texel_j0_i1_ = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(1, 0))))), metal::int2(0), last)), 0);
    bool counts_j0_i1_ = metal::all(metal::abs(texel_j0_i1_.xy) < metal::float2(300000000000000000000000000000000000000.0)) & (metal::abs(texel_j0_i1_.z) < 300000000000000000000000000000000000000.0);
    float bounded_j0_i1_ = (metal::abs(texel_j0_i1_.w) < 1000000000000000000000000000000.0) ? texel_j0_i1_.w : 1000000000000000000000000000000.0;
    metal::float4 counted_j0_i1_ = metal::float4(texel_j0_i1_.xyz, bounded_j0_i1_);
    metal::float4 taps_0_j0_i1_ = counts_j0_i1_ ? counted_j0_i1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_3 = metal::quad_shuffle_xor(taps_0_j0_i1_, 1u);
    metal::float4 unnamed_4 = metal::quad_shuffle_xor(taps_0_j0_i1_, 2u);
    metal::float4 unnamed_5 = metal::quad_shuffle_xor(taps_0_j0_i1_, 3u);
    float z_j0i1k0_ = (taps_0_j0_i1_.w - centre.w) / 0.1;
    float weight_j0i1k0_ = metal::exp2(((z_j0i1k0_ * z_j0i1k0_) + 0.25) * -0.7213475);
    metal::float4 weighed_j0i1k0_ = metal::float4((taps_0_j0_i1_.xyz - centre.xyz) * weight_j0i1k0_, weight_j0i1k0_);
    metal::float4 sum_j0i1k0_ = (((sum_j0i0k0_ + weighed_j0i0k1_) + weighed_j0i0k2_) + weighed_j0i0k3_) + weighed_j0i1k0_;
    float z_j0i1k1_ = (unnamed_3.w - centre.w) / 0.1;
    float weight_j0i1k1_ = metal::exp2(((z_j0i1k1_ * z_j0i1k1_) + 1.0) * -0.7213475);
    metal::float4 weighed_j0i1k1_ = metal::float4((unnamed_3.xyz - centre.xyz) * weight_j0i1k1_, weight_j0i1k1_);
    float z_j0i1k2_ = (unnamed_4.w - centre.w) / 0.1;
    float weight_j0i1k2_ = metal::exp2(((z_j0i1k2_ * z_j0i1k2_) + 0.5) * -0.7213475);
    metal::float4 weighed_j0i1k2_ = metal::float4((unnamed_4.xyz - centre.xyz) * weight_j0i1k2_, weight_j0i1k2_);
    float z_j0i1k3_ = (unnamed_5.w - centre.w) / 0.1;
    float weight_j0i1k3_ = metal::exp2(((z_j0i1k3_ * z_j0i1k3_) + 1.25) * -0.7213475);
    metal::float4 weighed_j0i1k3_ = metal::float4((unnamed_5.xyz - centre.xyz) * weight_j0i1k3_, weight_j0i1k3_);
    metal::float4 texel_j0_i2_ = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(2, 0))))), metal::int2(0), last)), 0);
    bool counts_j0_i2_ = metal::all(metal::abs(texel_j0_i2_.xy) < metal::float2(300000000000000000000000000000000000000.0)) & (metal::abs(texel_j0_i2_.z) < 300000000000000000000000000000000000000.0);
    float bounded_j0_i2_ = (metal::abs(texel_j0_i2_.w) < 1000000000000000000000000000000.0) ? texel_j0_i2_.w : 1000000000000000000000000000000.0;
    metal::float4 counted_j0_i2_ = metal::float4(texel_j0_i2_.xyz, bounded_j0_i2_);
    metal::float4 taps_0_j0_i2_ = counts_j0_i2_ ? counted_j0_i2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_6 = metal::quad_shuffle_xor(taps_0_j0_i2_, 2u);
    float z_j0i2k0_ = (taps_0_j0_i2_.w - centre.w) / 0.1;
    float weight_j0i2k0_ = metal::exp2(((z_j0i2k0_ * z_j0i2k0_) + 1.0) * -0.7213475);
    metal::float4 weighed_j0i2k0_ = metal::float4((taps_0_j0_i2_.xyz - centre.xyz) * weight_j0i2k0_, weight_j0i2k0_);
    metal::float4 sum_j0i2k0_ = (((sum_j0i1k0_ + weighed_j0i1k1_) + weighed_j0i1k2_) + weighed_j0i1k3_) + weighed_j0i2k0_;
    float z_j0i2k2_ = (unnamed_6.w - centre.w) / 0.1;
    float weight_j0i2k2_ = metal::exp2(((z_j0i2k2_ * z_j0i2k2_) + 1.25) * -0.7213475);
    metal::float4 weighed_j0i2k2_ = metal::float4((unnamed_6.xyz - centre.xyz) * weight_j0i2k2_, weight_j0i2k2_);
    metal::float4 texel_j1_i0_ = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(0, 1))))), metal::int2(0), last)), 0);
    bool counts_j1_i0_ = metal::all(metal::abs(texel_j1_i0_.xy) < metal::float2(300000000000000000000000000000000000000.0)) & (metal::abs(texel_j1_i0_.z) < 300000000000000000000000000000000000000.0);
    float bounded_j1_i0_ = (metal::abs(texel_j1_i0_.w) < 1000000000000000000000000000000.0) ? texel_j1_i0_.w : 1000000000000000000000000000000.0;
    metal::float4 counted_j1_i0_ = metal::float4(texel_j1_i0_.xyz, bounded_j1_i0_);
    metal::float4 taps_0_j1_i0_ = counts_j1_i0_ ? counted_j1_i0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_7 = metal::quad_shuffle_xor(taps_0_j1_i0_, 1u);
    metal::float4 unnamed_8 = metal::quad_shuffle_xor(taps_0_j1_i0_, 2u);
    metal::float4 unnamed_9 = metal::quad_shuffle_xor(taps_0_j1_i0_, 3u);
    float z_j1i0k0_ = (taps_0_j1_i0_.w - centre.w) / 0.1;
    float weight_j1i0k0_ = metal::exp2(((z_j1i0k0_ * z_j1i0k0_) + 0.25) * -0.7213475);
    metal::float4 weighed_j1i0k0_ = metal::float4((taps_0_j1_i0_.xyz - centre.xyz) * weight_j1i0k0_, weight_j1i0k0_);
    float z_j1i0k1_ = (unnamed_7.w - centre.w) / 0.1;
    float weight_j1i0k1_ = metal::exp2(((z_j1i0k1_ * z_j1i0k1_) + 0.5) * -0.7213475);
    metal::float4 weighed_j1i0k1_ = metal::float4((unnamed_7.xyz - centre.xyz) * weight_j1i0k1_, weight_j1i0k1_);
    float z_j1i0k2_ = (unnamed_8.w - centre.w) / 0.1;
    float weight_j1i0k2_ = metal::exp2(((z_j1i0k2_ * z_j1i0k2_) + 1.0) * -0.7213475);
    metal::float4 weighed_j1i0k2_ = metal::float4((unnamed_8.xyz - centre.xyz) * weight_j1i0k2_, weight_j1i0k2_);
    metal::float4 sum_j1i0k2_ = (((sum_j0i2k0_ + weighed_j0i2k2_) + weighed_j1i0k0_) + weighed_j1i0k1_) + weighed_j1i0k2_;
    float z_j1i0k3_ = (unnamed_9.w - centre.w) / 0.1;
    float weight_j1i0k3_ = metal::exp2(((z_j1i0k3_ * z_j1i0k3_) + 1.25) * -0.7213475);
    metal::float4 weighed_j1i0k3_ = metal::float4((unnamed_9.xyz - centre.xyz) * weight_j1i0k3_, weight_j1i0k3_);
    metal::float4 texel_j1_i1_ = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(outwards)), metal::int2(0), last)), 0);
    bool counts_j1_i1_ = metal::all(metal::abs(texel_j1_i1_.xy) < metal::float2(300000000000000000000000000000000000000.0)) & (metal::abs(texel_j1_i1_.z) < 300000000000000000000000000000000000000.0);
    float bounded_j1_i1_ = (metal::abs(texel_j1_i1_.w) < 1000000000000000000000000000000.0) ? texel_j1_i1_.w : 1000000000000000000000000000000.0;
    metal::float4 counted_j1_i1_ = metal::float4(texel_j1_i1_.xyz, bounded_j1_i1_);
    metal::float4 taps_0_j1_i1_ = counts_j1_i1_ ? counted_j1_i1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_10 = metal::quad_shuffle_xor(taps_0_j1_i1_, 1u);
    metal::float4 unnamed_11 = metal::quad_shuffle_xor(taps_0_j1_i1_, 2u);
    metal::float4 unnamed_12 = metal::quad_shuffle_xor(taps_0_j1_i1_, 3u);
    float z_j1i1k0_ = (taps_0_j1_i1_.w - centre.w) / 0.1;
    float weight_j1i1k0_ = metal::exp2(((z_j1i1k0_ * z_j1i1k0_) + 0.5) * -0.7213475);
    metal::float4 weighed_j1i1k0_ = metal::float4((taps_0_j1_i1_.xyz - centre.xyz) * weight_j1i1k0_, weight_j1i1k0_);
    float z_j1i1k1_ = (unnamed_10.w - centre.w) / 0.1;
    float weight_j1i1k1_ = metal::exp2(((z_j1i1k1_ * z_j1i1k1_) + 1.25) * -0.7213475);
    metal::float4 weighed_j1i1k1_ = metal::float4((unnamed_10.xyz - centre.xyz) * weight_j1i1k1_, weight_j1i1k1_);
    float z_j1i1k2_ = (unnamed_11.w - centre.w) / 0.1;
    float weight_j1i1k2_ = metal::exp2(((z_j1i1k2_ * z_j1i1k2_) + 1.25) * -0.7213475);
    metal::float4 weighed_j1i1k2_ = metal::float4((unnamed_11.xyz - centre.xyz) * weight_j1i1k2_, weight_j1i1k2_);
    metal::float4 sum_j1i1k2_ = (((sum_j1i0k2_ + weighed_j1i0k3_) + weighed_j1i1k0_) + weighed_j1i1k1_) + weighed_j1i1k2_;
    float z_j1i1k3_ = (unnamed_12.w - centre.w) / 0.1;
    float weight_j1i1k3_ = metal::exp2(((z_j1i1k3_ * z_j1i1k3_) + 2.0) * -0.7213475);
    metal::float4 weighed_j1i1k3_ = metal::float4((unnamed_12.xyz - centre.xyz) * weight_j1i1k3_, weight_j1i1k3_);
    metal::float4 texel_j1_i2_ = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(2, 1))))), metal::int2(0), last)), 0);
    bool counts_j1_i2_ = metal::all(metal::abs(texel_j1_i2_.xy) < metal::float2(300000000000000000000000000000000000000.0)) & (metal::abs(texel_j1_i2_.z) < 300000000000000000000000000000000000000.0);
    float bounded_j1_i2_ = (metal::abs(texel_j1_i2_.w) < 1000000000000000000000000000000.0) ? texel_j1_i2_.w : 1000000000000000000000000000000.0;
    metal::float4 counted_j1_i2_ = metal::float4(texel_j1_i2_.xyz, bounded_j1_i2_);
    metal::float4 taps_0_j1_i2_ = counts_j1_i2_ ? counted_j1_i2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_13 = metal::quad_shuffle_xor(taps_0_j1_i2_, 2u);
    float z_j1i2k0_ = (taps_0_j1_i2_.w - centre.w) / 0.1;
    float weight_j1i2k0_ = metal::exp2(((z_j1i2k0_ * z_j1i2k0_) + 1.25) * -0.7213475);
    metal::float4 weighed_j1i2k0_ = metal::float4((taps_0_j1_i2_.xyz - centre.xyz) * weight_j1i2k0_, weight_j1i2k0_);
    float z_j1i2k2_ = (unnamed_13.w - centre.w) / 0.1;
    float weight_j1i2k2_ = metal::exp2(((z_j1i2k2_ * z_j1i2k2_) + 2.0) * -0.7213475);
    metal::float4 weighed_j1i2k2_ = metal::float4((unnamed_13.xyz - centre.xyz) * weight_j1i2k2_, weight_j1i2k2_);
    metal::float4 texel_j2_i0_ = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(0, 2))))), metal::int2(0), last)), 0);
    bool counts_j2_i0_ = metal::all(metal::abs(texel_j2_i0_.xy) < metal::float2(300000000000000000000000000000000000000.0)) & (metal::abs(texel_j2_i0_.z) < 300000000000000000000000000000000000000.0);
    float bounded_j2_i0_ = (metal::abs(texel_j2_i0_.w) < 1000000000000000000000000000000.0) ? texel_j2_i0_.w : 1000000000000000000000000000000.0;
    metal::float4 counted_j2_i0_ = metal::float4(texel_j2_i0_.xyz, bounded_j2_i0_);
    metal::float4 taps_0_j2_i0_ = counts_j2_i0_ ? counted_j2_i0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_14 = metal::quad_shuffle_xor(taps_0_j2_i0_, 1u);
    float z_j2i0k0_ = (taps_0_j2_i0_.w - centre.w) / 0.1;
    float weight_j2i0k0_ = metal::exp2(((z_j2i0k0_ * z_j2i0k0_) + 1.0) * -0.7213475);
    metal::float4 weighed_j2i0k0_ = metal::float4((taps_0_j2_i0_.xyz - centre.xyz) * weight_j2i0k0_, weight_j2i0k0_);
    metal::float4 sum_j2i0k0_ = (((sum_j1i1k2_ + weighed_j1i1k3_) + weighed_j1i2k0_) + weighed_j1i2k2_) + weighed_j2i0k0_;
    float z_j2i0k1_ = (unnamed_14.w - centre.w) / 0.1;
    float weight_j2i0k1_ = metal::exp2(((z_j2i0k1_ * z_j2i0k1_) + 1.25) * -0.7213475);
    metal::float4 weighed_j2i0k1_ = metal::float4((unnamed_14.xyz - centre.xyz) * weight_j2i0k1_, weight_j2i0k1_);
    metal::float4 texel_j2_i1_ = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(1, 2))))), metal::int2(0), last)), 0);
    bool counts_j2_i1_ = metal::all(metal::abs(texel_j2_i1_.xy) < metal::float2(300000000000000000000000000000000000000.0)) & (metal::abs(texel_j2_i1_.z) < 300000000000000000000000000000000000000.0);
    float bounded_j2_i1_ = (metal::abs(texel_j2_i1_.w) < 1000000000000000000000000000000.0) ? texel_j2_i1_.w : 1000000000000000000000000000000.0;
    metal::float4 counted_j2_i1_ = metal::float4(texel_j2_i1_.xyz, bounded_j2_i1_);
    metal::float4 taps_0_j2_i1_ = counts_j2_i1_ ? counted_j2_i1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_15 = metal::quad_shuffle_xor(taps_0_j2_i1_, 1u);
    float z_j2i1k0_ = (taps_0_j2_i1_.w - centre.w) / 0.1;
    float weight_j2i1k0_ = metal::exp2(((z_j2i1k0_ * z_j2i1k0_) + 1.25) * -0.7213475);
    metal::float4 weighed_j2i1k0_ = metal::float4((taps_0_j2_i1_.xyz - centre.xyz) * weight_j2i1k0_, weight_j2i1k0_);
    float z_j2i1k1_ = (unnamed_15.w - centre.w) / 0.1;
    float weight_j2i1k1_ = metal::exp2(((z_j2i1k1_ * z_j2i1k1_) + 2.0) * -0.7213475);
    metal::float4 weighed_j2i1k1_ = metal::float4((unnamed_15.xyz - centre.xyz) * weight_j2i1k1_, weight_j2i1k1_);
    metal::float4 texel_j2_i2_ = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<uint>(2)))), metal::int2(0), last)), 0);
    bool counts_j2_i2_ = metal::all(metal::abs(texel_j2_i2_.xy) < metal::float2(300000000000000000000000000000000000000.0)) & (metal::abs(texel_j2_i2_.z) < 300000000000000000000000000000000000000.0);
    float bounded_j2_i2_ = (metal::abs(texel_j2_i2_.w) < 1000000000000000000000000000000.0) ? texel_j2_i2_.w : 1000000000000000000000000000000.0;
    metal::float4 counted_j2_i2_ = metal::float4(texel_j2_i2_.xyz, bounded_j2_i2_);
    metal::float4 taps_0_j2_i2_ = counts_j2_i2_ ? counted_j2_i2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j2i2k0_ = (taps_0_j2_i2_.w - centre.w) / 0.1;
    float weight_j2i2k0_ = metal::exp2(((z_j2i2k0_ * z_j2i2k0_) + 2.0) * -0.7213475);
    metal::float4 weighed_j2i2k0_ = metal::float4((taps_0_j2_i2_.xyz - centre.xyz) * weight_j2i2k0_, weight_j2i2k0_);
    metal::float4 sum_j2i2k0_ = (((sum_j2i0k0_ + weighed_j2i0k1_) + weighed_j2i1k0_) + weighed_j2i1k1_) + weighed_j2i2k0_;
    return quad_bilateralOutput { metal::float4(centre.xyz + (sum_j2i2k0_.xyz / metal::float3(sum_j2i2k0_.w)), bounded) };
}
