import { Engine } from "@babylonjs/core/Engines/engine.js";
import { WebGPUEngine } from "@babylonjs/core/Engines/webgpuEngine.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.renderTarget.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.renderTargetTexture.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.readTexture.js";
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { RenderTargetTexture } from "@babylonjs/core/Materials/Textures/renderTargetTexture.js";
import { StandardMaterial } from "@babylonjs/core/Materials/standardMaterial.js";
import { MeshBuilder } from "@babylonjs/core/Meshes/meshBuilder.js";
import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Scene } from "@babylonjs/core/scene.js";

/** Red of row 0 and of the last row of a scene whose upper half is red. */
export async function run({ webgpu }) {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 8;
    document.body.append(canvas);
    const engine = webgpu ? new WebGPUEngine(canvas) : new Engine(canvas, false);
    if (webgpu) await engine.initAsync();
    const scene = new Scene(engine);
    const camera = new FreeCamera("camera", new Vector3(0, 0, -5), scene);
    camera.setTarget(Vector3.Zero());
    const material = new StandardMaterial("red", scene);
    material.emissiveColor = new Color3(1, 0, 0);
    material.backFaceCulling = false;
    const above = MeshBuilder.CreatePlane("above", { size: 20 }, scene);
    above.position.y = 10.2;
    above.material = material;
    const target = new RenderTargetTexture("target", 8, scene, { type: 1, format: 5 });
    target.activeCamera = camera;
    target.renderList = [above];
    target.clearColor = scene.clearColor.set(0, 0, 0, 1);
    scene.customRenderTargets.push(target);
    await scene.whenReadyAsync();
    for (let frame = 0; frame < 5; frame++) {
        engine.beginFrame();
        scene.render();
        engine.endFrame();
        await new Promise((done) => setTimeout(done, 50));
    }
    const read = await target.readPixels(0, 0, null, true, false, 0, 0, 8, 8);
    const rgba = new Float32Array(read.buffer, read.byteOffset, 4 * 8 * 8);
    return Float32Array.of(rgba[0], rgba[4 * 56]);
}
