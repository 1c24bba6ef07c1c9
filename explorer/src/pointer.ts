/** What a pointer and the arrow keys do to the picture. */

import type { Dragging } from "./dragging";
import { Fingers, pixelIn, wheelZooms, whileDown } from "./fingers";
import { away, convexHull, nearest, toHull } from "./hull";
import type { Linkage } from "./linkage";
import { type Pair, place } from "./rows";
import type { Viewport } from "./viewport";

export interface StageEvents {
  dragStart(): void;
  /** A joint is dragged to a place; with Shift it snaps. */
  dragJoint(joint: number, place: Pair, snap: boolean): void;
  dragEnd(): void;
  /** A place of a link is pulled to a place in the plane: the drive follows. */
  pull(link: number, u: number, v: number, x: number, y: number): void;
  /** The drag that is going on is given up. */
  dragCancel(): void;
  /** A point is wanted at a place: on this link, or, beside all of them, on the chosen one. */
  addPoint(link: number | null, x: number, y: number): void;
  /** A link is chosen, or none. */
  choose(link: number | null): void;
  dragPoint(point: number, place: Pair, snap: boolean): void;
  movePointBy(point: number, dx: number, dy: number): void;
  moveJointBy(joint: number, dx: number, dy: number): void;
  /** A joint is to stay where it is, or not any more. */
  holdJoint(joint: number): void;
}

/** The picture as the pointer sees it. */
export interface Board {
  readonly root: SVGSVGElement;
  readonly viewport: Viewport;
  readonly linkage: Linkage | null;
  readonly dragging: Dragging | null;
  /** Whether a click adds a point. */
  readonly adding: boolean;
  readonly chosen: number | null;
  /** Whether names of links stand in a list. */
  readonly listed: boolean;
  /** The joints that are drawn. */
  readonly joints: readonly number[];
  focus(joint: number): void;
  /** Show that a link would be taken. */
  hover(link: number | null): void;
  zoom(factor: number, x: number, y: number): void;
  draw(): void;
}

const STILL = 4; // pixels: a pointer that goes no farther has clicked
const NEAR = 14; // pixels: how near a link must be for a point that is put on it
const GRIP = 20; // pixels: how near a pointer must be
export const WAYS: Record<string, Pair> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

interface Follow {
  id: number;
  at: Pair;
  stop(done: boolean): void;
}

export class Pointer {
  #following: Follow | null = null;
  #shift = false;
  readonly #fingers = new Fingers();
  readonly #board: Board;
  readonly #events: StageEvents;

  constructor(board: Board, events: StageEvents) {
    this.#board = board;
    this.#events = events;
    const { root, viewport } = board;
    root.addEventListener("pointerdown", (event) => this.#down(event));
    wheelZooms(root, (...about) => board.zoom(...about));
    root.addEventListener("dblclick", (event) => {
      const [x, y] = pixelIn(root, event);
      if (!board.linkage) return;
      const joint = this.#jointNear(x, y, GRIP, true);
      if (joint !== null) this.#events.holdJoint(joint);
      else if (this.#pointNear(x, y, GRIP) === null)
        this.#events.addPoint(this.#linkNear(x, y, NEAR), ...viewport.world(x, y));
    });
    root.addEventListener("pointermove", (event) => {
      const at = pixelIn(root, event);
      if (this.#fingers.move(event.pointerId, at, viewport)) board.zoom(1, 0, 0);
      else if (board.adding && board.linkage) board.hover(board.chosen ?? this.#linkNear(...at, 2 * GRIP));
      else if (board.listed && !this.#following) board.hover(this.#linkNear(...at, NEAR));
    });
    root.addEventListener("pointerleave", () => board.hover(null));
    for (const name of ["pointerup", "pointercancel"] as const)
      root.addEventListener(name, (event) => this.#fingers.lift(event.pointerId));
  }

  /** Give up what is dragged; false if nothing is. */
  cancel(): boolean {
    if (!this.#following) return false;
    this.#following.stop(false);
    return true;
  }

  #jointNear(x: number, y: number, reach: number, held = false): number | null {
    const { dragging, joints, linkage, viewport } = this.#board;
    const free = (joint: number) => dragging!.draggable(joint) || (held && dragging!.locks.held.has(joint));
    const taken = joints.filter(free);
    const number = nearest(taken, reach, (joint) => away(viewport.screen(...linkage!.jointAt(joint)), x, y));
    return number === null ? null : taken[number]!;
  }

  #pointNear(x: number, y: number, reach: number): number | null {
    const { linkage, viewport } = this.#board;
    const { pose, sizes } = linkage!;
    return nearest(sizes.points, reach, ({ link, at }) => away(viewport.screen(...place(pose, 0, link, ...at)), x, y));
  }

  #linkNear(x: number, y: number, reach: number): number | null {
    const { viewport } = this.#board;
    const linkage = this.#board.linkage!;
    const { model, pose, sizes } = linkage;
    return nearest(model.links.slice(0, model.own), reach, (_, link) => {
      if (link === model.frame) return Infinity;
      const points = sizes.points.filter((p) => p.link === link).map((p) => place(pose, 0, link, ...p.at));
      const elements = sizes.elementsOn(link).map((k) => linkage.elementAt(k));
      return Math.max(toHull(convexHull([...elements, ...points].map((p) => viewport.screen(...p))), x, y), 0.01);
    });
  }

  #down(event: PointerEvent): void {
    const { adding, chosen, linkage, root, viewport } = this.#board;
    if (!linkage || event.button > 0) return;
    event.preventDefault();
    const [x, y] = pixelIn(root, event);
    const reach = event.pointerType === "touch" ? 1.6 * GRIP : GRIP;
    const link = this.#linkNear(x, y, reach / 1.4);
    if (adding && chosen !== null) return this.#events.addPoint(chosen, ...viewport.world(x, y));
    if (adding) return this.#events.choose(this.#linkNear(x, y, 2 * reach)); // it may be moving
    root.setPointerCapture(event.pointerId);
    if (this.#following && event.pointerType === "touch") {
      this.#fingers.clear();
      this.#fingers.put(this.#following.id, this.#following.at);
      this.#fingers.put(event.pointerId, [x, y]);
      this.cancel();
      return;
    }
    const choose = (far: number) => {
      if (far < STILL) this.#events.choose(link);
    };
    const joint = this.#jointNear(x, y, reach);
    const point = this.#pointNear(x, y, joint === null ? reach : 0.3 * reach);
    if (point !== null) {
      this.#events.dragStart();
      this.#follow(event, this.#pointMove(point, x, y), () => this.#events.dragEnd());
    } else if (joint !== null) {
      this.#events.dragStart();
      this.#board.focus(joint);
      this.#follow(event, this.#jointMove(joint, x, y), () => this.#events.dragEnd());
    } else if (link !== null) {
      const local = linkage.toLocal(link, ...viewport.world(x, y));
      this.#follow(event, (u, v) => this.#events.pull(link, ...local, ...viewport.world(u, v)), choose);
    } else this.#follow(event, this.#pan(x, y), choose);
  }

  /** Take a joint along; the pointer keeps its distance from it. */
  #jointMove(joint: number, x: number, y: number): (u: number, v: number) => void {
    const { linkage, viewport } = this.#board;
    const [px, py] = viewport.screen(...linkage!.jointAt(joint));
    return (u, v) => this.#events.dragJoint(joint, viewport.world(u + px - x, v + py - y), this.#shift);
  }

  /** Take a point of a link along in the same way. */
  #pointMove(point: number, x: number, y: number): (u: number, v: number) => void {
    const { linkage, viewport } = this.#board;
    const { link, at } = linkage!.sizes.points[point]!;
    const [px, py] = viewport.screen(...place(linkage!.pose, 0, link, ...at));
    return (u, v) => this.#events.dragPoint(point, viewport.world(u + px - x, v + py - y), this.#shift);
  }

  #pan(x: number, y: number): (u: number, v: number) => void {
    let [lastX, lastY] = [x, y];
    return (u, v) => {
      this.#board.viewport.pan(u - lastX, v - lastY);
      [lastX, lastY] = [u, v];
      this.#board.draw();
    };
  }

  /** Follow a pointer that is down, once a frame, until it is up; in the end how far it went, in pixels. */
  #follow(first: PointerEvent, move: (x: number, y: number) => void, done: (far: number) => void): void {
    const { root } = this.#board;
    const start = pixelIn(root, first);
    let latest: Pair | null = null;
    let far = 0;
    let frame = 0;
    const flush = () => {
      frame = 0;
      if (latest) move(...latest);
      latest = null;
    };
    const moved = (next: PointerEvent) => {
      if (next.pointerId !== first.pointerId) return;
      latest = pixelIn(this.#board.root, next);
      this.#shift = next.shiftKey;
      far = Math.max(far, away(latest, ...start));
      mine.at = latest;
      frame ||= requestAnimationFrame(flush);
    };
    const stop = (reached: boolean) => {
      cancelAnimationFrame(frame);
      if (reached) flush();
      leave();
      this.#following = null;
      if (reached) done(far);
      else this.#events.dragCancel();
    };
    const end = (next: PointerEvent) => {
      if (next.pointerId === first.pointerId) stop(true);
    };
    const mine: Follow = { id: first.pointerId, at: start, stop };
    this.#following = mine;
    const leave = whileDown(root, moved, end);
  }

  /** Move a joint or a point with the arrow keys. */
  key(event: KeyboardEvent, move: (dx: number, dy: number) => void): void {
    const way = WAYS[event.key];
    if (!way) return;
    event.preventDefault();
    event.stopPropagation();
    const step = this.#board.linkage!.size * (event.shiftKey ? 0.001 : 0.01);
    move(step * way[0], step * way[1]);
  }
}
