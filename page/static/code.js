// The texts: the kernel's, and the shader's in every language; copy, download, and the same from a shell.

import { archive } from "./archive.js";
import { element } from "./controls.js";
import { Editor } from "./editor.js";

/** Tabs, and the languages of each by the command line's names for them. */
const LANGUAGES = {
  wgsl: { label: "WGSL", targets: ["wgsl"] },
  glsl: { label: "GLSL", targets: ["glsl450", "glsl430", "glsl330", "essl310", "essl300"] },
  hlsl: { label: "HLSL", targets: ["hlsl"] },
  msl: { label: "MSL", targets: ["msl"] },
};

const NAMES = {
  wgsl: "WGSL",
  glsl450: "GLSL 4.50 (Vulkan)",
  glsl430: "GLSL 4.30 (OpenGL)",
  glsl330: "GLSL 3.30 (OpenGL)",
  essl310: "GLSL ES 3.10",
  essl300: "GLSL ES 3.00 (WebGL2)",
  hlsl: "HLSL",
  msl: "MSL",
};

/** Languages without compute shaders. */
const FRAGMENT_ONLY = new Set(["glsl330", "essl300"]);

/** The stage that a language can have. */
export const stageOf = (target, stage) => (FRAGMENT_ONLY.has(target) ? "fragment" : stage);

function extension(target, stage) {
  if (!/gl|ssl/.test(target) || target === "wgsl") return { msl: "metal" }[target] ?? target;
  const version = { glsl430: "430.", glsl330: "330.", essl310: "es310.", essl300: "es300." }[target] ?? "";
  return `${version}${stage === "compute" ? "comp" : "frag"}`;
}

/** Gives a text, or a blob, to the visitor as a file. */
export function save(name, content, type = "text/plain") {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  element("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** Copies a text, and says so on the button. */
export async function copy(text, button) {
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = "Copied";
  } catch {
    button.textContent = "Not allowed here";
  }
  setTimeout(() => (button.textContent = "Copy"), 1500);
}

export class Code {
  #host;
  #editor;
  #find = (id) => document.getElementById(id);
  #tab = "wgsl";
  #glsl = "glsl450";
  #file = 0;
  #shown = { text: "", name: "" };
  #map = null;
  #errors = [];

  /**
   * `host` gives: `files()`, what the kernel's files are now; `edit(index, text)`; `restore()`; `isEdited()`;
   * `text(target)`, a promise of `{ text, refused, manifest, map }`, with its source map; `engine(name)`, one of an engine's files by name or `{ refused }`;
   * `name()`, for files; `command(target)`.
   */
  constructor(host) {
    this.#host = host;
    this.#editor = new Editor(this.#find("panel"), (text) => host.edit(this.#file, text), (line) => this.#showSource(line));
    const tabs = this.#find("tabs");
    for (const [id, label] of [["kernel", "Kernel"], ...Object.entries(LANGUAGES).map(([id, l]) => [id, l.label])]) {
      const tab = element("button", { type: "button", role: "tab", id: `tab-${id}`, textContent: label });
      tab.setAttribute("aria-controls", "panel");
      tab.addEventListener("click", () => this.open(id));
      tabs.append(tab);
    }
    tabs.addEventListener("keydown", (event) => this.#arrow(event));
    this.#find("variant").addEventListener("change", ({ target }) => {
      if (this.#tab === "kernel") this.#file = target.selectedIndex;
      else this.#glsl = target.value;
      this.update();
    });
    this.#find("copy").addEventListener("click", ({ target }) => copy(this.#shown.text, target));
    this.#find("download").addEventListener("click", () => save(this.#shown.name, this.#shown.text));
    this.#find("restore").addEventListener("click", () => host.restore());
    this.#find("copy-command").addEventListener("click", ({ target }) => copy(this.#find("command").textContent, target));
    this.#downloads();
  }

  /** The language that is open, or null of the kernel's own text. */
  get target() {
    return this.#tab === "kernel" ? null : this.#tab === "glsl" ? this.#glsl : this.#tab;
  }

  /** Opens a tab. */
  open(tab) {
    this.#tab = tab;
    return this.update();
  }

  #arrow(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    const tabs = [...this.#find("tabs").children];
    const at = tabs.findIndex((tab) => tab.ariaSelected === "true");
    const next = tabs[(at + step + tabs.length) % tabs.length];
    next.focus();
    next.click();
  }

  /** Another kernel: its first file is shown. */
  reset() {
    this.#file = 0;
  }

  /** Shows what is open as it is now. */
  async update() {
    const tab = this.#tab;
    for (const button of this.#find("tabs").children) {
      const selected = button.id === `tab-${tab}`;
      button.ariaSelected = String(selected);
      button.tabIndex = selected ? 0 : -1;
    }
    this.#find("panel").setAttribute("aria-labelledby", `tab-${tab}`);
    this.#find("source").hidden = true;
    this.#find("restore").hidden = tab !== "kernel" || !this.#host.isEdited();
    this.#find("command").textContent = this.#host.command(this.target ?? "wgsl");
    if (tab === "kernel") this.#showKernel();
    else await this.#showShader(tab);
  }

  #variants(entries, value) {
    const variant = this.#find("variant");
    variant.hidden = entries.length < 2;
    variant.replaceChildren(...entries.map(([value, label]) => element("option", { value, textContent: label })));
    variant.value = value;
  }

  #showKernel() {
    const files = this.#host.files();
    if (!files.length) return;
    this.#file = Math.min(this.#file, files.length - 1);
    const { path, text } = files[this.#file];
    this.#variants(files.map(({ path }, k) => [String(k), path]), String(this.#file));
    this.#shown = { text, name: path.split("/").pop() };
    this.#editor.show(text, { editable: true, label: `Text of the kernel, ${path}` });
    this.#mark();
  }

  /** Shows where a line of the shader comes from. */
  #showSource(line) {
    const statement = this.#map?.texts[this.target]?.find(({ first, last }) => first <= line && line <= last);
    const note = this.#find("source");
    note.hidden = !statement;
    if (!statement) return;
    const path = this.#map.files[statement.file];
    const file = this.#host.files().findIndex((file) => file.path === path);
    const at = `${path.split("/").pop()}:${statement.line}:${statement.column}`;
    const link = element("button", { type: "button", className: "place", textContent: at, disabled: file < 0 });
    link.addEventListener("click", async () => {
      this.#file = file;
      await this.open("kernel");
      const { text } = this.#host.files()[file];
      const before = text.split("\n").slice(0, statement.line - 1);
      const from = before.join("\n").length + (before.length ? 1 : 0) + statement.column - 1;
      const isWhole = text.startsWith(statement.expression, from);
      const end = isWhole ? from + statement.expression.length : text.indexOf("\n", from);
      this.#editor.goTo({ from, to: end < 0 ? text.length : end, line: statement.line });
    });
    const counters = (statement.counters ?? []).map(([name, value]) => `${name} ${value}`).join(", ");
    const name = statement.name ? `, ${statement.name}` : "";
    const expression = element("code", { textContent: statement.expression });
    note.replaceChildren(`Line ${line}${name}, is from `, link, counters && ` in ${counters}`, expression);
  }

  async #showShader(tab) {
    const target = this.target;
    this.#variants(LANGUAGES[tab].targets.map((target) => [target, NAMES[target]]), target);
    const { text, refused, stage, map } = await this.#host.text(target);
    if (this.target !== target) return;
    this.#map = map;
    const shown = text ?? (refused ? `// ${refused}\n` : "");
    this.#shown = { text: shown, name: `${this.#host.name()}.${extension(target, stage)}` };
    this.#editor.show(shown, { editable: false, label: `${NAMES[target]} of the kernel` });
    this.#editor.mark([]);
  }

  /** Shows errors, below the text and in it; none if all is well. */
  showErrors(errors) {
    this.#errors = errors;
    const list = this.#find("errors");
    list.hidden = errors.length === 0;
    list.replaceChildren(
      ...errors.map((error) => {
        const message = error.code ? `${error.code}: ${error.message}` : error.message;
        const item = element("li", {}, element("strong", { textContent: message }));
        if (error.label) item.append(element("span", { textContent: ` — ${error.label}` }));
        for (const note of error.notes) item.append(element("p", { textContent: `note: ${note}` }));
        if (error.help) item.append(element("p", { textContent: `help: ${error.help}` }));
        if (!error.place) return item;
        const { line, column, file } = error.place;
        const path = this.#host.files()[file]?.path.split("/").pop() ?? "";
        const link = element("button", { type: "button", className: "place", textContent: `${path}:${line}:${column}` });
        link.addEventListener("click", async () => {
          this.#file = file;
          await this.open("kernel");
          this.#editor.goTo(error.place);
        });
        item.prepend(link);
        return item;
      }),
    );
    if (this.#tab === "kernel") this.#mark();
  }

  #mark() {
    const here = this.#errors.filter((error) => error.place?.file === this.#file);
    this.#editor.mark(here.map((error) => ({ ...error.place, message: error.message })));
  }

  /** The engines that a folder can be had for, each with `name`, `title` and `about`. */
  offer(engines) {
    const choice = this.#find("engine");
    const entries = engines.map(({ name, title, about }) => element("option", { value: name, textContent: title, title: about }));
    choice.replaceChildren(...entries);
    this.#find("take-engine").addEventListener("click", async () => {
      const { files, refused } = await this.#host.engine(choice.value);
      const folder = `${this.#host.name()}-${choice.value}`;
      if (files) save(`${folder}.zip`, archive(folder, files));
      this.showErrors(files ? [] : [{ message: refused, label: "", notes: [], help: null, place: null }]);
    });
  }

  /** The list of what can be taken along. */
  #downloads() {
    const entry = (label, what) => {
      const button = element("button", { type: "button", className: "link", textContent: label });
      button.addEventListener("click", what);
      return element("li", {}, button);
    };
    const shader = (target) => async () => {
      const { text, refused, stage } = await this.#host.text(target);
      if (text) save(`${this.#host.name()}.${extension(target, stage)}`, text);
      else this.showErrors([{ message: refused ?? "there is no such shader", label: "", notes: [], help: null, place: null }]);
    };
    const manifest = async () => {
      const { manifest } = await this.#host.text("wgsl");
      if (manifest) save(`${this.#host.name()}.json`, `${JSON.stringify(manifest, null, 2)}\n`, "application/json");
    };
    this.#find("downloads").replaceChildren(
      ...Object.keys(NAMES).map((target) => entry(NAMES[target], shader(target))),
      entry("Manifest (JSON)", manifest),
    );
  }
}
