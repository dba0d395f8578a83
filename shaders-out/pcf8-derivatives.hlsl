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
    int2 lane = (pixel & (int(1)).xx);
    float2 value = (float2(lane) * (2.0).xx);
    float2 towards = ((1.0).xx - value);
    float3 _e16 = ddx_fine(coord);
    float3 row = (coord + (coord + (towards.x * _e16)));
    float3 _e21 = ddy_fine(row);
    float3 row_below = (row + (towards.y * _e21));
    float3 centre = ((row + row_below) * (0.25).xxx);
    float2 size = float2(uint2(int2(NagaDepthDimensions2D(shadow))));
    float2 value_2_ = float2(centre.x, centre.y);
    float2 a = frac(((value_2_ * size) - (0.5).xx));
    float2 quad_vector = (value - (1.0).xx);
    float2 taps_middle_k0_ = (quad_vector + (-2.0).xx);
    float2 value_3_ = (taps_middle_k0_ - a);
    float2 away = abs(value_3_);
    float2 x = (away * (0.375).xx);
    float2 outer = max(((1.5).xx - x), (0.0).xx);
    float2 inner = max(((0.5).xx - x), (0.0).xx);
    float2 w0_ = (((outer * outer) * (0.5).xx) - ((inner * inner) * (1.5).xx));
    float2 away_2_ = abs((value_3_ + (1.0).xx));
    float2 x_2_ = (away_2_ * (0.375).xx);
    float2 outer_2_ = max(((1.5).xx - x_2_), (0.0).xx);
    float2 inner_2_ = max(((0.5).xx - x_2_), (0.0).xx);
    float2 w1_ = (((outer_2_ * outer_2_) * (0.5).xx) - ((inner_2_ * inner_2_) * (1.5).xx));
    float2 weight = (w0_ + w1_);
    float2 column_place = (value_3_ + (w1_ / weight));
    float taps_lit_k0_ = shadow.SampleCmpLevelZero(shadow_sampler, (value_2_ + (column_place / size)), centre.z);
    float taps_weight_k0_ = (weight.x * weight.y);
    float2 taps_middle_k3_ = (quad_vector + (2.0).xx);
    float2 value_4_ = (taps_middle_k3_ - a);
    float2 away_3_ = abs(value_4_);
    float2 x_3_ = (away_3_ * (0.375).xx);
    float2 outer_3_ = max(((1.5).xx - x_3_), (0.0).xx);
    float2 inner_3_ = max(((0.5).xx - x_3_), (0.0).xx);
    float2 w0_2_ = (((outer_3_ * outer_3_) * (0.5).xx) - ((inner_3_ * inner_3_) * (1.5).xx));
    float2 away_4_ = abs((value_4_ + (1.0).xx));
    float2 x_4_ = (away_4_ * (0.375).xx);
    float2 outer_4_ = max(((1.5).xx - x_4_), (0.0).xx);
    float2 inner_4_ = max(((0.5).xx - x_4_), (0.0).xx);
    float2 w1_2_ = (((outer_4_ * outer_4_) * (0.5).xx) - ((inner_4_ * inner_4_) * (1.5).xx));
    float2 weight_2_ = (w0_2_ + w1_2_);
    float2 column_place_2_ = (value_4_ + (w1_2_ / weight_2_));
    float2 place_k1_ = float2(column_place_2_.x, column_place.y);
    float taps_lit_k1_ = shadow.SampleCmpLevelZero(shadow_sampler, (value_2_ + (place_k1_ / size)), centre.z);
    float2 taps_middle_k1_ = (quad_vector + float2(2.0, -2.0));
    float taps_weight_k1_ = (weight_2_.x * weight.y);
    float2 place_k2_ = float2(column_place.x, column_place_2_.y);
    float taps_lit_k2_ = shadow.SampleCmpLevelZero(shadow_sampler, (value_2_ + (place_k2_ / size)), centre.z);
    float2 taps_middle_k2_ = (quad_vector + float2(-2.0, 2.0));
    float taps_weight_k2_ = (weight.x * weight_2_.y);
    float taps_lit_k3_ = shadow.SampleCmpLevelZero(shadow_sampler, (value_2_ + (column_place_2_ / size)), centre.z);
    float taps_weight_k3_ = (weight_2_.x * weight_2_.y);
    float2 away_5_ = ((float2(coord.x, coord.y) - value_2_) * size);
    float2 value_5_ = (column_place * taps_weight_k0_);
    float4 sums_k0_ = ((0.0).xxxx + float4(value_5_.x, value_5_.y, taps_weight_k0_, (taps_lit_k0_ * taps_weight_k0_)));
    float2 value_6_ = (place_k1_ * taps_weight_k1_);
    float4 sums_k1_ = (sums_k0_ + float4(value_6_.x, value_6_.y, taps_weight_k1_, (taps_lit_k1_ * taps_weight_k1_)));
    float2 value_7_ = (place_k2_ * taps_weight_k2_);
    float4 sums_k2_ = (sums_k1_ + float4(value_7_.x, value_7_.y, taps_weight_k2_, (taps_lit_k2_ * taps_weight_k2_)));
    float2 value_8_ = (column_place_2_ * taps_weight_k3_);
    float4 sums_k3_ = (sums_k2_ + float4(value_8_.x, value_8_.y, taps_weight_k3_, (taps_lit_k3_ * taps_weight_k3_)));
    float4 _e246 = ddx_fine(sums_k3_);
    float4 sums_beside_k3_ = (sums_k3_ + (towards.x * _e246));
    float4 row_2_ = (sums_k3_ + sums_beside_k3_);
    float4 _e251 = ddy_fine(row_2_);
    float4 row_below_2_ = (row_2_ + (towards.y * _e251));
    float4 sums = (row_2_ + row_below_2_);
    float lit_ = (sums.w / sums.z);
    float2 middle = (float2(sums.x, sums.y) / (sums.z).xx);
    float2 moment_k0_ = ((0.0).xx + (taps_middle_k0_ * taps_lit_k0_));
    float2 moment_k1_ = (moment_k0_ + (taps_middle_k1_ * taps_lit_k1_));
    float2 moment_k2_ = (moment_k1_ + (taps_middle_k2_ * taps_lit_k2_));
    float2 moment_k3_ = (moment_k2_ + (taps_middle_k3_ * taps_lit_k3_));
    float2 _e275 = ddx_fine(moment_k3_);
    float2 moment_beside_k3_ = (moment_k3_ + (towards.x * _e275));
    float2 row_3_ = (moment_k3_ + moment_beside_k3_);
    float2 _e280 = ddy_fine(row_3_);
    float2 row_below_3_ = (row_3_ + (towards.y * _e280));
    float lit_2_ = saturate((lit_ + dot(((row_3_ + row_below_3_) / (80.0).xx), (away_5_ - middle))));
    return (lit_2_).xxxx;
}
