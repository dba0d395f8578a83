import * as WEBGL from "three";
import * as WEBGPU from "three/webgpu";

/** Red of row 0 and of the last row of a scene whose upper half is red. */
export async function run({ webgpu }) {
    const THREE = webgpu ? WEBGPU : WEBGL;
    const renderer = webgpu ? new THREE.WebGPURenderer() : new THREE.WebGLRenderer();
    await renderer.init?.();
    renderer.setSize(8, 8, false);
    const scene = new THREE.Scene();
    const camera = new THREE.PerspectiveCamera(50, 1, 0.1, 100);
    camera.position.z = 5;
    const above = new THREE.Mesh(new THREE.PlaneGeometry(20, 20), new THREE.MeshBasicMaterial({ color: 0xff0000 }));
    above.position.y = 10.2;
    scene.add(above);
    const target = webgpu
        ? new THREE.RenderTarget(8, 8, { type: THREE.FloatType })
        : new THREE.WebGLRenderTarget(8, 8, { type: THREE.FloatType });
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    let rgba = new Float32Array(4 * 8 * 8);
    if (webgpu) rgba = await renderer.readRenderTargetPixelsAsync(target, 0, 0, 8, 8);
    else renderer.readRenderTargetPixels(target, 0, 0, 8, 8, rgba);
    // Rows that are read of WebGPU may be padded to 256 bytes.
    const row = webgpu && rgba.length > 256 ? 64 : 32;
    return Float32Array.of(rgba[0], rgba[row * 7]);
}
