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
    int2 outwards = naga_f2i32(((float2((pixel & (int(1)).xx)) * 2.0) - (1.0).xx));
    int2 last = asint(asuint(frame) - asuint((int(1)).xx));
    float4 _e25 = image.Load(int3(clamp(pixel, (int(0)).xx, last), int(0)));
    float4 own_j0_i0_ = ((0.0).xxxx + (_e25 * 0.11111111));
    float4 tap_j0_i1_ = image.Load(int3(clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint(int2(int(1), int(0)))))), (int(0)).xx, last), int(0)));
    float4 own_j0_i1_ = (own_j0_i0_ + (tap_j0_i1_ * 0.11111111));
    float4 tap_j1_i0_ = image.Load(int3(clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint(int2(int(0), int(1)))))), (int(0)).xx, last), int(0)));
    float4 product = (tap_j1_i0_ * 0.11111111);
    float4 _e64 = image.Load(int3(clamp(asint(asuint(pixel) + asuint(outwards)), (int(0)).xx, last), int(0)));
    float4 product_2_ = (_e64 * 0.11111111);
    const float4 _e70 = QuadReadAcrossX((own_j0_i0_ + product));
    float4 sum = (((own_j0_i1_ + product) + product_2_) + _e70);
    const float4 _e72 = QuadReadAcrossY(own_j0_i1_);
    const float4 _e74 = QuadReadAcrossDiagonal(own_j0_i0_);
    return ((sum + _e72) + _e74);
}
