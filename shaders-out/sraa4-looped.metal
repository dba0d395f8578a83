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
    float seen_depth = {};
    type_8 distances = {};
    float nearest = {};
    int tap = {};
    float nearest_2_ = {};
    float d = {};
    bool local = {};
    bool local_1 = {};
    float shaded_depth = {};
    float chosen = {};
    float chosen_2_ = {};
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
    metal::float4 chosen_3_ = metal::float4(0.0);
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
            int _e297 = sample_2_;
            sample_2_ = as_type<int>(as_type<uint>(_e297) + as_type<uint>(1));
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
            seen_depth = 1000000000000000000000000000000.0;
            if (metal::abs(depth_2_) < 1000000000000000000000000000000.0) {
                seen_depth = depth_2_;
            }
            int _e64 = sample_2_;
            metal::float4 _e66 = normal.read(metal::uint2(pixel), _e64, 0);
            metal::float3 seen_normal = _e66.xyz;
            int _e68 = sample_2_;
            bool holds = _e68 == 4;
            distances = type_8 {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
            nearest = 16.0;
            tap = 0;
            uint2 loop_bound_2 = uint2(4294967295u);
            bool loop_init_2 = true;
            while(true) {
                if (metal::all(loop_bound_2 == uint2(0u))) { break; }
                loop_bound_2 -= uint2(loop_bound_2.y == 0u, 1u);
                if (!loop_init_2) {
                    int _e181 = tap;
                    tap = as_type<int>(as_type<uint>(_e181) + as_type<uint>(1));
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
                    bool holds_2_ = (metal::max(1.0 - metal::abs(away.x), 0.0) * metal::max(1.0 - metal::abs(away.y), 0.0)) > 0.0;
                    float _e117 = nearest;
                    nearest_2_ = _e117;
                    if (holds_2_) {
                        metal::bool2 holds_3_ = metal::int2(0) == pixel_2_;
                        d = float {};
                        if (holds) {
                            if (holds_3_.x) {
                                local_1 = holds_3_.y;
                            } else {
                                local_1 = false;
                            }
                            bool _e131 = local_1;
                            local = _e131;
                        } else {
                            local = false;
                        }
                        bool _e133 = local;
                        if (_e133) {
                            d = 0.0;
                        } else {
                            metal::int2 texel_2_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(pixel_2_));
                            metal::int2 texel_3_ = metal::clamp(texel_2_, metal::int2(0), last);
                            metal::float4 _e142 = depth.read(metal::uint2(texel_3_), 4, 0);
                            float depth_3_ = _e142.x;
                            shaded_depth = 1000000000000000000000000000000.0;
                            if (metal::abs(depth_3_) < 1000000000000000000000000000000.0) {
                                shaded_depth = depth_3_;
                            }
                            metal::float4 _e152 = normal.read(metal::uint2(texel_3_), 4, 0);
                            metal::float3 shaded_normal = _e152.xyz;
                            float _e154 = seen_depth;
                            float _e155 = shaded_depth;
                            float step_value = metal::abs(_e154 - _e155);
                            chosen = 16.0;
                            if (step_value < 16.0) {
                                chosen = step_value;
                            }
                            metal::float3 turn = seen_normal - shaded_normal;
                            float value = 0.5 * metal::dot(turn, turn);
                            chosen_2_ = 16.0;
                            if (value < 16.0) {
                                chosen_2_ = value;
                            }
                            float _e170 = chosen;
                            float _e171 = chosen_2_;
                            float larger = metal::max(_e170, _e171);
                            d = larger;
                        }
                        int _e173 = tap;
                        float _e175 = d;
                        distances.inner[_e173] = _e175;
                        float _e176 = nearest;
                        float _e177 = d;
                        float nearest_3_ = metal::min(_e176, _e177);
                        nearest_2_ = nearest_3_;
                    }
                    float _e179 = nearest_2_;
                    nearest = _e179;
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
                    int _e246 = tap_2_;
                    tap_2_ = as_type<int>(as_type<uint>(_e246) + as_type<uint>(1));
                }
                loop_init_3 = false;
                int _e198 = tap_2_;
                if (_e198 < 9) {
                } else {
                    break;
                }
                {
                    int _e201 = tap_2_;
                    int _e206 = tap_2_;
                    metal::int2 pixel_3_ = metal::int2(as_type<int>(as_type<uint>(naga_mod(_e201, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e206, 3)) - as_type<uint>(1)));
                    metal::float2 away_2_ = static_cast<metal::float2>(pixel_3_) - place_at;
                    float value_2_ = metal::max(1.0 - metal::abs(away_2_.x), 0.0) * metal::max(1.0 - metal::abs(away_2_.y), 0.0);
                    float _e227 = sum;
                    sum_2_ = _e227;
                    if (value_2_ > 0.0) {
                        int _e231 = tap_2_;
                        float value_3_ = distances.inner[_e231];
                        float _e234 = nearest;
                        float nearness = metal::exp2(-721.34753 * (value_3_ - _e234));
                        float w = value_2_ * nearness;
                        int _e240 = tap_2_;
                        tap_weights.inner[_e240] = w;
                        float _e242 = sum;
                        float sum_3_ = _e242 + w;
                        sum_2_ = sum_3_;
                    }
                    float _e244 = sum_2_;
                    sum = _e244;
                }
            }
            float _e248 = sum;
            float scale = share / _e248;
            tap_3_ = 0;
            uint2 loop_bound_4 = uint2(4294967295u);
            bool loop_init_4 = true;
            while(true) {
                if (metal::all(loop_bound_4 == uint2(0u))) { break; }
                loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
                if (!loop_init_4) {
                    int _e294 = tap_3_;
                    tap_3_ = as_type<int>(as_type<uint>(_e294) + as_type<uint>(1));
                }
                loop_init_4 = false;
                int _e252 = tap_3_;
                if (_e252 < 9) {
                } else {
                    break;
                }
                {
                    int _e255 = tap_3_;
                    int _e260 = tap_3_;
                    metal::int2 pixel_4_ = metal::int2(as_type<int>(as_type<uint>(naga_mod(_e255, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e260, 3)) - as_type<uint>(1)));
                    metal::float2 away_3_ = static_cast<metal::float2>(pixel_4_) - place_at;
                    bool holds_4_ = (metal::max(1.0 - metal::abs(away_3_.x), 0.0) * metal::max(1.0 - metal::abs(away_3_.y), 0.0)) > 0.0;
                    if (holds_4_) {
                        int _e283 = tap_3_;
                        float value_4_ = tap_weights.inner[_e283];
                        int _e286 = tap_3_;
                        float value_5_ = weights.inner[_e286];
                        float weights_2_ = value_5_ + (value_4_ * scale);
                        int _e291 = tap_3_;
                        weights.inner[_e291] = weights_2_;
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
            int _e359 = tap_4_;
            tap_4_ = as_type<int>(as_type<uint>(_e359) + as_type<uint>(1));
        }
        loop_init_5 = false;
        int _e306 = tap_4_;
        if (_e306 < 9) {
        } else {
            break;
        }
        {
            int _e309 = tap_4_;
            int _e314 = tap_4_;
            metal::int2 pixel_5_ = metal::int2(as_type<int>(as_type<uint>(naga_mod(_e309, 3)) - as_type<uint>(1)), as_type<int>(as_type<uint>(naga_div(_e314, 3)) - as_type<uint>(1)));
            metal::int2 pixel_6_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(pixel_5_));
            metal::int2 texel_4_ = metal::clamp(pixel_6_, metal::int2(0), last);
            metal::float4 shaded = color.read(metal::uint2(texel_4_), 0);
            metal::uint4 value_6_ = as_type<metal::uint4>(shaded) & metal::uint4(2147483647u);
            w_2_ = 0.0;
            if (metal::max(metal::max(metal::max(value_6_.x, value_6_.y), value_6_.z), value_6_.w) < 2139095040u) {
                int _e342 = tap_4_;
                float value_7_ = weights.inner[_e342];
                w_2_ = value_7_;
            }
            metal::float4 _e345 = result;
            result_2_ = _e345;
            float _e347 = w_2_;
            if (_e347 != 0.0) {
                metal::float4 _e350 = result;
                float _e351 = w_2_;
                metal::float4 result_3_ = _e350 + (_e351 * shaded);
                result_2_ = result_3_;
            }
            float _e354 = sum_4_;
            float _e355 = w_2_;
            float sum_5_ = _e354 + _e355;
            metal::float4 _e357 = result_2_;
            result = _e357;
            sum_4_ = sum_5_;
        }
    }
    float _e364 = sum_4_;
    if (_e364 > 0.000000000000000000000000000001) {
        metal::float4 _e367 = result;
        float _e368 = sum_4_;
        chosen_3_ = _e367 / metal::float4(_e368);
    }
    metal::float4 _e372 = chosen_3_;
    destination.write(_e372, metal::uint2(pixel));
    return;
}
