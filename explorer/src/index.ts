export { Kernel } from "./kernel";
export { Machine } from "./machine";
export { programOf } from "./program";
