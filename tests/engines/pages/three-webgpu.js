import * as THREE from "three/webgpu";
import { texture, uniform } from "three/tsl";
import { stacked } from "./rows.js";

export async function run({ modules, functionName, filtered, inputs, layered, chain, sizes, uniforms, width, height }) {
    const { [functionName]: filter } = await import(modules.node);
    const renderer = new THREE.WebGPURenderer();
    await renderer.init();
    if (!renderer.backend.isWebGPUBackend) throw new Error("three.js did not get WebGPU");
    renderer.setSize(width, height, false);
    const nodes = {};
    for (const [name, layers] of Object.entries(inputs)) {
        const [w, h] = sizes[name] ?? [width, height];
        const texels = stacked(layers, w, h, false);
        const made = layered.includes(name)
            ? new THREE.DataArrayTexture(texels, w, h, layers.length)
            : new THREE.DataTexture(texels, w, h);
        made.type = THREE.FloatType;
        made.format = THREE.RGBAFormat;
        if (filtered.includes(name)) made.minFilter = made.magFilter = THREE.LinearFilter;
        made.needsUpdate = true;
        nodes[name] = texture(made);
    }
    const material = new THREE.NodeMaterial();
    const set = chain ? Object.fromEntries(Object.entries(uniforms).map(([name, value]) => [name, uniform(value)])) : uniforms;
    material.fragmentNode = filter({ ...nodes, ...set });
    const target = new THREE.RenderTarget(width, height, { type: THREE.FloatType, depthBuffer: false });
    renderer.setRenderTarget(target);
    const quad = new THREE.QuadMesh(material);
    await quad.renderAsync?.(renderer) ?? quad.render(renderer);
    return new Float32Array(await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height));
}
