typedef int2 ret_Constructarray16_int2_[16];
ret_Constructarray16_int2_ Constructarray16_int2_(int2 arg0, int2 arg1, int2 arg2, int2 arg3, int2 arg4, int2 arg5, int2 arg6, int2 arg7, int2 arg8, int2 arg9, int2 arg10, int2 arg11, int2 arg12, int2 arg13, int2 arg14, int2 arg15) {
    int2 ret[16] = { arg0, arg1, arg2, arg3, arg4, arg5, arg6, arg7, arg8, arg9, arg10, arg11, arg12, arg13, arg14, arg15 };
    return ret;
}

static const int2 table[16] = { (int(1)).xx, int2(int(-1), int(-3)), int2(int(-3), int(2)), int2(int(4), int(-1)), int2(int(-5), int(-2)), int2(int(2), int(5)), int2(int(5), int(3)), int2(int(3), int(-5)), int2(int(-2), int(6)), int2(int(0), int(-7)), int2(int(-4), int(-6)), int2(int(-6), int(4)), int2(int(-8), int(0)), int2(int(7), int(-4)), int2(int(6), int(7)), int2(int(-7), int(-8)) };

Texture2DArray<float4> depth : register(t0);
Texture2DArray<float4> normal : register(t1);
Texture2D<float4> color : register(t2);
RWTexture2D<float4> destination : register(u3);

int naga_mod(int lhs, int rhs) {
    int divisor = ((lhs == int(-2147483647 - 1) & rhs == -1) | (rhs == 0)) ? 1 : rhs;
    return lhs - (lhs / divisor) * divisor;
}

int naga_div(int lhs, int rhs) {
    return lhs / (((lhs == int(-2147483647 - 1) & rhs == -1) | (rhs == 0)) ? 1 : rhs);
}

typedef float ret_Constructarray9_float_[9];
ret_Constructarray9_float_ Constructarray9_float_(float arg0, float arg1, float arg2, float arg3, float arg4, float arg5, float arg6, float arg7, float arg8) {
    float ret[9] = { arg0, arg1, arg2, arg3, arg4, arg5, arg6, arg7, arg8 };
    return ret;
}

float ZeroValuefloat() {
    return (float)0;
}

uint2 NagaRWDimensions2D(RWTexture2D<float4> tex)
{
    uint4 ret;
    tex.GetDimensions(ret.x, ret.y);
    return ret.xy;
}

[numthreads(256, 1, 1)]
void sraa(uint3 id : SV_DispatchThreadID)
{
    float total = 0.0;
    int sample_value = int(0);
    float weights[9] = Constructarray9_float_(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    int sample_2_ = int(0);
    float seen_depth = (float)0;
    float distances[9] = (float[9])0;
    float nearest = (float)0;
    int tap = (int)0;
    float nearest_2_ = (float)0;
    float d = (float)0;
    float shaded_depth = (float)0;
    float bounded = (float)0;
    float bounded_2_ = (float)0;
    float sum = (float)0;
    float tap_weights[9] = (float[9])0;
    int tap_2_ = (int)0;
    float sum_2_ = (float)0;
    int tap_3_ = (int)0;
    float4 result = (0.0).xxxx;
    float sum_3_ = 0.0;
    int tap_4_ = int(0);
    float w_2_ = (float)0;
    float4 result_2_ = (float4)0;
    float4 filtered = (0.0).xxxx;

    int2 frame = int2(NagaRWDimensions2D(destination));
    int2 pixel = int2(id.xy);
    if (any((pixel >= frame))) {
        return;
    }
    uint2 loop_bound = uint2(4294967295u, 4294967295u);
    bool loop_init = true;
    while(true) {
        if (all(loop_bound == uint2(0u, 0u))) { break; }
        loop_bound -= uint2(loop_bound.y == 0u, 1u);
        if (!loop_init) {
            int _e19 = sample_value;
            sample_value = asint(asuint(_e19) + asuint(int(1)));
        }
        loop_init = false;
        int _e12 = sample_value;
        if ((_e12 < int(16))) {
        } else {
            break;
        }
        {
            float _e15 = total;
            total = (_e15 + 1.0);
        }
    }
    float _e21 = total;
    float share = (1.0 / _e21);
    int2 last = asint(asuint(frame) - asuint((int(1)).xx));
    uint2 loop_bound_1 = uint2(4294967295u, 4294967295u);
    bool loop_init_1 = true;
    while(true) {
        if (all(loop_bound_1 == uint2(0u, 0u))) { break; }
        loop_bound_1 -= uint2(loop_bound_1.y == 0u, 1u);
        if (!loop_init_1) {
            int _e289 = sample_2_;
            sample_2_ = asint(asuint(_e289) + asuint(int(1)));
        }
        loop_init_1 = false;
        int _e40 = sample_2_;
        if ((_e40 < int(16))) {
        } else {
            break;
        }
        {
            int _e44 = sample_2_;
            float2 place_at = ((0.0).xx + (float2(table[min(uint(_e44), 15u)]) / (16.0).xx));
            int _e54 = sample_2_;
            float4 _e56 = depth.Load(int4(pixel, _e54, int(0)));
            float depth_2_ = _e56.x;
            seen_depth = 1e30;
            if ((abs(depth_2_) < 1e30)) {
                seen_depth = depth_2_;
            }
            int _e64 = sample_2_;
            float4 _e66 = normal.Load(int4(pixel, _e64, int(0)));
            float3 seen_normal = _e66.xyz;
            int _e68 = sample_2_;
            bool is_equal = (_e68 == int(16));
            distances = Constructarray9_float_(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
            nearest = 16.0;
            tap = int(0);
            uint2 loop_bound_2 = uint2(4294967295u, 4294967295u);
            bool loop_init_2 = true;
            while(true) {
                if (all(loop_bound_2 == uint2(0u, 0u))) { break; }
                loop_bound_2 -= uint2(loop_bound_2.y == 0u, 1u);
                if (!loop_init_2) {
                    int _e175 = tap;
                    tap = asint(asuint(_e175) + asuint(int(1)));
                }
                loop_init_2 = false;
                int _e86 = tap;
                if ((_e86 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e89 = tap;
                    int _e94 = tap;
                    int2 pixel_2_ = int2(asint(asuint(naga_mod(_e89, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e94, int(3))) - asuint(int(1))));
                    float2 away = (float2(pixel_2_) - place_at);
                    float _e102 = nearest;
                    nearest_2_ = _e102;
                    if (((max((1.0 - abs(away.x)), 0.0) * max((1.0 - abs(away.y)), 0.0)) > 0.0)) {
                        bool2 is_equal_2_ = ((int(0)).xx == pixel_2_);
                        d = ZeroValuefloat();
                        if ((is_equal & (is_equal_2_.x & is_equal_2_.y))) {
                            d = 0.0;
                        } else {
                            int2 texel = clamp(asint(asuint(pixel) + asuint(pixel_2_)), (int(0)).xx, last);
                            float4 _e136 = depth.Load(int4(texel, int(16), int(0)));
                            float depth_3_ = _e136.x;
                            shaded_depth = 1e30;
                            if ((abs(depth_3_) < 1e30)) {
                                shaded_depth = depth_3_;
                            }
                            float _e143 = seen_depth;
                            float _e144 = shaded_depth;
                            float step_value = abs((_e143 - _e144));
                            bounded = 16.0;
                            if ((step_value < 16.0)) {
                                bounded = step_value;
                            }
                            float4 _e154 = normal.Load(int4(texel, int(16), int(0)));
                            float3 turn = (seen_normal - _e154.xyz);
                            float difference = (0.5 * dot(turn, turn));
                            bounded_2_ = 16.0;
                            if ((difference < 16.0)) {
                                bounded_2_ = difference;
                            }
                            float _e164 = bounded;
                            float _e165 = bounded_2_;
                            d = max(_e164, _e165);
                        }
                        int _e167 = tap;
                        float _e169 = d;
                        distances[min(uint(_e167), 8u)] = _e169;
                        float _e170 = nearest;
                        float _e171 = d;
                        nearest_2_ = min(_e170, _e171);
                    }
                    float _e173 = nearest_2_;
                    nearest = _e173;
                }
            }
            sum = 0.0;
            tap_weights = Constructarray9_float_(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
            tap_2_ = int(0);
            uint2 loop_bound_3 = uint2(4294967295u, 4294967295u);
            bool loop_init_3 = true;
            while(true) {
                if (all(loop_bound_3 == uint2(0u, 0u))) { break; }
                loop_bound_3 -= uint2(loop_bound_3.y == 0u, 1u);
                if (!loop_init_3) {
                    int _e240 = tap_2_;
                    tap_2_ = asint(asuint(_e240) + asuint(int(1)));
                }
                loop_init_3 = false;
                int _e192 = tap_2_;
                if ((_e192 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e195 = tap_2_;
                    int _e200 = tap_2_;
                    float2 away_2_ = (float2(int2(asint(asuint(naga_mod(_e195, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e200, int(3))) - asuint(int(1))))) - place_at);
                    float tent = (max((1.0 - abs(away_2_.x)), 0.0) * max((1.0 - abs(away_2_.y)), 0.0));
                    float _e221 = sum;
                    sum_2_ = _e221;
                    if ((tent > 0.0)) {
                        int _e225 = tap_2_;
                        float _e227 = distances[min(uint(_e225), 8u)];
                        float _e228 = nearest;
                        float w = (tent * exp2((-721.34753 * (_e227 - _e228))));
                        int _e234 = tap_2_;
                        tap_weights[min(uint(_e234), 8u)] = w;
                        float _e236 = sum;
                        sum_2_ = (_e236 + w);
                    }
                    float _e238 = sum_2_;
                    sum = _e238;
                }
            }
            float _e242 = sum;
            float scale = (share / _e242);
            tap_3_ = int(0);
            uint2 loop_bound_4 = uint2(4294967295u, 4294967295u);
            bool loop_init_4 = true;
            while(true) {
                if (all(loop_bound_4 == uint2(0u, 0u))) { break; }
                loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
                if (!loop_init_4) {
                    int _e286 = tap_3_;
                    tap_3_ = asint(asuint(_e286) + asuint(int(1)));
                }
                loop_init_4 = false;
                int _e246 = tap_3_;
                if ((_e246 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e249 = tap_3_;
                    int _e254 = tap_3_;
                    float2 away_3_ = (float2(int2(asint(asuint(naga_mod(_e249, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e254, int(3))) - asuint(int(1))))) - place_at);
                    if (((max((1.0 - abs(away_3_.x)), 0.0) * max((1.0 - abs(away_3_.y)), 0.0)) > 0.0)) {
                        int _e277 = tap_3_;
                        float _e279 = weights[min(uint(_e277), 8u)];
                        int _e280 = tap_3_;
                        float _e282 = tap_weights[min(uint(_e280), 8u)];
                        weights[min(uint(_e277), 8u)] = (_e279 + (_e282 * scale));
                    }
                }
            }
        }
    }
    uint2 loop_bound_5 = uint2(4294967295u, 4294967295u);
    bool loop_init_5 = true;
    while(true) {
        if (all(loop_bound_5 == uint2(0u, 0u))) { break; }
        loop_bound_5 -= uint2(loop_bound_5.y == 0u, 1u);
        if (!loop_init_5) {
            int _e346 = tap_4_;
            tap_4_ = asint(asuint(_e346) + asuint(int(1)));
        }
        loop_init_5 = false;
        int _e298 = tap_4_;
        if ((_e298 < int(9))) {
        } else {
            break;
        }
        {
            int _e301 = tap_4_;
            int _e306 = tap_4_;
            int2 texel_2_ = clamp(asint(asuint(pixel) + asuint(int2(asint(asuint(naga_mod(_e301, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e306, int(3))) - asuint(int(1)))))), (int(0)).xx, last);
            float4 shaded = color.Load(int3(texel_2_, int(0)));
            w_2_ = 0.0;
            if (all(((asuint(shaded) & (2147483647u).xxxx) < (2139095040u).xxxx))) {
                int _e329 = tap_4_;
                float _e331 = weights[min(uint(_e329), 8u)];
                w_2_ = _e331;
            }
            float4 _e332 = result;
            result_2_ = _e332;
            float _e334 = w_2_;
            if ((_e334 != 0.0)) {
                float4 _e337 = result;
                float _e338 = w_2_;
                result_2_ = (_e337 + (_e338 * shaded));
            }
            float4 _e341 = result_2_;
            result = _e341;
            float _e342 = sum_3_;
            float _e343 = w_2_;
            sum_3_ = (_e342 + _e343);
        }
    }
    float _e351 = sum_3_;
    if ((_e351 > 1e-30)) {
        float4 _e354 = result;
        float _e355 = sum_3_;
        filtered = (_e354 / (_e355).xxxx);
    }
    float4 _e359 = filtered;
    destination[pixel] = _e359;
    return;
}
