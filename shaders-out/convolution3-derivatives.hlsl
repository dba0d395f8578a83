Texture2D<float4> image : register(t0);

struct FragmentInput_quad_convolution {
    float4 position_1 : SV_Position;
};

int2 naga_f2i32(float2 value) {
    return int2(clamp(value, -2147483600.0, 2147483500.0));
}

uint2 NagaDimensions2D(Texture2D<float4> tex)
{
    uint4 ret;
    tex.GetDimensions(0, ret.x, ret.y, ret.z);
    return ret.xy;
}

float4 quad_convolution(FragmentInput_quad_convolution fragmentinput_quad_convolution) : SV_Target0
{
    float4 position = fragmentinput_quad_convolution.position_1;
    int2 pixel = naga_f2i32(floor(position.xy));
    int2 frame = int2(NagaDimensions2D(image));
    float2 product = (float2((pixel & (int(1)).xx)) * 2.0);
    int2 outwards = naga_f2i32((product - (1.0).xx));
    int2 last = asint(asuint(frame) - asuint((int(1)).xx));
    float4 _e25 = image.Load(int3(clamp(pixel, (int(0)).xx, last), int(0)));
    float4 own_j0_i0_ = ((0.0).xxxx + (_e25 * 0.11111111));
    float4 tap_j0_i1_ = image.Load(int3(clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint(int2(int(1), int(0)))))), (int(0)).xx, last), int(0)));
    float4 own_j0_i1_ = (own_j0_i0_ + (tap_j0_i1_ * 0.11111111));
    float4 tap_j1_i0_ = image.Load(int3(clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint(int2(int(0), int(1)))))), (int(0)).xx, last), int(0)));
    float4 product_2_ = (tap_j1_i0_ * 0.11111111);
    float4 beside_j1_i0_ = (own_j0_i0_ + product_2_);
    float4 _e65 = image.Load(int3(clamp(asint(asuint(pixel) + asuint(outwards)), (int(0)).xx, last), int(0)));
    float4 product_3_ = (_e65 * 0.11111111);
    float2 towards = ((1.0).xx - product);
    float4 _e74 = ddx_fine(beside_j1_i0_);
    float4 sum = (((own_j0_i1_ + product_2_) + product_3_) + (beside_j1_i0_ + (towards.x * _e74)));
    float4 _e79 = ddy_fine(own_j0_i0_);
    float4 own_below_j0_i0_ = (own_j0_i0_ + (towards.y * _e79));
    float4 _e83 = ddx_fine(own_below_j0_i0_);
    float4 own_below_beside_j0_i0_ = (own_below_j0_i0_ + (towards.x * _e83));
    float4 _e87 = ddy_fine(own_j0_i1_);
    float4 shared_value = ((sum + (own_j0_i1_ + (towards.y * _e87))) + own_below_beside_j0_i0_);
    return shared_value;
}
