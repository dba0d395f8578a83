export { runWebGpu as run } from "./playcanvas.js";
