// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;


struct quad_convolutionInput {
};
kernel void quad_convolution(
  metal::uint3 id [[thread_position_in_grid]]
, metal::texture2d<float, metal::access::sample> image [[texture(0)]]
, metal::texture2d<float, metal::access::write> destination [[texture(1)]]
) {
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(destination.get_width(), destination.get_height()));
    metal::int2 pixel = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(id.xy)) * as_type<metal::uint2>(metal::int2(2, 2)));
    if (metal::any(pixel >= frame)) {
        return;
    }
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 texel_j0_i0_l1_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0))), last);
    metal::int2 texel_j0_i0_l2_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1))), last);
    metal::int2 texel_j0_i0_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1))), last);
    metal::float4 tap_j0_i0_l0_ = image.read(metal::uint2(pixel), 0);
    metal::float4 tap_j0_i0_l1_ = image.read(metal::uint2(texel_j0_i0_l1_), 0);
    metal::float4 tap_j0_i0_l2_ = image.read(metal::uint2(texel_j0_i0_l2_), 0);
    metal::float4 tap_j0_i0_l3_ = image.read(metal::uint2(texel_j0_i0_l3_), 0);
    metal::float4 own_j0_i0_l0_ = metal::float4(0.0) + (tap_j0_i0_l0_ * metal::float4(0.11111111));
    metal::float4 own_j0_i0_l1_ = metal::float4(0.0) + (tap_j0_i0_l1_ * metal::float4(0.11111111));
    metal::float4 own_j0_i0_l2_ = metal::float4(0.0) + (tap_j0_i0_l2_ * metal::float4(0.11111111));
    metal::float4 own_j0_i0_l3_ = metal::float4(0.0) + (tap_j0_i0_l3_ * metal::float4(0.11111111));
    metal::int2 texel_j0_i1_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, 0))), metal::int2(0));
    metal::int2 texel_j0_i1_l1_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, 0))), last);
    metal::int2 texel_j0_i1_l2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, 1))), metal::int2(0), last);
    metal::int2 texel_j0_i1_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, 1))), last);
    metal::float4 tap_j0_i1_l0_ = image.read(metal::uint2(texel_j0_i1_l0_), 0);
    metal::float4 tap_j0_i1_l1_ = image.read(metal::uint2(texel_j0_i1_l1_), 0);
    metal::float4 tap_j0_i1_l2_ = image.read(metal::uint2(texel_j0_i1_l2_), 0);
    metal::float4 tap_j0_i1_l3_ = image.read(metal::uint2(texel_j0_i1_l3_), 0);
    metal::float4 own_j0_i1_l0_ = own_j0_i0_l0_ + (tap_j0_i1_l0_ * metal::float4(0.11111111));
    metal::float4 own_j0_i1_l1_ = own_j0_i0_l1_ + (tap_j0_i1_l1_ * metal::float4(0.11111111));
    metal::float4 own_j0_i1_l2_ = own_j0_i0_l2_ + (tap_j0_i1_l2_ * metal::float4(0.11111111));
    metal::float4 own_j0_i1_l3_ = own_j0_i0_l3_ + (tap_j0_i1_l3_ * metal::float4(0.11111111));
    metal::int2 texel_j1_i0_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, -1))), metal::int2(0));
    metal::int2 texel_j1_i0_l1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, -1))), metal::int2(0), last);
    metal::int2 texel_j1_i0_l2_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 2))), last);
    metal::int2 texel_j1_i0_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 2))), last);
    metal::float4 tap_j1_i0_l0_ = image.read(metal::uint2(texel_j1_i0_l0_), 0);
    metal::float4 tap_j1_i0_l1_ = image.read(metal::uint2(texel_j1_i0_l1_), 0);
    metal::float4 tap_j1_i0_l2_ = image.read(metal::uint2(texel_j1_i0_l2_), 0);
    metal::float4 tap_j1_i0_l3_ = image.read(metal::uint2(texel_j1_i0_l3_), 0);
    metal::float4 value = tap_j1_i0_l0_ * metal::float4(0.11111111);
    metal::float4 value_2_ = tap_j1_i0_l1_ * metal::float4(0.11111111);
    metal::float4 value_3_ = tap_j1_i0_l2_ * metal::float4(0.11111111);
    metal::float4 value_4_ = tap_j1_i0_l3_ * metal::float4(0.11111111);
    metal::float4 own_j1_i0_l0_ = own_j0_i1_l0_ + value;
    metal::float4 own_j1_i0_l1_ = own_j0_i1_l1_ + value_2_;
    metal::float4 own_j1_i0_l2_ = own_j0_i1_l2_ + value_3_;
    metal::float4 own_j1_i0_l3_ = own_j0_i1_l3_ + value_4_;
    metal::float4 beside_j1_i0_l0_ = own_j0_i0_l0_ + value;
    metal::float4 beside_j1_i0_l1_ = own_j0_i0_l1_ + value_2_;
    metal::float4 beside_j1_i0_l2_ = own_j0_i0_l2_ + value_3_;
    metal::float4 beside_j1_i0_l3_ = own_j0_i0_l3_ + value_4_;
    metal::int2 texel_j1_i1_l0_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1))), metal::int2(0));
    metal::int2 texel_j1_i1_l1_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, -1))), metal::int2(0), last);
    metal::int2 texel_j1_i1_l2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, 2))), metal::int2(0), last);
    metal::int2 texel_j1_i1_l3_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2))), last);
    metal::float4 tap_j1_i1_l0_ = image.read(metal::uint2(texel_j1_i1_l0_), 0);
    metal::float4 tap_j1_i1_l1_ = image.read(metal::uint2(texel_j1_i1_l1_), 0);
    metal::float4 tap_j1_i1_l2_ = image.read(metal::uint2(texel_j1_i1_l2_), 0);
    metal::float4 tap_j1_i1_l3_ = image.read(metal::uint2(texel_j1_i1_l3_), 0);
    metal::float4 own_j1_i1_l0_ = own_j1_i0_l0_ + (tap_j1_i1_l0_ * metal::float4(0.11111111));
    metal::float4 own_j1_i1_l1_ = own_j1_i0_l1_ + (tap_j1_i1_l1_ * metal::float4(0.11111111));
    metal::float4 own_j1_i1_l2_ = own_j1_i0_l2_ + (tap_j1_i1_l2_ * metal::float4(0.11111111));
    metal::float4 own_j1_i1_l3_ = own_j1_i0_l3_ + (tap_j1_i1_l3_ * metal::float4(0.11111111));
    destination.write(((own_j1_i1_l0_ + beside_j1_i0_l1_) + own_j0_i1_l2_) + own_j0_i0_l3_, metal::uint2(pixel));
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0))) < frame)) {
        destination.write(((own_j1_i1_l1_ + beside_j1_i0_l0_) + own_j0_i1_l3_) + own_j0_i0_l2_, metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1))) < frame)) {
        destination.write(((own_j1_i1_l2_ + beside_j1_i0_l3_) + own_j0_i1_l0_) + own_j0_i0_l1_, metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 1))) < frame)) {
        destination.write(((own_j1_i1_l3_ + beside_j1_i0_l2_) + own_j0_i1_l1_) + own_j0_i0_l0_, metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 1)))));
        return;
    } else {
        return;
    }
}
