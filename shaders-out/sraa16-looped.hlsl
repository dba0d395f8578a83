typedef int2 ret_Constructarray16_int2_[16];
ret_Constructarray16_int2_ Constructarray16_int2_(int2 arg0, int2 arg1, int2 arg2, int2 arg3, int2 arg4, int2 arg5, int2 arg6, int2 arg7, int2 arg8, int2 arg9, int2 arg10, int2 arg11, int2 arg12, int2 arg13, int2 arg14, int2 arg15) {
    int2 ret[16] = { arg0, arg1, arg2, arg3, arg4, arg5, arg6, arg7, arg8, arg9, arg10, arg11, arg12, arg13, arg14, arg15 };
    return ret;
}

static const int2 table[16] = Constructarray16_int2_((int(1)).xx, int2(int(-1), int(-3)), int2(int(-3), int(2)), int2(int(4), int(-1)), int2(int(-5), int(-2)), int2(int(2), int(5)), int2(int(5), int(3)), int2(int(3), int(-5)), int2(int(-2), int(6)), int2(int(0), int(-7)), int2(int(-4), int(-6)), int2(int(-6), int(4)), int2(int(-8), int(0)), int2(int(7), int(-4)), int2(int(6), int(7)), int2(int(-7), int(-8)));

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
    float weights[9] = Constructarray9_float_(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    int sample_value = int(0);
    float distances[9] = (float[9])0;
    float nearest = (float)0;
    int tap = (int)0;
    float nearest_2_ = (float)0;
    float d = (float)0;
    bool local = (bool)0;
    float sum = (float)0;
    float tap_weights[9] = (float[9])0;
    int tap_2_ = (int)0;
    float sum_2_ = (float)0;
    int tap_3_ = (int)0;
    float4 result = (0.0).xxxx;
    int tap_4_ = int(0);
    float4 result_2_ = (float4)0;

    int2 frame = int2(NagaRWDimensions2D(destination));
    int2 pixel = int2(id.xy);
    if (any((pixel >= frame))) {
        return;
    }
    int2 last = asint(asuint(frame) - asuint((int(1)).xx));
    uint2 loop_bound = uint2(4294967295u, 4294967295u);
    bool loop_init = true;
    while(true) {
        if (all(loop_bound == uint2(0u, 0u))) { break; }
        loop_bound -= uint2(loop_bound.y == 0u, 1u);
        if (!loop_init) {
            int _e263 = sample_value;
            sample_value = asint(asuint(_e263) + asuint(int(1)));
        }
        loop_init = false;
        int _e24 = sample_value;
        if ((_e24 < int(16))) {
        } else {
            break;
        }
        {
            int _e28 = sample_value;
            float4 _e30 = depth.Load(int4(pixel, _e28, int(0)));
            float depth_texel = _e30.x;
            float centre_depth = min(depth_texel, 1e30);
            int _e35 = sample_value;
            float4 _e37 = normal.Load(int4(pixel, _e35, int(0)));
            float3 centre_normal = _e37.xyz;
            int _e40 = sample_value;
            int2 texel = table[min(uint(_e40), 15u)];
            float2 value = (float2(texel) / (16.0).xx);
            int _e46 = sample_value;
            bool holds = (_e46 == int(16));
            distances = Constructarray9_float_(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
            nearest = 16.0;
            tap = int(0);
            uint2 loop_bound_1 = uint2(4294967295u, 4294967295u);
            bool loop_init_1 = true;
            while(true) {
                if (all(loop_bound_1 == uint2(0u, 0u))) { break; }
                loop_bound_1 -= uint2(loop_bound_1.y == 0u, 1u);
                if (!loop_init_1) {
                    int _e142 = tap;
                    tap = asint(asuint(_e142) + asuint(int(1)));
                }
                loop_init_1 = false;
                int _e64 = tap;
                if ((_e64 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e67 = tap;
                    int _e72 = tap;
                    int2 texel_2_ = int2(asint(asuint(naga_mod(_e67, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e72, int(3))) - asuint(int(1))));
                    float2 away = abs(((float2(texel_2_) + (0.0).xx) - value));
                    float _e84 = nearest;
                    nearest_2_ = _e84;
                    if (((max((1.0 - away.x), 0.0) * max((1.0 - away.y), 0.0)) > 0.0)) {
                        d = ZeroValuefloat();
                        int _e101 = tap;
                        if ((_e101 == int(4))) {
                            local = holds;
                        } else {
                            local = false;
                        }
                        bool _e107 = local;
                        if (_e107) {
                            d = 0.0;
                        } else {
                            int2 texel_3_ = clamp(asint(asuint(pixel) + asuint(texel_2_)), (int(0)).xx, last);
                            float4 _e116 = depth.Load(int4(texel_3_, int(16), int(0)));
                            float depth_texel_2_ = _e116.x;
                            float shaded_depth = min(depth_texel_2_, 1e30);
                            float4 _e123 = normal.Load(int4(texel_3_, int(16), int(0)));
                            float3 shaded_normal = _e123.xyz;
                            float depths = abs((centre_depth - shaded_depth));
                            float3 apart = (centre_normal - shaded_normal);
                            float larger = max(depths, (0.5 * dot(apart, apart)));
                            d = min(larger, 16.0);
                        }
                        int _e134 = tap;
                        float _e136 = d;
                        distances[min(uint(_e134), 8u)] = _e136;
                        float _e137 = nearest;
                        float _e138 = d;
                        float nearest_3_ = min(_e137, _e138);
                        nearest_2_ = nearest_3_;
                    }
                    float _e140 = nearest_2_;
                    nearest = _e140;
                }
            }
            sum = 0.0;
            tap_weights = Constructarray9_float_(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
            tap_2_ = int(0);
            uint2 loop_bound_2 = uint2(4294967295u, 4294967295u);
            bool loop_init_2 = true;
            while(true) {
                if (all(loop_bound_2 == uint2(0u, 0u))) { break; }
                loop_bound_2 -= uint2(loop_bound_2.y == 0u, 1u);
                if (!loop_init_2) {
                    int _e209 = tap_2_;
                    tap_2_ = asint(asuint(_e209) + asuint(int(1)));
                }
                loop_init_2 = false;
                int _e159 = tap_2_;
                if ((_e159 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e162 = tap_2_;
                    int _e167 = tap_2_;
                    float2 value_2_ = ((float2(int2(asint(asuint(naga_mod(_e162, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e167, int(3))) - asuint(int(1))))) + (0.0).xx) - value);
                    float2 away_2_ = abs(value_2_);
                    float value_3_ = (max((1.0 - away_2_.x), 0.0) * max((1.0 - away_2_.y), 0.0));
                    float _e190 = sum;
                    sum_2_ = _e190;
                    if ((value_3_ > 0.0)) {
                        int _e194 = tap_2_;
                        float value_4_ = distances[min(uint(_e194), 8u)];
                        float _e197 = nearest;
                        float w = (value_3_ * exp2((-721.34753 * (value_4_ - _e197))));
                        int _e203 = tap_2_;
                        tap_weights[min(uint(_e203), 8u)] = w;
                        float _e205 = sum;
                        float sum_3_ = (_e205 + w);
                        sum_2_ = sum_3_;
                    }
                    float _e207 = sum_2_;
                    sum = _e207;
                }
            }
            float _e211 = sum;
            float scale = (0.0625 / _e211);
            tap_3_ = int(0);
            uint2 loop_bound_3 = uint2(4294967295u, 4294967295u);
            bool loop_init_3 = true;
            while(true) {
                if (all(loop_bound_3 == uint2(0u, 0u))) { break; }
                loop_bound_3 -= uint2(loop_bound_3.y == 0u, 1u);
                if (!loop_init_3) {
                    int _e260 = tap_3_;
                    tap_3_ = asint(asuint(_e260) + asuint(int(1)));
                }
                loop_init_3 = false;
                int _e216 = tap_3_;
                if ((_e216 < int(9))) {
                } else {
                    break;
                }
                {
                    int _e219 = tap_3_;
                    int _e224 = tap_3_;
                    float2 value_5_ = ((float2(int2(asint(asuint(naga_mod(_e219, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e224, int(3))) - asuint(int(1))))) + (0.0).xx) - value);
                    float2 away_3_ = abs(value_5_);
                    if (((max((1.0 - away_3_.x), 0.0) * max((1.0 - away_3_.y), 0.0)) > 0.0)) {
                        int _e249 = tap_3_;
                        float value_6_ = tap_weights[min(uint(_e249), 8u)];
                        int _e252 = tap_3_;
                        float value_7_ = weights[min(uint(_e252), 8u)];
                        float weights_2_ = (value_7_ + (value_6_ * scale));
                        int _e257 = tap_3_;
                        weights[min(uint(_e257), 8u)] = weights_2_;
                    }
                }
            }
        }
    }
    uint2 loop_bound_4 = uint2(4294967295u, 4294967295u);
    bool loop_init_4 = true;
    while(true) {
        if (all(loop_bound_4 == uint2(0u, 0u))) { break; }
        loop_bound_4 -= uint2(loop_bound_4.y == 0u, 1u);
        if (!loop_init_4) {
            int _e303 = tap_4_;
            tap_4_ = asint(asuint(_e303) + asuint(int(1)));
        }
        loop_init_4 = false;
        int _e270 = tap_4_;
        if ((_e270 < int(9))) {
        } else {
            break;
        }
        {
            int _e273 = tap_4_;
            float value_8_ = weights[min(uint(_e273), 8u)];
            float4 _e276 = result;
            result_2_ = _e276;
            if ((value_8_ != 0.0)) {
                int _e280 = tap_4_;
                int _e285 = tap_4_;
                int2 texel_4_ = clamp(asint(asuint(pixel) + asuint(int2(asint(asuint(naga_mod(_e280, int(3))) - asuint(int(1))), asint(asuint(naga_div(_e285, int(3))) - asuint(int(1)))))), (int(0)).xx, last);
                float4 shaded = color.Load(int3(texel_4_, int(0)));
                float4 _e298 = result;
                float4 result_3_ = (_e298 + (value_8_ * shaded));
                result_2_ = result_3_;
            }
            float4 _e301 = result_2_;
            result = _e301;
        }
    }
    float4 _e306 = result;
    destination[pixel] = _e306;
    return;
}
