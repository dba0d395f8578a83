@binding(3) @group(0) var destination_0 : texture_storage_2d<rgba16float, write>;

@binding(0) @group(0) var depth_0 : texture_2d_array<f32>;

@binding(1) @group(0) var normal_0 : texture_2d_array<f32>;

@binding(2) @group(0) var color_0 : texture_2d<f32>;

struct Surface_0
{
     depth_1 : f32,
     normal_1 : vec3<f32>,
};

fn Surface_x24init_0( depth_2 : f32,  normal_2 : vec3<f32>) -> Surface_0
{
    var _S1 : Surface_0;
    _S1.depth_1 = depth_2;
    _S1.normal_1 = normal_2;
    return _S1;
}

fn surface_0( at_0 : vec2<i32>,  layer_0 : i32) -> Surface_0
{
    var _S2 : vec4<i32> = vec4<i32>(at_0, layer_0, i32(0));
    return Surface_x24init_0(min((textureLoad((depth_0), ((_S2)).xy, i32(((_S2)).z), ((_S2)).w).x), 1.00000001504746622e+30f), (textureLoad((normal_0), ((_S2)).xy, i32(((_S2)).z), ((_S2)).w)).xyz);
}

fn offset_0( s_0 : i32) -> vec2<f32>
{
    var _S3 : vec2<f32> = vec2<f32>(0.5f);
    return (vec2<f32>(f32(s_0 % i32(2)), f32(s_0 / i32(2))) + _S3) / vec2<f32>(2.0f) - _S3;
}

fn near_0( s_1 : i32,  tap_0 : i32) -> bool
{
    var away_0 : vec2<f32> = vec2<f32>(f32(tap_0 % i32(3) - i32(1)), f32(tap_0 / i32(3) - i32(1))) + offset_0(i32(0)) - offset_0(s_1);
    var _S4 : bool;
    if((abs(away_0.x)) <= 1.0f)
    {
        _S4 = (abs(away_0.y)) <= 1.0f;
    }
    else
    {
        _S4 = false;
    }
    return _S4;
}

fn difference_0( a_0 : Surface_0,  b_0 : Surface_0) -> f32
{
    var turn_0 : vec3<f32> = a_0.normal_1 - b_0.normal_1;
    return max(abs(a_0.depth_1 - b_0.depth_1), 2.0f * dot(turn_0, turn_0));
}

@compute
@workgroup_size(16, 16, 1)
fn sraa(@builtin(global_invocation_id) id_0 : vec3<u32>)
{
    var width_0 : u32;
    var height_0 : u32;
    {var dim = textureDimensions((destination_0));((width_0)) = dim.x;((height_0)) = dim.y;};
    var size_0 : vec2<i32> = vec2<i32>(i32(width_0), i32(height_0));
    var _S5 : vec2<i32> = vec2<i32>(id_0.xy);
    if((any((_S5 >= size_0))))
    {
        return;
    }
    var taps_0 : array<Surface_0, i32(9)>;
    var weights_0 : array<f32, i32(9)>;
    var _S6 : vec2<i32> = vec2<i32>(i32(0));
    var _S7 : vec2<i32> = size_0 - vec2<i32>(i32(1));
    var at_1 : vec2<i32> = clamp(_S5 + vec2<i32>(i32(-1), i32(-1)), _S6, _S7);
    taps_0[i32(0)] = surface_0(at_1, i32(0));
    weights_0[i32(0)] = 0.0f;
    var at_2 : vec2<i32> = clamp(_S5 + vec2<i32>(i32(0), i32(-1)), _S6, _S7);
    taps_0[i32(1)] = surface_0(at_2, i32(0));
    weights_0[i32(1)] = 0.0f;
    var at_3 : vec2<i32> = clamp(_S5 + vec2<i32>(i32(1), i32(-1)), _S6, _S7);
    taps_0[i32(2)] = surface_0(at_3, i32(0));
    weights_0[i32(2)] = 0.0f;
    var at_4 : vec2<i32> = clamp(_S5 + vec2<i32>(i32(-1), i32(0)), _S6, _S7);
    taps_0[i32(3)] = surface_0(at_4, i32(0));
    weights_0[i32(3)] = 0.0f;
    var at_5 : vec2<i32> = clamp(_S5, _S6, _S7);
    taps_0[i32(4)] = surface_0(at_5, i32(0));
    weights_0[i32(4)] = 0.0f;
    var at_6 : vec2<i32> = clamp(_S5 + vec2<i32>(i32(1), i32(0)), _S6, _S7);
    taps_0[i32(5)] = surface_0(at_6, i32(0));
    weights_0[i32(5)] = 0.0f;
    var at_7 : vec2<i32> = clamp(_S5 + vec2<i32>(i32(-1), i32(1)), _S6, _S7);
    taps_0[i32(6)] = surface_0(at_7, i32(0));
    weights_0[i32(6)] = 0.0f;
    var at_8 : vec2<i32> = clamp(_S5 + vec2<i32>(i32(0), i32(1)), _S6, _S7);
    taps_0[i32(7)] = surface_0(at_8, i32(0));
    weights_0[i32(7)] = 0.0f;
    var at_9 : vec2<i32> = clamp(_S5 + vec2<i32>(i32(1), i32(1)), _S6, _S7);
    taps_0[i32(8)] = surface_0(at_9, i32(0));
    weights_0[i32(8)] = 0.0f;
    var _S8 : Surface_0 = surface_0(_S5, i32(0));
    var own_0 : array<f32, i32(9)>;
    var _S9 : bool = near_0(i32(0), i32(0));
    var sum_0 : f32;
    if(_S9)
    {
        var _S10 : f32 = exp2(-721.3475341796875f * difference_0(_S8, taps_0[i32(0)]));
        own_0[i32(0)] = _S10;
        sum_0 = _S10;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S11 : bool = near_0(i32(0), i32(1));
    if(_S11)
    {
        var _S12 : f32 = exp2(-721.3475341796875f * difference_0(_S8, taps_0[i32(1)]));
        own_0[i32(1)] = _S12;
        sum_0 = sum_0 + _S12;
    }
    var _S13 : bool = near_0(i32(0), i32(2));
    if(_S13)
    {
        var _S14 : f32 = exp2(-721.3475341796875f * difference_0(_S8, taps_0[i32(2)]));
        own_0[i32(2)] = _S14;
        sum_0 = sum_0 + _S14;
    }
    var _S15 : bool = near_0(i32(0), i32(3));
    if(_S15)
    {
        var _S16 : f32 = exp2(-721.3475341796875f * difference_0(_S8, taps_0[i32(3)]));
        own_0[i32(3)] = _S16;
        sum_0 = sum_0 + _S16;
    }
    var _S17 : bool = near_0(i32(0), i32(4));
    if(_S17)
    {
        var _S18 : f32 = exp2(-721.3475341796875f * difference_0(_S8, taps_0[i32(4)]));
        own_0[i32(4)] = _S18;
        sum_0 = sum_0 + _S18;
    }
    var _S19 : bool = near_0(i32(0), i32(5));
    if(_S19)
    {
        var _S20 : f32 = exp2(-721.3475341796875f * difference_0(_S8, taps_0[i32(5)]));
        own_0[i32(5)] = _S20;
        sum_0 = sum_0 + _S20;
    }
    var _S21 : bool = near_0(i32(0), i32(6));
    if(_S21)
    {
        var _S22 : f32 = exp2(-721.3475341796875f * difference_0(_S8, taps_0[i32(6)]));
        own_0[i32(6)] = _S22;
        sum_0 = sum_0 + _S22;
    }
    var _S23 : bool = near_0(i32(0), i32(7));
    if(_S23)
    {
        var _S24 : f32 = exp2(-721.3475341796875f * difference_0(_S8, taps_0[i32(7)]));
        own_0[i32(7)] = _S24;
        sum_0 = sum_0 + _S24;
    }
    var _S25 : bool = near_0(i32(0), i32(8));
    if(_S25)
    {
        var _S26 : f32 = exp2(-721.3475341796875f * difference_0(_S8, taps_0[i32(8)]));
        own_0[i32(8)] = _S26;
        sum_0 = sum_0 + _S26;
    }
    if(_S9)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_0[i32(0)] / (4.0f * sum_0);
    }
    if(_S11)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_0[i32(1)] / (4.0f * sum_0);
    }
    if(_S13)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_0[i32(2)] / (4.0f * sum_0);
    }
    if(_S15)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_0[i32(3)] / (4.0f * sum_0);
    }
    if(_S17)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_0[i32(4)] / (4.0f * sum_0);
    }
    if(_S19)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_0[i32(5)] / (4.0f * sum_0);
    }
    if(_S21)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_0[i32(6)] / (4.0f * sum_0);
    }
    if(_S23)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_0[i32(7)] / (4.0f * sum_0);
    }
    if(_S25)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_0[i32(8)] / (4.0f * sum_0);
    }
    var _S27 : Surface_0 = surface_0(_S5, i32(1));
    var own_1 : array<f32, i32(9)>;
    var _S28 : bool = near_0(i32(1), i32(0));
    if(_S28)
    {
        var _S29 : f32 = exp2(-721.3475341796875f * difference_0(_S27, taps_0[i32(0)]));
        own_1[i32(0)] = _S29;
        sum_0 = _S29;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S30 : bool = near_0(i32(1), i32(1));
    if(_S30)
    {
        var _S31 : f32 = exp2(-721.3475341796875f * difference_0(_S27, taps_0[i32(1)]));
        own_1[i32(1)] = _S31;
        sum_0 = sum_0 + _S31;
    }
    var _S32 : bool = near_0(i32(1), i32(2));
    if(_S32)
    {
        var _S33 : f32 = exp2(-721.3475341796875f * difference_0(_S27, taps_0[i32(2)]));
        own_1[i32(2)] = _S33;
        sum_0 = sum_0 + _S33;
    }
    var _S34 : bool = near_0(i32(1), i32(3));
    if(_S34)
    {
        var _S35 : f32 = exp2(-721.3475341796875f * difference_0(_S27, taps_0[i32(3)]));
        own_1[i32(3)] = _S35;
        sum_0 = sum_0 + _S35;
    }
    var _S36 : bool = near_0(i32(1), i32(4));
    if(_S36)
    {
        var _S37 : f32 = exp2(-721.3475341796875f * difference_0(_S27, taps_0[i32(4)]));
        own_1[i32(4)] = _S37;
        sum_0 = sum_0 + _S37;
    }
    var _S38 : bool = near_0(i32(1), i32(5));
    if(_S38)
    {
        var _S39 : f32 = exp2(-721.3475341796875f * difference_0(_S27, taps_0[i32(5)]));
        own_1[i32(5)] = _S39;
        sum_0 = sum_0 + _S39;
    }
    var _S40 : bool = near_0(i32(1), i32(6));
    if(_S40)
    {
        var _S41 : f32 = exp2(-721.3475341796875f * difference_0(_S27, taps_0[i32(6)]));
        own_1[i32(6)] = _S41;
        sum_0 = sum_0 + _S41;
    }
    var _S42 : bool = near_0(i32(1), i32(7));
    if(_S42)
    {
        var _S43 : f32 = exp2(-721.3475341796875f * difference_0(_S27, taps_0[i32(7)]));
        own_1[i32(7)] = _S43;
        sum_0 = sum_0 + _S43;
    }
    var _S44 : bool = near_0(i32(1), i32(8));
    if(_S44)
    {
        var _S45 : f32 = exp2(-721.3475341796875f * difference_0(_S27, taps_0[i32(8)]));
        own_1[i32(8)] = _S45;
        sum_0 = sum_0 + _S45;
    }
    if(_S28)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_1[i32(0)] / (4.0f * sum_0);
    }
    if(_S30)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_1[i32(1)] / (4.0f * sum_0);
    }
    if(_S32)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_1[i32(2)] / (4.0f * sum_0);
    }
    if(_S34)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_1[i32(3)] / (4.0f * sum_0);
    }
    if(_S36)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_1[i32(4)] / (4.0f * sum_0);
    }
    if(_S38)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_1[i32(5)] / (4.0f * sum_0);
    }
    if(_S40)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_1[i32(6)] / (4.0f * sum_0);
    }
    if(_S42)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_1[i32(7)] / (4.0f * sum_0);
    }
    if(_S44)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_1[i32(8)] / (4.0f * sum_0);
    }
    var _S46 : Surface_0 = surface_0(_S5, i32(2));
    var own_2 : array<f32, i32(9)>;
    var _S47 : bool = near_0(i32(2), i32(0));
    if(_S47)
    {
        var _S48 : f32 = exp2(-721.3475341796875f * difference_0(_S46, taps_0[i32(0)]));
        own_2[i32(0)] = _S48;
        sum_0 = _S48;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S49 : bool = near_0(i32(2), i32(1));
    if(_S49)
    {
        var _S50 : f32 = exp2(-721.3475341796875f * difference_0(_S46, taps_0[i32(1)]));
        own_2[i32(1)] = _S50;
        sum_0 = sum_0 + _S50;
    }
    var _S51 : bool = near_0(i32(2), i32(2));
    if(_S51)
    {
        var _S52 : f32 = exp2(-721.3475341796875f * difference_0(_S46, taps_0[i32(2)]));
        own_2[i32(2)] = _S52;
        sum_0 = sum_0 + _S52;
    }
    var _S53 : bool = near_0(i32(2), i32(3));
    if(_S53)
    {
        var _S54 : f32 = exp2(-721.3475341796875f * difference_0(_S46, taps_0[i32(3)]));
        own_2[i32(3)] = _S54;
        sum_0 = sum_0 + _S54;
    }
    var _S55 : bool = near_0(i32(2), i32(4));
    if(_S55)
    {
        var _S56 : f32 = exp2(-721.3475341796875f * difference_0(_S46, taps_0[i32(4)]));
        own_2[i32(4)] = _S56;
        sum_0 = sum_0 + _S56;
    }
    var _S57 : bool = near_0(i32(2), i32(5));
    if(_S57)
    {
        var _S58 : f32 = exp2(-721.3475341796875f * difference_0(_S46, taps_0[i32(5)]));
        own_2[i32(5)] = _S58;
        sum_0 = sum_0 + _S58;
    }
    var _S59 : bool = near_0(i32(2), i32(6));
    if(_S59)
    {
        var _S60 : f32 = exp2(-721.3475341796875f * difference_0(_S46, taps_0[i32(6)]));
        own_2[i32(6)] = _S60;
        sum_0 = sum_0 + _S60;
    }
    var _S61 : bool = near_0(i32(2), i32(7));
    if(_S61)
    {
        var _S62 : f32 = exp2(-721.3475341796875f * difference_0(_S46, taps_0[i32(7)]));
        own_2[i32(7)] = _S62;
        sum_0 = sum_0 + _S62;
    }
    var _S63 : bool = near_0(i32(2), i32(8));
    if(_S63)
    {
        var _S64 : f32 = exp2(-721.3475341796875f * difference_0(_S46, taps_0[i32(8)]));
        own_2[i32(8)] = _S64;
        sum_0 = sum_0 + _S64;
    }
    if(_S47)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_2[i32(0)] / (4.0f * sum_0);
    }
    if(_S49)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_2[i32(1)] / (4.0f * sum_0);
    }
    if(_S51)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_2[i32(2)] / (4.0f * sum_0);
    }
    if(_S53)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_2[i32(3)] / (4.0f * sum_0);
    }
    if(_S55)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_2[i32(4)] / (4.0f * sum_0);
    }
    if(_S57)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_2[i32(5)] / (4.0f * sum_0);
    }
    if(_S59)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_2[i32(6)] / (4.0f * sum_0);
    }
    if(_S61)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_2[i32(7)] / (4.0f * sum_0);
    }
    if(_S63)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_2[i32(8)] / (4.0f * sum_0);
    }
    var _S65 : Surface_0 = surface_0(_S5, i32(3));
    var own_3 : array<f32, i32(9)>;
    var _S66 : bool = near_0(i32(3), i32(0));
    if(_S66)
    {
        var _S67 : f32 = exp2(-721.3475341796875f * difference_0(_S65, taps_0[i32(0)]));
        own_3[i32(0)] = _S67;
        sum_0 = _S67;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S68 : bool = near_0(i32(3), i32(1));
    if(_S68)
    {
        var _S69 : f32 = exp2(-721.3475341796875f * difference_0(_S65, taps_0[i32(1)]));
        own_3[i32(1)] = _S69;
        sum_0 = sum_0 + _S69;
    }
    var _S70 : bool = near_0(i32(3), i32(2));
    if(_S70)
    {
        var _S71 : f32 = exp2(-721.3475341796875f * difference_0(_S65, taps_0[i32(2)]));
        own_3[i32(2)] = _S71;
        sum_0 = sum_0 + _S71;
    }
    var _S72 : bool = near_0(i32(3), i32(3));
    if(_S72)
    {
        var _S73 : f32 = exp2(-721.3475341796875f * difference_0(_S65, taps_0[i32(3)]));
        own_3[i32(3)] = _S73;
        sum_0 = sum_0 + _S73;
    }
    var _S74 : bool = near_0(i32(3), i32(4));
    if(_S74)
    {
        var _S75 : f32 = exp2(-721.3475341796875f * difference_0(_S65, taps_0[i32(4)]));
        own_3[i32(4)] = _S75;
        sum_0 = sum_0 + _S75;
    }
    var _S76 : bool = near_0(i32(3), i32(5));
    if(_S76)
    {
        var _S77 : f32 = exp2(-721.3475341796875f * difference_0(_S65, taps_0[i32(5)]));
        own_3[i32(5)] = _S77;
        sum_0 = sum_0 + _S77;
    }
    var _S78 : bool = near_0(i32(3), i32(6));
    if(_S78)
    {
        var _S79 : f32 = exp2(-721.3475341796875f * difference_0(_S65, taps_0[i32(6)]));
        own_3[i32(6)] = _S79;
        sum_0 = sum_0 + _S79;
    }
    var _S80 : bool = near_0(i32(3), i32(7));
    if(_S80)
    {
        var _S81 : f32 = exp2(-721.3475341796875f * difference_0(_S65, taps_0[i32(7)]));
        own_3[i32(7)] = _S81;
        sum_0 = sum_0 + _S81;
    }
    var _S82 : bool = near_0(i32(3), i32(8));
    if(_S82)
    {
        var _S83 : f32 = exp2(-721.3475341796875f * difference_0(_S65, taps_0[i32(8)]));
        own_3[i32(8)] = _S83;
        sum_0 = sum_0 + _S83;
    }
    if(_S66)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_3[i32(0)] / (4.0f * sum_0);
    }
    if(_S68)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_3[i32(1)] / (4.0f * sum_0);
    }
    if(_S70)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_3[i32(2)] / (4.0f * sum_0);
    }
    if(_S72)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_3[i32(3)] / (4.0f * sum_0);
    }
    if(_S74)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_3[i32(4)] / (4.0f * sum_0);
    }
    if(_S76)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_3[i32(5)] / (4.0f * sum_0);
    }
    if(_S78)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_3[i32(6)] / (4.0f * sum_0);
    }
    if(_S80)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_3[i32(7)] / (4.0f * sum_0);
    }
    if(_S82)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_3[i32(8)] / (4.0f * sum_0);
    }
    var _S84 : vec3<i32> = vec3<i32>(at_1, i32(0));
    var _S85 : vec3<i32> = vec3<i32>(at_2, i32(0));
    var _S86 : vec3<i32> = vec3<i32>(at_3, i32(0));
    var _S87 : vec3<i32> = vec3<i32>(at_4, i32(0));
    var _S88 : vec3<i32> = vec3<i32>(at_5, i32(0));
    var _S89 : vec3<i32> = vec3<i32>(at_6, i32(0));
    var _S90 : vec3<i32> = vec3<i32>(at_7, i32(0));
    var _S91 : vec3<i32> = vec3<i32>(at_8, i32(0));
    var _S92 : vec3<i32> = vec3<i32>(at_9, i32(0));
    textureStore((destination_0), (vec2<u32>(_S5)), (vec4<f32>(weights_0[i32(0)]) * (textureLoad((color_0), ((_S84)).xy, ((_S84)).z)) + vec4<f32>(weights_0[i32(1)]) * (textureLoad((color_0), ((_S85)).xy, ((_S85)).z)) + vec4<f32>(weights_0[i32(2)]) * (textureLoad((color_0), ((_S86)).xy, ((_S86)).z)) + vec4<f32>(weights_0[i32(3)]) * (textureLoad((color_0), ((_S87)).xy, ((_S87)).z)) + vec4<f32>(weights_0[i32(4)]) * (textureLoad((color_0), ((_S88)).xy, ((_S88)).z)) + vec4<f32>(weights_0[i32(5)]) * (textureLoad((color_0), ((_S89)).xy, ((_S89)).z)) + vec4<f32>(weights_0[i32(6)]) * (textureLoad((color_0), ((_S90)).xy, ((_S90)).z)) + vec4<f32>(weights_0[i32(7)]) * (textureLoad((color_0), ((_S91)).xy, ((_S91)).z)) + vec4<f32>(weights_0[i32(8)]) * (textureLoad((color_0), ((_S92)).xy, ((_S92)).z))));
    return;
}

