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
    return (vec2<f32>(f32(s_0 % i32(4)), f32(s_0 / i32(4))) + _S3) / vec2<f32>(4.0f) - _S3;
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
        weights_0[i32(0)] = weights_0[i32(0)] + own_0[i32(0)] / (16.0f * sum_0);
    }
    if(_S11)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_0[i32(1)] / (16.0f * sum_0);
    }
    if(_S13)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_0[i32(2)] / (16.0f * sum_0);
    }
    if(_S15)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_0[i32(3)] / (16.0f * sum_0);
    }
    if(_S17)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_0[i32(4)] / (16.0f * sum_0);
    }
    if(_S19)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_0[i32(5)] / (16.0f * sum_0);
    }
    if(_S21)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_0[i32(6)] / (16.0f * sum_0);
    }
    if(_S23)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_0[i32(7)] / (16.0f * sum_0);
    }
    if(_S25)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_0[i32(8)] / (16.0f * sum_0);
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
        weights_0[i32(0)] = weights_0[i32(0)] + own_1[i32(0)] / (16.0f * sum_0);
    }
    if(_S30)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_1[i32(1)] / (16.0f * sum_0);
    }
    if(_S32)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_1[i32(2)] / (16.0f * sum_0);
    }
    if(_S34)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_1[i32(3)] / (16.0f * sum_0);
    }
    if(_S36)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_1[i32(4)] / (16.0f * sum_0);
    }
    if(_S38)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_1[i32(5)] / (16.0f * sum_0);
    }
    if(_S40)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_1[i32(6)] / (16.0f * sum_0);
    }
    if(_S42)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_1[i32(7)] / (16.0f * sum_0);
    }
    if(_S44)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_1[i32(8)] / (16.0f * sum_0);
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
        weights_0[i32(0)] = weights_0[i32(0)] + own_2[i32(0)] / (16.0f * sum_0);
    }
    if(_S49)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_2[i32(1)] / (16.0f * sum_0);
    }
    if(_S51)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_2[i32(2)] / (16.0f * sum_0);
    }
    if(_S53)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_2[i32(3)] / (16.0f * sum_0);
    }
    if(_S55)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_2[i32(4)] / (16.0f * sum_0);
    }
    if(_S57)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_2[i32(5)] / (16.0f * sum_0);
    }
    if(_S59)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_2[i32(6)] / (16.0f * sum_0);
    }
    if(_S61)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_2[i32(7)] / (16.0f * sum_0);
    }
    if(_S63)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_2[i32(8)] / (16.0f * sum_0);
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
        weights_0[i32(0)] = weights_0[i32(0)] + own_3[i32(0)] / (16.0f * sum_0);
    }
    if(_S68)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_3[i32(1)] / (16.0f * sum_0);
    }
    if(_S70)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_3[i32(2)] / (16.0f * sum_0);
    }
    if(_S72)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_3[i32(3)] / (16.0f * sum_0);
    }
    if(_S74)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_3[i32(4)] / (16.0f * sum_0);
    }
    if(_S76)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_3[i32(5)] / (16.0f * sum_0);
    }
    if(_S78)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_3[i32(6)] / (16.0f * sum_0);
    }
    if(_S80)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_3[i32(7)] / (16.0f * sum_0);
    }
    if(_S82)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_3[i32(8)] / (16.0f * sum_0);
    }
    var _S84 : Surface_0 = surface_0(_S5, i32(4));
    var own_4 : array<f32, i32(9)>;
    var _S85 : bool = near_0(i32(4), i32(0));
    if(_S85)
    {
        var _S86 : f32 = exp2(-721.3475341796875f * difference_0(_S84, taps_0[i32(0)]));
        own_4[i32(0)] = _S86;
        sum_0 = _S86;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S87 : bool = near_0(i32(4), i32(1));
    if(_S87)
    {
        var _S88 : f32 = exp2(-721.3475341796875f * difference_0(_S84, taps_0[i32(1)]));
        own_4[i32(1)] = _S88;
        sum_0 = sum_0 + _S88;
    }
    var _S89 : bool = near_0(i32(4), i32(2));
    if(_S89)
    {
        var _S90 : f32 = exp2(-721.3475341796875f * difference_0(_S84, taps_0[i32(2)]));
        own_4[i32(2)] = _S90;
        sum_0 = sum_0 + _S90;
    }
    var _S91 : bool = near_0(i32(4), i32(3));
    if(_S91)
    {
        var _S92 : f32 = exp2(-721.3475341796875f * difference_0(_S84, taps_0[i32(3)]));
        own_4[i32(3)] = _S92;
        sum_0 = sum_0 + _S92;
    }
    var _S93 : bool = near_0(i32(4), i32(4));
    if(_S93)
    {
        var _S94 : f32 = exp2(-721.3475341796875f * difference_0(_S84, taps_0[i32(4)]));
        own_4[i32(4)] = _S94;
        sum_0 = sum_0 + _S94;
    }
    var _S95 : bool = near_0(i32(4), i32(5));
    if(_S95)
    {
        var _S96 : f32 = exp2(-721.3475341796875f * difference_0(_S84, taps_0[i32(5)]));
        own_4[i32(5)] = _S96;
        sum_0 = sum_0 + _S96;
    }
    var _S97 : bool = near_0(i32(4), i32(6));
    if(_S97)
    {
        var _S98 : f32 = exp2(-721.3475341796875f * difference_0(_S84, taps_0[i32(6)]));
        own_4[i32(6)] = _S98;
        sum_0 = sum_0 + _S98;
    }
    var _S99 : bool = near_0(i32(4), i32(7));
    if(_S99)
    {
        var _S100 : f32 = exp2(-721.3475341796875f * difference_0(_S84, taps_0[i32(7)]));
        own_4[i32(7)] = _S100;
        sum_0 = sum_0 + _S100;
    }
    var _S101 : bool = near_0(i32(4), i32(8));
    if(_S101)
    {
        var _S102 : f32 = exp2(-721.3475341796875f * difference_0(_S84, taps_0[i32(8)]));
        own_4[i32(8)] = _S102;
        sum_0 = sum_0 + _S102;
    }
    if(_S85)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_4[i32(0)] / (16.0f * sum_0);
    }
    if(_S87)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_4[i32(1)] / (16.0f * sum_0);
    }
    if(_S89)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_4[i32(2)] / (16.0f * sum_0);
    }
    if(_S91)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_4[i32(3)] / (16.0f * sum_0);
    }
    if(_S93)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_4[i32(4)] / (16.0f * sum_0);
    }
    if(_S95)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_4[i32(5)] / (16.0f * sum_0);
    }
    if(_S97)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_4[i32(6)] / (16.0f * sum_0);
    }
    if(_S99)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_4[i32(7)] / (16.0f * sum_0);
    }
    if(_S101)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_4[i32(8)] / (16.0f * sum_0);
    }
    var _S103 : Surface_0 = surface_0(_S5, i32(5));
    var own_5 : array<f32, i32(9)>;
    var _S104 : bool = near_0(i32(5), i32(0));
    if(_S104)
    {
        var _S105 : f32 = exp2(-721.3475341796875f * difference_0(_S103, taps_0[i32(0)]));
        own_5[i32(0)] = _S105;
        sum_0 = _S105;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S106 : bool = near_0(i32(5), i32(1));
    if(_S106)
    {
        var _S107 : f32 = exp2(-721.3475341796875f * difference_0(_S103, taps_0[i32(1)]));
        own_5[i32(1)] = _S107;
        sum_0 = sum_0 + _S107;
    }
    var _S108 : bool = near_0(i32(5), i32(2));
    if(_S108)
    {
        var _S109 : f32 = exp2(-721.3475341796875f * difference_0(_S103, taps_0[i32(2)]));
        own_5[i32(2)] = _S109;
        sum_0 = sum_0 + _S109;
    }
    var _S110 : bool = near_0(i32(5), i32(3));
    if(_S110)
    {
        var _S111 : f32 = exp2(-721.3475341796875f * difference_0(_S103, taps_0[i32(3)]));
        own_5[i32(3)] = _S111;
        sum_0 = sum_0 + _S111;
    }
    var _S112 : bool = near_0(i32(5), i32(4));
    if(_S112)
    {
        var _S113 : f32 = exp2(-721.3475341796875f * difference_0(_S103, taps_0[i32(4)]));
        own_5[i32(4)] = _S113;
        sum_0 = sum_0 + _S113;
    }
    var _S114 : bool = near_0(i32(5), i32(5));
    if(_S114)
    {
        var _S115 : f32 = exp2(-721.3475341796875f * difference_0(_S103, taps_0[i32(5)]));
        own_5[i32(5)] = _S115;
        sum_0 = sum_0 + _S115;
    }
    var _S116 : bool = near_0(i32(5), i32(6));
    if(_S116)
    {
        var _S117 : f32 = exp2(-721.3475341796875f * difference_0(_S103, taps_0[i32(6)]));
        own_5[i32(6)] = _S117;
        sum_0 = sum_0 + _S117;
    }
    var _S118 : bool = near_0(i32(5), i32(7));
    if(_S118)
    {
        var _S119 : f32 = exp2(-721.3475341796875f * difference_0(_S103, taps_0[i32(7)]));
        own_5[i32(7)] = _S119;
        sum_0 = sum_0 + _S119;
    }
    var _S120 : bool = near_0(i32(5), i32(8));
    if(_S120)
    {
        var _S121 : f32 = exp2(-721.3475341796875f * difference_0(_S103, taps_0[i32(8)]));
        own_5[i32(8)] = _S121;
        sum_0 = sum_0 + _S121;
    }
    if(_S104)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_5[i32(0)] / (16.0f * sum_0);
    }
    if(_S106)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_5[i32(1)] / (16.0f * sum_0);
    }
    if(_S108)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_5[i32(2)] / (16.0f * sum_0);
    }
    if(_S110)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_5[i32(3)] / (16.0f * sum_0);
    }
    if(_S112)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_5[i32(4)] / (16.0f * sum_0);
    }
    if(_S114)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_5[i32(5)] / (16.0f * sum_0);
    }
    if(_S116)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_5[i32(6)] / (16.0f * sum_0);
    }
    if(_S118)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_5[i32(7)] / (16.0f * sum_0);
    }
    if(_S120)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_5[i32(8)] / (16.0f * sum_0);
    }
    var _S122 : Surface_0 = surface_0(_S5, i32(6));
    var own_6 : array<f32, i32(9)>;
    var _S123 : bool = near_0(i32(6), i32(0));
    if(_S123)
    {
        var _S124 : f32 = exp2(-721.3475341796875f * difference_0(_S122, taps_0[i32(0)]));
        own_6[i32(0)] = _S124;
        sum_0 = _S124;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S125 : bool = near_0(i32(6), i32(1));
    if(_S125)
    {
        var _S126 : f32 = exp2(-721.3475341796875f * difference_0(_S122, taps_0[i32(1)]));
        own_6[i32(1)] = _S126;
        sum_0 = sum_0 + _S126;
    }
    var _S127 : bool = near_0(i32(6), i32(2));
    if(_S127)
    {
        var _S128 : f32 = exp2(-721.3475341796875f * difference_0(_S122, taps_0[i32(2)]));
        own_6[i32(2)] = _S128;
        sum_0 = sum_0 + _S128;
    }
    var _S129 : bool = near_0(i32(6), i32(3));
    if(_S129)
    {
        var _S130 : f32 = exp2(-721.3475341796875f * difference_0(_S122, taps_0[i32(3)]));
        own_6[i32(3)] = _S130;
        sum_0 = sum_0 + _S130;
    }
    var _S131 : bool = near_0(i32(6), i32(4));
    if(_S131)
    {
        var _S132 : f32 = exp2(-721.3475341796875f * difference_0(_S122, taps_0[i32(4)]));
        own_6[i32(4)] = _S132;
        sum_0 = sum_0 + _S132;
    }
    var _S133 : bool = near_0(i32(6), i32(5));
    if(_S133)
    {
        var _S134 : f32 = exp2(-721.3475341796875f * difference_0(_S122, taps_0[i32(5)]));
        own_6[i32(5)] = _S134;
        sum_0 = sum_0 + _S134;
    }
    var _S135 : bool = near_0(i32(6), i32(6));
    if(_S135)
    {
        var _S136 : f32 = exp2(-721.3475341796875f * difference_0(_S122, taps_0[i32(6)]));
        own_6[i32(6)] = _S136;
        sum_0 = sum_0 + _S136;
    }
    var _S137 : bool = near_0(i32(6), i32(7));
    if(_S137)
    {
        var _S138 : f32 = exp2(-721.3475341796875f * difference_0(_S122, taps_0[i32(7)]));
        own_6[i32(7)] = _S138;
        sum_0 = sum_0 + _S138;
    }
    var _S139 : bool = near_0(i32(6), i32(8));
    if(_S139)
    {
        var _S140 : f32 = exp2(-721.3475341796875f * difference_0(_S122, taps_0[i32(8)]));
        own_6[i32(8)] = _S140;
        sum_0 = sum_0 + _S140;
    }
    if(_S123)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_6[i32(0)] / (16.0f * sum_0);
    }
    if(_S125)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_6[i32(1)] / (16.0f * sum_0);
    }
    if(_S127)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_6[i32(2)] / (16.0f * sum_0);
    }
    if(_S129)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_6[i32(3)] / (16.0f * sum_0);
    }
    if(_S131)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_6[i32(4)] / (16.0f * sum_0);
    }
    if(_S133)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_6[i32(5)] / (16.0f * sum_0);
    }
    if(_S135)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_6[i32(6)] / (16.0f * sum_0);
    }
    if(_S137)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_6[i32(7)] / (16.0f * sum_0);
    }
    if(_S139)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_6[i32(8)] / (16.0f * sum_0);
    }
    var _S141 : Surface_0 = surface_0(_S5, i32(7));
    var own_7 : array<f32, i32(9)>;
    var _S142 : bool = near_0(i32(7), i32(0));
    if(_S142)
    {
        var _S143 : f32 = exp2(-721.3475341796875f * difference_0(_S141, taps_0[i32(0)]));
        own_7[i32(0)] = _S143;
        sum_0 = _S143;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S144 : bool = near_0(i32(7), i32(1));
    if(_S144)
    {
        var _S145 : f32 = exp2(-721.3475341796875f * difference_0(_S141, taps_0[i32(1)]));
        own_7[i32(1)] = _S145;
        sum_0 = sum_0 + _S145;
    }
    var _S146 : bool = near_0(i32(7), i32(2));
    if(_S146)
    {
        var _S147 : f32 = exp2(-721.3475341796875f * difference_0(_S141, taps_0[i32(2)]));
        own_7[i32(2)] = _S147;
        sum_0 = sum_0 + _S147;
    }
    var _S148 : bool = near_0(i32(7), i32(3));
    if(_S148)
    {
        var _S149 : f32 = exp2(-721.3475341796875f * difference_0(_S141, taps_0[i32(3)]));
        own_7[i32(3)] = _S149;
        sum_0 = sum_0 + _S149;
    }
    var _S150 : bool = near_0(i32(7), i32(4));
    if(_S150)
    {
        var _S151 : f32 = exp2(-721.3475341796875f * difference_0(_S141, taps_0[i32(4)]));
        own_7[i32(4)] = _S151;
        sum_0 = sum_0 + _S151;
    }
    var _S152 : bool = near_0(i32(7), i32(5));
    if(_S152)
    {
        var _S153 : f32 = exp2(-721.3475341796875f * difference_0(_S141, taps_0[i32(5)]));
        own_7[i32(5)] = _S153;
        sum_0 = sum_0 + _S153;
    }
    var _S154 : bool = near_0(i32(7), i32(6));
    if(_S154)
    {
        var _S155 : f32 = exp2(-721.3475341796875f * difference_0(_S141, taps_0[i32(6)]));
        own_7[i32(6)] = _S155;
        sum_0 = sum_0 + _S155;
    }
    var _S156 : bool = near_0(i32(7), i32(7));
    if(_S156)
    {
        var _S157 : f32 = exp2(-721.3475341796875f * difference_0(_S141, taps_0[i32(7)]));
        own_7[i32(7)] = _S157;
        sum_0 = sum_0 + _S157;
    }
    var _S158 : bool = near_0(i32(7), i32(8));
    if(_S158)
    {
        var _S159 : f32 = exp2(-721.3475341796875f * difference_0(_S141, taps_0[i32(8)]));
        own_7[i32(8)] = _S159;
        sum_0 = sum_0 + _S159;
    }
    if(_S142)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_7[i32(0)] / (16.0f * sum_0);
    }
    if(_S144)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_7[i32(1)] / (16.0f * sum_0);
    }
    if(_S146)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_7[i32(2)] / (16.0f * sum_0);
    }
    if(_S148)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_7[i32(3)] / (16.0f * sum_0);
    }
    if(_S150)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_7[i32(4)] / (16.0f * sum_0);
    }
    if(_S152)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_7[i32(5)] / (16.0f * sum_0);
    }
    if(_S154)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_7[i32(6)] / (16.0f * sum_0);
    }
    if(_S156)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_7[i32(7)] / (16.0f * sum_0);
    }
    if(_S158)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_7[i32(8)] / (16.0f * sum_0);
    }
    var _S160 : Surface_0 = surface_0(_S5, i32(8));
    var own_8 : array<f32, i32(9)>;
    var _S161 : bool = near_0(i32(8), i32(0));
    if(_S161)
    {
        var _S162 : f32 = exp2(-721.3475341796875f * difference_0(_S160, taps_0[i32(0)]));
        own_8[i32(0)] = _S162;
        sum_0 = _S162;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S163 : bool = near_0(i32(8), i32(1));
    if(_S163)
    {
        var _S164 : f32 = exp2(-721.3475341796875f * difference_0(_S160, taps_0[i32(1)]));
        own_8[i32(1)] = _S164;
        sum_0 = sum_0 + _S164;
    }
    var _S165 : bool = near_0(i32(8), i32(2));
    if(_S165)
    {
        var _S166 : f32 = exp2(-721.3475341796875f * difference_0(_S160, taps_0[i32(2)]));
        own_8[i32(2)] = _S166;
        sum_0 = sum_0 + _S166;
    }
    var _S167 : bool = near_0(i32(8), i32(3));
    if(_S167)
    {
        var _S168 : f32 = exp2(-721.3475341796875f * difference_0(_S160, taps_0[i32(3)]));
        own_8[i32(3)] = _S168;
        sum_0 = sum_0 + _S168;
    }
    var _S169 : bool = near_0(i32(8), i32(4));
    if(_S169)
    {
        var _S170 : f32 = exp2(-721.3475341796875f * difference_0(_S160, taps_0[i32(4)]));
        own_8[i32(4)] = _S170;
        sum_0 = sum_0 + _S170;
    }
    var _S171 : bool = near_0(i32(8), i32(5));
    if(_S171)
    {
        var _S172 : f32 = exp2(-721.3475341796875f * difference_0(_S160, taps_0[i32(5)]));
        own_8[i32(5)] = _S172;
        sum_0 = sum_0 + _S172;
    }
    var _S173 : bool = near_0(i32(8), i32(6));
    if(_S173)
    {
        var _S174 : f32 = exp2(-721.3475341796875f * difference_0(_S160, taps_0[i32(6)]));
        own_8[i32(6)] = _S174;
        sum_0 = sum_0 + _S174;
    }
    var _S175 : bool = near_0(i32(8), i32(7));
    if(_S175)
    {
        var _S176 : f32 = exp2(-721.3475341796875f * difference_0(_S160, taps_0[i32(7)]));
        own_8[i32(7)] = _S176;
        sum_0 = sum_0 + _S176;
    }
    var _S177 : bool = near_0(i32(8), i32(8));
    if(_S177)
    {
        var _S178 : f32 = exp2(-721.3475341796875f * difference_0(_S160, taps_0[i32(8)]));
        own_8[i32(8)] = _S178;
        sum_0 = sum_0 + _S178;
    }
    if(_S161)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_8[i32(0)] / (16.0f * sum_0);
    }
    if(_S163)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_8[i32(1)] / (16.0f * sum_0);
    }
    if(_S165)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_8[i32(2)] / (16.0f * sum_0);
    }
    if(_S167)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_8[i32(3)] / (16.0f * sum_0);
    }
    if(_S169)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_8[i32(4)] / (16.0f * sum_0);
    }
    if(_S171)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_8[i32(5)] / (16.0f * sum_0);
    }
    if(_S173)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_8[i32(6)] / (16.0f * sum_0);
    }
    if(_S175)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_8[i32(7)] / (16.0f * sum_0);
    }
    if(_S177)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_8[i32(8)] / (16.0f * sum_0);
    }
    var _S179 : Surface_0 = surface_0(_S5, i32(9));
    var own_9 : array<f32, i32(9)>;
    var _S180 : bool = near_0(i32(9), i32(0));
    if(_S180)
    {
        var _S181 : f32 = exp2(-721.3475341796875f * difference_0(_S179, taps_0[i32(0)]));
        own_9[i32(0)] = _S181;
        sum_0 = _S181;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S182 : bool = near_0(i32(9), i32(1));
    if(_S182)
    {
        var _S183 : f32 = exp2(-721.3475341796875f * difference_0(_S179, taps_0[i32(1)]));
        own_9[i32(1)] = _S183;
        sum_0 = sum_0 + _S183;
    }
    var _S184 : bool = near_0(i32(9), i32(2));
    if(_S184)
    {
        var _S185 : f32 = exp2(-721.3475341796875f * difference_0(_S179, taps_0[i32(2)]));
        own_9[i32(2)] = _S185;
        sum_0 = sum_0 + _S185;
    }
    var _S186 : bool = near_0(i32(9), i32(3));
    if(_S186)
    {
        var _S187 : f32 = exp2(-721.3475341796875f * difference_0(_S179, taps_0[i32(3)]));
        own_9[i32(3)] = _S187;
        sum_0 = sum_0 + _S187;
    }
    var _S188 : bool = near_0(i32(9), i32(4));
    if(_S188)
    {
        var _S189 : f32 = exp2(-721.3475341796875f * difference_0(_S179, taps_0[i32(4)]));
        own_9[i32(4)] = _S189;
        sum_0 = sum_0 + _S189;
    }
    var _S190 : bool = near_0(i32(9), i32(5));
    if(_S190)
    {
        var _S191 : f32 = exp2(-721.3475341796875f * difference_0(_S179, taps_0[i32(5)]));
        own_9[i32(5)] = _S191;
        sum_0 = sum_0 + _S191;
    }
    var _S192 : bool = near_0(i32(9), i32(6));
    if(_S192)
    {
        var _S193 : f32 = exp2(-721.3475341796875f * difference_0(_S179, taps_0[i32(6)]));
        own_9[i32(6)] = _S193;
        sum_0 = sum_0 + _S193;
    }
    var _S194 : bool = near_0(i32(9), i32(7));
    if(_S194)
    {
        var _S195 : f32 = exp2(-721.3475341796875f * difference_0(_S179, taps_0[i32(7)]));
        own_9[i32(7)] = _S195;
        sum_0 = sum_0 + _S195;
    }
    var _S196 : bool = near_0(i32(9), i32(8));
    if(_S196)
    {
        var _S197 : f32 = exp2(-721.3475341796875f * difference_0(_S179, taps_0[i32(8)]));
        own_9[i32(8)] = _S197;
        sum_0 = sum_0 + _S197;
    }
    if(_S180)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_9[i32(0)] / (16.0f * sum_0);
    }
    if(_S182)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_9[i32(1)] / (16.0f * sum_0);
    }
    if(_S184)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_9[i32(2)] / (16.0f * sum_0);
    }
    if(_S186)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_9[i32(3)] / (16.0f * sum_0);
    }
    if(_S188)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_9[i32(4)] / (16.0f * sum_0);
    }
    if(_S190)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_9[i32(5)] / (16.0f * sum_0);
    }
    if(_S192)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_9[i32(6)] / (16.0f * sum_0);
    }
    if(_S194)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_9[i32(7)] / (16.0f * sum_0);
    }
    if(_S196)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_9[i32(8)] / (16.0f * sum_0);
    }
    var _S198 : Surface_0 = surface_0(_S5, i32(10));
    var own_10 : array<f32, i32(9)>;
    var _S199 : bool = near_0(i32(10), i32(0));
    if(_S199)
    {
        var _S200 : f32 = exp2(-721.3475341796875f * difference_0(_S198, taps_0[i32(0)]));
        own_10[i32(0)] = _S200;
        sum_0 = _S200;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S201 : bool = near_0(i32(10), i32(1));
    if(_S201)
    {
        var _S202 : f32 = exp2(-721.3475341796875f * difference_0(_S198, taps_0[i32(1)]));
        own_10[i32(1)] = _S202;
        sum_0 = sum_0 + _S202;
    }
    var _S203 : bool = near_0(i32(10), i32(2));
    if(_S203)
    {
        var _S204 : f32 = exp2(-721.3475341796875f * difference_0(_S198, taps_0[i32(2)]));
        own_10[i32(2)] = _S204;
        sum_0 = sum_0 + _S204;
    }
    var _S205 : bool = near_0(i32(10), i32(3));
    if(_S205)
    {
        var _S206 : f32 = exp2(-721.3475341796875f * difference_0(_S198, taps_0[i32(3)]));
        own_10[i32(3)] = _S206;
        sum_0 = sum_0 + _S206;
    }
    var _S207 : bool = near_0(i32(10), i32(4));
    if(_S207)
    {
        var _S208 : f32 = exp2(-721.3475341796875f * difference_0(_S198, taps_0[i32(4)]));
        own_10[i32(4)] = _S208;
        sum_0 = sum_0 + _S208;
    }
    var _S209 : bool = near_0(i32(10), i32(5));
    if(_S209)
    {
        var _S210 : f32 = exp2(-721.3475341796875f * difference_0(_S198, taps_0[i32(5)]));
        own_10[i32(5)] = _S210;
        sum_0 = sum_0 + _S210;
    }
    var _S211 : bool = near_0(i32(10), i32(6));
    if(_S211)
    {
        var _S212 : f32 = exp2(-721.3475341796875f * difference_0(_S198, taps_0[i32(6)]));
        own_10[i32(6)] = _S212;
        sum_0 = sum_0 + _S212;
    }
    var _S213 : bool = near_0(i32(10), i32(7));
    if(_S213)
    {
        var _S214 : f32 = exp2(-721.3475341796875f * difference_0(_S198, taps_0[i32(7)]));
        own_10[i32(7)] = _S214;
        sum_0 = sum_0 + _S214;
    }
    var _S215 : bool = near_0(i32(10), i32(8));
    if(_S215)
    {
        var _S216 : f32 = exp2(-721.3475341796875f * difference_0(_S198, taps_0[i32(8)]));
        own_10[i32(8)] = _S216;
        sum_0 = sum_0 + _S216;
    }
    if(_S199)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_10[i32(0)] / (16.0f * sum_0);
    }
    if(_S201)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_10[i32(1)] / (16.0f * sum_0);
    }
    if(_S203)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_10[i32(2)] / (16.0f * sum_0);
    }
    if(_S205)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_10[i32(3)] / (16.0f * sum_0);
    }
    if(_S207)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_10[i32(4)] / (16.0f * sum_0);
    }
    if(_S209)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_10[i32(5)] / (16.0f * sum_0);
    }
    if(_S211)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_10[i32(6)] / (16.0f * sum_0);
    }
    if(_S213)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_10[i32(7)] / (16.0f * sum_0);
    }
    if(_S215)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_10[i32(8)] / (16.0f * sum_0);
    }
    var _S217 : Surface_0 = surface_0(_S5, i32(11));
    var own_11 : array<f32, i32(9)>;
    var _S218 : bool = near_0(i32(11), i32(0));
    if(_S218)
    {
        var _S219 : f32 = exp2(-721.3475341796875f * difference_0(_S217, taps_0[i32(0)]));
        own_11[i32(0)] = _S219;
        sum_0 = _S219;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S220 : bool = near_0(i32(11), i32(1));
    if(_S220)
    {
        var _S221 : f32 = exp2(-721.3475341796875f * difference_0(_S217, taps_0[i32(1)]));
        own_11[i32(1)] = _S221;
        sum_0 = sum_0 + _S221;
    }
    var _S222 : bool = near_0(i32(11), i32(2));
    if(_S222)
    {
        var _S223 : f32 = exp2(-721.3475341796875f * difference_0(_S217, taps_0[i32(2)]));
        own_11[i32(2)] = _S223;
        sum_0 = sum_0 + _S223;
    }
    var _S224 : bool = near_0(i32(11), i32(3));
    if(_S224)
    {
        var _S225 : f32 = exp2(-721.3475341796875f * difference_0(_S217, taps_0[i32(3)]));
        own_11[i32(3)] = _S225;
        sum_0 = sum_0 + _S225;
    }
    var _S226 : bool = near_0(i32(11), i32(4));
    if(_S226)
    {
        var _S227 : f32 = exp2(-721.3475341796875f * difference_0(_S217, taps_0[i32(4)]));
        own_11[i32(4)] = _S227;
        sum_0 = sum_0 + _S227;
    }
    var _S228 : bool = near_0(i32(11), i32(5));
    if(_S228)
    {
        var _S229 : f32 = exp2(-721.3475341796875f * difference_0(_S217, taps_0[i32(5)]));
        own_11[i32(5)] = _S229;
        sum_0 = sum_0 + _S229;
    }
    var _S230 : bool = near_0(i32(11), i32(6));
    if(_S230)
    {
        var _S231 : f32 = exp2(-721.3475341796875f * difference_0(_S217, taps_0[i32(6)]));
        own_11[i32(6)] = _S231;
        sum_0 = sum_0 + _S231;
    }
    var _S232 : bool = near_0(i32(11), i32(7));
    if(_S232)
    {
        var _S233 : f32 = exp2(-721.3475341796875f * difference_0(_S217, taps_0[i32(7)]));
        own_11[i32(7)] = _S233;
        sum_0 = sum_0 + _S233;
    }
    var _S234 : bool = near_0(i32(11), i32(8));
    if(_S234)
    {
        var _S235 : f32 = exp2(-721.3475341796875f * difference_0(_S217, taps_0[i32(8)]));
        own_11[i32(8)] = _S235;
        sum_0 = sum_0 + _S235;
    }
    if(_S218)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_11[i32(0)] / (16.0f * sum_0);
    }
    if(_S220)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_11[i32(1)] / (16.0f * sum_0);
    }
    if(_S222)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_11[i32(2)] / (16.0f * sum_0);
    }
    if(_S224)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_11[i32(3)] / (16.0f * sum_0);
    }
    if(_S226)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_11[i32(4)] / (16.0f * sum_0);
    }
    if(_S228)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_11[i32(5)] / (16.0f * sum_0);
    }
    if(_S230)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_11[i32(6)] / (16.0f * sum_0);
    }
    if(_S232)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_11[i32(7)] / (16.0f * sum_0);
    }
    if(_S234)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_11[i32(8)] / (16.0f * sum_0);
    }
    var _S236 : Surface_0 = surface_0(_S5, i32(12));
    var own_12 : array<f32, i32(9)>;
    var _S237 : bool = near_0(i32(12), i32(0));
    if(_S237)
    {
        var _S238 : f32 = exp2(-721.3475341796875f * difference_0(_S236, taps_0[i32(0)]));
        own_12[i32(0)] = _S238;
        sum_0 = _S238;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S239 : bool = near_0(i32(12), i32(1));
    if(_S239)
    {
        var _S240 : f32 = exp2(-721.3475341796875f * difference_0(_S236, taps_0[i32(1)]));
        own_12[i32(1)] = _S240;
        sum_0 = sum_0 + _S240;
    }
    var _S241 : bool = near_0(i32(12), i32(2));
    if(_S241)
    {
        var _S242 : f32 = exp2(-721.3475341796875f * difference_0(_S236, taps_0[i32(2)]));
        own_12[i32(2)] = _S242;
        sum_0 = sum_0 + _S242;
    }
    var _S243 : bool = near_0(i32(12), i32(3));
    if(_S243)
    {
        var _S244 : f32 = exp2(-721.3475341796875f * difference_0(_S236, taps_0[i32(3)]));
        own_12[i32(3)] = _S244;
        sum_0 = sum_0 + _S244;
    }
    var _S245 : bool = near_0(i32(12), i32(4));
    if(_S245)
    {
        var _S246 : f32 = exp2(-721.3475341796875f * difference_0(_S236, taps_0[i32(4)]));
        own_12[i32(4)] = _S246;
        sum_0 = sum_0 + _S246;
    }
    var _S247 : bool = near_0(i32(12), i32(5));
    if(_S247)
    {
        var _S248 : f32 = exp2(-721.3475341796875f * difference_0(_S236, taps_0[i32(5)]));
        own_12[i32(5)] = _S248;
        sum_0 = sum_0 + _S248;
    }
    var _S249 : bool = near_0(i32(12), i32(6));
    if(_S249)
    {
        var _S250 : f32 = exp2(-721.3475341796875f * difference_0(_S236, taps_0[i32(6)]));
        own_12[i32(6)] = _S250;
        sum_0 = sum_0 + _S250;
    }
    var _S251 : bool = near_0(i32(12), i32(7));
    if(_S251)
    {
        var _S252 : f32 = exp2(-721.3475341796875f * difference_0(_S236, taps_0[i32(7)]));
        own_12[i32(7)] = _S252;
        sum_0 = sum_0 + _S252;
    }
    var _S253 : bool = near_0(i32(12), i32(8));
    if(_S253)
    {
        var _S254 : f32 = exp2(-721.3475341796875f * difference_0(_S236, taps_0[i32(8)]));
        own_12[i32(8)] = _S254;
        sum_0 = sum_0 + _S254;
    }
    if(_S237)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_12[i32(0)] / (16.0f * sum_0);
    }
    if(_S239)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_12[i32(1)] / (16.0f * sum_0);
    }
    if(_S241)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_12[i32(2)] / (16.0f * sum_0);
    }
    if(_S243)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_12[i32(3)] / (16.0f * sum_0);
    }
    if(_S245)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_12[i32(4)] / (16.0f * sum_0);
    }
    if(_S247)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_12[i32(5)] / (16.0f * sum_0);
    }
    if(_S249)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_12[i32(6)] / (16.0f * sum_0);
    }
    if(_S251)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_12[i32(7)] / (16.0f * sum_0);
    }
    if(_S253)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_12[i32(8)] / (16.0f * sum_0);
    }
    var _S255 : Surface_0 = surface_0(_S5, i32(13));
    var own_13 : array<f32, i32(9)>;
    var _S256 : bool = near_0(i32(13), i32(0));
    if(_S256)
    {
        var _S257 : f32 = exp2(-721.3475341796875f * difference_0(_S255, taps_0[i32(0)]));
        own_13[i32(0)] = _S257;
        sum_0 = _S257;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S258 : bool = near_0(i32(13), i32(1));
    if(_S258)
    {
        var _S259 : f32 = exp2(-721.3475341796875f * difference_0(_S255, taps_0[i32(1)]));
        own_13[i32(1)] = _S259;
        sum_0 = sum_0 + _S259;
    }
    var _S260 : bool = near_0(i32(13), i32(2));
    if(_S260)
    {
        var _S261 : f32 = exp2(-721.3475341796875f * difference_0(_S255, taps_0[i32(2)]));
        own_13[i32(2)] = _S261;
        sum_0 = sum_0 + _S261;
    }
    var _S262 : bool = near_0(i32(13), i32(3));
    if(_S262)
    {
        var _S263 : f32 = exp2(-721.3475341796875f * difference_0(_S255, taps_0[i32(3)]));
        own_13[i32(3)] = _S263;
        sum_0 = sum_0 + _S263;
    }
    var _S264 : bool = near_0(i32(13), i32(4));
    if(_S264)
    {
        var _S265 : f32 = exp2(-721.3475341796875f * difference_0(_S255, taps_0[i32(4)]));
        own_13[i32(4)] = _S265;
        sum_0 = sum_0 + _S265;
    }
    var _S266 : bool = near_0(i32(13), i32(5));
    if(_S266)
    {
        var _S267 : f32 = exp2(-721.3475341796875f * difference_0(_S255, taps_0[i32(5)]));
        own_13[i32(5)] = _S267;
        sum_0 = sum_0 + _S267;
    }
    var _S268 : bool = near_0(i32(13), i32(6));
    if(_S268)
    {
        var _S269 : f32 = exp2(-721.3475341796875f * difference_0(_S255, taps_0[i32(6)]));
        own_13[i32(6)] = _S269;
        sum_0 = sum_0 + _S269;
    }
    var _S270 : bool = near_0(i32(13), i32(7));
    if(_S270)
    {
        var _S271 : f32 = exp2(-721.3475341796875f * difference_0(_S255, taps_0[i32(7)]));
        own_13[i32(7)] = _S271;
        sum_0 = sum_0 + _S271;
    }
    var _S272 : bool = near_0(i32(13), i32(8));
    if(_S272)
    {
        var _S273 : f32 = exp2(-721.3475341796875f * difference_0(_S255, taps_0[i32(8)]));
        own_13[i32(8)] = _S273;
        sum_0 = sum_0 + _S273;
    }
    if(_S256)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_13[i32(0)] / (16.0f * sum_0);
    }
    if(_S258)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_13[i32(1)] / (16.0f * sum_0);
    }
    if(_S260)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_13[i32(2)] / (16.0f * sum_0);
    }
    if(_S262)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_13[i32(3)] / (16.0f * sum_0);
    }
    if(_S264)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_13[i32(4)] / (16.0f * sum_0);
    }
    if(_S266)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_13[i32(5)] / (16.0f * sum_0);
    }
    if(_S268)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_13[i32(6)] / (16.0f * sum_0);
    }
    if(_S270)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_13[i32(7)] / (16.0f * sum_0);
    }
    if(_S272)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_13[i32(8)] / (16.0f * sum_0);
    }
    var _S274 : Surface_0 = surface_0(_S5, i32(14));
    var own_14 : array<f32, i32(9)>;
    var _S275 : bool = near_0(i32(14), i32(0));
    if(_S275)
    {
        var _S276 : f32 = exp2(-721.3475341796875f * difference_0(_S274, taps_0[i32(0)]));
        own_14[i32(0)] = _S276;
        sum_0 = _S276;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S277 : bool = near_0(i32(14), i32(1));
    if(_S277)
    {
        var _S278 : f32 = exp2(-721.3475341796875f * difference_0(_S274, taps_0[i32(1)]));
        own_14[i32(1)] = _S278;
        sum_0 = sum_0 + _S278;
    }
    var _S279 : bool = near_0(i32(14), i32(2));
    if(_S279)
    {
        var _S280 : f32 = exp2(-721.3475341796875f * difference_0(_S274, taps_0[i32(2)]));
        own_14[i32(2)] = _S280;
        sum_0 = sum_0 + _S280;
    }
    var _S281 : bool = near_0(i32(14), i32(3));
    if(_S281)
    {
        var _S282 : f32 = exp2(-721.3475341796875f * difference_0(_S274, taps_0[i32(3)]));
        own_14[i32(3)] = _S282;
        sum_0 = sum_0 + _S282;
    }
    var _S283 : bool = near_0(i32(14), i32(4));
    if(_S283)
    {
        var _S284 : f32 = exp2(-721.3475341796875f * difference_0(_S274, taps_0[i32(4)]));
        own_14[i32(4)] = _S284;
        sum_0 = sum_0 + _S284;
    }
    var _S285 : bool = near_0(i32(14), i32(5));
    if(_S285)
    {
        var _S286 : f32 = exp2(-721.3475341796875f * difference_0(_S274, taps_0[i32(5)]));
        own_14[i32(5)] = _S286;
        sum_0 = sum_0 + _S286;
    }
    var _S287 : bool = near_0(i32(14), i32(6));
    if(_S287)
    {
        var _S288 : f32 = exp2(-721.3475341796875f * difference_0(_S274, taps_0[i32(6)]));
        own_14[i32(6)] = _S288;
        sum_0 = sum_0 + _S288;
    }
    var _S289 : bool = near_0(i32(14), i32(7));
    if(_S289)
    {
        var _S290 : f32 = exp2(-721.3475341796875f * difference_0(_S274, taps_0[i32(7)]));
        own_14[i32(7)] = _S290;
        sum_0 = sum_0 + _S290;
    }
    var _S291 : bool = near_0(i32(14), i32(8));
    if(_S291)
    {
        var _S292 : f32 = exp2(-721.3475341796875f * difference_0(_S274, taps_0[i32(8)]));
        own_14[i32(8)] = _S292;
        sum_0 = sum_0 + _S292;
    }
    if(_S275)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_14[i32(0)] / (16.0f * sum_0);
    }
    if(_S277)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_14[i32(1)] / (16.0f * sum_0);
    }
    if(_S279)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_14[i32(2)] / (16.0f * sum_0);
    }
    if(_S281)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_14[i32(3)] / (16.0f * sum_0);
    }
    if(_S283)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_14[i32(4)] / (16.0f * sum_0);
    }
    if(_S285)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_14[i32(5)] / (16.0f * sum_0);
    }
    if(_S287)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_14[i32(6)] / (16.0f * sum_0);
    }
    if(_S289)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_14[i32(7)] / (16.0f * sum_0);
    }
    if(_S291)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_14[i32(8)] / (16.0f * sum_0);
    }
    var _S293 : Surface_0 = surface_0(_S5, i32(15));
    var own_15 : array<f32, i32(9)>;
    var _S294 : bool = near_0(i32(15), i32(0));
    if(_S294)
    {
        var _S295 : f32 = exp2(-721.3475341796875f * difference_0(_S293, taps_0[i32(0)]));
        own_15[i32(0)] = _S295;
        sum_0 = _S295;
    }
    else
    {
        sum_0 = 0.0f;
    }
    var _S296 : bool = near_0(i32(15), i32(1));
    if(_S296)
    {
        var _S297 : f32 = exp2(-721.3475341796875f * difference_0(_S293, taps_0[i32(1)]));
        own_15[i32(1)] = _S297;
        sum_0 = sum_0 + _S297;
    }
    var _S298 : bool = near_0(i32(15), i32(2));
    if(_S298)
    {
        var _S299 : f32 = exp2(-721.3475341796875f * difference_0(_S293, taps_0[i32(2)]));
        own_15[i32(2)] = _S299;
        sum_0 = sum_0 + _S299;
    }
    var _S300 : bool = near_0(i32(15), i32(3));
    if(_S300)
    {
        var _S301 : f32 = exp2(-721.3475341796875f * difference_0(_S293, taps_0[i32(3)]));
        own_15[i32(3)] = _S301;
        sum_0 = sum_0 + _S301;
    }
    var _S302 : bool = near_0(i32(15), i32(4));
    if(_S302)
    {
        var _S303 : f32 = exp2(-721.3475341796875f * difference_0(_S293, taps_0[i32(4)]));
        own_15[i32(4)] = _S303;
        sum_0 = sum_0 + _S303;
    }
    var _S304 : bool = near_0(i32(15), i32(5));
    if(_S304)
    {
        var _S305 : f32 = exp2(-721.3475341796875f * difference_0(_S293, taps_0[i32(5)]));
        own_15[i32(5)] = _S305;
        sum_0 = sum_0 + _S305;
    }
    var _S306 : bool = near_0(i32(15), i32(6));
    if(_S306)
    {
        var _S307 : f32 = exp2(-721.3475341796875f * difference_0(_S293, taps_0[i32(6)]));
        own_15[i32(6)] = _S307;
        sum_0 = sum_0 + _S307;
    }
    var _S308 : bool = near_0(i32(15), i32(7));
    if(_S308)
    {
        var _S309 : f32 = exp2(-721.3475341796875f * difference_0(_S293, taps_0[i32(7)]));
        own_15[i32(7)] = _S309;
        sum_0 = sum_0 + _S309;
    }
    var _S310 : bool = near_0(i32(15), i32(8));
    if(_S310)
    {
        var _S311 : f32 = exp2(-721.3475341796875f * difference_0(_S293, taps_0[i32(8)]));
        own_15[i32(8)] = _S311;
        sum_0 = sum_0 + _S311;
    }
    if(_S294)
    {
        weights_0[i32(0)] = weights_0[i32(0)] + own_15[i32(0)] / (16.0f * sum_0);
    }
    if(_S296)
    {
        weights_0[i32(1)] = weights_0[i32(1)] + own_15[i32(1)] / (16.0f * sum_0);
    }
    if(_S298)
    {
        weights_0[i32(2)] = weights_0[i32(2)] + own_15[i32(2)] / (16.0f * sum_0);
    }
    if(_S300)
    {
        weights_0[i32(3)] = weights_0[i32(3)] + own_15[i32(3)] / (16.0f * sum_0);
    }
    if(_S302)
    {
        weights_0[i32(4)] = weights_0[i32(4)] + own_15[i32(4)] / (16.0f * sum_0);
    }
    if(_S304)
    {
        weights_0[i32(5)] = weights_0[i32(5)] + own_15[i32(5)] / (16.0f * sum_0);
    }
    if(_S306)
    {
        weights_0[i32(6)] = weights_0[i32(6)] + own_15[i32(6)] / (16.0f * sum_0);
    }
    if(_S308)
    {
        weights_0[i32(7)] = weights_0[i32(7)] + own_15[i32(7)] / (16.0f * sum_0);
    }
    if(_S310)
    {
        weights_0[i32(8)] = weights_0[i32(8)] + own_15[i32(8)] / (16.0f * sum_0);
    }
    var _S312 : vec3<i32> = vec3<i32>(at_1, i32(0));
    var _S313 : vec3<i32> = vec3<i32>(at_2, i32(0));
    var _S314 : vec3<i32> = vec3<i32>(at_3, i32(0));
    var _S315 : vec3<i32> = vec3<i32>(at_4, i32(0));
    var _S316 : vec3<i32> = vec3<i32>(at_5, i32(0));
    var _S317 : vec3<i32> = vec3<i32>(at_6, i32(0));
    var _S318 : vec3<i32> = vec3<i32>(at_7, i32(0));
    var _S319 : vec3<i32> = vec3<i32>(at_8, i32(0));
    var _S320 : vec3<i32> = vec3<i32>(at_9, i32(0));
    textureStore((destination_0), (vec2<u32>(_S5)), (vec4<f32>(weights_0[i32(0)]) * (textureLoad((color_0), ((_S312)).xy, ((_S312)).z)) + vec4<f32>(weights_0[i32(1)]) * (textureLoad((color_0), ((_S313)).xy, ((_S313)).z)) + vec4<f32>(weights_0[i32(2)]) * (textureLoad((color_0), ((_S314)).xy, ((_S314)).z)) + vec4<f32>(weights_0[i32(3)]) * (textureLoad((color_0), ((_S315)).xy, ((_S315)).z)) + vec4<f32>(weights_0[i32(4)]) * (textureLoad((color_0), ((_S316)).xy, ((_S316)).z)) + vec4<f32>(weights_0[i32(5)]) * (textureLoad((color_0), ((_S317)).xy, ((_S317)).z)) + vec4<f32>(weights_0[i32(6)]) * (textureLoad((color_0), ((_S318)).xy, ((_S318)).z)) + vec4<f32>(weights_0[i32(7)]) * (textureLoad((color_0), ((_S319)).xy, ((_S319)).z)) + vec4<f32>(weights_0[i32(8)]) * (textureLoad((color_0), ((_S320)).xy, ((_S320)).z))));
    return;
}

