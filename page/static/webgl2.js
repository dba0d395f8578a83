// Draws a shader by WebGL2, from its GLSL ES 3.00 and what the manifest says of that language.

import { Pixels } from "./pixels.js";

const TRIANGLE = `#version 300 es
void main() {
    gl_Position = vec4(float(gl_VertexID & 1) * 4.0 - 1.0, float(gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}`;

/** Internal format, format and type of a texture by WebGPU's name. */
const FORMATS = {
  r32float: ["R32F", "RED", "FLOAT", Float32Array],
  r16float: ["R16F", "RED", "HALF_FLOAT", Uint16Array],
  rg16float: ["RG16F", "RG", "HALF_FLOAT", Uint16Array],
  rgba16float: ["RGBA16F", "RGBA", "HALF_FLOAT", Uint16Array],
  rgba32float: ["RGBA32F", "RGBA", "FLOAT", Float32Array],
};

export class WebGl2 {
  name = "WebGL2";
  stages = ["fragment"];
  #gl;
  #programs = new Map();
  #textures = new Map();
  #samplers;

  /** An executor, or null where there is no context that draws to floats. */
  static async create() {
    const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
    return gl?.getExtension("EXT_color_buffer_float") ? new WebGl2(gl) : null;
  }

  constructor(gl) {
    this.#gl = gl;
    // Texels that are read one by one need a sampler of the nearest: with the default one the texture is incomplete, and black.
    this.#samplers = { nearest: this.#sampler(gl.NEAREST), linear: this.#sampler(gl.LINEAR) };
  }

  #sampler(filter) {
    const gl = this.#gl;
    const sampler = gl.createSampler();
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.samplerParameteri(sampler, name, filter);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.samplerParameteri(sampler, name, gl.CLAMP_TO_EDGE);
    return sampler;
  }

  /** Resolves when the context is gone. */
  lost() {
    return new Promise((resolve) => {
      this.#gl.canvas.addEventListener("webglcontextlost", () => resolve("the WebGL2 context was lost"));
    });
  }

  /** Why a shader cannot run here, or null. */
  refuses({ texts, refused, manifest }) {
    if (!texts.essl300) return refused.essl300 ?? "it has no GLSL ES 3.00";
    return manifest.varyings?.length ? "it interpolates values over triangles" : null;
  }

  /** Draws; gives `Pixels`. */
  async draw({ manifest, texts }, inputs, uniforms, [width, height]) {
    const gl = this.#gl;
    const program = this.#program(texts.essl300);
    gl.useProgram(program);
    let unit = 0;
    for (const bound of manifest.language_bindings.filter((bound) => bound.language === "essl300")) {
      const place = gl.getUniformLocation(program, bound.name);
      if (!place) continue;
      if (bound.kind === "combined-sampler") {
        const { target, texture } = this.#upload(inputs, bound.texture ?? bound.of);
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(target, texture);
        gl.bindSampler(unit, bound.sampler ? this.#samplers.linear : this.#samplers.nearest);
        gl.uniform1i(place, unit++);
      } else if (bound.kind === "uniform") {
        this.#set(program, bound.name, place, uniforms[bound.of] ?? [0]);
      }
    }
    const outputs = [manifest.output].flat();
    const drawn = outputs.map(() => this.#target(width, height));
    const frame = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    drawn.forEach((texture, k) => {
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + k, gl.TEXTURE_2D, texture, 0);
    });
    gl.drawBuffers(outputs.map((_, k) => gl.COLOR_ATTACHMENT0 + k));
    gl.viewport(0, 0, width, height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const data = new Float32Array(width * height * 4);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, data);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.deleteFramebuffer(frame);
    drawn.forEach((texture) => gl.deleteTexture(texture));
    const error = gl.getError();
    if (error !== gl.NO_ERROR) throw new Error(`WebGL2: error 0x${error.toString(16)}`);
    // Row 0 of the target is row 0 of what is read, which the shader takes for the upper one.
    return new Pixels(width, height, data);
  }

  #target(width, height) {
    const gl = this.#gl;
    const texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0 + 15);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA16F, width, height);
    return texture;
  }

  #program(fragment) {
    const known = this.#programs.get(fragment);
    if (known) return known;
    const gl = this.#gl;
    const program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, TRIANGLE], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
        throw new Error(`WebGL2: ${gl.getShaderInfoLog(shader)}`);
      }
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error(`WebGL2: ${gl.getProgramInfoLog(program)}`);
    }
    this.#programs.set(fragment, program);
    return program;
  }

  #set(program, name, place, numbers) {
    const gl = this.#gl;
    const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
    for (let k = 0; k < count; k++) {
      const info = gl.getActiveUniform(program, k);
      if (info.name !== name) continue;
      const setters = {
        [gl.FLOAT]: ["uniform1fv", 1], [gl.FLOAT_VEC2]: ["uniform2fv", 2], [gl.FLOAT_VEC3]: ["uniform3fv", 3],
        [gl.FLOAT_VEC4]: ["uniform4fv", 4], [gl.INT]: ["uniform1iv", 1], [gl.INT_VEC2]: ["uniform2iv", 2],
        [gl.INT_VEC3]: ["uniform3iv", 3], [gl.INT_VEC4]: ["uniform4iv", 4], [gl.UNSIGNED_INT]: ["uniform1uiv", 1],
        [gl.UNSIGNED_INT_VEC2]: ["uniform2uiv", 2], [gl.UNSIGNED_INT_VEC3]: ["uniform3uiv", 3],
        [gl.UNSIGNED_INT_VEC4]: ["uniform4uiv", 4],
      };
      const known = setters[info.type];
      if (!known) throw new Error(`the uniform \`${name}\` has a type that the page cannot set`);
      gl[known[0]](place, Array.from({ length: known[1] }, (_, lane) => numbers[lane] ?? 0));
    }
  }

  /** A texture of a kernel's inputs, uploaded once; those of the last few inputs are kept. */
  #upload(inputs, name) {
    const gl = this.#gl;
    if (!this.#textures.has(inputs)) {
      if (this.#textures.size >= 3) {
        const [oldest, textures] = this.#textures.entries().next().value;
        for (const { texture } of textures.values()) gl.deleteTexture(texture);
        this.#textures.delete(oldest);
      }
      this.#textures.set(inputs, new Map());
    }
    const textures = this.#textures.get(inputs);
    if (textures.has(name)) return textures.get(name);
    const { width, height, layers, format, offset, length, layered } = inputs.textures.find((t) => t.name === name);
    const [internal, components, type, View] = FORMATS[format];
    const bytes = inputs.bytes.slice(offset, offset + length);
    const texels = new View(bytes.buffer);
    const target = layered ? gl.TEXTURE_2D_ARRAY : gl.TEXTURE_2D;
    const texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0 + 15);
    gl.bindTexture(target, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    if (layered) {
      gl.texStorage3D(target, 1, gl[internal], width, height, layers);
      gl.texSubImage3D(target, 0, 0, 0, 0, width, height, layers, gl[components], gl[type], texels);
    } else {
      gl.texStorage2D(target, 1, gl[internal], width, height);
      gl.texSubImage2D(target, 0, 0, 0, width, height, gl[components], gl[type], texels);
    }
    const uploaded = { target, texture };
    textures.set(name, uploaded);
    return uploaded;
  }
}
