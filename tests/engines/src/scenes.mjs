// Scenes that engines render themselves: a kernel that reads their depth has to get the distance along the view.

import { HEIGHT, WIDTH } from "./pictures.mjs";

/** Vertical field of view in degrees, planes of the camera, and the slope of a plane that fills the picture. */
export const SCENE = { fov: 50, near: 0.5, far: 40, distance: 6, slope: 0.5, color: [0.25, 0.5, 0.75], width: WIDTH, height: HEIGHT };

/**
 * Engines with depth of their own, and the emitted files that their pages import; `opaque` where alpha ends at 1,
 * `native` where no page runs them.
 */
export const SCENES = [
    { name: "three, WebGLRenderer", engine: "three", page: "scene-three", file: (k) => `${k}-pass.js` },
    { name: "three, WebGLRenderer, orthographic", engine: "three", page: "scene-three", file: (k) => `${k}-pass.js`, parallel: true },
    { name: "three, WebGLRenderer, reversed depth", engine: "three", page: "scene-three", file: (k) => `${k}-pass.js`, reversed: true },
    { name: "three, WebGPURenderer", engine: "three", page: "scene-three", file: (k) => `${k}-node.js`, webgpu: true },
    { name: "postprocessing", engine: "postprocessing", page: "scene-postprocessing", file: (k) => `${k}-effect.js`, opaque: true },
    { name: "babylon, WebGL 2", engine: "babylon", page: "scene-babylon", file: (k) => `${k}-post-process.js` },
    { name: "babylon, WebGPU", engine: "babylon", page: "scene-babylon", file: (k) => `${k}-post-process.js`, webgpu: true },
    { name: "panda3d", engine: "panda3d", native: "panda3d" },
];

/** Planes and projection of the camera, as `kernels/lens.rs` has them. */
function planes({ parallel }) {
    const { fov, near, far, distance } = SCENE;
    const up = Math.tan((fov * Math.PI) / 360) * (parallel ? distance : 1);
    const texel = [near, far, HEIGHT / (WIDTH * up), up];
    return Float32Array.from({ length: 4 * WIDTH * HEIGHT }, (_, k) => texel[k % 4]);
}

/** The target's size and each pixel's place, as `kernels/grid.rs` has them. */
function places({ opaque }) {
    const rgba = new Float32Array(4 * WIDTH * HEIGHT);
    for (let y = 0; y < HEIGHT; y++) {
        for (let x = 0; x < WIDTH; x++) rgba.set([WIDTH, HEIGHT, x, opaque ? Math.min(y, 1) : y], 4 * (y * WIDTH + x));
    }
    return rgba;
}

/** The scene in the fog of `kernels/fog.rs`, rows from above: RGB, and the distance in alpha. */
function foggy({ parallel, opaque }) {
    const { fov, distance, slope, color } = SCENE;
    const up = Math.tan((fov * Math.PI) / 360);
    const rgba = new Float32Array(4 * WIDTH * HEIGHT);
    for (let y = 0; y < HEIGHT; y++) {
        // Height of the ray through a row at distance 1. The plane leans away from the viewer below.
        const ray = up * (1 - (2 * (y + 0.5)) / HEIGHT);
        const far = parallel ? distance - distance * ray * Math.tan(slope) : distance * Math.cos(slope) / (Math.sin(slope) * ray + Math.cos(slope));
        const seen = Math.exp(-0.125 * far);
        const texel = [...color.map((value) => value * seen + 0.5 * (1 - seen)), opaque ? 1 : far];
        for (let x = 0; x < WIDTH; x++) rgba.set(texel, 4 * (y * WIDTH + x));
    }
    return rgba;
}

/** The picture of half the size of `kernels/halves.rs`: the place of its pixel that each pixel reads, and its width and height. */
function halves() {
    const [w, h] = [WIDTH, HEIGHT].map((side) => Math.floor(side / 2));
    const rgba = new Float32Array(4 * WIDTH * HEIGHT);
    for (let y = 0; y < HEIGHT; y++) {
        for (let x = 0; x < WIDTH; x++) {
            const place = [Math.min(x >> 1, w - 1), Math.min(y >> 1, h - 1)];
            rgba.set([...place, w + SCENE.color[0], h], 4 * (y * WIDTH + x));
        }
    }
    return rgba;
}

/** The kernels, the picture that each has to make, and the engines that have what it reads. */
export const FILTERS = [
    { name: "fog", expected: foggy, engines: SCENES.map(({ name }) => name) },
    { name: "grid", expected: places, engines: SCENES.map(({ name }) => name) },
    { name: "lens", expected: planes, engines: SCENES.map(({ name }) => name).filter((name) => /^(three|babylon)/.test(name)) },
    { name: "halves", expected: halves, engines: SCENES.map(({ name }) => name).filter((name) => /^three/.test(name)) },
];
