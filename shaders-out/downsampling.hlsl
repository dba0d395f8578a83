Texture2D<float4> image : register(t0);
Texture2D<float4> depth : register(t1);
RWTexture2D<float4> destination : register(u2);

uint2 NagaRWDimensions2D(RWTexture2D<float4> tex)
{
    uint4 ret;
    tex.GetDimensions(ret.x, ret.y);
    return ret.xy;
}

uint2 NagaDimensions2D(Texture2D<float4> tex)
{
    uint4 ret;
    tex.GetDimensions(0, ret.x, ret.y, ret.z);
    return ret.xy;
}

[numthreads(256, 1, 1)]
void downsampling(uint3 id : SV_DispatchThreadID)
{
    int2 frame = int2(NagaRWDimensions2D(destination));
    int2 pixel = int2(id.xy);
    if (any((pixel >= frame))) {
        return;
    }
    int2 first = asint(asuint(asint(asuint(pixel) * asuint((int(2)).xx))) - asuint((int(1)).xx));
    int2 last = asint(asuint(int2(NagaDimensions2D(depth))) - asuint((int(1)).xx));
    int2 texel = clamp(first, (int(0)).xx, last);
    float4 _e25 = depth.Load(int3(texel, int(0)));
    float nearest = _e25.x;
    int2 at_j0_i1_ = asint(asuint(first) + asuint(int2(int(1), int(0))));
    int2 texel_j0_i1_ = clamp(at_j0_i1_, (int(0)).xx, last);
    float4 _e36 = depth.Load(int3(texel_j0_i1_, int(0)));
    float z_j0_i1_ = _e36.x;
    bool holds = (z_j0_i1_ < nearest);
    int2 at_j0_i1_2_ = (holds ? at_j0_i1_ : first);
    float nearest_j0_i1_ = (holds ? z_j0_i1_ : nearest);
    int2 at_j1_i0_ = asint(asuint(first) + asuint(int2(int(0), int(1))));
    int2 texel_j1_i0_ = clamp(at_j1_i0_, (int(0)).xx, last);
    float4 _e50 = depth.Load(int3(texel_j1_i0_, int(0)));
    float z_j1_i0_ = _e50.x;
    bool holds_2_ = (z_j1_i0_ < nearest_j0_i1_);
    int2 at_j1_i0_2_ = (holds_2_ ? at_j1_i0_ : at_j0_i1_2_);
    float nearest_j1_i0_ = (holds_2_ ? z_j1_i0_ : nearest_j0_i1_);
    int2 at_j1_i1_ = asint(asuint(first) + asuint((int(1)).xx));
    int2 texel_j1_i1_ = clamp(at_j1_i1_, (int(0)).xx, last);
    float4 _e63 = depth.Load(int3(texel_j1_i1_, int(0)));
    float z_j1_i1_ = _e63.x;
    bool holds_3_ = (z_j1_i1_ < nearest_j1_i0_);
    int2 at_j1_i1_2_ = (holds_3_ ? at_j1_i1_ : at_j1_i0_2_);
    float nearest_j1_i1_ = (holds_3_ ? z_j1_i1_ : nearest_j1_i0_);
    int2 last_2_ = asint(asuint(int2(NagaDimensions2D(image))) - asuint((int(1)).xx));
    int2 texel_2_ = clamp(at_j1_i1_2_, (int(0)).xx, last_2_);
    float4 _e79 = image.Load(int3(texel_2_, int(0)));
    float3 image_texel = _e79.xyz;
    destination[pixel] = float4(image_texel.x, image_texel.y, image_texel.z, nearest_j1_i1_);
    return;
}
