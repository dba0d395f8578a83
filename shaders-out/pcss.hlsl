Texture2D<float> shadow : register(t0);
SamplerComparisonState shadow_sampler : register(s1);

struct FragmentInput_pcss {
    float3 coord_1 : LOC0;
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

uint2 NagaDepthDimensions2D(Texture2D<float> tex)
{
    uint4 ret;
    tex.GetDimensions(0, ret.x, ret.y, ret.z);
    return ret.xy;
}

float4 pcss(FragmentInput_pcss fragmentinput_pcss) : SV_Target0
{
    float4 position = fragmentinput_pcss.position_1;
    float3 coord = fragmentinput_pcss.coord_1;
    int2 pixel = naga_f2i32(floor(position.xy));
    const float3 _e5 = QuadReadAcrossX(coord);
    float3 row = (coord + _e5);
    const float3 _e7 = QuadReadAcrossY(row);
    float3 centre = ((row + _e7) * (0.25).xxx);
    int2 lane = (pixel & (int(1)).xx);
    float2 quad_vector = ((float2(lane) * (2.0).xx) - (1.0).xx);
    float2 value = (quad_vector + (-2.0).xx);
    float2 value_2_ = float2(centre.x, centre.y);
    int2 shadow_size = int2(NagaDepthDimensions2D(shadow));
    float2 value_3_ = float2(uint2(shadow_size));
    float2 value_4_ = (value_2_ * value_3_);
    float2 place_k0_ = (value_4_ + (value * (2.0).xx));
    int2 last = asint(asuint(shadow_size) - asuint((int(1)).xx));
    const int2 _e42 = to_vec2i(floor(place_k0_));
    int2 texel_k0_ = clamp(_e42, (int(0)).xx, last);
    float depth_k0_ = shadow.Load(int3(texel_k0_, int(0))).x;
    bool blocks_k0_ = (depth_k0_ < centre.z);
    float2 found_k0_ = ((0.0).xx + (blocks_k0_ ? float2(depth_k0_, 1.0) : (0.0).xx));
    float2 value_5_ = (quad_vector + float2(2.0, -2.0));
    float2 place_k1_ = (value_4_ + (value_5_ * (2.0).xx));
    const int2 _e68 = to_vec2i(floor(place_k1_));
    int2 texel_k1_ = clamp(_e68, (int(0)).xx, last);
    float depth_k1_ = shadow.Load(int3(texel_k1_, int(0))).x;
    bool blocks_k1_ = (depth_k1_ < centre.z);
    float2 found_k1_ = (found_k0_ + (blocks_k1_ ? float2(depth_k1_, 1.0) : (0.0).xx));
    float2 value_6_ = (quad_vector + float2(-2.0, 2.0));
    float2 place_k2_ = (value_4_ + (value_6_ * (2.0).xx));
    const int2 _e92 = to_vec2i(floor(place_k2_));
    int2 texel_k2_ = clamp(_e92, (int(0)).xx, last);
    float depth_k2_ = shadow.Load(int3(texel_k2_, int(0))).x;
    bool blocks_k2_ = (depth_k2_ < centre.z);
    float2 found_k2_ = (found_k1_ + (blocks_k2_ ? float2(depth_k2_, 1.0) : (0.0).xx));
    float2 value_7_ = (quad_vector + (2.0).xx);
    float2 place_k3_ = (value_4_ + (value_7_ * (2.0).xx));
    const int2 _e115 = to_vec2i(floor(place_k3_));
    int2 texel_k3_ = clamp(_e115, (int(0)).xx, last);
    float depth_k3_ = shadow.Load(int3(texel_k3_, int(0))).x;
    bool blocks_k3_ = (depth_k3_ < centre.z);
    float2 found_k3_ = (found_k2_ + (blocks_k3_ ? float2(depth_k3_, 1.0) : (0.0).xx));
    const float2 _e130 = QuadReadAcrossX(found_k3_);
    float2 row_2_ = (found_k3_ + _e130);
    const float2 _e132 = QuadReadAcrossY(row_2_);
    float2 value_8_ = (row_2_ + _e132);
    float distance_value = (centre.z - (value_8_.x / max(value_8_.y, 1.0)));
    float width = clamp((distance_value * 400.0), 2.0, 24.0);
    float width_2_ = ((value_8_.y > 0.5) ? width : 2.0);
    float2 value_9_ = ((width_2_ * 0.125)).xx;
    float2 place_k0_2_ = ((value * (width_2_ * 0.125)) / value_3_);
    float shadow_texel = shadow.SampleCmpLevelZero(shadow_sampler, (value_2_ + place_k0_2_), centre.z);
    float sum_k0_ = (0.0 + shadow_texel);
    float2 place_k1_2_ = ((value_5_ * (width_2_ * 0.125)) / value_3_);
    float shadow_texel_2_ = shadow.SampleCmpLevelZero(shadow_sampler, (value_2_ + place_k1_2_), centre.z);
    float sum_k1_ = (sum_k0_ + shadow_texel_2_);
    float2 place_k2_2_ = ((value_6_ * (width_2_ * 0.125)) / value_3_);
    float shadow_texel_3_ = shadow.SampleCmpLevelZero(shadow_sampler, (value_2_ + place_k2_2_), centre.z);
    float sum_k2_ = (sum_k1_ + shadow_texel_3_);
    float2 place_k3_2_ = ((value_7_ * (width_2_ * 0.125)) / value_3_);
    float shadow_texel_4_ = shadow.SampleCmpLevelZero(shadow_sampler, (value_2_ + place_k3_2_), centre.z);
    float sum_k3_ = (sum_k2_ + shadow_texel_4_);
    const float _e195 = QuadReadAcrossX(sum_k3_);
    float row_3_ = (sum_k3_ + _e195);
    const float _e197 = QuadReadAcrossY(row_3_);
    float lit_ = (((row_3_ + _e197) * 0.25) * 0.25);
    return (lit_).xxxx;
}
