import { Engine } from "@babylonjs/core/Engines/engine.js";
import { WebGPUEngine } from "@babylonjs/core/Engines/webgpuEngine.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.rawTexture.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.renderTarget.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.renderTargetTexture.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.readTexture.js";
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { RawTexture } from "@babylonjs/core/Materials/Textures/rawTexture.js";
import { RawTexture2DArray } from "@babylonjs/core/Materials/Textures/rawTexture2DArray.js";
import { RenderTargetTexture } from "@babylonjs/core/Materials/Textures/renderTargetTexture.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Scene } from "@babylonjs/core/scene.js";
import "@babylonjs/core/PostProcesses/postProcessManager.js";
import { ShaderStore } from "@babylonjs/core/Engines/shaderStore.js";
import { stacked, turned } from "./rows.js";

const [RGBA, FLOAT, NEAREST, LINEAR] = [5, 1, 1, 2];

export async function runOn(engineOf, { module, className, picture, filtered, inputs, layered, uniforms, width, height }) {
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    const engine = await engineOf(canvas);
    const { [`${className}PostProcess`]: Filter } = await import(module);
    const scene = new Scene(engine);
    const camera = new FreeCamera("camera", Vector3.Zero(), scene);
    const textures = {};
    for (const [name, layers] of Object.entries(inputs)) {
        const texels = stacked(layers, width, height, true);
        const how = filtered.includes(name) ? LINEAR : NEAREST;
        textures[name] = layered.includes(name)
            ? new RawTexture2DArray(texels, width, height, layers.length, RGBA, scene, false, false, how, FLOAT)
            : new RawTexture(texels, width, height, RGBA, scene, false, false, how, FLOAT);
        textures[name].wrapU = textures[name].wrapV = 0;
    }
    const filter = new Filter(null, { engine, textureType: FLOAT });
    filter.externalTextureSamplerBinding = true;
    filter.onApplyObservable.add((effect) => effect.setTexture("textureSampler", textures[picture]));
    for (const [name, texture] of Object.entries(textures)) if (name !== picture) filter.inputs[name] = texture;
    Object.assign(filter.uniforms, uniforms);
    const target = new RenderTargetTexture("target", { width, height }, scene, { type: FLOAT, format: RGBA, generateDepthBuffer: false });
    for (let k = 0; !(filter.isReady() && target.isReady()); k++) {
        if (k > 200) throw new Error(`the effect is not ready: ${filter.getEffect()?.getCompilationError()}`);
        await new Promise((done) => setTimeout(done, 20));
    }
    engine.beginFrame?.();
    scene.postProcessManager.directRender([filter], target.renderTarget, true);
    engine.endFrame?.();
    const read = await target.readPixels(0, 0, null, true, false, 0, 0, width, height);
    return turned(new Float32Array(read.buffer, read.byteOffset, 4 * width * height), width, height);
}

export function run(task) {
    return runOn((canvas) => new Engine(canvas, false), task);
}

export function runWebGpu(task) {
    return runOn(async (canvas) => {
        const engine = new WebGPUEngine(canvas, { deviceDescriptor: { requiredFeatures: ["float32-filterable"] } });
        await engine.initAsync();
        return engine;
    }, task);
}
