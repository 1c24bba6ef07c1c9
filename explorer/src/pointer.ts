/** What a pointer and the arrow keys do to the picture. */

import type { Dragging } from "./dragging";
import { convexHull, toHull } from "./hull";
import type { Linkage } from "./linkage";
import { type Pair, place } from "./rows";
import type { Viewport } from "./viewport";

export interface StageEvents {
  dragStart(): void;
  dragJoint(joint: number, x: number, y: number): void;
  dragEnd(): void;
  /** A place of a link is pulled to a place in the plane: the drive follows. */
  pull(link: number, u: number, v: number, x: number, y: number): void;
  addPoint(link: number, x: number, y: number): void;
  moveJointBy(joint: number, dx: number, dy: number): void;
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

const GRIP = 20; // pixels: how near a pointer must be
const WAYS: Record<string, Pair> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class Pointer {
  constructor(
    private readonly board: Board,
    private readonly events: StageEvents,
  ) {
    const { root, viewport } = board;
    root.addEventListener("pointerdown", (event) => this.down(event));
    root.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    root.addEventListener("dblclick", (event) => {
      const [x, y] = this.at(event);
      const link = this.linkNear(x, y, 14);
      if (link !== null) this.events.addPoint(link, ...viewport.world(x, y));
    });
  }

  /** The pixel of an event. */
  private at(event: MouseEvent): Pair {
    const box = this.board.root.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.board.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...this.at(event));
  }

  private jointNear(x: number, y: number, reach: number): number | null {
    const { dragging, joints, linkage, viewport } = this.board;
    let best: number | null = null;
    let least = reach;
    for (const joint of joints) {
      if (!dragging!.draggable(joint)) continue;
      const [px, py] = viewport.screen(...linkage!.jointAt(joint));
      const gap = Math.hypot(px - x, py - y);
      if (gap < least) [best, least] = [joint, gap];
    }
    return best;
  }

  private linkNear(x: number, y: number, reach: number): number | null {
    const { viewport } = this.board;
    const linkage = this.board.linkage!;
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

  private down(event: PointerEvent): void {
    const { adding, linkage, root, viewport } = this.board;
    if (!linkage || event.button > 0) return;
    event.preventDefault();
    const [x, y] = this.at(event);
    const reach = event.pointerType === "touch" ? 1.6 * GRIP : GRIP;
    const link = this.linkNear(x, y, reach / 1.4);
    if (adding) {
      if (link !== null) this.events.addPoint(link, ...viewport.world(x, y));
      return;
    }
    root.setPointerCapture(event.pointerId);
    const joint = this.jointNear(x, y, reach);
    if (joint !== null) {
      this.events.dragStart();
      this.board.focus(joint);
      this.follow(event, this.jointMove(joint, x, y), () => this.events.dragEnd());
    } else if (link !== null) {
      const local = linkage.toLocal(link, ...viewport.world(x, y));
      this.follow(event, (u, v) => this.events.pull(link, ...local, ...viewport.world(u, v)));
    } else this.follow(event, this.pan(x, y));
  }

  /** Take a joint along; the pointer keeps its distance from it. */
  private jointMove(joint: number, x: number, y: number): (u: number, v: number) => void {
    const { linkage, viewport } = this.board;
    const [px, py] = viewport.screen(...linkage!.jointAt(joint));
    return (u, v) => this.events.dragJoint(joint, ...viewport.world(u + px - x, v + py - y));
  }

  private pan(x: number, y: number): (u: number, v: number) => void {
    let [lastX, lastY] = [x, y];
    return (u, v) => {
      this.board.viewport.pan(u - lastX, v - lastY);
      [lastX, lastY] = [u, v];
      this.board.draw();
    };
  }

  /** Follow a pointer that is down, once a frame, until it is up. */
  private follow(first: PointerEvent, move: (x: number, y: number) => void, done?: () => void): void {
    const { root } = this.board;
    let latest: Pair | null = null;
    let frame = 0;
    const flush = () => {
      frame = 0;
      if (latest) move(...latest);
      latest = null;
    };
    const moved = (next: PointerEvent) => {
      if (next.pointerId !== first.pointerId) return;
      latest = this.at(next);
      frame ||= requestAnimationFrame(flush);
    };
    const end = (next: PointerEvent) => {
      if (next.pointerId !== first.pointerId) return;
      cancelAnimationFrame(frame);
      flush();
      root.removeEventListener("pointermove", moved);
      root.removeEventListener("pointerup", end);
      root.removeEventListener("pointercancel", end);
      done?.();
    };
    root.addEventListener("pointermove", moved);
    root.addEventListener("pointerup", end);
    root.addEventListener("pointercancel", end);
  }

  /** Move a joint with the arrow keys. */
  key(event: KeyboardEvent, joint: number): void {
    const way = WAYS[event.key];
    if (!way) return;
    event.preventDefault();
    event.stopPropagation();
    const step = this.board.linkage!.size * (event.shiftKey ? 0.001 : 0.01);
    this.events.moveJointBy(joint, step * way[0], step * way[1]);
  }
}
