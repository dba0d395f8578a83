import * as THREE from "three";
import { EffectComposer } from "three/addons/postprocessing/EffectComposer.js";
import { TexturePass } from "three/addons/postprocessing/TexturePass.js";
import { stacked, turned } from "./rows.js";

/** A texture as three.js has one of floats. */
export function textureOf(layers, layered, width, height, filtered = false) {
    const texels = stacked(layers, width, height, true);
    const texture = layered
        ? new THREE.DataArrayTexture(texels, width, height, layers.length)
        : new THREE.DataTexture(texels, width, height);
    texture.type = THREE.FloatType;
    texture.format = THREE.RGBAFormat;
    if (filtered) texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    return texture;
}

export async function run({ modules, className, picture, inputs, layered, filtered, chain, sizes, uniforms, width, height }) {
    const { [`${className}Pass`]: Pass } = await import(modules.pass);
    const renderer = new THREE.WebGLRenderer();
    renderer.setSize(width, height, false);
    const composer = new EffectComposer(renderer, new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType }));
    composer.renderToScreen = false;
    const textures = {};
    for (const [name, layers] of Object.entries(inputs)) {
        const [w, h] = sizes[name] ?? [width, height];
        textures[name] = textureOf(layers, layered.includes(name), w, h, chain && filtered.includes(name));
    }
    composer.addPass(new TexturePass(textures[picture]));
    const pass = new Pass();
    composer.addPass(pass);
    for (const [name, texture] of Object.entries(textures)) if (name !== picture) pass.uniforms[name].value = texture;
    for (const [name, value] of Object.entries(uniforms)) pass.uniforms[name].value = value;
    // A chain makes its textures again for another size.
    if (chain) renderOnce(composer, [9, 7], [width, height]);
    composer.render();
    const rgba = new Float32Array(4 * width * height);
    renderer.readRenderTargetPixels(composer.readBuffer, 0, 0, width, height, rgba);
    return turned(rgba, width, height);
}

function renderOnce(composer, small, size) {
    composer.setSize(...small);
    composer.render();
    composer.setSize(...size);
}
