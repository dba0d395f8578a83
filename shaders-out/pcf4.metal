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
    metal::float3 centre = (row + unnamed_1) * 0.25;
    metal::float2 size = static_cast<metal::float2>(static_cast<metal::int2>(metal::uint2(shadow.get_width(), shadow.get_height())));
    metal::float2 first_k0_ = (((static_cast<metal::float2>(pixel & metal::int2(1)) * 2.0) - metal::float2(1.0)) + metal::float2(0.0)) - metal::fract((centre.xy * size) - metal::float2(0.5));
    metal::float2 column_place_k0_ = first_k0_ + metal::float2(0.5);
    metal::float2 sum = centre.xy + (column_place_k0_ / size);
    float taps_lit_k0_ = shadow.sample_compare(shadow_sampler, sum, centre.z);
    metal::float4 sums_k0_ = metal::float4(0.0) + metal::float4(column_place_k0_, 1.0, taps_lit_k0_);
    float unnamed_2 = metal::quad_shuffle_xor(sums_k0_.w, 1u);
    float row_2_ = sums_k0_.w + unnamed_2;
    float unnamed_3 = metal::quad_shuffle_xor(row_2_, 2u);
    return pcfOutput { metal::float4((row_2_ + unnamed_3) * 0.25) };
}
