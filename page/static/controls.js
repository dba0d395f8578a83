// Controls of options, of numbers that are set at run time, and of the form.

/** An element with properties and children. */
export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

let ids = 0;

/** A row: a label, a control, and what it is about. */
function row(name, docs, ...controls) {
  const id = `control-${ids++}`;
  controls[0].id = id;
  controls[0].dataset.name = name;
  const label = element("label", { htmlFor: id, textContent: name.replaceAll("_", " ").replaceAll("-", " ") });
  const made = element("div", { className: "row" }, label, element("div", { className: "control" }, ...controls));
  if (docs) {
    made.append(element("p", { className: "docs", textContent: docs, id: `${id}-docs` }));
    controls[0].setAttribute("aria-describedby", `${id}-docs`);
  }
  return made;
}

function select(values, value, changed) {
  const made = element("select", { autocomplete: "off" });
  for (const { value, label, docs } of values) made.append(element("option", { value, textContent: label ?? value, title: docs ?? "" }));
  made.value = value;
  made.addEventListener("change", () => changed(made.value));
  return made;
}

/** The range that a slider offers of one that may be far wider: around what the number is at first. */
export function range({ min, max, integer }, value) {
  const low = min ?? (value < 0 ? 4 * value : 0);
  const wide = Math.max(4 * Math.abs(value), integer ? 4 : 1);
  const high = max === null || max === undefined || max > low + 20 * wide ? low + wide : max;
  return { low, high, step: integer ? 1 : nice((high - low) / 200) };
}

/** The power of ten, or twice or five times one, next below a number. */
function nice(number) {
  const power = 10 ** Math.floor(Math.log10(number));
  const first = number / power;
  return power * (first >= 5 ? 5 : first >= 2 ? 2 : 1);
}

/** A slider and a box for one number: `changed` is called with it while it moves. */
function number(name, about, value, changed) {
  const { low, high, step } = range(about, about.first ?? value);
  const slider = element("input", { type: "range", min: low, max: high, step, value });
  const box = element("input", { type: "number", step: about.integer ? 1 : "any", value, ariaLabel: `${name}, as a number` });
  if (about.min !== null && about.min !== undefined) box.min = about.min;
  if (about.max !== null && about.max !== undefined) box.max = about.max;
  slider.addEventListener("input", () => {
    box.value = String(Number(Number(slider.value).toPrecision(7)));
    changed(Number(box.value));
  });
  box.addEventListener("change", () => {
    if (box.value === "" || !box.checkValidity()) return box.reportValidity();
    slider.value = box.value;
    changed(Number(box.value));
  });
  return [slider, box];
}

/** Whether an option means something now: those whose text begins with `Of pattern=listed:` do where that is so. */
function applies(option, options, values) {
  const of = /^Of ([\w-]+)=([\w-]+)[:;,]/.exec(option.docs);
  const other = of && options.find(({ name }) => name === of[1]);
  return !other || (values[other.name] ?? other.default) === of[2] || values[option.name] !== undefined;
}

/** The options that mean something now. */
export const visible = (options, values) => options.filter((option) => applies(option, options, values));

/** Fills `place` with a control for each option. `set(name, value)` is called with its text, or null for the default. */
export function showOptions(place, options, values, set) {
  const rows = visible(options, values).map((option) => {
    const value = values[option.name] ?? option.default;
    const choose = (chosen) => set(option.name, String(chosen) === option.default && !option.uniform ? null : String(chosen));
    switch (option.kind) {
      case "choice":
        return row(option.name, option.docs, select(option.values.map((v) => ({ ...v, label: v.value })), value, choose));
      case "flag": {
        const box = element("input", { type: "checkbox", checked: value === "true" });
        box.addEventListener("change", () => choose(box.checked));
        return row(option.name, option.docs, box);
      }
      case "list": {
        const box = element("input", { type: "text", value, placeholder: "numbers, separated by commas", spellcheck: false });
        box.addEventListener("change", () => choose(box.value.replaceAll(" ", "")));
        return row(option.name, option.docs, box);
      }
      default: {
        const live = value === "uniform" || (option.uniform && values[option.name] === undefined);
        const shown = live ? Number(option.default) : Number(value);
        const controls = live ? [element("output", { textContent: "at run time" })] : number(option.name, { ...option, first: Number(option.default) }, shown, choose);
        const box = element("input", { type: "checkbox", checked: live });
        box.addEventListener("change", () => {
          if (box.checked) set(option.name, option.uniform ? null : "uniform");
          else set(option.name, option.uniform ? option.default : null);
        });
        const toggle = element("label", { className: "toggle", title: "Leave it to run time: a uniform of the shader" }, box, "live");
        return row(option.name, option.docs, ...controls, toggle);
      }
    }
  });
  place.replaceChildren(...rows);
}

/** Fills `place` with a control for each uniform: `{ name, letter, count, value, min, max, docs }`. */
export function showUniforms(place, uniforms, set) {
  const rows = uniforms.map(({ name, letter, count, value, min, max, docs }) => {
    const about = { min, max, integer: letter !== "f" };
    const numbers = [...value];
    const lanes = Array.from({ length: count }, (_, lane) => {
      const named = count === 1 ? name : `${name}.${"xyzw"[lane]}`;
      return number(named, about, numbers[lane] ?? 0, (given) => {
        numbers[lane] = given;
        set(name, [...numbers]);
      });
    });
    return row(name, docs, ...lanes.flat());
  });
  place.replaceChildren(...rows);
}

const UNROLL = [
  { value: "full", docs: "All iterations are run when the shader is made: straight-line code" },
  { value: "none", label: "none (looped)", docs: "Loops stay in the shader" },
  { value: "2", label: "by 2", docs: "Loops stay, 2 iterations in a row" },
  { value: "4", label: "by 4", docs: "Loops stay, 4 iterations in a row" },
  { value: "8", label: "by 8", docs: "Loops stay, 8 iterations in a row" },
];
const BRANCHES = [
  { value: "as-loops", label: "as loops", docs: "Left as branches where loops are left in the shader" },
  { value: "keep", docs: "An if on runtime values stays an if" },
  { value: "select", docs: "Both sides are computed, and one is chosen" },
];
const BLOCKS = ["1x1", "2x1", "2x2", "4x2"].map((value) => ({ value, label: value.replace("x", " × ") }));
const TRANSPORTS = [
  { value: "", label: "by the stage" },
  { value: "subgroup", label: "subgroup operations" },
  { value: "derivatives", label: "derivatives" },
  { value: "block", label: "none: one invocation a quad" },
];

/** Fills `place` with the controls of the form. `quad` says whether the kernel is one of pixel quads. */
export function showForm(place, form, quad, set) {
  const chosen = (name) => (value) => set(name, value);
  place.replaceChildren(
    row("unroll", null, select(UNROLL, form.unroll, chosen("unroll"))),
    row("branches", null, select(BRANCHES, form.branches, chosen("branches"))),
    row("stage", null, select([{ value: "compute" }, { value: "fragment" }], form.stage, chosen("stage"))),
    quad
      ? row("transport", null, select(TRANSPORTS, form.transport, chosen("transport")))
      : row("block", null, select(BLOCKS, form.block, chosen("block"))),
  );
}

/** Fills `place` with a control for each declared knob; `set` is called with null where one is left at its default. */
export function showKnobs(place, declared, values, set) {
  const rows = declared.map(({ name, value, initial, help }) => {
    const changed = (text) => set(name, text === initial ? null : text);
    const now = values[name] ?? initial;
    if (initial === "false") return row(name, help, select([{ value: "false", label: "no" }, { value: "true", label: "yes" }], now, changed));
    const box = element("input", { type: "text", value: now, placeholder: value, autocomplete: "off", spellcheck: false });
    box.addEventListener("change", () => changed(box.value.trim()));
    return row(name, help, box);
  });
  place.replaceChildren(...rows);
}
