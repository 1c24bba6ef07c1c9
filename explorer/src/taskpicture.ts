/** What a linkage is to meet as a picture: places, a chart of angles or a swing, with the design that moves. */

import { type Area, areaOf, gridOf, groundMark, MARK, viewBoxOf } from "./area";
import type { Design } from "./designs";
import { h, put, renew, svg } from "./dom";
import { Ghost, pathOf } from "./ghost";
import { away } from "./hull";
import type { Pair } from "./rows";
import { CROWD, markSize, numberPlaces, swingMark, swingOf, targetMark } from "./targets";
import { type Kind, wordsOf } from "./tasks";

const WIDE = 240; // of the plane, in millimetres; that of a phone is narrower
const PART = 0.64; // of the height of the window, at most
const DOT = 2.6; // units: the radius of a target
const LOW = 0.34; // the same on a phone, where designs need room
const SMALL = 0.7; // as large are marks beside a design there
const CORNER = [52, 84] as const; // pixels from its upper right corner that a button covers there

/** What is met, and by what. */
interface Task {
  kind: Kind;
  points: readonly number[][];
  pivots: readonly number[][];
  /** Where fixed pivots shall lie, if that is asked for. */
  region: Pair[];
  closed: boolean;
  /** The curve that is being drawn, as it is. */
  stroke: readonly number[][] | null;
  design: Design | null;
  /** How wide the plane is before there is anything in it; 0 is as usual. */
  home: number;
}

export class TaskPicture {
  /** Where targets are put. */
  readonly plane = svg("svg.plane", { role: "application", tabindex: 0 });
  /** Where a design moves beside the chart of its angles. */
  readonly #other = svg("svg.plane", { role: "img" });
  readonly element = h("div.chain-picture", {}, this.plane);
  readonly #marks = svg("g");
  /** Where the design that moves is in the chart. */
  readonly #here = svg("circle.joint", {});
  readonly #ghost: Ghost;
  #area!: Area;
  #marked = 0;

  /** It stands still while it is not seen. */
  constructor(seen: () => boolean) {
    this.#ghost = new Ghost(seen);
    this.plane.append(this.#marks);
  }

  /** The unit of marks, as a length of the plane. */
  get unit(): number {
    return this.#area.unit;
  }

  /** The same of marks of targets, which may be smaller. */
  get marked(): number {
    return this.#marked;
  }

  /** Where a button may be: its lower left corner, then the others. */
  get #corner(): [Pair, Pair, Pair, Pair] {
    const { right, top, unit } = this.#area;
    const [left, low] = [right - (CORNER[0] * unit) / MARK, top - (CORNER[1] * unit) / MARK];
    return [
      [left, low],
      [right, low],
      [right, top],
      [left, top],
    ];
  }

  /** Where a pointer is; in round numbers the last digit is the first that it can tell. */
  at(event: PointerEvent, round: boolean): [number, number] {
    const box = this.#marks.getScreenCTM()!.inverse();
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(box);
    const fine = 10 ** Math.floor(Math.log10(MARK / this.unit));
    return [point.x, -point.y].map((value) => (round ? Math.round(value * fine) / fine : value)) as Pair;
  }

  /** Draw all of it; while a mark is held what is seen stays, and the design goes on as it is. */
  paint({ kind, points, pivots, region, closed, stroke, design, home }: Task, held: boolean): void {
    const angles = kind === "function";
    const swing = kind === "dead-centres" ? swingOf(points[0]![0]!, design) : null;
    const charted = angles && design?.angles;
    this.#other.remove();
    if (charted) this.element.append(this.#other);
    const { clientWidth } = this.element;
    const narrow = clientWidth < 500;
    const half = (clientWidth - 14) / 2 / window.innerHeight; // a chart is as high alone as beside a design
    const high = angles && !narrow ? Math.min(PART, half) : PART;
    const part = narrow && design ? LOW : high;
    const moving = design?.frames.flat() ?? [];
    if (!held) {
      // all of a design, but of one so large that its targets would not be told apart only what is near them
      const targets: readonly (readonly number[])[] = swing ?? points;
      const off = ([x, y]: readonly number[]) => away(targets[0] as Pair, x!, y!);
      const reach = Math.max(...targets.map(off));
      const far = moving.every((one) => off(one) < 12 * reach) ? Infinity : 2.5 * reach;
      // what the swing is stands above it
      const above = swing ? [[0, 1].map((axis) => 1.2 * swing[3]![axis]! - 0.2 * swing[0]![axis]!)] : [];
      const places = [
        ...targets,
        ...above,
        ...pivots,
        ...region,
        ...(charted ? [] : moving).filter((one) => off(one) < far),
      ];
      const wide = angles || swing ? 0 : home || (narrow ? 0.6 : 1) * WIDE;
      const seen = (more: Pair[]) =>
        areaOf(design && !angles ? -Infinity : wide, part, [...places, ...more], this.plane);
      this.#area = seen([]);
      const [[edge, low]] = this.#corner;
      if (narrow && design && places.some(([u, v]) => u! > edge && v! > low))
        this.#area = seen([[this.#area.right, low]]);
    }
    const { unit } = this.#area;
    const size = narrow && design ? SMALL * unit : unit;
    this.#marked = size;
    const loop = closed && points.length > 2 ? "Z" : "";
    const way = angles ? [...points].sort(([one], [two]) => one! - two!) : points;
    const { left, right, bottom, top } = this.#area;
    const [axes, curve]: [Pair[][], Pair[]] = [
      [
        [
          [left, 0],
          [right, 0],
        ],
        [
          [0, bottom],
          [0, top],
        ],
      ],
      charted || [],
    ];
    const grounds = pivots.map(([x, y]): Pair[] => [
      [x!, y!],
      [x! - 5 * unit, y! - 7 * unit],
      [x! + 5 * unit, y! - 7 * unit],
    ]);
    const parts = curve.slice(1).map((next, k): Pair[] => [curve[k]!, next]);
    const at = numberPlaces(points, closed, size, [...(angles ? axes : []), ...parts, ...grounds]);
    put(this.#here, { r: 1.5 * unit });
    const dot = markSize(points, DOT, size) * (design && points[CROWD] ? 0.5 : 1);
    const mark = (_: unknown, k: number) => targetMark(points, k, at[k]!, size, dot);
    const wanted = svg("path.polygon", { d: kind === "positions" ? "" : pathOf(way) + loop });
    const marks = stroke ? [svg("path.arm", { d: pathOf(stroke) })] : points.map(mark);
    const [picture, names] = swing ? swingMark(swing, points[0]!, this.#area, design, this.#corner) : [[], []];
    renew(
      this.#marks,
      ...gridOf(this.#area, angles ? wordsOf(kind).heads : []),
      svg("path.shape.dead", { "data-region": "", d: region[0] ? `${pathOf(region)}Z` : "" }),
      ...picture,
      ...(charted ? [svg("path.curve", { d: pathOf(charted) }), this.#here] : [design !== null && this.#ghost.element]),
      ...(swing ? names : [...(charted || stroke ? [] : [wanted]), ...marks]),
      ...pivots.map((place) => svg("g", { "data-pivot": "" }, groundMark(place, unit))),
    );
    put(this.plane, { viewBox: viewBoxOf(this.#area) });
    let area = this.#area;
    if (charted) {
      area = areaOf(-Infinity, part, moving, this.#other);
      put(this.#other, { viewBox: viewBoxOf(area) });
      renew(this.#other, ...gridOf(area), this.#ghost.element);
    }
    const follow = (frame: number) => charted && put(this.#here, { cx: charted[frame]![0], cy: -charted[frame]![1] });
    if (!held) this.#ghost.play(design, area.unit, follow);
  }
}
