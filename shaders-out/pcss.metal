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
    metal::float3 centre = (row + unnamed_1) * 0.25;
    metal::float2 quad_vector = (static_cast<metal::float2>(pixel & metal::int2(1)) * 2.0) - metal::float2(1.0);
    metal::float2 at_k0_ = quad_vector - metal::float2(2.0);
    metal::int2 shadow_size = static_cast<metal::int2>(metal::uint2(shadow.get_width(), shadow.get_height()));
    metal::float2 as_float = static_cast<metal::float2>(shadow_size);
    metal::float2 product = centre.xy * as_float;
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(shadow_size) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 _e36 = to_vec2i(metal::floor(product + (at_k0_ * 2.0)));
    metal::int2 at_k0_2_ = metal::clamp(_e36, metal::int2(0), last);
    float depth_k0_ = shadow.read(metal::uint2(at_k0_2_), 0);
    metal::float2 found_k0_ = metal::float2(0.0) + ((depth_k0_ < centre.z) ? metal::float2(depth_k0_, 1.0) : metal::float2(0.0));
    metal::float2 at_k1_ = quad_vector + metal::float2(2.0, -2.0);
    metal::int2 _e61 = to_vec2i(metal::floor(product + (at_k1_ * 2.0)));
    metal::int2 at_k1_2_ = metal::clamp(_e61, metal::int2(0), last);
    float depth_k1_ = shadow.read(metal::uint2(at_k1_2_), 0);
    metal::float2 found_k1_ = found_k0_ + ((depth_k1_ < centre.z) ? metal::float2(depth_k1_, 1.0) : metal::float2(0.0));
    metal::float2 at_k2_ = quad_vector + metal::float2(-2.0, 2.0);
    metal::int2 _e84 = to_vec2i(metal::floor(product + (at_k2_ * 2.0)));
    metal::int2 at_k2_2_ = metal::clamp(_e84, metal::int2(0), last);
    float depth_k2_ = shadow.read(metal::uint2(at_k2_2_), 0);
    metal::float2 found_k2_ = found_k1_ + ((depth_k2_ < centre.z) ? metal::float2(depth_k2_, 1.0) : metal::float2(0.0));
    metal::float2 at_k3_ = quad_vector + metal::float2(2.0);
    metal::int2 _e106 = to_vec2i(metal::floor(product + (at_k3_ * 2.0)));
    metal::int2 at_k3_2_ = metal::clamp(_e106, metal::int2(0), last);
    float depth_k3_ = shadow.read(metal::uint2(at_k3_2_), 0);
    metal::float2 found_k3_ = found_k2_ + ((depth_k3_ < centre.z) ? metal::float2(depth_k3_, 1.0) : metal::float2(0.0));
    metal::float2 unnamed_2 = metal::quad_shuffle_xor(found_k3_, 1u);
    metal::float2 row_2_ = found_k3_ + unnamed_2;
    metal::float2 unnamed_3 = metal::quad_shuffle_xor(row_2_, 2u);
    metal::float2 found = row_2_ + unnamed_3;
    float width = metal::clamp((centre.z - (found.x / metal::max(found.y, 1.0))) * 400.0, 2.0, 24.0);
    float product_2_ = ((found.y > 0.5) ? width : 2.0) * 0.125;
    metal::float2 sum = centre.xy + ((at_k0_ * product_2_) / as_float);
    float _e151 = shadow.sample_compare(shadow_sampler, sum, centre.z);
    float sum_k0_ = 0.0 + _e151;
    metal::float2 sum_2_ = centre.xy + ((at_k1_ * product_2_) / as_float);
    float _e161 = shadow.sample_compare(shadow_sampler, sum_2_, centre.z);
    float sum_k1_ = sum_k0_ + _e161;
    metal::float2 sum_3_ = centre.xy + ((at_k2_ * product_2_) / as_float);
    float _e170 = shadow.sample_compare(shadow_sampler, sum_3_, centre.z);
    float sum_k2_ = sum_k1_ + _e170;
    metal::float2 sum_4_ = centre.xy + ((at_k3_ * product_2_) / as_float);
    float _e179 = shadow.sample_compare(shadow_sampler, sum_4_, centre.z);
    float sum_k3_ = sum_k2_ + _e179;
    float unnamed_4 = metal::quad_shuffle_xor(sum_k3_, 1u);
    float row_3_ = sum_k3_ + unnamed_4;
    float unnamed_5 = metal::quad_shuffle_xor(row_3_, 2u);
    return pcssOutput { metal::float4(((row_3_ + unnamed_5) * 0.25) * 0.25) };
}
