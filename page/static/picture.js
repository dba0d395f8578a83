// The visitor's own picture: chosen, dropped or pasted.

/** Longest side of a picture that is filtered, in pixels; larger ones are reduced. */
const LONGEST = 2048;

/** Width, height and bytes of sRGB and alpha of an image file. */
export async function decode(file) {
  let bitmap;
  try {
    bitmap = await createImageBitmap(file);
  } catch {
    throw new Error(`\`${file.name || "what was pasted"}\` is no picture that this browser reads: give a PNG, JPEG, WebP or AVIF`);
  }
  const scale = Math.min(1, LONGEST / Math.max(bitmap.width, bitmap.height));
  const width = Math.max(1, Math.round(bitmap.width * scale));
  const height = Math.max(1, Math.round(bitmap.height * scale));
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  context.imageSmoothingQuality = "high";
  context.drawImage(bitmap, 0, 0, width, height);
  bitmap.close();
  const { data } = context.getImageData(0, 0, width, height);
  return { size: { width, height }, bytes: new Uint8Array(data.buffer), reduced: scale < 1 };
}

/** Calls `take` with each picture that the visitor gives, and `refuse` with a message for what is none. */
export function listen(input, take, refuse) {
  const offer = (file) => file && decode(file).then(take).catch((error) => refuse(error.message));
  input.addEventListener("change", () => {
    offer(input.files[0]);
    input.value = "";
  });
  document.addEventListener("dragover", (event) => {
    if (!event.dataTransfer.types.includes("Files")) return;
    event.preventDefault();
    document.body.classList.add("dropping");
  });
  const end = () => document.body.classList.remove("dropping");
  document.addEventListener("dragleave", (event) => event.relatedTarget ?? end());
  document.addEventListener("drop", (event) => {
    end();
    if (!event.dataTransfer.files.length) return;
    event.preventDefault();
    offer(event.dataTransfer.files[0]);
  });
  document.addEventListener("paste", (event) => {
    if (event.clipboardData.files.length) offer(event.clipboardData.files[0]);
  });
}
