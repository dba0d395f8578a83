Texture2D<float> shadow : register(t0);
SamplerComparisonState shadow_sampler : register(s1);

struct FragmentInput_pcf {
    float3 coord_1 : LOC0;
    float4 position_1 : SV_Position;
};

int2 naga_f2i32(float2 value) {
    return int2(clamp(value, -2147483600.0, 2147483500.0));
}

uint2 NagaDepthDimensions2D(Texture2D<float> tex)
{
    uint4 ret;
    tex.GetDimensions(0, ret.x, ret.y, ret.z);
    return ret.xy;
}

float4 pcf(FragmentInput_pcf fragmentinput_pcf) : SV_Target0
{
    float4 position = fragmentinput_pcf.position_1;
    float3 coord = fragmentinput_pcf.coord_1;
    int2 pixel = naga_f2i32(floor(position.xy));
    const float3 _e5 = QuadReadAcrossX(coord);
    float3 row = (coord + _e5);
    const float3 _e7 = QuadReadAcrossY(row);
    float3 centre = ((row + _e7) * 0.25);
    float2 size = float2(int2(NagaDepthDimensions2D(shadow)));
    float2 first_k0_ = ((((float2((pixel & (int(1)).xx)) * 2.0) - (1.0).xx) + (0.0).xx) - frac(((centre.xy * size) - (0.5).xx)));
    float2 column_place_k0_ = (first_k0_ + (0.5).xx);
    float2 sum = (centre.xy + (column_place_k0_ / size));
    float taps_lit_k0_ = shadow.SampleCmpLevelZero(shadow_sampler, sum, centre.z);
    float4 sums_k0_ = ((0.0).xxxx + float4(column_place_k0_, 1.0, taps_lit_k0_));
    const float _e51 = QuadReadAcrossX(sums_k0_.w);
    float row_2_ = (sums_k0_.w + _e51);
    const float _e53 = QuadReadAcrossY(row_2_);
    return (((row_2_ + _e53) * 0.25)).xxxx;
}
