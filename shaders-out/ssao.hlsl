Texture2D<float4> depth : register(t0);
Texture2D<float4> normal : register(t1);

struct FragmentInput_quad_ssao {
    float4 position_1 : SV_Position;
};

int2 naga_f2i32(float2 value) {
    return int2(clamp(value, -2147483600.0, 2147483500.0));
}

int2 to_vec2i(float2 x)
{
    bool2 is_nan = ((asuint(x) & (2147483647u).xx) > (2139095040u).xx);
    int2 saturated = ((x >= (2147483600.0).xx) ? (int(2147483647)).xx : naga_f2i32(x));
    return (is_nan ? (int(0)).xx : saturated);
}

uint2 NagaDimensions2D(Texture2D<float4> tex)
{
    uint4 ret;
    tex.GetDimensions(0, ret.x, ret.y, ret.z);
    return ret.xy;
}

float4 quad_ssao(FragmentInput_quad_ssao fragmentinput_quad_ssao) : SV_Target0
{
    float4 position = fragmentinput_quad_ssao.position_1;
    int2 pixel = naga_f2i32(floor(position.xy));
    int2 frame = int2(NagaDimensions2D(depth));
    int2 last = asint(asuint(frame) - asuint((int(1)).xx));
    int2 texel = clamp(pixel, (int(0)).xx, last);
    float4 _e15 = depth.Load(int3(texel, int(0)));
    float z = _e15.x;
    float2 place_middle = (float2(frame) * 0.5);
    float3 place_from = float3((((float2(pixel) + (0.5).xx) - place_middle) * (z * 0.005)), z);
    float4 _e31 = normal.Load(int3(texel, int(0)));
    float3 place_normal = _e31.xyz;
    float place_reach = min((0.5 / (0.005 * z)), 48.0);
    int2 lane = (pixel & (int(1)).xx);
    bool differs = (lane.x != int(0));
    bool differs_2_ = (lane.y != int(0));
    float2 selection = (differs ? float2(-0.06912833, 0.06332722) : float2(0.03125, 0.0));
    float2 selection_2_ = (differs ? float2(0.13309608, 0.17360009) : float2(0.013660241, -0.15565173));
    const int2 _e68 = to_vec2i(floor((((differs_2_ ? selection_2_ : selection) * place_reach) + (0.5).xx)));
    int2 tap_k0_ = asint(asuint(pixel) + asuint(_e68));
    float4 _e75 = depth.Load(int3(clamp(tap_k0_, (int(0)).xx, last), int(0)));
    float z_k0_ = _e75.x;
    float3 to_k0_ = (float3((((float2(tap_k0_) + (0.5).xx) - place_middle) * (z_k0_ * 0.005)), z_k0_) - place_from);
    float squared_k0_ = dot(to_k0_, to_k0_);
    float larger = max(((dot(to_k0_, place_normal) * rsqrt(max(squared_k0_, 1e-12))) - 0.05), 0.0);
    float own_k0_ = (0.0 + (larger * max((1.0 - (squared_k0_ / 0.25)), 0.0)));
    float2 selection_3_ = (differs ? float2(0.29004085, -0.18450032) : float2(-0.2769507, -0.048988573));
    float2 selection_4_ = (differs ? float2(-0.21605052, -0.41599125) : float2(-0.10546385, 0.39232185));
    const int2 _e126 = to_vec2i(floor((((differs_2_ ? selection_4_ : selection_3_) * place_reach) + (0.5).xx)));
    int2 tap_k1_ = asint(asuint(pixel) + asuint(_e126));
    float4 _e133 = depth.Load(int3(clamp(tap_k1_, (int(0)).xx, last), int(0)));
    float z_k1_ = _e133.x;
    float3 to_k1_ = (float3((((float2(tap_k1_) + (0.5).xx) - place_middle) * (z_k1_ * 0.005)), z_k1_) - place_from);
    float squared_k1_ = dot(to_k1_, to_k1_);
    float larger_2_ = max(((dot(to_k1_, place_normal) * rsqrt(max(squared_k1_, 1e-12))) - 0.05), 0.0);
    float own_k1_ = (own_k0_ + (larger_2_ * max((1.0 - (squared_k1_ / 0.25)), 0.0)));
    float2 selection_5_ = (differs ? float2(-0.54883003, 0.22654943) : float2(0.49901456, 0.18223892));
    float2 selection_6_ = (differs ? float2(0.21511047, 0.6858054) : float2(0.27814868, -0.5943882));
    const int2 _e183 = to_vec2i(floor((((differs_2_ ? selection_6_ : selection_5_) * place_reach) + (0.5).xx)));
    int2 tap_k2_ = asint(asuint(pixel) + asuint(_e183));
    float4 _e190 = depth.Load(int3(clamp(tap_k2_, (int(0)).xx, last), int(0)));
    float z_k2_ = _e190.x;
    float3 to_k2_ = (float3((((float2(tap_k2_) + (0.5).xx) - place_middle) * (z_k2_ * 0.005)), z_k2_) - place_from);
    float squared_k2_ = dot(to_k2_, to_k2_);
    float larger_3_ = max(((dot(to_k2_, place_normal) * rsqrt(max(squared_k2_, 1e-12))) - 0.05), 0.0);
    float own_k2_ = (own_k1_ + (larger_3_ * max((1.0 - (squared_k2_ / 0.25)), 0.0)));
    float2 selection_7_ = (differs ? float2(0.82406986, -0.18117106) : float2(-0.675947, -0.3917233));
    float2 selection_8_ = (differs ? float2(-0.124496244, -0.960717) : float2(-0.5212098, 0.74136996));
    const int2 _e240 = to_vec2i(floor((((differs_2_ ? selection_8_ : selection_7_) * place_reach) + (0.5).xx)));
    int2 tap_k3_ = asint(asuint(pixel) + asuint(_e240));
    float4 _e247 = depth.Load(int3(clamp(tap_k3_, (int(0)).xx, last), int(0)));
    float z_k3_ = _e247.x;
    float3 to_k3_ = (float3((((float2(tap_k3_) + (0.5).xx) - place_middle) * (z_k3_ * 0.005)), z_k3_) - place_from);
    float squared_k3_ = dot(to_k3_, to_k3_);
    float larger_4_ = max(((dot(to_k3_, place_normal) * rsqrt(max(squared_k3_, 1e-12))) - 0.05), 0.0);
    float sum = ((own_k2_ + (larger_4_ * max((1.0 - (squared_k3_ / 0.25)), 0.0))) / 4.0);
    float2 messages_0_ = float2(sum, z);
    const float2 _e280 = QuadReadAcrossX(messages_0_);
    const float2 _e281 = QuadReadAcrossY(messages_0_);
    const float2 _e282 = QuadReadAcrossDiagonal(messages_0_);
    float away_k1_ = ((_e280.y - z) / 0.1);
    float weight_k1_ = exp2(((away_k1_ * away_k1_) * -0.7213475));
    float away_k2_ = ((_e281.y - z) / 0.1);
    float weight_k2_ = exp2(((away_k2_ * away_k2_) * -0.7213475));
    float sum_k2_ = ((sum + (_e280.x * weight_k1_)) + (_e281.x * weight_k2_));
    float away_k3_ = ((_e282.y - z) / 0.1);
    float weight_k3_ = exp2(((away_k3_ * away_k3_) * -0.7213475));
    float occluded = ((sum_k2_ + (_e282.x * weight_k3_)) / (((1.0 + weight_k1_) + weight_k2_) + weight_k3_));
    return (saturate((1.0 - (occluded * 2.0)))).xxxx;
}
