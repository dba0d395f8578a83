// What the page shows, in its address: a link to it shows the same. Pictures and edited texts are not part of it.

const FORM = { unroll: "full", branches: "as-loops", stage: "compute", block: "1x1", transport: "" };

/** The form of a kernel that is not changed. */
export const plainForm = (entry) => ({ ...FORM, unroll: entry?.unroll ?? "full" });

/** Kernel, options, form, further knobs and left side that an address names. */
export function read(hash, known, declared) {
  const all = new URLSearchParams(hash.slice(1));
  const entry = known.find((entry) => entry.id === all.get("kernel")) ?? known[0];
  const form = plainForm(entry);
  const options = {};
  const knobs = {};
  for (const [name, value] of all) {
    if (name in form) form[name] = value;
    else if (name.startsWith("set-")) options[name.slice(4)] = value;
    else if (declared.some((knob) => knob.name === name)) knobs[name] = value;
  }
  return { entry, form, options, knobs, left: all.get("left") };
}

/** The address of what is shown. */
export function write({ entry, form, options, knobs, left }) {
  const all = new URLSearchParams({ kernel: entry.id });
  const plain = plainForm(entry);
  for (const [name, value] of Object.entries(form)) if (value !== plain[name]) all.set(name, value);
  for (const [name, value] of Object.entries(options)) all.set(`set-${name}`, value);
  for (const [name, value] of Object.entries(knobs)) all.set(name, value);
  if (left !== "picture" && left !== "pinned") all.set("left", left);
  return `#${all}`;
}
