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
    metal::float2 a = metal::fract((centre.xy * size) - metal::float2(0.5));
    metal::float2 quad_vector = (static_cast<metal::float2>(pixel & metal::int2(1)) * 2.0) - metal::float2(1.0);
    metal::float2 taps_middle_k0_ = quad_vector - metal::float2(2.0);
    metal::float2 first_k0_ = taps_middle_k0_ - a;
    metal::float2 x = metal::abs(first_k0_) * 0.375;
    metal::float2 outer = metal::max(metal::float2(1.5) - x, metal::float2(0.0));
    metal::float2 inner = metal::max(metal::float2(0.5) - x, metal::float2(0.0));
    metal::float2 x_2_ = metal::abs(first_k0_ + metal::float2(1.0)) * 0.375;
    metal::float2 outer_2_ = metal::max(metal::float2(1.5) - x_2_, metal::float2(0.0));
    metal::float2 inner_2_ = metal::max(metal::float2(0.5) - x_2_, metal::float2(0.0));
    metal::float2 w1_ = ((outer_2_ * outer_2_) * 0.5) - ((inner_2_ * inner_2_) * 1.5);
    metal::float2 weight = (((outer * outer) * 0.5) - ((inner * inner) * 1.5)) + w1_;
    metal::float2 column_place = first_k0_ + (w1_ / weight);
    metal::float2 sum = centre.xy + (column_place / size);
    float taps_lit_k0_ = shadow.sample_compare(shadow_sampler, sum, centre.z);
    float taps_weight_k0_ = weight.x * weight.y;
    metal::float2 taps_middle_k3_ = quad_vector + metal::float2(2.0);
    metal::float2 first_k1_ = taps_middle_k3_ - a;
    metal::float2 x_3_ = metal::abs(first_k1_) * 0.375;
    metal::float2 outer_3_ = metal::max(metal::float2(1.5) - x_3_, metal::float2(0.0));
    metal::float2 inner_3_ = metal::max(metal::float2(0.5) - x_3_, metal::float2(0.0));
    metal::float2 x_4_ = metal::abs(first_k1_ + metal::float2(1.0)) * 0.375;
    metal::float2 outer_4_ = metal::max(metal::float2(1.5) - x_4_, metal::float2(0.0));
    metal::float2 inner_4_ = metal::max(metal::float2(0.5) - x_4_, metal::float2(0.0));
    metal::float2 w1_2_ = ((outer_4_ * outer_4_) * 0.5) - ((inner_4_ * inner_4_) * 1.5);
    metal::float2 weight_2_ = (((outer_3_ * outer_3_) * 0.5) - ((inner_3_ * inner_3_) * 1.5)) + w1_2_;
    metal::float2 column_place_2_ = first_k1_ + (w1_2_ / weight_2_);
    metal::float2 place_k1_ = metal::float2(column_place_2_.x, column_place.y);
    metal::float2 sum_2_ = centre.xy + (place_k1_ / size);
    float taps_lit_k1_ = shadow.sample_compare(shadow_sampler, sum_2_, centre.z);
    float taps_weight_k1_ = weight_2_.x * weight.y;
    metal::float2 place_k2_ = metal::float2(column_place.x, column_place_2_.y);
    metal::float2 sum_3_ = centre.xy + (place_k2_ / size);
    float taps_lit_k2_ = shadow.sample_compare(shadow_sampler, sum_3_, centre.z);
    float taps_weight_k2_ = weight.x * weight_2_.y;
    metal::float2 sum_4_ = centre.xy + (column_place_2_ / size);
    float taps_lit_k3_ = shadow.sample_compare(shadow_sampler, sum_4_, centre.z);
    float taps_weight_k3_ = weight_2_.x * weight_2_.y;
    metal::float4 vector = metal::float4(column_place * taps_weight_k0_, taps_weight_k0_, taps_lit_k0_ * taps_weight_k0_);
    metal::float4 vector_2_ = metal::float4(place_k1_ * taps_weight_k1_, taps_weight_k1_, taps_lit_k1_ * taps_weight_k1_);
    metal::float4 vector_3_ = metal::float4(place_k2_ * taps_weight_k2_, taps_weight_k2_, taps_lit_k2_ * taps_weight_k2_);
    metal::float4 vector_4_ = metal::float4(column_place_2_ * taps_weight_k3_, taps_weight_k3_, taps_lit_k3_ * taps_weight_k3_);
    metal::float4 sums_k3_ = (((metal::float4(0.0) + vector) + vector_2_) + vector_3_) + vector_4_;
    metal::float4 unnamed_2 = metal::quad_shuffle_xor(sums_k3_, 1u);
    metal::float4 row_2_ = sums_k3_ + unnamed_2;
    metal::float4 unnamed_3 = metal::quad_shuffle_xor(row_2_, 2u);
    metal::float4 sums = row_2_ + unnamed_3;
    metal::float2 product = (quad_vector + metal::float2(2.0, -2.0)) * taps_lit_k1_;
    metal::float2 product_2_ = (quad_vector + metal::float2(-2.0, 2.0)) * taps_lit_k2_;
    metal::float2 moment_k2_ = ((metal::float2(0.0) + (taps_middle_k0_ * taps_lit_k0_)) + product) + product_2_;
    metal::float2 moment_k3_ = moment_k2_ + (taps_middle_k3_ * taps_lit_k3_);
    metal::float2 unnamed_4 = metal::quad_shuffle_xor(moment_k3_, 1u);
    metal::float2 row_3_ = moment_k3_ + unnamed_4;
    metal::float2 difference = ((coord.xy - centre.xy) * size) - (sums.xy / metal::float2(sums.z));
    metal::float2 unnamed_5 = metal::quad_shuffle_xor(row_3_, 2u);
    float lit = metal::saturate((sums.w / sums.z) + metal::dot((row_3_ + unnamed_5) / metal::float2(80.0), difference));
    return pcfOutput { metal::float4(lit) };
}
