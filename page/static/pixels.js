// Pictures in linear light, and how they are shown.

/** The number that the bits of a 16-bit float stand for. */
export function halfToNumber(bits) {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 0x1f;
  const fraction = bits & 0x3ff;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/** The 8-bit sRGB value of linear light. What is no number is black. */
function srgb(value) {
  if (!(value > 0)) return 0;
  if (value >= 1) return 255;
  return Math.round(255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055));
}

let table = null;

/** The 8-bit sRGB value of every 16-bit float. */
function halfTable() {
  if (!table) {
    table = new Uint8Array(65536);
    for (let bits = 0; bits < 65536; bits++) table[bits] = srgb(halfToNumber(bits));
  }
  return table;
}

/** A picture: `data` has four components a pixel, rows from the top; a `Uint16Array` holds 16-bit floats. */
export class Pixels {
  constructor(width, height, data) {
    this.width = width;
    this.height = height;
    this.data = data;
  }

  /** The same as numbers: for tests and for whoever looks closer. */
  floats() {
    return this.data instanceof Uint16Array ? Float32Array.from(this.data, halfToNumber) : this.data;
  }

  /** As a canvas draws it: sRGB, opaque. */
  image() {
    const image = new ImageData(this.width, this.height);
    const to = image.data;
    const from = this.data;
    const encode = from instanceof Uint16Array ? ((table) => (v) => table[v])(halfTable()) : srgb;
    for (let k = 0; k < from.length; k += 4) {
      to[k] = encode(from[k]);
      to[k + 1] = encode(from[k + 1]);
      to[k + 2] = encode(from[k + 2]);
      to[k + 3] = 255;
    }
    return image;
  }
}

/** Numbers of a component's type from the letter that WGSL ends a vector's type with. */
const SETTERS = { f: "setFloat32", i: "setInt32", u: "setUint32" };

/** Letter and count of components of a type as WGSL spells it: `f32`, `vec3i`, ... */
export function components(type) {
  const vector = /^vec([234])([fiu])$/.exec(type);
  if (vector) return { letter: vector[2], count: Number(vector[1]) };
  return /^[fiu]32$/.test(type) ? { letter: type[0], count: 1 } : null;
}

/** A uniform buffer's bytes: `values` has a list of numbers for each field's name. */
export function uniformBytes(block, values) {
  const view = new DataView(new ArrayBuffer(block.size));
  for (const field of block.fields) {
    const given = components(field.type);
    if (!given) throw new Error(`the uniform \`${field.name}\` is a ${field.type}, which the page cannot set`);
    const numbers = values[field.name] ?? [];
    for (let k = 0; k < given.count; k++) {
      view[SETTERS[given.letter]](field.offset + 4 * k, numbers[k] ?? 0, true);
    }
  }
  return view.buffer;
}
