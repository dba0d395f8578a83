/** The picture with its rows in the other order. */
export function turned(rgba, width, height) {
    const made = new Float32Array(rgba.length);
    for (let y = 0; y < height; y++) made.set(rgba.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
    return made;
}

/** All layers, one after the other, each with its rows in the other order if `turn`. */
export function stacked(layers, width, height, turn) {
    const made = new Float32Array(4 * width * height * layers.length);
    layers.forEach((layer, k) => made.set(turn ? turned(layer, width, height) : layer, 4 * width * height * k));
    return made;
}
