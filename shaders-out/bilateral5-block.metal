// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;


struct quad_bilateralInput {
};
kernel void quad_bilateral(
  metal::uint3 id [[thread_position_in_grid]]
, metal::texture2d<float, metal::access::sample> image [[texture(0)]]
, metal::texture2d<float, metal::access::write> destination [[texture(1)]]
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
    bool local_18 = {};
    bool local_19 = {};
    bool local_20 = {};
    bool local_21 = {};
    bool local_22 = {};
    bool local_23 = {};
    bool local_24 = {};
    bool local_25 = {};
    bool local_26 = {};
    bool local_27 = {};
    bool local_28 = {};
    bool local_29 = {};
    bool local_30 = {};
    bool local_31 = {};
    bool local_32 = {};
    bool local_33 = {};
    bool local_34 = {};
    bool local_35 = {};
    bool local_36 = {};
    bool local_37 = {};
    bool local_38 = {};
    bool local_39 = {};
    bool local_40 = {};
    bool local_41 = {};
    bool local_42 = {};
    bool local_43 = {};
    bool local_44 = {};
    bool local_45 = {};
    bool local_46 = {};
    bool local_47 = {};
    bool local_48 = {};
    bool local_49 = {};
    bool local_50 = {};
    bool local_51 = {};
    bool local_52 = {};
    bool local_53 = {};
    bool local_54 = {};
    bool local_55 = {};
    bool local_56 = {};
    bool local_57 = {};
    bool local_58 = {};
    bool local_59 = {};
    bool local_60 = {};
    bool local_61 = {};
    bool local_62 = {};
    bool local_63 = {};
    bool local_64 = {};
    bool local_65 = {};
    bool local_66 = {};
    bool local_67 = {};
    bool local_68 = {};
    bool local_69 = {};
    bool local_70 = {};
    bool local_71 = {};
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(destination.get_width(), destination.get_height()));
    metal::int2 pixel = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(id.xy)) * as_type<metal::uint2>(metal::int2(2, 2)));
    if (metal::any(pixel >= frame)) {
        return;
    }
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 texel_l1_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0))), last);
    metal::int2 texel_l2_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1))), last);
    metal::int2 texel_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1))), last);
    metal::float4 own_l0_ = image.read(metal::uint2(pixel), 0);
    metal::float4 own_l1_ = image.read(metal::uint2(texel_l1_), 0);
    metal::float4 own_l2_ = image.read(metal::uint2(texel_l2_), 0);
    metal::float4 own_l3_ = image.read(metal::uint2(texel_l3_), 0);
    if (metal::abs(own_l0_.x) < 300000000000000000000000000000000000000.0) {
        local = metal::abs(own_l0_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local = false;
    }
    bool _e52 = local;
    if (_e52) {
        local_1 = metal::abs(own_l0_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_1 = false;
    }
    bool counts_l0_ = local_1;
    if (metal::abs(own_l1_.x) < 300000000000000000000000000000000000000.0) {
        local_2 = metal::abs(own_l1_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_2 = false;
    }
    bool _e72 = local_2;
    if (_e72) {
        local_3 = metal::abs(own_l1_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_3 = false;
    }
    bool counts_l1_ = local_3;
    if (metal::abs(own_l2_.x) < 300000000000000000000000000000000000000.0) {
        local_4 = metal::abs(own_l2_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_4 = false;
    }
    bool _e92 = local_4;
    if (_e92) {
        local_5 = metal::abs(own_l2_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_5 = false;
    }
    bool counts_l2_ = local_5;
    if (metal::abs(own_l3_.x) < 300000000000000000000000000000000000000.0) {
        local_6 = metal::abs(own_l3_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_6 = false;
    }
    bool _e112 = local_6;
    if (_e112) {
        local_7 = metal::abs(own_l3_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_7 = false;
    }
    bool counts_l3_ = local_7;
    float chosen = (metal::abs(own_l0_.w) < 1000000000000000000000000000000.0) ? own_l0_.w : 1000000000000000000000000000000.0;
    float chosen_2_ = (metal::abs(own_l1_.w) < 1000000000000000000000000000000.0) ? own_l1_.w : 1000000000000000000000000000000.0;
    float chosen_3_ = (metal::abs(own_l2_.w) < 1000000000000000000000000000000.0) ? own_l2_.w : 1000000000000000000000000000000.0;
    float chosen_4_ = (metal::abs(own_l3_.w) < 1000000000000000000000000000000.0) ? own_l3_.w : 1000000000000000000000000000000.0;
    metal::float4 counted_l0_ = metal::float4(own_l0_.x, own_l0_.y, own_l0_.z, chosen);
    metal::float4 counted_l1_ = metal::float4(own_l1_.x, own_l1_.y, own_l1_.z, chosen_2_);
    metal::float4 counted_l2_ = metal::float4(own_l2_.x, own_l2_.y, own_l2_.z, chosen_3_);
    metal::float4 counted_l3_ = metal::float4(own_l3_.x, own_l3_.y, own_l3_.z, chosen_4_);
    metal::float4 centre_l0_ = counts_l0_ ? counted_l0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 centre_l1_ = counts_l1_ ? counted_l1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 centre_l2_ = counts_l2_ ? counted_l2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 centre_l3_ = counts_l3_ ? counted_l3_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j0_i0_k0_l0_ = (centre_l0_.w - centre_l0_.w) / 0.1;
    float z_j0_i0_k0_l1_ = (centre_l1_.w - centre_l1_.w) / 0.1;
    float z_j0_i0_k0_l2_ = (centre_l2_.w - centre_l2_.w) / 0.1;
    float z_j0_i0_k0_l3_ = (centre_l3_.w - centre_l3_.w) / 0.1;
    float weight_j0_i0_k0_l0_ = metal::exp2((z_j0_i0_k0_l0_ * z_j0_i0_k0_l0_) * -0.7213475);
    float weight_j0_i0_k0_l1_ = metal::exp2((z_j0_i0_k0_l1_ * z_j0_i0_k0_l1_) * -0.7213475);
    float weight_j0_i0_k0_l2_ = metal::exp2((z_j0_i0_k0_l2_ * z_j0_i0_k0_l2_) * -0.7213475);
    float weight_j0_i0_k0_l3_ = metal::exp2((z_j0_i0_k0_l3_ * z_j0_i0_k0_l3_) * -0.7213475);
    metal::float3 value = metal::float3(centre_l0_.x, centre_l0_.y, centre_l0_.z);
    metal::float3 value_2_ = metal::float3(centre_l1_.x, centre_l1_.y, centre_l1_.z);
    metal::float3 value_3_ = metal::float3(centre_l2_.x, centre_l2_.y, centre_l2_.z);
    metal::float3 value_4_ = metal::float3(centre_l3_.x, centre_l3_.y, centre_l3_.z);
    metal::float3 value_5_ = (value - value) * weight_j0_i0_k0_l0_;
    metal::float3 value_6_ = (value_2_ - value_2_) * weight_j0_i0_k0_l1_;
    metal::float3 value_7_ = (value_3_ - value_3_) * weight_j0_i0_k0_l2_;
    metal::float3 value_8_ = (value_4_ - value_4_) * weight_j0_i0_k0_l3_;
    metal::float4 sum_j0_i0_k0_l0_ = metal::float4(0.0) + metal::float4(value_5_.x, value_5_.y, value_5_.z, weight_j0_i0_k0_l0_);
    metal::float4 sum_j0_i0_k0_l1_ = metal::float4(0.0) + metal::float4(value_6_.x, value_6_.y, value_6_.z, weight_j0_i0_k0_l1_);
    metal::float4 sum_j0_i0_k0_l2_ = metal::float4(0.0) + metal::float4(value_7_.x, value_7_.y, value_7_.z, weight_j0_i0_k0_l2_);
    metal::float4 sum_j0_i0_k0_l3_ = metal::float4(0.0) + metal::float4(value_8_.x, value_8_.y, value_8_.z, weight_j0_i0_k0_l3_);
    float z_j0_i0_k1_l0_ = (centre_l1_.w - centre_l0_.w) / 0.1;
    float z_j0_i0_k1_l1_ = (centre_l0_.w - centre_l1_.w) / 0.1;
    float z_j0_i0_k1_l2_ = (centre_l3_.w - centre_l2_.w) / 0.1;
    float z_j0_i0_k1_l3_ = (centre_l2_.w - centre_l3_.w) / 0.1;
    float weight_j0_i0_k1_l0_ = metal::exp2(((z_j0_i0_k1_l0_ * z_j0_i0_k1_l0_) + 0.25) * -0.7213475);
    float weight_j0_i0_k1_l1_ = metal::exp2(((z_j0_i0_k1_l1_ * z_j0_i0_k1_l1_) + 0.25) * -0.7213475);
    float weight_j0_i0_k1_l2_ = metal::exp2(((z_j0_i0_k1_l2_ * z_j0_i0_k1_l2_) + 0.25) * -0.7213475);
    float weight_j0_i0_k1_l3_ = metal::exp2(((z_j0_i0_k1_l3_ * z_j0_i0_k1_l3_) + 0.25) * -0.7213475);
    metal::float3 value_9_ = (value_2_ - value) * weight_j0_i0_k1_l0_;
    metal::float3 value_10_ = (value - value_2_) * weight_j0_i0_k1_l1_;
    metal::float3 value_11_ = (value_4_ - value_3_) * weight_j0_i0_k1_l2_;
    metal::float3 value_12_ = (value_3_ - value_4_) * weight_j0_i0_k1_l3_;
    metal::float4 sum_j0_i0_k1_l0_ = sum_j0_i0_k0_l0_ + metal::float4(value_9_.x, value_9_.y, value_9_.z, weight_j0_i0_k1_l0_);
    metal::float4 sum_j0_i0_k1_l1_ = sum_j0_i0_k0_l1_ + metal::float4(value_10_.x, value_10_.y, value_10_.z, weight_j0_i0_k1_l1_);
    metal::float4 sum_j0_i0_k1_l2_ = sum_j0_i0_k0_l2_ + metal::float4(value_11_.x, value_11_.y, value_11_.z, weight_j0_i0_k1_l2_);
    metal::float4 sum_j0_i0_k1_l3_ = sum_j0_i0_k0_l3_ + metal::float4(value_12_.x, value_12_.y, value_12_.z, weight_j0_i0_k1_l3_);
    float z_j0_i0_k2_l0_ = (centre_l2_.w - centre_l0_.w) / 0.1;
    float z_j0_i0_k2_l1_ = (centre_l3_.w - centre_l1_.w) / 0.1;
    float z_j0_i0_k2_l2_ = (centre_l0_.w - centre_l2_.w) / 0.1;
    float z_j0_i0_k2_l3_ = (centre_l1_.w - centre_l3_.w) / 0.1;
    float weight_j0_i0_k2_l0_ = metal::exp2(((z_j0_i0_k2_l0_ * z_j0_i0_k2_l0_) + 0.25) * -0.7213475);
    float weight_j0_i0_k2_l1_ = metal::exp2(((z_j0_i0_k2_l1_ * z_j0_i0_k2_l1_) + 0.25) * -0.7213475);
    float weight_j0_i0_k2_l2_ = metal::exp2(((z_j0_i0_k2_l2_ * z_j0_i0_k2_l2_) + 0.25) * -0.7213475);
    float weight_j0_i0_k2_l3_ = metal::exp2(((z_j0_i0_k2_l3_ * z_j0_i0_k2_l3_) + 0.25) * -0.7213475);
    metal::float3 value_13_ = (value_3_ - value) * weight_j0_i0_k2_l0_;
    metal::float3 value_14_ = (value_4_ - value_2_) * weight_j0_i0_k2_l1_;
    metal::float3 value_15_ = (value - value_3_) * weight_j0_i0_k2_l2_;
    metal::float3 value_16_ = (value_2_ - value_4_) * weight_j0_i0_k2_l3_;
    metal::float4 sum_j0_i0_k2_l0_ = sum_j0_i0_k1_l0_ + metal::float4(value_13_.x, value_13_.y, value_13_.z, weight_j0_i0_k2_l0_);
    metal::float4 sum_j0_i0_k2_l1_ = sum_j0_i0_k1_l1_ + metal::float4(value_14_.x, value_14_.y, value_14_.z, weight_j0_i0_k2_l1_);
    metal::float4 sum_j0_i0_k2_l2_ = sum_j0_i0_k1_l2_ + metal::float4(value_15_.x, value_15_.y, value_15_.z, weight_j0_i0_k2_l2_);
    metal::float4 sum_j0_i0_k2_l3_ = sum_j0_i0_k1_l3_ + metal::float4(value_16_.x, value_16_.y, value_16_.z, weight_j0_i0_k2_l3_);
    float z_j0_i0_k3_l0_ = (centre_l3_.w - centre_l0_.w) / 0.1;
    float z_j0_i0_k3_l1_ = (centre_l2_.w - centre_l1_.w) / 0.1;
    float z_j0_i0_k3_l2_ = (centre_l1_.w - centre_l2_.w) / 0.1;
    float z_j0_i0_k3_l3_ = (centre_l0_.w - centre_l3_.w) / 0.1;
    float weight_j0_i0_k3_l0_ = metal::exp2(((z_j0_i0_k3_l0_ * z_j0_i0_k3_l0_) + 0.5) * -0.7213475);
    float weight_j0_i0_k3_l1_ = metal::exp2(((z_j0_i0_k3_l1_ * z_j0_i0_k3_l1_) + 0.5) * -0.7213475);
    float weight_j0_i0_k3_l2_ = metal::exp2(((z_j0_i0_k3_l2_ * z_j0_i0_k3_l2_) + 0.5) * -0.7213475);
    float weight_j0_i0_k3_l3_ = metal::exp2(((z_j0_i0_k3_l3_ * z_j0_i0_k3_l3_) + 0.5) * -0.7213475);
    metal::float3 value_17_ = (value_4_ - value) * weight_j0_i0_k3_l0_;
    metal::float3 value_18_ = (value_3_ - value_2_) * weight_j0_i0_k3_l1_;
    metal::float3 value_19_ = (value_2_ - value_3_) * weight_j0_i0_k3_l2_;
    metal::float3 value_20_ = (value - value_4_) * weight_j0_i0_k3_l3_;
    metal::float4 sum_j0_i0_k3_l0_ = sum_j0_i0_k2_l0_ + metal::float4(value_17_.x, value_17_.y, value_17_.z, weight_j0_i0_k3_l0_);
    metal::float4 sum_j0_i0_k3_l1_ = sum_j0_i0_k2_l1_ + metal::float4(value_18_.x, value_18_.y, value_18_.z, weight_j0_i0_k3_l1_);
    metal::float4 sum_j0_i0_k3_l2_ = sum_j0_i0_k2_l2_ + metal::float4(value_19_.x, value_19_.y, value_19_.z, weight_j0_i0_k3_l2_);
    metal::float4 sum_j0_i0_k3_l3_ = sum_j0_i0_k2_l3_ + metal::float4(value_20_.x, value_20_.y, value_20_.z, weight_j0_i0_k3_l3_);
    metal::int2 texel_j0_i1_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, 0))), metal::int2(0));
    metal::int2 texel_j0_i1_l1_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, 0))), last);
    metal::int2 texel_j0_i1_l2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, 1))), metal::int2(0), last);
    metal::int2 texel_j0_i1_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, 1))), last);
    metal::float4 image_texel = image.read(metal::uint2(texel_j0_i1_l0_), 0);
    metal::float4 image_texel_2_ = image.read(metal::uint2(texel_j0_i1_l1_), 0);
    metal::float4 image_texel_3_ = image.read(metal::uint2(texel_j0_i1_l2_), 0);
    metal::float4 image_texel_4_ = image.read(metal::uint2(texel_j0_i1_l3_), 0);
    if (metal::abs(image_texel.x) < 300000000000000000000000000000000000000.0) {
        local_8 = metal::abs(image_texel.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_8 = false;
    }
    bool _e540 = local_8;
    if (_e540) {
        local_9 = metal::abs(image_texel.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_9 = false;
    }
    bool counts_j0_i1_l0_ = local_9;
    if (metal::abs(image_texel_2_.x) < 300000000000000000000000000000000000000.0) {
        local_10 = metal::abs(image_texel_2_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_10 = false;
    }
    bool _e560 = local_10;
    if (_e560) {
        local_11 = metal::abs(image_texel_2_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_11 = false;
    }
    bool counts_j0_i1_l1_ = local_11;
    if (metal::abs(image_texel_3_.x) < 300000000000000000000000000000000000000.0) {
        local_12 = metal::abs(image_texel_3_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_12 = false;
    }
    bool _e580 = local_12;
    if (_e580) {
        local_13 = metal::abs(image_texel_3_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_13 = false;
    }
    bool counts_j0_i1_l2_ = local_13;
    if (metal::abs(image_texel_4_.x) < 300000000000000000000000000000000000000.0) {
        local_14 = metal::abs(image_texel_4_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_14 = false;
    }
    bool _e600 = local_14;
    if (_e600) {
        local_15 = metal::abs(image_texel_4_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_15 = false;
    }
    bool counts_j0_i1_l3_ = local_15;
    metal::float4 counted_j0_i1_l0_ = metal::float4(image_texel.x, image_texel.y, image_texel.z, (metal::abs(image_texel.w) < 1000000000000000000000000000000.0) ? image_texel.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j0_i1_l1_ = metal::float4(image_texel_2_.x, image_texel_2_.y, image_texel_2_.z, (metal::abs(image_texel_2_.w) < 1000000000000000000000000000000.0) ? image_texel_2_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j0_i1_l2_ = metal::float4(image_texel_3_.x, image_texel_3_.y, image_texel_3_.z, (metal::abs(image_texel_3_.w) < 1000000000000000000000000000000.0) ? image_texel_3_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j0_i1_l3_ = metal::float4(image_texel_4_.x, image_texel_4_.y, image_texel_4_.z, (metal::abs(image_texel_4_.w) < 1000000000000000000000000000000.0) ? image_texel_4_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j0_i1_l0_ = counts_j0_i1_l0_ ? counted_j0_i1_l0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j0_i1_l1_ = counts_j0_i1_l1_ ? counted_j0_i1_l1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j0_i1_l2_ = counts_j0_i1_l2_ ? counted_j0_i1_l2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j0_i1_l3_ = counts_j0_i1_l3_ ? counted_j0_i1_l3_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j0_i1_k0_l0_ = (taps_0_j0_i1_l0_.w - centre_l0_.w) / 0.1;
    float z_j0_i1_k0_l1_ = (taps_0_j0_i1_l1_.w - centre_l1_.w) / 0.1;
    float z_j0_i1_k0_l2_ = (taps_0_j0_i1_l2_.w - centre_l2_.w) / 0.1;
    float z_j0_i1_k0_l3_ = (taps_0_j0_i1_l3_.w - centre_l3_.w) / 0.1;
    float weight_j0_i1_k0_l0_ = metal::exp2(((z_j0_i1_k0_l0_ * z_j0_i1_k0_l0_) + 0.25) * -0.7213475);
    float weight_j0_i1_k0_l1_ = metal::exp2(((z_j0_i1_k0_l1_ * z_j0_i1_k0_l1_) + 0.25) * -0.7213475);
    float weight_j0_i1_k0_l2_ = metal::exp2(((z_j0_i1_k0_l2_ * z_j0_i1_k0_l2_) + 0.25) * -0.7213475);
    float weight_j0_i1_k0_l3_ = metal::exp2(((z_j0_i1_k0_l3_ * z_j0_i1_k0_l3_) + 0.25) * -0.7213475);
    metal::float3 value_21_ = metal::float3(taps_0_j0_i1_l0_.x, taps_0_j0_i1_l0_.y, taps_0_j0_i1_l0_.z);
    metal::float3 value_22_ = metal::float3(taps_0_j0_i1_l1_.x, taps_0_j0_i1_l1_.y, taps_0_j0_i1_l1_.z);
    metal::float3 value_23_ = metal::float3(taps_0_j0_i1_l2_.x, taps_0_j0_i1_l2_.y, taps_0_j0_i1_l2_.z);
    metal::float3 value_24_ = metal::float3(taps_0_j0_i1_l3_.x, taps_0_j0_i1_l3_.y, taps_0_j0_i1_l3_.z);
    metal::float3 value_25_ = (value_21_ - value) * weight_j0_i1_k0_l0_;
    metal::float3 value_26_ = (value_22_ - value_2_) * weight_j0_i1_k0_l1_;
    metal::float3 value_27_ = (value_23_ - value_3_) * weight_j0_i1_k0_l2_;
    metal::float3 value_28_ = (value_24_ - value_4_) * weight_j0_i1_k0_l3_;
    metal::float4 sum_j0_i1_k0_l0_ = sum_j0_i0_k3_l0_ + metal::float4(value_25_.x, value_25_.y, value_25_.z, weight_j0_i1_k0_l0_);
    metal::float4 sum_j0_i1_k0_l1_ = sum_j0_i0_k3_l1_ + metal::float4(value_26_.x, value_26_.y, value_26_.z, weight_j0_i1_k0_l1_);
    metal::float4 sum_j0_i1_k0_l2_ = sum_j0_i0_k3_l2_ + metal::float4(value_27_.x, value_27_.y, value_27_.z, weight_j0_i1_k0_l2_);
    metal::float4 sum_j0_i1_k0_l3_ = sum_j0_i0_k3_l3_ + metal::float4(value_28_.x, value_28_.y, value_28_.z, weight_j0_i1_k0_l3_);
    float z_j0_i1_k1_l0_ = (taps_0_j0_i1_l1_.w - centre_l0_.w) / 0.1;
    float z_j0_i1_k1_l1_ = (taps_0_j0_i1_l0_.w - centre_l1_.w) / 0.1;
    float z_j0_i1_k1_l2_ = (taps_0_j0_i1_l3_.w - centre_l2_.w) / 0.1;
    float z_j0_i1_k1_l3_ = (taps_0_j0_i1_l2_.w - centre_l3_.w) / 0.1;
    float weight_j0_i1_k1_l0_ = metal::exp2(((z_j0_i1_k1_l0_ * z_j0_i1_k1_l0_) + 1.0) * -0.7213475);
    float weight_j0_i1_k1_l1_ = metal::exp2(((z_j0_i1_k1_l1_ * z_j0_i1_k1_l1_) + 1.0) * -0.7213475);
    float weight_j0_i1_k1_l2_ = metal::exp2(((z_j0_i1_k1_l2_ * z_j0_i1_k1_l2_) + 1.0) * -0.7213475);
    float weight_j0_i1_k1_l3_ = metal::exp2(((z_j0_i1_k1_l3_ * z_j0_i1_k1_l3_) + 1.0) * -0.7213475);
    metal::float3 value_29_ = (value_22_ - value) * weight_j0_i1_k1_l0_;
    metal::float3 value_30_ = (value_21_ - value_2_) * weight_j0_i1_k1_l1_;
    metal::float3 value_31_ = (value_24_ - value_3_) * weight_j0_i1_k1_l2_;
    metal::float3 value_32_ = (value_23_ - value_4_) * weight_j0_i1_k1_l3_;
    metal::float4 sum_j0_i1_k1_l0_ = sum_j0_i1_k0_l0_ + metal::float4(value_29_.x, value_29_.y, value_29_.z, weight_j0_i1_k1_l0_);
    metal::float4 sum_j0_i1_k1_l1_ = sum_j0_i1_k0_l1_ + metal::float4(value_30_.x, value_30_.y, value_30_.z, weight_j0_i1_k1_l1_);
    metal::float4 sum_j0_i1_k1_l2_ = sum_j0_i1_k0_l2_ + metal::float4(value_31_.x, value_31_.y, value_31_.z, weight_j0_i1_k1_l2_);
    metal::float4 sum_j0_i1_k1_l3_ = sum_j0_i1_k0_l3_ + metal::float4(value_32_.x, value_32_.y, value_32_.z, weight_j0_i1_k1_l3_);
    float z_j0_i1_k2_l0_ = (taps_0_j0_i1_l2_.w - centre_l0_.w) / 0.1;
    float z_j0_i1_k2_l1_ = (taps_0_j0_i1_l3_.w - centre_l1_.w) / 0.1;
    float z_j0_i1_k2_l2_ = (taps_0_j0_i1_l0_.w - centre_l2_.w) / 0.1;
    float z_j0_i1_k2_l3_ = (taps_0_j0_i1_l1_.w - centre_l3_.w) / 0.1;
    float weight_j0_i1_k2_l0_ = metal::exp2(((z_j0_i1_k2_l0_ * z_j0_i1_k2_l0_) + 0.5) * -0.7213475);
    float weight_j0_i1_k2_l1_ = metal::exp2(((z_j0_i1_k2_l1_ * z_j0_i1_k2_l1_) + 0.5) * -0.7213475);
    float weight_j0_i1_k2_l2_ = metal::exp2(((z_j0_i1_k2_l2_ * z_j0_i1_k2_l2_) + 0.5) * -0.7213475);
    float weight_j0_i1_k2_l3_ = metal::exp2(((z_j0_i1_k2_l3_ * z_j0_i1_k2_l3_) + 0.5) * -0.7213475);
    metal::float3 value_33_ = (value_23_ - value) * weight_j0_i1_k2_l0_;
    metal::float3 value_34_ = (value_24_ - value_2_) * weight_j0_i1_k2_l1_;
    metal::float3 value_35_ = (value_21_ - value_3_) * weight_j0_i1_k2_l2_;
    metal::float3 value_36_ = (value_22_ - value_4_) * weight_j0_i1_k2_l3_;
    metal::float4 sum_j0_i1_k2_l0_ = sum_j0_i1_k1_l0_ + metal::float4(value_33_.x, value_33_.y, value_33_.z, weight_j0_i1_k2_l0_);
    metal::float4 sum_j0_i1_k2_l1_ = sum_j0_i1_k1_l1_ + metal::float4(value_34_.x, value_34_.y, value_34_.z, weight_j0_i1_k2_l1_);
    metal::float4 sum_j0_i1_k2_l2_ = sum_j0_i1_k1_l2_ + metal::float4(value_35_.x, value_35_.y, value_35_.z, weight_j0_i1_k2_l2_);
    metal::float4 sum_j0_i1_k2_l3_ = sum_j0_i1_k1_l3_ + metal::float4(value_36_.x, value_36_.y, value_36_.z, weight_j0_i1_k2_l3_);
    float z_j0_i1_k3_l0_ = (taps_0_j0_i1_l3_.w - centre_l0_.w) / 0.1;
    float z_j0_i1_k3_l1_ = (taps_0_j0_i1_l2_.w - centre_l1_.w) / 0.1;
    float z_j0_i1_k3_l2_ = (taps_0_j0_i1_l1_.w - centre_l2_.w) / 0.1;
    float z_j0_i1_k3_l3_ = (taps_0_j0_i1_l0_.w - centre_l3_.w) / 0.1;
    float weight_j0_i1_k3_l0_ = metal::exp2(((z_j0_i1_k3_l0_ * z_j0_i1_k3_l0_) + 1.25) * -0.7213475);
    float weight_j0_i1_k3_l1_ = metal::exp2(((z_j0_i1_k3_l1_ * z_j0_i1_k3_l1_) + 1.25) * -0.7213475);
    float weight_j0_i1_k3_l2_ = metal::exp2(((z_j0_i1_k3_l2_ * z_j0_i1_k3_l2_) + 1.25) * -0.7213475);
    float weight_j0_i1_k3_l3_ = metal::exp2(((z_j0_i1_k3_l3_ * z_j0_i1_k3_l3_) + 1.25) * -0.7213475);
    metal::float3 value_37_ = (value_24_ - value) * weight_j0_i1_k3_l0_;
    metal::float3 value_38_ = (value_23_ - value_2_) * weight_j0_i1_k3_l1_;
    metal::float3 value_39_ = (value_22_ - value_3_) * weight_j0_i1_k3_l2_;
    metal::float3 value_40_ = (value_21_ - value_4_) * weight_j0_i1_k3_l3_;
    metal::float4 sum_j0_i1_k3_l0_ = sum_j0_i1_k2_l0_ + metal::float4(value_37_.x, value_37_.y, value_37_.z, weight_j0_i1_k3_l0_);
    metal::float4 sum_j0_i1_k3_l1_ = sum_j0_i1_k2_l1_ + metal::float4(value_38_.x, value_38_.y, value_38_.z, weight_j0_i1_k3_l1_);
    metal::float4 sum_j0_i1_k3_l2_ = sum_j0_i1_k2_l2_ + metal::float4(value_39_.x, value_39_.y, value_39_.z, weight_j0_i1_k3_l2_);
    metal::float4 sum_j0_i1_k3_l3_ = sum_j0_i1_k2_l3_ + metal::float4(value_40_.x, value_40_.y, value_40_.z, weight_j0_i1_k3_l3_);
    metal::int2 texel_j0_i2_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-2, 0))), metal::int2(0));
    metal::int2 texel_j0_i2_l1_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(3, 0))), last);
    metal::int2 texel_j0_i2_l2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-2, 1))), metal::int2(0), last);
    metal::int2 texel_j0_i2_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(3, 1))), last);
    metal::float4 image_texel_5_ = image.read(metal::uint2(texel_j0_i2_l0_), 0);
    metal::float4 image_texel_6_ = image.read(metal::uint2(texel_j0_i2_l1_), 0);
    metal::float4 image_texel_7_ = image.read(metal::uint2(texel_j0_i2_l2_), 0);
    metal::float4 image_texel_8_ = image.read(metal::uint2(texel_j0_i2_l3_), 0);
    if (metal::abs(image_texel_5_.x) < 300000000000000000000000000000000000000.0) {
        local_16 = metal::abs(image_texel_5_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_16 = false;
    }
    bool _e1028 = local_16;
    if (_e1028) {
        local_17 = metal::abs(image_texel_5_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_17 = false;
    }
    bool counts_j0_i2_l0_ = local_17;
    if (metal::abs(image_texel_6_.x) < 300000000000000000000000000000000000000.0) {
        local_18 = metal::abs(image_texel_6_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_18 = false;
    }
    bool _e1048 = local_18;
    if (_e1048) {
        local_19 = metal::abs(image_texel_6_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_19 = false;
    }
    bool counts_j0_i2_l1_ = local_19;
    if (metal::abs(image_texel_7_.x) < 300000000000000000000000000000000000000.0) {
        local_20 = metal::abs(image_texel_7_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_20 = false;
    }
    bool _e1068 = local_20;
    if (_e1068) {
        local_21 = metal::abs(image_texel_7_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_21 = false;
    }
    bool counts_j0_i2_l2_ = local_21;
    if (metal::abs(image_texel_8_.x) < 300000000000000000000000000000000000000.0) {
        local_22 = metal::abs(image_texel_8_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_22 = false;
    }
    bool _e1088 = local_22;
    if (_e1088) {
        local_23 = metal::abs(image_texel_8_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_23 = false;
    }
    bool counts_j0_i2_l3_ = local_23;
    metal::float4 counted_j0_i2_l0_ = metal::float4(image_texel_5_.x, image_texel_5_.y, image_texel_5_.z, (metal::abs(image_texel_5_.w) < 1000000000000000000000000000000.0) ? image_texel_5_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j0_i2_l1_ = metal::float4(image_texel_6_.x, image_texel_6_.y, image_texel_6_.z, (metal::abs(image_texel_6_.w) < 1000000000000000000000000000000.0) ? image_texel_6_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j0_i2_l2_ = metal::float4(image_texel_7_.x, image_texel_7_.y, image_texel_7_.z, (metal::abs(image_texel_7_.w) < 1000000000000000000000000000000.0) ? image_texel_7_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j0_i2_l3_ = metal::float4(image_texel_8_.x, image_texel_8_.y, image_texel_8_.z, (metal::abs(image_texel_8_.w) < 1000000000000000000000000000000.0) ? image_texel_8_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j0_i2_l0_ = counts_j0_i2_l0_ ? counted_j0_i2_l0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j0_i2_l1_ = counts_j0_i2_l1_ ? counted_j0_i2_l1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j0_i2_l2_ = counts_j0_i2_l2_ ? counted_j0_i2_l2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j0_i2_l3_ = counts_j0_i2_l3_ ? counted_j0_i2_l3_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j0_i2_k0_l0_ = (taps_0_j0_i2_l0_.w - centre_l0_.w) / 0.1;
    float z_j0_i2_k0_l1_ = (taps_0_j0_i2_l1_.w - centre_l1_.w) / 0.1;
    float z_j0_i2_k0_l2_ = (taps_0_j0_i2_l2_.w - centre_l2_.w) / 0.1;
    float z_j0_i2_k0_l3_ = (taps_0_j0_i2_l3_.w - centre_l3_.w) / 0.1;
    float weight_j0_i2_k0_l0_ = metal::exp2(((z_j0_i2_k0_l0_ * z_j0_i2_k0_l0_) + 1.0) * -0.7213475);
    float weight_j0_i2_k0_l1_ = metal::exp2(((z_j0_i2_k0_l1_ * z_j0_i2_k0_l1_) + 1.0) * -0.7213475);
    float weight_j0_i2_k0_l2_ = metal::exp2(((z_j0_i2_k0_l2_ * z_j0_i2_k0_l2_) + 1.0) * -0.7213475);
    float weight_j0_i2_k0_l3_ = metal::exp2(((z_j0_i2_k0_l3_ * z_j0_i2_k0_l3_) + 1.0) * -0.7213475);
    metal::float3 value_41_ = metal::float3(taps_0_j0_i2_l0_.x, taps_0_j0_i2_l0_.y, taps_0_j0_i2_l0_.z);
    metal::float3 value_42_ = metal::float3(taps_0_j0_i2_l1_.x, taps_0_j0_i2_l1_.y, taps_0_j0_i2_l1_.z);
    metal::float3 value_43_ = metal::float3(taps_0_j0_i2_l2_.x, taps_0_j0_i2_l2_.y, taps_0_j0_i2_l2_.z);
    metal::float3 value_44_ = metal::float3(taps_0_j0_i2_l3_.x, taps_0_j0_i2_l3_.y, taps_0_j0_i2_l3_.z);
    metal::float3 value_45_ = (value_41_ - value) * weight_j0_i2_k0_l0_;
    metal::float3 value_46_ = (value_42_ - value_2_) * weight_j0_i2_k0_l1_;
    metal::float3 value_47_ = (value_43_ - value_3_) * weight_j0_i2_k0_l2_;
    metal::float3 value_48_ = (value_44_ - value_4_) * weight_j0_i2_k0_l3_;
    metal::float4 sum_j0_i2_k0_l0_ = sum_j0_i1_k3_l0_ + metal::float4(value_45_.x, value_45_.y, value_45_.z, weight_j0_i2_k0_l0_);
    metal::float4 sum_j0_i2_k0_l1_ = sum_j0_i1_k3_l1_ + metal::float4(value_46_.x, value_46_.y, value_46_.z, weight_j0_i2_k0_l1_);
    metal::float4 sum_j0_i2_k0_l2_ = sum_j0_i1_k3_l2_ + metal::float4(value_47_.x, value_47_.y, value_47_.z, weight_j0_i2_k0_l2_);
    metal::float4 sum_j0_i2_k0_l3_ = sum_j0_i1_k3_l3_ + metal::float4(value_48_.x, value_48_.y, value_48_.z, weight_j0_i2_k0_l3_);
    float z_j0_i2_k2_l0_ = (taps_0_j0_i2_l2_.w - centre_l0_.w) / 0.1;
    float z_j0_i2_k2_l1_ = (taps_0_j0_i2_l3_.w - centre_l1_.w) / 0.1;
    float z_j0_i2_k2_l2_ = (taps_0_j0_i2_l0_.w - centre_l2_.w) / 0.1;
    float z_j0_i2_k2_l3_ = (taps_0_j0_i2_l1_.w - centre_l3_.w) / 0.1;
    float weight_j0_i2_k2_l0_ = metal::exp2(((z_j0_i2_k2_l0_ * z_j0_i2_k2_l0_) + 1.25) * -0.7213475);
    float weight_j0_i2_k2_l1_ = metal::exp2(((z_j0_i2_k2_l1_ * z_j0_i2_k2_l1_) + 1.25) * -0.7213475);
    float weight_j0_i2_k2_l2_ = metal::exp2(((z_j0_i2_k2_l2_ * z_j0_i2_k2_l2_) + 1.25) * -0.7213475);
    float weight_j0_i2_k2_l3_ = metal::exp2(((z_j0_i2_k2_l3_ * z_j0_i2_k2_l3_) + 1.25) * -0.7213475);
    metal::float3 value_49_ = (value_43_ - value) * weight_j0_i2_k2_l0_;
    metal::float3 value_50_ = (value_44_ - value_2_) * weight_j0_i2_k2_l1_;
    metal::float3 value_51_ = (value_41_ - value_3_) * weight_j0_i2_k2_l2_;
    metal::float3 value_52_ = (value_42_ - value_4_) * weight_j0_i2_k2_l3_;
    metal::float4 sum_j0_i2_k2_l0_ = sum_j0_i2_k0_l0_ + metal::float4(value_49_.x, value_49_.y, value_49_.z, weight_j0_i2_k2_l0_);
    metal::float4 sum_j0_i2_k2_l1_ = sum_j0_i2_k0_l1_ + metal::float4(value_50_.x, value_50_.y, value_50_.z, weight_j0_i2_k2_l1_);
    metal::float4 sum_j0_i2_k2_l2_ = sum_j0_i2_k0_l2_ + metal::float4(value_51_.x, value_51_.y, value_51_.z, weight_j0_i2_k2_l2_);
    metal::float4 sum_j0_i2_k2_l3_ = sum_j0_i2_k0_l3_ + metal::float4(value_52_.x, value_52_.y, value_52_.z, weight_j0_i2_k2_l3_);
    metal::int2 texel_j1_i0_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, -1))), metal::int2(0));
    metal::int2 texel_j1_i0_l1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, -1))), metal::int2(0), last);
    metal::int2 texel_j1_i0_l2_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 2))), last);
    metal::int2 texel_j1_i0_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 2))), last);
    metal::float4 image_texel_9_ = image.read(metal::uint2(texel_j1_i0_l0_), 0);
    metal::float4 image_texel_10_ = image.read(metal::uint2(texel_j1_i0_l1_), 0);
    metal::float4 image_texel_11_ = image.read(metal::uint2(texel_j1_i0_l2_), 0);
    metal::float4 image_texel_12_ = image.read(metal::uint2(texel_j1_i0_l3_), 0);
    if (metal::abs(image_texel_9_.x) < 300000000000000000000000000000000000000.0) {
        local_24 = metal::abs(image_texel_9_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_24 = false;
    }
    bool _e1372 = local_24;
    if (_e1372) {
        local_25 = metal::abs(image_texel_9_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_25 = false;
    }
    bool counts_j1_i0_l0_ = local_25;
    if (metal::abs(image_texel_10_.x) < 300000000000000000000000000000000000000.0) {
        local_26 = metal::abs(image_texel_10_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_26 = false;
    }
    bool _e1392 = local_26;
    if (_e1392) {
        local_27 = metal::abs(image_texel_10_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_27 = false;
    }
    bool counts_j1_i0_l1_ = local_27;
    if (metal::abs(image_texel_11_.x) < 300000000000000000000000000000000000000.0) {
        local_28 = metal::abs(image_texel_11_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_28 = false;
    }
    bool _e1412 = local_28;
    if (_e1412) {
        local_29 = metal::abs(image_texel_11_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_29 = false;
    }
    bool counts_j1_i0_l2_ = local_29;
    if (metal::abs(image_texel_12_.x) < 300000000000000000000000000000000000000.0) {
        local_30 = metal::abs(image_texel_12_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_30 = false;
    }
    bool _e1432 = local_30;
    if (_e1432) {
        local_31 = metal::abs(image_texel_12_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_31 = false;
    }
    bool counts_j1_i0_l3_ = local_31;
    metal::float4 counted_j1_i0_l0_ = metal::float4(image_texel_9_.x, image_texel_9_.y, image_texel_9_.z, (metal::abs(image_texel_9_.w) < 1000000000000000000000000000000.0) ? image_texel_9_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j1_i0_l1_ = metal::float4(image_texel_10_.x, image_texel_10_.y, image_texel_10_.z, (metal::abs(image_texel_10_.w) < 1000000000000000000000000000000.0) ? image_texel_10_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j1_i0_l2_ = metal::float4(image_texel_11_.x, image_texel_11_.y, image_texel_11_.z, (metal::abs(image_texel_11_.w) < 1000000000000000000000000000000.0) ? image_texel_11_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j1_i0_l3_ = metal::float4(image_texel_12_.x, image_texel_12_.y, image_texel_12_.z, (metal::abs(image_texel_12_.w) < 1000000000000000000000000000000.0) ? image_texel_12_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i0_l0_ = counts_j1_i0_l0_ ? counted_j1_i0_l0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i0_l1_ = counts_j1_i0_l1_ ? counted_j1_i0_l1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i0_l2_ = counts_j1_i0_l2_ ? counted_j1_i0_l2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i0_l3_ = counts_j1_i0_l3_ ? counted_j1_i0_l3_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j1_i0_k0_l0_ = (taps_0_j1_i0_l0_.w - centre_l0_.w) / 0.1;
    float z_j1_i0_k0_l1_ = (taps_0_j1_i0_l1_.w - centre_l1_.w) / 0.1;
    float z_j1_i0_k0_l2_ = (taps_0_j1_i0_l2_.w - centre_l2_.w) / 0.1;
    float z_j1_i0_k0_l3_ = (taps_0_j1_i0_l3_.w - centre_l3_.w) / 0.1;
    float weight_j1_i0_k0_l0_ = metal::exp2(((z_j1_i0_k0_l0_ * z_j1_i0_k0_l0_) + 0.25) * -0.7213475);
    float weight_j1_i0_k0_l1_ = metal::exp2(((z_j1_i0_k0_l1_ * z_j1_i0_k0_l1_) + 0.25) * -0.7213475);
    float weight_j1_i0_k0_l2_ = metal::exp2(((z_j1_i0_k0_l2_ * z_j1_i0_k0_l2_) + 0.25) * -0.7213475);
    float weight_j1_i0_k0_l3_ = metal::exp2(((z_j1_i0_k0_l3_ * z_j1_i0_k0_l3_) + 0.25) * -0.7213475);
    metal::float3 value_53_ = metal::float3(taps_0_j1_i0_l0_.x, taps_0_j1_i0_l0_.y, taps_0_j1_i0_l0_.z);
    metal::float3 value_54_ = metal::float3(taps_0_j1_i0_l1_.x, taps_0_j1_i0_l1_.y, taps_0_j1_i0_l1_.z);
    metal::float3 value_55_ = metal::float3(taps_0_j1_i0_l2_.x, taps_0_j1_i0_l2_.y, taps_0_j1_i0_l2_.z);
    metal::float3 value_56_ = metal::float3(taps_0_j1_i0_l3_.x, taps_0_j1_i0_l3_.y, taps_0_j1_i0_l3_.z);
    metal::float3 value_57_ = (value_53_ - value) * weight_j1_i0_k0_l0_;
    metal::float3 value_58_ = (value_54_ - value_2_) * weight_j1_i0_k0_l1_;
    metal::float3 value_59_ = (value_55_ - value_3_) * weight_j1_i0_k0_l2_;
    metal::float3 value_60_ = (value_56_ - value_4_) * weight_j1_i0_k0_l3_;
    metal::float4 sum_j1_i0_k0_l0_ = sum_j0_i2_k2_l0_ + metal::float4(value_57_.x, value_57_.y, value_57_.z, weight_j1_i0_k0_l0_);
    metal::float4 sum_j1_i0_k0_l1_ = sum_j0_i2_k2_l1_ + metal::float4(value_58_.x, value_58_.y, value_58_.z, weight_j1_i0_k0_l1_);
    metal::float4 sum_j1_i0_k0_l2_ = sum_j0_i2_k2_l2_ + metal::float4(value_59_.x, value_59_.y, value_59_.z, weight_j1_i0_k0_l2_);
    metal::float4 sum_j1_i0_k0_l3_ = sum_j0_i2_k2_l3_ + metal::float4(value_60_.x, value_60_.y, value_60_.z, weight_j1_i0_k0_l3_);
    float z_j1_i0_k1_l0_ = (taps_0_j1_i0_l1_.w - centre_l0_.w) / 0.1;
    float z_j1_i0_k1_l1_ = (taps_0_j1_i0_l0_.w - centre_l1_.w) / 0.1;
    float z_j1_i0_k1_l2_ = (taps_0_j1_i0_l3_.w - centre_l2_.w) / 0.1;
    float z_j1_i0_k1_l3_ = (taps_0_j1_i0_l2_.w - centre_l3_.w) / 0.1;
    float weight_j1_i0_k1_l0_ = metal::exp2(((z_j1_i0_k1_l0_ * z_j1_i0_k1_l0_) + 0.5) * -0.7213475);
    float weight_j1_i0_k1_l1_ = metal::exp2(((z_j1_i0_k1_l1_ * z_j1_i0_k1_l1_) + 0.5) * -0.7213475);
    float weight_j1_i0_k1_l2_ = metal::exp2(((z_j1_i0_k1_l2_ * z_j1_i0_k1_l2_) + 0.5) * -0.7213475);
    float weight_j1_i0_k1_l3_ = metal::exp2(((z_j1_i0_k1_l3_ * z_j1_i0_k1_l3_) + 0.5) * -0.7213475);
    metal::float3 value_61_ = (value_54_ - value) * weight_j1_i0_k1_l0_;
    metal::float3 value_62_ = (value_53_ - value_2_) * weight_j1_i0_k1_l1_;
    metal::float3 value_63_ = (value_56_ - value_3_) * weight_j1_i0_k1_l2_;
    metal::float3 value_64_ = (value_55_ - value_4_) * weight_j1_i0_k1_l3_;
    metal::float4 sum_j1_i0_k1_l0_ = sum_j1_i0_k0_l0_ + metal::float4(value_61_.x, value_61_.y, value_61_.z, weight_j1_i0_k1_l0_);
    metal::float4 sum_j1_i0_k1_l1_ = sum_j1_i0_k0_l1_ + metal::float4(value_62_.x, value_62_.y, value_62_.z, weight_j1_i0_k1_l1_);
    metal::float4 sum_j1_i0_k1_l2_ = sum_j1_i0_k0_l2_ + metal::float4(value_63_.x, value_63_.y, value_63_.z, weight_j1_i0_k1_l2_);
    metal::float4 sum_j1_i0_k1_l3_ = sum_j1_i0_k0_l3_ + metal::float4(value_64_.x, value_64_.y, value_64_.z, weight_j1_i0_k1_l3_);
    float z_j1_i0_k2_l0_ = (taps_0_j1_i0_l2_.w - centre_l0_.w) / 0.1;
    float z_j1_i0_k2_l1_ = (taps_0_j1_i0_l3_.w - centre_l1_.w) / 0.1;
    float z_j1_i0_k2_l2_ = (taps_0_j1_i0_l0_.w - centre_l2_.w) / 0.1;
    float z_j1_i0_k2_l3_ = (taps_0_j1_i0_l1_.w - centre_l3_.w) / 0.1;
    float weight_j1_i0_k2_l0_ = metal::exp2(((z_j1_i0_k2_l0_ * z_j1_i0_k2_l0_) + 1.0) * -0.7213475);
    float weight_j1_i0_k2_l1_ = metal::exp2(((z_j1_i0_k2_l1_ * z_j1_i0_k2_l1_) + 1.0) * -0.7213475);
    float weight_j1_i0_k2_l2_ = metal::exp2(((z_j1_i0_k2_l2_ * z_j1_i0_k2_l2_) + 1.0) * -0.7213475);
    float weight_j1_i0_k2_l3_ = metal::exp2(((z_j1_i0_k2_l3_ * z_j1_i0_k2_l3_) + 1.0) * -0.7213475);
    metal::float3 value_65_ = (value_55_ - value) * weight_j1_i0_k2_l0_;
    metal::float3 value_66_ = (value_56_ - value_2_) * weight_j1_i0_k2_l1_;
    metal::float3 value_67_ = (value_53_ - value_3_) * weight_j1_i0_k2_l2_;
    metal::float3 value_68_ = (value_54_ - value_4_) * weight_j1_i0_k2_l3_;
    metal::float4 sum_j1_i0_k2_l0_ = sum_j1_i0_k1_l0_ + metal::float4(value_65_.x, value_65_.y, value_65_.z, weight_j1_i0_k2_l0_);
    metal::float4 sum_j1_i0_k2_l1_ = sum_j1_i0_k1_l1_ + metal::float4(value_66_.x, value_66_.y, value_66_.z, weight_j1_i0_k2_l1_);
    metal::float4 sum_j1_i0_k2_l2_ = sum_j1_i0_k1_l2_ + metal::float4(value_67_.x, value_67_.y, value_67_.z, weight_j1_i0_k2_l2_);
    metal::float4 sum_j1_i0_k2_l3_ = sum_j1_i0_k1_l3_ + metal::float4(value_68_.x, value_68_.y, value_68_.z, weight_j1_i0_k2_l3_);
    float z_j1_i0_k3_l0_ = (taps_0_j1_i0_l3_.w - centre_l0_.w) / 0.1;
    float z_j1_i0_k3_l1_ = (taps_0_j1_i0_l2_.w - centre_l1_.w) / 0.1;
    float z_j1_i0_k3_l2_ = (taps_0_j1_i0_l1_.w - centre_l2_.w) / 0.1;
    float z_j1_i0_k3_l3_ = (taps_0_j1_i0_l0_.w - centre_l3_.w) / 0.1;
    float weight_j1_i0_k3_l0_ = metal::exp2(((z_j1_i0_k3_l0_ * z_j1_i0_k3_l0_) + 1.25) * -0.7213475);
    float weight_j1_i0_k3_l1_ = metal::exp2(((z_j1_i0_k3_l1_ * z_j1_i0_k3_l1_) + 1.25) * -0.7213475);
    float weight_j1_i0_k3_l2_ = metal::exp2(((z_j1_i0_k3_l2_ * z_j1_i0_k3_l2_) + 1.25) * -0.7213475);
    float weight_j1_i0_k3_l3_ = metal::exp2(((z_j1_i0_k3_l3_ * z_j1_i0_k3_l3_) + 1.25) * -0.7213475);
    metal::float3 value_69_ = (value_56_ - value) * weight_j1_i0_k3_l0_;
    metal::float3 value_70_ = (value_55_ - value_2_) * weight_j1_i0_k3_l1_;
    metal::float3 value_71_ = (value_54_ - value_3_) * weight_j1_i0_k3_l2_;
    metal::float3 value_72_ = (value_53_ - value_4_) * weight_j1_i0_k3_l3_;
    metal::float4 sum_j1_i0_k3_l0_ = sum_j1_i0_k2_l0_ + metal::float4(value_69_.x, value_69_.y, value_69_.z, weight_j1_i0_k3_l0_);
    metal::float4 sum_j1_i0_k3_l1_ = sum_j1_i0_k2_l1_ + metal::float4(value_70_.x, value_70_.y, value_70_.z, weight_j1_i0_k3_l1_);
    metal::float4 sum_j1_i0_k3_l2_ = sum_j1_i0_k2_l2_ + metal::float4(value_71_.x, value_71_.y, value_71_.z, weight_j1_i0_k3_l2_);
    metal::float4 sum_j1_i0_k3_l3_ = sum_j1_i0_k2_l3_ + metal::float4(value_72_.x, value_72_.y, value_72_.z, weight_j1_i0_k3_l3_);
    metal::int2 texel_j1_i1_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1))), metal::int2(0));
    metal::int2 texel_j1_i1_l1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, -1))), metal::int2(0), last);
    metal::int2 texel_j1_i1_l2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, 2))), metal::int2(0), last);
    metal::int2 texel_j1_i1_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2))), last);
    metal::float4 image_texel_13_ = image.read(metal::uint2(texel_j1_i1_l0_), 0);
    metal::float4 image_texel_14_ = image.read(metal::uint2(texel_j1_i1_l1_), 0);
    metal::float4 image_texel_15_ = image.read(metal::uint2(texel_j1_i1_l2_), 0);
    metal::float4 image_texel_16_ = image.read(metal::uint2(texel_j1_i1_l3_), 0);
    if (metal::abs(image_texel_13_.x) < 300000000000000000000000000000000000000.0) {
        local_32 = metal::abs(image_texel_13_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_32 = false;
    }
    bool _e1860 = local_32;
    if (_e1860) {
        local_33 = metal::abs(image_texel_13_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_33 = false;
    }
    bool counts_j1_i1_l0_ = local_33;
    if (metal::abs(image_texel_14_.x) < 300000000000000000000000000000000000000.0) {
        local_34 = metal::abs(image_texel_14_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_34 = false;
    }
    bool _e1880 = local_34;
    if (_e1880) {
        local_35 = metal::abs(image_texel_14_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_35 = false;
    }
    bool counts_j1_i1_l1_ = local_35;
    if (metal::abs(image_texel_15_.x) < 300000000000000000000000000000000000000.0) {
        local_36 = metal::abs(image_texel_15_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_36 = false;
    }
    bool _e1900 = local_36;
    if (_e1900) {
        local_37 = metal::abs(image_texel_15_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_37 = false;
    }
    bool counts_j1_i1_l2_ = local_37;
    if (metal::abs(image_texel_16_.x) < 300000000000000000000000000000000000000.0) {
        local_38 = metal::abs(image_texel_16_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_38 = false;
    }
    bool _e1920 = local_38;
    if (_e1920) {
        local_39 = metal::abs(image_texel_16_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_39 = false;
    }
    bool counts_j1_i1_l3_ = local_39;
    metal::float4 counted_j1_i1_l0_ = metal::float4(image_texel_13_.x, image_texel_13_.y, image_texel_13_.z, (metal::abs(image_texel_13_.w) < 1000000000000000000000000000000.0) ? image_texel_13_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j1_i1_l1_ = metal::float4(image_texel_14_.x, image_texel_14_.y, image_texel_14_.z, (metal::abs(image_texel_14_.w) < 1000000000000000000000000000000.0) ? image_texel_14_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j1_i1_l2_ = metal::float4(image_texel_15_.x, image_texel_15_.y, image_texel_15_.z, (metal::abs(image_texel_15_.w) < 1000000000000000000000000000000.0) ? image_texel_15_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j1_i1_l3_ = metal::float4(image_texel_16_.x, image_texel_16_.y, image_texel_16_.z, (metal::abs(image_texel_16_.w) < 1000000000000000000000000000000.0) ? image_texel_16_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i1_l0_ = counts_j1_i1_l0_ ? counted_j1_i1_l0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i1_l1_ = counts_j1_i1_l1_ ? counted_j1_i1_l1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i1_l2_ = counts_j1_i1_l2_ ? counted_j1_i1_l2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i1_l3_ = counts_j1_i1_l3_ ? counted_j1_i1_l3_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j1_i1_k0_l0_ = (taps_0_j1_i1_l0_.w - centre_l0_.w) / 0.1;
    float z_j1_i1_k0_l1_ = (taps_0_j1_i1_l1_.w - centre_l1_.w) / 0.1;
    float z_j1_i1_k0_l2_ = (taps_0_j1_i1_l2_.w - centre_l2_.w) / 0.1;
    float z_j1_i1_k0_l3_ = (taps_0_j1_i1_l3_.w - centre_l3_.w) / 0.1;
    float weight_j1_i1_k0_l0_ = metal::exp2(((z_j1_i1_k0_l0_ * z_j1_i1_k0_l0_) + 0.5) * -0.7213475);
    float weight_j1_i1_k0_l1_ = metal::exp2(((z_j1_i1_k0_l1_ * z_j1_i1_k0_l1_) + 0.5) * -0.7213475);
    float weight_j1_i1_k0_l2_ = metal::exp2(((z_j1_i1_k0_l2_ * z_j1_i1_k0_l2_) + 0.5) * -0.7213475);
    float weight_j1_i1_k0_l3_ = metal::exp2(((z_j1_i1_k0_l3_ * z_j1_i1_k0_l3_) + 0.5) * -0.7213475);
    metal::float3 value_73_ = metal::float3(taps_0_j1_i1_l0_.x, taps_0_j1_i1_l0_.y, taps_0_j1_i1_l0_.z);
    metal::float3 value_74_ = metal::float3(taps_0_j1_i1_l1_.x, taps_0_j1_i1_l1_.y, taps_0_j1_i1_l1_.z);
    metal::float3 value_75_ = metal::float3(taps_0_j1_i1_l2_.x, taps_0_j1_i1_l2_.y, taps_0_j1_i1_l2_.z);
    metal::float3 value_76_ = metal::float3(taps_0_j1_i1_l3_.x, taps_0_j1_i1_l3_.y, taps_0_j1_i1_l3_.z);
    metal::float3 value_77_ = (value_73_ - value) * weight_j1_i1_k0_l0_;
    metal::float3 value_78_ = (value_74_ - value_2_) * weight_j1_i1_k0_l1_;
    metal::float3 value_79_ = (value_75_ - value_3_) * weight_j1_i1_k0_l2_;
    metal::float3 value_80_ = (value_76_ - value_4_) * weight_j1_i1_k0_l3_;
    metal::float4 sum_j1_i1_k0_l0_ = sum_j1_i0_k3_l0_ + metal::float4(value_77_.x, value_77_.y, value_77_.z, weight_j1_i1_k0_l0_);
    metal::float4 sum_j1_i1_k0_l1_ = sum_j1_i0_k3_l1_ + metal::float4(value_78_.x, value_78_.y, value_78_.z, weight_j1_i1_k0_l1_);
    metal::float4 sum_j1_i1_k0_l2_ = sum_j1_i0_k3_l2_ + metal::float4(value_79_.x, value_79_.y, value_79_.z, weight_j1_i1_k0_l2_);
    metal::float4 sum_j1_i1_k0_l3_ = sum_j1_i0_k3_l3_ + metal::float4(value_80_.x, value_80_.y, value_80_.z, weight_j1_i1_k0_l3_);
    float z_j1_i1_k1_l0_ = (taps_0_j1_i1_l1_.w - centre_l0_.w) / 0.1;
    float z_j1_i1_k1_l1_ = (taps_0_j1_i1_l0_.w - centre_l1_.w) / 0.1;
    float z_j1_i1_k1_l2_ = (taps_0_j1_i1_l3_.w - centre_l2_.w) / 0.1;
    float z_j1_i1_k1_l3_ = (taps_0_j1_i1_l2_.w - centre_l3_.w) / 0.1;
    float weight_j1_i1_k1_l0_ = metal::exp2(((z_j1_i1_k1_l0_ * z_j1_i1_k1_l0_) + 1.25) * -0.7213475);
    float weight_j1_i1_k1_l1_ = metal::exp2(((z_j1_i1_k1_l1_ * z_j1_i1_k1_l1_) + 1.25) * -0.7213475);
    float weight_j1_i1_k1_l2_ = metal::exp2(((z_j1_i1_k1_l2_ * z_j1_i1_k1_l2_) + 1.25) * -0.7213475);
    float weight_j1_i1_k1_l3_ = metal::exp2(((z_j1_i1_k1_l3_ * z_j1_i1_k1_l3_) + 1.25) * -0.7213475);
    metal::float3 value_81_ = (value_74_ - value) * weight_j1_i1_k1_l0_;
    metal::float3 value_82_ = (value_73_ - value_2_) * weight_j1_i1_k1_l1_;
    metal::float3 value_83_ = (value_76_ - value_3_) * weight_j1_i1_k1_l2_;
    metal::float3 value_84_ = (value_75_ - value_4_) * weight_j1_i1_k1_l3_;
    metal::float4 sum_j1_i1_k1_l0_ = sum_j1_i1_k0_l0_ + metal::float4(value_81_.x, value_81_.y, value_81_.z, weight_j1_i1_k1_l0_);
    metal::float4 sum_j1_i1_k1_l1_ = sum_j1_i1_k0_l1_ + metal::float4(value_82_.x, value_82_.y, value_82_.z, weight_j1_i1_k1_l1_);
    metal::float4 sum_j1_i1_k1_l2_ = sum_j1_i1_k0_l2_ + metal::float4(value_83_.x, value_83_.y, value_83_.z, weight_j1_i1_k1_l2_);
    metal::float4 sum_j1_i1_k1_l3_ = sum_j1_i1_k0_l3_ + metal::float4(value_84_.x, value_84_.y, value_84_.z, weight_j1_i1_k1_l3_);
    float z_j1_i1_k2_l0_ = (taps_0_j1_i1_l2_.w - centre_l0_.w) / 0.1;
    float z_j1_i1_k2_l1_ = (taps_0_j1_i1_l3_.w - centre_l1_.w) / 0.1;
    float z_j1_i1_k2_l2_ = (taps_0_j1_i1_l0_.w - centre_l2_.w) / 0.1;
    float z_j1_i1_k2_l3_ = (taps_0_j1_i1_l1_.w - centre_l3_.w) / 0.1;
    float weight_j1_i1_k2_l0_ = metal::exp2(((z_j1_i1_k2_l0_ * z_j1_i1_k2_l0_) + 1.25) * -0.7213475);
    float weight_j1_i1_k2_l1_ = metal::exp2(((z_j1_i1_k2_l1_ * z_j1_i1_k2_l1_) + 1.25) * -0.7213475);
    float weight_j1_i1_k2_l2_ = metal::exp2(((z_j1_i1_k2_l2_ * z_j1_i1_k2_l2_) + 1.25) * -0.7213475);
    float weight_j1_i1_k2_l3_ = metal::exp2(((z_j1_i1_k2_l3_ * z_j1_i1_k2_l3_) + 1.25) * -0.7213475);
    metal::float3 value_85_ = (value_75_ - value) * weight_j1_i1_k2_l0_;
    metal::float3 value_86_ = (value_76_ - value_2_) * weight_j1_i1_k2_l1_;
    metal::float3 value_87_ = (value_73_ - value_3_) * weight_j1_i1_k2_l2_;
    metal::float3 value_88_ = (value_74_ - value_4_) * weight_j1_i1_k2_l3_;
    metal::float4 sum_j1_i1_k2_l0_ = sum_j1_i1_k1_l0_ + metal::float4(value_85_.x, value_85_.y, value_85_.z, weight_j1_i1_k2_l0_);
    metal::float4 sum_j1_i1_k2_l1_ = sum_j1_i1_k1_l1_ + metal::float4(value_86_.x, value_86_.y, value_86_.z, weight_j1_i1_k2_l1_);
    metal::float4 sum_j1_i1_k2_l2_ = sum_j1_i1_k1_l2_ + metal::float4(value_87_.x, value_87_.y, value_87_.z, weight_j1_i1_k2_l2_);
    metal::float4 sum_j1_i1_k2_l3_ = sum_j1_i1_k1_l3_ + metal::float4(value_88_.x, value_88_.y, value_88_.z, weight_j1_i1_k2_l3_);
    float z_j1_i1_k3_l0_ = (taps_0_j1_i1_l3_.w - centre_l0_.w) / 0.1;
    float z_j1_i1_k3_l1_ = (taps_0_j1_i1_l2_.w - centre_l1_.w) / 0.1;
    float z_j1_i1_k3_l2_ = (taps_0_j1_i1_l1_.w - centre_l2_.w) / 0.1;
    float z_j1_i1_k3_l3_ = (taps_0_j1_i1_l0_.w - centre_l3_.w) / 0.1;
    float weight_j1_i1_k3_l0_ = metal::exp2(((z_j1_i1_k3_l0_ * z_j1_i1_k3_l0_) + 2.0) * -0.7213475);
    float weight_j1_i1_k3_l1_ = metal::exp2(((z_j1_i1_k3_l1_ * z_j1_i1_k3_l1_) + 2.0) * -0.7213475);
    float weight_j1_i1_k3_l2_ = metal::exp2(((z_j1_i1_k3_l2_ * z_j1_i1_k3_l2_) + 2.0) * -0.7213475);
    float weight_j1_i1_k3_l3_ = metal::exp2(((z_j1_i1_k3_l3_ * z_j1_i1_k3_l3_) + 2.0) * -0.7213475);
    metal::float3 value_89_ = (value_76_ - value) * weight_j1_i1_k3_l0_;
    metal::float3 value_90_ = (value_75_ - value_2_) * weight_j1_i1_k3_l1_;
    metal::float3 value_91_ = (value_74_ - value_3_) * weight_j1_i1_k3_l2_;
    metal::float3 value_92_ = (value_73_ - value_4_) * weight_j1_i1_k3_l3_;
    metal::float4 sum_j1_i1_k3_l0_ = sum_j1_i1_k2_l0_ + metal::float4(value_89_.x, value_89_.y, value_89_.z, weight_j1_i1_k3_l0_);
    metal::float4 sum_j1_i1_k3_l1_ = sum_j1_i1_k2_l1_ + metal::float4(value_90_.x, value_90_.y, value_90_.z, weight_j1_i1_k3_l1_);
    metal::float4 sum_j1_i1_k3_l2_ = sum_j1_i1_k2_l2_ + metal::float4(value_91_.x, value_91_.y, value_91_.z, weight_j1_i1_k3_l2_);
    metal::float4 sum_j1_i1_k3_l3_ = sum_j1_i1_k2_l3_ + metal::float4(value_92_.x, value_92_.y, value_92_.z, weight_j1_i1_k3_l3_);
    metal::int2 texel_j1_i2_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-2, -1))), metal::int2(0));
    metal::int2 texel_j1_i2_l1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(3, -1))), metal::int2(0), last);
    metal::int2 texel_j1_i2_l2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-2, 2))), metal::int2(0), last);
    metal::int2 texel_j1_i2_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(3, 2))), last);
    metal::float4 image_texel_17_ = image.read(metal::uint2(texel_j1_i2_l0_), 0);
    metal::float4 image_texel_18_ = image.read(metal::uint2(texel_j1_i2_l1_), 0);
    metal::float4 image_texel_19_ = image.read(metal::uint2(texel_j1_i2_l2_), 0);
    metal::float4 image_texel_20_ = image.read(metal::uint2(texel_j1_i2_l3_), 0);
    if (metal::abs(image_texel_17_.x) < 300000000000000000000000000000000000000.0) {
        local_40 = metal::abs(image_texel_17_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_40 = false;
    }
    bool _e2350 = local_40;
    if (_e2350) {
        local_41 = metal::abs(image_texel_17_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_41 = false;
    }
    bool counts_j1_i2_l0_ = local_41;
    if (metal::abs(image_texel_18_.x) < 300000000000000000000000000000000000000.0) {
        local_42 = metal::abs(image_texel_18_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_42 = false;
    }
    bool _e2370 = local_42;
    if (_e2370) {
        local_43 = metal::abs(image_texel_18_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_43 = false;
    }
    bool counts_j1_i2_l1_ = local_43;
    if (metal::abs(image_texel_19_.x) < 300000000000000000000000000000000000000.0) {
        local_44 = metal::abs(image_texel_19_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_44 = false;
    }
    bool _e2390 = local_44;
    if (_e2390) {
        local_45 = metal::abs(image_texel_19_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_45 = false;
    }
    bool counts_j1_i2_l2_ = local_45;
    if (metal::abs(image_texel_20_.x) < 300000000000000000000000000000000000000.0) {
        local_46 = metal::abs(image_texel_20_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_46 = false;
    }
    bool _e2410 = local_46;
    if (_e2410) {
        local_47 = metal::abs(image_texel_20_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_47 = false;
    }
    bool counts_j1_i2_l3_ = local_47;
    metal::float4 counted_j1_i2_l0_ = metal::float4(image_texel_17_.x, image_texel_17_.y, image_texel_17_.z, (metal::abs(image_texel_17_.w) < 1000000000000000000000000000000.0) ? image_texel_17_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j1_i2_l1_ = metal::float4(image_texel_18_.x, image_texel_18_.y, image_texel_18_.z, (metal::abs(image_texel_18_.w) < 1000000000000000000000000000000.0) ? image_texel_18_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j1_i2_l2_ = metal::float4(image_texel_19_.x, image_texel_19_.y, image_texel_19_.z, (metal::abs(image_texel_19_.w) < 1000000000000000000000000000000.0) ? image_texel_19_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j1_i2_l3_ = metal::float4(image_texel_20_.x, image_texel_20_.y, image_texel_20_.z, (metal::abs(image_texel_20_.w) < 1000000000000000000000000000000.0) ? image_texel_20_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i2_l0_ = counts_j1_i2_l0_ ? counted_j1_i2_l0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i2_l1_ = counts_j1_i2_l1_ ? counted_j1_i2_l1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i2_l2_ = counts_j1_i2_l2_ ? counted_j1_i2_l2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j1_i2_l3_ = counts_j1_i2_l3_ ? counted_j1_i2_l3_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j1_i2_k0_l0_ = (taps_0_j1_i2_l0_.w - centre_l0_.w) / 0.1;
    float z_j1_i2_k0_l1_ = (taps_0_j1_i2_l1_.w - centre_l1_.w) / 0.1;
    float z_j1_i2_k0_l2_ = (taps_0_j1_i2_l2_.w - centre_l2_.w) / 0.1;
    float z_j1_i2_k0_l3_ = (taps_0_j1_i2_l3_.w - centre_l3_.w) / 0.1;
    float weight_j1_i2_k0_l0_ = metal::exp2(((z_j1_i2_k0_l0_ * z_j1_i2_k0_l0_) + 1.25) * -0.7213475);
    float weight_j1_i2_k0_l1_ = metal::exp2(((z_j1_i2_k0_l1_ * z_j1_i2_k0_l1_) + 1.25) * -0.7213475);
    float weight_j1_i2_k0_l2_ = metal::exp2(((z_j1_i2_k0_l2_ * z_j1_i2_k0_l2_) + 1.25) * -0.7213475);
    float weight_j1_i2_k0_l3_ = metal::exp2(((z_j1_i2_k0_l3_ * z_j1_i2_k0_l3_) + 1.25) * -0.7213475);
    metal::float3 value_93_ = metal::float3(taps_0_j1_i2_l0_.x, taps_0_j1_i2_l0_.y, taps_0_j1_i2_l0_.z);
    metal::float3 value_94_ = metal::float3(taps_0_j1_i2_l1_.x, taps_0_j1_i2_l1_.y, taps_0_j1_i2_l1_.z);
    metal::float3 value_95_ = metal::float3(taps_0_j1_i2_l2_.x, taps_0_j1_i2_l2_.y, taps_0_j1_i2_l2_.z);
    metal::float3 value_96_ = metal::float3(taps_0_j1_i2_l3_.x, taps_0_j1_i2_l3_.y, taps_0_j1_i2_l3_.z);
    metal::float3 value_97_ = (value_93_ - value) * weight_j1_i2_k0_l0_;
    metal::float3 value_98_ = (value_94_ - value_2_) * weight_j1_i2_k0_l1_;
    metal::float3 value_99_ = (value_95_ - value_3_) * weight_j1_i2_k0_l2_;
    metal::float3 value_100_ = (value_96_ - value_4_) * weight_j1_i2_k0_l3_;
    metal::float4 sum_j1_i2_k0_l0_ = sum_j1_i1_k3_l0_ + metal::float4(value_97_.x, value_97_.y, value_97_.z, weight_j1_i2_k0_l0_);
    metal::float4 sum_j1_i2_k0_l1_ = sum_j1_i1_k3_l1_ + metal::float4(value_98_.x, value_98_.y, value_98_.z, weight_j1_i2_k0_l1_);
    metal::float4 sum_j1_i2_k0_l2_ = sum_j1_i1_k3_l2_ + metal::float4(value_99_.x, value_99_.y, value_99_.z, weight_j1_i2_k0_l2_);
    metal::float4 sum_j1_i2_k0_l3_ = sum_j1_i1_k3_l3_ + metal::float4(value_100_.x, value_100_.y, value_100_.z, weight_j1_i2_k0_l3_);
    float z_j1_i2_k2_l0_ = (taps_0_j1_i2_l2_.w - centre_l0_.w) / 0.1;
    float z_j1_i2_k2_l1_ = (taps_0_j1_i2_l3_.w - centre_l1_.w) / 0.1;
    float z_j1_i2_k2_l2_ = (taps_0_j1_i2_l0_.w - centre_l2_.w) / 0.1;
    float z_j1_i2_k2_l3_ = (taps_0_j1_i2_l1_.w - centre_l3_.w) / 0.1;
    float weight_j1_i2_k2_l0_ = metal::exp2(((z_j1_i2_k2_l0_ * z_j1_i2_k2_l0_) + 2.0) * -0.7213475);
    float weight_j1_i2_k2_l1_ = metal::exp2(((z_j1_i2_k2_l1_ * z_j1_i2_k2_l1_) + 2.0) * -0.7213475);
    float weight_j1_i2_k2_l2_ = metal::exp2(((z_j1_i2_k2_l2_ * z_j1_i2_k2_l2_) + 2.0) * -0.7213475);
    float weight_j1_i2_k2_l3_ = metal::exp2(((z_j1_i2_k2_l3_ * z_j1_i2_k2_l3_) + 2.0) * -0.7213475);
    metal::float3 value_101_ = (value_95_ - value) * weight_j1_i2_k2_l0_;
    metal::float3 value_102_ = (value_96_ - value_2_) * weight_j1_i2_k2_l1_;
    metal::float3 value_103_ = (value_93_ - value_3_) * weight_j1_i2_k2_l2_;
    metal::float3 value_104_ = (value_94_ - value_4_) * weight_j1_i2_k2_l3_;
    metal::float4 sum_j1_i2_k2_l0_ = sum_j1_i2_k0_l0_ + metal::float4(value_101_.x, value_101_.y, value_101_.z, weight_j1_i2_k2_l0_);
    metal::float4 sum_j1_i2_k2_l1_ = sum_j1_i2_k0_l1_ + metal::float4(value_102_.x, value_102_.y, value_102_.z, weight_j1_i2_k2_l1_);
    metal::float4 sum_j1_i2_k2_l2_ = sum_j1_i2_k0_l2_ + metal::float4(value_103_.x, value_103_.y, value_103_.z, weight_j1_i2_k2_l2_);
    metal::float4 sum_j1_i2_k2_l3_ = sum_j1_i2_k0_l3_ + metal::float4(value_104_.x, value_104_.y, value_104_.z, weight_j1_i2_k2_l3_);
    metal::int2 texel_j2_i0_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, -2))), metal::int2(0));
    metal::int2 texel_j2_i0_l1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, -2))), metal::int2(0), last);
    metal::int2 texel_j2_i0_l2_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 3))), last);
    metal::int2 texel_j2_i0_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 3))), last);
    metal::float4 image_texel_21_ = image.read(metal::uint2(texel_j2_i0_l0_), 0);
    metal::float4 image_texel_22_ = image.read(metal::uint2(texel_j2_i0_l1_), 0);
    metal::float4 image_texel_23_ = image.read(metal::uint2(texel_j2_i0_l2_), 0);
    metal::float4 image_texel_24_ = image.read(metal::uint2(texel_j2_i0_l3_), 0);
    if (metal::abs(image_texel_21_.x) < 300000000000000000000000000000000000000.0) {
        local_48 = metal::abs(image_texel_21_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_48 = false;
    }
    bool _e2694 = local_48;
    if (_e2694) {
        local_49 = metal::abs(image_texel_21_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_49 = false;
    }
    bool counts_j2_i0_l0_ = local_49;
    if (metal::abs(image_texel_22_.x) < 300000000000000000000000000000000000000.0) {
        local_50 = metal::abs(image_texel_22_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_50 = false;
    }
    bool _e2714 = local_50;
    if (_e2714) {
        local_51 = metal::abs(image_texel_22_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_51 = false;
    }
    bool counts_j2_i0_l1_ = local_51;
    if (metal::abs(image_texel_23_.x) < 300000000000000000000000000000000000000.0) {
        local_52 = metal::abs(image_texel_23_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_52 = false;
    }
    bool _e2734 = local_52;
    if (_e2734) {
        local_53 = metal::abs(image_texel_23_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_53 = false;
    }
    bool counts_j2_i0_l2_ = local_53;
    if (metal::abs(image_texel_24_.x) < 300000000000000000000000000000000000000.0) {
        local_54 = metal::abs(image_texel_24_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_54 = false;
    }
    bool _e2754 = local_54;
    if (_e2754) {
        local_55 = metal::abs(image_texel_24_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_55 = false;
    }
    bool counts_j2_i0_l3_ = local_55;
    metal::float4 counted_j2_i0_l0_ = metal::float4(image_texel_21_.x, image_texel_21_.y, image_texel_21_.z, (metal::abs(image_texel_21_.w) < 1000000000000000000000000000000.0) ? image_texel_21_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j2_i0_l1_ = metal::float4(image_texel_22_.x, image_texel_22_.y, image_texel_22_.z, (metal::abs(image_texel_22_.w) < 1000000000000000000000000000000.0) ? image_texel_22_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j2_i0_l2_ = metal::float4(image_texel_23_.x, image_texel_23_.y, image_texel_23_.z, (metal::abs(image_texel_23_.w) < 1000000000000000000000000000000.0) ? image_texel_23_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j2_i0_l3_ = metal::float4(image_texel_24_.x, image_texel_24_.y, image_texel_24_.z, (metal::abs(image_texel_24_.w) < 1000000000000000000000000000000.0) ? image_texel_24_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i0_l0_ = counts_j2_i0_l0_ ? counted_j2_i0_l0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i0_l1_ = counts_j2_i0_l1_ ? counted_j2_i0_l1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i0_l2_ = counts_j2_i0_l2_ ? counted_j2_i0_l2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i0_l3_ = counts_j2_i0_l3_ ? counted_j2_i0_l3_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j2_i0_k0_l0_ = (taps_0_j2_i0_l0_.w - centre_l0_.w) / 0.1;
    float z_j2_i0_k0_l1_ = (taps_0_j2_i0_l1_.w - centre_l1_.w) / 0.1;
    float z_j2_i0_k0_l2_ = (taps_0_j2_i0_l2_.w - centre_l2_.w) / 0.1;
    float z_j2_i0_k0_l3_ = (taps_0_j2_i0_l3_.w - centre_l3_.w) / 0.1;
    float weight_j2_i0_k0_l0_ = metal::exp2(((z_j2_i0_k0_l0_ * z_j2_i0_k0_l0_) + 1.0) * -0.7213475);
    float weight_j2_i0_k0_l1_ = metal::exp2(((z_j2_i0_k0_l1_ * z_j2_i0_k0_l1_) + 1.0) * -0.7213475);
    float weight_j2_i0_k0_l2_ = metal::exp2(((z_j2_i0_k0_l2_ * z_j2_i0_k0_l2_) + 1.0) * -0.7213475);
    float weight_j2_i0_k0_l3_ = metal::exp2(((z_j2_i0_k0_l3_ * z_j2_i0_k0_l3_) + 1.0) * -0.7213475);
    metal::float3 value_105_ = metal::float3(taps_0_j2_i0_l0_.x, taps_0_j2_i0_l0_.y, taps_0_j2_i0_l0_.z);
    metal::float3 value_106_ = metal::float3(taps_0_j2_i0_l1_.x, taps_0_j2_i0_l1_.y, taps_0_j2_i0_l1_.z);
    metal::float3 value_107_ = metal::float3(taps_0_j2_i0_l2_.x, taps_0_j2_i0_l2_.y, taps_0_j2_i0_l2_.z);
    metal::float3 value_108_ = metal::float3(taps_0_j2_i0_l3_.x, taps_0_j2_i0_l3_.y, taps_0_j2_i0_l3_.z);
    metal::float3 value_109_ = (value_105_ - value) * weight_j2_i0_k0_l0_;
    metal::float3 value_110_ = (value_106_ - value_2_) * weight_j2_i0_k0_l1_;
    metal::float3 value_111_ = (value_107_ - value_3_) * weight_j2_i0_k0_l2_;
    metal::float3 value_112_ = (value_108_ - value_4_) * weight_j2_i0_k0_l3_;
    metal::float4 sum_j2_i0_k0_l0_ = sum_j1_i2_k2_l0_ + metal::float4(value_109_.x, value_109_.y, value_109_.z, weight_j2_i0_k0_l0_);
    metal::float4 sum_j2_i0_k0_l1_ = sum_j1_i2_k2_l1_ + metal::float4(value_110_.x, value_110_.y, value_110_.z, weight_j2_i0_k0_l1_);
    metal::float4 sum_j2_i0_k0_l2_ = sum_j1_i2_k2_l2_ + metal::float4(value_111_.x, value_111_.y, value_111_.z, weight_j2_i0_k0_l2_);
    metal::float4 sum_j2_i0_k0_l3_ = sum_j1_i2_k2_l3_ + metal::float4(value_112_.x, value_112_.y, value_112_.z, weight_j2_i0_k0_l3_);
    float z_j2_i0_k1_l0_ = (taps_0_j2_i0_l1_.w - centre_l0_.w) / 0.1;
    float z_j2_i0_k1_l1_ = (taps_0_j2_i0_l0_.w - centre_l1_.w) / 0.1;
    float z_j2_i0_k1_l2_ = (taps_0_j2_i0_l3_.w - centre_l2_.w) / 0.1;
    float z_j2_i0_k1_l3_ = (taps_0_j2_i0_l2_.w - centre_l3_.w) / 0.1;
    float weight_j2_i0_k1_l0_ = metal::exp2(((z_j2_i0_k1_l0_ * z_j2_i0_k1_l0_) + 1.25) * -0.7213475);
    float weight_j2_i0_k1_l1_ = metal::exp2(((z_j2_i0_k1_l1_ * z_j2_i0_k1_l1_) + 1.25) * -0.7213475);
    float weight_j2_i0_k1_l2_ = metal::exp2(((z_j2_i0_k1_l2_ * z_j2_i0_k1_l2_) + 1.25) * -0.7213475);
    float weight_j2_i0_k1_l3_ = metal::exp2(((z_j2_i0_k1_l3_ * z_j2_i0_k1_l3_) + 1.25) * -0.7213475);
    metal::float3 value_113_ = (value_106_ - value) * weight_j2_i0_k1_l0_;
    metal::float3 value_114_ = (value_105_ - value_2_) * weight_j2_i0_k1_l1_;
    metal::float3 value_115_ = (value_108_ - value_3_) * weight_j2_i0_k1_l2_;
    metal::float3 value_116_ = (value_107_ - value_4_) * weight_j2_i0_k1_l3_;
    metal::float4 sum_j2_i0_k1_l0_ = sum_j2_i0_k0_l0_ + metal::float4(value_113_.x, value_113_.y, value_113_.z, weight_j2_i0_k1_l0_);
    metal::float4 sum_j2_i0_k1_l1_ = sum_j2_i0_k0_l1_ + metal::float4(value_114_.x, value_114_.y, value_114_.z, weight_j2_i0_k1_l1_);
    metal::float4 sum_j2_i0_k1_l2_ = sum_j2_i0_k0_l2_ + metal::float4(value_115_.x, value_115_.y, value_115_.z, weight_j2_i0_k1_l2_);
    metal::float4 sum_j2_i0_k1_l3_ = sum_j2_i0_k0_l3_ + metal::float4(value_116_.x, value_116_.y, value_116_.z, weight_j2_i0_k1_l3_);
    metal::int2 texel_j2_i1_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, -2))), metal::int2(0));
    metal::int2 texel_j2_i1_l1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, -2))), metal::int2(0), last);
    metal::int2 texel_j2_i1_l2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, 3))), metal::int2(0), last);
    metal::int2 texel_j2_i1_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, 3))), last);
    metal::float4 image_texel_25_ = image.read(metal::uint2(texel_j2_i1_l0_), 0);
    metal::float4 image_texel_26_ = image.read(metal::uint2(texel_j2_i1_l1_), 0);
    metal::float4 image_texel_27_ = image.read(metal::uint2(texel_j2_i1_l2_), 0);
    metal::float4 image_texel_28_ = image.read(metal::uint2(texel_j2_i1_l3_), 0);
    if (metal::abs(image_texel_25_.x) < 300000000000000000000000000000000000000.0) {
        local_56 = metal::abs(image_texel_25_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_56 = false;
    }
    bool _e3040 = local_56;
    if (_e3040) {
        local_57 = metal::abs(image_texel_25_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_57 = false;
    }
    bool counts_j2_i1_l0_ = local_57;
    if (metal::abs(image_texel_26_.x) < 300000000000000000000000000000000000000.0) {
        local_58 = metal::abs(image_texel_26_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_58 = false;
    }
    bool _e3060 = local_58;
    if (_e3060) {
        local_59 = metal::abs(image_texel_26_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_59 = false;
    }
    bool counts_j2_i1_l1_ = local_59;
    if (metal::abs(image_texel_27_.x) < 300000000000000000000000000000000000000.0) {
        local_60 = metal::abs(image_texel_27_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_60 = false;
    }
    bool _e3080 = local_60;
    if (_e3080) {
        local_61 = metal::abs(image_texel_27_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_61 = false;
    }
    bool counts_j2_i1_l2_ = local_61;
    if (metal::abs(image_texel_28_.x) < 300000000000000000000000000000000000000.0) {
        local_62 = metal::abs(image_texel_28_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_62 = false;
    }
    bool _e3100 = local_62;
    if (_e3100) {
        local_63 = metal::abs(image_texel_28_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_63 = false;
    }
    bool counts_j2_i1_l3_ = local_63;
    metal::float4 counted_j2_i1_l0_ = metal::float4(image_texel_25_.x, image_texel_25_.y, image_texel_25_.z, (metal::abs(image_texel_25_.w) < 1000000000000000000000000000000.0) ? image_texel_25_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j2_i1_l1_ = metal::float4(image_texel_26_.x, image_texel_26_.y, image_texel_26_.z, (metal::abs(image_texel_26_.w) < 1000000000000000000000000000000.0) ? image_texel_26_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j2_i1_l2_ = metal::float4(image_texel_27_.x, image_texel_27_.y, image_texel_27_.z, (metal::abs(image_texel_27_.w) < 1000000000000000000000000000000.0) ? image_texel_27_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j2_i1_l3_ = metal::float4(image_texel_28_.x, image_texel_28_.y, image_texel_28_.z, (metal::abs(image_texel_28_.w) < 1000000000000000000000000000000.0) ? image_texel_28_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i1_l0_ = counts_j2_i1_l0_ ? counted_j2_i1_l0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i1_l1_ = counts_j2_i1_l1_ ? counted_j2_i1_l1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i1_l2_ = counts_j2_i1_l2_ ? counted_j2_i1_l2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i1_l3_ = counts_j2_i1_l3_ ? counted_j2_i1_l3_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j2_i1_k0_l0_ = (taps_0_j2_i1_l0_.w - centre_l0_.w) / 0.1;
    float z_j2_i1_k0_l1_ = (taps_0_j2_i1_l1_.w - centre_l1_.w) / 0.1;
    float z_j2_i1_k0_l2_ = (taps_0_j2_i1_l2_.w - centre_l2_.w) / 0.1;
    float z_j2_i1_k0_l3_ = (taps_0_j2_i1_l3_.w - centre_l3_.w) / 0.1;
    float weight_j2_i1_k0_l0_ = metal::exp2(((z_j2_i1_k0_l0_ * z_j2_i1_k0_l0_) + 1.25) * -0.7213475);
    float weight_j2_i1_k0_l1_ = metal::exp2(((z_j2_i1_k0_l1_ * z_j2_i1_k0_l1_) + 1.25) * -0.7213475);
    float weight_j2_i1_k0_l2_ = metal::exp2(((z_j2_i1_k0_l2_ * z_j2_i1_k0_l2_) + 1.25) * -0.7213475);
    float weight_j2_i1_k0_l3_ = metal::exp2(((z_j2_i1_k0_l3_ * z_j2_i1_k0_l3_) + 1.25) * -0.7213475);
    metal::float3 value_117_ = metal::float3(taps_0_j2_i1_l0_.x, taps_0_j2_i1_l0_.y, taps_0_j2_i1_l0_.z);
    metal::float3 value_118_ = metal::float3(taps_0_j2_i1_l1_.x, taps_0_j2_i1_l1_.y, taps_0_j2_i1_l1_.z);
    metal::float3 value_119_ = metal::float3(taps_0_j2_i1_l2_.x, taps_0_j2_i1_l2_.y, taps_0_j2_i1_l2_.z);
    metal::float3 value_120_ = metal::float3(taps_0_j2_i1_l3_.x, taps_0_j2_i1_l3_.y, taps_0_j2_i1_l3_.z);
    metal::float3 value_121_ = (value_117_ - value) * weight_j2_i1_k0_l0_;
    metal::float3 value_122_ = (value_118_ - value_2_) * weight_j2_i1_k0_l1_;
    metal::float3 value_123_ = (value_119_ - value_3_) * weight_j2_i1_k0_l2_;
    metal::float3 value_124_ = (value_120_ - value_4_) * weight_j2_i1_k0_l3_;
    metal::float4 sum_j2_i1_k0_l0_ = sum_j2_i0_k1_l0_ + metal::float4(value_121_.x, value_121_.y, value_121_.z, weight_j2_i1_k0_l0_);
    metal::float4 sum_j2_i1_k0_l1_ = sum_j2_i0_k1_l1_ + metal::float4(value_122_.x, value_122_.y, value_122_.z, weight_j2_i1_k0_l1_);
    metal::float4 sum_j2_i1_k0_l2_ = sum_j2_i0_k1_l2_ + metal::float4(value_123_.x, value_123_.y, value_123_.z, weight_j2_i1_k0_l2_);
    metal::float4 sum_j2_i1_k0_l3_ = sum_j2_i0_k1_l3_ + metal::float4(value_124_.x, value_124_.y, value_124_.z, weight_j2_i1_k0_l3_);
    float z_j2_i1_k1_l0_ = (taps_0_j2_i1_l1_.w - centre_l0_.w) / 0.1;
    float z_j2_i1_k1_l1_ = (taps_0_j2_i1_l0_.w - centre_l1_.w) / 0.1;
    float z_j2_i1_k1_l2_ = (taps_0_j2_i1_l3_.w - centre_l2_.w) / 0.1;
    float z_j2_i1_k1_l3_ = (taps_0_j2_i1_l2_.w - centre_l3_.w) / 0.1;
    float weight_j2_i1_k1_l0_ = metal::exp2(((z_j2_i1_k1_l0_ * z_j2_i1_k1_l0_) + 2.0) * -0.7213475);
    float weight_j2_i1_k1_l1_ = metal::exp2(((z_j2_i1_k1_l1_ * z_j2_i1_k1_l1_) + 2.0) * -0.7213475);
    float weight_j2_i1_k1_l2_ = metal::exp2(((z_j2_i1_k1_l2_ * z_j2_i1_k1_l2_) + 2.0) * -0.7213475);
    float weight_j2_i1_k1_l3_ = metal::exp2(((z_j2_i1_k1_l3_ * z_j2_i1_k1_l3_) + 2.0) * -0.7213475);
    metal::float3 value_125_ = (value_118_ - value) * weight_j2_i1_k1_l0_;
    metal::float3 value_126_ = (value_117_ - value_2_) * weight_j2_i1_k1_l1_;
    metal::float3 value_127_ = (value_120_ - value_3_) * weight_j2_i1_k1_l2_;
    metal::float3 value_128_ = (value_119_ - value_4_) * weight_j2_i1_k1_l3_;
    metal::float4 sum_j2_i1_k1_l0_ = sum_j2_i1_k0_l0_ + metal::float4(value_125_.x, value_125_.y, value_125_.z, weight_j2_i1_k1_l0_);
    metal::float4 sum_j2_i1_k1_l1_ = sum_j2_i1_k0_l1_ + metal::float4(value_126_.x, value_126_.y, value_126_.z, weight_j2_i1_k1_l1_);
    metal::float4 sum_j2_i1_k1_l2_ = sum_j2_i1_k0_l2_ + metal::float4(value_127_.x, value_127_.y, value_127_.z, weight_j2_i1_k1_l2_);
    metal::float4 sum_j2_i1_k1_l3_ = sum_j2_i1_k0_l3_ + metal::float4(value_128_.x, value_128_.y, value_128_.z, weight_j2_i1_k1_l3_);
    metal::int2 texel_j2_i2_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-2))), metal::int2(0));
    metal::int2 texel_j2_i2_l1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(3, -2))), metal::int2(0), last);
    metal::int2 texel_j2_i2_l2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-2, 3))), metal::int2(0), last);
    metal::int2 texel_j2_i2_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(3))), last);
    metal::float4 image_texel_29_ = image.read(metal::uint2(texel_j2_i2_l0_), 0);
    metal::float4 image_texel_30_ = image.read(metal::uint2(texel_j2_i2_l1_), 0);
    metal::float4 image_texel_31_ = image.read(metal::uint2(texel_j2_i2_l2_), 0);
    metal::float4 image_texel_32_ = image.read(metal::uint2(texel_j2_i2_l3_), 0);
    if (metal::abs(image_texel_29_.x) < 300000000000000000000000000000000000000.0) {
        local_64 = metal::abs(image_texel_29_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_64 = false;
    }
    bool _e3384 = local_64;
    if (_e3384) {
        local_65 = metal::abs(image_texel_29_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_65 = false;
    }
    bool counts_j2_i2_l0_ = local_65;
    if (metal::abs(image_texel_30_.x) < 300000000000000000000000000000000000000.0) {
        local_66 = metal::abs(image_texel_30_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_66 = false;
    }
    bool _e3404 = local_66;
    if (_e3404) {
        local_67 = metal::abs(image_texel_30_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_67 = false;
    }
    bool counts_j2_i2_l1_ = local_67;
    if (metal::abs(image_texel_31_.x) < 300000000000000000000000000000000000000.0) {
        local_68 = metal::abs(image_texel_31_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_68 = false;
    }
    bool _e3424 = local_68;
    if (_e3424) {
        local_69 = metal::abs(image_texel_31_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_69 = false;
    }
    bool counts_j2_i2_l2_ = local_69;
    if (metal::abs(image_texel_32_.x) < 300000000000000000000000000000000000000.0) {
        local_70 = metal::abs(image_texel_32_.y) < 300000000000000000000000000000000000000.0;
    } else {
        local_70 = false;
    }
    bool _e3444 = local_70;
    if (_e3444) {
        local_71 = metal::abs(image_texel_32_.z) < 300000000000000000000000000000000000000.0;
    } else {
        local_71 = false;
    }
    bool counts_j2_i2_l3_ = local_71;
    metal::float4 counted_j2_i2_l0_ = metal::float4(image_texel_29_.x, image_texel_29_.y, image_texel_29_.z, (metal::abs(image_texel_29_.w) < 1000000000000000000000000000000.0) ? image_texel_29_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j2_i2_l1_ = metal::float4(image_texel_30_.x, image_texel_30_.y, image_texel_30_.z, (metal::abs(image_texel_30_.w) < 1000000000000000000000000000000.0) ? image_texel_30_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j2_i2_l2_ = metal::float4(image_texel_31_.x, image_texel_31_.y, image_texel_31_.z, (metal::abs(image_texel_31_.w) < 1000000000000000000000000000000.0) ? image_texel_31_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_j2_i2_l3_ = metal::float4(image_texel_32_.x, image_texel_32_.y, image_texel_32_.z, (metal::abs(image_texel_32_.w) < 1000000000000000000000000000000.0) ? image_texel_32_.w : 1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i2_l0_ = counts_j2_i2_l0_ ? counted_j2_i2_l0_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i2_l1_ = counts_j2_i2_l1_ ? counted_j2_i2_l1_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i2_l2_ = counts_j2_i2_l2_ ? counted_j2_i2_l2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps_0_j2_i2_l3_ = counts_j2_i2_l3_ ? counted_j2_i2_l3_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    float z_j2_i2_k0_l0_ = (taps_0_j2_i2_l0_.w - centre_l0_.w) / 0.1;
    float z_j2_i2_k0_l1_ = (taps_0_j2_i2_l1_.w - centre_l1_.w) / 0.1;
    float z_j2_i2_k0_l2_ = (taps_0_j2_i2_l2_.w - centre_l2_.w) / 0.1;
    float z_j2_i2_k0_l3_ = (taps_0_j2_i2_l3_.w - centre_l3_.w) / 0.1;
    float weight_j2_i2_k0_l0_ = metal::exp2(((z_j2_i2_k0_l0_ * z_j2_i2_k0_l0_) + 2.0) * -0.7213475);
    float weight_j2_i2_k0_l1_ = metal::exp2(((z_j2_i2_k0_l1_ * z_j2_i2_k0_l1_) + 2.0) * -0.7213475);
    float weight_j2_i2_k0_l2_ = metal::exp2(((z_j2_i2_k0_l2_ * z_j2_i2_k0_l2_) + 2.0) * -0.7213475);
    float weight_j2_i2_k0_l3_ = metal::exp2(((z_j2_i2_k0_l3_ * z_j2_i2_k0_l3_) + 2.0) * -0.7213475);
    metal::float3 value_129_ = (metal::float3(taps_0_j2_i2_l0_.x, taps_0_j2_i2_l0_.y, taps_0_j2_i2_l0_.z) - value) * weight_j2_i2_k0_l0_;
    metal::float3 value_130_ = (metal::float3(taps_0_j2_i2_l1_.x, taps_0_j2_i2_l1_.y, taps_0_j2_i2_l1_.z) - value_2_) * weight_j2_i2_k0_l1_;
    metal::float3 value_131_ = (metal::float3(taps_0_j2_i2_l2_.x, taps_0_j2_i2_l2_.y, taps_0_j2_i2_l2_.z) - value_3_) * weight_j2_i2_k0_l2_;
    metal::float3 value_132_ = (metal::float3(taps_0_j2_i2_l3_.x, taps_0_j2_i2_l3_.y, taps_0_j2_i2_l3_.z) - value_4_) * weight_j2_i2_k0_l3_;
    metal::float4 sum_j2_i2_k0_l0_ = sum_j2_i1_k1_l0_ + metal::float4(value_129_.x, value_129_.y, value_129_.z, weight_j2_i2_k0_l0_);
    metal::float4 sum_j2_i2_k0_l1_ = sum_j2_i1_k1_l1_ + metal::float4(value_130_.x, value_130_.y, value_130_.z, weight_j2_i2_k0_l1_);
    metal::float4 sum_j2_i2_k0_l2_ = sum_j2_i1_k1_l2_ + metal::float4(value_131_.x, value_131_.y, value_131_.z, weight_j2_i2_k0_l2_);
    metal::float4 sum_j2_i2_k0_l3_ = sum_j2_i1_k1_l3_ + metal::float4(value_132_.x, value_132_.y, value_132_.z, weight_j2_i2_k0_l3_);
    metal::float3 value_133_ = value + (metal::float3(sum_j2_i2_k0_l0_.x, sum_j2_i2_k0_l0_.y, sum_j2_i2_k0_l0_.z) / metal::float3(sum_j2_i2_k0_l0_.w));
    metal::float3 value_134_ = value_2_ + (metal::float3(sum_j2_i2_k0_l1_.x, sum_j2_i2_k0_l1_.y, sum_j2_i2_k0_l1_.z) / metal::float3(sum_j2_i2_k0_l1_.w));
    metal::float3 value_135_ = value_3_ + (metal::float3(sum_j2_i2_k0_l2_.x, sum_j2_i2_k0_l2_.y, sum_j2_i2_k0_l2_.z) / metal::float3(sum_j2_i2_k0_l2_.w));
    metal::float3 value_136_ = value_4_ + (metal::float3(sum_j2_i2_k0_l3_.x, sum_j2_i2_k0_l3_.y, sum_j2_i2_k0_l3_.z) / metal::float3(sum_j2_i2_k0_l3_.w));
    destination.write(metal::float4(value_133_.x, value_133_.y, value_133_.z, chosen), metal::uint2(pixel));
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0))) < frame)) {
        destination.write(metal::float4(value_134_.x, value_134_.y, value_134_.z, chosen_2_), metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1))) < frame)) {
        destination.write(metal::float4(value_135_.x, value_135_.y, value_135_.z, chosen_3_), metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 1))) < frame)) {
        destination.write(metal::float4(value_136_.x, value_136_.y, value_136_.z, chosen_4_), metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 1)))));
        return;
    } else {
        return;
    }
}
