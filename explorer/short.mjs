// What is called so often that it has a short name of its own in the built page (build.mjs injects it).

const { abs, atan2, ceil, cos, floor, hypot, max, min, PI, round, sin } = Math;
const { isFinite: finite } = Number;

export {
  abs as "Math.abs",
  atan2 as "Math.atan2",
  ceil as "Math.ceil",
  cos as "Math.cos",
  finite as "Number.isFinite",
  floor as "Math.floor",
  hypot as "Math.hypot",
  max as "Math.max",
  min as "Math.min",
  PI as "Math.PI",
  round as "Math.round",
  sin as "Math.sin",
};
