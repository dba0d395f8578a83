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
    metal::int2 pixel = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(id.xy)) * as_type<metal::uint2>(metal::int2(2)));
    if (metal::any(pixel >= frame)) {
        return;
    }
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::float4 _e16 = image.read(metal::uint2(pixel), 0);
    metal::float4 own_j0i0l0_ = metal::float4(0.0) + (_e16 * 0.11111111);
    metal::float4 _e29 = image.read(metal::uint2(metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0))), last)), 0);
    metal::float4 own_j0i0l1_ = metal::float4(0.0) + (_e29 * 0.11111111);
    metal::float4 _e42 = image.read(metal::uint2(metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1))), last)), 0);
    metal::float4 own_j0i0l2_ = metal::float4(0.0) + (_e42 * 0.11111111);
    metal::float4 _e54 = image.read(metal::uint2(metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1))), last)), 0);
    metal::float4 own_j0i0l3_ = metal::float4(0.0) + (_e54 * 0.11111111);
    metal::float4 _e69 = image.read(metal::uint2(metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, 0))), metal::int2(0))), 0);
    metal::float4 product = _e69 * 0.11111111;
    metal::float4 _e79 = image.read(metal::uint2(metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, 0))), last)), 0);
    metal::float4 product_2_ = _e79 * 0.11111111;
    metal::float4 _e91 = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, 1))), metal::int2(0), last)), 0);
    metal::float4 product_3_ = _e91 * 0.11111111;
    metal::float4 _e101 = image.read(metal::uint2(metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, 1))), last)), 0);
    metal::float4 product_4_ = _e101 * 0.11111111;
    metal::float4 own_j0i1l0_ = own_j0i0l0_ + product;
    metal::float4 own_j0i1l1_ = own_j0i0l1_ + product_2_;
    metal::float4 own_j0i1l2_ = own_j0i0l2_ + product_3_;
    metal::float4 own_j0i1l3_ = own_j0i0l3_ + product_4_;
    metal::float4 _e117 = image.read(metal::uint2(metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, -1))), metal::int2(0))), 0);
    metal::float4 product_5_ = _e117 * 0.11111111;
    metal::float4 _e129 = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, -1))), metal::int2(0), last)), 0);
    metal::float4 product_6_ = _e129 * 0.11111111;
    metal::float4 _e139 = image.read(metal::uint2(metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 2))), last)), 0);
    metal::float4 product_7_ = _e139 * 0.11111111;
    metal::float4 _e149 = image.read(metal::uint2(metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 2))), last)), 0);
    metal::float4 product_8_ = _e149 * 0.11111111;
    metal::float4 _e160 = image.read(metal::uint2(metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) - as_type<metal::uint2>(metal::int2(1))), metal::int2(0))), 0);
    metal::float4 product_9_ = _e160 * 0.11111111;
    metal::float4 _e172 = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2, -1))), metal::int2(0), last)), 0);
    metal::float4 product_10_ = _e172 * 0.11111111;
    metal::float4 _e184 = image.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(-1, 2))), metal::int2(0), last)), 0);
    metal::float4 product_11_ = _e184 * 0.11111111;
    metal::float4 _e193 = image.read(metal::uint2(metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(2))), last)), 0);
    metal::float4 product_12_ = _e193 * 0.11111111;
    metal::float4 shared_l0_ = ((((own_j0i1l0_ + product_5_) + product_9_) + (own_j0i0l1_ + product_6_)) + own_j0i1l2_) + own_j0i0l3_;
    metal::float4 shared_l1_ = ((((own_j0i1l1_ + product_6_) + product_10_) + (own_j0i0l0_ + product_5_)) + own_j0i1l3_) + own_j0i0l2_;
    metal::float4 shared_l2_ = ((((own_j0i1l2_ + product_7_) + product_11_) + (own_j0i0l3_ + product_8_)) + own_j0i1l0_) + own_j0i0l1_;
    metal::float4 shared_l3_ = ((((own_j0i1l3_ + product_8_) + product_12_) + (own_j0i0l2_ + product_7_)) + own_j0i1l1_) + own_j0i0l0_;
    destination.write(shared_l0_, metal::uint2(pixel));
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0))) < frame)) {
        destination.write(shared_l1_, metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1))) < frame)) {
        destination.write(shared_l2_, metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1))) < frame)) {
        destination.write(shared_l3_, metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1)))));
        return;
    } else {
        return;
    }
}
