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
    float3 centre = ((row + _e7) * 0.25);
    float2 quad_vector = ((float2((pixel & (int(1)).xx)) * 2.0) - (1.0).xx);
    float2 at_k0_ = (quad_vector - (2.0).xx);
    int2 shadow_size = int2(NagaDepthDimensions2D(shadow));
    float2 as_float = float2(shadow_size);
    float2 product = (centre.xy * as_float);
    int2 last = asint(asuint(shadow_size) - asuint((int(1)).xx));
    const int2 _e36 = to_vec2i(floor((product + (at_k0_ * 2.0))));
    int2 texel_k0_ = clamp(_e36, (int(0)).xx, last);
    float depth_k0_ = shadow.Load(int3(texel_k0_, int(0))).x;
    float2 found_k0_ = ((0.0).xx + ((depth_k0_ < centre.z) ? float2(depth_k0_, 1.0) : (0.0).xx));
    float2 at_k1_ = (quad_vector + float2(2.0, -2.0));
    const int2 _e61 = to_vec2i(floor((product + (at_k1_ * 2.0))));
    int2 texel_k1_ = clamp(_e61, (int(0)).xx, last);
    float depth_k1_ = shadow.Load(int3(texel_k1_, int(0))).x;
    float2 found_k1_ = (found_k0_ + ((depth_k1_ < centre.z) ? float2(depth_k1_, 1.0) : (0.0).xx));
    float2 at_k2_ = (quad_vector + float2(-2.0, 2.0));
    const int2 _e84 = to_vec2i(floor((product + (at_k2_ * 2.0))));
    int2 texel_k2_ = clamp(_e84, (int(0)).xx, last);
    float depth_k2_ = shadow.Load(int3(texel_k2_, int(0))).x;
    float2 found_k2_ = (found_k1_ + ((depth_k2_ < centre.z) ? float2(depth_k2_, 1.0) : (0.0).xx));
    float2 at_k3_ = (quad_vector + (2.0).xx);
    const int2 _e106 = to_vec2i(floor((product + (at_k3_ * 2.0))));
    int2 texel_k3_ = clamp(_e106, (int(0)).xx, last);
    float depth_k3_ = shadow.Load(int3(texel_k3_, int(0))).x;
    float2 found_k3_ = (found_k2_ + ((depth_k3_ < centre.z) ? float2(depth_k3_, 1.0) : (0.0).xx));
    const float2 _e121 = QuadReadAcrossX(found_k3_);
    float2 row_2_ = (found_k3_ + _e121);
    const float2 _e123 = QuadReadAcrossY(row_2_);
    float2 found = (row_2_ + _e123);
    float width = clamp(((centre.z - (found.x / max(found.y, 1.0))) * 400.0), 2.0, 24.0);
    float product_2_ = (((found.y > 0.5) ? width : 2.0) * 0.125);
    float2 sum = (centre.xy + ((at_k0_ * product_2_) / as_float));
    float _e151 = shadow.SampleCmpLevelZero(shadow_sampler, sum, centre.z);
    float sum_k0_ = (0.0 + _e151);
    float2 sum_2_ = (centre.xy + ((at_k1_ * product_2_) / as_float));
    float _e161 = shadow.SampleCmpLevelZero(shadow_sampler, sum_2_, centre.z);
    float sum_k1_ = (sum_k0_ + _e161);
    float2 sum_3_ = (centre.xy + ((at_k2_ * product_2_) / as_float));
    float _e170 = shadow.SampleCmpLevelZero(shadow_sampler, sum_3_, centre.z);
    float sum_k2_ = (sum_k1_ + _e170);
    float2 sum_4_ = (centre.xy + ((at_k3_ * product_2_) / as_float));
    float _e179 = shadow.SampleCmpLevelZero(shadow_sampler, sum_4_, centre.z);
    float sum_k3_ = (sum_k2_ + _e179);
    const float _e181 = QuadReadAcrossX(sum_k3_);
    float row_3_ = (sum_k3_ + _e181);
    const float _e183 = QuadReadAcrossY(row_3_);
    return ((((row_3_ + _e183) * 0.25) * 0.25)).xxxx;
}
