import * as pc from "playcanvas";

/** Red of row 0 and of the last row of a scene whose upper half is red. */
export async function run({ webgpu }) {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 8;
    document.body.append(canvas);
    const device = await pc.createGraphicsDevice(canvas, { deviceTypes: [webgpu ? "webgpu" : "webgl2"], antialias: false });
    const app = new pc.AppBase(canvas);
    const options = new pc.AppOptions();
    options.graphicsDevice = device;
    options.componentSystems = [pc.CameraComponentSystem, pc.RenderComponentSystem];
    app.init(options);
    app.start();
    const texture = new pc.Texture(device, { width: 8, height: 8, format: pc.PIXELFORMAT_RGBA32F, mipmaps: false, minFilter: pc.FILTER_NEAREST, magFilter: pc.FILTER_NEAREST });
    const target = new pc.RenderTarget({ colorBuffer: texture, depth: true });
    const camera = new pc.Entity();
    camera.addComponent("camera", { clearColor: new pc.Color(0, 0, 0, 1), renderTarget: target });
    camera.setPosition(0, 0, 5);
    app.root.addChild(camera);
    const material = new pc.StandardMaterial();
    material.emissive = new pc.Color(1, 0, 0);
    material.useLighting = false;
    material.cull = pc.CULLFACE_NONE;
    material.update();
    const above = new pc.Entity();
    above.addComponent("render", { type: "plane", material });
    above.setLocalScale(20, 1, 20);
    above.setLocalEulerAngles(90, 0, 0);
    above.setPosition(0, 10.2, 0);
    app.root.addChild(above);
    await new Promise((done) => setTimeout(done, 800));
    const read = await texture.read(0, 0, 8, 8, { renderTarget: target, immediate: true });
    const rgba = new Float32Array(read.buffer, read.byteOffset, 4 * 8 * 8);
    return Float32Array.of(rgba[0], rgba[4 * 56]);
}
