export { runWebGpu as run } from "./babylon.js";
