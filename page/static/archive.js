// Files in a ZIP archive, as they are: for folders that are taken along.

const TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let remainder = byte;
  for (let bit = 0; bit < 8; bit++) remainder = (remainder >>> 1) ^ (remainder & 1 ? 0xedb88320 : 0);
  return remainder;
});

/** The checksum of ZIP, CRC-32. */
function checksum(bytes) {
  let remainder = 0xffffffff;
  for (const byte of bytes) remainder = TABLE[(remainder ^ byte) & 255] ^ (remainder >>> 8);
  return ~remainder >>> 0;
}

/** Numbers as little-endian bytes: `[value, width]` each. */
function packed(...fields) {
  const bytes = new Uint8Array(fields.reduce((sum, [, width]) => sum + width, 0));
  let at = 0;
  for (const [value, width] of fields) {
    for (let k = 0; k < width; k++) bytes[at++] = Math.floor(value / 256 ** k) & 255;
  }
  return bytes;
}

/** An archive of texts, by their names in `folder`. */
export function archive(folder, texts) {
  const encoder = new TextEncoder();
  const [parts, directory] = [[], []];
  let at = 0;
  for (const [name, text] of Object.entries(texts)) {
    const path = encoder.encode(`${folder}/${name}`);
    const bytes = encoder.encode(text);
    // Names in UTF-8, nothing compressed, 1 January 1980, so that equal files are equal archives.
    const about = [[20, 2], [0x800, 2], [0, 2], [0, 2], [0x21, 2], [checksum(bytes), 4], [bytes.length, 4], [bytes.length, 4], [path.length, 2], [0, 2]];
    const local = packed([0x04034b50, 4], ...about);
    parts.push(local, path, bytes);
    directory.push(packed([0x02014b50, 4], [20, 2], ...about, [0, 2], [0, 2], [0, 2], [0, 4], [at, 4]), path);
    at += local.length + path.length + bytes.length;
  }
  const count = Object.keys(texts).length;
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  const end = packed([0x06054b50, 4], [0, 2], [0, 2], [count, 2], [count, 2], [size, 4], [at, 4], [0, 2]);
  return new Blob([...parts, ...directory, end], { type: "application/zip" });
}
