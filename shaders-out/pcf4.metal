// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

metal::int2 naga_f2i32(metal::float2 value) {
    return static_cast<metal::int2>(metal::clamp(value, -2147483600.0, 2147483500.0));
}


struct pcfInput {
    metal::float3 coord [[user(loc0), center_perspective]];
};
struct pcfOutput {
    metal::float4 member [[color(0)]];
};
fragment pcfOutput pcf(
  pcfInput varyings [[stage_in]]
, metal::float4 position [[position]]
, metal::depth2d<float, metal::access::sample> shadow [[texture(0)]]
, metal::sampler shadow_sampler [[sampler(1)]]
) {
    const auto coord = varyings.coord;
    metal::int2 pixel = naga_f2i32(metal::floor(position.xy));
    metal::float3 unnamed = metal::quad_shuffle_xor(coord, 1u);
    metal::float3 row = coord + unnamed;
    metal::float3 unnamed_1 = metal::quad_shuffle_xor(row, 2u);
    metal::float3 centre = (row + unnamed_1) * metal::float3(0.25);
    metal::float2 size = static_cast<metal::float2>(static_cast<metal::uint2>(static_cast<metal::int2>(metal::uint2(shadow.get_width(), shadow.get_height()))));
    metal::float2 value = metal::float2(centre.x, centre.y);
    metal::float2 a = metal::fract((value * size) - metal::float2(0.5));
    metal::int2 lane_k0_ = pixel & metal::int2(1);
    metal::float2 quad_vector_k0_ = (static_cast<metal::float2>(lane_k0_) * metal::float2(2.0)) - metal::float2(1.0);
    metal::float2 taps_middle_k0_ = quad_vector_k0_ + metal::float2(0.0);
    metal::float2 column_place_k0_ = (taps_middle_k0_ - a) + metal::float2(0.5);
    float taps_lit_k0_ = shadow.sample_compare(shadow_sampler, value + (column_place_k0_ / size), centre.z);
    metal::float4 sums_k0_ = metal::float4(0.0) + metal::float4(column_place_k0_.x, column_place_k0_.y, 1.0, taps_lit_k0_);
    float unnamed_2 = metal::quad_shuffle_xor(sums_k0_.w, 1u);
    float row_2_ = sums_k0_.w + unnamed_2;
    float unnamed_3 = metal::quad_shuffle_xor(row_2_, 2u);
    float lit = (row_2_ + unnamed_3) * 0.25;
    return pcfOutput { metal::float4(lit) };
}
