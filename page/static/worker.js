// The generator's own thread: answers one request after the other, so that the page never waits for it.
//
// A message is four bytes of length (little endian), as much JSON, then bytes; page/abi has the other side.

/** What can be called: the generator, and what renders folders for engines, which is loaded when it is first called. */
const URLS = {
  generator: new URL("./straightline.wasm", import.meta.url),
  templates: new URL("./templates.wasm", import.meta.url),
};
const modules = {};
const instances = {};

/** Compiles a module once. A host that gives it another type than application/wasm is no obstacle. */
async function load(url) {
  const response = await fetch(url);
  if (!response.ok) {
    throw new Error(`${url} is not there (${response.status}): build the page again`);
  }
  const streams = response.headers.get("content-type") === "application/wasm";
  return streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/** A module, once it is there. One that could not be loaded is tried again. */
function loaded(name) {
  modules[name] ??= load(URLS[name]).catch((error) => {
    delete modules[name];
    throw error;
  });
  return modules[name];
}

/** Answers one message by a module of its own state. What stops it (a full stack, say) costs that state. */
function call(name, module, message) {
  instances[name] ??= new WebAssembly.Instance(module, {});
  const { memory, request, call: answer, answered } = instances[name].exports;
  try {
    const at = request(message.length) >>> 0;
    new Uint8Array(memory.buffer, at, message.length).set(message);
    const length = answer() >>> 0;
    return new Uint8Array(memory.buffer, answered() >>> 0, length).slice();
  } catch (error) {
    delete instances[name];
    throw error;
  }
}

loaded("generator").catch(() => {});

self.onmessage = async ({ data: { id, name, message } }) => {
  try {
    const module = await loaded(name);
    const start = performance.now();
    const answer = call(name, module, message);
    self.postMessage({ id, answer, milliseconds: performance.now() - start }, [answer.buffer]);
  } catch (error) {
    const deep = error instanceof RangeError || /call stack|out of bounds/i.test(error.message);
    self.postMessage({ id, stopped: deep ? "it is nested too deep for a browser's stack" : String(error.message) });
  }
};
