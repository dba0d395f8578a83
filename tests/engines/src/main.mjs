// Emits every kernel for every engine, runs it there, and compares pixels with the interpreter. See README.md.

import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { open } from "./browser.mjs";
import { compare } from "./compare.mjs";
import { ENGINES, PYTHON, UPRIGHT, scenePanda3d } from "./engines.mjs";
import { readExr, writeExr } from "./exr.mjs";
import { HEIGHT, KERNELS, WIDTH, inputs, sizeOf, tableSizes } from "./kernels.mjs";
import { FILTERS, SCENE, SCENES } from "./scenes.mjs";

const here = dirname(dirname(fileURLToPath(import.meta.url)));
const root = dirname(dirname(here));
const straightline = process.env.STRAIGHTLINE ?? join(root, "target", "debug", "straightline");
const [only, onlyKernel] = process.argv.slice(2).filter((argument) => !argument.startsWith("--"));
const record = process.argv.find((argument) => argument.startsWith("--record="))?.slice("--record=".length);

/** The path of a program. */
function found(program) {
    return spawnSync("sh", ["-c", `command -v ${program}`], { encoding: "utf8" }).stdout.trim() || program;
}

const PROGRAMS = {
    chromium: { program: process.env.CHROMIUM ?? found("chromium"), version: ["--version"], install: "apt-get install chromium" },
    ffmpeg: { program: "ffmpeg", version: ["-version"], install: "apt-get install ffmpeg mesa-vulkan-drivers" },
    cc: { program: "cc", version: ["--version"], install: "apt-get install gcc libegl-dev libopengl-dev libgl1-mesa-dri" },
    panda3d: {
        program: PYTHON,
        version: ["-c", "import panda3d; print('Panda3D', panda3d.__version__)"],
        install: "python3 -m pip install --target tests/engines/python -r tests/engines/requirements.txt",
        called: "panda3d",
    },
    librashader: {
        program: process.env.LIBRASHADER ?? "librashader-cli",
        version: ["--version"],
        install: "cargo install librashader-cli --version 0.12.0 --locked --no-default-features --features wgpu,vulkan, and its path in LIBRASHADER",
    },
};

/** The first line of what a program says of itself, or nothing if it is not there. */
function version({ program, version }) {
    const env = { PYTHONPATH: join(here, "python"), ...process.env };
    const ran = spawnSync(program, version, { encoding: "utf8", env });
    return ran.status === 0 ? (ran.stdout || ran.stderr).split("\n")[0].trim() : null;
}

/** A record with the rows of a run of some engines or kernels in it, in the order of a run of all. */
function merged(kept, found) {
    const orders = [[...ENGINES, ...SCENES], [...KERNELS, ...FILTERS]].map((all) => all.map(({ name }) => name));
    const place = (row) => [row.engine, row.kernel].map((name, k) => orders[k].indexOf(name));
    const order = (a, b) => place(a)[0] - place(b)[0] || place(a)[1] - place(b)[1];
    const joined = (old, rows) => {
        const isOld = ({ engine, kernel }) => !rows.some((row) => row.engine === engine && row.kernel === kernel);
        return [...old.filter(isOld), ...rows.map(dated)].sort(order);
    };
    // A row states the versions of programs that have changed since the others were written.
    const changed = Object.entries(found.versions).filter(([name, version]) => version && (kept.versions[name] ?? version) !== version);
    const dated = (row) => {
        const needs = ENGINES.find(({ name }) => name === row.engine)?.needs ?? ["chromium"];
        const own = changed.filter(([name]) => row.state === "same" && needs.includes(name));
        return own.length ? { ...row, versions: Object.fromEntries(own) } : row;
    };
    return {
        versions: { ...found.versions, ...kept.versions },
        rows: joined(kept.rows, found.rows),
        scenes: joined(kept.scenes ?? [], found.scenes),
    };
}

function emitted(kernel, { engine, fixed }, folder) {
    // A chain of several passes fits none of them.
    const values = fixed && !kernel.chain ? Object.entries(kernel.uniforms).map(([name, value]) => `${name}=${value}`) : [];
    const options = [...kernel.options.filter((option) => !fixed || !option.endsWith("=uniform")), ...values].flatMap((option) => ["--set", option]);
    const ran = spawnSync(straightline, ["emit", kernel.kernel, ...sourcesOf(kernel), ...options, "--engine", engine, "--name", kernel.name, "--out", folder],
        { cwd: root, encoding: "utf8" });
    if (ran.status === 0) return null;
    const said = ran.stderr.trim().replace(/^error(\[\w+\])?: /, "");
    // The lines after a refusal show its place.
    return said.includes("does not fit") ? said.split("\n")[0] : said;
}

function sourcesOf({ sources }) {
    return (sources ?? []).flatMap((file) => ["--source", file]);
}

/** What the interpreter makes of a kernel, of a picture of this size. */
function reference(kernel, size, work) {
    const given = [];
    const sizes = tableSizes(kernel);
    for (const [name, layers] of Object.entries(inputs(kernel, size))) {
        const files = layers.map((rgba, k) => {
            const stem = join(work, `${kernel.name}-${name}-${k}`);
            writeExr(`${stem}.exr`, ...(sizes[name] ?? size), rgba);
            writeFileSync(`${stem}.f32`, new Uint8Array(rgba.buffer));
            return `${stem}.exr`;
        });
        given.push("--input", `${name}=${files.join(",")}`);
    }
    const options = kernel.options.flatMap((option) => ["--set", option]);
    const uniforms = Object.entries(kernel.uniforms).flatMap(([name, value]) => ["--uniform", `${name}=${value}`]);
    const out = join(work, `${kernel.name}.exr`);
    execFileSync(straightline, ["run", kernel.kernel, ...sourcesOf(kernel), ...options, ...uniforms, ...given, "--executor", "cpu", "--out", out],
        { cwd: root, stdio: ["ignore", "ignore", "pipe"] });
    return readExr(out).rgba;
}

const work = mkdtempSync(join(tmpdir(), "straightline-engines-"));
const rows = [];
const scenes = [];
const versions = {};
let failed = 0;
let browser;
try {
    for (const [name, program] of Object.entries(PROGRAMS)) versions[name] = version(program);
    const kernels = KERNELS.filter(({ name }) => !onlyKernel || name === onlyKernel);
    const references = {};
    const engines = ENGINES.filter(({ name, engine }) => !only || name === only || engine === only);
    for (const kernel of kernels) {
        // Kernels that need more than pictures fit no engine here, which is what is tested of them. The usual size comes last:
        // its inputs are those that pages read.
        const sizes = new Set([...engines.map((engine) => String(sizeOf(kernel, engine))), `${WIDTH},${HEIGHT}`]);
        for (const size of kernel.refused ? [] : [...sizes].sort((a, b) => (b === String(kernel.even)) - (a === String(kernel.even)))) {
            references[`${kernel.name} ${size}`] = reference(kernel, size.split(",").map(Number), work);
        }
    }
    browser = versions.chromium && (await open(PROGRAMS.chromium.program, {
        pages: join(here, "pages"), modules: join(here, "node_modules"), emitted: work, inputs: work,
    }));
    for (const engine of engines) {
        for (const kernel of kernels) {
            const result = await tried(engine, kernel, references[`${kernel.name} ${sizeOf(kernel, engine)}`]);
            rows.push({ engine: engine.name, kernel: kernel.name, ...result });
            if (!["same", "refused"].includes(result.state)) failed += 1;
            const figures = result.most === undefined ? "" : ` most ${result.most.toExponential(1)}, ${(100 * result.within).toFixed(2)} % within ${result.limit.toExponential(1)}`;
            console.log(`${engine.name}: ${kernel.name}: ${result.state}${figures}${result.why ? `: ${result.why}` : ""}`);
        }
    }
    if (!onlyKernel && browser) {
        for (const scene of UPRIGHT.filter(({ engine }) => !only || only === engine || only.startsWith(`${engine},`))) {
            const why = await upright(scene);
            if (why) failed += 1;
            console.log(`${scene.engine}${scene.webgpu ? ", WebGPU" : ", WebGL"}: rows of a rendered scene: ${why ?? `from ${scene.origin}, as engine.toml says`}`);
        }
    }
    for (const filter of FILTERS.filter(({ name }) => !onlyKernel || name === onlyKernel)) {
        const rendering = SCENES.filter(({ name }) => filter.engines.includes(name));
        for (const scene of rendering.filter(({ name, engine }) => !only || name === only || engine === only)) {
            const result = await rendered(scene, filter);
            scenes.push({ engine: scene.name, kernel: filter.name, ...result });
            if (result.state !== "same") failed += 1;
            console.log(`${scene.name}: ${filter.name} in a rendered scene: ${result.state} ${result.why ?? `most ${result.most.toExponential(1)}`}`);
        }
    }
} finally {
    await browser?.close();
    rmSync(work, { recursive: true, force: true });
}
if (record) {
    const lock = JSON.parse(readFileSync(join(here, "package.json"), "utf8"));
    const found = { versions: { ...versions, ...lock.dependencies }, rows, scenes };
    const kept = only || onlyKernel ? JSON.parse(readFileSync(record, "utf8")) : { versions: {}, rows: [], scenes: [] };
    const text = JSON.stringify({ command: "tests/engines/run --record=FILE", size: [WIDTH, HEIGHT], ...merged(kept, found) }, null, 1);
    mkdirSync(dirname(record), { recursive: true });
    writeFileSync(record, `${text}\n`);
}
console.log(failed ? `${failed} of ${rows.length + scenes.length} failed` : `${rows.length + scenes.length} passed`);
process.exitCode = failed ? 1 : 0;

/**
 * Whether the engine itself renders with its rows as the shader expects them: of a scene whose upper half is red, row 0 is red
 * where rows count from above. Gives what is wrong.
 */
async function upright({ engine, webgpu, origin }) {
    try {
        const { rgba } = await browser.run(`upright-${engine}`, { webgpu, inputs: {} });
        const [first, last] = rgba;
        const expected = origin === "above" ? [1, 0] : [0, 1];
        return first === expected[0] && last === expected[1] ? null : `row 0 is ${first} and the last ${last}, not ${expected}`;
    } catch (error) {
        return error.message.slice(0, 2000);
    }
}

/** Emits a filter, has the engine render a scene with it, and compares with the picture that the scene has to make. */
async function rendered({ page, engine, file, native, ...scene }, { name, expected }) {
    const need = native ?? "chromium";
    if (!versions[need]) return { state: "missing", why: `${need} is not there: ${PROGRAMS[need].install}` };
    const folder = join(work, `${engine}-${name}-scene`);
    const refused = emitted({ name, kernel: `tests/engines/kernels/${name}.rs`, options: [], uniforms: {} }, { engine }, folder);
    if (refused) return { state: "failed", why: refused };
    try {
        const className = name[0].toUpperCase() + name.slice(1);
        const task = { ...SCENE, ...scene, className, functionName: name, inputs: {} };
        const { rgba } = native
            ? scenePanda3d(folder, className, SCENE)
            : await browser.run(page, { ...task, module: `/emitted/${engine}-${name}-scene/${file(name)}` });
        // Drivers move vertices to a fraction of a pixel, by which the distances of the plane differ.
        const found = compare(rgba, expected(scene), 32, 2 ** -9);
        return { state: found.within === 1 ? "same" : "differs", most: found.most, limit: found.limit };
    } catch (error) {
        return { state: "failed", why: error.message.slice(0, 2000) };
    }
}

/** Emits, runs and compares. */
async function tried(engine, kernel, expected) {
    const folder = join(work, `${engine.engine}-${kernel.name}`);
    const refused = emitted(kernel, engine, folder);
    if (refused) return { state: refused.includes("does not fit") ? "refused" : "failed", why: refused };
    if (!expected) return { state: "failed", why: "emitted, and nothing to compare with" };
    for (const need of engine.needs) {
        if (!versions[need]) return { state: "missing", why: `${PROGRAMS[need].called ?? PROGRAMS[need].program} is not there: ${PROGRAMS[need].install}` };
    }
    try {
        const className = kernel.name.split("_").map((word) => word[0].toUpperCase() + word.slice(1)).join("");
        const functionName = kernel.kernel.split("/").at(-1).replace(".rs", "");
        const { rgba, bits } = await engine.run({
            engine, kernel, folder, browser, className, functionName, picture: "color", url: `/emitted/${engine.engine}-${kernel.name}`,
        });
        const found = compare(rgba, expected, bits, kernel.bound + (engine.slack ?? 0));
        return { state: found.within >= kernel.share ? "same" : "differs", ...found };
    } catch (error) {
        const said = `${error.message}${error.stderr ? `\n${error.stderr}` : ""}`;
        return { state: "failed", why: said.slice(0, 2000) };
    }
}
