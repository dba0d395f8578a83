export { runWebGpu as run } from "./pixi.js";
