/** The canvas over the bodies: curves of points, centrodes, hodographs. */

import { DEGREE } from "./cycle";
import { clearAbout } from "./hull";
import type { Linkage } from "./linkage";
import { pole } from "./measures";
import type { PointRecord, Target } from "./model";
import type { OtherModes } from "./modes";
import { origin, type Pair, place, turn } from "./rows";
import { ownColour, type Shown } from "./shown";
import { armOf, markSize, numberOf } from "./targets";
import type { Viewport } from "./viewport";

const DASHES = [6, 4];
const FONT = "12px system-ui, sans-serif";
const GHOST = 0.3; // how much is seen of the curves of other assembly modes; half of it while they may be old
const FARTHEST = 1e5; // pixels: what is farther off is not drawn

export class Painter {
  constructor(
    private readonly pen: CanvasRenderingContext2D,
    private readonly viewport: Viewport,
    /** The value of a variable of the style sheet. */
    private readonly colour: (name: string) => string,
  ) {}

  /** Draw the curves, those of other assembly modes behind them. */
  paint(linkage: Linkage, shown: Shown, modes: OtherModes): void {
    const { pen, viewport } = this;
    const ratio = pen.canvas.width / viewport.width;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, viewport.width, viewport.height);
    const { points } = linkage.sizes;
    const { rows } = linkage.cycle;
    if (shown.curves)
      for (const shape of [...modes.beside(linkage), rows]) {
        pen.globalAlpha = shape === rows ? 1 : GHOST / (linkage.quick ? 2 : 1);
        points.forEach((point, k) => {
          const at = (row: number) => viewport.screen(...place(shape, row, point.link, ...point.at));
          this.#trace(shape.reached, ownColour(k), 2, at);
        });
      }
    this.#paintTargets(linkage.beside.targets ?? []);
    if (rows.order < 1) return;
    if (shown.hodographs) this.#paintHodographs(linkage);
    if (shown.poles) this.#paintCentrodes(linkage, shown.link);
  }

  /** A line through places in pixels; null interrupts it. */
  #trace(count: number, colour: string, width: number, at: (row: number) => Pair | null): void {
    const { pen, viewport } = this;
    pen.strokeStyle = this.colour(colour);
    pen.lineWidth = width;
    pen.beginPath();
    // a step far beyond the picture leads through infinity, to the other end of an asymptote
    const near = (2 * (viewport.width + viewport.height)) ** 2;
    let last: Pair | null = null;
    for (let row = 0; row < count; row++) {
      const here = at(row);
      if (!here || !(Math.abs(here[0]) + Math.abs(here[1]) <= FARTHEST)) {
        last = null;
        continue;
      }
      const [x, y] = here;
      if (last && (x - last[0]) ** 2 + (y - last[1]) ** 2 < near)
        pen.quadraticCurveTo(...last, (x + last[0]) / 2, (y + last[1]) / 2); // round, also where steps are long
      else pen.moveTo(x, y);
      last = here;
    }
    if (last) pen.lineTo(...last);
    pen.stroke();
  }

  /** What the linkage was designed for: rings with numbers, positions with their direction. */
  #paintTargets(targets: readonly Target[]): void {
    if (!targets.length) return; // to choose a font took a third of a frame
    const { pen, viewport } = this;
    pen.strokeStyle = pen.fillStyle = this.colour("--purple");
    pen.lineWidth = 2;
    pen.font = FONT;
    pen.textAlign = "center";
    const ring = markSize(targets, 6, 1 / viewport.scale);
    const arm = armOf(targets, 26, 1 / viewport.scale);
    const arrows = targets.map(([x, y, degrees]) => {
      const phi = (degrees ?? 0) * DEGREE;
      const [u, v] = viewport.screen(x, y);
      return [ring, degrees === undefined ? ring : arm].map(
        (far): Pair => [u + far * Math.cos(phi), v - far * Math.sin(phi)],
      );
    });
    for (const [k, [x, y]] of targets.entries()) {
      const [u, v] = viewport.screen(x, y);
      pen.beginPath();
      pen.arc(u, v, ring, 0, 7);
      const [from, to] = arrows[k] as [Pair, Pair];
      pen.moveTo(...from);
      pen.lineTo(...to);
      pen.stroke();
      const [left, middle] = clearAbout([u, v], -14, arrows);
      pen.fillText(numberOf(k, targets.length), left, middle + 4);
    }
  }

  /** The curves of the pole of a link, in the plane and on the link. */
  #paintCentrodes(linkage: Linkage, link: number): void {
    const { viewport } = this;
    const { rows, values } = linkage.cycle;
    this.#trace(values.length, "--green", 1.4, (row) => {
      const found = pole(linkage, rows, row, link);
      return found && viewport.screen(found.x, found.y);
    });
    this.pen.setLineDash(DASHES);
    this.#trace(values.length, "--purple", 1.4, (row) => {
      const found = pole(linkage, rows, row, link);
      if (!found) return null;
      const [c, s] = turn(rows, row, link);
      const [x, y] = origin(rows, row, link);
      const [dx, dy] = [found.x - x, found.y - y];
      return viewport.screen(...place(linkage.pose, 0, link, c * dx + s * dy, c * dy - s * dx));
    });
    this.pen.setLineDash([]);
  }

  /** The velocities of all named points, drawn from one place in the corner: their ends trace the hodographs. */
  #paintHodographs(linkage: Linkage): void {
    const { pen, viewport } = this;
    const { points } = linkage.sizes;
    if (!points.length) return;
    const { rows, values } = linkage.cycle;
    const velocity = (point: PointRecord, row: number) => place(rows, row, point.link, ...point.at, 1);
    const reach = 0.16 * Math.min(viewport.width, viewport.height);
    const [x, y] = [reach + 16, viewport.height - reach - 16];
    const fastest = points.map((point) => {
      const speeds = Array.from(values, (_, row) => Math.hypot(...velocity(point, row)));
      return Math.max(0, ...speeds.filter(Number.isFinite));
    });
    const most = Math.max(...fastest, 1e-12 * linkage.size);
    const end = ([u, v]: Pair): Pair => [x + (reach * u) / most, y - (reach * v) / most];
    points.forEach((point, k) => {
      this.#trace(values.length, ownColour(k), 1.4, (row) => end(velocity(point, row)));
      pen.beginPath();
      pen.moveTo(x, y);
      const tip = end(place(linkage.pose, 0, point.link, ...point.at, 1));
      pen.lineTo(...tip);
      pen.stroke();
      pen.fillStyle = pen.strokeStyle;
      pen.font = FONT;
      pen.textAlign = "center";
      pen.fillText(`v(${linkage.pointName(point.name)})`, tip[0], tip[1] - 8);
    });
    pen.fillStyle = this.colour("--ink");
    pen.beginPath();
    pen.arc(x, y, 2.5, 0, 7);
    pen.fill();
  }
}
