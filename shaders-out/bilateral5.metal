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
    bool local = {};
    bool local_1 = {};
    bool local_2 = {};
    bool local_3 = {};
    bool local_4 = {};
    bool local_5 = {};
    bool local_6 = {};
    bool local_7 = {};
    bool local_8 = {};
    bool local_9 = {};
    bool local_10 = {};
    bool local_11 = {};
    bool local_12 = {};
    bool local_13 = {};
    bool local_14 = {};
    bool local_15 = {};
    bool local_16 = {};
    bool local_17 = {};
    metal::int2 pixel = naga_f2i32(metal::floor(position.xy));
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(image.get_width(), image.get_height()));
    metal::int2 lane = pixel & metal::int2(1);
    metal::float2 quad_vector = (static_cast<metal::float2>(lane) * metal::float2(2.0)) - metal::float2(1.0);
    metal::int2 outwards = naga_f2i32(quad_vector);
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 texel = metal::clamp(pixel, metal::int2(0), last);
    metal::float4 own = image.read(metal::uint2(texel), 0);
    if (metal::abs(own.x) < 300000000000000000000000000000000000000.0) {
        local = metal::abs(own.y) < 300000000000000000000000000000000000000.0;
    } else {
        local = false;
    }
    bool _e38 = local;
    if (_e38) {
        local_1 = metal::abs(own.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_1 = false;
    }
    bool counts = local_1;
    float chosen = (metal::abs(own.w) < 1000000000000000000000000000000.0) ? own.w : 1000000000000000000000000000000.0;
    metal::float4 counted = metal::float4(own.x, own.y, own.z, chosen);
    metal::float4 centre = counts ? counted : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed = metal::quad_shuffle_xor(centre, 1u);
    metal::float4 unnamed_1 = metal::quad_shuffle_xor(centre, 2u);
    metal::float4 unnamed_2 = metal::quad_shuffle_xor(centre, 3u);
    float z_j0_i0_k0_ = (centre.w - centre.w) / 0.1;
    float weight_j0_i0_k0_ = metal::exp2((z_j0_i0_k0_ * z_j0_i0_k0_) * -0.7213475);
    metal::float3 value = metal::float3(centre.x, centre.y, centre.z);
    metal::float3 value_2_ = (value - value) * weight_j0_i0_k0_;
    metal::float4 sum_j0_i0_k0_ = metal::float4(0.0) + metal::float4(value_2_.x, value_2_.y, value_2_.z, weight_j0_i0_k0_);
    float z_j0_i0_k1_ = (unnamed.w - centre.w) / 0.1;
    float weight_j0_i0_k1_ = metal::exp2(((z_j0_i0_k1_ * z_j0_i0_k1_) + 0.25) * -0.7213475);
    metal::float3 value_3_ = (metal::float3(unnamed.x, unnamed.y, unnamed.z) - value) * weight_j0_i0_k1_;
    metal::float4 sum_j0_i0_k1_ = sum_j0_i0_k0_ + metal::float4(value_3_.x, value_3_.y, value_3_.z, weight_j0_i0_k1_);
    float z_j0_i0_k2_ = (unnamed_1.w - centre.w) / 0.1;
    float weight_j0_i0_k2_ = metal::exp2(((z_j0_i0_k2_ * z_j0_i0_k2_) + 0.25) * -0.7213475);
    metal::float3 value_4_ = (metal::float3(unnamed_1.x, unnamed_1.y, unnamed_1.z) - value) * weight_j0_i0_k2_;
    metal::float4 sum_j0_i0_k2_ = sum_j0_i0_k1_ + metal::float4(value_4_.x, value_4_.y, value_4_.z, weight_j0_i0_k2_);
    float z_j0_i0_k3_ = (unnamed_2.w - centre.w) / 0.1;
    float weight_j0_i0_k3_ = metal::exp2(((z_j0_i0_k3_ * z_j0_i0_k3_) + 0.5) * -0.7213475);
    metal::float3 value_5_ = (metal::float3(unnamed_2.x, unnamed_2.y, unnamed_2.z) - value) * weight_j0_i0_k3_;
    metal::float4 sum_j0_i0_k3_ = sum_j0_i0_k2_ + metal::float4(value_5_.x, value_5_.y, value_5_.z, weight_j0_i0_k3_);
    metal::int2 texel_j0_i1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(1, 0))))), metal::int2(0), last);
    metal::float4 image_texel = image.read(metal::uint2(texel_j0_i1_), 0);
    if (metal::abs(image_texel.x) < 300000000000000000000000000000000000000.0) {
        local_2 = metal::abs(image_texel.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_2 = false;
    }
    bool _e177 = local_2;
    if (_e177) {
        local_3 = metal::abs(image_texel.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_3 = false;
    }
    bool counts_j0_i1_ = local_3;
    metal::float4 counted_j0_i1_ = metal::float4(image_texel.x, image_texel.y, image_texel.z, (metal::abs(image_texel.w) < 1000000000000000000000000000000.0) ? image_texel.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j0_i1_ = counts_j0_i1_ ? counted_j0_i1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_3 = metal::quad_shuffle_xor(taps_0_j0_i1_, 1u);
    metal::float4 unnamed_4 = metal::quad_shuffle_xor(taps_0_j0_i1_, 2u);
    metal::float4 unnamed_5 = metal::quad_shuffle_xor(taps_0_j0_i1_, 3u);
    float z_j0_i1_k0_ = (taps_0_j0_i1_.w - centre.w) / 0.1;
    float weight_j0_i1_k0_ = metal::exp2(((z_j0_i1_k0_ * z_j0_i1_k0_) + 0.25) * -0.7213475);
    metal::float3 value_6_ = (metal::float3(taps_0_j0_i1_.x, taps_0_j0_i1_.y, taps_0_j0_i1_.z) - value) * weight_j0_i1_k0_;
    metal::float4 sum_j0_i1_k0_ = sum_j0_i0_k3_ + metal::float4(value_6_.x, value_6_.y, value_6_.z, weight_j0_i1_k0_);
    float z_j0_i1_k1_ = (unnamed_3.w - centre.w) / 0.1;
    float weight_j0_i1_k1_ = metal::exp2(((z_j0_i1_k1_ * z_j0_i1_k1_) + 1.0) * -0.7213475);
    metal::float3 value_7_ = (metal::float3(unnamed_3.x, unnamed_3.y, unnamed_3.z) - value) * weight_j0_i1_k1_;
    metal::float4 sum_j0_i1_k1_ = sum_j0_i1_k0_ + metal::float4(value_7_.x, value_7_.y, value_7_.z, weight_j0_i1_k1_);
    float z_j0_i1_k2_ = (unnamed_4.w - centre.w) / 0.1;
    float weight_j0_i1_k2_ = metal::exp2(((z_j0_i1_k2_ * z_j0_i1_k2_) + 0.5) * -0.7213475);
    metal::float3 value_8_ = (metal::float3(unnamed_4.x, unnamed_4.y, unnamed_4.z) - value) * weight_j0_i1_k2_;
    metal::float4 sum_j0_i1_k2_ = sum_j0_i1_k1_ + metal::float4(value_8_.x, value_8_.y, value_8_.z, weight_j0_i1_k2_);
    float z_j0_i1_k3_ = (unnamed_5.w - centre.w) / 0.1;
    float weight_j0_i1_k3_ = metal::exp2(((z_j0_i1_k3_ * z_j0_i1_k3_) + 1.25) * -0.7213475);
    metal::float3 value_9_ = (metal::float3(unnamed_5.x, unnamed_5.y, unnamed_5.z) - value) * weight_j0_i1_k3_;
    metal::float4 sum_j0_i1_k3_ = sum_j0_i1_k2_ + metal::float4(value_9_.x, value_9_.y, value_9_.z, weight_j0_i1_k3_);
    metal::int2 texel_j0_i2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(2, 0))))), metal::int2(0), last);
    metal::float4 image_texel_2_ = image.read(metal::uint2(texel_j0_i2_), 0);
    if (metal::abs(image_texel_2_.x) < 300000000000000000000000000000000000000.0) {
        local_4 = metal::abs(image_texel_2_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_4 = false;
    }
    bool _e316 = local_4;
    if (_e316) {
        local_5 = metal::abs(image_texel_2_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_5 = false;
    }
    bool counts_j0_i2_ = local_5;
    metal::float4 counted_j0_i2_ = metal::float4(image_texel_2_.x, image_texel_2_.y, image_texel_2_.z, (metal::abs(image_texel_2_.w) < 1000000000000000000000000000000.0) ? image_texel_2_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j0_i2_ = counts_j0_i2_ ? counted_j0_i2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_6 = metal::quad_shuffle_xor(taps_0_j0_i2_, 2u);
    float z_j0_i2_k0_ = (taps_0_j0_i2_.w - centre.w) / 0.1;
    float weight_j0_i2_k0_ = metal::exp2(((z_j0_i2_k0_ * z_j0_i2_k0_) + 1.0) * -0.7213475);
    metal::float3 value_10_ = (metal::float3(taps_0_j0_i2_.x, taps_0_j0_i2_.y, taps_0_j0_i2_.z) - value) * weight_j0_i2_k0_;
    metal::float4 sum_j0_i2_k0_ = sum_j0_i1_k3_ + metal::float4(value_10_.x, value_10_.y, value_10_.z, weight_j0_i2_k0_);
    float z_j0_i2_k2_ = (unnamed_6.w - centre.w) / 0.1;
    float weight_j0_i2_k2_ = metal::exp2(((z_j0_i2_k2_ * z_j0_i2_k2_) + 1.25) * -0.7213475);
    metal::float3 value_11_ = (metal::float3(unnamed_6.x, unnamed_6.y, unnamed_6.z) - value) * weight_j0_i2_k2_;
    metal::float4 sum_j0_i2_k2_ = sum_j0_i2_k0_ + metal::float4(value_11_.x, value_11_.y, value_11_.z, weight_j0_i2_k2_);
    metal::int2 texel_j1_i0_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(0, 1))))), metal::int2(0), last);
    metal::float4 image_texel_3_ = image.read(metal::uint2(texel_j1_i0_), 0);
    if (metal::abs(image_texel_3_.x) < 300000000000000000000000000000000000000.0) {
        local_6 = metal::abs(image_texel_3_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_6 = false;
    }
    bool _e409 = local_6;
    if (_e409) {
        local_7 = metal::abs(image_texel_3_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_7 = false;
    }
    bool counts_j1_i0_ = local_7;
    metal::float4 counted_j1_i0_ = metal::float4(image_texel_3_.x, image_texel_3_.y, image_texel_3_.z, (metal::abs(image_texel_3_.w) < 1000000000000000000000000000000.0) ? image_texel_3_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i0_ = counts_j1_i0_ ? counted_j1_i0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_7 = metal::quad_shuffle_xor(taps_0_j1_i0_, 1u);
    metal::float4 unnamed_8 = metal::quad_shuffle_xor(taps_0_j1_i0_, 2u);
    metal::float4 unnamed_9 = metal::quad_shuffle_xor(taps_0_j1_i0_, 3u);
    float z_j1_i0_k0_ = (taps_0_j1_i0_.w - centre.w) / 0.1;
    float weight_j1_i0_k0_ = metal::exp2(((z_j1_i0_k0_ * z_j1_i0_k0_) + 0.25) * -0.7213475);
    metal::float3 value_12_ = (metal::float3(taps_0_j1_i0_.x, taps_0_j1_i0_.y, taps_0_j1_i0_.z) - value) * weight_j1_i0_k0_;
    metal::float4 sum_j1_i0_k0_ = sum_j0_i2_k2_ + metal::float4(value_12_.x, value_12_.y, value_12_.z, weight_j1_i0_k0_);
    float z_j1_i0_k1_ = (unnamed_7.w - centre.w) / 0.1;
    float weight_j1_i0_k1_ = metal::exp2(((z_j1_i0_k1_ * z_j1_i0_k1_) + 0.5) * -0.7213475);
    metal::float3 value_13_ = (metal::float3(unnamed_7.x, unnamed_7.y, unnamed_7.z) - value) * weight_j1_i0_k1_;
    metal::float4 sum_j1_i0_k1_ = sum_j1_i0_k0_ + metal::float4(value_13_.x, value_13_.y, value_13_.z, weight_j1_i0_k1_);
    float z_j1_i0_k2_ = (unnamed_8.w - centre.w) / 0.1;
    float weight_j1_i0_k2_ = metal::exp2(((z_j1_i0_k2_ * z_j1_i0_k2_) + 1.0) * -0.7213475);
    metal::float3 value_14_ = (metal::float3(unnamed_8.x, unnamed_8.y, unnamed_8.z) - value) * weight_j1_i0_k2_;
    metal::float4 sum_j1_i0_k2_ = sum_j1_i0_k1_ + metal::float4(value_14_.x, value_14_.y, value_14_.z, weight_j1_i0_k2_);
    float z_j1_i0_k3_ = (unnamed_9.w - centre.w) / 0.1;
    float weight_j1_i0_k3_ = metal::exp2(((z_j1_i0_k3_ * z_j1_i0_k3_) + 1.25) * -0.7213475);
    metal::float3 value_15_ = (metal::float3(unnamed_9.x, unnamed_9.y, unnamed_9.z) - value) * weight_j1_i0_k3_;
    metal::float4 sum_j1_i0_k3_ = sum_j1_i0_k2_ + metal::float4(value_15_.x, value_15_.y, value_15_.z, weight_j1_i0_k3_);
    metal::int2 texel_j1_i1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(outwards)), metal::int2(0), last);
    metal::float4 image_texel_4_ = image.read(metal::uint2(texel_j1_i1_), 0);
    if (metal::abs(image_texel_4_.x) < 300000000000000000000000000000000000000.0) {
        local_8 = metal::abs(image_texel_4_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_8 = false;
    }
    bool _e544 = local_8;
    if (_e544) {
        local_9 = metal::abs(image_texel_4_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_9 = false;
    }
    bool counts_j1_i1_ = local_9;
    metal::float4 counted_j1_i1_ = metal::float4(image_texel_4_.x, image_texel_4_.y, image_texel_4_.z, (metal::abs(image_texel_4_.w) < 1000000000000000000000000000000.0) ? image_texel_4_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i1_ = counts_j1_i1_ ? counted_j1_i1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_10 = metal::quad_shuffle_xor(taps_0_j1_i1_, 1u);
    metal::float4 unnamed_11 = metal::quad_shuffle_xor(taps_0_j1_i1_, 2u);
    metal::float4 unnamed_12 = metal::quad_shuffle_xor(taps_0_j1_i1_, 3u);
    float z_j1_i1_k0_ = (taps_0_j1_i1_.w - centre.w) / 0.1;
    float weight_j1_i1_k0_ = metal::exp2(((z_j1_i1_k0_ * z_j1_i1_k0_) + 0.5) * -0.7213475);
    metal::float3 value_16_ = (metal::float3(taps_0_j1_i1_.x, taps_0_j1_i1_.y, taps_0_j1_i1_.z) - value) * weight_j1_i1_k0_;
    metal::float4 sum_j1_i1_k0_ = sum_j1_i0_k3_ + metal::float4(value_16_.x, value_16_.y, value_16_.z, weight_j1_i1_k0_);
    float z_j1_i1_k1_ = (unnamed_10.w - centre.w) / 0.1;
    float weight_j1_i1_k1_ = metal::exp2(((z_j1_i1_k1_ * z_j1_i1_k1_) + 1.25) * -0.7213475);
    metal::float3 value_17_ = (metal::float3(unnamed_10.x, unnamed_10.y, unnamed_10.z) - value) * weight_j1_i1_k1_;
    metal::float4 sum_j1_i1_k1_ = sum_j1_i1_k0_ + metal::float4(value_17_.x, value_17_.y, value_17_.z, weight_j1_i1_k1_);
    float z_j1_i1_k2_ = (unnamed_11.w - centre.w) / 0.1;
    float weight_j1_i1_k2_ = metal::exp2(((z_j1_i1_k2_ * z_j1_i1_k2_) + 1.25) * -0.7213475);
    metal::float3 value_18_ = (metal::float3(unnamed_11.x, unnamed_11.y, unnamed_11.z) - value) * weight_j1_i1_k2_;
    metal::float4 sum_j1_i1_k2_ = sum_j1_i1_k1_ + metal::float4(value_18_.x, value_18_.y, value_18_.z, weight_j1_i1_k2_);
    float z_j1_i1_k3_ = (unnamed_12.w - centre.w) / 0.1;
    float weight_j1_i1_k3_ = metal::exp2(((z_j1_i1_k3_ * z_j1_i1_k3_) + 2.0) * -0.7213475);
    metal::float3 value_19_ = (metal::float3(unnamed_12.x, unnamed_12.y, unnamed_12.z) - value) * weight_j1_i1_k3_;
    metal::float4 sum_j1_i1_k3_ = sum_j1_i1_k2_ + metal::float4(value_19_.x, value_19_.y, value_19_.z, weight_j1_i1_k3_);
    metal::int2 texel_j1_i2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(2, 1))))), metal::int2(0), last);
    metal::float4 image_texel_5_ = image.read(metal::uint2(texel_j1_i2_), 0);
    if (metal::abs(image_texel_5_.x) < 300000000000000000000000000000000000000.0) {
        local_10 = metal::abs(image_texel_5_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_10 = false;
    }
    bool _e683 = local_10;
    if (_e683) {
        local_11 = metal::abs(image_texel_5_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_11 = false;
    }
    bool counts_j1_i2_ = local_11;
    metal::float4 counted_j1_i2_ = metal::float4(image_texel_5_.x, image_texel_5_.y, image_texel_5_.z, (metal::abs(image_texel_5_.w) < 1000000000000000000000000000000.0) ? image_texel_5_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i2_ = counts_j1_i2_ ? counted_j1_i2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_13 = metal::quad_shuffle_xor(taps_0_j1_i2_, 2u);
    float z_j1_i2_k0_ = (taps_0_j1_i2_.w - centre.w) / 0.1;
    float weight_j1_i2_k0_ = metal::exp2(((z_j1_i2_k0_ * z_j1_i2_k0_) + 1.25) * -0.7213475);
    metal::float3 value_20_ = (metal::float3(taps_0_j1_i2_.x, taps_0_j1_i2_.y, taps_0_j1_i2_.z) - value) * weight_j1_i2_k0_;
    metal::float4 sum_j1_i2_k0_ = sum_j1_i1_k3_ + metal::float4(value_20_.x, value_20_.y, value_20_.z, weight_j1_i2_k0_);
    float z_j1_i2_k2_ = (unnamed_13.w - centre.w) / 0.1;
    float weight_j1_i2_k2_ = metal::exp2(((z_j1_i2_k2_ * z_j1_i2_k2_) + 2.0) * -0.7213475);
    metal::float3 value_21_ = (metal::float3(unnamed_13.x, unnamed_13.y, unnamed_13.z) - value) * weight_j1_i2_k2_;
    metal::float4 sum_j1_i2_k2_ = sum_j1_i2_k0_ + metal::float4(value_21_.x, value_21_.y, value_21_.z, weight_j1_i2_k2_);
    metal::int2 texel_j2_i0_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(0, 2))))), metal::int2(0), last);
    metal::float4 image_texel_6_ = image.read(metal::uint2(texel_j2_i0_), 0);
    if (metal::abs(image_texel_6_.x) < 300000000000000000000000000000000000000.0) {
        local_12 = metal::abs(image_texel_6_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_12 = false;
    }
    bool _e776 = local_12;
    if (_e776) {
        local_13 = metal::abs(image_texel_6_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_13 = false;
    }
    bool counts_j2_i0_ = local_13;
    metal::float4 counted_j2_i0_ = metal::float4(image_texel_6_.x, image_texel_6_.y, image_texel_6_.z, (metal::abs(image_texel_6_.w) < 1000000000000000000000000000000.0) ? image_texel_6_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i0_ = counts_j2_i0_ ? counted_j2_i0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_14 = metal::quad_shuffle_xor(taps_0_j2_i0_, 1u);
    float z_j2_i0_k0_ = (taps_0_j2_i0_.w - centre.w) / 0.1;
    float weight_j2_i0_k0_ = metal::exp2(((z_j2_i0_k0_ * z_j2_i0_k0_) + 1.0) * -0.7213475);
    metal::float3 value_22_ = (metal::float3(taps_0_j2_i0_.x, taps_0_j2_i0_.y, taps_0_j2_i0_.z) - value) * weight_j2_i0_k0_;
    metal::float4 sum_j2_i0_k0_ = sum_j1_i2_k2_ + metal::float4(value_22_.x, value_22_.y, value_22_.z, weight_j2_i0_k0_);
    float z_j2_i0_k1_ = (unnamed_14.w - centre.w) / 0.1;
    float weight_j2_i0_k1_ = metal::exp2(((z_j2_i0_k1_ * z_j2_i0_k1_) + 1.25) * -0.7213475);
    metal::float3 value_23_ = (metal::float3(unnamed_14.x, unnamed_14.y, unnamed_14.z) - value) * weight_j2_i0_k1_;
    metal::float4 sum_j2_i0_k1_ = sum_j2_i0_k0_ + metal::float4(value_23_.x, value_23_.y, value_23_.z, weight_j2_i0_k1_);
    metal::int2 texel_j2_i1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(1, 2))))), metal::int2(0), last);
    metal::float4 image_texel_7_ = image.read(metal::uint2(texel_j2_i1_), 0);
    if (metal::abs(image_texel_7_.x) < 300000000000000000000000000000000000000.0) {
        local_14 = metal::abs(image_texel_7_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_14 = false;
    }
    bool _e869 = local_14;
    if (_e869) {
        local_15 = metal::abs(image_texel_7_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_15 = false;
    }
    bool counts_j2_i1_ = local_15;
    metal::float4 counted_j2_i1_ = metal::float4(image_texel_7_.x, image_texel_7_.y, image_texel_7_.z, (metal::abs(image_texel_7_.w) < 1000000000000000000000000000000.0) ? image_texel_7_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i1_ = counts_j2_i1_ ? counted_j2_i1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed_15 = metal::quad_shuffle_xor(taps_0_j2_i1_, 1u);
    float z_j2_i1_k0_ = (taps_0_j2_i1_.w - centre.w) / 0.1;
    float weight_j2_i1_k0_ = metal::exp2(((z_j2_i1_k0_ * z_j2_i1_k0_) + 1.25) * -0.7213475);
    metal::float3 value_24_ = (metal::float3(taps_0_j2_i1_.x, taps_0_j2_i1_.y, taps_0_j2_i1_.z) - value) * weight_j2_i1_k0_;
    metal::float4 sum_j2_i1_k0_ = sum_j2_i0_k1_ + metal::float4(value_24_.x, value_24_.y, value_24_.z, weight_j2_i1_k0_);
    float z_j2_i1_k1_ = (unnamed_15.w - centre.w) / 0.1;
    float weight_j2_i1_k1_ = metal::exp2(((z_j2_i1_k1_ * z_j2_i1_k1_) + 2.0) * -0.7213475);
    metal::float3 value_25_ = (metal::float3(unnamed_15.x, unnamed_15.y, unnamed_15.z) - value) * weight_j2_i1_k1_;
    metal::float4 sum_j2_i1_k1_ = sum_j2_i1_k0_ + metal::float4(value_25_.x, value_25_.y, value_25_.z, weight_j2_i1_k1_);
    metal::int2 texel_j2_i2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(2))))), metal::int2(0), last);
    metal::float4 image_texel_8_ = image.read(metal::uint2(texel_j2_i2_), 0);
    if (metal::abs(image_texel_8_.x) < 300000000000000000000000000000000000000.0) {
        local_16 = metal::abs(image_texel_8_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_16 = false;
    }
    bool _e961 = local_16;
    if (_e961) {
        local_17 = metal::abs(image_texel_8_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_17 = false;
    }
    bool counts_j2_i2_ = local_17;
    metal::float4 counted_j2_i2_ = metal::float4(image_texel_8_.x, image_texel_8_.y, image_texel_8_.z, (metal::abs(image_texel_8_.w) < 1000000000000000000000000000000.0) ? image_texel_8_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i2_ = counts_j2_i2_ ? counted_j2_i2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j2_i2_k0_ = (taps_0_j2_i2_.w - centre.w) / 0.1;
    float weight_j2_i2_k0_ = metal::exp2(((z_j2_i2_k0_ * z_j2_i2_k0_) + 2.0) * -0.7213475);
    metal::float3 value_26_ = (metal::float3(taps_0_j2_i2_.x, taps_0_j2_i2_.y, taps_0_j2_i2_.z) - value) * weight_j2_i2_k0_;
    metal::float4 sum_j2_i2_k0_ = sum_j2_i1_k1_ + metal::float4(value_26_.x, value_26_.y, value_26_.z, weight_j2_i2_k0_);
    metal::float3 value_27_ = value + (metal::float3(sum_j2_i2_k0_.x, sum_j2_i2_k0_.y, sum_j2_i2_k0_.z) / metal::float3(sum_j2_i2_k0_.w));
    return quad_bilateralOutput { metal::float4(value_27_.x, value_27_.y, value_27_.z, chosen) };
}
