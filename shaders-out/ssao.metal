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
    metal::int2 at = metal::clamp(pixel, metal::int2(0), last);
    metal::float4 _e15 = depth.read(metal::uint2(at), 0);
    float z = _e15.x;
    metal::float2 place_middle = static_cast<metal::float2>(frame) * 0.5;
    metal::float3 place_from = metal::float3(((static_cast<metal::float2>(pixel) + metal::float2(0.5)) - place_middle) * (z * 0.005), z);
    metal::float4 _e31 = normal.read(metal::uint2(at), 0);
    metal::float3 place_normal = _e31.xyz;
    float place_reach = metal::min(0.5 / (0.005 * z), 48.0);
    metal::int2 lane = pixel & metal::int2(1);
    bool differs = lane.x != 0;
    bool differs_2_ = lane.y != 0;
    metal::float2 selection = differs ? metal::float2(-0.06912833, 0.06332722) : metal::float2(0.03125, 0.0);
    metal::float2 selection_2_ = differs ? metal::float2(0.13309608, 0.17360009) : metal::float2(0.013660241, -0.15565173);
    metal::int2 _e68 = to_vec2i(metal::floor(((differs_2_ ? selection_2_ : selection) * place_reach) + metal::float2(0.5)));
    metal::int2 tap_k0_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e68));
    metal::float4 _e75 = depth.read(metal::uint2(metal::clamp(tap_k0_, metal::int2(0), last)), 0);
    float z_k0_ = _e75.x;
    metal::float3 to_k0_ = metal::float3(((static_cast<metal::float2>(tap_k0_) + metal::float2(0.5)) - place_middle) * (z_k0_ * 0.005), z_k0_) - place_from;
    float squared_k0_ = metal::dot(to_k0_, to_k0_);
    float larger = metal::max((metal::dot(to_k0_, place_normal) * metal::rsqrt(metal::max(squared_k0_, 0.000000000001))) - 0.05, 0.0);
    float own_k0_ = 0.0 + (larger * metal::max(1.0 - (squared_k0_ / 0.25), 0.0));
    metal::float2 selection_3_ = differs ? metal::float2(0.29004085, -0.18450032) : metal::float2(-0.2769507, -0.048988573);
    metal::float2 selection_4_ = differs ? metal::float2(-0.21605052, -0.41599125) : metal::float2(-0.10546385, 0.39232185);
    metal::int2 _e126 = to_vec2i(metal::floor(((differs_2_ ? selection_4_ : selection_3_) * place_reach) + metal::float2(0.5)));
    metal::int2 tap_k1_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e126));
    metal::float4 _e133 = depth.read(metal::uint2(metal::clamp(tap_k1_, metal::int2(0), last)), 0);
    float z_k1_ = _e133.x;
    metal::float3 to_k1_ = metal::float3(((static_cast<metal::float2>(tap_k1_) + metal::float2(0.5)) - place_middle) * (z_k1_ * 0.005), z_k1_) - place_from;
    float squared_k1_ = metal::dot(to_k1_, to_k1_);
    float larger_2_ = metal::max((metal::dot(to_k1_, place_normal) * metal::rsqrt(metal::max(squared_k1_, 0.000000000001))) - 0.05, 0.0);
    float own_k1_ = own_k0_ + (larger_2_ * metal::max(1.0 - (squared_k1_ / 0.25), 0.0));
    metal::float2 selection_5_ = differs ? metal::float2(-0.54883003, 0.22654943) : metal::float2(0.49901456, 0.18223892);
    metal::float2 selection_6_ = differs ? metal::float2(0.21511047, 0.6858054) : metal::float2(0.27814868, -0.5943882);
    metal::int2 _e183 = to_vec2i(metal::floor(((differs_2_ ? selection_6_ : selection_5_) * place_reach) + metal::float2(0.5)));
    metal::int2 tap_k2_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e183));
    metal::float4 _e190 = depth.read(metal::uint2(metal::clamp(tap_k2_, metal::int2(0), last)), 0);
    float z_k2_ = _e190.x;
    metal::float3 to_k2_ = metal::float3(((static_cast<metal::float2>(tap_k2_) + metal::float2(0.5)) - place_middle) * (z_k2_ * 0.005), z_k2_) - place_from;
    float squared_k2_ = metal::dot(to_k2_, to_k2_);
    float larger_3_ = metal::max((metal::dot(to_k2_, place_normal) * metal::rsqrt(metal::max(squared_k2_, 0.000000000001))) - 0.05, 0.0);
    float own_k2_ = own_k1_ + (larger_3_ * metal::max(1.0 - (squared_k2_ / 0.25), 0.0));
    metal::float2 selection_7_ = differs ? metal::float2(0.82406986, -0.18117106) : metal::float2(-0.675947, -0.3917233);
    metal::float2 selection_8_ = differs ? metal::float2(-0.124496244, -0.960717) : metal::float2(-0.5212098, 0.74136996);
    metal::int2 _e240 = to_vec2i(metal::floor(((differs_2_ ? selection_8_ : selection_7_) * place_reach) + metal::float2(0.5)));
    metal::int2 tap_k3_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(_e240));
    metal::float4 _e247 = depth.read(metal::uint2(metal::clamp(tap_k3_, metal::int2(0), last)), 0);
    float z_k3_ = _e247.x;
    metal::float3 to_k3_ = metal::float3(((static_cast<metal::float2>(tap_k3_) + metal::float2(0.5)) - place_middle) * (z_k3_ * 0.005), z_k3_) - place_from;
    float squared_k3_ = metal::dot(to_k3_, to_k3_);
    float larger_4_ = metal::max((metal::dot(to_k3_, place_normal) * metal::rsqrt(metal::max(squared_k3_, 0.000000000001))) - 0.05, 0.0);
    float sum = (own_k2_ + (larger_4_ * metal::max(1.0 - (squared_k3_ / 0.25), 0.0))) / 4.0;
    metal::float2 messages_0_ = metal::float2(sum, z);
    metal::float2 unnamed = metal::quad_shuffle_xor(messages_0_, 1u);
    metal::float2 unnamed_1 = metal::quad_shuffle_xor(messages_0_, 2u);
    metal::float2 unnamed_2 = metal::quad_shuffle_xor(messages_0_, 3u);
    float away_k1_ = (unnamed.y - z) / 0.1;
    float weight_k1_ = metal::exp2((away_k1_ * away_k1_) * -0.7213475);
    float away_k2_ = (unnamed_1.y - z) / 0.1;
    float weight_k2_ = metal::exp2((away_k2_ * away_k2_) * -0.7213475);
    float sum_k2_ = (sum + (unnamed.x * weight_k1_)) + (unnamed_1.x * weight_k2_);
    float away_k3_ = (unnamed_2.y - z) / 0.1;
    float weight_k3_ = metal::exp2((away_k3_ * away_k3_) * -0.7213475);
    float occluded = (sum_k2_ + (unnamed_2.x * weight_k3_)) / (((1.0 + weight_k1_) + weight_k2_) + weight_k3_);
    return quad_ssaoOutput { metal::float4(metal::saturate(1.0 - (occluded * 2.0))) };
}
