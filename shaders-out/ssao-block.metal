// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;


metal::int2 naga_f2i32(metal::float2 value) {
    return static_cast<metal::int2>(metal::clamp(value, -2147483600.0, 2147483500.0));
}

metal::int2 to_vec2i(
    metal::float2 x
) {
    metal::bool2 is_nan = (as_type<metal::uint2>(x) & metal::uint2(2147483647u)) > metal::uint2(2139095040u);
    metal::int2 saturated = metal::select(naga_f2i32(x), metal::int2(2147483647), x >= metal::float2(2147483600.0));
    return metal::select(saturated, metal::int2(0), is_nan);
}

struct quad_ssaoInput {
};
kernel void quad_ssao(
  metal::uint3 id [[thread_position_in_grid]]
, metal::texture2d<float, metal::access::sample> depth [[texture(0)]]
, metal::texture2d<float, metal::access::sample> normal [[texture(1)]]
, metal::texture2d<float, metal::access::write> destination [[texture(2)]]
) {
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(destination.get_width(), destination.get_height()));
    metal::int2 pixel = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(id.xy)) * as_type<metal::uint2>(metal::int2(2)));
    if (metal::any(pixel >= frame)) {
        return;
    }
    metal::int2 sum = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0)));
    metal::int2 sum_2_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1)));
    metal::int2 sum_3_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1)));
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 at_l1_ = metal::min(sum, last);
    metal::int2 at_l2_ = metal::min(sum_2_, last);
    metal::int2 at_l3_ = metal::min(sum_3_, last);
    metal::float4 _e30 = depth.read(metal::uint2(pixel), 0);
    float z_l0_ = _e30.x;
    metal::float4 _e34 = depth.read(metal::uint2(at_l1_), 0);
    float z_l1_ = _e34.x;
    metal::float4 _e38 = depth.read(metal::uint2(at_l2_), 0);
    float z_l2_ = _e38.x;
    metal::float4 _e42 = depth.read(metal::uint2(at_l3_), 0);
    float z_l3_ = _e42.x;
    metal::float2 place_middle = static_cast<metal::float2>(frame) * 0.5;
    float product = z_l0_ * 0.005;
    float product_2_ = z_l1_ * 0.005;
    float product_3_ = z_l2_ * 0.005;
    float product_4_ = z_l3_ * 0.005;
    metal::float3 place_from_l0_ = metal::float3(((static_cast<metal::float2>(pixel) + metal::float2(0.5)) - place_middle) * product, z_l0_);
    metal::float3 place_from_l1_ = metal::float3(((static_cast<metal::float2>(sum) + metal::float2(0.5)) - place_middle) * product_2_, z_l1_);
    metal::float3 place_from_l2_ = metal::float3(((static_cast<metal::float2>(sum_2_) + metal::float2(0.5)) - place_middle) * product_3_, z_l2_);
    metal::float3 place_from_l3_ = metal::float3(((static_cast<metal::float2>(sum_3_) + metal::float2(0.5)) - place_middle) * product_4_, z_l3_);
    metal::float4 _e85 = normal.read(metal::uint2(pixel), 0);
    metal::float3 place_normal_l0_ = _e85.xyz;
    metal::float4 _e89 = normal.read(metal::uint2(at_l1_), 0);
    metal::float3 place_normal_l1_ = _e89.xyz;
    metal::float4 _e93 = normal.read(metal::uint2(at_l2_), 0);
    metal::float3 place_normal_l2_ = _e93.xyz;
    metal::float4 _e97 = normal.read(metal::uint2(at_l3_), 0);
    metal::float3 place_normal_l3_ = _e97.xyz;
    float place_reach_l0_ = metal::min(0.5 / product, 48.0);
    float place_reach_l1_ = metal::min(0.5 / product_2_, 48.0);
    float place_reach_l2_ = metal::min(0.5 / product_3_, 48.0);
    float place_reach_l3_ = metal::min(0.5 / product_4_, 48.0);
    metal::int2 _e123 = to_vec2i(metal::floor((metal::float2(0.03125, 0.0) * place_reach_l0_) + metal::float2(0.5)));
    metal::int2 tap_k0_l0_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e123));
    metal::int2 _e133 = to_vec2i(metal::floor((metal::float2(-0.06912833, 0.06332722) * place_reach_l1_) + metal::float2(0.5)));
    metal::int2 tap_k0_l1_ = as_type<metal::int2>(as_type<metal::uint2>(sum) + as_type<metal::uint2>(_e133));
    metal::int2 _e143 = to_vec2i(metal::floor((metal::float2(0.013660241, -0.15565173) * place_reach_l2_) + metal::float2(0.5)));
    metal::int2 tap_k0_l2_ = as_type<metal::int2>(as_type<metal::uint2>(sum_2_) + as_type<metal::uint2>(_e143));
    metal::int2 _e153 = to_vec2i(metal::floor((metal::float2(0.13309608, 0.17360009) * place_reach_l3_) + metal::float2(0.5)));
    metal::int2 tap_k0_l3_ = as_type<metal::int2>(as_type<metal::uint2>(sum_3_) + as_type<metal::uint2>(_e153));
    metal::float4 _e160 = depth.read(metal::uint2(metal::clamp(tap_k0_l0_, metal::int2(0), last)), 0);
    float z_k0_l0_ = _e160.x;
    metal::float4 _e167 = depth.read(metal::uint2(metal::clamp(tap_k0_l1_, metal::int2(0), last)), 0);
    float z_k0_l1_ = _e167.x;
    metal::float4 _e174 = depth.read(metal::uint2(metal::clamp(tap_k0_l2_, metal::int2(0), last)), 0);
    float z_k0_l2_ = _e174.x;
    metal::float4 _e181 = depth.read(metal::uint2(metal::clamp(tap_k0_l3_, metal::int2(0), last)), 0);
    float z_k0_l3_ = _e181.x;
    metal::float2 product_5_ = ((static_cast<metal::float2>(tap_k0_l0_) + metal::float2(0.5)) - place_middle) * (z_k0_l0_ * 0.005);
    metal::float2 product_6_ = ((static_cast<metal::float2>(tap_k0_l1_) + metal::float2(0.5)) - place_middle) * (z_k0_l1_ * 0.005);
    metal::float2 product_7_ = ((static_cast<metal::float2>(tap_k0_l2_) + metal::float2(0.5)) - place_middle) * (z_k0_l2_ * 0.005);
    metal::float2 product_8_ = ((static_cast<metal::float2>(tap_k0_l3_) + metal::float2(0.5)) - place_middle) * (z_k0_l3_ * 0.005);
    metal::float3 to_k0_l0_ = metal::float3(product_5_, z_k0_l0_) - place_from_l0_;
    metal::float3 to_k0_l1_ = metal::float3(product_6_, z_k0_l1_) - place_from_l1_;
    metal::float3 to_k0_l2_ = metal::float3(product_7_, z_k0_l2_) - place_from_l2_;
    metal::float3 to_k0_l3_ = metal::float3(product_8_, z_k0_l3_) - place_from_l3_;
    float squared_k0_l0_ = metal::dot(to_k0_l0_, to_k0_l0_);
    float squared_k0_l1_ = metal::dot(to_k0_l1_, to_k0_l1_);
    float squared_k0_l2_ = metal::dot(to_k0_l2_, to_k0_l2_);
    float squared_k0_l3_ = metal::dot(to_k0_l3_, to_k0_l3_);
    float cosine_k0_l0_ = metal::dot(to_k0_l0_, place_normal_l0_) * metal::rsqrt(metal::max(squared_k0_l0_, 0.000000000001));
    float cosine_k0_l1_ = metal::dot(to_k0_l1_, place_normal_l1_) * metal::rsqrt(metal::max(squared_k0_l1_, 0.000000000001));
    float cosine_k0_l2_ = metal::dot(to_k0_l2_, place_normal_l2_) * metal::rsqrt(metal::max(squared_k0_l2_, 0.000000000001));
    float cosine_k0_l3_ = metal::dot(to_k0_l3_, place_normal_l3_) * metal::rsqrt(metal::max(squared_k0_l3_, 0.000000000001));
    float occlusion_k0_l0_ = metal::max(cosine_k0_l0_ - 0.05, 0.0) * metal::max(1.0 - (squared_k0_l0_ / 0.25), 0.0);
    float occlusion_k0_l1_ = metal::max(cosine_k0_l1_ - 0.05, 0.0) * metal::max(1.0 - (squared_k0_l1_ / 0.25), 0.0);
    float occlusion_k0_l2_ = metal::max(cosine_k0_l2_ - 0.05, 0.0) * metal::max(1.0 - (squared_k0_l2_ / 0.25), 0.0);
    float occlusion_k0_l3_ = metal::max(cosine_k0_l3_ - 0.05, 0.0) * metal::max(1.0 - (squared_k0_l3_ / 0.25), 0.0);
    metal::int2 _e299 = to_vec2i(metal::floor((metal::float2(-0.2769507, -0.048988573) * place_reach_l0_) + metal::float2(0.5)));
    metal::int2 tap_k1_l0_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e299));
    metal::int2 _e309 = to_vec2i(metal::floor((metal::float2(0.29004085, -0.18450032) * place_reach_l1_) + metal::float2(0.5)));
    metal::int2 tap_k1_l1_ = as_type<metal::int2>(as_type<metal::uint2>(sum) + as_type<metal::uint2>(_e309));
    metal::int2 _e319 = to_vec2i(metal::floor((metal::float2(-0.10546385, 0.39232185) * place_reach_l2_) + metal::float2(0.5)));
    metal::int2 tap_k1_l2_ = as_type<metal::int2>(as_type<metal::uint2>(sum_2_) + as_type<metal::uint2>(_e319));
    metal::int2 _e329 = to_vec2i(metal::floor((metal::float2(-0.21605052, -0.41599125) * place_reach_l3_) + metal::float2(0.5)));
    metal::int2 tap_k1_l3_ = as_type<metal::int2>(as_type<metal::uint2>(sum_3_) + as_type<metal::uint2>(_e329));
    metal::float4 _e336 = depth.read(metal::uint2(metal::clamp(tap_k1_l0_, metal::int2(0), last)), 0);
    float z_k1_l0_ = _e336.x;
    metal::float4 _e343 = depth.read(metal::uint2(metal::clamp(tap_k1_l1_, metal::int2(0), last)), 0);
    float z_k1_l1_ = _e343.x;
    metal::float4 _e350 = depth.read(metal::uint2(metal::clamp(tap_k1_l2_, metal::int2(0), last)), 0);
    float z_k1_l2_ = _e350.x;
    metal::float4 _e357 = depth.read(metal::uint2(metal::clamp(tap_k1_l3_, metal::int2(0), last)), 0);
    float z_k1_l3_ = _e357.x;
    metal::float2 product_9_ = ((static_cast<metal::float2>(tap_k1_l0_) + metal::float2(0.5)) - place_middle) * (z_k1_l0_ * 0.005);
    metal::float2 product_10_ = ((static_cast<metal::float2>(tap_k1_l1_) + metal::float2(0.5)) - place_middle) * (z_k1_l1_ * 0.005);
    metal::float2 product_11_ = ((static_cast<metal::float2>(tap_k1_l2_) + metal::float2(0.5)) - place_middle) * (z_k1_l2_ * 0.005);
    metal::float2 product_12_ = ((static_cast<metal::float2>(tap_k1_l3_) + metal::float2(0.5)) - place_middle) * (z_k1_l3_ * 0.005);
    metal::float3 to_k1_l0_ = metal::float3(product_9_, z_k1_l0_) - place_from_l0_;
    metal::float3 to_k1_l1_ = metal::float3(product_10_, z_k1_l1_) - place_from_l1_;
    metal::float3 to_k1_l2_ = metal::float3(product_11_, z_k1_l2_) - place_from_l2_;
    metal::float3 to_k1_l3_ = metal::float3(product_12_, z_k1_l3_) - place_from_l3_;
    float squared_k1_l0_ = metal::dot(to_k1_l0_, to_k1_l0_);
    float squared_k1_l1_ = metal::dot(to_k1_l1_, to_k1_l1_);
    float squared_k1_l2_ = metal::dot(to_k1_l2_, to_k1_l2_);
    float squared_k1_l3_ = metal::dot(to_k1_l3_, to_k1_l3_);
    float cosine_k1_l0_ = metal::dot(to_k1_l0_, place_normal_l0_) * metal::rsqrt(metal::max(squared_k1_l0_, 0.000000000001));
    float cosine_k1_l1_ = metal::dot(to_k1_l1_, place_normal_l1_) * metal::rsqrt(metal::max(squared_k1_l1_, 0.000000000001));
    float cosine_k1_l2_ = metal::dot(to_k1_l2_, place_normal_l2_) * metal::rsqrt(metal::max(squared_k1_l2_, 0.000000000001));
    float cosine_k1_l3_ = metal::dot(to_k1_l3_, place_normal_l3_) * metal::rsqrt(metal::max(squared_k1_l3_, 0.000000000001));
    float occlusion_k1_l0_ = metal::max(cosine_k1_l0_ - 0.05, 0.0) * metal::max(1.0 - (squared_k1_l0_ / 0.25), 0.0);
    float occlusion_k1_l1_ = metal::max(cosine_k1_l1_ - 0.05, 0.0) * metal::max(1.0 - (squared_k1_l1_ / 0.25), 0.0);
    float occlusion_k1_l2_ = metal::max(cosine_k1_l2_ - 0.05, 0.0) * metal::max(1.0 - (squared_k1_l2_ / 0.25), 0.0);
    float occlusion_k1_l3_ = metal::max(cosine_k1_l3_ - 0.05, 0.0) * metal::max(1.0 - (squared_k1_l3_ / 0.25), 0.0);
    metal::int2 _e475 = to_vec2i(metal::floor((metal::float2(0.49901456, 0.18223892) * place_reach_l0_) + metal::float2(0.5)));
    metal::int2 tap_k2_l0_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e475));
    metal::int2 _e485 = to_vec2i(metal::floor((metal::float2(-0.54883003, 0.22654943) * place_reach_l1_) + metal::float2(0.5)));
    metal::int2 tap_k2_l1_ = as_type<metal::int2>(as_type<metal::uint2>(sum) + as_type<metal::uint2>(_e485));
    metal::int2 _e495 = to_vec2i(metal::floor((metal::float2(0.27814868, -0.5943882) * place_reach_l2_) + metal::float2(0.5)));
    metal::int2 tap_k2_l2_ = as_type<metal::int2>(as_type<metal::uint2>(sum_2_) + as_type<metal::uint2>(_e495));
    metal::int2 _e505 = to_vec2i(metal::floor((metal::float2(0.21511047, 0.6858054) * place_reach_l3_) + metal::float2(0.5)));
    metal::int2 tap_k2_l3_ = as_type<metal::int2>(as_type<metal::uint2>(sum_3_) + as_type<metal::uint2>(_e505));
    metal::float4 _e512 = depth.read(metal::uint2(metal::clamp(tap_k2_l0_, metal::int2(0), last)), 0);
    float z_k2_l0_ = _e512.x;
    metal::float4 _e519 = depth.read(metal::uint2(metal::clamp(tap_k2_l1_, metal::int2(0), last)), 0);
    float z_k2_l1_ = _e519.x;
    metal::float4 _e526 = depth.read(metal::uint2(metal::clamp(tap_k2_l2_, metal::int2(0), last)), 0);
    float z_k2_l2_ = _e526.x;
    metal::float4 _e533 = depth.read(metal::uint2(metal::clamp(tap_k2_l3_, metal::int2(0), last)), 0);
    float z_k2_l3_ = _e533.x;
    metal::float2 product_13_ = ((static_cast<metal::float2>(tap_k2_l0_) + metal::float2(0.5)) - place_middle) * (z_k2_l0_ * 0.005);
    metal::float2 product_14_ = ((static_cast<metal::float2>(tap_k2_l1_) + metal::float2(0.5)) - place_middle) * (z_k2_l1_ * 0.005);
    metal::float2 product_15_ = ((static_cast<metal::float2>(tap_k2_l2_) + metal::float2(0.5)) - place_middle) * (z_k2_l2_ * 0.005);
    metal::float2 product_16_ = ((static_cast<metal::float2>(tap_k2_l3_) + metal::float2(0.5)) - place_middle) * (z_k2_l3_ * 0.005);
    metal::float3 to_k2_l0_ = metal::float3(product_13_, z_k2_l0_) - place_from_l0_;
    metal::float3 to_k2_l1_ = metal::float3(product_14_, z_k2_l1_) - place_from_l1_;
    metal::float3 to_k2_l2_ = metal::float3(product_15_, z_k2_l2_) - place_from_l2_;
    metal::float3 to_k2_l3_ = metal::float3(product_16_, z_k2_l3_) - place_from_l3_;
    float squared_k2_l0_ = metal::dot(to_k2_l0_, to_k2_l0_);
    float squared_k2_l1_ = metal::dot(to_k2_l1_, to_k2_l1_);
    float squared_k2_l2_ = metal::dot(to_k2_l2_, to_k2_l2_);
    float squared_k2_l3_ = metal::dot(to_k2_l3_, to_k2_l3_);
    float cosine_k2_l0_ = metal::dot(to_k2_l0_, place_normal_l0_) * metal::rsqrt(metal::max(squared_k2_l0_, 0.000000000001));
    float cosine_k2_l1_ = metal::dot(to_k2_l1_, place_normal_l1_) * metal::rsqrt(metal::max(squared_k2_l1_, 0.000000000001));
    float cosine_k2_l2_ = metal::dot(to_k2_l2_, place_normal_l2_) * metal::rsqrt(metal::max(squared_k2_l2_, 0.000000000001));
    float cosine_k2_l3_ = metal::dot(to_k2_l3_, place_normal_l3_) * metal::rsqrt(metal::max(squared_k2_l3_, 0.000000000001));
    float occlusion_k2_l0_ = metal::max(cosine_k2_l0_ - 0.05, 0.0) * metal::max(1.0 - (squared_k2_l0_ / 0.25), 0.0);
    float occlusion_k2_l1_ = metal::max(cosine_k2_l1_ - 0.05, 0.0) * metal::max(1.0 - (squared_k2_l1_ / 0.25), 0.0);
    float occlusion_k2_l2_ = metal::max(cosine_k2_l2_ - 0.05, 0.0) * metal::max(1.0 - (squared_k2_l2_ / 0.25), 0.0);
    float occlusion_k2_l3_ = metal::max(cosine_k2_l3_ - 0.05, 0.0) * metal::max(1.0 - (squared_k2_l3_ / 0.25), 0.0);
    metal::int2 _e651 = to_vec2i(metal::floor((metal::float2(-0.675947, -0.3917233) * place_reach_l0_) + metal::float2(0.5)));
    metal::int2 tap_k3_l0_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e651));
    metal::int2 _e661 = to_vec2i(metal::floor((metal::float2(0.82406986, -0.18117106) * place_reach_l1_) + metal::float2(0.5)));
    metal::int2 tap_k3_l1_ = as_type<metal::int2>(as_type<metal::uint2>(sum) + as_type<metal::uint2>(_e661));
    metal::int2 _e671 = to_vec2i(metal::floor((metal::float2(-0.5212098, 0.74136996) * place_reach_l2_) + metal::float2(0.5)));
    metal::int2 tap_k3_l2_ = as_type<metal::int2>(as_type<metal::uint2>(sum_2_) + as_type<metal::uint2>(_e671));
    metal::int2 _e681 = to_vec2i(metal::floor((metal::float2(-0.124496244, -0.960717) * place_reach_l3_) + metal::float2(0.5)));
    metal::int2 tap_k3_l3_ = as_type<metal::int2>(as_type<metal::uint2>(sum_3_) + as_type<metal::uint2>(_e681));
    metal::float4 _e688 = depth.read(metal::uint2(metal::clamp(tap_k3_l0_, metal::int2(0), last)), 0);
    float z_k3_l0_ = _e688.x;
    metal::float4 _e695 = depth.read(metal::uint2(metal::clamp(tap_k3_l1_, metal::int2(0), last)), 0);
    float z_k3_l1_ = _e695.x;
    metal::float4 _e702 = depth.read(metal::uint2(metal::clamp(tap_k3_l2_, metal::int2(0), last)), 0);
    float z_k3_l2_ = _e702.x;
    metal::float4 _e709 = depth.read(metal::uint2(metal::clamp(tap_k3_l3_, metal::int2(0), last)), 0);
    float z_k3_l3_ = _e709.x;
    metal::float2 product_17_ = ((static_cast<metal::float2>(tap_k3_l0_) + metal::float2(0.5)) - place_middle) * (z_k3_l0_ * 0.005);
    metal::float2 product_18_ = ((static_cast<metal::float2>(tap_k3_l1_) + metal::float2(0.5)) - place_middle) * (z_k3_l1_ * 0.005);
    metal::float2 product_19_ = ((static_cast<metal::float2>(tap_k3_l2_) + metal::float2(0.5)) - place_middle) * (z_k3_l2_ * 0.005);
    metal::float2 product_20_ = ((static_cast<metal::float2>(tap_k3_l3_) + metal::float2(0.5)) - place_middle) * (z_k3_l3_ * 0.005);
    metal::float3 to_k3_l0_ = metal::float3(product_17_, z_k3_l0_) - place_from_l0_;
    metal::float3 to_k3_l1_ = metal::float3(product_18_, z_k3_l1_) - place_from_l1_;
    metal::float3 to_k3_l2_ = metal::float3(product_19_, z_k3_l2_) - place_from_l2_;
    metal::float3 to_k3_l3_ = metal::float3(product_20_, z_k3_l3_) - place_from_l3_;
    float squared_k3_l0_ = metal::dot(to_k3_l0_, to_k3_l0_);
    float squared_k3_l1_ = metal::dot(to_k3_l1_, to_k3_l1_);
    float squared_k3_l2_ = metal::dot(to_k3_l2_, to_k3_l2_);
    float squared_k3_l3_ = metal::dot(to_k3_l3_, to_k3_l3_);
    float cosine_k3_l0_ = metal::dot(to_k3_l0_, place_normal_l0_) * metal::rsqrt(metal::max(squared_k3_l0_, 0.000000000001));
    float cosine_k3_l1_ = metal::dot(to_k3_l1_, place_normal_l1_) * metal::rsqrt(metal::max(squared_k3_l1_, 0.000000000001));
    float cosine_k3_l2_ = metal::dot(to_k3_l2_, place_normal_l2_) * metal::rsqrt(metal::max(squared_k3_l2_, 0.000000000001));
    float cosine_k3_l3_ = metal::dot(to_k3_l3_, place_normal_l3_) * metal::rsqrt(metal::max(squared_k3_l3_, 0.000000000001));
    float occlusion_k3_l0_ = metal::max(cosine_k3_l0_ - 0.05, 0.0) * metal::max(1.0 - (squared_k3_l0_ / 0.25), 0.0);
    float occlusion_k3_l1_ = metal::max(cosine_k3_l1_ - 0.05, 0.0) * metal::max(1.0 - (squared_k3_l1_ / 0.25), 0.0);
    float occlusion_k3_l2_ = metal::max(cosine_k3_l2_ - 0.05, 0.0) * metal::max(1.0 - (squared_k3_l2_ / 0.25), 0.0);
    float occlusion_k3_l3_ = metal::max(cosine_k3_l3_ - 0.05, 0.0) * metal::max(1.0 - (squared_k3_l3_ / 0.25), 0.0);
    float sum_l0_ = ((((0.0 + occlusion_k0_l0_) + occlusion_k1_l0_) + occlusion_k2_l0_) + occlusion_k3_l0_) / 4.0;
    float sum_l1_ = ((((0.0 + occlusion_k0_l1_) + occlusion_k1_l1_) + occlusion_k2_l1_) + occlusion_k3_l1_) / 4.0;
    float sum_l2_ = ((((0.0 + occlusion_k0_l2_) + occlusion_k1_l2_) + occlusion_k2_l2_) + occlusion_k3_l2_) / 4.0;
    float sum_l3_ = ((((0.0 + occlusion_k0_l3_) + occlusion_k1_l3_) + occlusion_k2_l3_) + occlusion_k3_l3_) / 4.0;
    float away_k1_l0_ = (z_l1_ - z_l0_) / 0.1;
    float away_k1_l1_ = (z_l0_ - z_l1_) / 0.1;
    float away_k1_l2_ = (z_l3_ - z_l2_) / 0.1;
    float away_k1_l3_ = (z_l2_ - z_l3_) / 0.1;
    float weight_k1_l0_ = metal::exp2((away_k1_l0_ * away_k1_l0_) * -0.7213475);
    float weight_k1_l1_ = metal::exp2((away_k1_l1_ * away_k1_l1_) * -0.7213475);
    float weight_k1_l2_ = metal::exp2((away_k1_l2_ * away_k1_l2_) * -0.7213475);
    float weight_k1_l3_ = metal::exp2((away_k1_l3_ * away_k1_l3_) * -0.7213475);
    float away_k2_l0_ = (z_l2_ - z_l0_) / 0.1;
    float away_k2_l1_ = (z_l3_ - z_l1_) / 0.1;
    float away_k2_l2_ = (z_l0_ - z_l2_) / 0.1;
    float away_k2_l3_ = (z_l1_ - z_l3_) / 0.1;
    float weight_k2_l0_ = metal::exp2((away_k2_l0_ * away_k2_l0_) * -0.7213475);
    float weight_k2_l1_ = metal::exp2((away_k2_l1_ * away_k2_l1_) * -0.7213475);
    float weight_k2_l2_ = metal::exp2((away_k2_l2_ * away_k2_l2_) * -0.7213475);
    float weight_k2_l3_ = metal::exp2((away_k2_l3_ * away_k2_l3_) * -0.7213475);
    float away_k3_l0_ = (z_l3_ - z_l0_) / 0.1;
    float away_k3_l1_ = (z_l2_ - z_l1_) / 0.1;
    float away_k3_l2_ = (z_l1_ - z_l2_) / 0.1;
    float away_k3_l3_ = (z_l0_ - z_l3_) / 0.1;
    float weight_k3_l0_ = metal::exp2((away_k3_l0_ * away_k3_l0_) * -0.7213475);
    float weight_k3_l1_ = metal::exp2((away_k3_l1_ * away_k3_l1_) * -0.7213475);
    float weight_k3_l2_ = metal::exp2((away_k3_l2_ * away_k3_l2_) * -0.7213475);
    float weight_k3_l3_ = metal::exp2((away_k3_l3_ * away_k3_l3_) * -0.7213475);
    float sum_k3_l0_ = ((sum_l0_ + (sum_l1_ * weight_k1_l0_)) + (sum_l2_ * weight_k2_l0_)) + (sum_l3_ * weight_k3_l0_);
    float sum_k3_l1_ = ((sum_l1_ + (sum_l0_ * weight_k1_l1_)) + (sum_l3_ * weight_k2_l1_)) + (sum_l2_ * weight_k3_l1_);
    float sum_k3_l2_ = ((sum_l2_ + (sum_l3_ * weight_k1_l2_)) + (sum_l0_ * weight_k2_l2_)) + (sum_l1_ * weight_k3_l2_);
    float sum_k3_l3_ = ((sum_l3_ + (sum_l2_ * weight_k1_l3_)) + (sum_l1_ * weight_k2_l3_)) + (sum_l0_ * weight_k3_l3_);
    float difference = 1.0 - ((sum_k3_l0_ / (((1.0 + weight_k1_l0_) + weight_k2_l0_) + weight_k3_l0_)) * 2.0);
    float difference_2_ = 1.0 - ((sum_k3_l1_ / (((1.0 + weight_k1_l1_) + weight_k2_l1_) + weight_k3_l1_)) * 2.0);
    float difference_3_ = 1.0 - ((sum_k3_l2_ / (((1.0 + weight_k1_l2_) + weight_k2_l2_) + weight_k3_l2_)) * 2.0);
    float difference_4_ = 1.0 - ((sum_k3_l3_ / (((1.0 + weight_k1_l3_) + weight_k2_l3_) + weight_k3_l3_)) * 2.0);
    destination.write(metal::float4(metal::saturate(difference)), metal::uint2(pixel));
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0))) < frame)) {
        destination.write(metal::float4(metal::saturate(difference_2_)), metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1))) < frame)) {
        destination.write(metal::float4(metal::saturate(difference_3_)), metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1))) < frame)) {
        destination.write(metal::float4(metal::saturate(difference_4_)), metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1)))));
        return;
    } else {
        return;
    }
}
