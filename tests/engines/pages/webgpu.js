export async function run({ module, inputs, layered, chain, sizes, uniforms, width, height }) {
    const adapter = await navigator.gpu.requestAdapter();
    if (!adapter) throw new Error("no WebGPU adapter");
    const device = await adapter.requestDevice({ requiredFeatures: ["float32-filterable"] });
    const errors = [];
    device.onuncapturederror = ({ error }) => errors.push(error.message);
    const { create } = await import(module);
    const filter = create(device, "rgba32float");
    const views = {};
    for (const [name, layers] of Object.entries(inputs)) {
        const [w, h] = sizes[name] ?? [width, height];
        const texture = device.createTexture({
            size: [w, h, layers.length],
            format: "rgba32float",
            usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
        });
        layers.forEach((texels, z) => device.queue.writeTexture({ texture, origin: [0, 0, z] }, texels, { bytesPerRow: 16 * w }, [w, h]));
        // A chain is given textures, whose sizes those of its pictures follow from.
        views[name] = chain ? texture : texture.createView({ dimension: layered.includes(name) ? "2d-array" : "2d" });
    }
    const target = device.createTexture({
        size: [width, height],
        format: "rgba32float",
        usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC,
    });
    Object.assign(filter.uniforms, uniforms);
    // A chain makes its textures again for another size.
    if (chain) encodeOnce(device, filter, views, [9, 7]);
    const encoder = device.createCommandEncoder();
    filter.encode(encoder, views, target.createView());
    const bytesPerRow = Math.ceil((16 * width) / 256) * 256;
    const buffer = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    encoder.copyTextureToBuffer({ texture: target }, { buffer, bytesPerRow }, [width, height]);
    device.queue.submit([encoder.finish()]);
    await buffer.mapAsync(GPUMapMode.READ);
    const rows = new Float32Array(buffer.getMappedRange());
    const rgba = new Float32Array(4 * width * height);
    for (let y = 0; y < height; y++) rgba.set(rows.subarray((bytesPerRow / 4) * y, (bytesPerRow / 4) * y + 4 * width), 4 * width * y);
    if (errors.length) throw new Error(errors.join("\n"));
    return rgba;
}

/** Runs a chain on a picture of another size. */
function encodeOnce(device, filter, views, size) {
    const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.RENDER_ATTACHMENT;
    const [color, target] = [0, 1].map(() => device.createTexture({ size, format: "rgba32float", usage }));
    const encoder = device.createCommandEncoder();
    filter.encode(encoder, { ...views, color: { view: color.createView(), width: size[0], height: size[1] } }, target.createView());
    device.queue.submit([encoder.finish()]);
}
