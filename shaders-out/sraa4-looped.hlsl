typedef int2 ret_Constructarray4_int2_[4];
ret_Constructarray4_int2_ Constructarray4_int2_(int2 arg0, int2 arg1, int2 arg2, int2 arg3) {
    int2 ret[4] = { arg0, arg1, arg2, arg3 };
    return ret;
}

static const int2 table[4] = Constructarray4_int2_(int2(int(-2), int(-6)), int2(int(6), int(-2)), int2(int(-6), int(2)), int2(int(2), int(6)));

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
    bool local = (bool)0;
    bool local_1 = (bool)0;
    float shaded_depth = (float)0;
    float chosen = (float)0;
    float chosen_2_ = (float)0;
    float sum = (float)0;
    float tap_weights[9] = (float[9])0;
    int tap_2_ = (int)0;
    float sum_2_ = (float)0;
    int tap_3_ = (int)0;
    float4 result = (0.0).xxxx;
    float sum_4_ = 0.0;
    int tap_4_ = int(0);
    float w_2_ = (float)0;
    float4 result_2_ = (float4)0;
    float4 chosen_3_ = (0.0).xxxx;

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
        if ((_e12 < int(4))) {
        } else {
            break;
        }
        {
            float _e15 = total;
            float total_2_ = (_e15 + 1.0);
            total = total_2_;
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
            int _e297 = sample_2_;
            sample_2_ = asint(asuint(_e297) + asuint(int(1)));
        }
        loop_init_1 = false;
        int _e40 = sample_2_;
        if ((_e40 < int(4))) {
        } else {
            break;
        }
        {
            int _e44 = sample_2_;
            int2 texel = table[min(uint(_e44), 3u)];
            float2 place_at = ((0.0).xx + (float2(texel) / (16.0).xx));
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
            bool holds = (_e68 == int(4));
            distances = Constructarray9_float_(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
            nearest = 16.0;
            tap = int(0);
            uint2 loop_bound_2 = uint2(4294967295u, 4294967295u);
            bool loop_init_2 = true;
            while(true) {
                if (all(loop_bound_2 == uint2(0u, 0u))) { break; }
                loop_bound_2 -= uint2(loop_bound_2.y == 0u, 1u);
                if (!loop_init_2) {
                    int _e181 = tap;
                    tap = asint(asuint(_e181) + asuint(int(1)));
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
                    bool holds_2_ = ((max((1.0 - abs(away.x)), 0.0) * max((1.0 - abs(away.y)), 0.0)) > 0.0);
                    float _e117 = nearest;
                    nearest_2_ = _e117;
                    if (holds_2_) {
                        bool2 holds_3_ = ((int(0)).xx == pixel_2_);
                        d = ZeroValuefloat();
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
                            int2 texel_2_ = asint(asuint(pixel) + asuint(pixel_2_));
                            int2 texel_3_ = clamp(texel_2_, (int(0)).xx, last);
                            float4 _e142 = depth.Load(int4(texel_3_, int(4), int(0)));
                            float depth_3_ = _e142.x;
                            shaded_depth = 1e30;
                            if ((abs(depth_3_) < 1e30)) {
                                shaded_depth = depth_3_;
                            }
                            float4 _e152 = normal.Load(int4(texel_3_, int(4), int(0)));
                            float3 shaded_normal = _e152.xyz;
                            float _e154 = seen_depth;
                            float _e155 = shaded_depth;
                            float step_value = abs((_e154 - _e155));
                            chosen = 16.0;
                            if ((step_value < 16.0)) {
                                chosen = step_value;
                            }
                            float3 turn = (seen_normal - shaded_normal);
                            float value = (0.5 * dot(turn, turn));
                            chosen_2_ = 16.0;
                            if ((value < 16.0)) {
                                chosen_2_ = value;
                            }
                            float _e170 = chosen;
                            float _e171 = chosen_2_;
                            float larger = max(_e170, _e171);
                            d = larger;
                        }
                        int _e173 = tap;
                        float _e175 = d;
                        distances[min(uint(_e173), 8u)] = _e175;
                        float _e176 = nearest;
                        float _e177 = d;
                        float nearest_3_ = min(_e176, _e177);
                        nearest_2_ = nearest_3_;
                    }
                    float _e179 = nearest_2_;
                    nearest = _e179;
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
                    int _e246 = tap_2_;
                    tap_2_ = asint(asuint(_e246) + asuint(int(1)));
                }
                loop_init_3 = false;
                int _e198 = tap_2_;
                if ((_e198 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e201 = tap_2_;
                    int _e206 = tap_2_;
                    int2 pixel_3_ = int2(asint(asuint(naga_mod(_e201, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e206, int(3))) - asuint(int(1))));
                    float2 away_2_ = (float2(pixel_3_) - place_at);
                    float value_2_ = (max((1.0 - abs(away_2_.x)), 0.0) * max((1.0 - abs(away_2_.y)), 0.0));
                    float _e227 = sum;
                    sum_2_ = _e227;
                    if ((value_2_ > 0.0)) {
                        int _e231 = tap_2_;
                        float value_3_ = distances[min(uint(_e231), 8u)];
                        float _e234 = nearest;
                        float nearness = exp2((-721.34753 * (value_3_ - _e234)));
                        float w = (value_2_ * nearness);
                        int _e240 = tap_2_;
                        tap_weights[min(uint(_e240), 8u)] = w;
                        float _e242 = sum;
                        float sum_3_ = (_e242 + w);
                        sum_2_ = sum_3_;
                    }
                    float _e244 = sum_2_;
                    sum = _e244;
                }
            }
            float _e248 = sum;
            float scale = (share / _e248);
            tap_3_ = int(0);
            uint2 loop_bound_4 = uint2(4294967295u, 4294967295u);
            bool loop_init_4 = true;
            while(true) {
                if (all(loop_bound_4 == uint2(0u, 0u))) { break; }
                loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
                if (!loop_init_4) {
                    int _e294 = tap_3_;
                    tap_3_ = asint(asuint(_e294) + asuint(int(1)));
                }
                loop_init_4 = false;
                int _e252 = tap_3_;
                if ((_e252 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e255 = tap_3_;
                    int _e260 = tap_3_;
                    int2 pixel_4_ = int2(asint(asuint(naga_mod(_e255, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e260, int(3))) - asuint(int(1))));
                    float2 away_3_ = (float2(pixel_4_) - place_at);
                    bool holds_4_ = ((max((1.0 - abs(away_3_.x)), 0.0) * max((1.0 - abs(away_3_.y)), 0.0)) > 0.0);
                    if (holds_4_) {
                        int _e283 = tap_3_;
                        float value_4_ = tap_weights[min(uint(_e283), 8u)];
                        int _e286 = tap_3_;
                        float value_5_ = weights[min(uint(_e286), 8u)];
                        float weights_2_ = (value_5_ + (value_4_ * scale));
                        int _e291 = tap_3_;
                        weights[min(uint(_e291), 8u)] = weights_2_;
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
            int _e359 = tap_4_;
            tap_4_ = asint(asuint(_e359) + asuint(int(1)));
        }
        loop_init_5 = false;
        int _e306 = tap_4_;
        if ((_e306 < int(9))) {
        } else {
            break;
        }
        {
            int _e309 = tap_4_;
            int _e314 = tap_4_;
            int2 pixel_5_ = int2(asint(asuint(naga_mod(_e309, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e314, int(3))) - asuint(int(1))));
            int2 pixel_6_ = asint(asuint(pixel) + asuint(pixel_5_));
            int2 texel_4_ = clamp(pixel_6_, (int(0)).xx, last);
            float4 shaded = color.Load(int3(texel_4_, int(0)));
            uint4 value_6_ = (asuint(shaded) & (2147483647u).xxxx);
            w_2_ = 0.0;
            if ((max(max(max(value_6_.x, value_6_.y), value_6_.z), value_6_.w) < 2139095040u)) {
                int _e342 = tap_4_;
                float value_7_ = weights[min(uint(_e342), 8u)];
                w_2_ = value_7_;
            }
            float4 _e345 = result;
            result_2_ = _e345;
            float _e347 = w_2_;
            if ((_e347 != 0.0)) {
                float4 _e350 = result;
                float _e351 = w_2_;
                float4 result_3_ = (_e350 + (_e351 * shaded));
                result_2_ = result_3_;
            }
            float _e354 = sum_4_;
            float _e355 = w_2_;
            float sum_5_ = (_e354 + _e355);
            float4 _e357 = result_2_;
            result = _e357;
            sum_4_ = sum_5_;
        }
    }
    float _e364 = sum_4_;
    if ((_e364 > 1e-30)) {
        float4 _e367 = result;
        float _e368 = sum_4_;
        chosen_3_ = (_e367 / (_e368).xxxx);
    }
    float4 _e372 = chosen_3_;
    destination[pixel] = _e372;
    return;
}
