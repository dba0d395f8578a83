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
    float2 a = frac(((centre.xy * size) - (0.5).xx));
    float2 quad_vector = ((float2((pixel & (int(1)).xx)) * 2.0) - (1.0).xx);
    float2 taps_middle_k0_ = (quad_vector - (2.0).xx);
    float2 first_k0_ = (taps_middle_k0_ - a);
    float2 x = (abs(first_k0_) * 0.375);
    float2 outer = max(((1.5).xx - x), (0.0).xx);
    float2 inner = max(((0.5).xx - x), (0.0).xx);
    float2 x_2_ = (abs((first_k0_ + (1.0).xx)) * 0.375);
    float2 outer_2_ = max(((1.5).xx - x_2_), (0.0).xx);
    float2 inner_2_ = max(((0.5).xx - x_2_), (0.0).xx);
    float2 w1_ = (((outer_2_ * outer_2_) * 0.5) - ((inner_2_ * inner_2_) * 1.5));
    float2 weight = ((((outer * outer) * 0.5) - ((inner * inner) * 1.5)) + w1_);
    float2 column_place = (first_k0_ + (w1_ / weight));
    float2 sum = (centre.xy + (column_place / size));
    float taps_lit_k0_ = shadow.SampleCmpLevelZero(shadow_sampler, sum, centre.z);
    float taps_weight_k0_ = (weight.x * weight.y);
    float2 taps_middle_k3_ = (quad_vector + (2.0).xx);
    float2 first_k1_ = (taps_middle_k3_ - a);
    float2 x_3_ = (abs(first_k1_) * 0.375);
    float2 outer_3_ = max(((1.5).xx - x_3_), (0.0).xx);
    float2 inner_3_ = max(((0.5).xx - x_3_), (0.0).xx);
    float2 x_4_ = (abs((first_k1_ + (1.0).xx)) * 0.375);
    float2 outer_4_ = max(((1.5).xx - x_4_), (0.0).xx);
    float2 inner_4_ = max(((0.5).xx - x_4_), (0.0).xx);
    float2 w1_2_ = (((outer_4_ * outer_4_) * 0.5) - ((inner_4_ * inner_4_) * 1.5));
    float2 weight_2_ = ((((outer_3_ * outer_3_) * 0.5) - ((inner_3_ * inner_3_) * 1.5)) + w1_2_);
    float2 column_place_2_ = (first_k1_ + (w1_2_ / weight_2_));
    float2 place_k1_ = float2(column_place_2_.x, column_place.y);
    float2 sum_2_ = (centre.xy + (place_k1_ / size));
    float taps_lit_k1_ = shadow.SampleCmpLevelZero(shadow_sampler, sum_2_, centre.z);
    float taps_weight_k1_ = (weight_2_.x * weight.y);
    float2 place_k2_ = float2(column_place.x, column_place_2_.y);
    float2 sum_3_ = (centre.xy + (place_k2_ / size));
    float taps_lit_k2_ = shadow.SampleCmpLevelZero(shadow_sampler, sum_3_, centre.z);
    float taps_weight_k2_ = (weight.x * weight_2_.y);
    float2 sum_4_ = (centre.xy + (column_place_2_ / size));
    float taps_lit_k3_ = shadow.SampleCmpLevelZero(shadow_sampler, sum_4_, centre.z);
    float taps_weight_k3_ = (weight_2_.x * weight_2_.y);
    float4 vector_ = float4((column_place * taps_weight_k0_), taps_weight_k0_, (taps_lit_k0_ * taps_weight_k0_));
    float4 vector_2_ = float4((place_k1_ * taps_weight_k1_), taps_weight_k1_, (taps_lit_k1_ * taps_weight_k1_));
    float4 vector_3_ = float4((place_k2_ * taps_weight_k2_), taps_weight_k2_, (taps_lit_k2_ * taps_weight_k2_));
    float4 vector_4_ = float4((column_place_2_ * taps_weight_k3_), taps_weight_k3_, (taps_lit_k3_ * taps_weight_k3_));
    float4 sums_k3_ = (((((0.0).xxxx + vector_) + vector_2_) + vector_3_) + vector_4_);
    const float4 _e202 = QuadReadAcrossX(sums_k3_);
    float4 row_2_ = (sums_k3_ + _e202);
    const float4 _e204 = QuadReadAcrossY(row_2_);
    float4 sums = (row_2_ + _e204);
    float2 product = ((quad_vector + float2(2.0, -2.0)) * taps_lit_k1_);
    float2 product_2_ = ((quad_vector + float2(-2.0, 2.0)) * taps_lit_k2_);
    float2 moment_k2_ = ((((0.0).xx + (taps_middle_k0_ * taps_lit_k0_)) + product) + product_2_);
    float2 moment_k3_ = (moment_k2_ + (taps_middle_k3_ * taps_lit_k3_));
    const float2 _e224 = QuadReadAcrossX(moment_k3_);
    float2 row_3_ = (moment_k3_ + _e224);
    float2 difference = (((coord.xy - centre.xy) * size) - (sums.xy / (sums.z).xx));
    const float2 _e238 = QuadReadAcrossY(row_3_);
    float lit_ = saturate(((sums.w / sums.z) + dot(((row_3_ + _e238) / (80.0).xx), difference)));
    return (lit_).xxxx;
}
