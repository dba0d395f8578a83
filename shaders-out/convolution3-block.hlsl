Texture2D<float4> image : register(t0);
RWTexture2D<float4> destination : register(u1);

uint2 NagaRWDimensions2D(RWTexture2D<float4> tex)
{
    uint4 ret;
    tex.GetDimensions(ret.x, ret.y);
    return ret.xy;
}

[numthreads(256, 1, 1)]
void quad_convolution(uint3 id : SV_DispatchThreadID)
{
    int2 frame = int2(NagaRWDimensions2D(destination));
    int2 pixel = asint(asuint(int2(id.xy)) * asuint((int(2)).xx));
    if (any((pixel >= frame))) {
        return;
    }
    int2 last = asint(asuint(frame) - asuint((int(1)).xx));
    float4 _e16 = image.Load(int3(pixel, int(0)));
    float4 own_j0i0l0_ = ((0.0).xxxx + (_e16 * 0.11111111));
    float4 _e29 = image.Load(int3(min(asint(asuint(pixel) + asuint(int2(int(1), int(0)))), last), int(0)));
    float4 own_j0i0l1_ = ((0.0).xxxx + (_e29 * 0.11111111));
    float4 _e42 = image.Load(int3(min(asint(asuint(pixel) + asuint(int2(int(0), int(1)))), last), int(0)));
    float4 own_j0i0l2_ = ((0.0).xxxx + (_e42 * 0.11111111));
    float4 _e54 = image.Load(int3(min(asint(asuint(pixel) + asuint((int(1)).xx)), last), int(0)));
    float4 own_j0i0l3_ = ((0.0).xxxx + (_e54 * 0.11111111));
    float4 _e69 = image.Load(int3(max(asint(asuint(pixel) + asuint(int2(int(-1), int(0)))), (int(0)).xx), int(0)));
    float4 product = (_e69 * 0.11111111);
    float4 _e79 = image.Load(int3(min(asint(asuint(pixel) + asuint(int2(int(2), int(0)))), last), int(0)));
    float4 product_2_ = (_e79 * 0.11111111);
    float4 _e91 = image.Load(int3(clamp(asint(asuint(pixel) + asuint(int2(int(-1), int(1)))), (int(0)).xx, last), int(0)));
    float4 product_3_ = (_e91 * 0.11111111);
    float4 _e101 = image.Load(int3(min(asint(asuint(pixel) + asuint(int2(int(2), int(1)))), last), int(0)));
    float4 product_4_ = (_e101 * 0.11111111);
    float4 own_j0i1l0_ = (own_j0i0l0_ + product);
    float4 own_j0i1l1_ = (own_j0i0l1_ + product_2_);
    float4 own_j0i1l2_ = (own_j0i0l2_ + product_3_);
    float4 own_j0i1l3_ = (own_j0i0l3_ + product_4_);
    float4 _e117 = image.Load(int3(max(asint(asuint(pixel) + asuint(int2(int(0), int(-1)))), (int(0)).xx), int(0)));
    float4 product_5_ = (_e117 * 0.11111111);
    float4 _e129 = image.Load(int3(clamp(asint(asuint(pixel) + asuint(int2(int(1), int(-1)))), (int(0)).xx, last), int(0)));
    float4 product_6_ = (_e129 * 0.11111111);
    float4 _e139 = image.Load(int3(min(asint(asuint(pixel) + asuint(int2(int(0), int(2)))), last), int(0)));
    float4 product_7_ = (_e139 * 0.11111111);
    float4 _e149 = image.Load(int3(min(asint(asuint(pixel) + asuint(int2(int(1), int(2)))), last), int(0)));
    float4 product_8_ = (_e149 * 0.11111111);
    float4 _e160 = image.Load(int3(max(asint(asuint(pixel) - asuint((int(1)).xx)), (int(0)).xx), int(0)));
    float4 product_9_ = (_e160 * 0.11111111);
    float4 _e172 = image.Load(int3(clamp(asint(asuint(pixel) + asuint(int2(int(2), int(-1)))), (int(0)).xx, last), int(0)));
    float4 product_10_ = (_e172 * 0.11111111);
    float4 _e184 = image.Load(int3(clamp(asint(asuint(pixel) + asuint(int2(int(-1), int(2)))), (int(0)).xx, last), int(0)));
    float4 product_11_ = (_e184 * 0.11111111);
    float4 _e193 = image.Load(int3(min(asint(asuint(pixel) + asuint((int(2)).xx)), last), int(0)));
    float4 product_12_ = (_e193 * 0.11111111);
    float4 shared_l0_ = (((((own_j0i1l0_ + product_5_) + product_9_) + (own_j0i0l1_ + product_6_)) + own_j0i1l2_) + own_j0i0l3_);
    float4 shared_l1_ = (((((own_j0i1l1_ + product_6_) + product_10_) + (own_j0i0l0_ + product_5_)) + own_j0i1l3_) + own_j0i0l2_);
    float4 shared_l2_ = (((((own_j0i1l2_ + product_7_) + product_11_) + (own_j0i0l3_ + product_8_)) + own_j0i1l0_) + own_j0i0l1_);
    float4 shared_l3_ = (((((own_j0i1l3_ + product_8_) + product_12_) + (own_j0i0l2_ + product_7_)) + own_j0i1l1_) + own_j0i0l0_);
    destination[pixel] = shared_l0_;
    if (all((asint(asuint(pixel) + asuint(int2(int(1), int(0)))) < frame))) {
        destination[asint(asuint(pixel) + asuint(int2(int(1), int(0))))] = shared_l1_;
    }
    if (all((asint(asuint(pixel) + asuint(int2(int(0), int(1)))) < frame))) {
        destination[asint(asuint(pixel) + asuint(int2(int(0), int(1))))] = shared_l2_;
    }
    if (all((asint(asuint(pixel) + asuint((int(1)).xx)) < frame))) {
        destination[asint(asuint(pixel) + asuint((int(1)).xx))] = shared_l3_;
        return;
    } else {
        return;
    }
}
