// What is called so often that it has a short name of its own in the built page (build.mjs injects it).

const { abs, atan2, ceil, cos, floor, hypot, max, min, PI, round, sin } = Math;
const { isFinite: finite } = Number;
const { from, isArray } = Array;
const { assign, entries, fromEntries } = Object;
const { clearTimeout: stop, document: page, requestAnimationFrame: next, setTimeout: wait } = globalThis;
const { parse, stringify } = JSON;
const [Amount, Numbers, Text] = [Number, Float64Array, String];

export {
  Amount as Number,
  abs as "Math.abs",
  assign as "Object.assign",
  atan2 as "Math.atan2",
  ceil as "Math.ceil",
  cos as "Math.cos",
  entries as "Object.entries",
  finite as "Number.isFinite",
  floor as "Math.floor",
  from as "Array.from",
  fromEntries as "Object.fromEntries",
  hypot as "Math.hypot",
  isArray as "Array.isArray",
  max as "Math.max",
  min as "Math.min",
  Numbers as Float64Array,
  next as requestAnimationFrame,
  PI as "Math.PI",
  page as document,
  parse as "JSON.parse",
  round as "Math.round",
  sin as "Math.sin",
  stop as clearTimeout,
  stringify as "JSON.stringify",
  Text as String,
  wait as setTimeout,
};
