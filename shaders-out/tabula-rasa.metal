// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

struct Parameters {
    float depth_sensibility;
    float normal_sensibility;
    float weight;
};
metal::int2 naga_f2i32(metal::float2 value) {
    return static_cast<metal::int2>(metal::clamp(value, -2147483600.0, 2147483500.0));
}


struct tabula_rasaInput {
};
struct tabula_rasaOutput {
    metal::float4 member [[color(0)]];
};
fragment tabula_rasaOutput tabula_rasa(
  metal::float4 position [[position]]
, metal::texture2d<float, metal::access::sample> depth [[texture(0)]]
, metal::texture2d<float, metal::access::sample> normal [[texture(1)]]
, metal::texture2d<float, metal::access::sample> color [[texture(2)]]
, metal::sampler linear [[sampler(3)]]
, constant Parameters& parameters [[buffer(4)]]
) {
    metal::int2 pixel = naga_f2i32(metal::floor(position.xy));
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(depth.get_width(), depth.get_height()));
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::float4 _e12 = depth.read(metal::uint2(pixel), 0);
    float depth_2_ = _e12.x;
    float here = (metal::abs(depth_2_) < 1000000000000000000000000000000.0) ? depth_2_ : 1000000000000000000000000000000.0;
    metal::float4 _e21 = normal.read(metal::uint2(pixel), 0);
    metal::float3 facing = _e21.xyz;
    metal::int2 at = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) - as_type<metal::uint2>(metal::int2(1))), metal::int2(0));
    metal::float4 _e31 = depth.read(metal::uint2(at), 0);
    float depth_3_ = _e31.x;
    float before = metal::abs(((metal::abs(depth_3_) < 1000000000000000000000000000000.0) ? depth_3_ : 1000000000000000000000000000000.0) - here);
    metal::int2 at_2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1))), metal::int2(0), last);
    metal::float4 _e48 = depth.read(metal::uint2(at_2_), 0);
    float depth_4_ = _e48.x;
    float after = metal::abs(((metal::abs(depth_4_) < 1000000000000000000000000000000.0) ? depth_4_ : 1000000000000000000000000000000.0) - here);
    float _e62 = parameters.depth_sensibility;
    float product = metal::max(metal::min(before, after), 0.00001) * _e62;
    metal::float4 _e66 = normal.read(metal::uint2(at), 0);
    float difference = 1.0 - metal::dot(_e66.xyz, facing);
    float _e73 = parameters.normal_sensibility;
    float turned = ((difference * _e73) < 0.4) ? 0.0 : 1.0;
    metal::float4 _e82 = normal.read(metal::uint2(at_2_), 0);
    float difference_2_ = 1.0 - metal::dot(_e82.xyz, facing);
    float _e89 = parameters.normal_sensibility;
    float turned_2_ = ((difference_2_ * _e89) < 0.4) ? 0.0 : 1.0;
    metal::int2 at_3_ = metal::max(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, -1))), metal::int2(0));
    metal::float4 _e105 = depth.read(metal::uint2(at_3_), 0);
    float depth_5_ = _e105.x;
    float before_2_ = metal::abs(((metal::abs(depth_5_) < 1000000000000000000000000000000.0) ? depth_5_ : 1000000000000000000000000000000.0) - here);
    metal::int2 at_4_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) - as_type<metal::uint2>(metal::int2(0, -1))), metal::int2(0), last);
    metal::float4 _e123 = depth.read(metal::uint2(at_4_), 0);
    float depth_6_ = _e123.x;
    float after_2_ = metal::abs(((metal::abs(depth_6_) < 1000000000000000000000000000000.0) ? depth_6_ : 1000000000000000000000000000000.0) - here);
    float _e137 = parameters.depth_sensibility;
    float product_2_ = metal::max(metal::min(before_2_, after_2_), 0.00001) * _e137;
    metal::float4 _e141 = normal.read(metal::uint2(at_3_), 0);
    float difference_3_ = 1.0 - metal::dot(_e141.xyz, facing);
    float _e148 = parameters.normal_sensibility;
    float turned_3_ = ((difference_3_ * _e148) < 0.4) ? 0.0 : 1.0;
    metal::float4 _e157 = normal.read(metal::uint2(at_4_), 0);
    float difference_4_ = 1.0 - metal::dot(_e157.xyz, facing);
    float _e164 = parameters.normal_sensibility;
    float turned_4_ = ((difference_4_ * _e164) < 0.4) ? 0.0 : 1.0;
    float larger = metal::max((metal::max(before_2_, after_2_) < product_2_) ? 0.0 : 1.0, metal::max(turned_3_, turned_4_));
    float edges = metal::max((metal::max(before, after) < product) ? 0.0 : 1.0, metal::max(turned, turned_2_)) + larger;
    metal::int2 at_5_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, -1))), metal::int2(0), last);
    metal::float4 _e195 = depth.read(metal::uint2(at_5_), 0);
    float depth_7_ = _e195.x;
    float before_3_ = metal::abs(((metal::abs(depth_7_) < 1000000000000000000000000000000.0) ? depth_7_ : 1000000000000000000000000000000.0) - here);
    metal::int2 at_6_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) - as_type<metal::uint2>(metal::int2(1, -1))), metal::int2(0), last);
    metal::float4 _e213 = depth.read(metal::uint2(at_6_), 0);
    float depth_8_ = _e213.x;
    float after_3_ = metal::abs(((metal::abs(depth_8_) < 1000000000000000000000000000000.0) ? depth_8_ : 1000000000000000000000000000000.0) - here);
    float _e227 = parameters.depth_sensibility;
    float product_3_ = metal::max(metal::min(before_3_, after_3_), 0.00001) * _e227;
    metal::float4 _e231 = normal.read(metal::uint2(at_5_), 0);
    float difference_5_ = 1.0 - metal::dot(_e231.xyz, facing);
    float _e238 = parameters.normal_sensibility;
    float turned_5_ = ((difference_5_ * _e238) < 0.4) ? 0.0 : 1.0;
    metal::float4 _e247 = normal.read(metal::uint2(at_6_), 0);
    float difference_6_ = 1.0 - metal::dot(_e247.xyz, facing);
    float _e254 = parameters.normal_sensibility;
    float turned_6_ = ((difference_6_ * _e254) < 0.4) ? 0.0 : 1.0;
    float edges_2_ = edges + metal::max((metal::max(before_3_, after_3_) < product_3_) ? 0.0 : 1.0, metal::max(turned_5_, turned_6_));
    metal::int2 at_7_ = metal::min(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0))), last);
    metal::float4 _e276 = depth.read(metal::uint2(at_7_), 0);
    float depth_9_ = _e276.x;
    float before_4_ = metal::abs(((metal::abs(depth_9_) < 1000000000000000000000000000000.0) ? depth_9_ : 1000000000000000000000000000000.0) - here);
    metal::int2 at_8_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) - as_type<metal::uint2>(metal::int2(1, 0))), metal::int2(0), last);
    metal::float4 _e294 = depth.read(metal::uint2(at_8_), 0);
    float depth_10_ = _e294.x;
    float after_4_ = metal::abs(((metal::abs(depth_10_) < 1000000000000000000000000000000.0) ? depth_10_ : 1000000000000000000000000000000.0) - here);
    float _e308 = parameters.depth_sensibility;
    float product_4_ = metal::max(metal::min(before_4_, after_4_), 0.00001) * _e308;
    metal::float4 _e312 = normal.read(metal::uint2(at_7_), 0);
    float difference_7_ = 1.0 - metal::dot(_e312.xyz, facing);
    float _e319 = parameters.normal_sensibility;
    float turned_7_ = ((difference_7_ * _e319) < 0.4) ? 0.0 : 1.0;
    metal::float4 _e328 = normal.read(metal::uint2(at_8_), 0);
    float difference_8_ = 1.0 - metal::dot(_e328.xyz, facing);
    float _e335 = parameters.normal_sensibility;
    float turned_8_ = ((difference_8_ * _e335) < 0.4) ? 0.0 : 1.0;
    float edges_3_ = edges_2_ + metal::max((metal::max(before_4_, after_4_) < product_4_) ? 0.0 : 1.0, metal::max(turned_7_, turned_8_));
    float _e356 = parameters.weight;
    float reach = metal::min(edges_3_ * 0.25, 1.0) * _e356;
    metal::float4 own = color.read(metal::uint2(pixel), 0);
    bool is_less = metal::all((as_type<metal::uint4>(own) & metal::uint4(2147483647u)) < metal::uint4(2139095040u));
    metal::float4 own_2_ = is_less ? own : metal::float4(0.0);
    metal::float2 offset = metal::float2(-1.0) * reach;
    metal::float2 texel = metal::float2(1.0) / static_cast<metal::float2>(frame);
    metal::float2 sum = static_cast<metal::float2>(pixel) + metal::float2(0.5);
    metal::float4 tap = color.sample(linear, (sum + offset) * texel, metal::level(0.0));
    bool is_less_2_ = metal::all((as_type<metal::uint4>(tap) & metal::uint4(2147483647u)) < metal::uint4(2139095040u));
    metal::float4 tap_2_ = color.sample(linear, (sum + -(offset)) * texel, metal::level(0.0));
    bool is_less_3_ = metal::all((as_type<metal::uint4>(tap_2_) & metal::uint4(2147483647u)) < metal::uint4(2139095040u));
    metal::float4 sum_2_ = ((2.0 * own_2_) + (is_less_2_ ? tap : own_2_)) + (is_less_3_ ? tap_2_ : own_2_);
    metal::float2 offset_2_ = metal::float2(0.0, -1.0) * reach;
    metal::float4 tap_3_ = color.sample(linear, (sum + offset_2_) * texel, metal::level(0.0));
    bool is_less_4_ = metal::all((as_type<metal::uint4>(tap_3_) & metal::uint4(2147483647u)) < metal::uint4(2139095040u));
    metal::float4 tap_4_ = color.sample(linear, (sum + -(offset_2_)) * texel, metal::level(0.0));
    bool is_less_5_ = metal::all((as_type<metal::uint4>(tap_4_) & metal::uint4(2147483647u)) < metal::uint4(2139095040u));
    metal::float4 sum_3_ = (sum_2_ + (is_less_4_ ? tap_3_ : own_2_)) + (is_less_5_ ? tap_4_ : own_2_);
    metal::float2 offset_3_ = metal::float2(1.0, -1.0) * reach;
    metal::float4 tap_5_ = color.sample(linear, (sum + offset_3_) * texel, metal::level(0.0));
    bool is_less_6_ = metal::all((as_type<metal::uint4>(tap_5_) & metal::uint4(2147483647u)) < metal::uint4(2139095040u));
    metal::float4 tap_6_ = color.sample(linear, (sum + -(offset_3_)) * texel, metal::level(0.0));
    bool is_less_7_ = metal::all((as_type<metal::uint4>(tap_6_) & metal::uint4(2147483647u)) < metal::uint4(2139095040u));
    metal::float4 sum_4_ = (sum_3_ + (is_less_6_ ? tap_5_ : own_2_)) + (is_less_7_ ? tap_6_ : own_2_);
    metal::float2 offset_4_ = metal::float2(1.0, 0.0) * reach;
    metal::float4 tap_7_ = color.sample(linear, (sum + offset_4_) * texel, metal::level(0.0));
    bool is_less_8_ = metal::all((as_type<metal::uint4>(tap_7_) & metal::uint4(2147483647u)) < metal::uint4(2139095040u));
    metal::float4 tap_8_ = color.sample(linear, (sum + -(offset_4_)) * texel, metal::level(0.0));
    bool is_less_9_ = metal::all((as_type<metal::uint4>(tap_8_) & metal::uint4(2147483647u)) < metal::uint4(2139095040u));
    metal::float4 tabula_rasa_2_ = ((sum_4_ + (is_less_8_ ? tap_7_ : own_2_)) + (is_less_9_ ? tap_8_ : own_2_)) * 0.1;
    return tabula_rasaOutput { tabula_rasa_2_ };
}
