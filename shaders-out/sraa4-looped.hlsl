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
    float distances[9] = (float[9])0;
    float nearest = (float)0;
    int tap = (int)0;
    float nearest_2_ = (float)0;
    float d = (float)0;
    bool local = (bool)0;
    bool local_1 = (bool)0;
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
            int _e281 = sample_2_;
            sample_2_ = asint(asuint(_e281) + asuint(int(1)));
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
            float seen_depth = min(depth_2_, 1e30);
            int _e61 = sample_2_;
            float4 _e63 = normal.Load(int4(pixel, _e61, int(0)));
            float3 seen_normal = _e63.xyz;
            int _e65 = sample_2_;
            bool holds = (_e65 == int(4));
            distances = Constructarray9_float_(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
            nearest = 16.0;
            tap = int(0);
            uint2 loop_bound_2 = uint2(4294967295u, 4294967295u);
            bool loop_init_2 = true;
            while(true) {
                if (all(loop_bound_2 == uint2(0u, 0u))) { break; }
                loop_bound_2 -= uint2(loop_bound_2.y == 0u, 1u);
                if (!loop_init_2) {
                    int _e165 = tap;
                    tap = asint(asuint(_e165) + asuint(int(1)));
                }
                loop_init_2 = false;
                int _e83 = tap;
                if ((_e83 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e86 = tap;
                    int _e91 = tap;
                    int2 pixel_2_ = int2(asint(asuint(naga_mod(_e86, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e91, int(3))) - asuint(int(1))));
                    float2 away = (float2(pixel_2_) - place_at);
                    bool holds_2_ = ((max((1.0 - abs(away.x)), 0.0) * max((1.0 - abs(away.y)), 0.0)) > 0.0);
                    float _e114 = nearest;
                    nearest_2_ = _e114;
                    if (holds_2_) {
                        bool2 holds_3_ = ((int(0)).xx == pixel_2_);
                        d = ZeroValuefloat();
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
                            int2 texel_2_ = asint(asuint(pixel) + asuint(pixel_2_));
                            int2 texel_3_ = clamp(texel_2_, (int(0)).xx, last);
                            float4 _e139 = depth.Load(int4(texel_3_, int(4), int(0)));
                            float depth_3_ = _e139.x;
                            float shaded_depth = min(depth_3_, 1e30);
                            float4 _e146 = normal.Load(int4(texel_3_, int(4), int(0)));
                            float3 shaded_normal = _e146.xyz;
                            float step_value = abs((seen_depth - shaded_depth));
                            float3 turn = (seen_normal - shaded_normal);
                            float larger = max(step_value, (0.5 * dot(turn, turn)));
                            d = min(larger, 16.0);
                        }
                        int _e157 = tap;
                        float _e159 = d;
                        distances[min(uint(_e157), 8u)] = _e159;
                        float _e160 = nearest;
                        float _e161 = d;
                        float nearest_3_ = min(_e160, _e161);
                        nearest_2_ = nearest_3_;
                    }
                    float _e163 = nearest_2_;
                    nearest = _e163;
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
                    int _e230 = tap_2_;
                    tap_2_ = asint(asuint(_e230) + asuint(int(1)));
                }
                loop_init_3 = false;
                int _e182 = tap_2_;
                if ((_e182 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e185 = tap_2_;
                    int _e190 = tap_2_;
                    int2 pixel_3_ = int2(asint(asuint(naga_mod(_e185, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e190, int(3))) - asuint(int(1))));
                    float2 away_2_ = (float2(pixel_3_) - place_at);
                    float value = (max((1.0 - abs(away_2_.x)), 0.0) * max((1.0 - abs(away_2_.y)), 0.0));
                    float _e211 = sum;
                    sum_2_ = _e211;
                    if ((value > 0.0)) {
                        int _e215 = tap_2_;
                        float value_2_ = distances[min(uint(_e215), 8u)];
                        float _e218 = nearest;
                        float nearness = exp2((-721.34753 * (value_2_ - _e218)));
                        float w = (value * nearness);
                        int _e224 = tap_2_;
                        tap_weights[min(uint(_e224), 8u)] = w;
                        float _e226 = sum;
                        float sum_3_ = (_e226 + w);
                        sum_2_ = sum_3_;
                    }
                    float _e228 = sum_2_;
                    sum = _e228;
                }
            }
            float _e232 = sum;
            float scale = (share / _e232);
            tap_3_ = int(0);
            uint2 loop_bound_4 = uint2(4294967295u, 4294967295u);
            bool loop_init_4 = true;
            while(true) {
                if (all(loop_bound_4 == uint2(0u, 0u))) { break; }
                loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
                if (!loop_init_4) {
                    int _e278 = tap_3_;
                    tap_3_ = asint(asuint(_e278) + asuint(int(1)));
                }
                loop_init_4 = false;
                int _e236 = tap_3_;
                if ((_e236 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e239 = tap_3_;
                    int _e244 = tap_3_;
                    int2 pixel_4_ = int2(asint(asuint(naga_mod(_e239, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e244, int(3))) - asuint(int(1))));
                    float2 away_3_ = (float2(pixel_4_) - place_at);
                    bool holds_4_ = ((max((1.0 - abs(away_3_.x)), 0.0) * max((1.0 - abs(away_3_.y)), 0.0)) > 0.0);
                    if (holds_4_) {
                        int _e267 = tap_3_;
                        float value_3_ = tap_weights[min(uint(_e267), 8u)];
                        int _e270 = tap_3_;
                        float value_4_ = weights[min(uint(_e270), 8u)];
                        float weights_2_ = (value_4_ + (value_3_ * scale));
                        int _e275 = tap_3_;
                        weights[min(uint(_e275), 8u)] = weights_2_;
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
            int _e343 = tap_4_;
            tap_4_ = asint(asuint(_e343) + asuint(int(1)));
        }
        loop_init_5 = false;
        int _e290 = tap_4_;
        if ((_e290 < int(9))) {
        } else {
            break;
        }
        {
            int _e293 = tap_4_;
            int _e298 = tap_4_;
            int2 pixel_5_ = int2(asint(asuint(naga_mod(_e293, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e298, int(3))) - asuint(int(1))));
            int2 pixel_6_ = asint(asuint(pixel) + asuint(pixel_5_));
            int2 texel_4_ = clamp(pixel_6_, (int(0)).xx, last);
            float4 shaded = color.Load(int3(texel_4_, int(0)));
            uint4 value_5_ = (asuint(shaded) & (2147483647u).xxxx);
            w_2_ = 0.0;
            if ((max(max(max(value_5_.x, value_5_.y), value_5_.z), value_5_.w) < 2139095040u)) {
                int _e326 = tap_4_;
                float value_6_ = weights[min(uint(_e326), 8u)];
                w_2_ = value_6_;
            }
            float4 _e329 = result;
            result_2_ = _e329;
            float _e331 = w_2_;
            if ((_e331 != 0.0)) {
                float4 _e334 = result;
                float _e335 = w_2_;
                float4 result_3_ = (_e334 + (_e335 * shaded));
                result_2_ = result_3_;
            }
            float _e338 = sum_4_;
            float _e339 = w_2_;
            float sum_5_ = (_e338 + _e339);
            float4 _e341 = result_2_;
            result = _e341;
            sum_4_ = sum_5_;
        }
    }
    float4 _e346 = result;
    float _e347 = sum_4_;
    destination[pixel] = (_e346 / (max(_e347, 1e-30)).xxxx);
    return;
}
