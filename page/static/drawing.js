// From a kernel in one form to its picture: what is compiled, what it reads, what draws it.

import { refusal, Refused } from "./generator.js";
import { Pixels, components } from "./pixels.js";
import { WebGl2 } from "./webgl2.js";
import { WebGpu } from "./webgpu.js";

/** Texels of a shader's result. */
const FORMAT = "rgba16float";

/** Forms of which what was compiled and read is kept. */
const KEPT = 6;

/** The interpreter, as an executor: it runs anything, slowly. */
class Interpreter {
  name = "CPU";
  stages = ["compute"];
  #generator;

  constructor(generator) {
    this.#generator = generator;
  }

  refuses() {
    return null;
  }

  async draw(_, inputs, uniforms, size) {
    const { json, bytes } = await this.#generator.ask({ do: "interpret", ...inputs.asked, size, uniforms });
    return new Pixels(json.width, json.height, new Float32Array(bytes.buffer));
  }
}

/** What can draw here, the best first. `only` names one, for comparing them. */
export async function executors(generator, only) {
  const made = [];
  for (const Executor of [WebGpu, WebGl2]) {
    // A driver that fails to start is one that is not there.
    const executor = await Executor.create().catch(() => null);
    if (executor) made.push(executor);
  }
  made.push(new Interpreter(generator));
  const chosen = made.filter((executor) => executor.name.toLowerCase() === only?.toLowerCase());
  return chosen.length ? [...chosen, made.at(-1)] : made;
}

export class Drawing {
  #generator;
  #executors = [];
  #plain = new Map();
  #compiled = new Map();
  #inputs = new Map();
  #references = new Map();

  /** Called when an executor is gone, and another has taken over. */
  lost = () => {};

  /** `executors` is a promise: a driver takes as long to start as the generator. */
  constructor(generator, executors) {
    this.#generator = generator;
    this.ready = executors.then((executors) => {
      this.#executors = executors;
      this.#watch();
    });
  }

  /** What draws first. */
  get executor() {
    return this.#executors[0];
  }

  /** Another executor takes over when one is lost. */
  #watch() {
    const first = this.executor;
    first.lost?.().then(() => {
      this.#executors = this.#executors.filter((executor) => executor !== first);
      this.#inputs.clear();
      this.#watch();
      this.lost();
    });
  }

  /** Forgets what was read from the picture. */
  forget() {
    this.#inputs.clear();
    this.#references.clear();
  }

  /** Asks once for the same. */
  async #once(known, key, make) {
    if (!known.has(key)) {
      if (known.size >= KEPT) known.delete(known.keys().next().value);
      known.set(key, make());
      // What has failed may be tried again.
      known.get(key).catch(() => known.delete(key));
    }
    return known.get(key);
  }

  /** Begins what needs no executor. */
  begin({ asked }, size) {
    for (const begun of [this.#compile(asked), this.inputs(asked, size)]) begun.catch(() => {});
  }

  #compile(asked) {
    return this.#once(this.#plain, JSON.stringify(asked), () => this.#generator.ask({ do: "compile", ...asked }));
  }

  /** Options, counts and the shader of a form that the executor runs, and how long that took. Throws `Refused`. */
  async compile({ asked, stage }) {
    const plain = this.#compile(asked);
    await Promise.all([plain, this.ready]);
    const executor = this.executor;
    const first = executor.stages.includes(stage) ? stage : executor.stages[0];
    const target = executor.name === "WebGL2" ? "essl300" : "wgsl";
    const shaders = [{ stage: first, format: FORMAT, target: [target] }];
    // Where the stage cannot be had, counts and manifest are still those of compute.
    if (first === "fragment") shaders.push({ stage: "compute", format: FORMAT, target: [] });
    return this.#once(this.#compiled, JSON.stringify([asked, stage, executor.name]), async () => {
      const { json, milliseconds } = await this.#generator.ask({ do: "compile", ...asked, shaders });
      const [shader, other] = json.shaders;
      const all = milliseconds + (await plain).milliseconds;
      return { ...json, shader, manifest: shader.manifest ?? other?.manifest, milliseconds: all };
    });
  }

  /** One language's text of a form with its source map, or why there is none. */
  async text({ asked, stage }, target) {
    const shaders = [{ stage, format: FORMAT, target: [target], debug: "map" }];
    const { json } = await this.#generator.ask({ do: "compile", ...asked, shaders });
    const { texts, refused, manifest, source_map } = json.shaders[0];
    return { text: texts[target], refused: refused[target], manifest, stage, map: source_map };
  }

  /** The numbers that a form takes at run time: those of the visitor, of the scene, of the kernel. */
  uniforms(manifest, inputs, ranges, given) {
    const all = [];
    for (const block of manifest.bindings.filter((binding) => binding.type === "uniform")) {
      for (const field of block.fields) {
        const { letter, count } = components(field.type) ?? { letter: "f", count: 1 };
        const range = ranges.find((range) => range.name === field.name);
        const scene = range ? undefined : inputs?.uniforms[field.name];
        const first = range?.value ?? scene ?? Array(count).fill(field.default ?? 1);
        const value = given[field.name]?.length === count ? given[field.name] : first;
        all.push({ name: field.name, letter, count, value, of: scene ? "scene" : "visitor", range });
      }
    }
    return all;
  }

  /** What a form reads. Throws `Refused` where the page cannot fill a texture. */
  inputs(asked, size) {
    return this.#once(this.#inputs, JSON.stringify([asked, size]), async () => {
      const { json, bytes } = await this.#generator.ask({ do: "inputs", ...asked, size });
      return { ...json, bytes, asked };
    });
  }

  /** The picture without a filter; of the scene, with so many samples a pixel. */
  reference(samples, scene) {
    return this.#once(this.#references, `${samples} ${scene}`, async () => {
      const { json, bytes } = await this.#generator.ask({ do: "reference", samples, scene });
      return new Pixels(json.width, json.height, new Float32Array(bytes.buffer));
    });
  }

  /** Draws a form; gives its `Pixels`, and by what they were drawn and why not by another. */
  async draw(form, compiled, inputs, uniforms, size) {
    const values = Object.fromEntries(uniforms.map(({ name, value }) => [name, value]));
    let why = null;
    for (const executor of this.#executors) {
      const usable = executor === this.executor || executor instanceof Interpreter;
      if (!usable) continue;
      const gpu = !(executor instanceof Interpreter);
      const shader = compiled.shader;
      const reason = gpu ? (shader.manifest ? executor.refuses(shader) : Object.values(shader.refused)[0]) : null;
      if (reason) {
        why ??= reason;
        continue;
      }
      const start = performance.now();
      try {
        const pixels = await executor.draw(shader, inputs, values, size);
        return { pixels, by: executor.name, milliseconds: performance.now() - start, why };
      } catch (error) {
        if (!gpu || error instanceof Refused) throw error;
        why ??= error.message;
      }
    }
    throw new Refused(refusal(why ?? "nothing here can draw it"));
  }
}
