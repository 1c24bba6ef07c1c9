// What is called so often that it has a short name of its own in the built page (build.mjs injects it).

const { abs, atan2, ceil, cos, floor, hypot, max, min, PI, round, sin } = Math;
const { isFinite: finite } = Number;
const { from } = Array;
const { parse, stringify } = JSON;
const [Amount, Numbers, Text] = [Number, Float64Array, String];

export {
  Amount as Number,
  abs as "Math.abs",
  atan2 as "Math.atan2",
  ceil as "Math.ceil",
  cos as "Math.cos",
  finite as "Number.isFinite",
  floor as "Math.floor",
  from as "Array.from",
  hypot as "Math.hypot",
  max as "Math.max",
  min as "Math.min",
  Numbers as Float64Array,
  PI as "Math.PI",
  parse as "JSON.parse",
  round as "Math.round",
  sin as "Math.sin",
  stringify as "JSON.stringify",
  Text as String,
};
