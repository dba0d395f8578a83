// What one invocation executes, of the form on the right and of that on the left.

const ROWS = [
  ["basic blocks", (c) => c.basic_blocks],
  ["loops", (c) => c.loops],
  ["texture reads", (c) => c.texture_reads, (paper) => paper.texture_reads],
  ["reads of color", (c) => c.colour_reads],
  ["weight evaluations", (c) => c.tallies.weight_evaluations, (paper) => paper.weight_evaluations || undefined],
  ["quad operations", (c) => c.messages],
  ["transcendental calls", (c) => c.transcendentals],
  ["other arithmetic", (c) => c.alu],
  ["statements", (c) => c.statements],
  ["scalars alive at most", (c) => c.max_live],
];

/** Rows of which nothing need be said where there is none of it. */
const RARE = new Set(["reads of color", "weight evaluations", "quad operations"]);

const cell = (row, text, tag = "td") => {
  const made = document.createElement(tag);
  made.textContent = text;
  if (tag === "th") made.scope = row.parentElement?.tagName === "THEAD" ? "col" : "row";
  row.append(made);
};

/** Fills the table: `right` is `{ name, counts, block }`, `left` the same without a block; `left` and `paper` may be null. */
export function showCounts(table, right, left, paper) {
  const head = document.createElement("thead");
  const title = head.insertRow();
  const [across, down] = right.block;
  cell(title, across * down === 1 ? "per pixel" : `per ${across}×${down} pixels`, "th");
  if (left) cell(title, left.name, "th");
  cell(title, right.name, "th");
  if (paper) cell(title, "paper", "th");
  const body = document.createElement("tbody");
  for (const [name, of, ofPaper] of ROWS) {
    const value = of(right.counts);
    const other = left ? of(left.counts) : undefined;
    if (RARE.has(name) && !value && !other) continue;
    const row = body.insertRow();
    cell(row, name, "th");
    if (left) cell(row, other ?? 0);
    cell(row, value ?? 0);
    if (paper) cell(row, ofPaper?.(paper) ?? "");
  }
  table.replaceChildren(head, body);
}

/** Fills the table of loops, and hides it where there is none. */
export function showLoops(details, loops) {
  details.hidden = loops.length === 0;
  details.querySelector("summary").textContent = loops.length === 1 ? "What became of 1 loop" : `What became of ${loops.length} loops`;
  const head = document.createElement("thead");
  const title = head.insertRow();
  for (const name of ["loop", "unroll", "copies", "operations"]) cell(title, name, "th");
  const body = document.createElement("tbody");
  for (const { loop, unroll, copies, operations, reason } of loops) {
    const row = body.insertRow();
    cell(row, loop, "th");
    cell(row, reason ? `${unroll}: ${reason}` : unroll);
    cell(row, copies);
    cell(row, operations);
  }
  details.querySelector("table").replaceChildren(head, body);
}
