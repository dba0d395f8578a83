// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

metal::int2 naga_f2i32(metal::float2 value) {
    return static_cast<metal::int2>(metal::clamp(value, -2147483600.0, 2147483500.0));
}


struct quad_convolutionInput {
};
struct quad_convolutionOutput {
    metal::float4 member [[color(0)]];
};
fragment quad_convolutionOutput quad_convolution(
  metal::float4 position [[position]]
, metal::texture2d<float, metal::access::sample> image [[texture(0)]]
) {
    metal::int2 pixel = naga_f2i32(metal::floor(position.xy));
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(image.get_width(), image.get_height()));
    metal::int2 outwards = naga_f2i32((static_cast<metal::float2>(pixel & metal::int2(1)) * 2.0) - metal::float2(1.0));
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::float4 _e25 = image.read(metal::uint2(metal::clamp(pixel, metal::int2(0), last)), 0);
    metal::float4 own_j0_i0_ = metal::float4(0.0) + (_e25 * 0.11111111);
    metal::float4 tap_j0_i1_ = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(1, 0))))), metal::int2(0), last)), 0);
    metal::float4 own_j0_i1_ = own_j0_i0_ + (tap_j0_i1_ * 0.11111111);
    metal::float4 tap_j1_i0_ = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(outwards) * as_type<metal::uint2>(metal::int2(0, 1))))), metal::int2(0), last)), 0);
    metal::float4 product = tap_j1_i0_ * 0.11111111;
    metal::float4 _e64 = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(outwards)), metal::int2(0), last)), 0);
    metal::float4 product_2_ = _e64 * 0.11111111;
    metal::float4 unnamed = metal::quad_shuffle_xor(own_j0_i0_ + product, 1u);
    metal::float4 sum = ((own_j0_i1_ + product) + product_2_) + unnamed;
    metal::float4 unnamed_1 = metal::quad_shuffle_xor(own_j0_i1_, 2u);
    metal::float4 unnamed_2 = metal::quad_shuffle_xor(own_j0_i0_, 3u);
    return quad_convolutionOutput { (sum + unnamed_1) + unnamed_2 };
}
