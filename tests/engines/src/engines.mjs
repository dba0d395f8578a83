// How each engine is run: what is emitted is given to the engine itself, and its pixels are read back.

import { execFileSync } from "node:child_process";
import { appendFileSync, copyFileSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { PNG } from "pngjs";
import { turned } from "../pages/rows.js";
import { pack } from "./godot.mjs";
import { HEIGHT, WIDTH, inputs, sizeOf, tableSizes } from "./kernels.mjs";

const here = dirname(dirname(fileURLToPath(import.meta.url)));
const native = join(here, "native");
const root = dirname(dirname(here));

/** Python, which finds what `run` installs. */
export const PYTHON = process.env.PYTHON ?? "python3";

/** A page of the browser; `files` are those of the folder by what the page calls them, `bits` what its picture has. */
function page(name, files, bits = 32) {
    return async ({ kernel, folder, url, browser, className, functionName, picture }) => {
        const found = Object.fromEntries(Object.entries(files(kernel.name)).map(([key, file]) => [key, `${url}/${file}`]));
        const layers = inputs(kernel);
        const { rgba, said } = await browser.run(name, {
            module: found.module,
            modules: found,
            className,
            functionName,
            picture,
            // Textures that the kernel reads through a sampler.
            filtered: kernel.filtered,
            chain: kernel.chain ?? false,
            sizes: tableSizes(kernel),
            layered: Object.keys(layers).filter((key) => layers[key].length > 1),
            inputs: Object.fromEntries(Object.entries(layers).map(([key, each]) => [key, each.map((_, k) => `/inputs/${kernel.name}-${key}-${k}.f32`)])),
            uniforms: kernel.uniforms,
            width: WIDTH,
            height: HEIGHT,
        });
        return { rgba, bits, said };
    };
}

/** A program that reads and writes a PNG of 8 bits. */
function withPng(program) {
    return async (task) => {
        const from = join(task.folder, "in.png");
        const to = join(task.folder, "out.png");
        const [width, height] = sizeOf(task.kernel, task.engine);
        writeFileSync(from, PNG.sync.write(png(inputs(task.kernel, [width, height]).color[0], width, height)));
        program(task, from, to);
        const made = PNG.sync.read(readFileSync(to));
        if (made.width !== width || made.height !== height) throw new Error(`the picture has ${made.width}x${made.height} pixels`);
        return { rgba: Float32Array.from(made.data, (value) => value / 255), bits: 8 };
    };
}

function png(rgba, width = WIDTH, height = HEIGHT) {
    const made = new PNG({ width, height });
    rgba.forEach((value, k) => { made.data[k] = Math.round(value * 255); });
    return made;
}

function run(program, args) {
    // Drivers complain where it is not set.
    const env = { XDG_RUNTIME_DIR: tmpdir(), EGL_PLATFORM: "surfaceless", PYTHONPATH: join(here, "python"), ...process.env };
    execFileSync(program, args, { stdio: ["ignore", "pipe", "pipe"], env });
}

/** The file of a folder that ends so. */
function ending(folder, end) {
    const found = readdirSync(folder).find((file) => file.endsWith(end));
    if (!found) throw new Error(`no file *${end} was emitted`);
    return join(folder, found);
}

const ffmpeg = withPng(({ folder }, from, to) => {
    // Without dithering, which would hide differences of a level.
    const hook = `libplacebo=custom_shader_path=${ending(folder, ".glsl")}:dithering=none`;
    run("ffmpeg", ["-hide_banner", "-loglevel", "error", "-y", "-init_hw_device", "vulkan=device", "-filter_hw_device", "device", "-i", from,
        "-vf", `format=rgba,hwupload,${hook},hwdownload,format=rgba`, "-frames:v", "1", "-update", "1", to]);
});

const librashader = (program) => withPng(({ kernel, folder }, from, to) => {
    const preset = ending(folder, ".slangp");
    for (const [name, table] of Object.entries(kernel.tables)) copyFileSync(join(root, table), join(folder, `${name}.png`));
    // A preset sets parameters as RetroArch's menu does.
    const values = Object.entries(kernel.uniforms).map(([name, value]) => `${name} = "${value}"`);
    if (values.length) appendFileSync(preset, `parameters = "${Object.keys(kernel.uniforms).join(";")}"\n${values.join("\n")}\n`);
    run(program, ["render", "-p", preset, "-i", from, "-o", to, "-r", "wgpu"]);
});

/** Godot's web template in the browser, with a project of ours. */
async function godot({ kernel, folder, url, browser }) {
    const shader = readFileSync(ending(folder, ".gdshader"), "utf8");
    writeFileSync(join(folder, "filter.pck"), pack(shader, PNG.sync.write(png(inputs(kernel).color[0])), kernel.uniforms));
    const { rgba, said } = await browser.run("godot", { pack: `${url}/filter.pck`, inputs: {} });
    return { rgba, bits: 8, said };
}

/** A program that is given files of floats, rows from below, and writes one. */
function withFloats(kernel, folder, program) {
    const given = Object.entries(inputs(kernel)).map(([name, layers]) => {
        const files = layers.map((rgba, k) => {
            const file = join(folder, `${name}-${k}.f32`);
            writeFileSync(file, new Uint8Array(turned(rgba, WIDTH, HEIGHT).buffer));
            return file;
        });
        return `${name}=${files.join(",")}`;
    });
    const uniforms = Object.entries(kernel.uniforms).map(([name, value]) => `uniform:${name}=${value}`);
    const out = join(folder, "out.f32");
    program([WIDTH, HEIGHT, out, ...given, ...uniforms].map(String));
    const bytes = readFileSync(out);
    const rgba = new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
    return { rgba: turned(rgba, WIDTH, HEIGHT), bits: 32 };
}

/** A C program with the emitted header in it, on EGL. OpenGL counts rows from below. */
function opengl({ kernel, folder, functionName }) {
    const program = join(folder, "program");
    const header = ending(folder, ".h");
    run("cc", ["-std=c99", "-Wall", "-Werror", "-o", program, join(native, "opengl.c"), `-DHEADER="${header}"`, `-DVERTEX=${functionName}_vertex`,
        `-DFRAGMENT=${functionName}_fragment`, `-DSAMPLERS=${functionName}_samplers`, "-Wno-unused-variable", "-lEGL", "-lOpenGL"]);
    return withFloats(kernel, folder, (given) => run(program, given));
}

/** The emitted module in Panda3D, without a display: the picture is drawn there. */
function panda3d({ kernel, folder, className }) {
    const module = ending(folder, ".py");
    return withFloats(kernel, folder, (given) => run(PYTHON, [join(native, "in_panda3d.py"), module, `${className}Filter`, ...given]));
}

/** A scene that Panda3D renders with the emitted filter. */
export function scenePanda3d(folder, className, { fov, near, far, distance, slope, color, width, height }) {
    const out = join(folder, "scene.f32");
    const given = [width, height, fov, near, far, distance, slope, ...color].map(String);
    run(PYTHON, [join(native, "scene_panda3d.py"), ending(folder, ".py"), `${className}Filter`, out, ...given]);
    const bytes = readFileSync(out);
    const rgba = new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
    return { rgba: turned(rgba, width, height) };
}

/**
 * Name of the test, the engine that is emitted for, how it is run, and what it needs. Where uniforms are `fixed`, nothing here
 * can set them: the kernel is emitted with their values. `slack` is added to
 * the bound: libplacebo keeps pictures in floats of 16 bits between its steps. `even` engines are given pictures of chains whose
 * sizes their presets state without rounding.
 */
export const ENGINES = [
    { name: "webgl2", engine: "webgl2", needs: ["chromium"], run: page("webgl2", (k) => ({ module: `${k}.js` })) },
    { name: "webgpu", engine: "webgpu", needs: ["chromium"], run: page("webgpu", (k) => ({ module: `${k}.js` })) },
    { name: "three, WebGLRenderer", engine: "three", needs: ["chromium"], run: page("three-webgl", (k) => ({ pass: `${k}-pass.js` })) },
    { name: "three, WebGPURenderer", engine: "three", needs: ["chromium"], run: page("three-webgpu", (k) => ({ node: `${k}-node.js` })) },
    { name: "postprocessing", engine: "postprocessing", needs: ["chromium"], run: page("postprocessing", (k) => ({ module: `${k}-effect.js` })) },
    { name: "babylon, WebGL 2", engine: "babylon", needs: ["chromium"], run: page("babylon", (k) => ({ module: `${k}-post-process.js` })) },
    { name: "babylon, WebGPU", engine: "babylon", needs: ["chromium"], run: page("babylon-webgpu", (k) => ({ module: `${k}-post-process.js` })) },
    { name: "playcanvas, WebGL 2", engine: "playcanvas", needs: ["chromium"], run: page("playcanvas", (k) => ({ module: `${k}-effect.mjs` })) },
    { name: "playcanvas, WebGPU", engine: "playcanvas", needs: ["chromium"], run: page("playcanvas-webgpu", (k) => ({ module: `${k}-effect.mjs` })) },
    { name: "pixi, WebGL 2", engine: "pixi", needs: ["chromium"], run: page("pixi", (k) => ({ module: `${k}-filter.js` }), 8) },
    { name: "pixi, WebGPU", engine: "pixi", needs: ["chromium"], run: page("pixi-webgpu", (k) => ({ module: `${k}-filter.js` }), 8) },
    { name: "godot, Compatibility", engine: "godot", needs: ["chromium"], run: godot },
    { name: "opengl", engine: "opengl", needs: ["cc"], run: opengl },
    { name: "panda3d", engine: "panda3d", needs: ["panda3d"], run: panda3d },
    { name: "mpv (libplacebo)", engine: "mpv", needs: ["ffmpeg"], fixed: true, slack: 2 ** -10, run: ffmpeg },
    { name: "libretro (librashader)", engine: "libretro", needs: ["librashader"], even: true, run: librashader(process.env.LIBRASHADER ?? "librashader-cli") },
];

/** Engines that render a scene of their own, and where `engine.toml` has row 0 of each of their shaders: above or below. */
export const UPRIGHT = ["three", "babylon", "playcanvas"].flatMap((engine) => [false, true].map((webgpu) => {
    const description = readFileSync(join(root, "engines", "templates", engine, "engine.toml"), "utf8");
    const shader = description.split("[shaders.").find((part) => part.startsWith(webgpu ? "wgsl]" : "glsl]")).split("\n[")[0];
    return { engine, webgpu, origin: /^origin = "lower-left"$/m.test(shader) ? "below" : "above" };
}));
