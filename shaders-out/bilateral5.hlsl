Texture2D<float4> image : register(t0);

struct FragmentInput_quad_bilateral {
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

float4 quad_bilateral(FragmentInput_quad_bilateral fragmentinput_quad_bilateral) : SV_Target0
{
    float4 position = fragmentinput_quad_bilateral.position_1;
    bool local = (bool)0;
    bool local_1 = (bool)0;
    bool local_2 = (bool)0;
    bool local_3 = (bool)0;
    bool local_4 = (bool)0;
    bool local_5 = (bool)0;
    bool local_6 = (bool)0;
    bool local_7 = (bool)0;
    bool local_8 = (bool)0;
    bool local_9 = (bool)0;
    bool local_10 = (bool)0;
    bool local_11 = (bool)0;
    bool local_12 = (bool)0;
    bool local_13 = (bool)0;
    bool local_14 = (bool)0;
    bool local_15 = (bool)0;
    bool local_16 = (bool)0;
    bool local_17 = (bool)0;

    int2 pixel = naga_f2i32(floor(position.xy));
    int2 frame = int2(NagaDimensions2D(image));
    int2 lane = (pixel & (int(1)).xx);
    float2 quad_vector = ((float2(lane) * (2.0).xx) - (1.0).xx);
    int2 outwards = naga_f2i32(quad_vector);
    int2 last = asint(asuint(frame) - asuint((int(1)).xx));
    int2 texel = clamp(pixel, (int(0)).xx, last);
    float4 own = image.Load(int3(texel, int(0)));
    if ((abs(own.x) < 3e38)) {
        local = (abs(own.y) < 3e38);
    } else {
        local = false;
    }
    bool _e38 = local;
    if (_e38) {
        local_1 = (abs(own.z) < 3e38);
    } else {
        local_1 = false;
    }
    bool counts = local_1;
    float chosen = ((abs(own.w) < 1e30) ? own.w : 1e30);
    float4 counted = float4(own.x, own.y, own.z, chosen);
    float4 centre = (counts ? counted : float4(0.0, 0.0, 0.0, -1e30));
    const float4 _e64 = QuadReadAcrossX(centre);
    const float4 _e65 = QuadReadAcrossY(centre);
    const float4 _e66 = QuadReadAcrossDiagonal(centre);
    float z_j0_i0_k0_ = ((centre.w - centre.w) / 0.1);
    float weight_j0_i0_k0_ = exp2(((z_j0_i0_k0_ * z_j0_i0_k0_) * -0.7213475));
    float3 value = float3(centre.x, centre.y, centre.z);
    float3 value_2_ = ((value - value) * weight_j0_i0_k0_);
    float4 sum_j0_i0_k0_ = ((0.0).xxxx + float4(value_2_.x, value_2_.y, value_2_.z, weight_j0_i0_k0_));
    float z_j0_i0_k1_ = ((_e64.w - centre.w) / 0.1);
    float weight_j0_i0_k1_ = exp2((((z_j0_i0_k1_ * z_j0_i0_k1_) + 0.25) * -0.7213475));
    float3 value_3_ = ((float3(_e64.x, _e64.y, _e64.z) - value) * weight_j0_i0_k1_);
    float4 sum_j0_i0_k1_ = (sum_j0_i0_k0_ + float4(value_3_.x, value_3_.y, value_3_.z, weight_j0_i0_k1_));
    float z_j0_i0_k2_ = ((_e65.w - centre.w) / 0.1);
    float weight_j0_i0_k2_ = exp2((((z_j0_i0_k2_ * z_j0_i0_k2_) + 0.25) * -0.7213475));
    float3 value_4_ = ((float3(_e65.x, _e65.y, _e65.z) - value) * weight_j0_i0_k2_);
    float4 sum_j0_i0_k2_ = (sum_j0_i0_k1_ + float4(value_4_.x, value_4_.y, value_4_.z, weight_j0_i0_k2_));
    float z_j0_i0_k3_ = ((_e66.w - centre.w) / 0.1);
    float weight_j0_i0_k3_ = exp2((((z_j0_i0_k3_ * z_j0_i0_k3_) + 0.5) * -0.7213475));
    float3 value_5_ = ((float3(_e66.x, _e66.y, _e66.z) - value) * weight_j0_i0_k3_);
    float4 sum_j0_i0_k3_ = (sum_j0_i0_k2_ + float4(value_5_.x, value_5_.y, value_5_.z, weight_j0_i0_k3_));
    int2 texel_j0_i1_ = clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint(int2(int(1), int(0)))))), (int(0)).xx, last);
    float4 image_texel = image.Load(int3(texel_j0_i1_, int(0)));
    if ((abs(image_texel.x) < 3e38)) {
        local_2 = (abs(image_texel.y) < 3e38);
    } else {
        local_2 = false;
    }
    bool _e177 = local_2;
    if (_e177) {
        local_3 = (abs(image_texel.z) < 3e38);
    } else {
        local_3 = false;
    }
    bool counts_j0_i1_ = local_3;
    float4 counted_j0_i1_ = float4(image_texel.x, image_texel.y, image_texel.z, ((abs(image_texel.w) < 1e30) ? image_texel.w : 1e30));
    float4 taps_0_j0_i1_ = (counts_j0_i1_ ? counted_j0_i1_ : float4(0.0, 0.0, 0.0, -1e30));
    const float4 _e203 = QuadReadAcrossX(taps_0_j0_i1_);
    const float4 _e204 = QuadReadAcrossY(taps_0_j0_i1_);
    const float4 _e205 = QuadReadAcrossDiagonal(taps_0_j0_i1_);
    float z_j0_i1_k0_ = ((taps_0_j0_i1_.w - centre.w) / 0.1);
    float weight_j0_i1_k0_ = exp2((((z_j0_i1_k0_ * z_j0_i1_k0_) + 0.25) * -0.7213475));
    float3 value_6_ = ((float3(taps_0_j0_i1_.x, taps_0_j0_i1_.y, taps_0_j0_i1_.z) - value) * weight_j0_i1_k0_);
    float4 sum_j0_i1_k0_ = (sum_j0_i0_k3_ + float4(value_6_.x, value_6_.y, value_6_.z, weight_j0_i1_k0_));
    float z_j0_i1_k1_ = ((_e203.w - centre.w) / 0.1);
    float weight_j0_i1_k1_ = exp2((((z_j0_i1_k1_ * z_j0_i1_k1_) + 1.0) * -0.7213475));
    float3 value_7_ = ((float3(_e203.x, _e203.y, _e203.z) - value) * weight_j0_i1_k1_);
    float4 sum_j0_i1_k1_ = (sum_j0_i1_k0_ + float4(value_7_.x, value_7_.y, value_7_.z, weight_j0_i1_k1_));
    float z_j0_i1_k2_ = ((_e204.w - centre.w) / 0.1);
    float weight_j0_i1_k2_ = exp2((((z_j0_i1_k2_ * z_j0_i1_k2_) + 0.5) * -0.7213475));
    float3 value_8_ = ((float3(_e204.x, _e204.y, _e204.z) - value) * weight_j0_i1_k2_);
    float4 sum_j0_i1_k2_ = (sum_j0_i1_k1_ + float4(value_8_.x, value_8_.y, value_8_.z, weight_j0_i1_k2_));
    float z_j0_i1_k3_ = ((_e205.w - centre.w) / 0.1);
    float weight_j0_i1_k3_ = exp2((((z_j0_i1_k3_ * z_j0_i1_k3_) + 1.25) * -0.7213475));
    float3 value_9_ = ((float3(_e205.x, _e205.y, _e205.z) - value) * weight_j0_i1_k3_);
    float4 sum_j0_i1_k3_ = (sum_j0_i1_k2_ + float4(value_9_.x, value_9_.y, value_9_.z, weight_j0_i1_k3_));
    int2 texel_j0_i2_ = clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint(int2(int(2), int(0)))))), (int(0)).xx, last);
    float4 image_texel_2_ = image.Load(int3(texel_j0_i2_, int(0)));
    if ((abs(image_texel_2_.x) < 3e38)) {
        local_4 = (abs(image_texel_2_.y) < 3e38);
    } else {
        local_4 = false;
    }
    bool _e316 = local_4;
    if (_e316) {
        local_5 = (abs(image_texel_2_.z) < 3e38);
    } else {
        local_5 = false;
    }
    bool counts_j0_i2_ = local_5;
    float4 counted_j0_i2_ = float4(image_texel_2_.x, image_texel_2_.y, image_texel_2_.z, ((abs(image_texel_2_.w) < 1e30) ? image_texel_2_.w : 1e30));
    float4 taps_0_j0_i2_ = (counts_j0_i2_ ? counted_j0_i2_ : float4(0.0, 0.0, 0.0, -1e30));
    const float4 _e342 = QuadReadAcrossY(taps_0_j0_i2_);
    float z_j0_i2_k0_ = ((taps_0_j0_i2_.w - centre.w) / 0.1);
    float weight_j0_i2_k0_ = exp2((((z_j0_i2_k0_ * z_j0_i2_k0_) + 1.0) * -0.7213475));
    float3 value_10_ = ((float3(taps_0_j0_i2_.x, taps_0_j0_i2_.y, taps_0_j0_i2_.z) - value) * weight_j0_i2_k0_);
    float4 sum_j0_i2_k0_ = (sum_j0_i1_k3_ + float4(value_10_.x, value_10_.y, value_10_.z, weight_j0_i2_k0_));
    float z_j0_i2_k2_ = ((_e342.w - centre.w) / 0.1);
    float weight_j0_i2_k2_ = exp2((((z_j0_i2_k2_ * z_j0_i2_k2_) + 1.25) * -0.7213475));
    float3 value_11_ = ((float3(_e342.x, _e342.y, _e342.z) - value) * weight_j0_i2_k2_);
    float4 sum_j0_i2_k2_ = (sum_j0_i2_k0_ + float4(value_11_.x, value_11_.y, value_11_.z, weight_j0_i2_k2_));
    int2 texel_j1_i0_ = clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint(int2(int(0), int(1)))))), (int(0)).xx, last);
    float4 image_texel_3_ = image.Load(int3(texel_j1_i0_, int(0)));
    if ((abs(image_texel_3_.x) < 3e38)) {
        local_6 = (abs(image_texel_3_.y) < 3e38);
    } else {
        local_6 = false;
    }
    bool _e409 = local_6;
    if (_e409) {
        local_7 = (abs(image_texel_3_.z) < 3e38);
    } else {
        local_7 = false;
    }
    bool counts_j1_i0_ = local_7;
    float4 counted_j1_i0_ = float4(image_texel_3_.x, image_texel_3_.y, image_texel_3_.z, ((abs(image_texel_3_.w) < 1e30) ? image_texel_3_.w : 1e30));
    float4 taps_0_j1_i0_ = (counts_j1_i0_ ? counted_j1_i0_ : float4(0.0, 0.0, 0.0, -1e30));
    const float4 _e435 = QuadReadAcrossX(taps_0_j1_i0_);
    const float4 _e436 = QuadReadAcrossY(taps_0_j1_i0_);
    const float4 _e437 = QuadReadAcrossDiagonal(taps_0_j1_i0_);
    float z_j1_i0_k0_ = ((taps_0_j1_i0_.w - centre.w) / 0.1);
    float weight_j1_i0_k0_ = exp2((((z_j1_i0_k0_ * z_j1_i0_k0_) + 0.25) * -0.7213475));
    float3 value_12_ = ((float3(taps_0_j1_i0_.x, taps_0_j1_i0_.y, taps_0_j1_i0_.z) - value) * weight_j1_i0_k0_);
    float4 sum_j1_i0_k0_ = (sum_j0_i2_k2_ + float4(value_12_.x, value_12_.y, value_12_.z, weight_j1_i0_k0_));
    float z_j1_i0_k1_ = ((_e435.w - centre.w) / 0.1);
    float weight_j1_i0_k1_ = exp2((((z_j1_i0_k1_ * z_j1_i0_k1_) + 0.5) * -0.7213475));
    float3 value_13_ = ((float3(_e435.x, _e435.y, _e435.z) - value) * weight_j1_i0_k1_);
    float4 sum_j1_i0_k1_ = (sum_j1_i0_k0_ + float4(value_13_.x, value_13_.y, value_13_.z, weight_j1_i0_k1_));
    float z_j1_i0_k2_ = ((_e436.w - centre.w) / 0.1);
    float weight_j1_i0_k2_ = exp2((((z_j1_i0_k2_ * z_j1_i0_k2_) + 1.0) * -0.7213475));
    float3 value_14_ = ((float3(_e436.x, _e436.y, _e436.z) - value) * weight_j1_i0_k2_);
    float4 sum_j1_i0_k2_ = (sum_j1_i0_k1_ + float4(value_14_.x, value_14_.y, value_14_.z, weight_j1_i0_k2_));
    float z_j1_i0_k3_ = ((_e437.w - centre.w) / 0.1);
    float weight_j1_i0_k3_ = exp2((((z_j1_i0_k3_ * z_j1_i0_k3_) + 1.25) * -0.7213475));
    float3 value_15_ = ((float3(_e437.x, _e437.y, _e437.z) - value) * weight_j1_i0_k3_);
    float4 sum_j1_i0_k3_ = (sum_j1_i0_k2_ + float4(value_15_.x, value_15_.y, value_15_.z, weight_j1_i0_k3_));
    int2 texel_j1_i1_ = clamp(asint(asuint(pixel) + asuint(outwards)), (int(0)).xx, last);
    float4 image_texel_4_ = image.Load(int3(texel_j1_i1_, int(0)));
    if ((abs(image_texel_4_.x) < 3e38)) {
        local_8 = (abs(image_texel_4_.y) < 3e38);
    } else {
        local_8 = false;
    }
    bool _e544 = local_8;
    if (_e544) {
        local_9 = (abs(image_texel_4_.z) < 3e38);
    } else {
        local_9 = false;
    }
    bool counts_j1_i1_ = local_9;
    float4 counted_j1_i1_ = float4(image_texel_4_.x, image_texel_4_.y, image_texel_4_.z, ((abs(image_texel_4_.w) < 1e30) ? image_texel_4_.w : 1e30));
    float4 taps_0_j1_i1_ = (counts_j1_i1_ ? counted_j1_i1_ : float4(0.0, 0.0, 0.0, -1e30));
    const float4 _e570 = QuadReadAcrossX(taps_0_j1_i1_);
    const float4 _e571 = QuadReadAcrossY(taps_0_j1_i1_);
    const float4 _e572 = QuadReadAcrossDiagonal(taps_0_j1_i1_);
    float z_j1_i1_k0_ = ((taps_0_j1_i1_.w - centre.w) / 0.1);
    float weight_j1_i1_k0_ = exp2((((z_j1_i1_k0_ * z_j1_i1_k0_) + 0.5) * -0.7213475));
    float3 value_16_ = ((float3(taps_0_j1_i1_.x, taps_0_j1_i1_.y, taps_0_j1_i1_.z) - value) * weight_j1_i1_k0_);
    float4 sum_j1_i1_k0_ = (sum_j1_i0_k3_ + float4(value_16_.x, value_16_.y, value_16_.z, weight_j1_i1_k0_));
    float z_j1_i1_k1_ = ((_e570.w - centre.w) / 0.1);
    float weight_j1_i1_k1_ = exp2((((z_j1_i1_k1_ * z_j1_i1_k1_) + 1.25) * -0.7213475));
    float3 value_17_ = ((float3(_e570.x, _e570.y, _e570.z) - value) * weight_j1_i1_k1_);
    float4 sum_j1_i1_k1_ = (sum_j1_i1_k0_ + float4(value_17_.x, value_17_.y, value_17_.z, weight_j1_i1_k1_));
    float z_j1_i1_k2_ = ((_e571.w - centre.w) / 0.1);
    float weight_j1_i1_k2_ = exp2((((z_j1_i1_k2_ * z_j1_i1_k2_) + 1.25) * -0.7213475));
    float3 value_18_ = ((float3(_e571.x, _e571.y, _e571.z) - value) * weight_j1_i1_k2_);
    float4 sum_j1_i1_k2_ = (sum_j1_i1_k1_ + float4(value_18_.x, value_18_.y, value_18_.z, weight_j1_i1_k2_));
    float z_j1_i1_k3_ = ((_e572.w - centre.w) / 0.1);
    float weight_j1_i1_k3_ = exp2((((z_j1_i1_k3_ * z_j1_i1_k3_) + 2.0) * -0.7213475));
    float3 value_19_ = ((float3(_e572.x, _e572.y, _e572.z) - value) * weight_j1_i1_k3_);
    float4 sum_j1_i1_k3_ = (sum_j1_i1_k2_ + float4(value_19_.x, value_19_.y, value_19_.z, weight_j1_i1_k3_));
    int2 texel_j1_i2_ = clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint(int2(int(2), int(1)))))), (int(0)).xx, last);
    float4 image_texel_5_ = image.Load(int3(texel_j1_i2_, int(0)));
    if ((abs(image_texel_5_.x) < 3e38)) {
        local_10 = (abs(image_texel_5_.y) < 3e38);
    } else {
        local_10 = false;
    }
    bool _e683 = local_10;
    if (_e683) {
        local_11 = (abs(image_texel_5_.z) < 3e38);
    } else {
        local_11 = false;
    }
    bool counts_j1_i2_ = local_11;
    float4 counted_j1_i2_ = float4(image_texel_5_.x, image_texel_5_.y, image_texel_5_.z, ((abs(image_texel_5_.w) < 1e30) ? image_texel_5_.w : 1e30));
    float4 taps_0_j1_i2_ = (counts_j1_i2_ ? counted_j1_i2_ : float4(0.0, 0.0, 0.0, -1e30));
    const float4 _e709 = QuadReadAcrossY(taps_0_j1_i2_);
    float z_j1_i2_k0_ = ((taps_0_j1_i2_.w - centre.w) / 0.1);
    float weight_j1_i2_k0_ = exp2((((z_j1_i2_k0_ * z_j1_i2_k0_) + 1.25) * -0.7213475));
    float3 value_20_ = ((float3(taps_0_j1_i2_.x, taps_0_j1_i2_.y, taps_0_j1_i2_.z) - value) * weight_j1_i2_k0_);
    float4 sum_j1_i2_k0_ = (sum_j1_i1_k3_ + float4(value_20_.x, value_20_.y, value_20_.z, weight_j1_i2_k0_));
    float z_j1_i2_k2_ = ((_e709.w - centre.w) / 0.1);
    float weight_j1_i2_k2_ = exp2((((z_j1_i2_k2_ * z_j1_i2_k2_) + 2.0) * -0.7213475));
    float3 value_21_ = ((float3(_e709.x, _e709.y, _e709.z) - value) * weight_j1_i2_k2_);
    float4 sum_j1_i2_k2_ = (sum_j1_i2_k0_ + float4(value_21_.x, value_21_.y, value_21_.z, weight_j1_i2_k2_));
    int2 texel_j2_i0_ = clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint(int2(int(0), int(2)))))), (int(0)).xx, last);
    float4 image_texel_6_ = image.Load(int3(texel_j2_i0_, int(0)));
    if ((abs(image_texel_6_.x) < 3e38)) {
        local_12 = (abs(image_texel_6_.y) < 3e38);
    } else {
        local_12 = false;
    }
    bool _e776 = local_12;
    if (_e776) {
        local_13 = (abs(image_texel_6_.z) < 3e38);
    } else {
        local_13 = false;
    }
    bool counts_j2_i0_ = local_13;
    float4 counted_j2_i0_ = float4(image_texel_6_.x, image_texel_6_.y, image_texel_6_.z, ((abs(image_texel_6_.w) < 1e30) ? image_texel_6_.w : 1e30));
    float4 taps_0_j2_i0_ = (counts_j2_i0_ ? counted_j2_i0_ : float4(0.0, 0.0, 0.0, -1e30));
    const float4 _e802 = QuadReadAcrossX(taps_0_j2_i0_);
    float z_j2_i0_k0_ = ((taps_0_j2_i0_.w - centre.w) / 0.1);
    float weight_j2_i0_k0_ = exp2((((z_j2_i0_k0_ * z_j2_i0_k0_) + 1.0) * -0.7213475));
    float3 value_22_ = ((float3(taps_0_j2_i0_.x, taps_0_j2_i0_.y, taps_0_j2_i0_.z) - value) * weight_j2_i0_k0_);
    float4 sum_j2_i0_k0_ = (sum_j1_i2_k2_ + float4(value_22_.x, value_22_.y, value_22_.z, weight_j2_i0_k0_));
    float z_j2_i0_k1_ = ((_e802.w - centre.w) / 0.1);
    float weight_j2_i0_k1_ = exp2((((z_j2_i0_k1_ * z_j2_i0_k1_) + 1.25) * -0.7213475));
    float3 value_23_ = ((float3(_e802.x, _e802.y, _e802.z) - value) * weight_j2_i0_k1_);
    float4 sum_j2_i0_k1_ = (sum_j2_i0_k0_ + float4(value_23_.x, value_23_.y, value_23_.z, weight_j2_i0_k1_));
    int2 texel_j2_i1_ = clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint(int2(int(1), int(2)))))), (int(0)).xx, last);
    float4 image_texel_7_ = image.Load(int3(texel_j2_i1_, int(0)));
    if ((abs(image_texel_7_.x) < 3e38)) {
        local_14 = (abs(image_texel_7_.y) < 3e38);
    } else {
        local_14 = false;
    }
    bool _e869 = local_14;
    if (_e869) {
        local_15 = (abs(image_texel_7_.z) < 3e38);
    } else {
        local_15 = false;
    }
    bool counts_j2_i1_ = local_15;
    float4 counted_j2_i1_ = float4(image_texel_7_.x, image_texel_7_.y, image_texel_7_.z, ((abs(image_texel_7_.w) < 1e30) ? image_texel_7_.w : 1e30));
    float4 taps_0_j2_i1_ = (counts_j2_i1_ ? counted_j2_i1_ : float4(0.0, 0.0, 0.0, -1e30));
    const float4 _e895 = QuadReadAcrossX(taps_0_j2_i1_);
    float z_j2_i1_k0_ = ((taps_0_j2_i1_.w - centre.w) / 0.1);
    float weight_j2_i1_k0_ = exp2((((z_j2_i1_k0_ * z_j2_i1_k0_) + 1.25) * -0.7213475));
    float3 value_24_ = ((float3(taps_0_j2_i1_.x, taps_0_j2_i1_.y, taps_0_j2_i1_.z) - value) * weight_j2_i1_k0_);
    float4 sum_j2_i1_k0_ = (sum_j2_i0_k1_ + float4(value_24_.x, value_24_.y, value_24_.z, weight_j2_i1_k0_));
    float z_j2_i1_k1_ = ((_e895.w - centre.w) / 0.1);
    float weight_j2_i1_k1_ = exp2((((z_j2_i1_k1_ * z_j2_i1_k1_) + 2.0) * -0.7213475));
    float3 value_25_ = ((float3(_e895.x, _e895.y, _e895.z) - value) * weight_j2_i1_k1_);
    float4 sum_j2_i1_k1_ = (sum_j2_i1_k0_ + float4(value_25_.x, value_25_.y, value_25_.z, weight_j2_i1_k1_));
    int2 texel_j2_i2_ = clamp(asint(asuint(pixel) + asuint(asint(asuint(outwards) * asuint((int(2)).xx)))), (int(0)).xx, last);
    float4 image_texel_8_ = image.Load(int3(texel_j2_i2_, int(0)));
    if ((abs(image_texel_8_.x) < 3e38)) {
        local_16 = (abs(image_texel_8_.y) < 3e38);
    } else {
        local_16 = false;
    }
    bool _e961 = local_16;
    if (_e961) {
        local_17 = (abs(image_texel_8_.z) < 3e38);
    } else {
        local_17 = false;
    }
    bool counts_j2_i2_ = local_17;
    float4 counted_j2_i2_ = float4(image_texel_8_.x, image_texel_8_.y, image_texel_8_.z, ((abs(image_texel_8_.w) < 1e30) ? image_texel_8_.w : 1e30));
    float4 taps_0_j2_i2_ = (counts_j2_i2_ ? counted_j2_i2_ : float4(0.0, 0.0, 0.0, -1e30));
    float z_j2_i2_k0_ = ((taps_0_j2_i2_.w - centre.w) / 0.1);
    float weight_j2_i2_k0_ = exp2((((z_j2_i2_k0_ * z_j2_i2_k0_) + 2.0) * -0.7213475));
    float3 value_26_ = ((float3(taps_0_j2_i2_.x, taps_0_j2_i2_.y, taps_0_j2_i2_.z) - value) * weight_j2_i2_k0_);
    float4 sum_j2_i2_k0_ = (sum_j2_i1_k1_ + float4(value_26_.x, value_26_.y, value_26_.z, weight_j2_i2_k0_));
    float3 value_27_ = (value + (float3(sum_j2_i2_k0_.x, sum_j2_i2_k0_.y, sum_j2_i2_k0_.z) / (sum_j2_i2_k0_.w).xxx));
    return float4(value_27_.x, value_27_.y, value_27_.z, chosen);
}
