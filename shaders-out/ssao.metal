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
struct quad_ssaoOutput {
    metal::float4 member [[color(0)]];
};
fragment quad_ssaoOutput quad_ssao(
  metal::float4 position [[position]]
, metal::texture2d<float, metal::access::sample> depth [[texture(0)]]
, metal::texture2d<float, metal::access::sample> normal [[texture(1)]]
) {
    metal::int2 pixel = naga_f2i32(metal::floor(position.xy));
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(depth.get_width(), depth.get_height()));
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 texel = metal::clamp(pixel, metal::int2(0), last);
    metal::float4 _e15 = depth.read(metal::uint2(texel), 0);
    float z = _e15.x;
    metal::float2 place_middle = static_cast<metal::float2>(static_cast<metal::uint2>(frame)) * metal::float2(0.5);
    metal::float2 value = ((static_cast<metal::float2>(pixel) + metal::float2(0.5)) - place_middle) * (z * 0.005);
    metal::float3 place_from = metal::float3(value.x, value.y, z);
    metal::float4 _e35 = normal.read(metal::uint2(texel), 0);
    metal::float3 place_normal = _e35.xyz;
    float place_reach = metal::min(0.5 / (0.005 * z), 48.0);
    metal::int2 lane = pixel & metal::int2(1);
    bool holds = lane.x != 0;
    bool holds_2_ = lane.y != 0;
    metal::float2 way_k0_ = holds_2_ ? (holds ? metal::float2(0.13309608, 0.17360009) : metal::float2(0.013660241, -0.15565173)) : (holds ? metal::float2(-0.06912833, 0.06332722) : metal::float2(0.03125, 0.0));
    metal::int2 _e72 = to_vec2i(metal::floor((way_k0_ * place_reach) + metal::float2(0.5)));
    metal::int2 tap_k0_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e72));
    metal::int2 texel_k0_ = metal::clamp(tap_k0_, metal::int2(0), last);
    metal::float4 _e79 = depth.read(metal::uint2(texel_k0_), 0);
    float depth_texel = _e79.x;
    metal::float2 value_2_ = ((static_cast<metal::float2>(tap_k0_) + metal::float2(0.5)) - place_middle) * (depth_texel * 0.005);
    metal::float3 to_k0_ = metal::float3(value_2_.x, value_2_.y, depth_texel) - place_from;
    float squared_k0_ = metal::dot(to_k0_, to_k0_);
    float cosine_k0_ = metal::dot(to_k0_, place_normal) * metal::rsqrt(metal::max(squared_k0_, 0.000000000001));
    float near_k0_ = metal::max(1.0 - (squared_k0_ / 0.25), 0.0);
    float own_k0_ = 0.0 + (metal::max(cosine_k0_ - 0.05, 0.0) * near_k0_);
    metal::float2 way_k1_ = holds_2_ ? (holds ? metal::float2(-0.21605052, -0.41599125) : metal::float2(-0.10546385, 0.39232185)) : (holds ? metal::float2(0.29004085, -0.18450032) : metal::float2(-0.2769507, -0.048988573));
    metal::int2 _e132 = to_vec2i(metal::floor((way_k1_ * place_reach) + metal::float2(0.5)));
    metal::int2 tap_k1_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e132));
    metal::int2 texel_k1_ = metal::clamp(tap_k1_, metal::int2(0), last);
    metal::float4 _e139 = depth.read(metal::uint2(texel_k1_), 0);
    float depth_texel_2_ = _e139.x;
    metal::float2 value_3_ = ((static_cast<metal::float2>(tap_k1_) + metal::float2(0.5)) - place_middle) * (depth_texel_2_ * 0.005);
    metal::float3 to_k1_ = metal::float3(value_3_.x, value_3_.y, depth_texel_2_) - place_from;
    float squared_k1_ = metal::dot(to_k1_, to_k1_);
    float cosine_k1_ = metal::dot(to_k1_, place_normal) * metal::rsqrt(metal::max(squared_k1_, 0.000000000001));
    float near_k1_ = metal::max(1.0 - (squared_k1_ / 0.25), 0.0);
    float own_k1_ = own_k0_ + (metal::max(cosine_k1_ - 0.05, 0.0) * near_k1_);
    metal::float2 way_k2_ = holds_2_ ? (holds ? metal::float2(0.21511047, 0.6858054) : metal::float2(0.27814868, -0.5943882)) : (holds ? metal::float2(-0.54883003, 0.22654943) : metal::float2(0.49901456, 0.18223892));
    metal::int2 _e191 = to_vec2i(metal::floor((way_k2_ * place_reach) + metal::float2(0.5)));
    metal::int2 tap_k2_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e191));
    metal::int2 texel_k2_ = metal::clamp(tap_k2_, metal::int2(0), last);
    metal::float4 _e198 = depth.read(metal::uint2(texel_k2_), 0);
    float depth_texel_3_ = _e198.x;
    metal::float2 value_4_ = ((static_cast<metal::float2>(tap_k2_) + metal::float2(0.5)) - place_middle) * (depth_texel_3_ * 0.005);
    metal::float3 to_k2_ = metal::float3(value_4_.x, value_4_.y, depth_texel_3_) - place_from;
    float squared_k2_ = metal::dot(to_k2_, to_k2_);
    float cosine_k2_ = metal::dot(to_k2_, place_normal) * metal::rsqrt(metal::max(squared_k2_, 0.000000000001));
    float near_k2_ = metal::max(1.0 - (squared_k2_ / 0.25), 0.0);
    float own_k2_ = own_k1_ + (metal::max(cosine_k2_ - 0.05, 0.0) * near_k2_);
    metal::float2 way_k3_ = holds_2_ ? (holds ? metal::float2(-0.124496244, -0.960717) : metal::float2(-0.5212098, 0.74136996)) : (holds ? metal::float2(0.82406986, -0.18117106) : metal::float2(-0.675947, -0.3917233));
    metal::int2 _e250 = to_vec2i(metal::floor((way_k3_ * place_reach) + metal::float2(0.5)));
    metal::int2 tap_k3_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e250));
    metal::int2 texel_k3_ = metal::clamp(tap_k3_, metal::int2(0), last);
    metal::float4 _e257 = depth.read(metal::uint2(texel_k3_), 0);
    float depth_texel_4_ = _e257.x;
    metal::float2 value_5_ = ((static_cast<metal::float2>(tap_k3_) + metal::float2(0.5)) - place_middle) * (depth_texel_4_ * 0.005);
    metal::float3 to_k3_ = metal::float3(value_5_.x, value_5_.y, depth_texel_4_) - place_from;
    float squared_k3_ = metal::dot(to_k3_, to_k3_);
    float cosine_k3_ = metal::dot(to_k3_, place_normal) * metal::rsqrt(metal::max(squared_k3_, 0.000000000001));
    float near_k3_ = metal::max(1.0 - (squared_k3_ / 0.25), 0.0);
    float own_k3_ = own_k2_ + (metal::max(cosine_k3_ - 0.05, 0.0) * near_k3_);
    float sum = own_k3_ / 4.0;
    metal::float2 messages_0_ = metal::float2(sum, z);
    metal::float2 unnamed = metal::quad_shuffle_xor(messages_0_, 1u);
    metal::float2 unnamed_1 = metal::quad_shuffle_xor(messages_0_, 2u);
    metal::float2 unnamed_2 = metal::quad_shuffle_xor(messages_0_, 3u);
    float away_k1_ = (unnamed.y - z) / 0.1;
    float weight_k1_ = metal::exp2((away_k1_ * away_k1_) * -0.7213475);
    float sum_k1_ = sum + (unnamed.x * weight_k1_);
    float total_k1_ = 1.0 + weight_k1_;
    float away_k2_ = (unnamed_1.y - z) / 0.1;
    float weight_k2_ = metal::exp2((away_k2_ * away_k2_) * -0.7213475);
    float sum_k2_ = sum_k1_ + (unnamed_1.x * weight_k2_);
    float total_k2_ = total_k1_ + weight_k2_;
    float away_k3_ = (unnamed_2.y - z) / 0.1;
    float weight_k3_ = metal::exp2((away_k3_ * away_k3_) * -0.7213475);
    float sum_k3_ = sum_k2_ + (unnamed_2.x * weight_k3_);
    float total_k3_ = total_k2_ + weight_k3_;
    float occluded = sum_k3_ / total_k3_;
    return quad_ssaoOutput { metal::float4(metal::saturate(1.0 - (occluded * 2.0))) };
}
