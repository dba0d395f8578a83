import { stacked, turned } from "./rows.js";

export async function run({ module, inputs, layered, uniforms, width, height }) {
    const gl = document.createElement("canvas").getContext("webgl2");
    if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("no targets of floats");
    // Textures of floats can be filtered.
    gl.getExtension("OES_texture_float_linear");
    const { create } = await import(module);
    const filter = create(gl);
    const textures = {};
    for (const [name, layers] of Object.entries(inputs)) {
        const target = layered.includes(name) ? gl.TEXTURE_2D_ARRAY : gl.TEXTURE_2D;
        textures[name] = gl.createTexture();
        gl.bindTexture(target, textures[name]);
        const texels = stacked(layers, width, height, true);
        if (target === gl.TEXTURE_2D) gl.texImage2D(target, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, texels);
        else gl.texImage3D(target, 0, gl.RGBA32F, width, height, layers.length, 0, gl.RGBA, gl.FLOAT, texels);
    }
    const target = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, target);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
    const framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
    Object.assign(filter.uniforms, uniforms);
    filter.draw(textures, { framebuffer, width, height });
    const rgba = new Float32Array(4 * width * height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, rgba);
    if (gl.getError()) throw new Error("WebGL reports an error");
    filter.dispose();
    return turned(rgba, width, height);
}
