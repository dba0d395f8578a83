typedef int2 ret_Constructarray4_int2_[4];
ret_Constructarray4_int2_ Constructarray4_int2_(int2 arg0, int2 arg1, int2 arg2, int2 arg3) {
    int2 ret[4] = { arg0, arg1, arg2, arg3 };
    return ret;
}

static const int2 table[4] = { int2(int(-2), int(-6)), int2(int(6), int(-2)), int2(int(-6), int(2)), int2(int(2), int(6)) };

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
            int _e291 = sample_2_;
            sample_2_ = asint(asuint(_e291) + asuint(int(1)));
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
                    bool holds_2_ = ((max((1.0 - abs(away.x)), 0.0) * max((1.0 - abs(away.y)), 0.0)) > 0.0);
                    float _e117 = nearest;
                    nearest_2_ = _e117;
                    if (holds_2_) {
                        bool2 holds_3_ = ((int(0)).xx == pixel_2_);
                        d = ZeroValuefloat();
                        if ((holds & (holds_3_.x & holds_3_.y))) {
                            d = 0.0;
                        } else {
                            int2 texel_2_ = asint(asuint(pixel) + asuint(pixel_2_));
                            int2 texel_3_ = clamp(texel_2_, (int(0)).xx, last);
                            float4 _e136 = depth.Load(int4(texel_3_, int(4), int(0)));
                            float depth_3_ = _e136.x;
                            shaded_depth = 1e30;
                            if ((abs(depth_3_) < 1e30)) {
                                shaded_depth = depth_3_;
                            }
                            float4 _e146 = normal.Load(int4(texel_3_, int(4), int(0)));
                            float3 shaded_normal = _e146.xyz;
                            float _e148 = seen_depth;
                            float _e149 = shaded_depth;
                            float step_value = abs((_e148 - _e149));
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
                            float _e164 = chosen;
                            float _e165 = chosen_2_;
                            float larger = max(_e164, _e165);
                            d = larger;
                        }
                        int _e167 = tap;
                        float _e169 = d;
                        distances[min(uint(_e167), 8u)] = _e169;
                        float _e170 = nearest;
                        float _e171 = d;
                        float nearest_3_ = min(_e170, _e171);
                        nearest_2_ = nearest_3_;
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
                    int2 pixel_3_ = int2(asint(asuint(naga_mod(_e195, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e200, int(3))) - asuint(int(1))));
                    float2 away_2_ = (float2(pixel_3_) - place_at);
                    float value_2_ = (max((1.0 - abs(away_2_.x)), 0.0) * max((1.0 - abs(away_2_.y)), 0.0));
                    float _e221 = sum;
                    sum_2_ = _e221;
                    if ((value_2_ > 0.0)) {
                        int _e225 = tap_2_;
                        float value_3_ = distances[min(uint(_e225), 8u)];
                        float _e228 = nearest;
                        float nearness = exp2((-721.34753 * (value_3_ - _e228)));
                        float w = (value_2_ * nearness);
                        int _e234 = tap_2_;
                        tap_weights[min(uint(_e234), 8u)] = w;
                        float _e236 = sum;
                        float sum_3_ = (_e236 + w);
                        sum_2_ = sum_3_;
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
                    int _e288 = tap_3_;
                    tap_3_ = asint(asuint(_e288) + asuint(int(1)));
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
                    int2 pixel_4_ = int2(asint(asuint(naga_mod(_e249, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e254, int(3))) - asuint(int(1))));
                    float2 away_3_ = (float2(pixel_4_) - place_at);
                    bool holds_4_ = ((max((1.0 - abs(away_3_.x)), 0.0) * max((1.0 - abs(away_3_.y)), 0.0)) > 0.0);
                    if (holds_4_) {
                        int _e277 = tap_3_;
                        float value_4_ = tap_weights[min(uint(_e277), 8u)];
                        int _e280 = tap_3_;
                        float value_5_ = weights[min(uint(_e280), 8u)];
                        float weights_2_ = (value_5_ + (value_4_ * scale));
                        int _e285 = tap_3_;
                        weights[min(uint(_e285), 8u)] = weights_2_;
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
            int _e353 = tap_4_;
            tap_4_ = asint(asuint(_e353) + asuint(int(1)));
        }
        loop_init_5 = false;
        int _e300 = tap_4_;
        if ((_e300 < int(9))) {
        } else {
            break;
        }
        {
            int _e303 = tap_4_;
            int _e308 = tap_4_;
            int2 pixel_5_ = int2(asint(asuint(naga_mod(_e303, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e308, int(3))) - asuint(int(1))));
            int2 pixel_6_ = asint(asuint(pixel) + asuint(pixel_5_));
            int2 texel_4_ = clamp(pixel_6_, (int(0)).xx, last);
            float4 shaded = color.Load(int3(texel_4_, int(0)));
            uint4 value_6_ = (asuint(shaded) & (2147483647u).xxxx);
            w_2_ = 0.0;
            if ((max(max(max(value_6_.x, value_6_.y), value_6_.z), value_6_.w) < 2139095040u)) {
                int _e336 = tap_4_;
                float value_7_ = weights[min(uint(_e336), 8u)];
                w_2_ = value_7_;
            }
            float4 _e339 = result;
            result_2_ = _e339;
            float _e341 = w_2_;
            if ((_e341 != 0.0)) {
                float4 _e344 = result;
                float _e345 = w_2_;
                float4 result_3_ = (_e344 + (_e345 * shaded));
                result_2_ = result_3_;
            }
            float _e348 = sum_4_;
            float _e349 = w_2_;
            float sum_5_ = (_e348 + _e349);
            float4 _e351 = result_2_;
            result = _e351;
            sum_4_ = sum_5_;
        }
    }
    float _e358 = sum_4_;
    if ((_e358 > 1e-30)) {
        float4 _e361 = result;
        float _e362 = sum_4_;
        chosen_3_ = (_e361 / (_e362).xxxx);
    }
    float4 _e366 = chosen_3_;
    destination[pixel] = _e366;
    return;
}
