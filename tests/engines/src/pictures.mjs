// Pictures that kernels are run on. Their sides are odd and unequal, and nothing in them is symmetric.

export const WIDTH = 61;
export const HEIGHT = 43;

// Numbers of a fixed sequence, 0 to 1.
function sequence(seed) {
    let state = seed >>> 0;
    return () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return state / 2 ** 32;
    };
}

/** A picture of stripes, discs and noise, RGBA, rows from above; levels of 8 bits, so that every engine can be given it exactly. */
export function picture([width, height]) {
    const random = sequence(1);
    const rgba = new Float32Array(4 * width * height);
    for (let y = 0; y < height; y++) {
        for (let x = 0; x < width; x++) {
            const disc = Math.hypot(x - 20, y - 14) < 9 ? 0.8 : 0.1;
            const stripe = (x + 2 * y) % 11 < 4 ? 0.6 : 0.25;
            const noise = 0.2 * random();
            const texel = [disc + noise * 0.5, stripe + noise, 0.1 + 0.8 * (y / height), 1];
            texel.forEach((value, c) => { rgba[4 * (y * width + x) + c] = Math.round(Math.min(value, 1) * 255) / 255; });
        }
    }
    return rgba;
}

/** Layers of depth for SRAA: a step, a slope and a disc, a little moved in each. One channel in four. */
export function depths(layers) {
    return Array.from({ length: layers }, (_, k) => each((x, y) => {
        const near = Math.hypot(x + 0.2 * k - 33, y - 0.15 * k - 20) < 12;
        const depth = near ? 4 + 0.01 * x : 9 + 0.02 * y;
        return [depth, depth, depth, 1];
    }));
}

/** Layers of normals for SRAA. */
export function normals(layers) {
    return Array.from({ length: layers }, (_, k) => each((x, y) => {
        const left = x + 0.3 * k + 0.4 * y < 40;
        return left ? [0, 0, 1, 1] : [Math.fround(0.6), 0, Math.fround(0.8), 1];
    }));
}

function each(texel) {
    const rgba = new Float32Array(4 * WIDTH * HEIGHT);
    for (let y = 0; y < HEIGHT; y++) {
        for (let x = 0; x < WIDTH; x++) rgba.set(texel(x, y), 4 * (y * WIDTH + x));
    }
    return rgba;
}
