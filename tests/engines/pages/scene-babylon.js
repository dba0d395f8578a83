import { Engine } from "@babylonjs/core/Engines/engine.js";
import { WebGPUEngine } from "@babylonjs/core/Engines/webgpuEngine.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.renderTarget.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.renderTargetTexture.js";
import "@babylonjs/core/Engines/WebGPU/Extensions/engine.readTexture.js";
import "@babylonjs/core/Engines/Extensions/engine.readTexture.js";
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { StandardMaterial } from "@babylonjs/core/Materials/standardMaterial.js";
import { MeshBuilder } from "@babylonjs/core/Meshes/meshBuilder.js";
import { PassPostProcess } from "@babylonjs/core/PostProcesses/passPostProcess.js";
import "@babylonjs/core/PostProcesses/postProcessManager.js";
import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Scene } from "@babylonjs/core/scene.js";
import { turned } from "./rows.js";

const FLOAT = 1;

export async function run({ module, className, webgpu, fov, near, far, distance, slope, color, width, height }) {
    const { [`${className}PostProcess`]: Filter } = await import(module);
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    document.body.append(canvas);
    const engine = webgpu
        ? new WebGPUEngine(canvas, { deviceDescriptor: { requiredFeatures: ["float32-filterable"] } })
        : new Engine(canvas, false);
    if (webgpu) await engine.initAsync();
    const scene = new Scene(engine);
    const camera = new FreeCamera("camera", Vector3.Zero(), scene);
    camera.setTarget(new Vector3(0, 0, 1));
    Object.assign(camera, { fov: (fov * Math.PI) / 180, minZ: near, maxZ: far });
    const material = new StandardMaterial("plain", scene);
    material.emissiveColor = new Color3(...color);
    material.disableLighting = true;
    material.backFaceCulling = false;
    const plane = MeshBuilder.CreatePlane("plane", { size: 60 }, scene);
    plane.position.z = distance;
    // z runs into the scene here.
    plane.rotation.x = -slope;
    plane.material = material;
    const filter = new Filter(camera, { textureType: FLOAT });
    // The picture that the next one gets is the filter's.
    const next = new PassPostProcess("next", 1, camera, 1, engine, false, FLOAT);
    await scene.whenReadyAsync();
    for (let frame = 0; frame < 8; frame++) {
        engine.beginFrame();
        scene.render();
        engine.endFrame();
        await new Promise((done) => setTimeout(done, 50));
    }
    if (!filter.isReady()) throw new Error(`the effect is not ready: ${filter.getEffect()?.getCompilationError()}`);
    const read = await engine._readTexturePixels(next.inputTexture.texture, width, height);
    return turned(new Float32Array(read.buffer, read.byteOffset, 4 * width * height), width, height);
}
