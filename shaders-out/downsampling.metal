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
    metal::int2 first = as_type<metal::int2>(as_type<metal::uint2>(as_type<metal::int2>(as_type<metal::uint2>(pixel) * as_type<metal::uint2>(metal::int2(2)))) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(metal::uint2(depth.get_width(), depth.get_height()))) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 texel = metal::clamp(first, metal::int2(0), last);
    metal::float4 _e25 = depth.read(metal::uint2(texel), 0);
    float nearest = _e25.x;
    metal::int2 at_j0_i1_ = as_type<metal::int2>(as_type<metal::uint2>(first) + as_type<metal::uint2>(metal::int2(1, 0)));
    metal::int2 texel_j0_i1_ = metal::clamp(at_j0_i1_, metal::int2(0), last);
    metal::float4 _e36 = depth.read(metal::uint2(texel_j0_i1_), 0);
    float z_j0_i1_ = _e36.x;
    bool holds = z_j0_i1_ < nearest;
    metal::int2 at_j0_i1_2_ = holds ? at_j0_i1_ : first;
    float nearest_j0_i1_ = holds ? z_j0_i1_ : nearest;
    metal::int2 at_j1_i0_ = as_type<metal::int2>(as_type<metal::uint2>(first) + as_type<metal::uint2>(metal::int2(0, 1)));
    metal::int2 texel_j1_i0_ = metal::clamp(at_j1_i0_, metal::int2(0), last);
    metal::float4 _e50 = depth.read(metal::uint2(texel_j1_i0_), 0);
    float z_j1_i0_ = _e50.x;
    bool holds_2_ = z_j1_i0_ < nearest_j0_i1_;
    metal::int2 at_j1_i0_2_ = holds_2_ ? at_j1_i0_ : at_j0_i1_2_;
    float nearest_j1_i0_ = holds_2_ ? z_j1_i0_ : nearest_j0_i1_;
    metal::int2 at_j1_i1_ = as_type<metal::int2>(as_type<metal::uint2>(first) + as_type<metal::uint2>(metal::int2(1)));
    metal::int2 texel_j1_i1_ = metal::clamp(at_j1_i1_, metal::int2(0), last);
    metal::float4 _e63 = depth.read(metal::uint2(texel_j1_i1_), 0);
    float z_j1_i1_ = _e63.x;
    bool holds_3_ = z_j1_i1_ < nearest_j1_i0_;
    metal::int2 at_j1_i1_2_ = holds_3_ ? at_j1_i1_ : at_j1_i0_2_;
    float nearest_j1_i1_ = holds_3_ ? z_j1_i1_ : nearest_j1_i0_;
    metal::int2 last_2_ = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(metal::uint2(image.get_width(), image.get_height()))) - as_type<metal::uint2>(metal::int2(1)));
    metal::int2 texel_2_ = metal::clamp(at_j1_i1_2_, metal::int2(0), last_2_);
    metal::float4 _e79 = image.read(metal::uint2(texel_2_), 0);
    metal::float3 image_texel = _e79.xyz;
    destination.write(metal::float4(image_texel.x, image_texel.y, image_texel.z, nearest_j1_i1_), metal::uint2(pixel));
    return;
}
