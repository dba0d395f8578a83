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
    float3 centre = ((row + _e7) * (0.25).xxx);
    float2 size = float2(uint2(int2(NagaDepthDimensions2D(shadow))));
    float2 value = float2(centre.x, centre.y);
    float2 a = frac(((value * size) - (0.5).xx));
    int2 lane = (pixel & (int(1)).xx);
    float2 quad_vector = ((float2(lane) * (2.0).xx) - (1.0).xx);
    float2 taps_middle_k0_ = (quad_vector + (-2.0).xx);
    float2 value_2_ = (taps_middle_k0_ - a);
    float2 away = abs(value_2_);
    float2 x = (away * (0.375).xx);
    float2 outer = max(((1.5).xx - x), (0.0).xx);
    float2 inner = max(((0.5).xx - x), (0.0).xx);
    float2 w0_ = (((outer * outer) * (0.5).xx) - ((inner * inner) * (1.5).xx));
    float2 away_2_ = abs((value_2_ + (1.0).xx));
    float2 x_2_ = (away_2_ * (0.375).xx);
    float2 outer_2_ = max(((1.5).xx - x_2_), (0.0).xx);
    float2 inner_2_ = max(((0.5).xx - x_2_), (0.0).xx);
    float2 w1_ = (((outer_2_ * outer_2_) * (0.5).xx) - ((inner_2_ * inner_2_) * (1.5).xx));
    float2 weight = (w0_ + w1_);
    float2 column_place = (value_2_ + (w1_ / weight));
    float taps_lit_k0_ = shadow.SampleCmpLevelZero(shadow_sampler, (value + (column_place / size)), centre.z);
    float taps_weight_k0_ = (weight.x * weight.y);
    float2 taps_middle_k3_ = (quad_vector + (2.0).xx);
    float2 value_3_ = (taps_middle_k3_ - a);
    float2 away_3_ = abs(value_3_);
    float2 x_3_ = (away_3_ * (0.375).xx);
    float2 outer_3_ = max(((1.5).xx - x_3_), (0.0).xx);
    float2 inner_3_ = max(((0.5).xx - x_3_), (0.0).xx);
    float2 w0_2_ = (((outer_3_ * outer_3_) * (0.5).xx) - ((inner_3_ * inner_3_) * (1.5).xx));
    float2 away_4_ = abs((value_3_ + (1.0).xx));
    float2 x_4_ = (away_4_ * (0.375).xx);
    float2 outer_4_ = max(((1.5).xx - x_4_), (0.0).xx);
    float2 inner_4_ = max(((0.5).xx - x_4_), (0.0).xx);
    float2 w1_2_ = (((outer_4_ * outer_4_) * (0.5).xx) - ((inner_4_ * inner_4_) * (1.5).xx));
    float2 weight_2_ = (w0_2_ + w1_2_);
    float2 column_place_2_ = (value_3_ + (w1_2_ / weight_2_));
    float2 place_k1_ = float2(column_place_2_.x, column_place.y);
    float taps_lit_k1_ = shadow.SampleCmpLevelZero(shadow_sampler, (value + (place_k1_ / size)), centre.z);
    float2 taps_middle_k1_ = (quad_vector + float2(2.0, -2.0));
    float taps_weight_k1_ = (weight_2_.x * weight.y);
    float2 place_k2_ = float2(column_place.x, column_place_2_.y);
    float taps_lit_k2_ = shadow.SampleCmpLevelZero(shadow_sampler, (value + (place_k2_ / size)), centre.z);
    float2 taps_middle_k2_ = (quad_vector + float2(-2.0, 2.0));
    float taps_weight_k2_ = (weight.x * weight_2_.y);
    float taps_lit_k3_ = shadow.SampleCmpLevelZero(shadow_sampler, (value + (column_place_2_ / size)), centre.z);
    float taps_weight_k3_ = (weight_2_.x * weight_2_.y);
    float2 away_5_ = ((float2(coord.x, coord.y) - value) * size);
    float2 value_4_ = (column_place * taps_weight_k0_);
    float4 sums_k0_ = ((0.0).xxxx + float4(value_4_.x, value_4_.y, taps_weight_k0_, (taps_lit_k0_ * taps_weight_k0_)));
    float2 value_5_ = (place_k1_ * taps_weight_k1_);
    float4 sums_k1_ = (sums_k0_ + float4(value_5_.x, value_5_.y, taps_weight_k1_, (taps_lit_k1_ * taps_weight_k1_)));
    float2 value_6_ = (place_k2_ * taps_weight_k2_);
    float4 sums_k2_ = (sums_k1_ + float4(value_6_.x, value_6_.y, taps_weight_k2_, (taps_lit_k2_ * taps_weight_k2_)));
    float2 value_7_ = (column_place_2_ * taps_weight_k3_);
    float4 sums_k3_ = (sums_k2_ + float4(value_7_.x, value_7_.y, taps_weight_k3_, (taps_lit_k3_ * taps_weight_k3_)));
    const float4 _e236 = QuadReadAcrossX(sums_k3_);
    float4 row_2_ = (sums_k3_ + _e236);
    const float4 _e238 = QuadReadAcrossY(row_2_);
    float4 sums = (row_2_ + _e238);
    float lit_ = (sums.w / sums.z);
    float2 middle = (float2(sums.x, sums.y) / (sums.z).xx);
    float2 moment_k0_ = ((0.0).xx + (taps_middle_k0_ * taps_lit_k0_));
    float2 moment_k1_ = (moment_k0_ + (taps_middle_k1_ * taps_lit_k1_));
    float2 moment_k2_ = (moment_k1_ + (taps_middle_k2_ * taps_lit_k2_));
    float2 moment_k3_ = (moment_k2_ + (taps_middle_k3_ * taps_lit_k3_));
    const float2 _e259 = QuadReadAcrossX(moment_k3_);
    float2 row_3_ = (moment_k3_ + _e259);
    const float2 _e261 = QuadReadAcrossY(row_3_);
    float lit_2_ = saturate((lit_ + dot(((row_3_ + _e261) / (80.0).xx), (away_5_ - middle))));
    return (lit_2_).xxxx;
}
