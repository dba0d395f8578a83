// A server for the page's folder, and a browser that looks at it.

import { createServer } from "node:http";
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { extname, join, normalize } from "node:path";
import puppeteer from "puppeteer-core";

const TYPES = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
};

/** Serves a folder below a path of its own, as a host that gives each project a folder does. */
export async function serve(folder) {
  const server = createServer(async ({ url }, answer) => {
    const path = normalize(decodeURIComponent(new URL(url, "http://localhost").pathname)).replace(/^\/project\//, "/");
    const file = join(folder, path === "/" ? "index.html" : path);
    try {
      const bytes = await readFile(file);
      answer.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream" });
      answer.end(bytes);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const { port } = server.address();
  return { origin: `http://127.0.0.1:${port}`, url: `http://127.0.0.1:${port}/project/`, close: () => server.close() };
}

const FLAGS = [
  "--no-sandbox",
  "--enable-unsafe-webgpu",
  "--use-webgpu-adapter=swiftshader",
  "--enable-features=Vulkan",
  "--use-vulkan=swiftshader",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-vulkan-surface",
  "--ignore-gpu-blocklist",
];

/** A browser without a display; its driver is SwiftShader, on the processor. */
export async function browse() {
  const path = process.env.CHROMIUM ?? ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
  if (!path || !existsSync(path)) {
    throw new Error("no Chromium: on Debian `apt install chromium`, or set CHROMIUM to one's path");
  }
  return puppeteer.launch({ executablePath: path, headless: true, args: FLAGS });
}

/** Opens the page and waits for its first picture. Gives the page, with `requests` and `problems` that it collects. */
export async function open(browser, url, { width = 1400, height = 1000, hash = "", query = "", dark = false } = {}) {
  const page = await browser.newPage();
  await page.setViewport({ width, height, deviceScaleFactor: 1 });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }]);
  page.requests = [];
  page.problems = [];
  page.on("request", (request) => page.requests.push(request.url()));
  page.on("pageerror", (error) => page.problems.push(String(error)));
  page.on("console", (message) => {
    // That reading a picture back waits for the driver is no problem here.
    if (message.text().includes("GPU stall due to ReadPixels")) return;
    if (["error", "warn"].includes(message.type())) page.problems.push(message.text());
  });
  await page.goto(`${url}${query}${hash}`);
  await settled(page);
  return page;
}

/** Waits until the page shows what is chosen. */
export async function settled(page) {
  // A text that is edited waits a moment for more.
  await new Promise((resolve) => setTimeout(resolve, 320));
  await page.waitForFunction(
    () => !document.body.dataset.busy && document.body.dataset.busy === undefined && globalThis.straightline !== undefined,
    { timeout: 60_000 },
  );
}
