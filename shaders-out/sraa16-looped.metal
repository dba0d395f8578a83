// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

struct type_5 {
    metal::int2 inner[16];
};
struct type_8 {
    float inner[9];
};
constant type_5 table = type_5 {{metal::int2(1), metal::int2(-1, -3), metal::int2(-3, 2), metal::int2(4, -1), metal::int2(-5, -2), metal::int2(2, 5), metal::int2(5, 3), metal::int2(3, -5), metal::int2(-2, 6), metal::int2(0, -7), metal::int2(-4, -6), metal::int2(-6, 4), metal::int2(-8, 0), metal::int2(7, -4), metal::int2(6, 7), metal::int2(-7, -8)}};
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
    int sample = 0;
    type_8 weights = type_8 {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
    int sample_2_ = 0;
    float seen_depth = {};
    type_8 distances = {};
    float nearest = {};
    int tap = {};
    float nearest_2_ = {};
    float d = {};
    float shaded_depth = {};
    float bounded = {};
    float bounded_2_ = {};
    float sum = {};
    type_8 tap_weights = {};
    int tap_2_ = {};
    float sum_2_ = {};
    int tap_3_ = {};
    metal::float4 result = metal::float4(0.0);
    float sum_3_ = 0.0;
    int tap_4_ = 0;
    float w_2_ = {};
    metal::float4 result_2_ = {};
    metal::float4 filtered = metal::float4(0.0);
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
            int _e19 = sample;
            sample = as_type<int>(as_type<uint>(_e19) + as_type<uint>(1));
        }
        loop_init = false;
        int _e12 = sample;
        if (_e12 < 16) {
        } else {
            break;
        }
        {
            float _e15 = total;
            total = _e15 + 1.0;
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
            int _e289 = sample_2_;
            sample_2_ = as_type<int>(as_type<uint>(_e289) + as_type<uint>(1));
        }
        loop_init_1 = false;
        int _e40 = sample_2_;
        if (_e40 < 16) {
        } else {
            break;
        }
        {
            int _e44 = sample_2_;
            metal::float2 place_at = metal::float2(0.0) + (static_cast<metal::float2>(table.inner[metal::min(unsigned(_e44), 15u)]) / metal::float2(16.0));
            int _e54 = sample_2_;
            metal::float4 _e56 = depth.read(metal::uint2(pixel), _e54, 0);
            float depth_2_ = _e56.x;
            seen_depth = 1000000000000000000000000000000.0;
            if (metal::abs(depth_2_) < 1000000000000000000000000000000.0) {
                seen_depth = depth_2_;
            }
            int _e64 = sample_2_;
            metal::float4 _e66 = normal.read(metal::uint2(pixel), _e64, 0);
            metal::float3 seen_normal = _e66.xyz;
            int _e68 = sample_2_;
            bool is_equal = _e68 == 16;
            distances = type_8 {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
            nearest = 16.0;
            tap = 0;
            uint2 loop_bound_2 = uint2(4294967295u);
            bool loop_init_2 = true;
            while(true) {
                if (metal::all(loop_bound_2 == uint2(0u))) { break; }
                loop_bound_2 -= uint2(loop_bound_2.y == 0u, 1u);
                if (!loop_init_2) {
                    int _e175 = tap;
                    tap = as_type<int>(as_type<uint>(_e175) + as_type<uint>(1));
                }
                loop_init_2 = false;
                int _e86 = tap;
                if (_e86 < 9) {
                } else {
                    break;
                }
                {
                    int _e89 = tap;
                    int _e94 = tap;
                    metal::int2 pixel_2_ = metal::int2(as_type<int>(as_type<uint>(naga_mod(_e89, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e94, 3)) - as_type<uint>(1)));
                    metal::float2 away = static_cast<metal::float2>(pixel_2_) - place_at;
                    float _e102 = nearest;
                    nearest_2_ = _e102;
                    if ((metal::max(1.0 - metal::abs(away.x), 0.0) * metal::max(1.0 - metal::abs(away.y), 0.0)) > 0.0) {
                        metal::bool2 is_equal_2_ = metal::int2(0) == pixel_2_;
                        d = float {};
                        if (is_equal & (is_equal_2_.x & is_equal_2_.y)) {
                            d = 0.0;
                        } else {
                            metal::int2 at = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(pixel_2_)), metal::int2(0), last);
                            metal::float4 _e136 = depth.read(metal::uint2(at), 16, 0);
                            float depth_3_ = _e136.x;
                            shaded_depth = 1000000000000000000000000000000.0;
                            if (metal::abs(depth_3_) < 1000000000000000000000000000000.0) {
                                shaded_depth = depth_3_;
                            }
                            float _e143 = seen_depth;
                            float _e144 = shaded_depth;
                            float step_value = metal::abs(_e143 - _e144);
                            bounded = 16.0;
                            if (step_value < 16.0) {
                                bounded = step_value;
                            }
                            metal::float4 _e154 = normal.read(metal::uint2(at), 16, 0);
                            metal::float3 turn = seen_normal - _e154.xyz;
                            float difference = 0.5 * metal::dot(turn, turn);
                            bounded_2_ = 16.0;
                            if (difference < 16.0) {
                                bounded_2_ = difference;
                            }
                            float _e164 = bounded;
                            float _e165 = bounded_2_;
                            d = metal::max(_e164, _e165);
                        }
                        int _e167 = tap;
                        float _e169 = d;
                        distances.inner[metal::min(unsigned(_e167), 8u)] = _e169;
                        float _e170 = nearest;
                        float _e171 = d;
                        nearest_2_ = metal::min(_e170, _e171);
                    }
                    float _e173 = nearest_2_;
                    nearest = _e173;
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
                    int _e240 = tap_2_;
                    tap_2_ = as_type<int>(as_type<uint>(_e240) + as_type<uint>(1));
                }
                loop_init_3 = false;
                int _e192 = tap_2_;
                if (_e192 < 9) {
                } else {
                    break;
                }
                {
                    int _e195 = tap_2_;
                    int _e200 = tap_2_;
                    metal::float2 away_2_ = static_cast<metal::float2>(metal::int2(as_type<int>(as_type<uint>(naga_mod(_e195, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e200, 3)) - as_type<uint>(1)))) - place_at;
                    float tent = metal::max(1.0 - metal::abs(away_2_.x), 0.0) * metal::max(1.0 - metal::abs(away_2_.y), 0.0);
                    float _e221 = sum;
                    sum_2_ = _e221;
                    if (tent > 0.0) {
                        int _e225 = tap_2_;
                        float _e227 = distances.inner[metal::min(unsigned(_e225), 8u)];
                        float _e228 = nearest;
                        float w = tent * metal::exp2(-721.34753 * (_e227 - _e228));
                        int _e234 = tap_2_;
                        tap_weights.inner[metal::min(unsigned(_e234), 8u)] = w;
                        float _e236 = sum;
                        sum_2_ = _e236 + w;
                    }
                    float _e238 = sum_2_;
                    sum = _e238;
                }
            }
            float _e242 = sum;
            float scale = share / _e242;
            tap_3_ = 0;
            uint2 loop_bound_4 = uint2(4294967295u);
            bool loop_init_4 = true;
            while(true) {
                if (metal::all(loop_bound_4 == uint2(0u))) { break; }
                loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
                if (!loop_init_4) {
                    int _e286 = tap_3_;
                    tap_3_ = as_type<int>(as_type<uint>(_e286) + as_type<uint>(1));
                }
                loop_init_4 = false;
                int _e246 = tap_3_;
                if (_e246 < 9) {
                } else {
                    break;
                }
                {
                    int _e249 = tap_3_;
                    int _e254 = tap_3_;
                    metal::float2 away_3_ = static_cast<metal::float2>(metal::int2(as_type<int>(as_type<uint>(naga_mod(_e249, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e254, 3)) - as_type<uint>(1)))) - place_at;
                    if ((metal::max(1.0 - metal::abs(away_3_.x), 0.0) * metal::max(1.0 - metal::abs(away_3_.y), 0.0)) > 0.0) {
                        int _e277 = tap_3_;
                        float _e279 = weights.inner[metal::min(unsigned(_e277), 8u)];
                        int _e280 = tap_3_;
                        float _e282 = tap_weights.inner[metal::min(unsigned(_e280), 8u)];
                        weights.inner[metal::min(unsigned(_e277), 8u)] = _e279 + (_e282 * scale);
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
            int _e346 = tap_4_;
            tap_4_ = as_type<int>(as_type<uint>(_e346) + as_type<uint>(1));
        }
        loop_init_5 = false;
        int _e298 = tap_4_;
        if (_e298 < 9) {
        } else {
            break;
        }
        {
            int _e301 = tap_4_;
            int _e306 = tap_4_;
            metal::int2 at_2_ = metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(as_type<int>(as_type<uint>(naga_mod(_e301, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e306, 3)) - as_type<uint>(1))))), metal::int2(0), last);
            metal::float4 shaded = color.read(metal::uint2(at_2_), 0);
            w_2_ = 0.0;
            if (metal::all((as_type<metal::uint4>(shaded) & metal::uint4(2147483647u)) < metal::uint4(2139095040u))) {
                int _e329 = tap_4_;
                float _e331 = weights.inner[metal::min(unsigned(_e329), 8u)];
                w_2_ = _e331;
            }
            metal::float4 _e332 = result;
            result_2_ = _e332;
            float _e334 = w_2_;
            if (_e334 != 0.0) {
                metal::float4 _e337 = result;
                float _e338 = w_2_;
                result_2_ = _e337 + (_e338 * shaded);
            }
            metal::float4 _e341 = result_2_;
            result = _e341;
            float _e342 = sum_3_;
            float _e343 = w_2_;
            sum_3_ = _e342 + _e343;
        }
    }
    float _e351 = sum_3_;
    if (_e351 > 0.000000000000000000000000000001) {
        metal::float4 _e354 = result;
        float _e355 = sum_3_;
        filtered = _e354 / metal::float4(_e355);
    }
    metal::float4 _e359 = filtered;
    destination.write(_e359, metal::uint2(pixel));
    return;
}
