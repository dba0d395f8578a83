import * as WEBGL from "three";
import * as WEBGPU from "three/webgpu";
import { pass } from "three/tsl";
import { EffectComposer } from "three/addons/postprocessing/EffectComposer.js";
import { RenderPass } from "three/addons/postprocessing/RenderPass.js";
import { turned } from "./rows.js";

/** A leaning plane before a camera; `parallel` for an orthographic one, as high as the other one at the plane's distance. */
export function sceneOf(THREE, { fov, near, far, distance, slope, color, width, height, parallel }) {
    const scene = new THREE.Scene();
    const up = distance * Math.tan((fov * Math.PI) / 360);
    const across = (up * width) / height;
    const camera = parallel
        ? new THREE.OrthographicCamera(-across, across, up, -up, near, far)
        : new THREE.PerspectiveCamera(fov, width / height, near, far);
    const plane = new THREE.Mesh(new THREE.PlaneGeometry(60, 60), new THREE.MeshBasicMaterial());
    plane.material.color.setRGB(...color);
    plane.rotation.x = slope;
    plane.position.z = -distance;
    scene.add(plane);
    return { scene, camera };
}

export async function run({ module, webgpu, ...task }) {
    const emitted = await import(module);
    return webgpu ? runWebGpu(emitted, task) : runWebGl(emitted, task);
}

async function runWebGl(emitted, task) {
    const { className, width, height, reversed } = task;
    const Filter = emitted[`${className}Pass`];
    const { scene, camera } = sceneOf(WEBGL, task);
    const renderer = new WEBGL.WebGLRenderer({ reversedDepthBuffer: reversed });
    if (reversed && !renderer.capabilities.reversedDepthBuffer) throw new Error("no EXT_clip_control");
    renderer.setSize(width, height, false);
    const depthTexture = new WEBGL.DepthTexture(width, height, reversed ? WEBGL.FloatType : undefined);
    const composer = new EffectComposer(renderer, new WEBGL.WebGLRenderTarget(width, height, { type: WEBGL.FloatType, depthTexture }));
    composer.renderToScreen = false;
    composer.addPass(new RenderPass(scene, camera));
    composer.addPass(new Filter(camera));
    composer.render();
    const rgba = new Float32Array(4 * width * height);
    renderer.readRenderTargetPixels(composer.readBuffer, 0, 0, width, height, rgba);
    return turned(rgba, width, height);
}

async function runWebGpu(emitted, task) {
    const { functionName, width, height } = task;
    const { scene, camera } = sceneOf(WEBGPU, task);
    const renderer = new WEBGPU.WebGPURenderer();
    await renderer.init();
    if (!renderer.backend.isWebGPUBackend) throw new Error("three.js did not get WebGPU");
    renderer.setSize(width, height, false);
    const material = new WEBGPU.NodeMaterial();
    material.fragmentNode = emitted[functionName]({ color: pass(scene, camera) });
    const target = new WEBGPU.RenderTarget(width, height, { type: WEBGPU.FloatType, depthBuffer: false });
    renderer.setRenderTarget(target);
    new WEBGPU.QuadMesh(material).render(renderer);
    return new Float32Array(await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height));
}
