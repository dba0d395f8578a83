Texture2D<float4> low : register(t0);
Texture2D<float4> depth : register(t1);
RWTexture2D<float4> destination : register(u2);

int2 naga_div(int2 lhs, int2 rhs) {
    return lhs / (((lhs == int(-2147483647 - 1) & rhs == -1) | (rhs == 0)) ? 1 : rhs);
}

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
void quad_upsampling(uint3 id : SV_DispatchThreadID)
{
    int2 frame = int2(NagaRWDimensions2D(destination));
    int2 pixel = asint(asuint(int2(id.xy)) * asuint((int(2)).xx));
    if (any((pixel >= frame))) {
        return;
    }
    int2 sum = asint(asuint(pixel) + asuint(int2(int(1), int(0))));
    int2 sum_2_ = asint(asuint(pixel) + asuint(int2(int(0), int(1))));
    int2 sum_3_ = asint(asuint(pixel) + asuint((int(1)).xx));
    int2 last = asint(asuint(frame) - asuint((int(1)).xx));
    float4 _e27 = depth.Load(int3(pixel, int(0)));
    float depth_l0_ = _e27.x;
    float4 _e32 = depth.Load(int3(min(sum, last), int(0)));
    float depth_l1_ = _e32.x;
    float4 _e37 = depth.Load(int3(min(sum_2_, last), int(0)));
    float depth_l2_ = _e37.x;
    float4 _e42 = depth.Load(int3(min(sum_3_, last), int(0)));
    float depth_l3_ = _e42.x;
    float own_depth_l0_ = ((abs(depth_l0_) < 1e30) ? depth_l0_ : 1e30);
    float own_depth_l1_ = ((abs(depth_l1_) < 1e30) ? depth_l1_ : 1e30);
    float own_depth_l2_ = ((abs(depth_l2_) < 1e30) ? depth_l2_ : 1e30);
    float own_depth_l3_ = ((abs(depth_l3_) < 1e30) ? depth_l3_ : 1e30);
    int2 last_2_ = asint(asuint(int2(NagaDimensions2D(low))) - asuint((int(1)).xx));
    float4 texel_l0_ = low.Load(int3(clamp(naga_div(pixel, (int(2)).xx), (int(0)).xx, last_2_), int(0)));
    float4 texel_l1_ = low.Load(int3(clamp(asint(asuint(naga_div(sum, (int(2)).xx)) + asuint(int2(int(1), int(0)))), (int(0)).xx, last_2_), int(0)));
    float4 texel_l2_ = low.Load(int3(clamp(asint(asuint(naga_div(sum_2_, (int(2)).xx)) + asuint(int2(int(0), int(1)))), (int(0)).xx, last_2_), int(0)));
    float4 texel_l3_ = low.Load(int3(clamp(asint(asuint(naga_div(sum_3_, (int(2)).xx)) + asuint((int(1)).xx)), (int(0)).xx, last_2_), int(0)));
    bool color_l0_ = all((abs(texel_l0_.xyz) < (3e38).xxx));
    bool color_l1_ = all((abs(texel_l1_.xyz) < (3e38).xxx));
    bool color_l2_ = all((abs(texel_l2_.xyz) < (3e38).xxx));
    bool color_l3_ = all((abs(texel_l3_.xyz) < (3e38).xxx));
    float4 vector_ = float4(texel_l0_.xyz, ((abs(texel_l0_.w) < 1e30) ? texel_l0_.w : 1e30));
    float4 vector_2_ = float4(texel_l1_.xyz, ((abs(texel_l1_.w) < 1e30) ? texel_l1_.w : 1e30));
    float4 vector_3_ = float4(texel_l2_.xyz, ((abs(texel_l2_.w) < 1e30) ? texel_l2_.w : 1e30));
    float4 vector_4_ = float4(texel_l3_.xyz, ((abs(texel_l3_.w) < 1e30) ? texel_l3_.w : 1e30));
    float4 texel_l0_2_ = (color_l0_ ? vector_ : float4(0.0, 0.0, 0.0, -1e30));
    float4 texel_l1_2_ = (color_l1_ ? vector_2_ : float4(0.0, 0.0, 0.0, -1e30));
    float4 texel_l2_2_ = (color_l2_ ? vector_3_ : float4(0.0, 0.0, 0.0, -1e30));
    float4 texel_l3_2_ = (color_l3_ ? vector_4_ : float4(0.0, 0.0, 0.0, -1e30));
    float4 taps = float4(texel_l0_2_.xyz, 1.0);
    float4 taps_2_ = float4(texel_l1_2_.xyz, 1.0);
    float4 taps_3_ = float4(texel_l2_2_.xyz, 1.0);
    float4 taps_4_ = float4(texel_l3_2_.xyz, 1.0);
    float away_k0_l0_ = abs((texel_l0_2_.w - own_depth_l0_));
    float away_k0_l1_ = abs((texel_l1_2_.w - own_depth_l1_));
    float away_k0_l2_ = abs((texel_l2_2_.w - own_depth_l2_));
    float away_k0_l3_ = abs((texel_l3_2_.w - own_depth_l3_));
    float z_k0_l0_ = (away_k0_l0_ / 0.1);
    float z_k0_l1_ = (away_k0_l1_ / 0.1);
    float z_k0_l2_ = (away_k0_l2_ / 0.1);
    float z_k0_l3_ = (away_k0_l3_ / 0.1);
    float away_k1_l0_ = abs((texel_l1_2_.w - own_depth_l0_));
    float away_k1_l1_ = abs((texel_l0_2_.w - own_depth_l1_));
    float away_k1_l2_ = abs((texel_l3_2_.w - own_depth_l2_));
    float away_k1_l3_ = abs((texel_l2_2_.w - own_depth_l3_));
    float z_k1_l0_ = (away_k1_l0_ / 0.1);
    float z_k1_l1_ = (away_k1_l1_ / 0.1);
    float z_k1_l2_ = (away_k1_l2_ / 0.1);
    float z_k1_l3_ = (away_k1_l3_ / 0.1);
    float weight_k1_l0_ = (0.1875 * exp2(((z_k1_l0_ * z_k1_l0_) * -0.7213475)));
    float weight_k1_l1_ = (0.1875 * exp2(((z_k1_l1_ * z_k1_l1_) * -0.7213475)));
    float weight_k1_l2_ = (0.1875 * exp2(((z_k1_l2_ * z_k1_l2_) * -0.7213475)));
    float weight_k1_l3_ = (0.1875 * exp2(((z_k1_l3_ * z_k1_l3_) * -0.7213475)));
    bool nearer_k1_l0_ = (away_k1_l0_ < away_k0_l0_);
    bool nearer_k1_l1_ = (away_k1_l1_ < away_k0_l1_);
    bool nearer_k1_l2_ = (away_k1_l2_ < away_k0_l2_);
    bool nearer_k1_l3_ = (away_k1_l3_ < away_k0_l3_);
    float nearest_k1_l0_ = (nearer_k1_l0_ ? away_k1_l0_ : away_k0_l0_);
    float nearest_k1_l1_ = (nearer_k1_l1_ ? away_k1_l1_ : away_k0_l1_);
    float nearest_k1_l2_ = (nearer_k1_l2_ ? away_k1_l2_ : away_k0_l2_);
    float nearest_k1_l3_ = (nearer_k1_l3_ ? away_k1_l3_ : away_k0_l3_);
    float away_k2_l0_ = abs((texel_l2_2_.w - own_depth_l0_));
    float away_k2_l1_ = abs((texel_l3_2_.w - own_depth_l1_));
    float away_k2_l2_ = abs((texel_l0_2_.w - own_depth_l2_));
    float away_k2_l3_ = abs((texel_l1_2_.w - own_depth_l3_));
    float z_k2_l0_ = (away_k2_l0_ / 0.1);
    float z_k2_l1_ = (away_k2_l1_ / 0.1);
    float z_k2_l2_ = (away_k2_l2_ / 0.1);
    float z_k2_l3_ = (away_k2_l3_ / 0.1);
    float weight_k2_l0_ = (0.1875 * exp2(((z_k2_l0_ * z_k2_l0_) * -0.7213475)));
    float weight_k2_l1_ = (0.1875 * exp2(((z_k2_l1_ * z_k2_l1_) * -0.7213475)));
    float weight_k2_l2_ = (0.1875 * exp2(((z_k2_l2_ * z_k2_l2_) * -0.7213475)));
    float weight_k2_l3_ = (0.1875 * exp2(((z_k2_l3_ * z_k2_l3_) * -0.7213475)));
    float total_k2_l0_ = (((0.5625 * exp2(((z_k0_l0_ * z_k0_l0_) * -0.7213475))) + weight_k1_l0_) + weight_k2_l0_);
    float total_k2_l1_ = (((0.5625 * exp2(((z_k0_l1_ * z_k0_l1_) * -0.7213475))) + weight_k1_l1_) + weight_k2_l1_);
    float total_k2_l2_ = (((0.5625 * exp2(((z_k0_l2_ * z_k0_l2_) * -0.7213475))) + weight_k1_l2_) + weight_k2_l2_);
    float total_k2_l3_ = (((0.5625 * exp2(((z_k0_l3_ * z_k0_l3_) * -0.7213475))) + weight_k1_l3_) + weight_k2_l3_);
    bool nearer_k2_l0_ = (away_k2_l0_ < nearest_k1_l0_);
    bool nearer_k2_l1_ = (away_k2_l1_ < nearest_k1_l1_);
    bool nearer_k2_l2_ = (away_k2_l2_ < nearest_k1_l2_);
    bool nearer_k2_l3_ = (away_k2_l3_ < nearest_k1_l3_);
    float4 fallback_k2_l0_ = (nearer_k2_l0_ ? taps_3_ : (nearer_k1_l0_ ? taps_2_ : taps));
    float4 fallback_k2_l1_ = (nearer_k2_l1_ ? taps_4_ : (nearer_k1_l1_ ? taps : taps_2_));
    float4 fallback_k2_l2_ = (nearer_k2_l2_ ? taps : (nearer_k1_l2_ ? taps_4_ : taps_3_));
    float4 fallback_k2_l3_ = (nearer_k2_l3_ ? taps_2_ : (nearer_k1_l3_ ? taps_3_ : taps_4_));
    float away_k3_l0_ = abs((texel_l3_2_.w - own_depth_l0_));
    float away_k3_l1_ = abs((texel_l2_2_.w - own_depth_l1_));
    float away_k3_l2_ = abs((texel_l1_2_.w - own_depth_l2_));
    float away_k3_l3_ = abs((texel_l0_2_.w - own_depth_l3_));
    float z_k3_l0_ = (away_k3_l0_ / 0.1);
    float z_k3_l1_ = (away_k3_l1_ / 0.1);
    float z_k3_l2_ = (away_k3_l2_ / 0.1);
    float z_k3_l3_ = (away_k3_l3_ / 0.1);
    float weight_k3_l0_ = (0.0625 * exp2(((z_k3_l0_ * z_k3_l0_) * -0.7213475)));
    float weight_k3_l1_ = (0.0625 * exp2(((z_k3_l1_ * z_k3_l1_) * -0.7213475)));
    float weight_k3_l2_ = (0.0625 * exp2(((z_k3_l2_ * z_k3_l2_) * -0.7213475)));
    float weight_k3_l3_ = (0.0625 * exp2(((z_k3_l3_ * z_k3_l3_) * -0.7213475)));
    float total_k3_l0_ = (total_k2_l0_ + weight_k3_l0_);
    float total_k3_l1_ = (total_k2_l1_ + weight_k3_l1_);
    float total_k3_l2_ = (total_k2_l2_ + weight_k3_l2_);
    float total_k3_l3_ = (total_k2_l3_ + weight_k3_l3_);
    bool nearer_k3_l0_ = (away_k3_l0_ < (nearer_k2_l0_ ? away_k2_l0_ : nearest_k1_l0_));
    bool nearer_k3_l1_ = (away_k3_l1_ < (nearer_k2_l1_ ? away_k2_l1_ : nearest_k1_l1_));
    bool nearer_k3_l2_ = (away_k3_l2_ < (nearer_k2_l2_ ? away_k2_l2_ : nearest_k1_l2_));
    bool nearer_k3_l3_ = (away_k3_l3_ < (nearer_k2_l3_ ? away_k2_l3_ : nearest_k1_l3_));
    float4 fallback_k3_l0_ = (nearer_k3_l0_ ? taps_4_ : fallback_k2_l0_);
    float4 fallback_k3_l1_ = (nearer_k3_l1_ ? taps_3_ : fallback_k2_l1_);
    float4 fallback_k3_l2_ = (nearer_k3_l2_ ? taps_2_ : fallback_k2_l2_);
    float4 fallback_k3_l3_ = (nearer_k3_l3_ ? taps : fallback_k2_l3_);
    float scale_l0_ = (1.0 / max(total_k3_l0_, 1e-20));
    float scale_l1_ = (1.0 / max(total_k3_l1_, 1e-20));
    float scale_l2_ = (1.0 / max(total_k3_l2_, 1e-20));
    float scale_l3_ = (1.0 / max(total_k3_l3_, 1e-20));
    float4 color_k1_l0_ = (taps + ((taps_2_ - taps) * (weight_k1_l0_ * scale_l0_)));
    float4 color_k1_l1_ = (taps_2_ + ((taps - taps_2_) * (weight_k1_l1_ * scale_l1_)));
    float4 color_k1_l2_ = (taps_3_ + ((taps_4_ - taps_3_) * (weight_k1_l2_ * scale_l2_)));
    float4 color_k1_l3_ = (taps_4_ + ((taps_3_ - taps_4_) * (weight_k1_l3_ * scale_l3_)));
    float4 color_k2_l0_ = (color_k1_l0_ + ((taps_3_ - taps) * (weight_k2_l0_ * scale_l0_)));
    float4 color_k2_l1_ = (color_k1_l1_ + ((taps_4_ - taps_2_) * (weight_k2_l1_ * scale_l1_)));
    float4 color_k2_l2_ = (color_k1_l2_ + ((taps - taps_3_) * (weight_k2_l2_ * scale_l2_)));
    float4 color_k2_l3_ = (color_k1_l3_ + ((taps_2_ - taps_4_) * (weight_k2_l3_ * scale_l3_)));
    float4 color_k3_l0_ = (color_k2_l0_ + ((taps_4_ - taps) * (weight_k3_l0_ * scale_l0_)));
    float4 color_k3_l1_ = (color_k2_l1_ + ((taps_3_ - taps_2_) * (weight_k3_l1_ * scale_l1_)));
    float4 color_k3_l2_ = (color_k2_l2_ + ((taps_2_ - taps_3_) * (weight_k3_l2_ * scale_l2_)));
    float4 color_k3_l3_ = (color_k2_l3_ + ((taps - taps_4_) * (weight_k3_l3_ * scale_l3_)));
    destination[pixel] = ((total_k3_l0_ > 1e-20) ? color_k3_l0_ : fallback_k3_l0_);
    if (all((asint(asuint(pixel) + asuint(int2(int(1), int(0)))) < frame))) {
        destination[asint(asuint(pixel) + asuint(int2(int(1), int(0))))] = ((total_k3_l1_ > 1e-20) ? color_k3_l1_ : fallback_k3_l1_);
    }
    if (all((asint(asuint(pixel) + asuint(int2(int(0), int(1)))) < frame))) {
        destination[asint(asuint(pixel) + asuint(int2(int(0), int(1))))] = ((total_k3_l2_ > 1e-20) ? color_k3_l2_ : fallback_k3_l2_);
    }
    if (all((asint(asuint(pixel) + asuint((int(1)).xx)) < frame))) {
        destination[asint(asuint(pixel) + asuint((int(1)).xx))] = ((total_k3_l3_ > 1e-20) ? color_k3_l3_ : fallback_k3_l3_);
        return;
    } else {
        return;
    }
}
