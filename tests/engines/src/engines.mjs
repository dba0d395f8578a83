// How each engine is run: what is emitted is given to the engine itself, and its pixels are read back.

import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { PNG } from "pngjs";
import { HEIGHT, WIDTH, inputs } from "./kernels.mjs";

/** A page of the browser; `files` are those of the folder by what the page calls them. */
function page(name, files) {
    return async ({ kernel, folder, url, browser, className, functionName, picture }) => {
        const found = Object.fromEntries(Object.entries(files(kernel.name)).map(([key, file]) => [key, `${url}/${file}`]));
        const layers = inputs(kernel);
        const { rgba, said } = await browser.run(name, {
            module: found.module,
            modules: found,
            className,
            functionName,
            picture,
            layered: Object.keys(layers).filter((key) => layers[key].length > 1),
            inputs: Object.fromEntries(Object.entries(layers).map(([key, each]) => [key, each.map((_, k) => `/inputs/${kernel.name}-${key}-${k}.f32`)])),
            uniforms: kernel.uniforms,
            width: WIDTH,
            height: HEIGHT,
        });
        return { rgba, bits: 32, said };
    };
}

/** A program that reads and writes a PNG of 8 bits. */
function withPng(program) {
    return async (task) => {
        const from = join(task.folder, "in.png");
        const to = join(task.folder, "out.png");
        writeFileSync(from, PNG.sync.write(png(inputs(task.kernel).color[0])));
        program(task, from, to);
        const made = PNG.sync.read(readFileSync(to));
        if (made.width !== WIDTH || made.height !== HEIGHT) throw new Error(`the picture has ${made.width}x${made.height} pixels`);
        return { rgba: Float32Array.from(made.data, (value) => value / 255), bits: 8 };
    };
}

function png(rgba) {
    const made = new PNG({ width: WIDTH, height: HEIGHT });
    rgba.forEach((value, k) => { made.data[k] = Math.round(value * 255); });
    return made;
}

function run(program, args, environment = {}) {
    execFileSync(program, args, { stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, ...environment } });
}

/** The file of a folder that ends so. */
function ending(folder, end) {
    const found = readdirSync(folder).find((file) => file.endsWith(end));
    if (!found) throw new Error(`no file *${end} was emitted`);
    return join(folder, found);
}

const ffmpeg = withPng(({ kernel, folder }, from, to) => {
    // libplacebo sees the picture as it is: no dithering, no change of its gamma or its primaries.
    const placebo = `libplacebo=custom_shader_path=${ending(folder, ".glsl")}:dithering=none:format=gbrp`;
    run("ffmpeg", ["-hide_banner", "-loglevel", "error", "-y", "-init_hw_device", "vulkan", "-i", from,
        "-vf", `format=gbrp,${placebo},format=rgba`, to], { XDG_RUNTIME_DIR: "/tmp" });
});

const librashader = (program) => withPng(({ folder }, from, to) => {
    run(program, ["render", "-p", ending(folder, ".slangp"), "-i", from, "-o", to, "-r", "wgpu"], { XDG_RUNTIME_DIR: "/tmp" });
});

/** Name of the test, the engine that is emitted for, how it is run, and what it needs. */
export const ENGINES = [
    { name: "webgl2", engine: "webgl2", needs: ["chromium"], run: page("webgl2", (k) => ({ module: `${k}.js` })) },
    { name: "webgpu", engine: "webgpu", needs: ["chromium"], run: page("webgpu", (k) => ({ module: `${k}.js` })) },
    { name: "three, WebGLRenderer", engine: "three", needs: ["chromium"], run: page("three-webgl", (k) => ({ pass: `${k}-pass.js` })) },
    { name: "three, WebGPURenderer", engine: "three", needs: ["chromium"], run: page("three-webgpu", (k) => ({ node: `${k}-node.js` })) },
    { name: "postprocessing", engine: "postprocessing", needs: ["chromium"], run: page("postprocessing", (k) => ({ module: `${k}-effect.js` })) },
    { name: "mpv (libplacebo)", engine: "mpv", needs: ["ffmpeg"], run: ffmpeg },
    { name: "libretro (librashader)", engine: "libretro", needs: ["librashader"], run: librashader(process.env.LIBRASHADER ?? "librashader-cli") },
];
