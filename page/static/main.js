// The page: what is chosen, and everything that follows from it.

import { Code, stageOf } from "./code.js";
import { element, showForm, showKnobs, showOptions, showUniforms, visible } from "./controls.js";
import { showCounts, showLoops } from "./counts.js";
import { Drawing, executors } from "./drawing.js";
import { Generator, Refused, refusal } from "./generator.js";
import * as link from "./link.js";
import { listen } from "./picture.js";
import { showThemes } from "./theme.js";
import { View } from "./view.js";

const find = (id) => document.getElementById(id);
const parameters = new URLSearchParams(location.search);

showThemes(find("theme"));
const generator = new Generator();
const view = new View(find("picture"), find("canvas"));
const drawing = new Drawing(generator, executors(generator, parameters.get("executor")));
const { json: catalogue } = await generator.ask({ do: "catalogue" }).catch((error) => {
  find("status").textContent = error.message;
  throw error;
});
const kernels = catalogue.kernels;

/** What is chosen. */
const state = {
  ...link.read(location.hash, kernels, catalogue.knobs),
  uniforms: {},
  /** The kernel's files, and as they were. */
  files: [],
  original: [],
  edited: false,
  /** Size of the visitor's picture. */
  picture: null,
  /** The form that was pinned to the left, with its picture. */
  pinned: null,
};
state.left ??= "picture";
const shown = { left: null, right: null, manifest: null, by: null };

/** The form on the right, as the generator takes it. */
function form(change = {}) {
  const { entry, options, form, knobs } = state;
  const kernel = { id: entry.id };
  if (state.edited) Object.assign(kernel, { function: entry.name, files: state.files });
  const { unroll, branches, block, transport } = form;
  const shader = { set: options, unroll, branches, block, ...(transport && { transport }), ...texts(knobs), ...change };
  return { asked: { kernel, shader }, stage: form.stage, entry };
}

/** Further knobs as the generator takes them: of one that takes several values a list. */
function texts(knobs) {
  const many = ({ name }) => catalogue.knobs.find((knob) => knob.name === name).many;
  return Object.fromEntries(
    Object.entries(knobs).map(([name, text]) => [name, many({ name }) ? text.split(/\s+/).filter(Boolean) : text]),
  );
}

/** The form of another kernel, as it comes. */
function plainForm(entry) {
  return { asked: { kernel: { id: entry.id }, shader: { unroll: entry.unroll } }, stage: state.form.stage, entry };
}

/** Size of a form's result: of the visitor's picture, or of the scene. */
function sizeOf(made, picture = state.picture) {
  const base = picture ? [picture.width, picture.height] : catalogue.size;
  return base.map((n) => n * made.entry.scale);
}

/** Compiles, reads and draws a form; gives all of it. */
async function drawn(made, given) {
  const compiled = await drawing.compile(made);
  let size = sizeOf(made);
  let inputs = await drawing.inputs(made.asked, size);
  if (inputs.geometry && state.picture) {
    size = sizeOf(made, null);
    inputs = await drawing.inputs(made.asked, size);
  }
  const uniforms = drawing.uniforms(compiled.manifest, inputs, made.entry.uniforms, given);
  return { compiled, inputs, uniforms, ...(await drawing.draw(made, compiled, inputs, uniforms, size)) };
}

/** What the left side shows: pixels, their name, counts and number of pixels where it is a form. */
async function leftSide(right) {
  const sides = {
    none: () => null,
    picture: async () =>
      right.inputs.picture ? { pixels: await drawing.reference(1, right.inputs.geometry), name: "not filtered" } : null,
    supersampled: async () => ({ pixels: await drawing.reference(64, true), name: "64 samples a pixel" }),
    looped: () => formed(form({ unroll: "none" }), "looped", state.uniforms),
    defaults: () => formed(form({ set: {} }), "default options", {}),
    pinned: () => state.pinned,
  };
  const other = kernels.find((entry) => `kernel:${entry.id}` === state.left);
  if (other) return formed(plainForm(other), other.name.replaceAll("_", " "), {});
  return (sides[state.left] ?? sides.picture)();
}

/** The last form that stood on the left, which need not be drawn again while only the right one changes. */
let last = { key: "", side: null };

async function formed(made, name, uniforms) {
  const key = JSON.stringify([made, uniforms, state.picture, drawing.executor.name]);
  if (key !== last.key) {
    const { pixels, compiled } = await drawn(made, uniforms);
    last = { key, side: { pixels, name, counts: compiled.manifest.counts } };
  }
  return last.side;
}

let busy = false;
let again = false;

/** Shows what is chosen, and once more if that has changed meanwhile. */
async function update() {
  again = true;
  if (busy) return;
  busy = true;
  document.body.dataset.busy = "";
  while (again) {
    again = false;
    await once();
  }
  busy = false;
  delete document.body.dataset.busy;
}

async function once() {
  const made = form();
  let compiled = null;
  // Also where a value that an address names is none: this is the way back.
  find("reset").hidden = Object.keys(state.options).length === 0;
  try {
    drawing.begin(made, sizeOf(made));
    compiled = await drawing.compile(made);
    shown.manifest = compiled.manifest;
    code.showErrors([]);
    await code.update();
    const right = await drawn(made, state.uniforms);
    showAbout(compiled, right);
    const left = await leftSide(right).catch((error) => ({ pixels: null, name: "", failed: error }));
    await view.show(left?.pixels ?? null, right.pixels);
    Object.assign(shown, { left: left?.pixels ?? null, right: right.pixels, by: right.by });
    const name = formName();
    find("left-name").textContent = left?.pixels ? left.name : "";
    find("right-name").textContent = name;
    showFigures(compiled, left?.counts ? left : null);
    find("overlay").hidden = true;
    const about = right.why ? ` ${right.why}` : "";
    find("status").textContent = left?.failed
      ? `The left side: ${left.failed.errors?.[0]?.message ?? left.failed.message}`
      : `${size(right.pixels)}, compiled in ${time(compiled.milliseconds)}, drawn in ${time(right.milliseconds)} by ${by(right.by)}.${about}`;
    document.body.dataset.drawn ??= String(Math.round(performance.now()));
  } catch (error) {
    await showFailure(error, compiled);
  }
  // Browsers allow only so many changes of the address in a while.
  clearTimeout(written);
  written = setTimeout(() => history.replaceState(null, "", link.write(state)), 200);
}
let written = 0;
addEventListener("hashchange", () => location.reload());

/** The counts of the form on the right, and of that on the left if it is one. */
function showFigures(compiled, left) {
  const { counts, block } = compiled.manifest;
  showCounts(find("counts"), { name: formName(), counts, block: block ?? [1, 1] }, left, block ? null : compiled.paper);
  showLoops(find("loops"), compiled.loops);
}

const size = ({ width, height }) => `${width} × ${height}`;
const time = (milliseconds) => `${milliseconds < 10 ? milliseconds.toFixed(1) : Math.round(milliseconds)} ms`;
const by = (name) => (name === "CPU" ? "the interpreter" : name);

/** A name for the form on the right. */
function formName() {
  const unroll = { full: "unrolled", none: "looped" }[state.form.unroll] ?? `${state.form.unroll} in a row`;
  return `${state.entry.name.replaceAll("_", " ")}, ${unroll}${state.edited ? ", edited" : ""}`;
}

/** What went wrong: errors of the kernel below its text, all else over the picture, which stays. */
async function showFailure(error, compiled) {
  if (!(error instanceof Refused)) console.error(error);
  const errors = error instanceof Refused ? error.errors : refusal(error.message).errors;
  // What keeps a kernel that compiles from being drawn is no error of its text.
  code.showErrors(compiled ? [] : errors);
  await code.update().catch(() => {});
  const overlay = find("overlay");
  overlay.hidden = false;
  overlay.textContent = compiled ? `Not drawn: ${errors[0].message}.` : "Does not compile: the errors stand below the text.";
  find("status").textContent = errors.length === 1 ? errors[0].message : `${errors.length} errors`;
  if (!compiled) return;
  showAbout(compiled, null);
  await view.show(null, null);
  showFigures(compiled, null);
}

/** Controls are made anew only when there are others. */
let controlled = "";

function showAbout(compiled, right) {
  const live = compiled.manifest.bindings.filter((b) => b.type === "uniform").flatMap((b) => b.fields.map((f) => f.name));
  const names = visible(compiled.options, state.options).map(({ name }) => [name, state.options[name] === "uniform"]);
  const key = JSON.stringify([state.entry.id, compiled.options, names, live, state.form, state.knobs, compiled.quad, !right]);
  if (key === controlled) return;
  controlled = key;
  const focused = document.activeElement?.dataset?.name;
  find("summary").textContent = state.entry.summary;
  const { options } = compiled;
  find("option-section").hidden = options.length === 0;
  showOptions(find("options"), options, state.options, (name, value) => {
    if (value === null) delete state.options[name];
    else state.options[name] = value;
    update();
  });
  showForm(find("form-controls"), state.form, compiled.quad, (name, value) => {
    state.form[name] = value;
    update();
  });
  showKnobs(find("knobs"), catalogue.knobs, state.knobs, (name, value) => {
    if (value === null) delete state.knobs[name];
    else state.knobs[name] = value;
    update();
  });
  const uniforms = drawing.uniforms(compiled.manifest, right?.inputs, state.entry.uniforms, state.uniforms);
  const own = uniforms.filter(({ of }) => of === "visitor").map((uniform) => {
    const option = options.find(({ name }) => name.replaceAll("-", "_") === uniform.name);
    return { ...uniform, min: uniform.range?.min ?? option?.min, max: uniform.range?.max ?? option?.max, docs: option?.docs };
  });
  find("uniform-section").hidden = own.length === 0;
  showUniforms(find("uniforms"), own, (name, value) => {
    state.uniforms[name] = value;
    update();
  });
  if (focused) document.querySelector(`[data-name="${CSS.escape(focused)}"]`)?.focus();
}

/** The sides that can stand on the left. */
function showSides() {
  const sides = [
    ["picture", "not filtered"],
    ["looped", "this kernel, looped"],
    ["defaults", "this kernel, default options"],
    ["supersampled", "the scene, 64 samples a pixel"],
    ["none", "nothing"],
  ];
  if (state.pinned) sides.push(["pinned", `pinned: ${state.pinned.name}`]);
  const option = ([value, textContent]) => element("option", { value, textContent });
  const others = kernels.map((entry) => option([`kernel:${entry.id}`, title(entry)]));
  find("left").replaceChildren(...sides.map(option), element("optgroup", { label: "Another kernel" }, ...others));
  find("left").value = state.left;
}

/** A kernel's name in lists; of two of one name, with the folder. */
function title(entry) {
  const name = entry.name.replaceAll("_", " ");
  const several = kernels.filter((other) => other.name === entry.name).length > 1;
  return several && entry.example ? `${name} (${entry.id.split("/")[0]})` : name;
}

async function choose(entry) {
  state.entry = entry;
  const { json } = await generator.ask({ do: "source", kernel: { id: entry.id } });
  state.original = json.files;
  state.files = json.files.map((file) => ({ ...file }));
  state.edited = false;
  code.reset();
}

let pause = 0;
const code = new Code({
  files: () => state.files,
  edit(index, text) {
    state.files[index].text = text;
    state.edited = state.files.some((file, k) => file.text !== state.original[k].text);
    find("restore").hidden = !state.edited;
    clearTimeout(pause);
    pause = setTimeout(update, 250);
  },
  restore() {
    state.files = state.original.map((file) => ({ ...file }));
    state.edited = false;
    update();
  },
  isEdited: () => state.edited,
  async text(target) {
    const made = form();
    made.stage = stageOf(target, made.stage);
    return drawing.text(made, target).catch((error) => ({ refused: error.errors?.[0]?.message ?? error.message, stage: made.stage }));
  },
  async engine(name) {
    try {
      return { files: await generator.folder(name, form().asked) };
    } catch (error) {
      return { refused: error.errors?.[0]?.message ?? error.message };
    }
  },
  name: () => state.entry.name,
  command(target) {
    const { entry, options, form, knobs } = state;
    const stage = stageOf(target, form.stage);
    const set = Object.entries(options).map(([name, value]) => ` --set ${name}=${value}`);
    const unroll = form.unroll === "full" ? "" : ` --unroll ${form.unroll}`;
    const branches = form.branches === "as-loops" ? "" : ` --branches ${form.branches}`;
    const block = form.block === "1x1" ? "" : ` --block ${form.block}`;
    const transport = form.transport ? ` --transport ${form.transport}` : "";
    const more = Object.entries(texts(knobs)).flatMap(([name, text]) =>
      [text].flat().map((value) => (value === "true" ? ` --${name}` : ` --${name} ${value}`)),
    );
    // An edited text is to be saved where it came from.
    const [first, ...others] = state.files.map(({ path }) => path);
    const sources = state.edited ? others.map((path) => ` --source ${path}`).join("") : "";
    const file = state.edited ? `${first}::${entry.name}${sources}` : (entry.example ?? entry.id);
    const staged = stage === "compute" ? "" : ` --stage ${stage}`;
    return `straightline emit ${file}${set.join("")}${unroll}${branches}${block}${transport}${more.join("")}${staged} --target ${target} --out shaders/`;
  },
});

code.offer(catalogue.engines);

/** Another picture, or without one the scene again. */
async function setPicture(picture) {
  await generator.setPicture(picture?.size, picture?.bytes);
  state.picture = picture?.size ?? null;
  find("scene").hidden = !state.picture;
  drawing.forget();
  last = { key: "", side: null };
  await update();
  if (picture && state.entry && shown.right && !isShown(picture.size)) {
    find("status").textContent = `${title(state.entry)} reads depths and normals, which a picture does not have: the built-in scene stays. Choose a filter such as kuwahara.`;
  } else if (picture?.reduced) find("status").textContent += " The picture was reduced to 2048 pixels.";
}

const isShown = ({ width, height }) =>
  shown.right.width === width * state.entry.scale && shown.right.height === height * state.entry.scale;

const groups = Map.groupBy ? Map.groupBy(kernels, ({ group }) => group) : grouped();
function grouped() {
  const all = new Map();
  for (const entry of kernels) all.set(entry.group, [...(all.get(entry.group) ?? []), entry]);
  return all;
}
find("kernel").replaceChildren(
  ...[...groups].map(([label, entries]) =>
    element("optgroup", { label }, ...entries.map((entry) => element("option", { value: entry.id, textContent: title(entry) }))),
  ),
);
find("kernel").value = state.entry.id;
find("kernel").addEventListener("change", async ({ target }) => {
  const entry = kernels.find(({ id }) => id === target.value);
  Object.assign(state, { options: {}, uniforms: {}, knobs: {}, form: link.plainForm(entry) });
  await choose(entry);
  update();
});
find("controls").addEventListener("submit", (event) => event.preventDefault());
find("reset").addEventListener("click", () => {
  state.options = {};
  controlled = "";
  update();
});
find("left").addEventListener("change", ({ target }) => {
  state.left = target.value;
  update();
});
find("pin").addEventListener("click", () => {
  if (!shown.right) return;
  state.pinned = { pixels: shown.right, name: `${formName()} (pinned)`, counts: shown.manifest.counts };
  state.left = "pinned";
  showSides();
  update();
});
find("zoom").addEventListener("change", ({ target }) => (view.zoom = target.value));
find("scene").addEventListener("click", () => setPicture(null));
listen(find("file"), setPicture, (message) => (find("status").textContent = message));
showSides();
drawing.begin(form(), sizeOf(form()));
await choose(state.entry);
const showExecutor = () => (find("executor").textContent = drawing.executor.name);
drawing.ready.then(showExecutor);
drawing.lost = () => {
  showExecutor();
  update();
};

/** For the console, and for the tests: what is shown, and what the interpreter makes of it. */
globalThis.straightline = {
  shown,
  state,
  update,
  async reference() {
    const made = form();
    const { compiled, inputs, uniforms, pixels } = await drawn(made, state.uniforms);
    const values = Object.fromEntries(uniforms.map(({ name, value }) => [name, value]));
    const size = [pixels.width, pixels.height];
    const { bytes } = await generator.ask({ do: "interpret", ...made.asked, size, uniforms: values });
    return { drawn: pixels.floats(), interpreted: new Float32Array(bytes.buffer), geometry: inputs.geometry, kernel: compiled.kernel };
  },
};
await update();
