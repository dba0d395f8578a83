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
    float2 place_middle = (float2(uint2(frame)) * (0.5).xx);
    float2 value = (((float2(pixel) + (0.5).xx) - place_middle) * (z * 0.005));
    float3 place_from = float3(value.x, value.y, z);
    float4 _e35 = normal.Load(int3(texel, int(0)));
    float3 place_normal = _e35.xyz;
    float place_reach = min((0.5 / (0.005 * z)), 48.0);
    int2 lane = (pixel & (int(1)).xx);
    bool holds = (lane.x != int(0));
    bool holds_2_ = (lane.y != int(0));
    float2 way_k0_ = (holds_2_ ? (holds ? float2(0.13309608, 0.17360009) : float2(0.013660241, -0.15565173)) : (holds ? float2(-0.06912833, 0.06332722) : float2(0.03125, 0.0)));
    const int2 _e72 = to_vec2i(floor(((way_k0_ * place_reach) + (0.5).xx)));
    int2 tap_k0_ = asint(asuint(pixel) + asuint(_e72));
    int2 texel_k0_ = clamp(tap_k0_, (int(0)).xx, last);
    float4 _e79 = depth.Load(int3(texel_k0_, int(0)));
    float depth_texel = _e79.x;
    float2 value_2_ = (((float2(tap_k0_) + (0.5).xx) - place_middle) * (depth_texel * 0.005));
    float3 to_k0_ = (float3(value_2_.x, value_2_.y, depth_texel) - place_from);
    float squared_k0_ = dot(to_k0_, to_k0_);
    float cosine_k0_ = (dot(to_k0_, place_normal) * rsqrt(max(squared_k0_, 1e-12)));
    float near_k0_ = max((1.0 - (squared_k0_ / 0.25)), 0.0);
    float own_k0_ = (0.0 + (max((cosine_k0_ - 0.05), 0.0) * near_k0_));
    float2 way_k1_ = (holds_2_ ? (holds ? float2(-0.21605052, -0.41599125) : float2(-0.10546385, 0.39232185)) : (holds ? float2(0.29004085, -0.18450032) : float2(-0.2769507, -0.048988573)));
    const int2 _e132 = to_vec2i(floor(((way_k1_ * place_reach) + (0.5).xx)));
    int2 tap_k1_ = asint(asuint(pixel) + asuint(_e132));
    int2 texel_k1_ = clamp(tap_k1_, (int(0)).xx, last);
    float4 _e139 = depth.Load(int3(texel_k1_, int(0)));
    float depth_texel_2_ = _e139.x;
    float2 value_3_ = (((float2(tap_k1_) + (0.5).xx) - place_middle) * (depth_texel_2_ * 0.005));
    float3 to_k1_ = (float3(value_3_.x, value_3_.y, depth_texel_2_) - place_from);
    float squared_k1_ = dot(to_k1_, to_k1_);
    float cosine_k1_ = (dot(to_k1_, place_normal) * rsqrt(max(squared_k1_, 1e-12)));
    float near_k1_ = max((1.0 - (squared_k1_ / 0.25)), 0.0);
    float own_k1_ = (own_k0_ + (max((cosine_k1_ - 0.05), 0.0) * near_k1_));
    float2 way_k2_ = (holds_2_ ? (holds ? float2(0.21511047, 0.6858054) : float2(0.27814868, -0.5943882)) : (holds ? float2(-0.54883003, 0.22654943) : float2(0.49901456, 0.18223892)));
    const int2 _e191 = to_vec2i(floor(((way_k2_ * place_reach) + (0.5).xx)));
    int2 tap_k2_ = asint(asuint(pixel) + asuint(_e191));
    int2 texel_k2_ = clamp(tap_k2_, (int(0)).xx, last);
    float4 _e198 = depth.Load(int3(texel_k2_, int(0)));
    float depth_texel_3_ = _e198.x;
    float2 value_4_ = (((float2(tap_k2_) + (0.5).xx) - place_middle) * (depth_texel_3_ * 0.005));
    float3 to_k2_ = (float3(value_4_.x, value_4_.y, depth_texel_3_) - place_from);
    float squared_k2_ = dot(to_k2_, to_k2_);
    float cosine_k2_ = (dot(to_k2_, place_normal) * rsqrt(max(squared_k2_, 1e-12)));
    float near_k2_ = max((1.0 - (squared_k2_ / 0.25)), 0.0);
    float own_k2_ = (own_k1_ + (max((cosine_k2_ - 0.05), 0.0) * near_k2_));
    float2 way_k3_ = (holds_2_ ? (holds ? float2(-0.124496244, -0.960717) : float2(-0.5212098, 0.74136996)) : (holds ? float2(0.82406986, -0.18117106) : float2(-0.675947, -0.3917233)));
    const int2 _e250 = to_vec2i(floor(((way_k3_ * place_reach) + (0.5).xx)));
    int2 tap_k3_ = asint(asuint(pixel) + asuint(_e250));
    int2 texel_k3_ = clamp(tap_k3_, (int(0)).xx, last);
    float4 _e257 = depth.Load(int3(texel_k3_, int(0)));
    float depth_texel_4_ = _e257.x;
    float2 value_5_ = (((float2(tap_k3_) + (0.5).xx) - place_middle) * (depth_texel_4_ * 0.005));
    float3 to_k3_ = (float3(value_5_.x, value_5_.y, depth_texel_4_) - place_from);
    float squared_k3_ = dot(to_k3_, to_k3_);
    float cosine_k3_ = (dot(to_k3_, place_normal) * rsqrt(max(squared_k3_, 1e-12)));
    float near_k3_ = max((1.0 - (squared_k3_ / 0.25)), 0.0);
    float own_k3_ = (own_k2_ + (max((cosine_k3_ - 0.05), 0.0) * near_k3_));
    float sum = (own_k3_ / 4.0);
    float2 messages_0_ = float2(sum, z);
    const float2 _e292 = QuadReadAcrossX(messages_0_);
    const float2 _e293 = QuadReadAcrossY(messages_0_);
    const float2 _e294 = QuadReadAcrossDiagonal(messages_0_);
    float away_k1_ = ((_e292.y - z) / 0.1);
    float weight_k1_ = exp2(((away_k1_ * away_k1_) * -0.7213475));
    float sum_k1_ = (sum + (_e292.x * weight_k1_));
    float total_k1_ = (1.0 + weight_k1_);
    float away_k2_ = ((_e293.y - z) / 0.1);
    float weight_k2_ = exp2(((away_k2_ * away_k2_) * -0.7213475));
    float sum_k2_ = (sum_k1_ + (_e293.x * weight_k2_));
    float total_k2_ = (total_k1_ + weight_k2_);
    float away_k3_ = ((_e294.y - z) / 0.1);
    float weight_k3_ = exp2(((away_k3_ * away_k3_) * -0.7213475));
    float sum_k3_ = (sum_k2_ + (_e294.x * weight_k3_));
    float total_k3_ = (total_k2_ + weight_k3_);
    float occluded = (sum_k3_ / total_k3_);
    return (saturate((1.0 - (occluded * 2.0)))).xxxx;
}
