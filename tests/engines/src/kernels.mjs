// The kernels that every engine is given, and what they read.

import { HEIGHT, WIDTH, depths, normals, picture } from "./pictures.mjs";

const GALLERY = "kernels/filters";

/**
 * `bound` is the difference that a value may have from the interpreter's, in floats; `share` how many of the values are within it:
 * a filter that decides by comparing lets a rounding decide otherwise now and then. Where the kernel has its picture filtered, the
 * bound is that of drivers whose weights have 8 bits. `uniforms` are set in the engine too.
 */
export const KERNELS = [
    { name: "orientation", kernel: "tests/engines/kernels/orientation.rs", bound: 2e-7, share: 1 },
    { name: "kuwahara", kernel: `${GALLERY}/kuwahara.rs`, bound: 1e-5, share: 0.99 },
    { name: "bilateral", kernel: `${GALLERY}/bilateral.rs`, options: ["sigma=uniform"], uniforms: { sigma: 2.25 }, bound: 1e-5, share: 1 },
    { name: "fxaa", kernel: `${GALLERY}/fxaa.rs`, filtered: "color", bound: 2 ** -9, share: 0.99 },
    { name: "sraa4", kernel: "sraa", scene: 5, bound: 1e-5, share: 1 },
    { name: "sraa16", kernel: "sraa", options: ["pattern=latin16"], scene: 17, bound: 1e-5, share: 1 },
    { name: "pcf", kernel: "pcf", refused: true, bound: 0, share: 1 },
].map((kernel) => ({ options: [], uniforms: {}, ...kernel }));

/** Layers by the name of the texture, RGBA floats, rows from above. */
export function inputs({ scene }) {
    const color = [picture()];
    return scene ? { color, depth: depths(scene), normal: normals(scene) } : { color };
}

export { HEIGHT, WIDTH };
