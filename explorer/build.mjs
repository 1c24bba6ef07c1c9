// Builds the page into the folder given, else into the package: an ES module and its style sheet, kernel and texts,
// one more module for static sites, one for their synthesis, one for linkages in space and what adds to the sheet.

import { readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";
import zopfli from "@gfx/zopfli";
import { parse as acorn } from "acorn";
import { build } from "esbuild";
import { minify } from "terser";

const here = path.dirname(fileURLToPath(import.meta.url));
const target = process.argv[2] ?? path.join(here, "../src/gruebler/page/static");

// All of ASCII that may stand in a text of a script within a page.
const SIGNS = Array.from({ length: 127 }, (_, k) => String.fromCharCode(k + 1)).filter(
  (sign) => !/["<\\\n\r]/.test(sign),
);

/** Bytes as text: 97 in 112 of the 122 signs, 122^112 > 256^97; of the last n, if they are fewer, n + 15. */
function written(bytes) {
  let text = "";
  for (let at = 0; at < bytes.length; at += 97) {
    const some = bytes.subarray(at, at + 97);
    let value = some.reduce((sum, byte) => 256n * sum + BigInt(byte), 0n);
    let group = "";
    for (let k = 0; k < some.length + 15; k++) {
      group = SIGNS[value % 122n] + group;
      value /= 122n;
    }
    text += group;
  }
  return text;
}

/** Texts that stand in the modules in the end only: the bundler would write signs out, "\\x01". */
const kept = [];

/** What stands for packed bytes until then: a name, of which no minifier counts the letters. */
function standIn(bytes) {
  return `packed_${kept.push(written(bytes)) - 1}`;
}

const german = JSON.parse(await readFile(path.join(here, "src/de.json"), "utf8"));
const texts = besideTheirLike(Object.keys(german).sort());
const literal = /"(?:[^"\\]|\\.)*"/g;

/** Each text behind the one with which it has most sequences of three signs in common, in both languages: so they pack
 * smaller. */
function besideTheirLike([first, ...others]) {
  const pieces = (text) => {
    const both = `\n${text}\n${german[text]}\n`;
    return new Set(Array.from(both, (_, k) => both.slice(k, k + 3)));
  };
  const all = new Map([first, ...others].map((text) => [text, pieces(text)]));
  const chosen = [first];
  const left = new Set(others);
  while (left.size) {
    const last = all.get(chosen.at(-1));
    const worth = (text) => [...last].filter((piece) => all.get(text).has(piece)).length / text.length ** 0.4;
    const next = [...left].reduce((one, other) => (worth(other) > worth(one) ? other : one));
    chosen.push(next);
    left.delete(next);
  }
  return chosen;
}

/** `t("Play")` with the number of its text in the table, which stands packed beside the module. */
function numbered(source) {
  return source.replace(/\bt\(\s*("(?:[^"\\]|\\.)*"(?:\s*\+\s*"(?:[^"\\]|\\.)*")*)\s*(?=[,)])/g, (call, text) => {
    const number = texts.indexOf(text.match(literal).map(JSON.parse).join(""));
    return number < 0 ? call : `t(${number}`;
  });
}

/** `h("p", {}, text)` and `h("p", {})` without their attributes, which are none. */
function bare(source) {
  return source.replace(/\b(h|svg)\((\s*"[\w.-]+"),\s*\{\}(?=[,)])/g, "$1($2");
}

/** `void this.save()` without its first word, which is for those who read: nobody takes what comes of it. */
function given(source) {
  return source.replace(/\bvoid (?=\w+\.)/g, "");
}

/** `#name` of a class as a property that gets a short name (`mangleProps`), the most used ones of a file the same ones
 * everywhere: that nobody looks into it from outside has been checked before. */
function unveiled(source) {
  const hidden = /(?<=[\w)]\.|^ +(?:(?:static|readonly|async|get|set) )*)#([a-z]\w*)/gm;
  const counts = new Map();
  for (const [, name] of source.matchAll(hidden)) counts.set(name, (counts.get(name) ?? 0) + 1);
  const names = [...counts.keys()].sort((one, other) => counts.get(other) - counts.get(one));
  return source.replace(hidden, (_, name) => `hidden${names.indexOf(name)}`);
}

/** Texts are numbers; the kernel of synthesis stands packed in its module. */
const packed = {
  name: "packed",
  setup: ({ onLoad }) => {
    onLoad({ filter: /src.[\w-]+\.ts$/ }, async ({ path: file }) => {
      return { contents: unveiled(given(bare(numbered(await readFile(file, "utf8"))))), loader: "ts" };
    });
    onLoad({ filter: /\.gz$/ }, async ({ path: file }) => {
      const contents = `import { bytesOf } from "./packed";\nexport default bytesOf(${standIn(await readFile(file))});`;
      return { contents, loader: "js", resolveDir: path.join(here, "src") };
    });
  },
};

/** Long names of methods and fields of the page's own, which get short ones; nobody outside, neither tests nor the
 * library, calls them. */
const own = `
  measuring showRange showPose showValue adding addPoint appeared arrange atFrame cancelDrag changeSlowly dragCancel
  endFall driveName jointSymbol outputStandsStill refining
  dragEnd dragPoint dragStart editor element elementAt elementsOf elementsOn falling forget holdJoint knot
  jointName leftOf lineFirst linkList linkName moveJointBy movePointBy openDocument openFile
  pan paused picked pickWithin playAt plottedAngle pointed pointName poleAside possible present recoloured runAlong
  degrees fitted measured nudge recall spots
  longest margin inSpace advance destroy elsewhere emit follow heads letterOf posed showKeys taken undoing
  keepInside served setAdding setLength setTheme shiftLine shownDesign showPose showRange showValue
  narrow leader waits covers spokes distances grounds
  ahead legend lowest seconds settled stretched tools written
  arrows columns keepLoads sized snapping switchMode toLocal turnTo upright writeSizes
`.match(/\w+/g);

/** Long names that others call, too, above all the browser's own, and that stand in a module again and again. */
const often = `
  activeElement backward fromCharCode getAttribute members onpointerdown placeholder reverse toPrecision
  offsetHeight replaceState splice
  accelerations active addEventListener angles append appendChild arrayBuffer ArrowRight attempt
  backend beginPath beside between bodies bottom button cancel canvas catalog chains change changed
  charCodeAt checked childElementCount children choose chosen circle class classList clientWidth
  clientX clientY closed colour conditions contains count counted ctrlKey cursor cycle cylinder dataset
  delete describe designs direction document documentElement domain draggable dragging dragJoint
  drawImage drawing drive drives elements entries error every exercises filter find findIndex firstChild
  flatMap focus forces forEach found frame frames fresh from fromCharCode full function generic
  getAttribute getBoundingClientRect getContext getPropertyValue ground gruebler hasAttribute hash
  height hidden hodographs includes indexOf inflection inputmode inversions isConnected items join
  joint jointAt joints keys kind knot knots lastChild length lengths lines link linkage linkCount links
  listeners locks masses matches measured message missing mobility model motion moveTo name near number
  onchange onclick onkeydown open operations output outputs overconstrained page parentElement parts
  pause pending pick picture pieces places player playing plots pointerId pointerType points pose
  positions preventDefault preventScroll program progress push querySelector querySelectorAll quick
  range reached redraw reduce reference reference_pose refused remove removeAttribute replace
  replaceAll replaceChildren replaceWith restore right root roots rows rulers scale screen
  scrollIntoView scrollTop selected selectedIndex setAttribute setPointerCapture setProperty shift
  shiftKey show shown side sides signs size sizes slice slider snapshot some sort source sources speed
  split spots springs stage start startsWith state status stiffness stopPropagation stroke structure
  style synthesis tabindex tagName targets test text textContent title toFixed together toggle
  toLowerCase toUpperCase transform transmission transport trim turning turns unit unknowns unshift
  design history location point undoable variant
  loads offsetLeft order plane value values velocities view viewBox viewport views width windings world zoom
`.match(/\w+/g);

/** These names, as members and as keys, and what else stands there as often, as constants: texts that are keys or
 * operands, told by the signs beside them (not values in a selector, `[role="tab"]`), and `void 0`. */
function shared(code) {
  const taken = new Set(code.match(/[\w$]+/g));
  const letters = [..."abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"];
  const pairs = letters.flatMap((one) => letters.map((other) => one + other));
  const unused = pairs.filter((pair) => !taken.has(pair) && !/^(do|if|in|of)$/.test(pair));
  const repeated = /(?<=[([{,=?:&|+>])(?<!\[[a-z-]+=)"([\w .#-]{4,60})"(?=[)\]},?:;&|+])/g;
  const names = `(${often.join("|")})`;
  // texts are passed over
  const member = new RegExp(`"(?:[^"\\\\]|\\\\.)*"|(\\?\\.|\\.)${names}\\b|([{,])${names}(?=:)|\\bvoid 0`, "g");
  const counts = new Map();
  const count = (text) => counts.set(text, (counts.get(text) ?? 0) + 1);
  const wanted = (text, named) => (text === "void 0" ? text : named && `"${named}"`);
  for (const [text] of code.matchAll(repeated)) count(text);
  for (const [text, , called, , key] of code.matchAll(member)) count(wanted(text, called ?? key));
  counts.delete(undefined); // of texts
  const long = [...counts]
    .filter(([text, times]) => (times - 1) * (text.length - 5) > 9)
    .sort(([, one], [, other]) => other - one) // the shortest names are given first
    .map(([text]) => text);
  const name = (text) => unused[long.indexOf(text)];
  const made = code
    .replace(repeated, (text, _, at) => {
      if (!long.includes(text)) return text;
      return "{,".includes(code[at - 1]) && code[at + text.length] === ":" ? `[${name(text)}]` : name(text);
    })
    .replace(member, (text, dot, called, before, key) => {
      const short = name(wanted(text, called ?? key));
      if (!short || text === "void 0") return short ?? text;
      return `${before ?? (dot === "." ? "" : dot)}[${short}]`;
    });
  return long.length ? `const ${long.map((text) => `${name(text)}=${text}`).join()};${made}` : code;
}

/** Functions of the module as arrows, `function f(x) {}` as `f = (x) => {}`, before all else: they are as early there.
 * Those with a `this` of their own and generators stay. */
function arrowed(code) {
  const { body } = acorn(code, { ecmaVersion: 2022, sourceType: "module" });
  const text = ({ start, end }) => code.slice(start, end);
  const bound = (node) =>
    node?.type === "ThisExpression" ||
    (node?.type === "Identifier" && node.name === "arguments") ||
    (typeof node === "object" && node?.type !== "ClassBody" && Object.values(node ?? {}).some(bound));
  const made = (node) => node.type === "FunctionDeclaration" && !node.generator && !bound(node);
  const arrows = body
    .filter(made)
    .map(
      ({ async, id, params, body: does }) => `${id.name}=${async ? "async" : ""}(${params.map(text)})=>${text(does)}`,
    );
  const rest = body.filter((node) => !made(node)).map(text);
  return (arrows.length ? `const ${arrows};` : "") + rest.join("\n");
}

/** What the bundler leaves: statements joined, functions called once put where they are called. Functions without
 * `this` become arrows. Reads whose value nobody uses are left out: no getter of the page does anything else. */
const SMALLER = {
  module: true,
  compress: { ecma: 2020, passes: 6, pure_getters: true, unsafe_arrows: true },
};

const { outputFiles } = await build({
  absWorkingDir: here,
  entryPoints: {
    explorer: "src/index.ts",
    site: "src/site/index.ts",
    points: "src/points/index.ts",
    space: "src/space/index.ts",
  },
  outdir: target,
  bundle: true,
  inject: [path.join(here, "short.mjs")],
  format: "esm",
  target: "es2022",
  minify: true,
  mangleProps: new RegExp(`^(hidden\\d+|${own.join("|")})$`),
  charset: "utf8",
  legalComments: "none",
  plugins: [packed],
  write: false,
});
for (const { path: file, text } of outputFiles) {
  const { code } = await minify(shared(arrowed(text)), SMALLER);
  await writeFile(
    file,
    code.replace(/\bpacked_(\d+)/g, (_, number) => `"${kept[number]}"`),
  );
}

// All of one language, then all of the other: what is alike stands nearer.
const lines = [...texts, ...texts.map((one) => german[one])].join("\n");
const beside = {
  motion: await readFile(path.join(here, "../core/page/motion.wasm.gz")),
  texts: await zopfli.gzipAsync(Buffer.from(lines), { numiterations: 60 }),
};
for (const [name, bytes] of Object.entries(beside)) await writeFile(path.join(target, `${name}.txt`), written(bytes));

/** Declarations in the order of their names, in which they pack smaller. */
function ordered(sheet) {
  const name = (declaration) => declaration.split(":", 1)[0];
  return sheet.replace(/\{([^{}]*)\}/g, (_, list) => {
    const sorted = list.split(";").sort((one, other) => (name(one) < name(other) ? -1 : +(name(one) > name(other))));
    return `{${sorted.join(";")}}`;
  });
}

// Before the script is there nobody but the browser knows which colours are wanted: dark ones stand there twice.
const night = /:host\(\[data-theme="dark"\]\)(\{[^}]*\})/;
const both = "$&@media (prefers-color-scheme:dark){:host(:not([data-theme]))$1}";
for (const [name, source] of Object.entries({ explorer: "src/style.css", space: "src/space/space.css" })) {
  const options = { bundle: true, charset: "utf8", minify: true, write: false };
  const [sheet] = (await build({ absWorkingDir: here, entryPoints: [source], ...options })).outputFiles;
  await writeFile(path.join(target, `${name}.css`), ordered(sheet.text.trim()).replace(night, both));
}
