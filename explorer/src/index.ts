export { Kernel } from "./kernel";
export { programOf } from "./program";
