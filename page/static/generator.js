// The generator, as the rest of the page calls it.

/** Why the generator made nothing: `errors` one by one, `message` as a terminal would have it. */
export class Refused extends Error {
  constructor(refusal) {
    super(refusal.text);
    this.errors = refusal.errors;
  }
}

/** Longest time that a text may take, in milliseconds: after that the generator is started anew. */
const PATIENCE = 60_000;

export class Generator {
  #worker = null;
  #waiting = new Map();
  #next = 0;
  #picture = null;

  constructor() {
    this.#start();
  }

  #start() {
    this.#worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
    this.#worker.onmessage = ({ data }) => this.#settle(data);
    this.#worker.onerror = (event) => {
      for (const id of [...this.#waiting.keys()]) {
        this.#settle({ id, stopped: event.message || "its thread could not be started" });
      }
    };
  }

  #settle({ id, answer, milliseconds, stopped }) {
    const waiting = this.#waiting.get(id);
    if (!waiting) return;
    this.#waiting.delete(id);
    clearTimeout(waiting.timer);
    if (stopped !== undefined) {
      waiting.reject(new Refused(refusal(`the generator stopped: ${stopped}`)));
      // The picture was part of what it remembered.
      if (this.#picture) this.#send({ do: "picture", ...this.#picture.size }, this.#picture.bytes).catch(() => {});
      return;
    }
    const length = new DataView(answer.buffer).getUint32(0, true);
    const json = JSON.parse(new TextDecoder().decode(answer.subarray(4, 4 + length)));
    if ("ok" in json) {
      // From a place of its own, so that floats are aligned.
      waiting.resolve({ json: json.ok, bytes: answer.slice(4 + length), milliseconds });
    } else {
      waiting.reject(new Refused(json.refused));
    }
  }

  #send(request, bytes, name = "generator") {
    const json = new TextEncoder().encode(JSON.stringify(request));
    const message = new Uint8Array(4 + json.length + (bytes?.length ?? 0));
    new DataView(message.buffer).setUint32(0, json.length, true);
    message.set(json, 4);
    if (bytes) message.set(bytes, 4 + json.length);
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => this.#giveUp(), PATIENCE);
      this.#waiting.set(id, { resolve, reject, timer });
      this.#worker.postMessage({ id, name, message }, [message.buffer]);
    });
  }

  /** Ends a generator that does not answer, and starts another. */
  #giveUp() {
    this.#worker.terminate();
    const all = [...this.#waiting.keys()];
    this.#start();
    for (const id of all) this.#settle({ id, stopped: `it took longer than ${PATIENCE / 1000} seconds` });
  }

  /** Asks; gives `{ json, bytes, milliseconds }`, or throws `Refused`. */
  ask(request, bytes) {
    return this.#send(request, bytes);
  }

  /** The files of a kernel for an engine, by name. What renders them is loaded the first time. */
  async folder(engine, asked) {
    const { json: context } = await this.ask({ do: "engine", engine, ...asked });
    return (await this.#send({ engine, context }, undefined, "templates")).json;
  }

  /** The visitor's picture: `{ width, height }` and bytes of sRGB and alpha; without one, the built-in scene again. */
  async setPicture(size, bytes) {
    this.#picture = size ? { size, bytes: bytes.slice() } : null;
    await this.#send({ do: "picture", ...(size ?? { width: 0, height: 0 }) }, bytes);
  }
}

/** A reason that is in no file, in the generator's form. */
export function refusal(message) {
  return { text: `error: ${message}`, errors: [{ message, label: "", place: null, others: [], notes: [], help: null }] };
}
