/** The picture: bodies in SVG, over them curves on one canvas, over these joints, points and names in SVG again. */

import { Bodies } from "./bodies";
import { Painter } from "./canvas";
import { h, lowered, put, renew, svg } from "./dom";
import type { Dragging } from "./dragging";
import { gridOf } from "./grid";
import { pathThrough } from "./hull";
import { currentLanguage, number, t } from "./language";
import { Legend } from "./legend";
import type { Linkage } from "./linkage";
import { OtherModes } from "./modes";
import { type Board, Pointer, type StageEvents } from "./pointer";
import { type Pair, place } from "./rows";
import { Scene } from "./scene";
import { linesOf } from "./shapes";
import { stageButton, zoomButtons } from "./shell";
import { ownColour, type Shown } from "./shown";
import { Extent, Viewport } from "./viewport";

/** What a style sheet says of an element, and a file on its own must. */
const STYLES =
  "fill fill-rule stroke stroke-width stroke-linecap stroke-linejoin stroke-dasharray opacity font-size font-family " +
  "font-weight paint-order";

const SAID = 16; // pixels more that a bearing needs over what can be done
const NUMBERS = 28; // pixels that numbers of links need at the edges

export class Stage implements Board {
  readonly element: HTMLElement;
  readonly root = svg("svg", { role: "application", tabindex: "-1" });
  readonly viewport = new Viewport();
  linkage: Linkage | null = null;
  dragging: Dragging | null = null;
  adding = false;
  readonly #tools = h("div.tools", {});
  readonly #hint = h("div.hint", {});
  readonly #grid = svg("svg.grid", { "aria-hidden": "true" });
  /** In which names stand. */
  #language = "";
  /** Of what the grid is: drawn anew each time, it took a third of a frame. */
  #ruled = "";
  readonly #under = svg("svg.grid", { "aria-hidden": "true" });
  readonly #canvas = h("canvas", { "aria-hidden": "true" });
  readonly #scene: Scene;
  readonly #pointer: Pointer;
  readonly #modes = new OtherModes();
  readonly #observer: ResizeObserver;
  readonly #lowered: () => void;
  /** Values of variables of the style sheet. To ask for one makes the browser apply all of it. */
  readonly #colours = new Map<string, string>();
  readonly #colour = (name: string): string => {
    const known = this.#colours.get(name);
    if (known) return known;
    const found = getComputedStyle(this.element).getPropertyValue(name).trim();
    this.#colours.set(name, found);
    return found;
  };

  constructor(
    events: StageEvents,
    private shown: Shown,
  ) {
    this.viewport.rows = true;
    this.#tools.style.visibility = "hidden"; // until it is known where they stand
    this.element = h("div.stage", {}, this.#grid, this.#under, this.#canvas, this.root);
    this.#pointer = new Pointer(this, events);
    const legend = new Legend((link) => this.hover(link), events.choose);
    const keys = {
      joint: (event: KeyboardEvent, joint: number) => {
        if (event.key === "Enter") events.holdJoint(joint);
        else this.#pointer.key(event, (dx, dy) => events.moveJointBy(joint, dx, dy));
      },
      point: (event: KeyboardEvent, point: number) =>
        this.#pointer.key(event, (dx, dy) => events.movePointBy(point, dx, dy)),
    };
    this.#scene = new Scene(this.root, this.#under, this.viewport, keys, legend);
    this.#observer = new ResizeObserver(() => this.#resize());
    this.#observer.observe(this.element);
    this.#lowered = lowered(this.element);
  }

  destroy(): void {
    this.#observer.disconnect();
    this.#lowered();
  }

  /** Write the buttons on the picture, in the language of the page. */
  arrange(): void {
    const adder = stageButton("point", t("Add a coupler point"), () => this.setAdding(!this.adding));
    adder.setAttribute("aria-pressed", String(this.adding));
    renew(this.#tools, ...zoomButtons(this), adder);
    this.element.append(this.#tools, this.#hint);
  }

  get joints(): number[] {
    return this.#scene.joints;
  }

  get chosen(): number | null {
    return this.shown.chosen;
  }

  get listed(): boolean {
    return this.#scene.listed;
  }

  focus(joint: number): void {
    this.#scene.focus(joint);
  }

  hover(link: number | null): void {
    this.#scene.mark(link, "hovered");
  }

  /** Whether clicks make coupler points; returns whether they did. */
  setAdding(on: boolean): boolean {
    const before = this.adding;
    this.adding = on;
    this.#tools.querySelector("[aria-pressed]")?.setAttribute("aria-pressed", String(on));
    this.element.classList.toggle("adding", on);
    this.hover(null);
    this.draw();
    return before;
  }

  /** Give up what the pointer is dragging; false if it drags nothing. */
  cancelDrag(): boolean {
    return this.#pointer.cancel();
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.element;
    if (!clientWidth || !clientHeight) return;
    this.viewport.width = clientWidth;
    this.viewport.height = clientHeight;
    const ratio = Math.min(devicePixelRatio || 1, 3);
    this.#canvas.width = Math.round(clientWidth * ratio);
    this.#canvas.height = Math.round(clientHeight * ratio);
    this.root.setAttribute("viewBox", `0 0 ${clientWidth} ${clientHeight}`);
    this.refit();
  }

  show(linkage: Linkage, dragging: Dragging, shown: Shown): void {
    this.linkage = linkage;
    this.dragging = dragging;
    this.shown = shown;
    this.build();
  }

  /** Show everything, unless something else was chosen. */
  refit(): void {
    if (this.viewport.fitted) this.fit();
    else this.sized();
  }

  /** Show everything that the linkage reaches. */
  fit(): void {
    const { linkage, viewport } = this;
    if (!linkage || viewport.width < 2) return;
    const reach = reachOf(linkage);
    const fit = (below?: number, room?: number) => viewport.fit(reach, 0.2 * linkage.size, below, reach.places, room);
    fit(viewport.narrow ? undefined : SAID);
    this.#scene.sized(linkage);
    const listed = this.#scene.choose(linkage, this.shown);
    if (listed) fit(listed, NUMBERS);
    this.#tools.style.cssText = viewport.row ? "flex-flow: row" : "";
    this.sized();
  }

  /** Show everything again, if nothing else was chosen, where a part of it would be outside. */
  keepInside(): void {
    const { fitted, height, width } = this.viewport;
    const { left, right, bottom, top } = reachOf(this.linkage!);
    const [[x, y], [u, v]] = [this.viewport.screen(left, top), this.viewport.screen(right, bottom)];
    if (fitted && Math.min(x, y, width - u, height - v) < 0) this.fit();
  }

  zoom(factor: number, x?: number, y?: number): void {
    this.viewport.zoom(factor, x, y);
    this.sized();
  }

  /** Make the elements anew: after another linkage, another point, other options. */
  build(): void {
    const { linkage, dragging } = this;
    if (!linkage || !dragging) return;
    this.root.setAttribute("aria-label", linkage.title || linkage.model.source || t("The mechanism"));
    this.#scene.build(linkage, dragging, this.shown);
    const language = currentLanguage();
    const other = this.#language && this.#language !== language;
    this.#language = language;
    if (other) this.refit();
    else this.sized();
  }

  /** Draw the bodies of the links after their sizes or the scale changed. */
  sized(): void {
    if (!this.linkage || this.viewport.width < 2) return; // it follows when the picture has its size
    this.#scene.sized(this.linkage);
    this.draw();
  }

  /** Put everything where the pose has it. */
  draw(): void {
    if (!this.linkage) return;
    this.#rule(this.linkage.model.unit);
    this.#scene.draw(this.linkage, this.shown);
    this.#scene.mark(this.chosen, "chosen");
    const said = this.#said(this.linkage, this.chosen);
    if (this.#hint.textContent !== said) this.#hint.textContent = said;
    const pen = this.#canvas.getContext("2d");
    if (!pen) return;
    new Painter(pen, this.viewport, this.#colour).paint(this.linkage, this.shown, this.#modes);
  }

  /** What can be done next; of a link that is chosen its lengths. */
  #said(linkage: Linkage, chosen: number | null): string {
    const name = chosen === null ? "" : linkage.linkName(chosen);
    if (this.adding)
      return name
        ? t("A point of {name}: place it on the link or beside it.", { name })
        : t("Coupler point: choose its link.");
    const aside = this.#scene.poleAside ? ` ${t("The pole lies outside of the picture.")}` : "";
    const { dragging } = this;
    const lengths = dragging!.lengths();
    if (!name) {
      if (linkage.cycle.whole) return aside; // it moves freely
      const can = this.joints.some((joint) => dragging!.draggable(joint));
      let text = t("Drag a link to move it.");
      if (can) text = t("Drag an axis to shift it, a link to turn it.");
      if (can && lengths[0]) text = t("Drag a joint to resize, a link to move it.");
      return text + aside;
    }
    const mine = lengths.filter(({ link }) => link === chosen);
    const values = mine.map(({ value }) => `${number(value, 5)} ${linkage.model.unit}`.trim());
    return [name, values.join(", ")].filter(Boolean).join(": ") + aside;
  }

  /** It has come to rest. */
  settled(): void {
    this.#scene.settle();
    this.draw();
  }

  #rule(unit: string): void {
    const ruled = this.shown.grid ? JSON.stringify([this.viewport, unit, currentLanguage()]) : "";
    if (ruled !== this.#ruled) renew(this.#grid, ...(ruled ? gridOf(this.viewport, unit) : []));
    this.#ruled = ruled;
  }

  /** Draw in the colours of another theme. */
  recoloured(): void {
    this.#colours.clear();
    this.draw();
  }

  /** The picture as one SVG file, its colours written out. */
  file(): string {
    const { viewport } = this;
    const [below, copy] = [this.#under, this.root].map((root) => this.#styled(root)) as [SVGSVGElement, SVGSVGElement];
    const { rows, values } = this.linkage!.cycle;
    const points = this.shown.curves ? this.linkage!.sizes.points : [];
    const curves = points.map(({ link, at }, k) => {
      const places = Array.from(values, (_, row) => viewport.screen(...place(rows, row, link, ...at)));
      const d = pathThrough(places);
      return svg("path", { d, fill: "none", stroke: this.#colour(ownColour(k)), "stroke-width": 2 });
    });
    const paper = svg("rect", { width: viewport.width, height: viewport.height, fill: this.#colour("--paper") });
    copy.prepend(paper, ...below.children, ...curves);
    put(copy, { xmlns: "http://www.w3.org/2000/svg", width: viewport.width, height: viewport.height });
    copy.removeAttribute("tabindex");
    return new XMLSerializer().serializeToString(copy);
  }

  /** A copy of a part of the picture, its styles written out. */
  #styled(root: SVGSVGElement): SVGSVGElement {
    const copy = root.cloneNode(true) as SVGSVGElement;
    const from = [...root.querySelectorAll<SVGElement>("*")];
    for (const [k, element] of [...copy.querySelectorAll<SVGElement>("*")].entries()) {
      const style = getComputedStyle(from[k]!);
      if (style.display === "none") {
        element.remove();
        continue;
      }
      for (const name of STYLES.split(" ")) element.setAttribute(name, style.getPropertyValue(name));
      for (const name of "class tabindex role style".split(" ")) element.removeAttribute(name);
    }
    return copy;
  }
}

/** Where a linkage comes to in its cycle. */
function reachOf(linkage: Linkage): Extent {
  const { model, sizes } = linkage;
  const { rows, values } = linkage.cycle;
  const box = new Extent();
  const add = (at: Pair, room?: number) => box.add(at, room);
  for (const [x, y] of linkage.beside.targets ?? []) add([x, y]);
  const { rods } = new Bodies(linkage, Infinity);
  const step = Math.max(1, Math.floor(values.length / 90));
  for (let row = 0; row < values.length; row += step) {
    for (const joint of model.joints.keys()) add(linkage.jointAt(joint, rows, row));
    for (const point of sizes.points) add(place(rows, row, point.link, ...point.at));
    for (const [link, at] of rods) add(place(rows, row, link, ...at));
    for (const shape of model.shapes) {
      const at = (x: number, y: number) => place(rows, row, shape.link, x, y);
      if (shape.circle) add(at(shape.circle[0], shape.circle[1]), shape.circle[2]);
      for (const line of linesOf(sizes, shape))
        for (let k = 0; k + 1 < line.length; k += line.length > 99 ? 16 : 2) add(at(line[k]!, line[k + 1]!));
    }
  }
  return box;
}
