import * as PIXI from "pixi.js";

/**
 * The picture as a sprite with the filter, somewhere in a larger stage: the filter's input is a part of a texture whose sides are powers
 * of two.
 */
async function runOn(preference, { module, className, picture, inputs, uniforms, width, height }) {
    const { [`${className}Filter`]: Filter } = await import(module);
    const [x, y] = [7, 5];
    const renderer = await PIXI.autoDetectRenderer({ preference, width: width + 20, height: height + 10, antialias: false });
    const type = { webgl: PIXI.RendererType.WEBGL, webgpu: PIXI.RendererType.WEBGPU }[preference];
    if (renderer.type !== type) throw new Error(`PixiJS made ${renderer.name}, not ${preference}`);
    const texels = Uint8Array.from(inputs[picture][0], (value) => Math.round(value * 255));
    const texture = PIXI.Texture.from({ resource: texels, width, height, format: "rgba8unorm", scaleMode: "nearest" });
    const sprite = new PIXI.Sprite(texture);
    sprite.position.set(x, y);
    const filter = new Filter();
    for (const [name, value] of Object.entries(uniforms)) filter.uniforms[name] = value;
    sprite.filters = [filter];
    const stage = new PIXI.Container();
    stage.addChild(sprite);
    const target = PIXI.RenderTexture.create({ width: width + 20, height: height + 10 });
    renderer.render({ container: stage, target });
    const read = preference === "webgpu" ? await ofWebGpu(renderer, target.source) : renderer.extract.pixels(target);
    const rgba = new Float32Array(4 * width * height);
    for (let row = 0; row < height; row++) {
        const from = 4 * ((row + y) * read.width + x);
        read.pixels.slice(from, from + 4 * width).forEach((value, k) => { rgba[4 * width * row + k] = value / 255; });
    }
    return rgba;
}

/** The pixels of a texture. PixiJS reads them by a canvas, which comes out white without a display. */
async function ofWebGpu(renderer, source) {
    const { device } = renderer.gpu;
    const texture = renderer.texture.getGpuSource(source);
    const bytesPerRow = Math.ceil((4 * source.pixelWidth) / 256) * 256;
    const buffer = device.createBuffer({ size: bytesPerRow * source.pixelHeight, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    const encoder = device.createCommandEncoder();
    encoder.copyTextureToBuffer({ texture }, { buffer, bytesPerRow }, [source.pixelWidth, source.pixelHeight]);
    device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const pixels = new Uint8Array(buffer.getMappedRange()).slice();
    if (texture.format === "bgra8unorm") {
        for (let k = 0; k < pixels.length; k += 4) [pixels[k], pixels[k + 2]] = [pixels[k + 2], pixels[k]];
    }
    return { pixels, width: bytesPerRow / 4 };
}

export const run = (task) => runOn("webgl", task);

export const runWebGpu = (task) => runOn("webgpu", task);
