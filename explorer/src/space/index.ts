// The page of a linkage in space: go round it, play it, pull a drive or a link, see the paths of points.

import { axes, before, type Camera, meeting, moved, projection, ray, seen, type Vector } from "./algebra";
import { type Body, Painter } from "./painter";
import { type Live, Solver } from "./solver";

interface Motion {
  /** Its number. */
  drive: number;
  round: boolean;
  unit: string;
  /** (rows) of the drive. */
  values: number[];
  /** (rows, links, 12). */
  poses: number[][][];
}

interface Texts {
  title: string;
  drives: string[];
  words: { play: string; stop: string; drive: string; help: string; none: string; end: string; flat: string };
}

interface Model {
  texts: Record<string, Texts>;
  middle: Vector;
  size: number;
  bodies: Body[];
  points: { name: string; link: number; at: Vector }[];
  motions: Motion[];
  /** What moves several drives together; with one drive its motion is there. */
  live: Live | null;
}

const SECONDS = 4;
const NEAR = 8; // rows before and behind among which a pulled link looks for its place
const WHOLE = 2.3; // distances of the eye from the middle of a ball that fills the picture, in its radii
const STILL = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

const model: Model = JSON.parse(document.getElementById("gruebler-model")!.textContent!);
const asked = location.hash.slice(1);
const language = asked in model.texts ? asked : document.documentElement.lang;
const { title, drives, words } = model.texts[language]!;
document.title = title;
const dark = matchMedia("(prefers-color-scheme: dark)").matches;
const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;

function element<K extends keyof HTMLElementTagNameMap>(
  kind: K,
  parent: HTMLElement,
  style: Partial<CSSStyleDeclaration> = {},
  text = "",
): HTMLElementTagNameMap[K] {
  const made = document.createElement(kind);
  Object.assign(made.style, style);
  made.textContent = text;
  parent.append(made);
  return made;
}

const ink = dark ? "#eee" : "#222";
Object.assign(document.body.style, { margin: "0", font: "16px system-ui, sans-serif", color: ink, overflow: "hidden" });
Object.assign(document.body.style, { display: "flex", flexDirection: "column", height: "100dvh" });
Object.assign(document.body.style, { background: dark ? "#171717" : "#fff", colorScheme: dark ? "dark" : "light" });
const bar = element("header", document.body, {
  display: "flex",
  flexWrap: "wrap",
  gap: "0.8em",
  alignItems: "center",
  padding: "0.6em 1em",
});
element("h1", bar, { font: "600 1em system-ui, sans-serif", margin: "0.3em 0" }, title);
const canvas = element("canvas", document.body, { flex: "1", minHeight: "0", touchAction: "none", cursor: "grab" });
canvas.tabIndex = 0;
canvas.setAttribute("role", "img");
canvas.setAttribute("aria-label", `${title}. ${words.help}`);
element("p", document.body, { margin: "0", padding: "0.5em 1em", fontSize: "0.85em" }, words.help);

const camera: Camera = { turn: 0.9, lift: 0.55, ...framed() };
let motion = model.motions[0];
let row = 0;
let playing = motion !== undefined && !calm;
let pulled: { link: number; at: Vector } | undefined;
let traced: { link: number; at: Vector } | undefined;

const room = matchMedia("(pointer: coarse)").matches ? "44px" : ""; // for a finger
const button = element("button", bar, { font: "inherit", minWidth: "5em", minHeight: room });
const label = element("label", bar, {
  display: "flex",
  flexWrap: "wrap",
  gap: "0.5em",
  alignItems: "center",
  flex: "1",
});
const choice = element("select", label, { font: "inherit", minHeight: room, maxWidth: "100%" });
const slider = element("input", label, { flex: "1", minWidth: "8em", minHeight: room });
const value = element("output", label, { minWidth: "5em" });
slider.type = "range";
slider.step = "any";
slider.setAttribute("aria-label", words.drive);
choice.setAttribute("aria-label", words.drive);
for (const each of model.motions) element("option", choice, {}, drives[each.drive]);
if (!motion) label.replaceChildren(words.none);

// --- several drives ---

const { live } = model;
const solver = live ? new Solver(live, model.size, model.middle, model.bodies.length) : undefined;
const TRAIL = 600; // places of a point that are remembered
let trails: Vector[][] = [];
let chosen = 0;
let ended = false; // the chosen drive could not go where it was sent
const sliders: { input: HTMLInputElement; output: HTMLOutputElement }[] = [];
if (solver && live) {
  label.remove();
  const all = element("div", bar, { display: "flex", flexWrap: "wrap", gap: "0.2em 1em", flex: "1 1 100%" });
  live.drives.forEach(({ low, high }, k) => {
    const own = element("label", all, { display: "flex", gap: "0.4em", alignItems: "center", fontSize: "0.85em" });
    element("span", own, {}, drives[k]);
    const input = element("input", own, { width: "9em", minHeight: room });
    Object.assign(input, { type: "range", min: String(low), max: String(high), step: "any", value: "0" });
    input.addEventListener("input", () => {
      chosen = k;
      playing = false;
      const to = Number(input.value);
      together(k, live.drives[k]!.round ? to + 2 * Math.PI * Math.round((solver.values[k]! - to) / (2 * Math.PI)) : to);
    });
    sliders.push({ input, output: element("output", own, { minWidth: "4.5em" }) });
  });
}

/** A camera that sees all bodies in all positions. */
function framed(): { middle: Vector; distance: number } {
  const all = model.motions.flatMap(({ poses }) => poses);
  const positions = all.filter((_, k) => k % Math.ceil(all.length / 24) === 0);
  const still = model.bodies.map(() => STILL);
  const places = (positions.length ? positions : [still]).flatMap((poses) =>
    model.bodies.flatMap(({ vertices }, link) => {
      const corners = Array.from({ length: vertices.length / 3 }, (_, k) => vertices.slice(3 * k, 3 * k + 3) as Vector);
      return corners.map((corner) => moved(poses[link]!, corner));
    }),
  );
  const ends = [0, 1, 2].map((axis) => {
    const values = places.map((place) => place[axis]!);
    return [values.reduce((a, b) => Math.min(a, b), Infinity), values.reduce((a, b) => Math.max(a, b), -Infinity)];
  });
  const middle = ends.map(([low, high]) => (low! + high!) / 2) as Vector;
  const far = places.reduce((most, place) => Math.max(most, Math.hypot(...place.map((v, k) => v - middle[k]!))), 0);
  return far > 0 ? { middle, distance: WHOLE * far } : { middle: model.middle, distance: 3.1 * model.size };
}

/** Move one of the drives, the others staying where they are. */
function together(number: number, to: number): void {
  ended = !solver!.drive(solver!.values.map((v, k) => (k === number ? to : v)));
  if (ended) playing = false;
  leave();
}

/** Remember where the points are. */
function leave(): void {
  const points = [...model.points, ...(traced ? [traced] : [])];
  trails = points.map(({ link, at }, k) => [...(trails[k] ?? []), moved(solver!.poses[link]!, at)].slice(-TRAIL));
  paint();
}

/** The poses of all links between two rows. */
function posesAt(at: number): ArrayLike<number>[] {
  if (solver) return solver.poses;
  if (!motion) return model.bodies.map(() => STILL);
  const low = Math.min(Math.floor(at), motion.poses.length - 2);
  const part = at - low;
  const [a, b] = [motion.poses[low]!, motion.poses[low + 1]!];
  return a.map((pose, link) => pose.map((v, k) => v + part * (b[link]![k]! - v)));
}

const wide = (): number => canvas.clientWidth / Math.max(canvas.clientHeight, 1);

let painter: Painter | undefined;
try {
  painter = new Painter(canvas, model.bodies);
} catch {
  canvas.replaceWith(document.createTextNode(words.flat));
}

const numbers = new Intl.NumberFormat(language, {
  minimumFractionDigits: 1,
  maximumFractionDigits: 1,
  useGrouping: false,
});
/** In the page's language, with a true minus. */
function written(amount: number): string {
  return numbers.format(amount).replace("-", "\u2212");
}

function paint(): void {
  const ratio = Math.min(devicePixelRatio, 2);
  const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const points = [...model.points, ...(traced ? [traced] : [])];
  let paths = trails.map((trail) => trail.flat());
  if (motion && !solver)
    paths = points.map(({ link, at }) => motion!.poses.flatMap((poses) => moved(poses[link]!, at)));
  painter?.paint(projection(camera, wide()), axes(camera).eye, posesAt(row), paths, dark);
  button.textContent = playing ? words.stop : words.play;
  sliders.forEach(({ input, output }, k) => {
    const at = solver!.values[k]!;
    const unit = model.motions.find((each) => each.drive === k)?.unit ?? "";
    const { turns, round } = live!.drives[k]!;
    const shown = round ? at - 2 * Math.PI * Math.round(at / (2 * Math.PI)) : at;
    input.value = String(shown);
    output.textContent = `${written(turns ? (shown * 180) / Math.PI : shown)}${unit}`;
    if (ended && k === chosen) output.textContent += `: ${words.end}`;
  });
  if (!motion || solver) return;
  const low = Math.min(Math.floor(row), motion.values.length - 2);
  const shown = motion.values[low]! + (row - low) * (motion.values[low + 1]! - motion.values[low]!);
  slider.max = String(motion.values.length - 1);
  slider.value = String(row);
  value.textContent = `${written(shown)}${motion.unit}`;
}

let last = 0;
let phase = 0;
function tick(now: number): void {
  const passed = Math.min(now - last, 100) / 1000;
  last = now;
  if (playing && solver) {
    const { low, high, round } = live!.drives[chosen]!;
    const way = (2 * Math.PI * passed) / SECONDS;
    const [mid, half] = [(low + high) / 2, (high - low) / 2];
    // On from where it stands, in the sense of the phase: a swing to and fro.
    const part = Math.asin(Math.min(Math.max((solver.values[chosen]! - mid) / half, -1), 1));
    const turn = (Math.cos(phase) < 0 ? Math.PI - part : part) + way;
    phase = turn;
    together(chosen, round ? solver.values[chosen]! + way : mid + half * Math.sin(turn));
  } else if (playing && motion) {
    phase = (phase + passed / SECONDS) % 1;
    const part = motion.round ? phase : 1 - Math.abs(1 - 2 * phase);
    row = part * (motion.values.length - 1);
    paint();
  }
  requestAnimationFrame(tick);
}

function stopAt(next: number): void {
  playing = false;
  row = next;
  phase = next / Math.max((motion?.values.length ?? 2) - 1, 1) / (motion?.round ? 1 : 2);
  paint();
}

/** Where an event is on the picture, -1 to 1. */
const placed = (event: MouseEvent): [number, number] => {
  const box = canvas.getBoundingClientRect();
  return [(2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height];
};

/** The moving link under a place, and where on it. */
function hit(x: number, y: number): { link: number; at: Vector } | undefined {
  const { from, along } = ray(camera, wide(), x, y);
  let [best, nearest] = [undefined as { link: number; at: Vector } | undefined, Infinity];
  posesAt(row).forEach((pose, link) => {
    const { vertices, triangles } = model.bodies[link]!;
    const start = before(pose, from);
    const end = before(pose, from.map((v, k) => v + along[k]!) as Vector);
    const way = end.map((v, k) => v - start[k]!) as Vector;
    const corner = (k: number): Vector => vertices.slice(3 * k, 3 * k + 3) as Vector;
    for (let k = 0; k < triangles.length; k += 3) {
      const t = meeting(start, way, corner(triangles[k]!), corner(triangles[k + 1]!), corner(triangles[k + 2]!));
      if (t < nearest) [nearest, best] = [t, { link, at: start.map((v, n) => v + t * way[n]!) as Vector }];
    }
  });
  return best;
}

/** The row near the present one at which the pulled place is nearest to the pointer. */
function pull(x: number, y: number): void {
  if (!pulled || !motion) return;
  const { link, at } = pulled;
  const view = projection(camera, wide());
  if (solver) {
    ended = false;
    solver.pull(link, (pose) => {
      const [u, v] = seen(view, moved(pose, at));
      return [wide() * (u - x), v - y];
    });
    return leave();
  }
  const count = motion.values.length - 1;
  let [best, nearest] = [row, Infinity];
  for (let step = -NEAR; step <= NEAR; step += 0.25) {
    const tried = motion.round ? (row + step + count) % count : Math.min(Math.max(row + step, 0), count);
    const [u, v] = seen(view, moved(posesAt(tried)[link]!, at));
    const off = (wide() * (u - x)) ** 2 + (v - y) ** 2;
    if (off < nearest) [nearest, best] = [off, tried];
  }
  stopAt(best);
}

/** How far apart two fingers are. */
function apart(): number {
  const [one, two] = [...fingers.values()];
  return one && two ? Math.hypot(one.clientX - two.clientX, one.clientY - two.clientY) : 0;
}

const fingers = new Map<number, PointerEvent>();
canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  fingers.set(event.pointerId, event);
  pulled = undefined;
  if (fingers.size > 1) return;
  pulled = hit(...placed(event));
  if (pulled) trails = trails.slice(0, model.points.length);
  traced = pulled ?? traced;
  canvas.style.cursor = "grabbing";
  if (pulled) stopAt(row);
});
canvas.addEventListener("pointermove", (event) => {
  if (!fingers.has(event.pointerId)) return;
  const was = apart();
  fingers.set(event.pointerId, event);
  if (fingers.size > 1) {
    camera.distance *= was / Math.max(apart(), 1);
    return paint();
  }
  if (pulled) return pull(...placed(event));
  camera.turn -= event.movementX / 150;
  camera.lift = Math.min(Math.max(camera.lift + event.movementY / 150, -1.5), 1.5);
  paint();
});
for (const end of ["pointerup", "pointercancel"] as const)
  canvas.addEventListener(end, (event) => {
    fingers.delete(event.pointerId);
    pulled = undefined;
    canvas.style.cursor = "grab";
  });
canvas.addEventListener(
  "wheel",
  (event) => {
    event.preventDefault();
    camera.distance *= Math.exp(event.deltaY / 900);
    paint();
  },
  { passive: false },
);
canvas.addEventListener("keydown", (event) => {
  const steps: Record<string, [number, number]> = {
    ArrowLeft: [0.1, 0],
    ArrowRight: [-0.1, 0],
    ArrowUp: [0, 0.1],
    ArrowDown: [0, -0.1],
  };
  const step = steps[event.key];
  if (!step) return;
  event.preventDefault();
  camera.turn += step[0];
  camera.lift = Math.min(Math.max(camera.lift + step[1], -1.5), 1.5);
  paint();
});
slider.addEventListener("input", () => stopAt(Number(slider.value)));
choice.addEventListener("change", () => {
  motion = model.motions[choice.selectedIndex];
  stopAt(((motion?.values.length ?? 1) - 1) / 2);
});
button.addEventListener("click", () => {
  playing = !playing && motion !== undefined;
  paint();
});
new ResizeObserver(paint).observe(canvas);
requestAnimationFrame(tick);
Object.assign(window, { gruebler: { poses: () => posesAt(row), values: () => solver?.values ?? [] } });
