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
    metal::int2 lane = pixel & metal::int2(1);
    metal::float2 quad_vector = (static_cast<metal::float2>(lane) * metal::float2(2.0)) - metal::float2(1.0);
    metal::float2 taps_middle_k0_ = quad_vector + metal::float2(-2.0);
    metal::float2 value_2_ = taps_middle_k0_ - a;
    metal::float2 away = metal::abs(value_2_);
    metal::float2 x = away * metal::float2(0.375);
    metal::float2 outer = metal::max(metal::float2(1.5) - x, metal::float2(0.0));
    metal::float2 inner = metal::max(metal::float2(0.5) - x, metal::float2(0.0));
    metal::float2 w0_ = ((outer * outer) * metal::float2(0.5)) - ((inner * inner) * metal::float2(1.5));
    metal::float2 away_2_ = metal::abs(value_2_ + metal::float2(1.0));
    metal::float2 x_2_ = away_2_ * metal::float2(0.375);
    metal::float2 outer_2_ = metal::max(metal::float2(1.5) - x_2_, metal::float2(0.0));
    metal::float2 inner_2_ = metal::max(metal::float2(0.5) - x_2_, metal::float2(0.0));
    metal::float2 w1_ = ((outer_2_ * outer_2_) * metal::float2(0.5)) - ((inner_2_ * inner_2_) * metal::float2(1.5));
    metal::float2 weight = w0_ + w1_;
    metal::float2 column_place = value_2_ + (w1_ / weight);
    float taps_lit_k0_ = shadow.sample_compare(shadow_sampler, value + (column_place / size), centre.z);
    float taps_weight_k0_ = weight.x * weight.y;
    metal::float2 taps_middle_k3_ = quad_vector + metal::float2(2.0);
    metal::float2 value_3_ = taps_middle_k3_ - a;
    metal::float2 away_3_ = metal::abs(value_3_);
    metal::float2 x_3_ = away_3_ * metal::float2(0.375);
    metal::float2 outer_3_ = metal::max(metal::float2(1.5) - x_3_, metal::float2(0.0));
    metal::float2 inner_3_ = metal::max(metal::float2(0.5) - x_3_, metal::float2(0.0));
    metal::float2 w0_2_ = ((outer_3_ * outer_3_) * metal::float2(0.5)) - ((inner_3_ * inner_3_) * metal::float2(1.5));
    metal::float2 away_4_ = metal::abs(value_3_ + metal::float2(1.0));
    metal::float2 x_4_ = away_4_ * metal::float2(0.375);
    metal::float2 outer_4_ = metal::max(metal::float2(1.5) - x_4_, metal::float2(0.0));
    metal::float2 inner_4_ = metal::max(metal::float2(0.5) - x_4_, metal::float2(0.0));
    metal::float2 w1_2_ = ((outer_4_ * outer_4_) * metal::float2(0.5)) - ((inner_4_ * inner_4_) * metal::float2(1.5));
    metal::float2 weight_2_ = w0_2_ + w1_2_;
    metal::float2 column_place_2_ = value_3_ + (w1_2_ / weight_2_);
    metal::float2 place_k1_ = metal::float2(column_place_2_.x, column_place.y);
    float taps_lit_k1_ = shadow.sample_compare(shadow_sampler, value + (place_k1_ / size), centre.z);
    metal::float2 taps_middle_k1_ = quad_vector + metal::float2(2.0, -2.0);
    float taps_weight_k1_ = weight_2_.x * weight.y;
    metal::float2 place_k2_ = metal::float2(column_place.x, column_place_2_.y);
    float taps_lit_k2_ = shadow.sample_compare(shadow_sampler, value + (place_k2_ / size), centre.z);
    metal::float2 taps_middle_k2_ = quad_vector + metal::float2(-2.0, 2.0);
    float taps_weight_k2_ = weight.x * weight_2_.y;
    float taps_lit_k3_ = shadow.sample_compare(shadow_sampler, value + (column_place_2_ / size), centre.z);
    float taps_weight_k3_ = weight_2_.x * weight_2_.y;
    metal::float2 away_5_ = (metal::float2(coord.x, coord.y) - value) * size;
    metal::float2 value_4_ = column_place * taps_weight_k0_;
    metal::float4 sums_k0_ = metal::float4(0.0) + metal::float4(value_4_.x, value_4_.y, taps_weight_k0_, taps_lit_k0_ * taps_weight_k0_);
    metal::float2 value_5_ = place_k1_ * taps_weight_k1_;
    metal::float4 sums_k1_ = sums_k0_ + metal::float4(value_5_.x, value_5_.y, taps_weight_k1_, taps_lit_k1_ * taps_weight_k1_);
    metal::float2 value_6_ = place_k2_ * taps_weight_k2_;
    metal::float4 sums_k2_ = sums_k1_ + metal::float4(value_6_.x, value_6_.y, taps_weight_k2_, taps_lit_k2_ * taps_weight_k2_);
    metal::float2 value_7_ = column_place_2_ * taps_weight_k3_;
    metal::float4 sums_k3_ = sums_k2_ + metal::float4(value_7_.x, value_7_.y, taps_weight_k3_, taps_lit_k3_ * taps_weight_k3_);
    metal::float4 unnamed_2 = metal::quad_shuffle_xor(sums_k3_, 1u);
    metal::float4 row_2_ = sums_k3_ + unnamed_2;
    metal::float4 unnamed_3 = metal::quad_shuffle_xor(row_2_, 2u);
    metal::float4 sums = row_2_ + unnamed_3;
    float lit = sums.w / sums.z;
    metal::float2 middle = metal::float2(sums.x, sums.y) / metal::float2(sums.z);
    metal::float2 moment_k0_ = metal::float2(0.0) + (taps_middle_k0_ * taps_lit_k0_);
    metal::float2 moment_k1_ = moment_k0_ + (taps_middle_k1_ * taps_lit_k1_);
    metal::float2 moment_k2_ = moment_k1_ + (taps_middle_k2_ * taps_lit_k2_);
    metal::float2 moment_k3_ = moment_k2_ + (taps_middle_k3_ * taps_lit_k3_);
    metal::float2 unnamed_4 = metal::quad_shuffle_xor(moment_k3_, 1u);
    metal::float2 row_3_ = moment_k3_ + unnamed_4;
    metal::float2 unnamed_5 = metal::quad_shuffle_xor(row_3_, 2u);
    float lit_2_ = metal::saturate(lit + metal::dot((row_3_ + unnamed_5) / metal::float2(80.0), away_5_ - middle));
    return pcfOutput { metal::float4(lit_2_) };
}
