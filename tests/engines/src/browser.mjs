// A headless Chromium on software drivers, and the server of the pages that it runs.

import { createServer } from "node:http";
import { existsSync, readFileSync } from "node:fs";
import { extname, join, normalize } from "node:path";
import puppeteer from "puppeteer-core";

const TYPES = { ".js": "text/javascript", ".mjs": "text/javascript", ".html": "text/html", ".json": "application/json" };

/** Serves the folders by the names of `roots`. */
async function serve(roots) {
    const server = createServer((request, response) => {
        const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname)).split("/").slice(1);
        const root = roots[path[0]];
        const file = root && join(root, ...path.slice(1));
        if (!file || !existsSync(file)) {
            response.writeHead(404).end();
            return;
        }
        response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream" }).end(readFileSync(file));
    });
    await new Promise((done) => server.listen(0, "127.0.0.1", done));
    return server;
}

/** Opens the browser; `run(engine, task)` runs `pages/ENGINE.js` and gives the picture, rows from above. */
export async function open(chromium, roots) {
    const server = await serve(roots);
    const browser = await puppeteer.launch({
        executablePath: chromium,
        headless: true,
        args: ["--no-sandbox", "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan",
            "--use-vulkan=swiftshader", "--use-angle=swiftshader", "--disable-vulkan-surface", "--ignore-gpu-blocklist"],
    });
    return {
        async run(engine, task) {
            const page = await browser.newPage();
            const said = [];
            page.on("console", (message) => said.push(message.text()));
            page.on("pageerror", (error) => said.push(String(error)));
            try {
                await page.goto(`http://127.0.0.1:${server.address().port}/pages/page.html`);
                const base64 = await page.evaluate(async (engine, task) => globalThis.runEngine(engine, task), engine, task);
                const bytes = Buffer.from(base64, "base64");
                return { rgba: new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)), said };
            } catch (error) {
                throw new Error([error.message, ...said].join("\n"));
            } finally {
                await page.close();
            }
        },
        version: () => browser.version(),
        async close() {
            await browser.close();
            server.close();
        },
    };
}
