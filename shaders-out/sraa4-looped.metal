// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

struct type_5 {
    metal::int2 inner[4];
};
struct type_8 {
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
    float total = 0.0;
    int sample_value = 0;
    type_8 weights = type_8 {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
    int sample_2_ = 0;
    type_8 distances = {};
    float nearest = {};
    int tap = {};
    float nearest_2_ = {};
    float d = {};
    bool local = {};
    bool local_1 = {};
    float sum = {};
    type_8 tap_weights = {};
    int tap_2_ = {};
    float sum_2_ = {};
    int tap_3_ = {};
    metal::float4 result = metal::float4(0.0);
    float sum_4_ = 0.0;
    int tap_4_ = 0;
    float w_2_ = {};
    metal::float4 result_2_ = {};
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(destination.get_width(), destination.get_height()));
    metal::int2 pixel = static_cast<metal::int2>(id.xy);
    if (metal::any(pixel >= frame)) {
        return;
    }
    uint2 loop_bound = uint2(4294967295u);
    bool loop_init = true;
    while(true) {
        if (metal::all(loop_bound == uint2(0u))) { break; }
        loop_bound -= uint2(loop_bound.y == 0u, 1u);
        if (!loop_init) {
            int _e19 = sample_value;
            sample_value = as_type<int>(as_type<uint>(_e19) + as_type<uint>(1));
        }
        loop_init = false;
        int _e12 = sample_value;
        if (_e12 < 4) {
        } else {
            break;
        }
        {
            float _e15 = total;
            float total_2_ = _e15 + 1.0;
            total = total_2_;
        }
    }
    float _e21 = total;
    float share = 1.0 / _e21;
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    uint2 loop_bound_1 = uint2(4294967295u);
    bool loop_init_1 = true;
    while(true) {
        if (metal::all(loop_bound_1 == uint2(0u))) { break; }
        loop_bound_1 -= uint2(loop_bound_1.y == 0u, 1u);
        if (!loop_init_1) {
            int _e281 = sample_2_;
            sample_2_ = as_type<int>(as_type<uint>(_e281) + as_type<uint>(1));
        }
        loop_init_1 = false;
        int _e40 = sample_2_;
        if (_e40 < 4) {
        } else {
            break;
        }
        {
            int _e44 = sample_2_;
            metal::int2 texel = table.inner[_e44];
            metal::float2 place_at = metal::float2(0.0) + (static_cast<metal::float2>(texel) / metal::float2(16.0));
            int _e54 = sample_2_;
            metal::float4 _e56 = depth.read(metal::uint2(pixel), _e54, 0);
            float depth_2_ = _e56.x;
            float seen_depth = metal::min(depth_2_, 1000000000000000000000000000000.0);
            int _e61 = sample_2_;
            metal::float4 _e63 = normal.read(metal::uint2(pixel), _e61, 0);
            metal::float3 seen_normal = _e63.xyz;
            int _e65 = sample_2_;
            bool holds = _e65 == 4;
            distances = type_8 {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
            nearest = 16.0;
            tap = 0;
            uint2 loop_bound_2 = uint2(4294967295u);
            bool loop_init_2 = true;
            while(true) {
                if (metal::all(loop_bound_2 == uint2(0u))) { break; }
                loop_bound_2 -= uint2(loop_bound_2.y == 0u, 1u);
                if (!loop_init_2) {
                    int _e165 = tap;
                    tap = as_type<int>(as_type<uint>(_e165) + as_type<uint>(1));
                }
                loop_init_2 = false;
                int _e83 = tap;
                if (_e83 < 9) {
                } else {
                    break;
                }
                {
                    int _e86 = tap;
                    int _e91 = tap;
                    metal::int2 pixel_2_ = metal::int2(as_type<int>(as_type<uint>(naga_mod(_e86, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e91, 3)) - as_type<uint>(1)));
                    metal::float2 away = static_cast<metal::float2>(pixel_2_) - place_at;
                    bool holds_2_ = (metal::max(1.0 - metal::abs(away.x), 0.0) * metal::max(1.0 - metal::abs(away.y), 0.0)) > 0.0;
                    float _e114 = nearest;
                    nearest_2_ = _e114;
                    if (holds_2_) {
                        metal::bool2 holds_3_ = metal::int2(0) == pixel_2_;
                        d = float {};
                        if (holds) {
                            if (holds_3_.x) {
                                local_1 = holds_3_.y;
                            } else {
                                local_1 = false;
                            }
                            bool _e128 = local_1;
                            local = _e128;
                        } else {
                            local = false;
                        }
                        bool _e130 = local;
                        if (_e130) {
                            d = 0.0;
                        } else {
                            metal::int2 texel_2_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(pixel_2_));
                            metal::int2 texel_3_ = metal::clamp(texel_2_, metal::int2(0), last);
                            metal::float4 _e139 = depth.read(metal::uint2(texel_3_), 4, 0);
                            float depth_3_ = _e139.x;
                            float shaded_depth = metal::min(depth_3_, 1000000000000000000000000000000.0);
                            metal::float4 _e146 = normal.read(metal::uint2(texel_3_), 4, 0);
                            metal::float3 shaded_normal = _e146.xyz;
                            float step_value = metal::abs(seen_depth - shaded_depth);
                            metal::float3 turn = seen_normal - shaded_normal;
                            float larger = metal::max(step_value, 0.5 * metal::dot(turn, turn));
                            d = metal::min(larger, 16.0);
                        }
                        int _e157 = tap;
                        float _e159 = d;
                        distances.inner[_e157] = _e159;
                        float _e160 = nearest;
                        float _e161 = d;
                        float nearest_3_ = metal::min(_e160, _e161);
                        nearest_2_ = nearest_3_;
                    }
                    float _e163 = nearest_2_;
                    nearest = _e163;
                }
            }
            sum = 0.0;
            tap_weights = type_8 {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
            tap_2_ = 0;
            uint2 loop_bound_3 = uint2(4294967295u);
            bool loop_init_3 = true;
            while(true) {
                if (metal::all(loop_bound_3 == uint2(0u))) { break; }
                loop_bound_3 -= uint2(loop_bound_3.y == 0u, 1u);
                if (!loop_init_3) {
                    int _e230 = tap_2_;
                    tap_2_ = as_type<int>(as_type<uint>(_e230) + as_type<uint>(1));
                }
                loop_init_3 = false;
                int _e182 = tap_2_;
                if (_e182 < 9) {
                } else {
                    break;
                }
                {
                    int _e185 = tap_2_;
                    int _e190 = tap_2_;
                    metal::int2 pixel_3_ = metal::int2(as_type<int>(as_type<uint>(naga_mod(_e185, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e190, 3)) - as_type<uint>(1)));
                    metal::float2 away_2_ = static_cast<metal::float2>(pixel_3_) - place_at;
                    float value = metal::max(1.0 - metal::abs(away_2_.x), 0.0) * metal::max(1.0 - metal::abs(away_2_.y), 0.0);
                    float _e211 = sum;
                    sum_2_ = _e211;
                    if (value > 0.0) {
                        int _e215 = tap_2_;
                        float value_2_ = distances.inner[_e215];
                        float _e218 = nearest;
                        float nearness = metal::exp2(-721.34753 * (value_2_ - _e218));
                        float w = value * nearness;
                        int _e224 = tap_2_;
                        tap_weights.inner[_e224] = w;
                        float _e226 = sum;
                        float sum_3_ = _e226 + w;
                        sum_2_ = sum_3_;
                    }
                    float _e228 = sum_2_;
                    sum = _e228;
                }
            }
            float _e232 = sum;
            float scale = share / _e232;
            tap_3_ = 0;
            uint2 loop_bound_4 = uint2(4294967295u);
            bool loop_init_4 = true;
            while(true) {
                if (metal::all(loop_bound_4 == uint2(0u))) { break; }
                loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
                if (!loop_init_4) {
                    int _e278 = tap_3_;
                    tap_3_ = as_type<int>(as_type<uint>(_e278) + as_type<uint>(1));
                }
                loop_init_4 = false;
                int _e236 = tap_3_;
                if (_e236 < 9) {
                } else {
                    break;
                }
                {
                    int _e239 = tap_3_;
                    int _e244 = tap_3_;
                    metal::int2 pixel_4_ = metal::int2(as_type<int>(as_type<uint>(naga_mod(_e239, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e244, 3)) - as_type<uint>(1)));
                    metal::float2 away_3_ = static_cast<metal::float2>(pixel_4_) - place_at;
                    bool holds_4_ = (metal::max(1.0 - metal::abs(away_3_.x), 0.0) * metal::max(1.0 - metal::abs(away_3_.y), 0.0)) > 0.0;
                    if (holds_4_) {
                        int _e267 = tap_3_;
                        float value_3_ = tap_weights.inner[_e267];
                        int _e270 = tap_3_;
                        float value_4_ = weights.inner[_e270];
                        float weights_2_ = value_4_ + (value_3_ * scale);
                        int _e275 = tap_3_;
                        weights.inner[_e275] = weights_2_;
                    }
                }
            }
        }
    }
    uint2 loop_bound_5 = uint2(4294967295u);
    bool loop_init_5 = true;
    while(true) {
        if (metal::all(loop_bound_5 == uint2(0u))) { break; }
        loop_bound_5 -= uint2(loop_bound_5.y == 0u, 1u);
        if (!loop_init_5) {
            int _e343 = tap_4_;
            tap_4_ = as_type<int>(as_type<uint>(_e343) + as_type<uint>(1));
        }
        loop_init_5 = false;
        int _e290 = tap_4_;
        if (_e290 < 9) {
        } else {
            break;
        }
        {
            int _e293 = tap_4_;
            int _e298 = tap_4_;
            metal::int2 pixel_5_ = metal::int2(as_type<int>(as_type<uint>(naga_mod(_e293, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e298, 3)) - as_type<uint>(1)));
            metal::int2 pixel_6_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(pixel_5_));
            metal::int2 texel_4_ = metal::clamp(pixel_6_, metal::int2(0), last);
            metal::float4 shaded = color.read(metal::uint2(texel_4_), 0);
            metal::uint4 value_5_ = as_type<metal::uint4>(shaded) & metal::uint4(2147483647u);
            w_2_ = 0.0;
            if (metal::max(metal::max(metal::max(value_5_.x, value_5_.y), value_5_.z), value_5_.w) < 2139095040u) {
                int _e326 = tap_4_;
                float value_6_ = weights.inner[_e326];
                w_2_ = value_6_;
            }
            metal::float4 _e329 = result;
            result_2_ = _e329;
            float _e331 = w_2_;
            if (_e331 != 0.0) {
                metal::float4 _e334 = result;
                float _e335 = w_2_;
                metal::float4 result_3_ = _e334 + (_e335 * shaded);
                result_2_ = result_3_;
            }
            float _e338 = sum_4_;
            float _e339 = w_2_;
            float sum_5_ = _e338 + _e339;
            metal::float4 _e341 = result_2_;
            result = _e341;
            sum_4_ = sum_5_;
        }
    }
    metal::float4 _e346 = result;
    float _e347 = sum_4_;
    destination.write(_e346 / metal::float4(metal::max(_e347, 0.000000000000000000000000000001)), metal::uint2(pixel));
    return;
}
