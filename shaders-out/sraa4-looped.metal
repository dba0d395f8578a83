// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

struct type_5 {
    metal::int2 inner[4];
};
struct type_7 {
    float inner[9];
};
constant type_5 table = type_5 {{metal::int2(-2, -6), metal::int2(6, -2), metal::int2(-6, 2), metal::int2(2, 6)}};
int naga_mod(int lhs, int rhs) {
    int divisor = metal::select(rhs, 1, (lhs == (-2147483647 - 1) & rhs == -1) | (rhs == 0));
    return lhs - (lhs / divisor) * divisor;
}

int naga_div(int lhs, int rhs) {
    return lhs / metal::select(rhs, 1, (lhs == (-2147483647 - 1) & rhs == -1) | (rhs == 0));
}


struct sraaInput {
};
kernel void sraa(
  metal::uint3 id [[thread_position_in_grid]]
, metal::texture2d_array<float, metal::access::sample> depth [[texture(0)]]
, metal::texture2d_array<float, metal::access::sample> normal [[texture(1)]]
, metal::texture2d<float, metal::access::sample> color [[texture(2)]]
, metal::texture2d<float, metal::access::write> destination [[texture(3)]]
) {
    type_7 weights = type_7 {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
    int sample_value = 0;
    type_7 distances = {};
    float nearest = {};
    int tap = {};
    float nearest_2_ = {};
    float d = {};
    bool local = {};
    float sum = {};
    type_7 tap_weights = {};
    int tap_2_ = {};
    float sum_2_ = {};
    int tap_3_ = {};
    metal::float4 result = metal::float4(0.0);
    int tap_4_ = 0;
    metal::float4 result_2_ = {};
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(destination.get_width(), destination.get_height()));
    metal::int2 pixel = static_cast<metal::int2>(id.xy);
    if (metal::any(pixel >= frame)) {
        return;
    }
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    uint2 loop_bound = uint2(4294967295u);
    bool loop_init = true;
    while(true) {
        if (metal::all(loop_bound == uint2(0u))) { break; }
        loop_bound -= uint2(loop_bound.y == 0u, 1u);
        if (!loop_init) {
            int _e263 = sample_value;
            sample_value = as_type<int>(as_type<uint>(_e263) + as_type<uint>(1));
        }
        loop_init = false;
        int _e24 = sample_value;
        if (_e24 < 4) {
        } else {
            break;
        }
        {
            int _e28 = sample_value;
            metal::float4 _e30 = depth.read(metal::uint2(pixel), _e28, 0);
            float depth_texel = _e30.x;
            float centre_depth = metal::min(depth_texel, 1000000000000000000000000000000.0);
            int _e35 = sample_value;
            metal::float4 _e37 = normal.read(metal::uint2(pixel), _e35, 0);
            metal::float3 centre_normal = _e37.xyz;
            int _e40 = sample_value;
            metal::int2 texel = table.inner[_e40];
            metal::float2 value = static_cast<metal::float2>(texel) / metal::float2(16.0);
            int _e46 = sample_value;
            bool holds = _e46 == 4;
            distances = type_7 {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
            nearest = 16.0;
            tap = 0;
            uint2 loop_bound_1 = uint2(4294967295u);
            bool loop_init_1 = true;
            while(true) {
                if (metal::all(loop_bound_1 == uint2(0u))) { break; }
                loop_bound_1 -= uint2(loop_bound_1.y == 0u, 1u);
                if (!loop_init_1) {
                    int _e142 = tap;
                    tap = as_type<int>(as_type<uint>(_e142) + as_type<uint>(1));
                }
                loop_init_1 = false;
                int _e64 = tap;
                if (_e64 < 9) {
                } else {
                    break;
                }
                {
                    int _e67 = tap;
                    int _e72 = tap;
                    metal::int2 texel_2_ = metal::int2(as_type<int>(as_type<uint>(naga_mod(_e67, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e72, 3)) - as_type<uint>(1)));
                    metal::float2 away = metal::abs((static_cast<metal::float2>(texel_2_) + metal::float2(0.0)) - value);
                    float _e84 = nearest;
                    nearest_2_ = _e84;
                    if ((metal::max(1.0 - away.x, 0.0) * metal::max(1.0 - away.y, 0.0)) > 0.0) {
                        d = float {};
                        int _e101 = tap;
                        if (_e101 == 4) {
                            local = holds;
                        } else {
                            local = false;
                        }
                        bool _e107 = local;
                        if (_e107) {
                            d = 0.0;
                        } else {
                            metal::int2 texel_3_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(texel_2_)), metal::int2(0), last);
                            metal::float4 _e116 = depth.read(metal::uint2(texel_3_), 4, 0);
                            float depth_texel_2_ = _e116.x;
                            float shaded_depth = metal::min(depth_texel_2_, 1000000000000000000000000000000.0);
                            metal::float4 _e123 = normal.read(metal::uint2(texel_3_), 4, 0);
                            metal::float3 shaded_normal = _e123.xyz;
                            float depths = metal::abs(centre_depth - shaded_depth);
                            metal::float3 apart = centre_normal - shaded_normal;
                            float larger = metal::max(depths, 0.5 * metal::dot(apart, apart));
                            d = metal::min(larger, 16.0);
                        }
                        int _e134 = tap;
                        float _e136 = d;
                        distances.inner[_e134] = _e136;
                        float _e137 = nearest;
                        float _e138 = d;
                        float nearest_3_ = metal::min(_e137, _e138);
                        nearest_2_ = nearest_3_;
                    }
                    float _e140 = nearest_2_;
                    nearest = _e140;
                }
            }
            sum = 0.0;
            tap_weights = type_7 {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
            tap_2_ = 0;
            uint2 loop_bound_2 = uint2(4294967295u);
            bool loop_init_2 = true;
            while(true) {
                if (metal::all(loop_bound_2 == uint2(0u))) { break; }
                loop_bound_2 -= uint2(loop_bound_2.y == 0u, 1u);
                if (!loop_init_2) {
                    int _e209 = tap_2_;
                    tap_2_ = as_type<int>(as_type<uint>(_e209) + as_type<uint>(1));
                }
                loop_init_2 = false;
                int _e159 = tap_2_;
                if (_e159 < 9) {
                } else {
                    break;
                }
                {
                    int _e162 = tap_2_;
                    int _e167 = tap_2_;
                    metal::float2 value_2_ = (static_cast<metal::float2>(metal::int2(as_type<int>(as_type<uint>(naga_mod(_e162, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e167, 3)) - as_type<uint>(1)))) + metal::float2(0.0)) - value;
                    metal::float2 away_2_ = metal::abs(value_2_);
                    float value_3_ = metal::max(1.0 - away_2_.x, 0.0) * metal::max(1.0 - away_2_.y, 0.0);
                    float _e190 = sum;
                    sum_2_ = _e190;
                    if (value_3_ > 0.0) {
                        int _e194 = tap_2_;
                        float value_4_ = distances.inner[_e194];
                        float _e197 = nearest;
                        float w = value_3_ * metal::exp2(-721.34753 * (value_4_ - _e197));
                        int _e203 = tap_2_;
                        tap_weights.inner[_e203] = w;
                        float _e205 = sum;
                        float sum_3_ = _e205 + w;
                        sum_2_ = sum_3_;
                    }
                    float _e207 = sum_2_;
                    sum = _e207;
                }
            }
            float _e211 = sum;
            float scale = 0.25 / _e211;
            tap_3_ = 0;
            uint2 loop_bound_3 = uint2(4294967295u);
            bool loop_init_3 = true;
            while(true) {
                if (metal::all(loop_bound_3 == uint2(0u))) { break; }
                loop_bound_3 -= uint2(loop_bound_3.y == 0u, 1u);
                if (!loop_init_3) {
                    int _e260 = tap_3_;
                    tap_3_ = as_type<int>(as_type<uint>(_e260) + as_type<uint>(1));
                }
                loop_init_3 = false;
                int _e216 = tap_3_;
                if (_e216 < 9) {
                } else {
                    break;
                }
                {
                    int _e219 = tap_3_;
                    int _e224 = tap_3_;
                    metal::float2 value_5_ = (static_cast<metal::float2>(metal::int2(as_type<int>(as_type<uint>(naga_mod(_e219, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e224, 3)) - as_type<uint>(1)))) + metal::float2(0.0)) - value;
                    metal::float2 away_3_ = metal::abs(value_5_);
                    if ((metal::max(1.0 - away_3_.x, 0.0) * metal::max(1.0 - away_3_.y, 0.0)) > 0.0) {
                        int _e249 = tap_3_;
                        float value_6_ = tap_weights.inner[_e249];
                        int _e252 = tap_3_;
                        float value_7_ = weights.inner[_e252];
                        float weights_2_ = value_7_ + (value_6_ * scale);
                        int _e257 = tap_3_;
                        weights.inner[_e257] = weights_2_;
                    }
                }
            }
        }
    }
    uint2 loop_bound_4 = uint2(4294967295u);
    bool loop_init_4 = true;
    while(true) {
        if (metal::all(loop_bound_4 == uint2(0u))) { break; }
        loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
        if (!loop_init_4) {
            int _e303 = tap_4_;
            tap_4_ = as_type<int>(as_type<uint>(_e303) + as_type<uint>(1));
        }
        loop_init_4 = false;
        int _e270 = tap_4_;
        if (_e270 < 9) {
        } else {
            break;
        }
        {
            int _e273 = tap_4_;
            float value_8_ = weights.inner[_e273];
            metal::float4 _e276 = result;
            result_2_ = _e276;
            if (value_8_ != 0.0) {
                int _e280 = tap_4_;
                int _e285 = tap_4_;
                metal::int2 texel_4_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(as_type<int>(as_type<uint>(naga_mod(_e280, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e285, 3)) - as_type<uint>(1))))), metal::int2(0), last);
                metal::float4 shaded = color.read(metal::uint2(texel_4_), 0);
                metal::float4 _e298 = result;
                metal::float4 result_3_ = _e298 + (value_8_ * shaded);
                result_2_ = result_3_;
            }
            metal::float4 _e301 = result_2_;
            result = _e301;
        }
    }
    metal::float4 _e306 = result;
    destination.write(_e306, metal::uint2(pixel));
    return;
}
