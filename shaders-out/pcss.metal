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

struct pcssInput {
    metal::float3 coord [[user(loc0), center_perspective]];
};
struct pcssOutput {
    metal::float4 member [[color(0)]];
};
fragment pcssOutput pcss(
  pcssInput varyings [[stage_in]]
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
    metal::int2 lane = pixel & metal::int2(1);
    metal::float2 quad_vector = (static_cast<metal::float2>(lane) * metal::float2(2.0)) - metal::float2(1.0);
    metal::float2 value = quad_vector + metal::float2(-2.0);
    metal::float2 value_2_ = metal::float2(centre.x, centre.y);
    metal::int2 shadow_size = static_cast<metal::int2>(metal::uint2(shadow.get_width(), shadow.get_height()));
    metal::float2 value_3_ = static_cast<metal::float2>(static_cast<metal::uint2>(shadow_size));
    metal::float2 value_4_ = value_2_ * value_3_;
    metal::float2 place_k0_ = value_4_ + (value * metal::float2(2.0));
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(shadow_size) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 _e42 = to_vec2i(metal::floor(place_k0_));
    metal::int2 texel_k0_ = metal::clamp(_e42, metal::int2(0), last);
    float depth_k0_ = shadow.read(metal::uint2(texel_k0_), 0);
    bool blocks_k0_ = depth_k0_ < centre.z;
    metal::float2 found_k0_ = metal::float2(0.0) + (blocks_k0_ ? metal::float2(depth_k0_, 1.0) : metal::float2(0.0));
    metal::float2 value_5_ = quad_vector + metal::float2(2.0, -2.0);
    metal::float2 place_k1_ = value_4_ + (value_5_ * metal::float2(2.0));
    metal::int2 _e68 = to_vec2i(metal::floor(place_k1_));
    metal::int2 texel_k1_ = metal::clamp(_e68, metal::int2(0), last);
    float depth_k1_ = shadow.read(metal::uint2(texel_k1_), 0);
    bool blocks_k1_ = depth_k1_ < centre.z;
    metal::float2 found_k1_ = found_k0_ + (blocks_k1_ ? metal::float2(depth_k1_, 1.0) : metal::float2(0.0));
    metal::float2 value_6_ = quad_vector + metal::float2(-2.0, 2.0);
    metal::float2 place_k2_ = value_4_ + (value_6_ * metal::float2(2.0));
    metal::int2 _e92 = to_vec2i(metal::floor(place_k2_));
    metal::int2 texel_k2_ = metal::clamp(_e92, metal::int2(0), last);
    float depth_k2_ = shadow.read(metal::uint2(texel_k2_), 0);
    bool blocks_k2_ = depth_k2_ < centre.z;
    metal::float2 found_k2_ = found_k1_ + (blocks_k2_ ? metal::float2(depth_k2_, 1.0) : metal::float2(0.0));
    metal::float2 value_7_ = quad_vector + metal::float2(2.0);
    metal::float2 place_k3_ = value_4_ + (value_7_ * metal::float2(2.0));
    metal::int2 _e115 = to_vec2i(metal::floor(place_k3_));
    metal::int2 texel_k3_ = metal::clamp(_e115, metal::int2(0), last);
    float depth_k3_ = shadow.read(metal::uint2(texel_k3_), 0);
    bool blocks_k3_ = depth_k3_ < centre.z;
    metal::float2 found_k3_ = found_k2_ + (blocks_k3_ ? metal::float2(depth_k3_, 1.0) : metal::float2(0.0));
    metal::float2 unnamed_2 = metal::quad_shuffle_xor(found_k3_, 1u);
    metal::float2 row_2_ = found_k3_ + unnamed_2;
    metal::float2 unnamed_3 = metal::quad_shuffle_xor(row_2_, 2u);
    metal::float2 value_8_ = row_2_ + unnamed_3;
    float distance_value = centre.z - (value_8_.x / metal::max(value_8_.y, 1.0));
    float width = metal::clamp(distance_value * 400.0, 2.0, 24.0);
    float width_2_ = (value_8_.y > 0.5) ? width : 2.0;
    metal::float2 value_9_ = metal::float2(width_2_ * 0.125);
    metal::float2 place_k0_2_ = (value * (width_2_ * 0.125)) / value_3_;
    float shadow_texel = shadow.sample_compare(shadow_sampler, value_2_ + place_k0_2_, centre.z);
    float sum_k0_ = 0.0 + shadow_texel;
    metal::float2 place_k1_2_ = (value_5_ * (width_2_ * 0.125)) / value_3_;
    float shadow_texel_2_ = shadow.sample_compare(shadow_sampler, value_2_ + place_k1_2_, centre.z);
    float sum_k1_ = sum_k0_ + shadow_texel_2_;
    metal::float2 place_k2_2_ = (value_6_ * (width_2_ * 0.125)) / value_3_;
    float shadow_texel_3_ = shadow.sample_compare(shadow_sampler, value_2_ + place_k2_2_, centre.z);
    float sum_k2_ = sum_k1_ + shadow_texel_3_;
    metal::float2 place_k3_2_ = (value_7_ * (width_2_ * 0.125)) / value_3_;
    float shadow_texel_4_ = shadow.sample_compare(shadow_sampler, value_2_ + place_k3_2_, centre.z);
    float sum_k3_ = sum_k2_ + shadow_texel_4_;
    float unnamed_4 = metal::quad_shuffle_xor(sum_k3_, 1u);
    float row_3_ = sum_k3_ + unnamed_4;
    float unnamed_5 = metal::quad_shuffle_xor(row_3_, 2u);
    float lit = ((row_3_ + unnamed_5) * 0.25) * 0.25;
    return pcssOutput { metal::float4(lit) };
}
