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
    metal::int2 pixel = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(id.xy)) * as_type<metal::uint2>(metal::int2(2, 2)));
    if (metal::any(pixel >= frame)) {
        return;
    }
    metal::int2 texel = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0)));
    metal::int2 texel_2_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1)));
    metal::int2 texel_3_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1)));
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 texel_l1_ = metal::min(texel, last);
    metal::int2 texel_l2_ = metal::min(texel_2_, last);
    metal::int2 texel_l3_ = metal::min(texel_3_, last);
    metal::float4 _e31 = depth.read(metal::uint2(pixel), 0);
    float z_l0_ = _e31.x;
    metal::float4 _e35 = depth.read(metal::uint2(texel_l1_), 0);
    float z_l1_ = _e35.x;
    metal::float4 _e39 = depth.read(metal::uint2(texel_l2_), 0);
    float z_l2_ = _e39.x;
    metal::float4 _e43 = depth.read(metal::uint2(texel_l3_), 0);
    float z_l3_ = _e43.x;
    metal::float2 place_middle = static_cast<metal::float2>(static_cast<metal::uint2>(frame)) * metal::float2(0.5);
    float value = z_l0_ * 0.005;
    float value_2_ = z_l1_ * 0.005;
    float value_3_ = z_l2_ * 0.005;
    float value_4_ = z_l3_ * 0.005;
    metal::float2 value_5_ = ((static_cast<metal::float2>(pixel) + metal::float2(0.5)) - place_middle) * value;
    metal::float2 value_6_ = ((static_cast<metal::float2>(texel) + metal::float2(0.5)) - place_middle) * value_2_;
    metal::float2 value_7_ = ((static_cast<metal::float2>(texel_2_) + metal::float2(0.5)) - place_middle) * value_3_;
    metal::float2 value_8_ = ((static_cast<metal::float2>(texel_3_) + metal::float2(0.5)) - place_middle) * value_4_;
    metal::float3 place_from_l0_ = metal::float3(value_5_.x, value_5_.y, z_l0_);
    metal::float3 place_from_l1_ = metal::float3(value_6_.x, value_6_.y, z_l1_);
    metal::float3 place_from_l2_ = metal::float3(value_7_.x, value_7_.y, z_l2_);
    metal::float3 place_from_l3_ = metal::float3(value_8_.x, value_8_.y, z_l3_);
    metal::float4 _e96 = normal.read(metal::uint2(pixel), 0);
    metal::float3 place_normal_l0_ = _e96.xyz;
    metal::float4 _e100 = normal.read(metal::uint2(texel_l1_), 0);
    metal::float3 place_normal_l1_ = _e100.xyz;
    metal::float4 _e104 = normal.read(metal::uint2(texel_l2_), 0);
    metal::float3 place_normal_l2_ = _e104.xyz;
    metal::float4 _e108 = normal.read(metal::uint2(texel_l3_), 0);
    metal::float3 place_normal_l3_ = _e108.xyz;
    float place_reach_l0_ = metal::min(0.5 / value, 48.0);
    float place_reach_l1_ = metal::min(0.5 / value_2_, 48.0);
    float place_reach_l2_ = metal::min(0.5 / value_3_, 48.0);
    float place_reach_l3_ = metal::min(0.5 / value_4_, 48.0);
    metal::int2 _e134 = to_vec2i(metal::floor((metal::float2(0.03125, 0.0) * place_reach_l0_) + metal::float2(0.5)));
    metal::int2 tap_k0_l0_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e134));
    metal::int2 _e144 = to_vec2i(metal::floor((metal::float2(-0.06912833, 0.06332722) * place_reach_l1_) + metal::float2(0.5)));
    metal::int2 tap_k0_l1_ = as_type<metal::int2>(as_type<metal::uint2>(texel) + as_type<metal::uint2>(_e144));
    metal::int2 _e154 = to_vec2i(metal::floor((metal::float2(0.013660241, -0.15565173) * place_reach_l2_) + metal::float2(0.5)));
    metal::int2 tap_k0_l2_ = as_type<metal::int2>(as_type<metal::uint2>(texel_2_) + as_type<metal::uint2>(_e154));
    metal::int2 _e164 = to_vec2i(metal::floor((metal::float2(0.13309608, 0.17360009) * place_reach_l3_) + metal::float2(0.5)));
    metal::int2 tap_k0_l3_ = as_type<metal::int2>(as_type<metal::uint2>(texel_3_) + as_type<metal::uint2>(_e164));
    metal::int2 texel_k0_l0_ = metal::clamp(tap_k0_l0_, metal::int2(0), last);
    metal::int2 texel_k0_l1_ = metal::clamp(tap_k0_l1_, metal::int2(0), last);
    metal::int2 texel_k0_l2_ = metal::clamp(tap_k0_l2_, metal::int2(0), last);
    metal::int2 texel_k0_l3_ = metal::clamp(tap_k0_l3_, metal::int2(0), last);
    metal::float4 _e180 = depth.read(metal::uint2(texel_k0_l0_), 0);
    float depth_texel = _e180.x;
    metal::float4 _e184 = depth.read(metal::uint2(texel_k0_l1_), 0);
    float depth_texel_2_ = _e184.x;
    metal::float4 _e188 = depth.read(metal::uint2(texel_k0_l2_), 0);
    float depth_texel_3_ = _e188.x;
    metal::float4 _e192 = depth.read(metal::uint2(texel_k0_l3_), 0);
    float depth_texel_4_ = _e192.x;
    metal::float2 value_9_ = ((static_cast<metal::float2>(tap_k0_l0_) + metal::float2(0.5)) - place_middle) * (depth_texel * 0.005);
    metal::float2 value_10_ = ((static_cast<metal::float2>(tap_k0_l1_) + metal::float2(0.5)) - place_middle) * (depth_texel_2_ * 0.005);
    metal::float2 value_11_ = ((static_cast<metal::float2>(tap_k0_l2_) + metal::float2(0.5)) - place_middle) * (depth_texel_3_ * 0.005);
    metal::float2 value_12_ = ((static_cast<metal::float2>(tap_k0_l3_) + metal::float2(0.5)) - place_middle) * (depth_texel_4_ * 0.005);
    metal::float3 to_k0_l0_ = metal::float3(value_9_.x, value_9_.y, depth_texel) - place_from_l0_;
    metal::float3 to_k0_l1_ = metal::float3(value_10_.x, value_10_.y, depth_texel_2_) - place_from_l1_;
    metal::float3 to_k0_l2_ = metal::float3(value_11_.x, value_11_.y, depth_texel_3_) - place_from_l2_;
    metal::float3 to_k0_l3_ = metal::float3(value_12_.x, value_12_.y, depth_texel_4_) - place_from_l3_;
    float squared_k0_l0_ = metal::dot(to_k0_l0_, to_k0_l0_);
    float squared_k0_l1_ = metal::dot(to_k0_l1_, to_k0_l1_);
    float squared_k0_l2_ = metal::dot(to_k0_l2_, to_k0_l2_);
    float squared_k0_l3_ = metal::dot(to_k0_l3_, to_k0_l3_);
    float cosine_k0_l0_ = metal::dot(to_k0_l0_, place_normal_l0_) * metal::rsqrt(metal::max(squared_k0_l0_, 0.000000000001));
    float cosine_k0_l1_ = metal::dot(to_k0_l1_, place_normal_l1_) * metal::rsqrt(metal::max(squared_k0_l1_, 0.000000000001));
    float cosine_k0_l2_ = metal::dot(to_k0_l2_, place_normal_l2_) * metal::rsqrt(metal::max(squared_k0_l2_, 0.000000000001));
    float cosine_k0_l3_ = metal::dot(to_k0_l3_, place_normal_l3_) * metal::rsqrt(metal::max(squared_k0_l3_, 0.000000000001));
    float near_k0_l0_ = metal::max(1.0 - (squared_k0_l0_ / 0.25), 0.0);
    float near_k0_l1_ = metal::max(1.0 - (squared_k0_l1_ / 0.25), 0.0);
    float near_k0_l2_ = metal::max(1.0 - (squared_k0_l2_ / 0.25), 0.0);
    float near_k0_l3_ = metal::max(1.0 - (squared_k0_l3_ / 0.25), 0.0);
    float own_k0_l0_ = 0.0 + (metal::max(cosine_k0_l0_ - 0.05, 0.0) * near_k0_l0_);
    float own_k0_l1_ = 0.0 + (metal::max(cosine_k0_l1_ - 0.05, 0.0) * near_k0_l1_);
    float own_k0_l2_ = 0.0 + (metal::max(cosine_k0_l2_ - 0.05, 0.0) * near_k0_l2_);
    float own_k0_l3_ = 0.0 + (metal::max(cosine_k0_l3_ - 0.05, 0.0) * near_k0_l3_);
    metal::int2 _e326 = to_vec2i(metal::floor((metal::float2(-0.2769507, -0.048988573) * place_reach_l0_) + metal::float2(0.5)));
    metal::int2 tap_k1_l0_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e326));
    metal::int2 _e336 = to_vec2i(metal::floor((metal::float2(0.29004085, -0.18450032) * place_reach_l1_) + metal::float2(0.5)));
    metal::int2 tap_k1_l1_ = as_type<metal::int2>(as_type<metal::uint2>(texel) + as_type<metal::uint2>(_e336));
    metal::int2 _e346 = to_vec2i(metal::floor((metal::float2(-0.10546385, 0.39232185) * place_reach_l2_) + metal::float2(0.5)));
    metal::int2 tap_k1_l2_ = as_type<metal::int2>(as_type<metal::uint2>(texel_2_) + as_type<metal::uint2>(_e346));
    metal::int2 _e356 = to_vec2i(metal::floor((metal::float2(-0.21605052, -0.41599125) * place_reach_l3_) + metal::float2(0.5)));
    metal::int2 tap_k1_l3_ = as_type<metal::int2>(as_type<metal::uint2>(texel_3_) + as_type<metal::uint2>(_e356));
    metal::int2 texel_k1_l0_ = metal::clamp(tap_k1_l0_, metal::int2(0), last);
    metal::int2 texel_k1_l1_ = metal::clamp(tap_k1_l1_, metal::int2(0), last);
    metal::int2 texel_k1_l2_ = metal::clamp(tap_k1_l2_, metal::int2(0), last);
    metal::int2 texel_k1_l3_ = metal::clamp(tap_k1_l3_, metal::int2(0), last);
    metal::float4 _e372 = depth.read(metal::uint2(texel_k1_l0_), 0);
    float depth_texel_5_ = _e372.x;
    metal::float4 _e376 = depth.read(metal::uint2(texel_k1_l1_), 0);
    float depth_texel_6_ = _e376.x;
    metal::float4 _e380 = depth.read(metal::uint2(texel_k1_l2_), 0);
    float depth_texel_7_ = _e380.x;
    metal::float4 _e384 = depth.read(metal::uint2(texel_k1_l3_), 0);
    float depth_texel_8_ = _e384.x;
    metal::float2 value_13_ = ((static_cast<metal::float2>(tap_k1_l0_) + metal::float2(0.5)) - place_middle) * (depth_texel_5_ * 0.005);
    metal::float2 value_14_ = ((static_cast<metal::float2>(tap_k1_l1_) + metal::float2(0.5)) - place_middle) * (depth_texel_6_ * 0.005);
    metal::float2 value_15_ = ((static_cast<metal::float2>(tap_k1_l2_) + metal::float2(0.5)) - place_middle) * (depth_texel_7_ * 0.005);
    metal::float2 value_16_ = ((static_cast<metal::float2>(tap_k1_l3_) + metal::float2(0.5)) - place_middle) * (depth_texel_8_ * 0.005);
    metal::float3 to_k1_l0_ = metal::float3(value_13_.x, value_13_.y, depth_texel_5_) - place_from_l0_;
    metal::float3 to_k1_l1_ = metal::float3(value_14_.x, value_14_.y, depth_texel_6_) - place_from_l1_;
    metal::float3 to_k1_l2_ = metal::float3(value_15_.x, value_15_.y, depth_texel_7_) - place_from_l2_;
    metal::float3 to_k1_l3_ = metal::float3(value_16_.x, value_16_.y, depth_texel_8_) - place_from_l3_;
    float squared_k1_l0_ = metal::dot(to_k1_l0_, to_k1_l0_);
    float squared_k1_l1_ = metal::dot(to_k1_l1_, to_k1_l1_);
    float squared_k1_l2_ = metal::dot(to_k1_l2_, to_k1_l2_);
    float squared_k1_l3_ = metal::dot(to_k1_l3_, to_k1_l3_);
    float cosine_k1_l0_ = metal::dot(to_k1_l0_, place_normal_l0_) * metal::rsqrt(metal::max(squared_k1_l0_, 0.000000000001));
    float cosine_k1_l1_ = metal::dot(to_k1_l1_, place_normal_l1_) * metal::rsqrt(metal::max(squared_k1_l1_, 0.000000000001));
    float cosine_k1_l2_ = metal::dot(to_k1_l2_, place_normal_l2_) * metal::rsqrt(metal::max(squared_k1_l2_, 0.000000000001));
    float cosine_k1_l3_ = metal::dot(to_k1_l3_, place_normal_l3_) * metal::rsqrt(metal::max(squared_k1_l3_, 0.000000000001));
    float near_k1_l0_ = metal::max(1.0 - (squared_k1_l0_ / 0.25), 0.0);
    float near_k1_l1_ = metal::max(1.0 - (squared_k1_l1_ / 0.25), 0.0);
    float near_k1_l2_ = metal::max(1.0 - (squared_k1_l2_ / 0.25), 0.0);
    float near_k1_l3_ = metal::max(1.0 - (squared_k1_l3_ / 0.25), 0.0);
    float own_k1_l0_ = own_k0_l0_ + (metal::max(cosine_k1_l0_ - 0.05, 0.0) * near_k1_l0_);
    float own_k1_l1_ = own_k0_l1_ + (metal::max(cosine_k1_l1_ - 0.05, 0.0) * near_k1_l1_);
    float own_k1_l2_ = own_k0_l2_ + (metal::max(cosine_k1_l2_ - 0.05, 0.0) * near_k1_l2_);
    float own_k1_l3_ = own_k0_l3_ + (metal::max(cosine_k1_l3_ - 0.05, 0.0) * near_k1_l3_);
    metal::int2 _e514 = to_vec2i(metal::floor((metal::float2(0.49901456, 0.18223892) * place_reach_l0_) + metal::float2(0.5)));
    metal::int2 tap_k2_l0_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e514));
    metal::int2 _e524 = to_vec2i(metal::floor((metal::float2(-0.54883003, 0.22654943) * place_reach_l1_) + metal::float2(0.5)));
    metal::int2 tap_k2_l1_ = as_type<metal::int2>(as_type<metal::uint2>(texel) + as_type<metal::uint2>(_e524));
    metal::int2 _e534 = to_vec2i(metal::floor((metal::float2(0.27814868, -0.5943882) * place_reach_l2_) + metal::float2(0.5)));
    metal::int2 tap_k2_l2_ = as_type<metal::int2>(as_type<metal::uint2>(texel_2_) + as_type<metal::uint2>(_e534));
    metal::int2 _e544 = to_vec2i(metal::floor((metal::float2(0.21511047, 0.6858054) * place_reach_l3_) + metal::float2(0.5)));
    metal::int2 tap_k2_l3_ = as_type<metal::int2>(as_type<metal::uint2>(texel_3_) + as_type<metal::uint2>(_e544));
    metal::int2 texel_k2_l0_ = metal::clamp(tap_k2_l0_, metal::int2(0), last);
    metal::int2 texel_k2_l1_ = metal::clamp(tap_k2_l1_, metal::int2(0), last);
    metal::int2 texel_k2_l2_ = metal::clamp(tap_k2_l2_, metal::int2(0), last);
    metal::int2 texel_k2_l3_ = metal::clamp(tap_k2_l3_, metal::int2(0), last);
    metal::float4 _e560 = depth.read(metal::uint2(texel_k2_l0_), 0);
    float depth_texel_9_ = _e560.x;
    metal::float4 _e564 = depth.read(metal::uint2(texel_k2_l1_), 0);
    float depth_texel_10_ = _e564.x;
    metal::float4 _e568 = depth.read(metal::uint2(texel_k2_l2_), 0);
    float depth_texel_11_ = _e568.x;
    metal::float4 _e572 = depth.read(metal::uint2(texel_k2_l3_), 0);
    float depth_texel_12_ = _e572.x;
    metal::float2 value_17_ = ((static_cast<metal::float2>(tap_k2_l0_) + metal::float2(0.5)) - place_middle) * (depth_texel_9_ * 0.005);
    metal::float2 value_18_ = ((static_cast<metal::float2>(tap_k2_l1_) + metal::float2(0.5)) - place_middle) * (depth_texel_10_ * 0.005);
    metal::float2 value_19_ = ((static_cast<metal::float2>(tap_k2_l2_) + metal::float2(0.5)) - place_middle) * (depth_texel_11_ * 0.005);
    metal::float2 value_20_ = ((static_cast<metal::float2>(tap_k2_l3_) + metal::float2(0.5)) - place_middle) * (depth_texel_12_ * 0.005);
    metal::float3 to_k2_l0_ = metal::float3(value_17_.x, value_17_.y, depth_texel_9_) - place_from_l0_;
    metal::float3 to_k2_l1_ = metal::float3(value_18_.x, value_18_.y, depth_texel_10_) - place_from_l1_;
    metal::float3 to_k2_l2_ = metal::float3(value_19_.x, value_19_.y, depth_texel_11_) - place_from_l2_;
    metal::float3 to_k2_l3_ = metal::float3(value_20_.x, value_20_.y, depth_texel_12_) - place_from_l3_;
    float squared_k2_l0_ = metal::dot(to_k2_l0_, to_k2_l0_);
    float squared_k2_l1_ = metal::dot(to_k2_l1_, to_k2_l1_);
    float squared_k2_l2_ = metal::dot(to_k2_l2_, to_k2_l2_);
    float squared_k2_l3_ = metal::dot(to_k2_l3_, to_k2_l3_);
    float cosine_k2_l0_ = metal::dot(to_k2_l0_, place_normal_l0_) * metal::rsqrt(metal::max(squared_k2_l0_, 0.000000000001));
    float cosine_k2_l1_ = metal::dot(to_k2_l1_, place_normal_l1_) * metal::rsqrt(metal::max(squared_k2_l1_, 0.000000000001));
    float cosine_k2_l2_ = metal::dot(to_k2_l2_, place_normal_l2_) * metal::rsqrt(metal::max(squared_k2_l2_, 0.000000000001));
    float cosine_k2_l3_ = metal::dot(to_k2_l3_, place_normal_l3_) * metal::rsqrt(metal::max(squared_k2_l3_, 0.000000000001));
    float near_k2_l0_ = metal::max(1.0 - (squared_k2_l0_ / 0.25), 0.0);
    float near_k2_l1_ = metal::max(1.0 - (squared_k2_l1_ / 0.25), 0.0);
    float near_k2_l2_ = metal::max(1.0 - (squared_k2_l2_ / 0.25), 0.0);
    float near_k2_l3_ = metal::max(1.0 - (squared_k2_l3_ / 0.25), 0.0);
    float own_k2_l0_ = own_k1_l0_ + (metal::max(cosine_k2_l0_ - 0.05, 0.0) * near_k2_l0_);
    float own_k2_l1_ = own_k1_l1_ + (metal::max(cosine_k2_l1_ - 0.05, 0.0) * near_k2_l1_);
    float own_k2_l2_ = own_k1_l2_ + (metal::max(cosine_k2_l2_ - 0.05, 0.0) * near_k2_l2_);
    float own_k2_l3_ = own_k1_l3_ + (metal::max(cosine_k2_l3_ - 0.05, 0.0) * near_k2_l3_);
    metal::int2 _e702 = to_vec2i(metal::floor((metal::float2(-0.675947, -0.3917233) * place_reach_l0_) + metal::float2(0.5)));
    metal::int2 tap_k3_l0_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e702));
    metal::int2 _e712 = to_vec2i(metal::floor((metal::float2(0.82406986, -0.18117106) * place_reach_l1_) + metal::float2(0.5)));
    metal::int2 tap_k3_l1_ = as_type<metal::int2>(as_type<metal::uint2>(texel) + as_type<metal::uint2>(_e712));
    metal::int2 _e722 = to_vec2i(metal::floor((metal::float2(-0.5212098, 0.74136996) * place_reach_l2_) + metal::float2(0.5)));
    metal::int2 tap_k3_l2_ = as_type<metal::int2>(as_type<metal::uint2>(texel_2_) + as_type<metal::uint2>(_e722));
    metal::int2 _e732 = to_vec2i(metal::floor((metal::float2(-0.124496244, -0.960717) * place_reach_l3_) + metal::float2(0.5)));
    metal::int2 tap_k3_l3_ = as_type<metal::int2>(as_type<metal::uint2>(texel_3_) + as_type<metal::uint2>(_e732));
    metal::int2 texel_k3_l0_ = metal::clamp(tap_k3_l0_, metal::int2(0), last);
    metal::int2 texel_k3_l1_ = metal::clamp(tap_k3_l1_, metal::int2(0), last);
    metal::int2 texel_k3_l2_ = metal::clamp(tap_k3_l2_, metal::int2(0), last);
    metal::int2 texel_k3_l3_ = metal::clamp(tap_k3_l3_, metal::int2(0), last);
    metal::float4 _e748 = depth.read(metal::uint2(texel_k3_l0_), 0);
    float depth_texel_13_ = _e748.x;
    metal::float4 _e752 = depth.read(metal::uint2(texel_k3_l1_), 0);
    float depth_texel_14_ = _e752.x;
    metal::float4 _e756 = depth.read(metal::uint2(texel_k3_l2_), 0);
    float depth_texel_15_ = _e756.x;
    metal::float4 _e760 = depth.read(metal::uint2(texel_k3_l3_), 0);
    float depth_texel_16_ = _e760.x;
    metal::float2 value_21_ = ((static_cast<metal::float2>(tap_k3_l0_) + metal::float2(0.5)) - place_middle) * (depth_texel_13_ * 0.005);
    metal::float2 value_22_ = ((static_cast<metal::float2>(tap_k3_l1_) + metal::float2(0.5)) - place_middle) * (depth_texel_14_ * 0.005);
    metal::float2 value_23_ = ((static_cast<metal::float2>(tap_k3_l2_) + metal::float2(0.5)) - place_middle) * (depth_texel_15_ * 0.005);
    metal::float2 value_24_ = ((static_cast<metal::float2>(tap_k3_l3_) + metal::float2(0.5)) - place_middle) * (depth_texel_16_ * 0.005);
    metal::float3 to_k3_l0_ = metal::float3(value_21_.x, value_21_.y, depth_texel_13_) - place_from_l0_;
    metal::float3 to_k3_l1_ = metal::float3(value_22_.x, value_22_.y, depth_texel_14_) - place_from_l1_;
    metal::float3 to_k3_l2_ = metal::float3(value_23_.x, value_23_.y, depth_texel_15_) - place_from_l2_;
    metal::float3 to_k3_l3_ = metal::float3(value_24_.x, value_24_.y, depth_texel_16_) - place_from_l3_;
    float squared_k3_l0_ = metal::dot(to_k3_l0_, to_k3_l0_);
    float squared_k3_l1_ = metal::dot(to_k3_l1_, to_k3_l1_);
    float squared_k3_l2_ = metal::dot(to_k3_l2_, to_k3_l2_);
    float squared_k3_l3_ = metal::dot(to_k3_l3_, to_k3_l3_);
    float cosine_k3_l0_ = metal::dot(to_k3_l0_, place_normal_l0_) * metal::rsqrt(metal::max(squared_k3_l0_, 0.000000000001));
    float cosine_k3_l1_ = metal::dot(to_k3_l1_, place_normal_l1_) * metal::rsqrt(metal::max(squared_k3_l1_, 0.000000000001));
    float cosine_k3_l2_ = metal::dot(to_k3_l2_, place_normal_l2_) * metal::rsqrt(metal::max(squared_k3_l2_, 0.000000000001));
    float cosine_k3_l3_ = metal::dot(to_k3_l3_, place_normal_l3_) * metal::rsqrt(metal::max(squared_k3_l3_, 0.000000000001));
    float near_k3_l0_ = metal::max(1.0 - (squared_k3_l0_ / 0.25), 0.0);
    float near_k3_l1_ = metal::max(1.0 - (squared_k3_l1_ / 0.25), 0.0);
    float near_k3_l2_ = metal::max(1.0 - (squared_k3_l2_ / 0.25), 0.0);
    float near_k3_l3_ = metal::max(1.0 - (squared_k3_l3_ / 0.25), 0.0);
    float own_k3_l0_ = own_k2_l0_ + (metal::max(cosine_k3_l0_ - 0.05, 0.0) * near_k3_l0_);
    float own_k3_l1_ = own_k2_l1_ + (metal::max(cosine_k3_l1_ - 0.05, 0.0) * near_k3_l1_);
    float own_k3_l2_ = own_k2_l2_ + (metal::max(cosine_k3_l2_ - 0.05, 0.0) * near_k3_l2_);
    float own_k3_l3_ = own_k2_l3_ + (metal::max(cosine_k3_l3_ - 0.05, 0.0) * near_k3_l3_);
    float sum_l0_ = own_k3_l0_ / 4.0;
    float sum_l1_ = own_k3_l1_ / 4.0;
    float sum_l2_ = own_k3_l2_ / 4.0;
    float sum_l3_ = own_k3_l3_ / 4.0;
    float away_k1_l0_ = (z_l1_ - z_l0_) / 0.1;
    float away_k1_l1_ = (z_l0_ - z_l1_) / 0.1;
    float away_k1_l2_ = (z_l3_ - z_l2_) / 0.1;
    float away_k1_l3_ = (z_l2_ - z_l3_) / 0.1;
    float weight_k1_l0_ = metal::exp2((away_k1_l0_ * away_k1_l0_) * -0.7213475);
    float weight_k1_l1_ = metal::exp2((away_k1_l1_ * away_k1_l1_) * -0.7213475);
    float weight_k1_l2_ = metal::exp2((away_k1_l2_ * away_k1_l2_) * -0.7213475);
    float weight_k1_l3_ = metal::exp2((away_k1_l3_ * away_k1_l3_) * -0.7213475);
    float sum_k1_l0_ = sum_l0_ + (sum_l1_ * weight_k1_l0_);
    float sum_k1_l1_ = sum_l1_ + (sum_l0_ * weight_k1_l1_);
    float sum_k1_l2_ = sum_l2_ + (sum_l3_ * weight_k1_l2_);
    float sum_k1_l3_ = sum_l3_ + (sum_l2_ * weight_k1_l3_);
    float total_k1_l0_ = 1.0 + weight_k1_l0_;
    float total_k1_l1_ = 1.0 + weight_k1_l1_;
    float total_k1_l2_ = 1.0 + weight_k1_l2_;
    float total_k1_l3_ = 1.0 + weight_k1_l3_;
    float away_k2_l0_ = (z_l2_ - z_l0_) / 0.1;
    float away_k2_l1_ = (z_l3_ - z_l1_) / 0.1;
    float away_k2_l2_ = (z_l0_ - z_l2_) / 0.1;
    float away_k2_l3_ = (z_l1_ - z_l3_) / 0.1;
    float weight_k2_l0_ = metal::exp2((away_k2_l0_ * away_k2_l0_) * -0.7213475);
    float weight_k2_l1_ = metal::exp2((away_k2_l1_ * away_k2_l1_) * -0.7213475);
    float weight_k2_l2_ = metal::exp2((away_k2_l2_ * away_k2_l2_) * -0.7213475);
    float weight_k2_l3_ = metal::exp2((away_k2_l3_ * away_k2_l3_) * -0.7213475);
    float sum_k2_l0_ = sum_k1_l0_ + (sum_l2_ * weight_k2_l0_);
    float sum_k2_l1_ = sum_k1_l1_ + (sum_l3_ * weight_k2_l1_);
    float sum_k2_l2_ = sum_k1_l2_ + (sum_l0_ * weight_k2_l2_);
    float sum_k2_l3_ = sum_k1_l3_ + (sum_l1_ * weight_k2_l3_);
    float total_k2_l0_ = total_k1_l0_ + weight_k2_l0_;
    float total_k2_l1_ = total_k1_l1_ + weight_k2_l1_;
    float total_k2_l2_ = total_k1_l2_ + weight_k2_l2_;
    float total_k2_l3_ = total_k1_l3_ + weight_k2_l3_;
    float away_k3_l0_ = (z_l3_ - z_l0_) / 0.1;
    float away_k3_l1_ = (z_l2_ - z_l1_) / 0.1;
    float away_k3_l2_ = (z_l1_ - z_l2_) / 0.1;
    float away_k3_l3_ = (z_l0_ - z_l3_) / 0.1;
    float weight_k3_l0_ = metal::exp2((away_k3_l0_ * away_k3_l0_) * -0.7213475);
    float weight_k3_l1_ = metal::exp2((away_k3_l1_ * away_k3_l1_) * -0.7213475);
    float weight_k3_l2_ = metal::exp2((away_k3_l2_ * away_k3_l2_) * -0.7213475);
    float weight_k3_l3_ = metal::exp2((away_k3_l3_ * away_k3_l3_) * -0.7213475);
    float sum_k3_l0_ = sum_k2_l0_ + (sum_l3_ * weight_k3_l0_);
    float sum_k3_l1_ = sum_k2_l1_ + (sum_l2_ * weight_k3_l1_);
    float sum_k3_l2_ = sum_k2_l2_ + (sum_l1_ * weight_k3_l2_);
    float sum_k3_l3_ = sum_k2_l3_ + (sum_l0_ * weight_k3_l3_);
    float total_k3_l0_ = total_k2_l0_ + weight_k3_l0_;
    float total_k3_l1_ = total_k2_l1_ + weight_k3_l1_;
    float total_k3_l2_ = total_k2_l2_ + weight_k3_l2_;
    float total_k3_l3_ = total_k2_l3_ + weight_k3_l3_;
    float occluded_l0_ = sum_k3_l0_ / total_k3_l0_;
    float occluded_l1_ = sum_k3_l1_ / total_k3_l1_;
    float occluded_l2_ = sum_k3_l2_ / total_k3_l2_;
    float occluded_l3_ = sum_k3_l3_ / total_k3_l3_;
    destination.write(metal::float4(metal::saturate(1.0 - (occluded_l0_ * 2.0))), metal::uint2(pixel));
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0))) < frame)) {
        destination.write(metal::float4(metal::saturate(1.0 - (occluded_l1_ * 2.0))), metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1))) < frame)) {
        destination.write(metal::float4(metal::saturate(1.0 - (occluded_l2_ * 2.0))), metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 1))) < frame)) {
        destination.write(metal::float4(metal::saturate(1.0 - (occluded_l3_ * 2.0))), metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 1)))));
        return;
    } else {
        return;
    }
}
