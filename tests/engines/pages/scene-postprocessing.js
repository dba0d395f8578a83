import * as THREE from "three";
import { EffectComposer, EffectPass, RenderPass } from "postprocessing";
import { sceneOf } from "./scene-three.js";
import { turned } from "./rows.js";

export async function run({ module, ...task }) {
    const { className, width, height } = task;
    const { [`${className}Effect`]: Filter } = await import(module);
    const { scene, camera } = sceneOf(THREE, task);
    const renderer = new THREE.WebGLRenderer();
    renderer.setSize(width, height, false);
    const composer = new EffectComposer(renderer, { frameBufferType: THREE.FloatType });
    composer.autoRenderToScreen = false;
    composer.addPass(new RenderPass(scene, camera));
    composer.addPass(new EffectPass(camera, new Filter()));
    composer.render();
    const rgba = new Float32Array(4 * width * height);
    renderer.readRenderTargetPixels(composer.outputBuffer, 0, 0, width, height, rgba);
    return turned(rgba, width, height);
}
