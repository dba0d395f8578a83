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
    int2 first = asint(asuint(asint(asuint(pixel) * asuint(int(2)))) - asuint((int(1)).xx));
    int2 last = asint(asuint(int2(NagaDimensions2D(depth))) - asuint((int(1)).xx));
    float4 _e24 = depth.Load(int3(clamp(first, (int(0)).xx, last), int(0)));
    float nearest = _e24.x;
    int2 at_j0_i1_ = asint(asuint(first) + asuint(int2(int(1), int(0))));
    float4 _e35 = depth.Load(int3(clamp(at_j0_i1_, (int(0)).xx, last), int(0)));
    float z_j0_i1_ = _e35.x;
    bool is_less = (z_j0_i1_ < nearest);
    float nearest_j0_i1_ = (is_less ? z_j0_i1_ : nearest);
    int2 at_j1_i0_ = asint(asuint(first) + asuint(int2(int(0), int(1))));
    float4 _e48 = depth.Load(int3(clamp(at_j1_i0_, (int(0)).xx, last), int(0)));
    float z_j1_i0_ = _e48.x;
    bool is_less_2_ = (z_j1_i0_ < nearest_j0_i1_);
    int2 at_j1_i0_2_ = (is_less_2_ ? at_j1_i0_ : (is_less ? at_j0_i1_ : first));
    float nearest_j1_i0_ = (is_less_2_ ? z_j1_i0_ : nearest_j0_i1_);
    int2 at_j1_i1_ = asint(asuint(first) + asuint((int(1)).xx));
    float4 _e62 = depth.Load(int3(clamp(at_j1_i1_, (int(0)).xx, last), int(0)));
    float z_j1_i1_ = _e62.x;
    bool is_less_3_ = (z_j1_i1_ < nearest_j1_i0_);
    float nearest_j1_i1_ = (is_less_3_ ? z_j1_i1_ : nearest_j1_i0_);
    int2 last_2_ = asint(asuint(int2(NagaDimensions2D(image))) - asuint((int(1)).xx));
    int2 texel = clamp((is_less_3_ ? at_j1_i1_ : at_j1_i0_2_), (int(0)).xx, last_2_);
    float4 _e79 = image.Load(int3(texel, int(0)));
    destination[pixel] = float4(_e79.xyz, nearest_j1_i1_);
    return;
}
