// language: metal2.0
#include <metal_stdlib>
#include <simd/simd.h>

using metal::uint;

metal::int2 naga_div(metal::int2 lhs, metal::int2 rhs) {
    return lhs / metal::select(rhs, 1, (lhs == (-2147483647 - 1) & rhs == -1) | (rhs == 0));
}


struct quad_upsamplingInput {
};
kernel void quad_upsampling(
  metal::uint3 id [[thread_position_in_grid]]
, metal::texture2d<float, metal::access::sample> low [[texture(0)]]
, metal::texture2d<float, metal::access::sample> depth [[texture(1)]]
, metal::texture2d<float, metal::access::write> destination [[texture(2)]]
) {
    metal::int2 frame = static_cast<metal::int2>(metal::uint2(destination.get_width(), destination.get_height()));
    metal::int2 pixel = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(id.xy)) * as_type<metal::uint2>(metal::int2(2)));
    if (metal::any(pixel >= frame)) {
        return;
    }
    metal::int2 sum = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0)));
    metal::int2 sum_2_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1)));
    metal::int2 sum_3_ = as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1)));
    metal::int2 last = as_type<metal::int2>(as_type<metal::uint2>(frame) - as_type<metal::uint2>(metal::int2(1)));
    metal::float4 _e27 = depth.read(metal::uint2(pixel), 0);
    float depth_l0_ = _e27.x;
    metal::float4 _e32 = depth.read(metal::uint2(metal::min(sum, last)), 0);
    float depth_l1_ = _e32.x;
    metal::float4 _e37 = depth.read(metal::uint2(metal::min(sum_2_, last)), 0);
    float depth_l2_ = _e37.x;
    metal::float4 _e42 = depth.read(metal::uint2(metal::min(sum_3_, last)), 0);
    float depth_l3_ = _e42.x;
    float own_depth_l0_ = (metal::abs(depth_l0_) < 1000000000000000000000000000000.0) ? depth_l0_ : 1000000000000000000000000000000.0;
    float own_depth_l1_ = (metal::abs(depth_l1_) < 1000000000000000000000000000000.0) ? depth_l1_ : 1000000000000000000000000000000.0;
    float own_depth_l2_ = (metal::abs(depth_l2_) < 1000000000000000000000000000000.0) ? depth_l2_ : 1000000000000000000000000000000.0;
    float own_depth_l3_ = (metal::abs(depth_l3_) < 1000000000000000000000000000000.0) ? depth_l3_ : 1000000000000000000000000000000.0;
    metal::int2 last_2_ = as_type<metal::int2>(as_type<metal::uint2>(static_cast<metal::int2>(metal::uint2(low.get_width(), low.get_height()))) - as_type<metal::uint2>(metal::int2(1)));
    metal::float4 own_l0_ = low.read(metal::uint2(metal::clamp(naga_div(pixel, metal::int2(2)), metal::int2(0), last_2_)), 0);
    metal::float4 own_l1_ = low.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(naga_div(sum, metal::int2(2))) + as_type<metal::uint2>(metal::int2(1, 0))), metal::int2(0), last_2_)), 0);
    metal::float4 own_l2_ = low.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(naga_div(sum_2_, metal::int2(2))) + as_type<metal::uint2>(metal::int2(0, 1))), metal::int2(0), last_2_)), 0);
    metal::float4 own_l3_ = low.read(metal::uint2(metal::clamp(as_type<metal::int2>(as_type<metal::uint2>(naga_div(sum_3_, metal::int2(2))) + as_type<metal::uint2>(metal::int2(1))), metal::int2(0), last_2_)), 0);
    bool color_l0_ = metal::all(metal::abs(own_l0_.xyz) < metal::float3(300000000000000000000000000000000000000.0));
    bool color_l1_ = metal::all(metal::abs(own_l1_.xyz) < metal::float3(300000000000000000000000000000000000000.0));
    bool color_l2_ = metal::all(metal::abs(own_l2_.xyz) < metal::float3(300000000000000000000000000000000000000.0));
    bool color_l3_ = metal::all(metal::abs(own_l3_.xyz) < metal::float3(300000000000000000000000000000000000000.0));
    metal::float4 vector = metal::float4(own_l0_.xyz, (metal::abs(own_l0_.w) < 1000000000000000000000000000000.0) ? own_l0_.w : 1000000000000000000000000000000.0);
    metal::float4 vector_2_ = metal::float4(own_l1_.xyz, (metal::abs(own_l1_.w) < 1000000000000000000000000000000.0) ? own_l1_.w : 1000000000000000000000000000000.0);
    metal::float4 vector_3_ = metal::float4(own_l2_.xyz, (metal::abs(own_l2_.w) < 1000000000000000000000000000000.0) ? own_l2_.w : 1000000000000000000000000000000.0);
    metal::float4 vector_4_ = metal::float4(own_l3_.xyz, (metal::abs(own_l3_.w) < 1000000000000000000000000000000.0) ? own_l3_.w : 1000000000000000000000000000000.0);
    metal::float4 counted_l0_ = color_l0_ ? vector : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 counted_l1_ = color_l1_ ? vector_2_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 counted_l2_ = color_l2_ ? vector_3_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 counted_l3_ = color_l3_ ? vector_4_ : metal::float4(0.0, 0.0, 0.0, -1000000000000000000000000000000.0);
    metal::float4 taps = metal::float4(counted_l0_.xyz, 1.0);
    metal::float4 taps_2_ = metal::float4(counted_l1_.xyz, 1.0);
    metal::float4 taps_3_ = metal::float4(counted_l2_.xyz, 1.0);
    metal::float4 taps_4_ = metal::float4(counted_l3_.xyz, 1.0);
    float away_k0_l0_ = metal::abs(counted_l0_.w - own_depth_l0_);
    float away_k0_l1_ = metal::abs(counted_l1_.w - own_depth_l1_);
    float away_k0_l2_ = metal::abs(counted_l2_.w - own_depth_l2_);
    float away_k0_l3_ = metal::abs(counted_l3_.w - own_depth_l3_);
    float z_k0_l0_ = away_k0_l0_ / 0.1;
    float z_k0_l1_ = away_k0_l1_ / 0.1;
    float z_k0_l2_ = away_k0_l2_ / 0.1;
    float z_k0_l3_ = away_k0_l3_ / 0.1;
    float away_k1_l0_ = metal::abs(counted_l1_.w - own_depth_l0_);
    float away_k1_l1_ = metal::abs(counted_l0_.w - own_depth_l1_);
    float away_k1_l2_ = metal::abs(counted_l3_.w - own_depth_l2_);
    float away_k1_l3_ = metal::abs(counted_l2_.w - own_depth_l3_);
    float z_k1_l0_ = away_k1_l0_ / 0.1;
    float z_k1_l1_ = away_k1_l1_ / 0.1;
    float z_k1_l2_ = away_k1_l2_ / 0.1;
    float z_k1_l3_ = away_k1_l3_ / 0.1;
    float weight_k1_l0_ = 0.1875 * metal::exp2((z_k1_l0_ * z_k1_l0_) * -0.7213475);
    float weight_k1_l1_ = 0.1875 * metal::exp2((z_k1_l1_ * z_k1_l1_) * -0.7213475);
    float weight_k1_l2_ = 0.1875 * metal::exp2((z_k1_l2_ * z_k1_l2_) * -0.7213475);
    float weight_k1_l3_ = 0.1875 * metal::exp2((z_k1_l3_ * z_k1_l3_) * -0.7213475);
    bool nearer_k1_l0_ = away_k1_l0_ < away_k0_l0_;
    bool nearer_k1_l1_ = away_k1_l1_ < away_k0_l1_;
    bool nearer_k1_l2_ = away_k1_l2_ < away_k0_l2_;
    bool nearer_k1_l3_ = away_k1_l3_ < away_k0_l3_;
    float nearest_k1_l0_ = nearer_k1_l0_ ? away_k1_l0_ : away_k0_l0_;
    float nearest_k1_l1_ = nearer_k1_l1_ ? away_k1_l1_ : away_k0_l1_;
    float nearest_k1_l2_ = nearer_k1_l2_ ? away_k1_l2_ : away_k0_l2_;
    float nearest_k1_l3_ = nearer_k1_l3_ ? away_k1_l3_ : away_k0_l3_;
    float away_k2_l0_ = metal::abs(counted_l2_.w - own_depth_l0_);
    float away_k2_l1_ = metal::abs(counted_l3_.w - own_depth_l1_);
    float away_k2_l2_ = metal::abs(counted_l0_.w - own_depth_l2_);
    float away_k2_l3_ = metal::abs(counted_l1_.w - own_depth_l3_);
    float z_k2_l0_ = away_k2_l0_ / 0.1;
    float z_k2_l1_ = away_k2_l1_ / 0.1;
    float z_k2_l2_ = away_k2_l2_ / 0.1;
    float z_k2_l3_ = away_k2_l3_ / 0.1;
    float weight_k2_l0_ = 0.1875 * metal::exp2((z_k2_l0_ * z_k2_l0_) * -0.7213475);
    float weight_k2_l1_ = 0.1875 * metal::exp2((z_k2_l1_ * z_k2_l1_) * -0.7213475);
    float weight_k2_l2_ = 0.1875 * metal::exp2((z_k2_l2_ * z_k2_l2_) * -0.7213475);
    float weight_k2_l3_ = 0.1875 * metal::exp2((z_k2_l3_ * z_k2_l3_) * -0.7213475);
    float total_k2_l0_ = ((0.5625 * metal::exp2((z_k0_l0_ * z_k0_l0_) * -0.7213475)) + weight_k1_l0_) + weight_k2_l0_;
    float total_k2_l1_ = ((0.5625 * metal::exp2((z_k0_l1_ * z_k0_l1_) * -0.7213475)) + weight_k1_l1_) + weight_k2_l1_;
    float total_k2_l2_ = ((0.5625 * metal::exp2((z_k0_l2_ * z_k0_l2_) * -0.7213475)) + weight_k1_l2_) + weight_k2_l2_;
    float total_k2_l3_ = ((0.5625 * metal::exp2((z_k0_l3_ * z_k0_l3_) * -0.7213475)) + weight_k1_l3_) + weight_k2_l3_;
    bool nearer_k2_l0_ = away_k2_l0_ < nearest_k1_l0_;
    bool nearer_k2_l1_ = away_k2_l1_ < nearest_k1_l1_;
    bool nearer_k2_l2_ = away_k2_l2_ < nearest_k1_l2_;
    bool nearer_k2_l3_ = away_k2_l3_ < nearest_k1_l3_;
    metal::float4 fallback_k2_l0_ = nearer_k2_l0_ ? taps_3_ : (nearer_k1_l0_ ? taps_2_ : taps);
    metal::float4 fallback_k2_l1_ = nearer_k2_l1_ ? taps_4_ : (nearer_k1_l1_ ? taps : taps_2_);
    metal::float4 fallback_k2_l2_ = nearer_k2_l2_ ? taps : (nearer_k1_l2_ ? taps_4_ : taps_3_);
    metal::float4 fallback_k2_l3_ = nearer_k2_l3_ ? taps_2_ : (nearer_k1_l3_ ? taps_3_ : taps_4_);
    float away_k3_l0_ = metal::abs(counted_l3_.w - own_depth_l0_);
    float away_k3_l1_ = metal::abs(counted_l2_.w - own_depth_l1_);
    float away_k3_l2_ = metal::abs(counted_l1_.w - own_depth_l2_);
    float away_k3_l3_ = metal::abs(counted_l0_.w - own_depth_l3_);
    float z_k3_l0_ = away_k3_l0_ / 0.1;
    float z_k3_l1_ = away_k3_l1_ / 0.1;
    float z_k3_l2_ = away_k3_l2_ / 0.1;
    float z_k3_l3_ = away_k3_l3_ / 0.1;
    float weight_k3_l0_ = 0.0625 * metal::exp2((z_k3_l0_ * z_k3_l0_) * -0.7213475);
    float weight_k3_l1_ = 0.0625 * metal::exp2((z_k3_l1_ * z_k3_l1_) * -0.7213475);
    float weight_k3_l2_ = 0.0625 * metal::exp2((z_k3_l2_ * z_k3_l2_) * -0.7213475);
    float weight_k3_l3_ = 0.0625 * metal::exp2((z_k3_l3_ * z_k3_l3_) * -0.7213475);
    float total_k3_l0_ = total_k2_l0_ + weight_k3_l0_;
    float total_k3_l1_ = total_k2_l1_ + weight_k3_l1_;
    float total_k3_l2_ = total_k2_l2_ + weight_k3_l2_;
    float total_k3_l3_ = total_k2_l3_ + weight_k3_l3_;
    bool nearer_k3_l0_ = away_k3_l0_ < (nearer_k2_l0_ ? away_k2_l0_ : nearest_k1_l0_);
    bool nearer_k3_l1_ = away_k3_l1_ < (nearer_k2_l1_ ? away_k2_l1_ : nearest_k1_l1_);
    bool nearer_k3_l2_ = away_k3_l2_ < (nearer_k2_l2_ ? away_k2_l2_ : nearest_k1_l2_);
    bool nearer_k3_l3_ = away_k3_l3_ < (nearer_k2_l3_ ? away_k2_l3_ : nearest_k1_l3_);
    metal::float4 fallback_k3_l0_ = nearer_k3_l0_ ? taps_4_ : fallback_k2_l0_;
    metal::float4 fallback_k3_l1_ = nearer_k3_l1_ ? taps_3_ : fallback_k2_l1_;
    metal::float4 fallback_k3_l2_ = nearer_k3_l2_ ? taps_2_ : fallback_k2_l2_;
    metal::float4 fallback_k3_l3_ = nearer_k3_l3_ ? taps : fallback_k2_l3_;
    float scale_l0_ = 1.0 / metal::max(total_k3_l0_, 0.00000000000000000001);
    float scale_l1_ = 1.0 / metal::max(total_k3_l1_, 0.00000000000000000001);
    float scale_l2_ = 1.0 / metal::max(total_k3_l2_, 0.00000000000000000001);
    float scale_l3_ = 1.0 / metal::max(total_k3_l3_, 0.00000000000000000001);
    metal::float4 color_k1_l0_ = taps + ((taps_2_ - taps) * (weight_k1_l0_ * scale_l0_));
    metal::float4 color_k1_l1_ = taps_2_ + ((taps - taps_2_) * (weight_k1_l1_ * scale_l1_));
    metal::float4 color_k1_l2_ = taps_3_ + ((taps_4_ - taps_3_) * (weight_k1_l2_ * scale_l2_));
    metal::float4 color_k1_l3_ = taps_4_ + ((taps_3_ - taps_4_) * (weight_k1_l3_ * scale_l3_));
    metal::float4 color_k2_l0_ = color_k1_l0_ + ((taps_3_ - taps) * (weight_k2_l0_ * scale_l0_));
    metal::float4 color_k2_l1_ = color_k1_l1_ + ((taps_4_ - taps_2_) * (weight_k2_l1_ * scale_l1_));
    metal::float4 color_k2_l2_ = color_k1_l2_ + ((taps - taps_3_) * (weight_k2_l2_ * scale_l2_));
    metal::float4 color_k2_l3_ = color_k1_l3_ + ((taps_2_ - taps_4_) * (weight_k2_l3_ * scale_l3_));
    metal::float4 color_k3_l0_ = color_k2_l0_ + ((taps_4_ - taps) * (weight_k3_l0_ * scale_l0_));
    metal::float4 color_k3_l1_ = color_k2_l1_ + ((taps_3_ - taps_2_) * (weight_k3_l1_ * scale_l1_));
    metal::float4 color_k3_l2_ = color_k2_l2_ + ((taps_2_ - taps_3_) * (weight_k3_l2_ * scale_l2_));
    metal::float4 color_k3_l3_ = color_k2_l3_ + ((taps - taps_4_) * (weight_k3_l3_ * scale_l3_));
    destination.write((total_k3_l0_ > 0.00000000000000000001) ? color_k3_l0_ : fallback_k3_l0_, metal::uint2(pixel));
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0))) < frame)) {
        destination.write((total_k3_l1_ > 0.00000000000000000001) ? color_k3_l1_ : fallback_k3_l1_, metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1, 0)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1))) < frame)) {
        destination.write((total_k3_l2_ > 0.00000000000000000001) ? color_k3_l2_ : fallback_k3_l2_, metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(0, 1)))));
    }
    if (metal::all(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1))) < frame)) {
        destination.write((total_k3_l3_ > 0.00000000000000000001) ? color_k3_l3_ : fallback_k3_l3_, metal::uint2(as_type<metal::int2>(as_type<metal::uint2>(pixel) + as_type<metal::uint2>(metal::int2(1)))));
        return;
    } else {
        return;
    }
}
