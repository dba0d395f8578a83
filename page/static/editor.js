// A text with numbered lines and colours; the kernel's own can be edited, and shows errors where they are.

import { highlight } from "./highlight.js";

/** Texts longer than this are shown without colours: a browser is slow with that many words. */
const LONGEST = 200_000;

export class Editor {
  #area = document.createElement("textarea");
  #numbers = document.createElement("pre");
  #colours = document.createElement("pre");
  #marks = document.createElement("pre");
  #places = [];
  #lines = 0;

  /** `changed` is called with the text after each edit, `chosen` with the cursor's line, from 1, of a text that is only read. */
  constructor(panel, changed, chosen) {
    const sheet = document.createElement("div");
    sheet.className = "sheet";
    this.#numbers.className = "numbers";
    this.#numbers.ariaHidden = "true";
    this.#colours.ariaHidden = "true";
    this.#marks.ariaHidden = "true";
    this.#colours.className = "colours";
    this.#marks.className = "marks";
    this.#area.spellcheck = false;
    this.#area.autocapitalize = "off";
    this.#area.autocomplete = "off";
    this.#area.wrap = "off";
    const layers = document.createElement("div");
    layers.className = "layers";
    layers.append(this.#marks, this.#colours, this.#area);
    sheet.append(this.#numbers, layers);
    panel.append(sheet);
    this.#area.addEventListener("input", () => {
      this.#paint();
      changed(this.#area.value);
    });
    this.#area.addEventListener("keydown", (event) => this.#key(event));
    const choose = () => this.#area.readOnly && chosen(this.#area.value.slice(0, this.#area.selectionStart).split("\n").length);
    this.#area.addEventListener("click", choose);
    this.#area.addEventListener("keyup", choose);
  }

  get text() {
    return this.#area.value;
  }

  /** Shows a text; `label` is what a screen reader calls it. */
  show(text, { editable, label }) {
    this.#area.readOnly = !editable;
    this.#area.title = editable ? "Tab indents; Escape, then Tab, leaves the text" : "Click a line to see where it comes from";
    this.#area.ariaLabel = label;
    if (this.#area.value !== text) {
      this.#area.value = text;
      this.#places = [];
    }
    this.#paint();
  }

  /** Marks places: `{ from, to, line, message }`, in UTF-16 units of the text. */
  mark(places) {
    this.#places = places;
    this.#paint();
  }

  /** Puts the cursor at a place, and shows it. */
  goTo(place) {
    this.#area.focus();
    this.#area.setSelectionRange(place.from, Math.max(place.to, place.from));
    const height = parseFloat(getComputedStyle(this.#area).lineHeight);
    const panel = this.#area.closest(".panel");
    panel.scrollTop = Math.max(0, (place.line - 4) * height);
  }

  /** Tab indents; Escape, then Tab, leaves. */
  #key(event) {
    if (event.key !== "Tab" || event.shiftKey || this.#area.readOnly || this.#escaped) {
      this.#escaped = event.key === "Escape";
      return;
    }
    event.preventDefault();
    // The only way that keeps undo.
    document.execCommand("insertText", false, "    ");
  }
  #escaped = false;

  #paint() {
    const text = this.#area.value;
    // A last empty line has a height only if something is in it.
    const end = text.endsWith("\n") ? " " : "";
    if (text.length < LONGEST) this.#colours.innerHTML = highlight(text) + end;
    else this.#colours.textContent = text + end;
    this.#marks.replaceChildren(...this.#marked(text), end);
    const lines = text.split("\n").length;
    const wrong = new Set(this.#places.map((place) => place.line));
    if (lines === this.#lines && !wrong.size && !this.#numbers.querySelector(".wrong")) return;
    this.#lines = lines;
    const numbers = Array.from({ length: lines }, (_, k) => {
      const number = document.createElement("span");
      number.textContent = `${k + 1}\n`;
      if (wrong.has(k + 1)) number.className = "wrong";
      return number;
    });
    this.#numbers.replaceChildren(...numbers);
  }

  #marked(text) {
    const parts = [];
    let last = 0;
    for (const { from, to } of [...this.#places].sort((a, b) => a.from - b.from)) {
      if (from < last || from > text.length) continue;
      // A place without width is where something is missing.
      const end = Math.min(Math.max(to, from + 1), text.length);
      const mark = document.createElement("mark");
      mark.textContent = text.slice(from, end) || " ";
      parts.push(text.slice(last, from), mark);
      last = end;
    }
    return [...parts, text.slice(last)];
  }
}
