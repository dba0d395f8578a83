// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;


struct downsamplingInput {
};
kernel void downsampling(
  metal::uint3 id [[thread_position_in_grid]]
, metal::texture2d<float, metal::access::sample> image [[texture(0)]]
, metal::texture2d<float, metal::access::sample> depth [[texture(1)]]
, metal::texture2d<float, metal::access::write> destination [[texture(2)]]
) {
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(destination.get_width(), destination.get_height()));
    metal::int2 pixel = static_cast<metal::int2>(id.xy);
    if (metal::any(pixel >= frame)) {
        return;
    }
    metal::int2 first = as_type<metal::int2>(as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(pixel) * as_type<uint>(2))) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(metal::uint2(depth.get_width(), depth.get_height()))) - as_type<metal::uint2>(metal::int2(1)));
    metal::float4 _e24 = depth.read(metal::uint2(metal::clamp(first, metal::int2(0), last)), 0);
    float nearest = _e24.x;
    metal::int2 at_j0_i1_ = as_type<metal::int2>(as_type<metal::uint2>(first) + as_type<metal::uint2>(metal::int2(1, 0)));
    metal::float4 _e35 = depth.read(metal::uint2(metal::clamp(at_j0_i1_, metal::int2(0), last)), 0);
    float z_j0_i1_ = _e35.x;
    bool is_less = z_j0_i1_ < nearest;
    float nearest_j0_i1_ = is_less ? z_j0_i1_ : nearest;
    metal::int2 at_j1_i0_ = as_type<metal::int2>(as_type<metal::uint2>(first) + as_type<metal::uint2>(metal::int2(0, 1)));
    metal::float4 _e48 = depth.read(metal::uint2(metal::clamp(at_j1_i0_, metal::int2(0), last)), 0);
    float z_j1_i0_ = _e48.x;
    bool is_less_2_ = z_j1_i0_ < nearest_j0_i1_;
    metal::int2 at_j1_i0_2_ = is_less_2_ ? at_j1_i0_ : (is_less ? at_j0_i1_ : first);
    float nearest_j1_i0_ = is_less_2_ ? z_j1_i0_ : nearest_j0_i1_;
    metal::int2 at_j1_i1_ = as_type<metal::int2>(as_type<metal::uint2>(first) + as_type<metal::uint2>(metal::int2(1)));
    metal::float4 _e62 = depth.read(metal::uint2(metal::clamp(at_j1_i1_, metal::int2(0), last)), 0);
    float z_j1_i1_ = _e62.x;
    bool is_less_3_ = z_j1_i1_ < nearest_j1_i0_;
    float nearest_j1_i1_ = is_less_3_ ? z_j1_i1_ : nearest_j1_i0_;
    metal::int2 last_2_ = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(metal::uint2(image.get_width(), image.get_height()))) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 at = metal::clamp(is_less_3_ ? at_j1_i1_ : at_j1_i0_2_, metal::int2(0), last_2_);
    metal::float4 _e79 = image.read(metal::uint2(at), 0);
    destination.write(metal::float4(_e79.xyz, nearest_j1_i1_), metal::uint2(pixel));
    return;
}
