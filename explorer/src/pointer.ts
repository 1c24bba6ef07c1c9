/** What a pointer and the arrow keys do to the picture. */

import { ownPage } from "./dom";
import type { Dragging } from "./dragging";
import { Fingers } from "./fingers";
import { convexHull, toHull } from "./hull";
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
  /** The joints that are drawn. */
  readonly joints: readonly number[];
  focus(joint: number): void;
  zoom(factor: number, x: number, y: number): void;
  draw(): void;
}

const NEAR = 14; // pixels: how near a link must be for a point that is put on it
const GRIP = 20; // pixels: how near a pointer must be
const WAYS: Record<string, Pair> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

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
    root.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    root.addEventListener("dblclick", (event) => {
      const [x, y] = this.#at(event);
      if (!board.linkage) return;
      const joint = this.#jointNear(x, y, GRIP, true);
      if (joint !== null) this.#events.holdJoint(joint);
      else if (this.#pointNear(x, y, GRIP) === null)
        this.#events.addPoint(this.#linkNear(x, y, NEAR), ...viewport.world(x, y));
    });
    root.addEventListener("pointermove", (event) => {
      if (this.#fingers.move(event.pointerId, this.#at(event), viewport)) board.zoom(1, 0, 0);
    });
    for (const name of ["pointerup", "pointercancel"] as const)
      root.addEventListener(name, (event) => this.#fingers.lift(event.pointerId));
  }

  /** Give up what is dragged; false if nothing is. */
  cancel(): boolean {
    if (!this.#following) return false;
    this.#following.stop(false);
    return true;
  }

  /** The pixel of an event. */
  #at(event: MouseEvent): Pair {
    const box = this.#board.root.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #wheel(event: WheelEvent): void {
    if (!ownPage() && !event.ctrlKey) return; // a notebook scrolls past it
    event.preventDefault();
    this.#board.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...this.#at(event));
  }

  #jointNear(x: number, y: number, reach: number, held = false): number | null {
    const { dragging, joints, linkage, viewport } = this.#board;
    let best: number | null = null;
    let least = reach;
    for (const joint of joints) {
      if (!dragging!.draggable(joint) && !(held && dragging!.locks.held.has(joint))) continue;
      const [px, py] = viewport.screen(...linkage!.jointAt(joint));
      const gap = Math.hypot(px - x, py - y);
      if (gap < least) [best, least] = [joint, gap];
    }
    return best;
  }

  #pointNear(x: number, y: number, reach: number): number | null {
    const { viewport } = this.#board;
    const { pose, sizes } = this.#board.linkage!;
    let best: number | null = null;
    let least = reach;
    sizes.points.forEach(({ link, at }, number) => {
      const [px, py] = viewport.screen(...place(pose, 0, link, ...at));
      const gap = Math.hypot(px - x, py - y);
      if (gap < least) [best, least] = [number, gap];
    });
    return best;
  }

  #linkNear(x: number, y: number, reach: number): number | null {
    const { viewport } = this.#board;
    const linkage = this.#board.linkage!;
    const { model, pose, sizes } = linkage;
    let best: number | null = null;
    let least = reach;
    for (let link = 0; link < model.own; link++) {
      if (link === model.frame) continue;
      const points = sizes.points.filter((p) => p.link === link).map((p) => place(pose, 0, link, ...p.at));
      const elements = sizes.elementsOn(link).map((k) => linkage.elementAt(k));
      const gap = toHull(convexHull([...elements, ...points].map((p) => viewport.screen(...p))), x, y);
      if (gap < least) [best, least] = [link, Math.max(gap, 0.01)];
    }
    return best;
  }

  #down(event: PointerEvent): void {
    const { adding, linkage, root, viewport } = this.#board;
    if (!linkage || event.button > 0) return;
    event.preventDefault();
    const [x, y] = this.#at(event);
    const reach = event.pointerType === "touch" ? 1.6 * GRIP : GRIP;
    const link = this.#linkNear(x, y, reach / 1.4);
    if (adding) return this.#events.addPoint(link, ...viewport.world(x, y));
    root.setPointerCapture(event.pointerId);
    if (this.#following && event.pointerType === "touch") {
      this.#fingers.clear();
      this.#fingers.put(this.#following.id, this.#following.at);
      this.#fingers.put(event.pointerId, [x, y]);
      this.cancel();
      return;
    }
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
      this.#follow(event, (u, v) => this.#events.pull(link, ...local, ...viewport.world(u, v)));
    } else this.#follow(event, this.#pan(x, y));
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

  /** Follow a pointer that is down, once a frame, until it is up. */
  #follow(first: PointerEvent, move: (x: number, y: number) => void, done?: () => void): void {
    const { root } = this.#board;
    let latest: Pair | null = null;
    let frame = 0;
    const flush = () => {
      frame = 0;
      if (latest) move(...latest);
      latest = null;
    };
    const moved = (next: PointerEvent) => {
      if (next.pointerId !== first.pointerId) return;
      latest = this.#at(next);
      this.#shift = next.shiftKey;
      mine.at = latest;
      frame ||= requestAnimationFrame(flush);
    };
    const stop = (reached: boolean) => {
      cancelAnimationFrame(frame);
      if (reached) flush();
      root.removeEventListener("pointermove", moved);
      root.removeEventListener("pointerup", end);
      root.removeEventListener("pointercancel", end);
      this.#following = null;
      if (reached) done?.();
      else this.#events.dragCancel();
    };
    const end = (next: PointerEvent) => {
      if (next.pointerId === first.pointerId) stop(true);
    };
    const mine: Follow = { id: first.pointerId, at: this.#at(first), stop };
    this.#following = mine;
    root.addEventListener("pointermove", moved);
    root.addEventListener("pointerup", end);
    root.addEventListener("pointercancel", end);
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
