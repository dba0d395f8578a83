// Draws a shader by WebGPU, from its manifest alone.

import { Pixels, uniformBytes } from "./pixels.js";

/** Features of a device by the manifest's names for them. */
const FEATURES = { subgroup: "subgroups", "shader-f16": "shader-f16" };

/** A triangle over the whole target, for shaders of the fragment stage. */
const TRIANGLE = `@vertex fn triangle(@builtin(vertex_index) k: u32) -> @builtin(position) vec4f {
    return vec4f(f32(k & 1u) * 4.0 - 1.0, f32(k >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}`;

export class WebGpu {
  name = "WebGPU";
  stages = ["compute", "fragment"];
  #device;
  #pipelines = new Map();
  #textures = new WeakMap();

  /** An executor, or null where there is no device. */
  static async create() {
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) return null;
    const features = Object.values(FEATURES).filter((name) => adapter.features.has(name));
    // Large patterns have more layers than the least that every device has.
    const { maxTextureDimension2D, maxBufferSize } = adapter.limits;
    const device = await adapter.requestDevice({
      requiredFeatures: features,
      requiredLimits: { maxTextureDimension2D, maxBufferSize },
    });
    return new WebGpu(device);
  }

  constructor(device) {
    this.#device = device;
  }

  /** Resolves when the device is gone, with the reason. */
  lost() {
    return this.#device.lost.then((info) => info.message || "the device was lost");
  }

  /** Why this device cannot run a shader, or null. */
  refuses({ manifest }) {
    const missing = manifest.features?.find((name) => !this.#device.features.has(FEATURES[name]));
    if (missing) return `this device has no ${missing}: choose the stage compute, where one invocation computes a block`;
    return manifest.varyings?.length ? "it interpolates values over triangles: choose the stage compute" : null;
  }

  /** Draws; gives `Pixels`. `inputs` is what the generator said the kernel reads. */
  async draw({ manifest, texts }, inputs, uniforms, [width, height]) {
    const device = this.#device;
    device.pushErrorScope("validation");
    const made = this.#pipeline(manifest, texts.wgsl);
    const outputs = [manifest.output].flat();
    const targets = outputs.map((output) => this.#target(output.format, width, height));
    const textures = this.#upload(inputs);
    const entries = manifest.bindings.map((binding) => ({
      binding: binding.binding,
      resource: this.#resource(binding, textures, uniforms),
    }));
    outputs.forEach((output, k) => {
      if (output.binding !== undefined) entries.push({ binding: output.binding, resource: targets[k].createView() });
    });
    const group = device.createBindGroup({ layout: made.layout, entries });
    const encoder = device.createCommandEncoder();
    if (manifest.stage === "compute") {
      const pass = encoder.beginComputePass();
      pass.setPipeline(made.pipeline);
      pass.setBindGroup(0, group);
      const [x, y] = manifest.workgroup_size;
      const [across, down] = manifest.block ?? [1, 1];
      pass.dispatchWorkgroups(Math.ceil(width / across / x), Math.ceil(height / down / y));
      pass.end();
    } else {
      const attachments = targets.map((target) => ({
        view: target.createView(),
        loadOp: "clear",
        storeOp: "store",
      }));
      const pass = encoder.beginRenderPass({ colorAttachments: attachments });
      pass.setPipeline(made.pipeline);
      pass.setBindGroup(0, group);
      pass.draw(3);
      pass.end();
    }
    const row = Math.ceil((width * 8) / 256) * 256;
    const buffer = device.createBuffer({ size: row * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    encoder.copyTextureToBuffer({ texture: targets[0] }, { buffer, bytesPerRow: row }, [width, height]);
    device.queue.submit([encoder.finish()]);
    const error = await device.popErrorScope();
    if (error) throw new Error(`WebGPU: ${error.message}`);
    await buffer.mapAsync(GPUMapMode.READ);
    const mapped = new Uint16Array(buffer.getMappedRange());
    const data = new Uint16Array(width * height * 4);
    for (let y = 0; y < height; y++) {
      data.set(mapped.subarray((y * row) / 2, (y * row) / 2 + width * 4), y * width * 4);
    }
    buffer.destroy();
    targets.forEach((target) => target.destroy());
    return new Pixels(width, height, data);
  }

  #target(format, width, height) {
    const usage = GPUTextureUsage.STORAGE_BINDING | GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC;
    return this.#device.createTexture({ size: [width, height], format, usage });
  }

  /** Pipeline and layout of a shader, made once. */
  #pipeline(manifest, wgsl) {
    const known = this.#pipelines.get(wgsl);
    if (known) return known;
    const device = this.#device;
    const compute = manifest.stage === "compute";
    const visibility = compute ? GPUShaderStage.COMPUTE : GPUShaderStage.FRAGMENT;
    const entries = manifest.bindings.map((b) => ({ binding: b.binding, visibility, ...kind(b) }));
    for (const output of [manifest.output].flat()) {
      if (output.binding === undefined) continue;
      const storageTexture = { access: output.access, format: output.format, viewDimension: output.view_dimension };
      entries.push({ binding: output.binding, visibility, storageTexture });
    }
    const bound = device.createBindGroupLayout({ entries });
    const layout = device.createPipelineLayout({ bindGroupLayouts: [bound] });
    const module = device.createShaderModule({ code: wgsl });
    const stage = { module, entryPoint: manifest.entry_point };
    const targets = [manifest.output].flat().map((output) => ({ format: output.format }));
    const vertex = () => ({ module: device.createShaderModule({ code: TRIANGLE }) });
    const pipeline = compute
      ? device.createComputePipeline({ layout, compute: stage })
      : device.createRenderPipeline({ layout, vertex: vertex(), fragment: { ...stage, targets } });
    const made = { pipeline, layout: bound };
    if (this.#pipelines.size > 50) this.#pipelines.clear();
    this.#pipelines.set(wgsl, made);
    return made;
  }

  /** Textures of a kernel's inputs by name, uploaded once. */
  #upload(inputs) {
    const known = this.#textures.get(inputs);
    if (known) return known;
    const textures = new Map();
    for (const { name, width, height, layers, format, offset, length } of inputs.textures) {
      const size = [width, height, layers];
      const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
      const texture = this.#device.createTexture({ size, format, usage });
      const bytes = inputs.bytes.subarray(offset, offset + length);
      const layout = { bytesPerRow: length / layers / height, rowsPerImage: height };
      this.#device.queue.writeTexture({ texture }, bytes, layout, size);
      textures.set(name, texture);
    }
    this.#textures.set(inputs, textures);
    return textures;
  }

  #resource(binding, textures, uniforms) {
    const device = this.#device;
    switch (binding.type) {
      case "texture":
        return textures.get(binding.name).createView({ dimension: binding.view_dimension });
      case "sampler":
        return device.createSampler({ magFilter: "linear", minFilter: "linear", mipmapFilter: "linear" });
      case "uniform": {
        const bytes = uniformBytes(binding, uniforms);
        const buffer = device.createBuffer({
          size: bytes.byteLength,
          usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST,
        });
        device.queue.writeBuffer(buffer, 0, bytes);
        return { buffer };
      }
      default:
        throw new Error(`the page has nothing to bind as \`${binding.name}\``);
    }
  }
}

/** What a binding is, in WebGPU's words, which are the manifest's. */
function kind(binding) {
  switch (binding.type) {
    case "texture":
      return {
        texture: {
          sampleType: binding.sample_type,
          viewDimension: binding.view_dimension,
          multisampled: binding.multisampled,
        },
      };
    case "sampler":
      return { sampler: { type: binding.sampler_type } };
    default:
      return { buffer: { type: binding.buffer_type } };
  }
}
