// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

metal::int2 naga_f2i32(metal::float2 value) {
    return static_cast<metal::int2>(metal::clamp(value, -2147483600.0, 2147483500.0));
}

metal::int2 naga_div(metal::int2 lhs, metal::int2 rhs) {
    return lhs / metal::select(rhs, 1, (lhs == (-2147483647 - 1) & rhs == -1) | (rhs == 0));
}


struct quad_upsamplingInput {
};
struct quad_upsamplingOutput {
    metal::float4 member [[color(0)]];
};
fragment quad_upsamplingOutput quad_upsampling(
  metal::float4 position [[position]]
, metal::texture2d<float, metal::access::sample> low [[texture(0)]]
, metal::texture2d<float, metal::access::sample> depth [[texture(1)]]
) {
    metal::int2 pixel = naga_f2i32(metal::floor(position.xy));
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(depth.get_width(), depth.get_height()));
    metal::float4 _e15 = depth.read(metal::uint2(metal::clamp(pixel, metal::int2(0), as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1))))), 0);
    float depth_2_ = _e15.x;
    float own_depth = (metal::abs(depth_2_) < 1000000000000000000000000000000.0) ? depth_2_ : 1000000000000000000000000000000.0;
    metal::int2 sum = as_type<metal::int2>(as_type<metal::uint2>(naga_div(pixel, metal::int2(2))) + as_type<metal::uint2>(pixel & metal::int2(1)));
    metal::float4 own = low.read(metal::uint2(metal::clamp(sum, metal::int2(0), as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(metal::uint2(low.get_width(), low.get_height()))) - as_type<metal::uint2>(metal::int2(1))))), 0);
    metal::float4 vector = metal::float4(own.xyz, (metal::abs(own.w) < 1000000000000000000000000000000.0) ? own.w : 1000000000000000000000000000000.0);
    metal::float4 counted = metal::all(metal::abs(own.xyz) < metal::float3(300000000000000000000000000000000000000.0)) ? vector : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 unnamed = metal::quad_shuffle_xor(counted, 1u);
    metal::float4 unnamed_1 = metal::quad_shuffle_xor(counted, 2u);
    metal::float4 unnamed_2 = metal::quad_shuffle_xor(counted, 3u);
    metal::float4 taps_k0_ = metal::float4(counted.xyz, 1.0);
    metal::float4 taps_k1_ = metal::float4(unnamed.xyz, 1.0);
    metal::float4 taps_k2_ = metal::float4(unnamed_1.xyz, 1.0);
    metal::float4 taps_k3_ = metal::float4(unnamed_2.xyz, 1.0);
    float away_k0_ = metal::abs(counted.w - own_depth);
    float z_k0_ = away_k0_ / 0.1;
    float away_k1_ = metal::abs(unnamed.w - own_depth);
    float z_k1_ = away_k1_ / 0.1;
    float weight_k1_ = 0.1875 * metal::exp2((z_k1_ * z_k1_) * -0.7213475);
    bool nearer_k1_ = away_k1_ < away_k0_;
    float nearest_k1_ = nearer_k1_ ? away_k1_ : away_k0_;
    float away_k2_ = metal::abs(unnamed_1.w - own_depth);
    float z_k2_ = away_k2_ / 0.1;
    float weight_k2_ = 0.1875 * metal::exp2((z_k2_ * z_k2_) * -0.7213475);
    bool nearer_k2_ = away_k2_ < nearest_k1_;
    metal::float4 fallback_k2_ = nearer_k2_ ? taps_k2_ : (nearer_k1_ ? taps_k1_ : taps_k0_);
    float away_k3_ = metal::abs(unnamed_2.w - own_depth);
    float z_k3_ = away_k3_ / 0.1;
    float weight_k3_ = 0.0625 * metal::exp2((z_k3_ * z_k3_) * -0.7213475);
    float total_k3_ = (((0.5625 * metal::exp2((z_k0_ * z_k0_) * -0.7213475)) + weight_k1_) + weight_k2_) + weight_k3_;
    bool nearer_k3_ = away_k3_ < (nearer_k2_ ? away_k2_ : nearest_k1_);
    metal::float4 fallback_k3_ = nearer_k3_ ? taps_k3_ : fallback_k2_;
    float scale = 1.0 / metal::max(total_k3_, 0.00000000000000000001);
    metal::float4 color_k1_ = taps_k0_ + ((taps_k1_ - taps_k0_) * (weight_k1_ * scale));
    metal::float4 color_k2_ = color_k1_ + ((taps_k2_ - taps_k0_) * (weight_k2_ * scale));
    metal::float4 color_k3_ = color_k2_ + ((taps_k3_ - taps_k0_) * (weight_k3_ * scale));
    return quad_upsamplingOutput { (total_k3_ > 0.00000000000000000001) ? color_k3_ : fallback_k3_ };
}
