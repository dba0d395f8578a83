// The example in a browser without a display: `web/run` builds the page, draws the native pictures, and runs this.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { existsSync } from "node:fs";
import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { browse, serve } from "../../../page/tests/browser.js";

const { DEFERRED_PAGE: folder, DEFERRED_PICTURES: pictures } = process.env;
if (!folder || !pictures) throw new Error("run web/run, which builds the page and draws the native pictures");

const SIZE = [640, 360];

let server;
let browser;
before(async () => {
  server = await serve(folder);
  browser = await browse();
});
after(async () => {
  await browser?.close();
  server?.close();
});

async function open(query) {
  const page = await browser.newPage();
  await page.setViewport({ width: 1000, height: 700 });
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(String(error)));
  page.on("console", (message) => {
    if (["error", "warn"].includes(message.type())) page.problems.push(message.text());
  });
  await page.goto(`${server.url}?${query}`);
  return page;
}

const state = (page) => page.$eval("#state", (element) => element.textContent);

async function says(page, pattern) {
  try {
    await page.waitForFunction(
      (pattern) => new RegExp(pattern).test(document.querySelector("#state").textContent),
      { timeout: 60_000 },
      pattern.source,
    );
  } catch (error) {
    assert.fail(`the page says "${await state(page)}", not ${pattern}: ${page.problems.join("; ")} (${error})`);
  }
  return state(page);
}

const MS = /(\d+\.\d+) ms/g;

test("the canvas is drawn, and the page says what a frame costs", async () => {
  const page = await open(`size=${SIZE.join("x")}&time=2`);
  const said = await says(page, /^guided: .* ms a frame, .* ms to record/);
  console.log(`  ${said}`);
  const times = [...said.matchAll(MS)].map((found) => Number(found[1]));
  assert.ok(times.length >= 2 && times.every((ms) => ms > 0 && ms < 10_000), said);
  // Chromium's adapter here is the processor, which is no clock for itself.
  assert.match(said, /by the wall clock; .*processor/);
  assert.deepEqual(await page.$eval("canvas", (canvas) => [canvas.width, canvas.height]), SIZE);

  for (const [key, preset] of [["Space", "none"], ["Space", "guided"], ["4", "full"], ["6", "4x"]]) {
    await page.keyboard.press(key);
    await says(page, new RegExp(`^${preset}: .* ms to record`));
  }
  assert.deepEqual(page.problems, []);
  await page.close();
});

test("timestamps come without waiting", async () => {
  // The runtime's Timer on a driver whose timestamps are not worth much: what is tried is that they arrive.
  const page = await open(`size=${SIZE.join("x")}&time=2&preset=full&timestamps`);
  const said = await says(page, /^full: .* ms on the GPU, .* ms of them SRAA/);
  console.log(`  ${said}`);
  const [all, sraa] = [...said.matchAll(MS)].slice(-2).map((found) => Number(found[1]));
  assert.ok(sraa > 0 && sraa <= all && all < 10_000, said);
  assert.deepEqual(page.problems, []);
  await page.close();
});

/** Mean and maximum of the differences of colours, in 8 bits, and the share of pixels that differ by more than 2. */
async function compared(page, preset, file) {
  const png = (await readFile(file)).toString("base64");
  return page.evaluate(
    async (size, preset, png) => {
      const { picture } = await import("./deferred.js");
      const drawn = await picture(`?size=${size.join("x")}&time=2&preset=${preset}`);
      const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${png}`)).blob());
      const canvas = new OffscreenCanvas(...size);
      const context = canvas.getContext("2d");
      context.drawImage(bitmap, 0, 0);
      const native = context.getImageData(0, 0, ...size).data;
      let [sum, most, beyond, colours] = [0, 0, 0, new Set()];
      for (let k = 0; k < native.length; k += 4) {
        let off = 0;
        for (let c = 0; c < 3; c++) {
          const difference = Math.abs(drawn[k + c] - native[k + c]);
          sum += difference;
          off = Math.max(off, difference);
        }
        most = Math.max(most, off);
        beyond += off > 2;
        colours.add((drawn[k] << 16) | (drawn[k + 1] << 8) | drawn[k + 2]);
      }
      context.putImageData(new ImageData(new Uint8ClampedArray(drawn), ...size), 0, 0);
      const blob = await canvas.convertToBlob({ type: "image/png" });
      const bytes = Array.from(new Uint8Array(await blob.arrayBuffer()));
      const pixels = native.length / 4;
      return { mean: sum / (3 * pixels), most, beyond: beyond / pixels, colours: colours.size, same: drawn.length === native.length, bytes };
    },
    SIZE,
    preset,
    png,
  );
}

test("the browser's picture is the native one", async () => {
  const page = await open(`size=${SIZE.join("x")}&time=2`);
  await says(page, /^guided/);
  for (const [driver, mean, share] of [["swiftshader", 0.01, 0], ["native", 0.5, 0.02]]) {
    for (const preset of ["none", "edges", "guided"]) {
      const file = join(pictures, `${driver}-${preset}.png`);
      if (!existsSync(file)) {
        console.log(`  no ${driver}-${preset}.png: this machine's Chromium has no SwiftShader that the native example can load`);
        continue;
      }
      const { bytes, ...found } = await compared(page, preset, file);
      await writeFile(join(pictures, `browser-${preset}.png`), Buffer.from(bytes));
      console.log(`  to ${driver}-${preset}.png: mean ${found.mean.toFixed(4)}, at most ${found.most}, ${(100 * found.beyond).toFixed(3)} % beyond 2`);
      assert.ok(found.same && found.colours > 300, `a picture: ${JSON.stringify(found)}`);
      assert.ok(found.mean <= mean && found.beyond <= share, `${driver}-${preset}: ${JSON.stringify(found)}`);
    }
  }
  assert.deepEqual(page.problems, []);
  await page.close();
});

test("what goes wrong is said", async () => {
  for (const [query, wanted] of [["preset=best", /no preset best/], ["size=0x4", /0x4 is not a size/], ["table", /neither/]]) {
    const page = await open(query);
    await says(page, wanted);
    await page.close();
  }
  const page = await browser.newPage();
  page.problems = [];
  await page.evaluateOnNewDocument(() => delete Navigator.prototype.gpu);
  await page.goto(server.url);
  await says(page, /no WebGPU/);
  await page.close();
});
