// The generator's own thread: answers one request after the other, so that the page never waits for it.
//
// A message is four bytes of length (little endian), as much JSON, then bytes; page/module/src/message.rs has the other side.

let module = null;
let instance = null;

/** Compiles the module once. A host that gives it another type than application/wasm is no obstacle. */
async function load(url) {
  const response = await fetch(url);
  if (!response.ok) {
    throw new Error(`${url} is not there (${response.status}): build the page again`);
  }
  const streams = response.headers.get("content-type") === "application/wasm";
  module = streams
    ? await WebAssembly.compileStreaming(response)
    : await WebAssembly.compile(await response.arrayBuffer());
}

/** Answers one message by a module of its own state. What stops it (a full stack, say) costs that state. */
function call(message) {
  instance ??= new WebAssembly.Instance(module, {});
  const { memory, request, call: answer, answered } = instance.exports;
  try {
    const at = request(message.length) >>> 0;
    new Uint8Array(memory.buffer, at, message.length).set(message);
    const length = answer() >>> 0;
    return new Uint8Array(memory.buffer, answered() >>> 0, length).slice();
  } catch (error) {
    instance = null;
    throw error;
  }
}

const ready = load(new URL("./straightline.wasm", import.meta.url));

self.onmessage = async ({ data: { id, message } }) => {
  try {
    await ready;
    const start = performance.now();
    const answer = call(message);
    self.postMessage({ id, answer, milliseconds: performance.now() - start }, [answer.buffer]);
  } catch (error) {
    const deep = error instanceof RangeError || /call stack|out of bounds/i.test(error.message);
    self.postMessage({ id, stopped: deep ? "it is nested too deep for a browser's stack" : String(error.message) });
  }
};
