import * as THREE from "three";
import { EffectComposer, EffectPass, TextureEffect, BlendFunction } from "postprocessing";
import { textureOf } from "./three-webgl.js";
import { turned } from "./rows.js";

export async function run({ module, className, picture, inputs, layered, uniforms, width, height }) {
    const { [`${className}Effect`]: Filter } = await import(module);
    const renderer = new THREE.WebGLRenderer();
    renderer.setSize(width, height, false);
    const composer = new EffectComposer(renderer, { frameBufferType: THREE.FloatType });
    composer.autoRenderToScreen = false;
    const camera = new THREE.Camera();
    const textures = {};
    for (const [name, layers] of Object.entries(inputs)) textures[name] = textureOf(layers, layered.includes(name), width, height);
    const first = new TextureEffect({ texture: textures[picture], blendFunction: BlendFunction.SET });
    composer.addPass(new EffectPass(camera, first));
    const effect = new Filter();
    for (const [name, texture] of Object.entries(textures)) if (name !== picture) effect.uniforms.get(name).value = texture;
    for (const [name, value] of Object.entries(uniforms)) effect.uniforms.get(name).value = value;
    composer.addPass(new EffectPass(camera, effect));
    composer.render();
    // Two passes: the second one wrote to the first one's input.
    const rgba = new Float32Array(4 * width * height);
    renderer.readRenderTargetPixels(composer.inputBuffer, 0, 0, width, height, rgba);
    return turned(rgba, width, height);
}
