// Orientation for Unity's URP: A mixture of the pixel, the one to its right and the one two rows below.
// Written by straightline 0.1.0; do not edit. See README.md.

Shader "Straightline/Orientation"
{
    Properties
    {
        _below("below", Range(0.0, 1.0)) = 0.5
    }
    SubShader
    {
        Tags { "RenderPipeline" = "UniversalPipeline" }
        ZWrite Off
        ZTest Always
        Cull Off
        Blend Off

        Pass
        {
            Name "Orientation"

            HLSLPROGRAM
            #pragma target 4.5
            #pragma vertex Vert
            #pragma fragment Frag

            #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"
            #include "Packages/com.unity.render-pipelines.core/Runtime/Utilities/Blit.hlsl"
            #include "Orientation.hlsl"

            float _below;

            float4 Frag(Varyings input) : SV_Target
            {
                return orientation(_BlitTexture, input.positionCS.xy, _below);
            }
            ENDHLSL
        }
    }
}
