// OpenEXR as the command line reads and writes it: floats, scanlines. Writing is uncompressed.

import { EXRLoader } from "three/addons/loaders/EXRLoader.js";
import { FloatType } from "three";
import { readFileSync, writeFileSync } from "node:fs";

/** Writes RGBA floats, rows from above. */
export function writeExr(path, width, height, rgba) {
    const parts = [];
    const bytes = (...values) => parts.push(Buffer.from(values));
    const int = (value) => { const b = Buffer.alloc(4); b.writeInt32LE(value); parts.push(b); };
    const float = (value) => { const b = Buffer.alloc(4); b.writeFloatLE(value); parts.push(b); };
    const text = (value) => parts.push(Buffer.from(value + "\0", "latin1"));
    const attribute = (name, type, size) => { text(name); text(type); int(size); };
    int(20000630);
    int(2);
    attribute("channels", "chlist", 4 * 18 + 1);
    for (const channel of "ABGR") { text(channel); int(2); bytes(0, 0, 0, 0); int(1); int(1); }
    bytes(0);
    attribute("compression", "compression", 1); bytes(0);
    for (const window of ["dataWindow", "displayWindow"]) {
        attribute(window, "box2i", 16); int(0); int(0); int(width - 1); int(height - 1);
    }
    attribute("lineOrder", "lineOrder", 1); bytes(0);
    attribute("pixelAspectRatio", "float", 4); float(1);
    attribute("screenWindowCenter", "v2f", 8); float(0); float(0);
    attribute("screenWindowWidth", "float", 4); float(1);
    bytes(0);
    const head = Buffer.concat(parts);
    const line = 8 + 16 * width;
    const file = Buffer.alloc(head.length + 8 * height + line * height);
    head.copy(file);
    for (let y = 0; y < height; y++) {
        const at = head.length + 8 * height + line * y;
        file.writeBigUInt64LE(BigInt(at), head.length + 8 * y);
        file.writeInt32LE(y, at);
        file.writeInt32LE(16 * width, at + 4);
        [3, 2, 1, 0].forEach((channel, k) => {
            for (let x = 0; x < width; x++) {
                file.writeFloatLE(rgba[4 * (y * width + x) + channel], at + 8 + 4 * (k * width + x));
            }
        });
    }
    writeFileSync(path, file);
}

/** Reads RGBA floats, rows from above. */
export function readExr(path) {
    const bytes = readFileSync(path);
    const loader = new EXRLoader();
    loader.setDataType(FloatType);
    const { width, height, data } = loader.parse(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
    // The loader turns the rows, as textures of WebGL have them.
    const rgba = new Float32Array(4 * width * height);
    for (let y = 0; y < height; y++) {
        rgba.set(data.subarray(4 * width * (height - 1 - y), 4 * width * (height - y)), 4 * width * y);
    }
    return { width, height, rgba };
}
