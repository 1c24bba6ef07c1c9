/** Signs of buttons, drawn as lines on a square of 20. */

import { svg } from "./dom";

const PATHS = {
  undo: "M8 4L4 8l4 4M4 8h8a4 4 0 0 1 0 8H9",
  redo: "M12 4l4 4-4 4M16 8H8a4 4 0 0 0 0 8h3",
  open: "M3 16V4h5l2 2h7v10zM10 14V9M7.5 11.5L10 9l2.5 2.5",
  save: "M3 3h11l3 3v11H3zM6 3v4h7V3M6 17v-6h8v6",
  link: "M8.5 11.5l3-3M9 6l2-2a3.5 3.5 0 0 1 5 5l-2 2M11 14l-2 2a3.5 3.5 0 0 1-5-5l2-2",
  theme: "M10 3a7 7 0 1 0 0 14zM10 3a7 7 0 0 1 0 14",
  keys: "M2.5 5h15v10h-15zM5.5 8h1M9.5 8h1M13.5 8h1M6.5 12h7",
  fit: "M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4",
  point: "M10 3v5M10 12v5M3 10h5M12 10h5M10 9.5v1",
  more: "M10 4v12M4 10h12",
  lock: "M5 9h10v8H5zM7 9V6a3 3 0 0 1 6 0v3",
  less: "M4 10h12",
  move: "M5 3l11 7-5 1.2L8.5 16z",
  ground: "M10 4L5 13h10zM3 13h14M6 13l-2 3M11 13l-2 3M16 13l-2 3",
  bar: "M5 15L15 5M2.5 16a1 1 0 103 0 1 1 0 10-3 0M14.5 4a1 1 0 103 0 1 1 0 10-3 0",
  slider: "M6 6h8v6H6zM2 14h16M6 14l-2 3M11 14l-2 3M16 14l-2 3",
  dyad: "M3 16L9 6.5M11 6.5L17 16M8.5 5a1 1 0 103 0 1 1 0 10-3 0",
  cylinder: "M2 7h9v6H2zM11 10h7",
  gears: "M2 11a1 1 0 108 0 1 1 0 10-8 0M10 11a1 1 0 107 0 1 1 0 10-7 0",
  play: "M6 4l9 6-9 6z",
  angle: "M17 16H3L13 4M11 16a8 8 0 0 0-2.8-6",
} as const;

export type Icon = keyof typeof PATHS;

export function icon(name: Icon): SVGElement {
  return svg("svg.icon", { viewBox: "0 0 20 20", "aria-hidden": "true" }, svg("path", { d: PATHS[name] }));
}
