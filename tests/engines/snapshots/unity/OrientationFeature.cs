// Orientation for Unity's URP: A mixture of the pixel, the one to its right and the one two rows below.
// Written by straightline 0.1.0; do not edit. See README.md.

using UnityEngine;
using UnityEngine.Rendering;
using UnityEngine.Rendering.RenderGraphModule;
using UnityEngine.Rendering.RenderGraphModule.Util;
using UnityEngine.Rendering.Universal;

/// <summary>Filters the camera's colours before post-processing.</summary>
public sealed class OrientationFeature : ScriptableRendererFeature
{
    /// <summary>A material with the shader Straightline/Orientation.</summary>
    public Material material;

    public RenderPassEvent when = RenderPassEvent.BeforeRenderingPostProcessing;

    private FilterPass pass;

    public override void Create()
    {
        pass = new FilterPass();
    }

    public override void AddRenderPasses(ScriptableRenderer renderer, ref RenderingData data)
    {
        if (material == null)
        {
            return;
        }
        pass.material = material;
        pass.renderPassEvent = when;
        pass.requiresIntermediateTexture = true;
        renderer.EnqueuePass(pass);
    }

    private sealed class FilterPass : ScriptableRenderPass
    {
        public Material material;

        public override void RecordRenderGraph(RenderGraph graph, ContextContainer frame)
        {
            var resources = frame.Get<UniversalResourceData>();
            if (resources.isActiveTargetBackBuffer)
            {
                return;
            }
            var source = resources.activeColorTexture;
            var description = graph.GetTextureDesc(source);
            description.name = "Orientation";
            description.clearBuffer = false;
            var target = graph.CreateTexture(description);
            graph.AddBlitPass(new RenderGraphUtils.BlitMaterialParameters(source, target, material, 0), "Orientation");
            resources.cameraColor = target;
        }
    }
}
