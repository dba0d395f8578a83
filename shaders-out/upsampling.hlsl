Texture2D<float4> low : register(t0);
Texture2D<float4> depth : register(t1);

struct FragmentInput_quad_upsampling {
    float4 position_1 : SV_Position;
};

int2 naga_div(int2 lhs, int2 rhs) {
    return lhs / (((lhs == int(-2147483647 - 1) & rhs == -1) | (rhs == 0)) ? 1 : rhs);
}

int2 naga_f2i32(float2 value) {
    return int2(clamp(value, -2147483600.0, 2147483500.0));
}

uint2 NagaDimensions2D(Texture2D<float4> tex)
{
    uint4 ret;
    tex.GetDimensions(0, ret.x, ret.y, ret.z);
    return ret.xy;
}

float4 quad_upsampling(FragmentInput_quad_upsampling fragmentinput_quad_upsampling) : SV_Target0
{
    float4 position = fragmentinput_quad_upsampling.position_1;
    int2 pixel = naga_f2i32(floor(position.xy));
    int2 frame = int2(NagaDimensions2D(depth));
    float4 _e15 = depth.Load(int3(clamp(pixel, (int(0)).xx, asint(asuint(frame) - asuint((int(1)).xx))), int(0)));
    float depth_2_ = _e15.x;
    float own_depth = ((abs(depth_2_) < 1e30) ? depth_2_ : 1e30);
    int2 sum = asint(asuint(naga_div(pixel, (int(2)).xx)) + asuint((pixel & (int(1)).xx)));
    float4 texel = low.Load(int3(clamp(sum, (int(0)).xx, asint(asuint(int2(NagaDimensions2D(low))) - asuint((int(1)).xx))), int(0)));
    float4 vector_ = float4(texel.xyz, ((abs(texel.w) < 1e30) ? texel.w : 1e30));
    float4 texel_2_ = (all((abs(texel.xyz) < (3e38).xxx)) ? vector_ : float4(0.0, 0.0, 0.0, -1e30));
    const float4 _e62 = QuadReadAcrossX(texel_2_);
    const float4 _e63 = QuadReadAcrossY(texel_2_);
    const float4 _e64 = QuadReadAcrossDiagonal(texel_2_);
    float4 taps_k0_ = float4(texel_2_.xyz, 1.0);
    float4 taps_k1_ = float4(_e62.xyz, 1.0);
    float4 taps_k2_ = float4(_e63.xyz, 1.0);
    float4 taps_k3_ = float4(_e64.xyz, 1.0);
    float away_k0_ = abs((texel_2_.w - own_depth));
    float z_k0_ = (away_k0_ / 0.1);
    float away_k1_ = abs((_e62.w - own_depth));
    float z_k1_ = (away_k1_ / 0.1);
    float weight_k1_ = (0.1875 * exp2(((z_k1_ * z_k1_) * -0.7213475)));
    bool nearer_k1_ = (away_k1_ < away_k0_);
    float nearest_k1_ = (nearer_k1_ ? away_k1_ : away_k0_);
    float away_k2_ = abs((_e63.w - own_depth));
    float z_k2_ = (away_k2_ / 0.1);
    float weight_k2_ = (0.1875 * exp2(((z_k2_ * z_k2_) * -0.7213475)));
    bool nearer_k2_ = (away_k2_ < nearest_k1_);
    float4 fallback_k2_ = (nearer_k2_ ? taps_k2_ : (nearer_k1_ ? taps_k1_ : taps_k0_));
    float away_k3_ = abs((_e64.w - own_depth));
    float z_k3_ = (away_k3_ / 0.1);
    float weight_k3_ = (0.0625 * exp2(((z_k3_ * z_k3_) * -0.7213475)));
    float total_k3_ = ((((0.5625 * exp2(((z_k0_ * z_k0_) * -0.7213475))) + weight_k1_) + weight_k2_) + weight_k3_);
    bool nearer_k3_ = (away_k3_ < (nearer_k2_ ? away_k2_ : nearest_k1_));
    float4 fallback_k3_ = (nearer_k3_ ? taps_k3_ : fallback_k2_);
    float scale = (1.0 / max(total_k3_, 1e-20));
    float4 color_k1_ = (taps_k0_ + ((taps_k1_ - taps_k0_) * (weight_k1_ * scale)));
    float4 color_k2_ = (color_k1_ + ((taps_k2_ - taps_k0_) * (weight_k2_ * scale)));
    float4 color_k3_ = (color_k2_ + ((taps_k3_ - taps_k0_) * (weight_k3_ * scale)));
    return ((total_k3_ > 1e-20) ? color_k3_ : fallback_k3_);
}
