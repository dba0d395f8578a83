// The kernels and chains that every engine is given, and what they read.

import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { PNG } from "pngjs";
import { HEIGHT, WIDTH, depths, normals, picture } from "./pictures.mjs";

const root = dirname(dirname(dirname(dirname(fileURLToPath(import.meta.url)))));
const GALLERY = "kernels/filters";
const SMAA = ["edges", "weights", "blend"].map((pass) => `examples/gallery/smaa_${pass}.rs`);

/**
 * `bound` is the difference that a value may have from the interpreter's, in floats; `share` how many of the values are within it:
 * a filter that decides by comparing lets a rounding decide otherwise now and then. Where the kernel has its picture filtered, the
 * bound is that of drivers whose weights have 8 bits. `uniforms` are set in the engine too. A chain has `sources`, and `tables` in
 * files of 8 bits; `even` is the size of the picture for engines whose presets state sizes as factors.
 */
export const KERNELS = [
    { name: "orientation", kernel: "tests/engines/kernels/orientation.rs", bound: 2e-7, share: 1 },
    { name: "kuwahara", kernel: `${GALLERY}/kuwahara.rs`, bound: 1e-5, share: 0.99 },
    { name: "bilateral", kernel: `${GALLERY}/bilateral.rs`, options: ["sigma=uniform"], uniforms: { sigma: 2.25 }, bound: 1e-5, share: 1 },
    { name: "fxaa", kernel: `${GALLERY}/fxaa.rs`, filtered: ["color"], bound: 2 ** -9, share: 0.99 },
    { name: "sraa4", kernel: "sraa", scene: 5, bound: 1e-5, share: 1 },
    { name: "sraa16", kernel: "sraa", options: ["pattern=latin16"], scene: 17, bound: 1e-5, share: 1 },
    { name: "pcf", kernel: "pcf", refused: true, bound: 0, share: 1 },
    {
        name: "bloom", kernel: "examples/chains/bloom.rs", chain: true, options: ["levels=3"], uniforms: { threshold: 0.4, strength: 0.5 },
        even: [64, 48], bound: 2 ** -9, share: 1,
    },
    {
        name: "smaa", kernel: "examples/chains/smaa.rs", chain: true, sources: SMAA, filtered: ["color", "area", "search"],
        tables: { area: "examples/gallery/smaa_area.png", search: "examples/gallery/smaa_search.png" }, bound: 2 ** -9, share: 0.99,
    },
].map((kernel) => ({ options: [], uniforms: {}, sources: [], filtered: [], tables: {}, ...kernel }));

/** Width and height of the picture that an engine is given. */
export function sizeOf(kernel, engine) {
    return engine?.even && kernel.even ? kernel.even : [WIDTH, HEIGHT];
}

/** Layers by the name of the texture, RGBA floats, rows from above. */
export function inputs({ scene, tables }, size = [WIDTH, HEIGHT]) {
    const color = [picture(size)];
    const read = ([name, path]) => [name, [Float32Array.from(table(path).data, (value) => value / 255)]];
    return {
        color,
        ...(scene ? { depth: depths(scene), normal: normals(scene) } : {}),
        ...Object.fromEntries(Object.entries(tables).map(read)),
    };
}

/** Width and height of the tables by the name of the texture. */
export function tableSizes({ tables }) {
    const size = ([name, path]) => [name, [table(path).width, table(path).height]];
    return Object.fromEntries(Object.entries(tables).map(size));
}

function table(path) {
    return PNG.sync.read(readFileSync(join(root, path)));
}

export { HEIGHT, WIDTH };
