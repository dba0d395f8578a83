import * as pc from "playcanvas";
import { stacked, turned } from "./rows.js";

async function runOn(type, { module, className, picture, filtered, inputs, layered, uniforms, width, height }) {
    const canvas = document.createElement("canvas");
    const device = await pc.createGraphicsDevice(canvas, { deviceTypes: [type], antialias: false });
    if (device.deviceType !== type) throw new Error(`PlayCanvas made ${device.deviceType}, not ${type}`);
    const app = new pc.AppBase(canvas);
    const options = new pc.AppOptions();
    options.graphicsDevice = device;
    options.componentSystems = [pc.CameraComponentSystem];
    app.init(options);
    const { [`${className}Effect`]: Filter } = await import(module);
    const below = device.isWebGL2;
    const made = (name, layers) => new pc.Texture(device, {
        name, width, height,
        format: pc.PIXELFORMAT_RGBA32F,
        mipmaps: false,
        minFilter: filtered.includes(name) ? pc.FILTER_LINEAR : pc.FILTER_NEAREST,
        magFilter: filtered.includes(name) ? pc.FILTER_LINEAR : pc.FILTER_NEAREST,
        addressU: pc.ADDRESS_CLAMP_TO_EDGE,
        addressV: pc.ADDRESS_CLAMP_TO_EDGE,
        ...(layered.includes(name) ? { arrayLength: layers.length } : {}),
        ...(layers.length ? { levels: [layered.includes(name) ? layers.map((l) => (below ? turned(l, width, height) : l)) : stacked(layers, width, height, below)] } : {}),
    });
    const filter = new Filter(device);
    Object.assign(filter.uniforms, uniforms);
    let source;
    for (const [name, layers] of Object.entries(inputs)) {
        const texture = made(name, layers);
        if (name === picture) source = { colorBuffer: texture };
        else filter.inputs[name] = texture;
    }
    const result = made("result", []);
    const target = new pc.RenderTarget({ colorBuffer: result, depth: false });
    device.frameStart?.();
    filter.render(source, target);
    device.frameEnd?.();
    const read = await result.read(0, 0, width, height, { renderTarget: target, immediate: true });
    const rgba = new Float32Array(read.buffer, read.byteOffset, 4 * width * height);
    return below ? turned(rgba, width, height) : rgba;
}

export const run = (task) => runOn(pc.DEVICETYPE_WEBGL2, task);

export const runWebGpu = (task) => runOn(pc.DEVICETYPE_WEBGPU, task);
