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
    int2 pixel = asint(asuint(int2(id.xy)) * asuint(int2(int(2), int(2))));
    if (any((pixel >= frame))) {
        return;
    }
    int2 last = asint(asuint(frame) - asuint((int(1)).xx));
    int2 texel_j0_i0_l1_ = min(asint(asuint(pixel) + asuint(int2(int(1), int(0)))), last);
    int2 texel_j0_i0_l2_ = min(asint(asuint(pixel) + asuint(int2(int(0), int(1)))), last);
    int2 texel_j0_i0_l3_ = min(asint(asuint(pixel) + asuint((int(1)).xx)), last);
    float4 tap_j0_i0_l0_ = image.Load(int3(pixel, int(0)));
    float4 tap_j0_i0_l1_ = image.Load(int3(texel_j0_i0_l1_, int(0)));
    float4 tap_j0_i0_l2_ = image.Load(int3(texel_j0_i0_l2_, int(0)));
    float4 tap_j0_i0_l3_ = image.Load(int3(texel_j0_i0_l3_, int(0)));
    float4 own_j0_i0_l0_ = ((0.0).xxxx + (tap_j0_i0_l0_ * (0.11111111).xxxx));
    float4 own_j0_i0_l1_ = ((0.0).xxxx + (tap_j0_i0_l1_ * (0.11111111).xxxx));
    float4 own_j0_i0_l2_ = ((0.0).xxxx + (tap_j0_i0_l2_ * (0.11111111).xxxx));
    float4 own_j0_i0_l3_ = ((0.0).xxxx + (tap_j0_i0_l3_ * (0.11111111).xxxx));
    int2 texel_j0_i1_l0_ = max(asint(asuint(pixel) + asuint(int2(int(-1), int(0)))), (int(0)).xx);
    int2 texel_j0_i1_l1_ = min(asint(asuint(pixel) + asuint(int2(int(2), int(0)))), last);
    int2 texel_j0_i1_l2_ = clamp(asint(asuint(pixel) + asuint(int2(int(-1), int(1)))), (int(0)).xx, last);
    int2 texel_j0_i1_l3_ = min(asint(asuint(pixel) + asuint(int2(int(2), int(1)))), last);
    float4 tap_j0_i1_l0_ = image.Load(int3(texel_j0_i1_l0_, int(0)));
    float4 tap_j0_i1_l1_ = image.Load(int3(texel_j0_i1_l1_, int(0)));
    float4 tap_j0_i1_l2_ = image.Load(int3(texel_j0_i1_l2_, int(0)));
    float4 tap_j0_i1_l3_ = image.Load(int3(texel_j0_i1_l3_, int(0)));
    float4 own_j0_i1_l0_ = (own_j0_i0_l0_ + (tap_j0_i1_l0_ * (0.11111111).xxxx));
    float4 own_j0_i1_l1_ = (own_j0_i0_l1_ + (tap_j0_i1_l1_ * (0.11111111).xxxx));
    float4 own_j0_i1_l2_ = (own_j0_i0_l2_ + (tap_j0_i1_l2_ * (0.11111111).xxxx));
    float4 own_j0_i1_l3_ = (own_j0_i0_l3_ + (tap_j0_i1_l3_ * (0.11111111).xxxx));
    int2 texel_j1_i0_l0_ = max(asint(asuint(pixel) + asuint(int2(int(0), int(-1)))), (int(0)).xx);
    int2 texel_j1_i0_l1_ = clamp(asint(asuint(pixel) + asuint(int2(int(1), int(-1)))), (int(0)).xx, last);
    int2 texel_j1_i0_l2_ = min(asint(asuint(pixel) + asuint(int2(int(0), int(2)))), last);
    int2 texel_j1_i0_l3_ = min(asint(asuint(pixel) + asuint(int2(int(1), int(2)))), last);
    float4 tap_j1_i0_l0_ = image.Load(int3(texel_j1_i0_l0_, int(0)));
    float4 tap_j1_i0_l1_ = image.Load(int3(texel_j1_i0_l1_, int(0)));
    float4 tap_j1_i0_l2_ = image.Load(int3(texel_j1_i0_l2_, int(0)));
    float4 tap_j1_i0_l3_ = image.Load(int3(texel_j1_i0_l3_, int(0)));
    float4 value = (tap_j1_i0_l0_ * (0.11111111).xxxx);
    float4 value_2_ = (tap_j1_i0_l1_ * (0.11111111).xxxx);
    float4 value_3_ = (tap_j1_i0_l2_ * (0.11111111).xxxx);
    float4 value_4_ = (tap_j1_i0_l3_ * (0.11111111).xxxx);
    float4 own_j1_i0_l0_ = (own_j0_i1_l0_ + value);
    float4 own_j1_i0_l1_ = (own_j0_i1_l1_ + value_2_);
    float4 own_j1_i0_l2_ = (own_j0_i1_l2_ + value_3_);
    float4 own_j1_i0_l3_ = (own_j0_i1_l3_ + value_4_);
    float4 beside_j1_i0_l0_ = (own_j0_i0_l0_ + value);
    float4 beside_j1_i0_l1_ = (own_j0_i0_l1_ + value_2_);
    float4 beside_j1_i0_l2_ = (own_j0_i0_l2_ + value_3_);
    float4 beside_j1_i0_l3_ = (own_j0_i0_l3_ + value_4_);
    int2 texel_j1_i1_l0_ = max(asint(asuint(pixel) + asuint((int(-1)).xx)), (int(0)).xx);
    int2 texel_j1_i1_l1_ = clamp(asint(asuint(pixel) + asuint(int2(int(2), int(-1)))), (int(0)).xx, last);
    int2 texel_j1_i1_l2_ = clamp(asint(asuint(pixel) + asuint(int2(int(-1), int(2)))), (int(0)).xx, last);
    int2 texel_j1_i1_l3_ = min(asint(asuint(pixel) + asuint((int(2)).xx)), last);
    float4 tap_j1_i1_l0_ = image.Load(int3(texel_j1_i1_l0_, int(0)));
    float4 tap_j1_i1_l1_ = image.Load(int3(texel_j1_i1_l1_, int(0)));
    float4 tap_j1_i1_l2_ = image.Load(int3(texel_j1_i1_l2_, int(0)));
    float4 tap_j1_i1_l3_ = image.Load(int3(texel_j1_i1_l3_, int(0)));
    float4 own_j1_i1_l0_ = (own_j1_i0_l0_ + (tap_j1_i1_l0_ * (0.11111111).xxxx));
    float4 own_j1_i1_l1_ = (own_j1_i0_l1_ + (tap_j1_i1_l1_ * (0.11111111).xxxx));
    float4 own_j1_i1_l2_ = (own_j1_i0_l2_ + (tap_j1_i1_l2_ * (0.11111111).xxxx));
    float4 own_j1_i1_l3_ = (own_j1_i0_l3_ + (tap_j1_i1_l3_ * (0.11111111).xxxx));
    destination[pixel] = (((own_j1_i1_l0_ + beside_j1_i0_l1_) + own_j0_i1_l2_) + own_j0_i0_l3_);
    if (all((asint(asuint(pixel) + asuint(int2(int(1), int(0)))) < frame))) {
        destination[asint(asuint(pixel) + asuint(int2(int(1), int(0))))] = (((own_j1_i1_l1_ + beside_j1_i0_l0_) + own_j0_i1_l3_) + own_j0_i0_l2_);
    }
    if (all((asint(asuint(pixel) + asuint(int2(int(0), int(1)))) < frame))) {
        destination[asint(asuint(pixel) + asuint(int2(int(0), int(1))))] = (((own_j1_i1_l2_ + beside_j1_i0_l3_) + own_j0_i1_l0_) + own_j0_i0_l1_);
    }
    if (all((asint(asuint(pixel) + asuint(int2(int(1), int(1)))) < frame))) {
        destination[asint(asuint(pixel) + asuint(int2(int(1), int(1))))] = (((own_j1_i1_l3_ + beside_j1_i0_l2_) + own_j0_i1_l1_) + own_j0_i0_l0_);
        return;
    } else {
        return;
    }
}
