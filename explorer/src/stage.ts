/** The picture: links in SVG, curves on one canvas, and what a pointer does to them. */

import { h, svg } from "./dom";
import { t } from "./language";
import type { Machine } from "./machine";

export interface Shown {
  curves: boolean;
  velocities: boolean;
  accelerations: boolean;
  hodographs: boolean;
  poles: boolean;
  inflection: boolean;
  labels: boolean;
  grid: boolean;
  link: number; // whose poles are shown
}

export interface StageEvents {
  dragStart(): void;
  dragJoint(joint: number, x: number, y: number): void;
  dragEnd(): void;
  /** A place of a link is pulled to a place in the plane: the drive follows. */
  pull(link: number, u: number, v: number, x: number, y: number): void;
  addPoint(link: number, x: number, y: number): void;
  moveJointBy(joint: number, dx: number, dy: number): void;
}

const PALETTE = ["--motion", "--accent", "--green", "--purple"];
const GRIP = 20;

interface Band {
  x: number;
  y: number;
  c: number;
  s: number;
  low: number;
  high: number;
}

export class Stage {
  readonly element: HTMLElement;
  adding = false;
  private readonly canvas = h("canvas", { "aria-hidden": "true" });
  private readonly root = svg("svg", { role: "application", tabindex: "-1" });
  private machine: Machine | null = null;
  private shown: Shown;
  private width = 1;
  private height = 1;
  private scale = 1;
  private ox = 0;
  private oy = 0;
  private fitted = true;
  private links: (SVGGElement | null)[] = [];
  private pins: { element: SVGGElement; joint: number; ground: boolean }[] = [];
  private marks: { element: SVGGElement; point: number }[] = [];
  private labels: { element: SVGTextElement; at: () => [number, number] }[] = [];
  private readonly arrows = svg("path", { class: "velocity" });
  private readonly changes = svg("path", { class: "acceleration" });
  private readonly circle = svg("circle", { class: "inflection", r: 0 });
  private readonly pole = svg("circle", { class: "pole", r: 4 });
  private bands = new Map<number, Band>();
  private readonly observer: ResizeObserver;

  constructor(
    private readonly events: StageEvents,
    shown: Shown,
  ) {
    this.shown = shown;
    this.element = h("div", { class: "stage" }, this.canvas, this.root);
    this.root.addEventListener("pointerdown", (event) => this.down(event));
    this.root.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    this.root.addEventListener("dblclick", (event) => {
      const [x, y] = this.at(event);
      const link = this.linkNear(x, y, 14);
      if (link !== null) this.events.addPoint(link, ...this.world(x, y));
    });
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.element);
  }

  destroy(): void {
    this.observer.disconnect();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (!clientWidth || !clientHeight) return;
    this.width = clientWidth;
    this.height = clientHeight;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    this.root.setAttribute("viewBox", `0 0 ${clientWidth} ${clientHeight}`);
    if (this.fitted) this.fit();
    else this.draw();
  }

  show(machine: Machine, shown: Shown): void {
    this.machine = machine;
    this.shown = shown;
    this.build();
  }

  // --- coordinates ---------------------------------------------------------------------------------------------------

  private screen(x: number, y: number): [number, number] {
    return [this.ox + this.scale * x, this.oy - this.scale * y];
  }

  world(x: number, y: number): [number, number] {
    return [(x - this.ox) / this.scale, (this.oy - y) / this.scale];
  }

  private at(event: MouseEvent): [number, number] {
    const box = this.root.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** Show everything that the linkage reaches. */
  fit(): void {
    const machine = this.machine;
    if (!machine || this.width < 2) return;
    let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
    const add = ([x, y]: [number, number], room = 0) => {
      if (!Number.isFinite(x) || !Number.isFinite(y)) return;
      left = Math.min(left, x - room);
      right = Math.max(right, x + room);
      bottom = Math.min(bottom, y - room);
      top = Math.max(top, y + room);
    };
    const { rows, values } = machine.cycle;
    const step = Math.max(1, Math.floor(values.length / 90));
    for (let row = 0; row < values.length; row += step) {
      for (const joint of machine.model.joints.keys()) add(machine.jointAt(joint, rows, row));
      for (const point of machine.points) add(machine.place(rows, row, point.link, ...point.at));
      for (const shape of machine.model.shapes) {
        if (shape.circle) add(machine.place(rows, row, shape.link, shape.circle[0], shape.circle[1]), shape.circle[2]);
        for (const line of machine.linesOf(shape))
          for (let k = 0; k + 1 < line.length; k += 16)
            add(machine.place(rows, row, shape.link, line[k]!, line[k + 1]!));
      }
    }
    const narrow = this.width < 500;
    const margin = narrow ? 34 : 60;
    const keys = narrow ? 36 : 0; // the buttons on the right
    const wide = Math.max(right - left, 0.2 * machine.size),
      high = Math.max(top - bottom, 0.2 * machine.size);
    this.scale = Math.min((this.width - 2 * margin - keys) / wide, (this.height - 2 * margin) / high);
    this.ox = (this.width - keys) / 2 - (this.scale * (left + right)) / 2;
    this.oy = this.height / 2 + (this.scale * (bottom + top)) / 2;
    this.fitted = true;
    this.sized();
  }

  zoom(factor: number, x = this.width / 2, y = this.height / 2): void {
    this.ox = x + (this.ox - x) * factor;
    this.oy = y + (this.oy - y) * factor;
    this.scale *= factor;
    this.fitted = false;
    this.sized();
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...this.at(event));
  }

  // --- the parts -----------------------------------------------------------------------------------------------------

  /** Make the elements anew: after another linkage, another point, other options. */
  build(): void {
    const machine = this.machine;
    if (!machine) return;
    const { model } = machine;
    const layers = ["back", "bodies", "marks", "front"].map((name) => svg("g", { class: name })) as [
      SVGGElement,
      SVGGElement,
      SVGGElement,
      SVGGElement,
    ];
    const [back, bodies, marks, front] = layers;
    this.links = model.links.map((name, link) => {
      const group = svg("g", { class: link === model.frame ? "link ground" : "link", "data-link": name });
      (link === model.frame ? back : bodies).append(group);
      return group;
    });
    this.pins = model.joints.flatMap((joint, number) => {
      if (!machine.elementsOf(number).some((k) => model.elements[k]!.kind === "pin")) return [];
      const ground = joint.links.includes(model.frame) && joint.pair === "revolute";
      const free = machine.draggable(number);
      const element = svg("g", {
        class: free ? "pin free" : "pin",
        "data-joint": joint.name,
        tabindex: free ? 0 : -1,
        role: free ? "button" : "img",
        "aria-label": joint.name,
        onkeydown: (event: KeyboardEvent) => this.key(event, number),
      });
      if (ground)
        element.append(
          svg("path", {
            class: "support",
            d: "M0 0 L-11 17 H11 Z M-17 17 H17 M-14 23 l5 -6 M-5 23 l5 -6 M4 23 l5 -6 M13 23 l4 -5",
          }),
        );
      element.append(svg("circle", { class: "halo", r: 13 }), svg("circle", { class: "joint", r: ground ? 5.5 : 4.6 }));
      if (model.drives.some((drive) => drive.joint === number))
        element.append(
          svg("path", { class: "driven", d: "M-9.5 -9.5 A13.4 13.4 0 0 1 12.5 -5 M12.5 -5 l-6 -1.5 M12.5 -5 l0.6 -6" }),
        );
      front.append(element);
      return [{ element, joint: number, ground }];
    });
    this.marks = machine.points.map((_, number) => {
      const element = svg("g", { class: "coupler-point" }, svg("circle", { r: 4.2 }));
      element.style.setProperty("--own", `var(${PALETTE[number % PALETTE.length]!})`);
      marks.append(element);
      return { element, point: number };
    });
    this.labels = [];
    if (this.shown.labels) {
      const text = (content: string, style: string, at: () => [number, number]) => {
        const element = svg("text", { class: style }, content);
        front.append(element);
        this.labels.push({ element, at });
      };
      model.links.slice(0, model.own).forEach((_, link) => {
        if (link === model.frame) return;
        const mine = machine.elementsOn(link);
        text(machine.linkName(link), "name", () => {
          const places = mine.map((k) => machine.elementAt(k));
          return [
            places.reduce((sum, p) => sum + p[0], 0) / places.length,
            places.reduce((sum, p) => sum + p[1], 0) / places.length,
          ];
        });
      });
      for (const point of machine.points)
        text(point.name, "mark", () => machine.place(machine.pose, 0, point.link, ...point.at));
    }
    front.append(this.arrows, this.changes, this.circle, this.pole);
    this.root.setAttribute("aria-label", model.name || model.source || t("The mechanism"));
    this.root.replaceChildren(...layers);
    this.sized();
  }

  /** Draw the bodies of the links after their sizes or the scale changed. */
  sized(): void {
    const machine = this.machine;
    if (!machine) return;
    this.findBands();
    for (const link of machine.model.links.keys()) this.links[link]!.replaceChildren(...this.body(link));
    this.draw();
  }

  /** How far the partners of a line travel along it. */
  private findBands(): void {
    const machine = this.machine!;
    const { rows, values } = machine.cycle;
    this.bands.clear();
    machine.model.elements.forEach((e, k) => {
      if (e.kind !== "line") return;
      const a = machine.angles[k]!;
      const band: Band = {
        x: machine.at[2 * k]!,
        y: machine.at[2 * k + 1]!,
        c: Math.cos(a),
        s: Math.sin(a),
        low: 0,
        high: 0,
      };
      [band.low, band.high] = [Infinity, -Infinity];
      const partners = machine.elementsOf(e.joint).filter((m) => m !== k);
      const step = Math.max(1, Math.floor(values.length / 60));
      for (let row = 0; row < values.length; row += step)
        for (const m of partners) {
          const [x, y] = machine.elementAt(k, rows, row),
            [px, py] = machine.elementAt(m, rows, row);
          const [tx, ty] = machine.turn(rows, row, e.link);
          const way = (tx * band.c - ty * band.s) * (px - x) + (tx * band.s + ty * band.c) * (py - y);
          if (!Number.isFinite(way)) continue;
          band.low = Math.min(band.low, way);
          band.high = Math.max(band.high, way);
        }
      if (!(band.high >= band.low)) [band.low, band.high] = [0, 0];
      this.bands.set(k, band);
    });
  }

  private body(link: number): SVGElement[] {
    const machine = this.machine!,
      { model } = machine;
    if (link >= model.own) return [];
    const out: SVGElement[] = [];
    const frame = link === model.frame;
    const px = (value: number) => (value * this.scale).toFixed(2);
    const place = (x: number, y: number) => `${px(x)} ${px(-y)}`;
    const mine = machine.elementsOn(link);
    for (const shape of model.shapes) {
      if (shape.link !== link) continue;
      const style = `shape ${shape.style}`;
      if (shape.circle)
        out.push(
          svg("circle", { class: style, cx: px(shape.circle[0]), cy: px(-shape.circle[1]), r: px(shape.circle[2]) }),
        );
      for (const line of machine.linesOf(shape)) {
        let d = "M";
        for (let k = 0; k + 1 < line.length; k += 2) d += `${k ? "L" : ""}${place(line[k]!, line[k + 1]!)}`;
        out.push(svg("path", { class: shape.closed ? style : `${style} open`, d: shape.closed ? `${d}Z` : d }));
      }
    }
    const nodes: [number, number][] = [];
    for (const k of mine) {
      const e = model.elements[k]!;
      const here: [number, number] = [machine.at[2 * k]!, machine.at[2 * k + 1]!];
      if (e.kind === "pin") nodes.push(here);
      if (e.kind !== "line") continue;
      const cylinder = this.cylinderBody(k, px);
      if (cylinder) {
        out.push(...cylinder);
        continue;
      }
      const band = this.bands.get(k)!,
        partners = machine.elementsOf(e.joint).filter((m) => m !== k);
      const pinned = partners.some((m) => model.elements[m]!.kind === "pin");
      const carries = frame || pinned || this.carries(link, e.joint);
      const turn = `rotate(${(-machine.angles[k]! * 180) / Math.PI})`;
      if (carries) {
        const room = 26 / this.scale;
        const pins = frame
          ? []
          : mine
              .filter((m) => model.elements[m]!.kind === "pin")
              .map((m) => {
                const dx = machine.at[2 * m]! - band.x,
                  dy = machine.at[2 * m + 1]! - band.y;
                return [band.c * dx + band.s * dy, band.c * dy - band.s * dx] as const;
              })
              .filter(([, off]) => Math.abs(off) < 1e-6 * machine.size)
              .map(([way]) => way);
        const from = Math.min(band.low - room, ...pins),
          to = Math.max(band.high + room, ...pins);
        const a = place(band.x + band.c * from, band.y + band.s * from),
          b = place(band.x + band.c * to, band.y + band.s * to);
        if (frame)
          out.push(
            svg("path", { class: "rail", d: `M${a}L${b}` }),
            svg("path", { class: "rail-hatch", d: `M${a}L${b}` }),
          );
        else
          out.push(
            svg("path", { class: pinned ? "slot-outline" : "rod-outline", d: `M${a}L${b}` }),
            svg("path", { class: pinned ? "slot" : "rod", d: `M${a}L${b}` }),
          );
        if (!frame && !pins.length)
          nodes.push([band.x + (band.c * (band.low + band.high)) / 2, band.y + (band.s * (band.low + band.high)) / 2]);
      } else {
        out.push(
          svg("rect", {
            class: "block",
            x: -15,
            y: -9,
            width: 30,
            height: 18,
            rx: 3,
            transform: `translate(${place(...here)}) ${turn}`,
          }),
        );
        nodes.push(here);
      }
    }
    if (frame) return out;
    for (const point of machine.points) if (point.link === link) nodes.push(point.at);
    for (const k of mine)
      if (model.elements[k]!.kind === "round") nodes.push([machine.at[2 * k]!, machine.at[2 * k + 1]!]);
    const hull = convexHull(nodes);
    if (hull.length > 1) {
      const d = hull.map(([x, y], k) => `${k ? "L" : "M"}${place(x, y)}`).join("") + (hull.length > 2 ? "Z" : "");
      const wide = hull.length > 2 ? " plate" : "";
      out.unshift(svg("path", { class: `outline${wide}`, d }), svg("path", { class: `bar${wide}`, d }));
    }
    return out;
  }

  /** Whether of the two links of a slide this one has the bar: the frame, the one with more joints, or at the frame. */
  private carries(link: number, joint: number): boolean {
    const machine = this.machine!,
      { model } = machine;
    const [one, two] = model.joints[joint]!.links as [number, number];
    const rank = (k: number) =>
      (k === model.frame ? 100 : 0) +
      2 * machine.elementsOn(k).length +
      Number(model.joints.some((other) => other.links.includes(k) && other.links.includes(model.frame)));
    return rank(one) >= rank(two) ? link === one : link === two;
  }

  /** A cylinder's barrel, or its rod, from its pin towards the other; null if the slide is no cylinder. */
  private cylinderBody(k: number, px: (value: number) => string): SVGElement[] | null {
    const machine = this.machine!,
      e = machine.model.elements[k]!;
    const found = machine.cylinder(e.joint);
    if (!found) return null;
    const [one, , pinOne, pinTwo] = found;
    const [own, other] = one === k ? [pinOne, pinTwo] : [pinTwo, pinOne];
    const { rows, values } = machine.cycle;
    let [near, far] = [Infinity, 0];
    for (let row = 0; row < values.length; row += Math.max(1, Math.floor(values.length / 60))) {
      const [ax, ay] = machine.elementAt(own, rows, row),
        [bx, by] = machine.elementAt(other, rows, row);
      const gap = Math.hypot(bx - ax, by - ay);
      if (!Number.isFinite(gap)) continue;
      near = Math.min(near, gap);
      far = Math.max(far, gap);
    }
    if (far > 1.9 * near) return null; // a rod cannot be drawn in by so much: a block on a bar
    const [u, v] = machine.toLocal(e.link, ...machine.elementAt(other));
    const x = machine.at[2 * own]!,
      y = machine.at[2 * own + 1]!;
    const length = Math.hypot(u - x, v - y) || 1;
    const reach = one === k ? 0.86 * near : Math.min(far - 0.62 * near, 0.95 * near);
    const d = `M${px(x)} ${px(-y)}L${px(x + ((u - x) / length) * reach)} ${px(-(y + ((v - y) / length) * reach))}`;
    return (one === k ? ["slot-outline", "slot"] : ["rod-outline", "rod"]).map((style) =>
      svg("path", { class: style, d }),
    );
  }

  /** Put everything where the pose has it. */
  draw(): void {
    const machine = this.machine;
    if (!machine) return;
    const { pose } = machine;
    this.links.forEach((group, link) => {
      const [c, s] = machine.turn(pose, 0, link);
      const [x, y] = this.screen(...machine.place(pose, 0, link, 0, 0));
      group!.setAttribute(
        "transform",
        `matrix(${c.toFixed(6)} ${(-s).toFixed(6)} ${s.toFixed(6)} ${c.toFixed(6)} ${x.toFixed(2)} ${y.toFixed(2)})`,
      );
    });
    const put = (element: SVGElement, [x, y]: [number, number]) =>
      element.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
    for (const { element, joint } of this.pins) put(element, this.screen(...machine.jointAt(joint)));
    for (const { element, point } of this.marks) {
      const record = machine.points[point];
      if (record) put(element, this.screen(...machine.place(pose, 0, record.link, ...record.at)));
    }
    for (const { element, at } of this.labels) {
      const [x, y] = this.screen(...at());
      put(element, [x + 9, y - 9]);
    }
    this.drawVectors();
    this.paint();
  }

  private drawVectors(): void {
    const machine = this.machine!,
      { pose } = machine;
    const arrow = (x: number, y: number, dx: number, dy: number) => {
      const length = Math.hypot(dx, dy);
      if (!(length > 3) || !Number.isFinite(length)) return "";
      const [ux, uy] = [dx / length, dy / length];
      const [ex, ey] = [x + dx, y + dy];
      const at = (u: number, v: number) => `${u.toFixed(1)} ${v.toFixed(1)}`;
      const left = at(ex - 8 * ux - 4 * uy, ey - 8 * uy + 4 * ux);
      const right = at(ex - 8 * ux + 4 * uy, ey - 8 * uy - 4 * ux);
      return `M${at(x, y)}L${at(ex, ey)}M${left}L${at(ex, ey)}L${right}`;
    };
    const vectors = (k: 1 | 2) => {
      const places: [number, number, number, number][] = [];
      const add = (link: number, u: number, v: number) => {
        const [x, y] = this.screen(...machine.place(pose, 0, link, u, v));
        const [dx, dy] = machine.place(pose, 0, link, u, v, k);
        places.push([x, y, dx, -dy]);
      };
      machine.model.joints.forEach((joint, number) => {
        if (joint.links.includes(machine.model.frame) && joint.pair === "revolute") return;
        const element = machine
          .elementsOf(number)
          .find(
            (e) =>
              machine.model.elements[e]!.link !== machine.model.frame && machine.model.elements[e]!.kind !== "round",
          );
        if (element !== undefined)
          add(machine.model.elements[element]!.link, machine.at[2 * element]!, machine.at[2 * element + 1]!);
      });
      for (const point of machine.points) add(point.link, ...point.at);
      const most = Math.max(...places.map(([, , dx, dy]) => Math.hypot(dx, dy)).filter(Number.isFinite), 1e-12);
      return places.map(([x, y, dx, dy]) => arrow(x, y, (70 * dx) / most, (70 * dy) / most)).join("");
    };
    this.arrows.setAttribute("d", this.shown.velocities ? vectors(1) : "");
    this.changes.setAttribute("d", this.shown.accelerations ? vectors(2) : "");
    const pole = this.shown.poles || this.shown.inflection ? machine.pole(pose, 0, this.shown.link) : null;
    this.pole.setAttribute("r", pole ? "4" : "0");
    this.circle.setAttribute("r", "0");
    if (pole) {
      const [x, y] = this.screen(pole.x, pole.y);
      this.pole.setAttribute("cx", x.toFixed(1));
      this.pole.setAttribute("cy", y.toFixed(1));
      if (this.shown.inflection) {
        const [cx, cy] = this.screen(pole.x + pole.dx / 2, pole.y + pole.dy / 2);
        const radius = (Math.hypot(pole.dx, pole.dy) / 2) * this.scale;
        if (radius < 1e5) {
          this.circle.setAttribute("cx", cx.toFixed(1));
          this.circle.setAttribute("cy", cy.toFixed(1));
          this.circle.setAttribute("r", radius.toFixed(1));
        }
      }
    }
  }

  /** The canvas: grid, curves, centrodes. */
  private paint(): void {
    const machine = this.machine!,
      pen = this.canvas.getContext("2d");
    if (!pen) return;
    const ratio = this.canvas.width / this.width;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, this.width, this.height);
    const style = getComputedStyle(this.element);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    if (this.shown.grid) this.paintGrid(pen, colour("--grid"));
    const { rows, values } = machine.cycle;
    const trace = (at: (row: number) => [number, number] | null) => {
      pen.beginPath();
      let on = false;
      let last: [number, number] = [0, 0];
      for (let row = 0; row < values.length; row++) {
        const place = at(row);
        if (!place || !Number.isFinite(place[0] + place[1]) || Math.abs(place[0]) + Math.abs(place[1]) > 1e5) {
          on = false;
          continue;
        }
        // a step far beyond the picture leads through infinity, to the other end of an asymptote
        if (on && Math.hypot(place[0] - last[0], place[1] - last[1]) < 2 * (this.width + this.height))
          pen.lineTo(...place);
        else pen.moveTo(...place);
        on = true;
        last = place;
      }
      pen.stroke();
    };
    if (this.shown.curves) {
      machine.points.forEach((point, number) => {
        pen.strokeStyle = colour(PALETTE[number % PALETTE.length]!);
        pen.lineWidth = 2;
        trace((row) => this.screen(...machine.place(rows, row, point.link, ...point.at)));
      });
    }
    if (this.shown.hodographs && rows.order >= 1) this.paintHodographs(pen, trace, colour);
    if (this.shown.poles && rows.order >= 1) {
      const link = this.shown.link;
      pen.lineWidth = 1.4;
      pen.strokeStyle = colour("--green");
      trace((row) => {
        const pole = machine.pole(rows, row, link);
        return pole && this.screen(pole.x, pole.y);
      });
      pen.setLineDash([6, 4]);
      pen.strokeStyle = colour("--purple");
      trace((row) => {
        const pole = machine.pole(rows, row, link);
        if (!pole) return null;
        const [c, s] = machine.turn(rows, row, link);
        const [x, y] = machine.place(rows, row, link, 0, 0);
        const dx = pole.x - x,
          dy = pole.y - y;
        return this.screen(...machine.place(machine.pose, 0, link, c * dx + s * dy, c * dy - s * dx));
      });
      pen.setLineDash([]);
    }
  }

  /** The velocities of all named points, drawn from one place in the corner: their ends trace the hodographs. */
  private paintHodographs(
    pen: CanvasRenderingContext2D,
    trace: (at: (row: number) => [number, number] | null) => void,
    colour: (name: string) => string,
  ): void {
    const machine = this.machine!,
      { rows, values } = machine.cycle;
    const velocity = (point: (typeof machine.points)[number], row: number) =>
      machine.place(rows, row, point.link, ...point.at, 1);
    const reach = 0.16 * Math.min(this.width, this.height);
    const [x, y] = [reach + 16, this.height - reach - 16];
    const fastest = machine.points.map((point) =>
      Math.max(0, ...Array.from(values, (_, row) => Math.hypot(...velocity(point, row))).filter(Number.isFinite)),
    );
    const most = Math.max(...fastest, 1e-12 * machine.size);
    machine.points.forEach((point, number) => {
      const end = ([u, v]: [number, number]): [number, number] => [x + (reach * u) / most, y - (reach * v) / most];
      pen.strokeStyle = colour(PALETTE[number % PALETTE.length]!);
      pen.lineWidth = 1.4;
      trace((row) => end(velocity(point, row)));
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(...end(machine.place(machine.pose, 0, point.link, ...point.at, 1)));
      pen.stroke();
    });
    pen.fillStyle = colour("--ink");
    pen.beginPath();
    pen.arc(x, y, 2.5, 0, 7);
    pen.fill();
  }

  private paintGrid(pen: CanvasRenderingContext2D, colour: string): void {
    const wanted = 70 / this.scale;
    const power = 10 ** Math.floor(Math.log10(wanted));
    const step = [1, 2, 5, 10].map((m) => m * power).find((value) => value >= wanted)!;
    pen.strokeStyle = colour;
    pen.lineWidth = 1;
    pen.beginPath();
    const [left, top] = this.world(0, 0),
      [right, bottom] = this.world(this.width, this.height);
    for (let k = Math.ceil(left / step); k * step <= right; k++) {
      const x = Math.round(this.screen(k * step, 0)[0]) + 0.5;
      pen.moveTo(x, 0);
      pen.lineTo(x, this.height);
    }
    for (let k = Math.ceil(bottom / step); k * step <= top; k++) {
      const y = Math.round(this.screen(0, k * step)[1]) + 0.5;
      pen.moveTo(0, y);
      pen.lineTo(this.width, y);
    }
    pen.stroke();
  }

  // --- the pointer ---------------------------------------------------------------------------------------------------

  private jointNear(x: number, y: number, reach: number): number | null {
    const machine = this.machine!;
    let best: number | null = null;
    for (const { joint } of this.pins) {
      if (!machine.draggable(joint)) continue;
      const [px, py] = this.screen(...machine.jointAt(joint));
      const gap = Math.hypot(px - x, py - y);
      if (gap < reach) [best, reach] = [joint, gap];
    }
    return best;
  }

  private linkNear(x: number, y: number, reach: number): number | null {
    const machine = this.machine!;
    let best: number | null = null;
    for (let link = 0; link < machine.model.own; link++) {
      if (link === machine.model.frame) continue;
      const places = [
        ...machine.elementsOn(link).map((k) => this.screen(...machine.elementAt(k))),
        ...machine.points
          .filter((p) => p.link === link)
          .map((p) => this.screen(...machine.place(machine.pose, 0, link, ...p.at))),
      ];
      const hull = convexHull(places);
      const gap = inside(hull, x, y)
        ? 0
        : Math.min(...hull.map((p, k) => toSegment(x, y, p, hull[(k + 1) % hull.length]!)));
      if (gap < reach) [best, reach] = [link, Math.max(gap, 0.01)];
    }
    return best;
  }

  private down(event: PointerEvent): void {
    const machine = this.machine;
    if (!machine || event.button > 0) return;
    event.preventDefault();
    const [x, y] = this.at(event);
    const reach = event.pointerType === "touch" ? 1.6 * GRIP : GRIP;
    const link = this.linkNear(x, y, reach / 1.4);
    if (this.adding) {
      if (link !== null) this.events.addPoint(link, ...this.world(x, y));
      return;
    }
    this.root.setPointerCapture(event.pointerId);
    const joint = this.jointNear(x, y, reach);
    let move: (x: number, y: number) => void;
    if (joint !== null) {
      const [px, py] = this.screen(...machine.jointAt(joint));
      this.events.dragStart();
      (this.pins.find((pin) => pin.joint === joint)?.element as SVGElement | undefined)?.focus({ preventScroll: true });
      move = (u, v) => this.events.dragJoint(joint, ...this.world(u + px - x, v + py - y));
    } else if (link !== null) {
      const local = machine.toLocal(link, ...this.world(x, y));
      move = (u, v) => this.events.pull(link, ...local, ...this.world(u, v));
    } else {
      let [lastX, lastY] = [x, y];
      move = (u, v) => {
        this.ox += u - lastX;
        this.oy += v - lastY;
        [lastX, lastY] = [u, v];
        this.fitted = false;
        this.draw();
      };
    }
    let latest: [number, number] | null = null;
    let frame = 0;
    const flush = () => {
      frame = 0;
      if (latest) move(...latest);
      latest = null;
    };
    const follow = (next: PointerEvent) => {
      if (next.pointerId !== event.pointerId) return;
      latest = this.at(next);
      frame ||= requestAnimationFrame(flush);
    };
    const end = (next: PointerEvent) => {
      if (next.pointerId !== event.pointerId) return;
      cancelAnimationFrame(frame);
      flush();
      this.root.removeEventListener("pointermove", follow);
      this.root.removeEventListener("pointerup", end);
      this.root.removeEventListener("pointercancel", end);
      if (joint !== null) this.events.dragEnd();
    };
    this.root.addEventListener("pointermove", follow);
    this.root.addEventListener("pointerup", end);
    this.root.addEventListener("pointercancel", end);
  }

  private key(event: KeyboardEvent, joint: number): void {
    const ways: Record<string, [number, number]> = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, 1],
      ArrowDown: [0, -1],
    };
    const way = ways[event.key];
    if (!way) return;
    event.preventDefault();
    event.stopPropagation();
    const step = this.machine!.size * (event.shiftKey ? 0.001 : 0.01);
    this.events.moveJointBy(joint, step * way[0], step * way[1]);
  }

  /** The picture as one SVG file, its colours written out. */
  file(): string {
    const copy = this.root.cloneNode(true) as SVGSVGElement;
    const from = [...this.root.querySelectorAll<SVGElement>("*")];
    const names = [
      "fill",
      "stroke",
      "stroke-width",
      "stroke-linecap",
      "stroke-linejoin",
      "stroke-dasharray",
      "opacity",
      "font-size",
      "font-family",
    ];
    for (const [k, element] of [...copy.querySelectorAll<SVGElement>("*")].entries()) {
      const style = getComputedStyle(from[k]!);
      if (style.display === "none") {
        element.remove();
        continue;
      }
      for (const name of names) element.setAttribute(name, style.getPropertyValue(name));
      for (const name of ["class", "tabindex", "role", "style"]) element.removeAttribute(name);
    }
    const machine = this.machine!;
    if (this.shown.curves) {
      const { rows, values } = machine.cycle;
      machine.points.forEach((point, number) => {
        const d = Array.from(values, (_, row) => {
          const [x, y] = this.screen(...machine.place(rows, row, point.link, ...point.at));
          return `${row ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`;
        }).join("");
        const stroke = getComputedStyle(this.element)
          .getPropertyValue(PALETTE[number % PALETTE.length]!)
          .trim();
        copy.prepend(svg("path", { d, fill: "none", stroke, "stroke-width": 2 }));
      });
    }
    copy.prepend(
      svg("rect", {
        width: this.width,
        height: this.height,
        fill: getComputedStyle(this.element).getPropertyValue("--paper").trim(),
      }),
    );
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    copy.setAttribute("width", String(this.width));
    copy.setAttribute("height", String(this.height));
    copy.removeAttribute("tabindex");
    return new XMLSerializer().serializeToString(copy);
  }
}

/** The corners of the convex hull, in order. */
export function convexHull(points: readonly (readonly [number, number])[]): [number, number][] {
  const sorted = [...new Map(points.map(([x, y]) => [`${x},${y}`, [x, y] as [number, number]])).values()].sort(
    (a, b) => a[0] - b[0] || a[1] - b[1],
  );
  if (sorted.length < 3) return sorted;
  const half = (list: [number, number][]) => {
    const out: [number, number][] = [];
    for (const p of list) {
      while (out.length > 1) {
        const [ax, ay] = out[out.length - 2]!,
          [bx, by] = out[out.length - 1]!;
        if ((bx - ax) * (p[1] - ay) - (by - ay) * (p[0] - ax) > 0) break;
        out.pop();
      }
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return [...half(sorted), ...half([...sorted].reverse())];
}

function inside(hull: [number, number][], x: number, y: number): boolean {
  return (
    hull.length > 2 &&
    hull.every(([ax, ay], k) => {
      const [bx, by] = hull[(k + 1) % hull.length]!;
      return (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0;
    })
  );
}

function toSegment(x: number, y: number, [ax, ay]: [number, number], [bx, by]: [number, number]): number {
  const dx = bx - ax,
    dy = by - ay,
    d = dx * dx + dy * dy;
  const part = d ? Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / d)) : 0;
  return Math.hypot(x - ax - part * dx, y - ay - part * dy);
}
