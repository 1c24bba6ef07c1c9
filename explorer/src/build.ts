/** The view in which a mechanism is drawn on an empty plane; its mobility is told while it grows. */

import { gripAt, gripped } from "./backdrop";
import { choiceOf, removeChosen } from "./choice";
import { h, ownPage, renew, svg } from "./dom";
import {
  type Drawing,
  documentOfDrawing,
  EMPTY,
  isPin,
  joined,
  lengthsOf,
  linksOf,
  moved,
  type Spot,
  withCylinder,
  withDyad,
  withGears,
  withGround,
  withLink,
  withSlider,
} from "./drawing";
import { Fingers } from "./fingers";
import { stepOf } from "./grid";
import { History } from "./history";
import { toHull } from "./hull";
import { t } from "./language";
import { type Drawn, MobilityPanel } from "./mobility";
import type { Model } from "./model";
import { placesPanel } from "./places";
import { type Chosen, outlineOf, type Plane, planePicture } from "./plane";
import type { Pair } from "./rows";
import { snapped } from "./snapping";
import type { Page, View } from "./view";
import { Viewport } from "./viewport";

type Tool = "move" | "ground" | "link" | "slider" | "dyad" | "cylinder" | "gears";
const NEEDED: Record<Tool, number> = { move: 0, ground: 1, link: 2, slider: 1, dyad: 3, cylinder: 2, gears: 3 };
const KEYS: Record<string, Tool> = {
  v: "move",
  g: "ground",
  l: "link",
  s: "slider",
  d: "dyad",
  c: "cylinder",
  w: "gears",
};
const WAYS: Record<string, Pair> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const GRIP = 16; // pixels
const KEPT = "gruebler-drawing";

export class BuildView implements View, Plane, Drawn {
  readonly element = h("div.view.motion", { "data-page": "build" });
  drawing: Drawing = kept();
  readonly viewport = new Viewport();
  #tool: Tool = this.drawing.knots.length ? "link" : "ground";
  spots: Spot[] = [];
  chosen: Chosen | null = null;
  cursor: Pair = [0, 0];
  #snapping = true;
  readonly #fingers = new Fingers();
  /** What was there when the first finger came. */
  #begun: [Drawing, Spot[]] = [EMPTY, []];
  readonly #history = new History<Drawing>();
  private readonly root = svg("svg", { role: "application", tabindex: 0, class: "drawing" });
  readonly #tools = h("div.transport.palette", {});
  readonly #hint = h("div.hint", {});
  readonly #side = h("div.side", {});
  private readonly mobility = new MobilityPanel(this);
  readonly #choice = h("div", {});
  readonly #places = h("section.panel.options", {});

  constructor(readonly page: Page) {
    this.viewport.scale = 4;
    const stage = h("div.stage", {}, this.root, this.#hint);
    this.element.append(stage, this.#tools, this.#side);
    this.root.addEventListener("pointerdown", (event) => this.#down(event));
    this.root.addEventListener("pointermove", (event) => this.#hover(event));
    for (const end of ["pointerup", "pointercancel"] as const)
      this.root.addEventListener(end, (event) => this.#fingers.lift(event.pointerId));
    this.root.addEventListener("keydown", (event) => this.#key(event));
    this.root.addEventListener(
      "wheel",
      (event) => {
        if (!ownPage() && !event.ctrlKey) return; // a notebook scrolls past it
        event.preventDefault();
        this.viewport.zoom(Math.exp(-event.deltaY * 0.0015), ...this.#pixel(event));
        this.#draw();
      },
      { passive: false },
    );
    new ResizeObserver(() => this.#resize()).observe(stage);
  }

  #resize(): void {
    const { width, height } = this.root.getBoundingClientRect();
    if (!width) return;
    const first = this.viewport.width < 2;
    Object.assign(this.viewport, { width, height });
    this.root.setAttribute("viewBox", `0 0 ${width} ${height}`);
    const part = width < 500 ? 0.75 : 1;
    if (first) this.viewport.fit({ left: -60 * part, right: 140 * part, bottom: -50 * part, top: 90 * part }, 1);
    this.#draw();
  }

  arrange(): void {
    const names: Record<Tool, string> = {
      move: t("Move"),
      ground: t("Ground"),
      link: t("Link"),
      slider: t("Slider"),
      dyad: t("Dyad"),
      cylinder: t("Cylinder"),
      gears: t("Gear pair"),
    };
    const tools = Object.entries(KEYS).map(([letter, key]) =>
      h(
        "button",
        {
          class: key === this.#tool ? "key" : "plain",
          "data-tool": key,
          "aria-pressed": String(key === this.#tool),
          onclick: () => this.#take(key),
        },
        names[key],
        h("span.letter.keys", {}, ` (${letter.toUpperCase()})`),
      ),
    );
    renew(this.#tools, ...tools);
    const ends = t("Two clicks, from end to end.");
    const hints: Record<Tool, string> = {
      move: t("Drag joints; click on a joint or a link to choose it."),
      ground: t("A click puts it, on a joint too."),
      slider: t("A click puts it, on a joint too."),
      link: ends,
      cylinder: ends,
      dyad: t("Three clicks: end, middle, end."),
      gears: t(
        "Three clicks: both centres, then where they touch; beyond a centre the other wheel has internal teeth.",
      ),
    };
    renew(this.#hint, h("b", {}, names[this.#tool]), " ", hints[this.#tool]);
    const snap = h("input", {
      type: "checkbox",
      checked: this.#snapping,
      onchange: () => (this.#snapping = snap.checked),
    });
    renew(
      this.#side,
      h("section.panel", {}, h("h2", {}, t("Mobility")), this.mobility.element),
      h("section.panel", {}, h("h2", {}, t("What is chosen")), this.#choice),
      h(
        "section.panel.options",
        {},
        h("label", {}, snap, t("Snap")),
        h(
          "p.note",
          {},
          t(
            "Ends meet what is near them, and stop in line with others, at round angles and " +
              "at lengths of other links.",
          ),
          h("span.keys", {}, " ", t("With Shift links are level or upright. Keys: arrows and Enter.")),
        ),
        h("button.plain", { "data-act": "empty", onclick: () => this.#empty() }, t("Empty plane")),
      ),
      this.#places,
    );
    this.root.setAttribute("aria-label", t("Plane to draw on"));
    this.#changed();
  }

  appeared(): void {
    this.#resize();
  }

  #empty(): void {
    this.change(EMPTY);
    this.#take("ground");
  }

  #take(tool: Tool): void {
    this.#tool = tool;
    this.spots = [];
    this.arrange();
  }

  // --- changes -------------------------------------------------------------------------------------------------------

  change(next: Drawing | null, text = t("A link cannot meet itself.")): void {
    if (!next) return this.page.say(text);
    this.#history.add(this.drawing);
    this.drawing = next;
    this.chosen = null;
    this.page.say("");
    this.#changed();
    this.page.changed();
  }

  get undoable(): [boolean, boolean] {
    return this.#history.possible;
  }

  undo(): void {
    this.#goTo(this.#history.undo(this.drawing));
  }

  redo(): void {
    this.#goTo(this.#history.redo(this.drawing));
  }

  #goTo(old: Drawing | undefined): void {
    if (!old) return;
    this.drawing = old;
    this.spots = [];
    this.chosen = null;
    this.#changed();
    this.page.changed();
  }

  #changed(): void {
    try {
      localStorage.setItem(KEPT, JSON.stringify(this.drawing));
    } catch {
      // what cannot be kept lasts as long as the page
    }
    this.#draw();
    this.#showChoice();
    renew(this.#places, ...placesPanel(this));
    void this.mobility.tell();
  }

  /** What a click, a tap or Enter does at a place. */
  #put(spot: Spot): void {
    const { drawing, spots } = this;
    const tool = this.#tool;
    spots.push(spot);
    if (spots.length < NEEDED[tool]) return this.#draw();
    this.spots = [];
    const [one, two, three] = spots as [Spot, Spot, Spot];
    if (tool === "ground") this.change(withGround(drawing, one));
    else if (tool === "slider") this.change(withSlider(drawing, one));
    else if (tool === "gears") this.change(same(one, two) ? null : withGears(drawing, one, two, three.at));
    else if (tool === "cylinder") this.change(same(one, two) ? null : withCylinder(drawing, one, two));
    else if (tool === "link") this.change(same(one, two) ? null : withLink(drawing, one, two));
    else if (tool === "dyad")
      this.change(same(one, two) || same(two, three) ? null : withDyad(drawing, one, two, three));
  }

  // --- the pointer ---------------------------------------------------------------------------------------------------

  #pixel(event: MouseEvent): Pair {
    const box = this.root.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** What is at a pixel: a knot, a link, else a place, on the grid if that is wanted. */
  #spot([x, y]: Pair, upright: boolean, but = -1): Spot {
    const { drawing, viewport } = this;
    let [knot, least]: [number | null, number] = [null, GRIP];
    drawing.knots.forEach(({ at }, k) => {
      const [px, py] = viewport.screen(...at);
      if (k !== but && Math.hypot(px - x, py - y) < least) [knot, least] = [k, Math.hypot(px - x, py - y)];
    });
    const last = this.spots.at(-1);
    const pins = drawing.knots.filter((one, k) => isPin(one) && k !== but);
    let [u, v] = viewport.world(x, y);
    if (this.#snapping)
      [u, v] = snapped([u, v], viewport, {
        places: [...pins, ...this.spots].map(({ at }) => at),
        from: last ? [last.at] : [],
        lengths: lengthsOf(drawing),
      });
    if (upright && last) {
      if (Math.abs(u - last.at[0]) > Math.abs(v - last.at[1])) v = last.at[1];
      else u = last.at[0];
    }
    if (knot !== null) return { at: drawing.knots[knot]!.at, knot, link: null };
    const link = linksOf(drawing).find((one) => one !== drawing.frame && toHull(outlineOf(this, one), x, y) < GRIP / 2);
    return { at: [u, v], knot: null, link: link ?? null };
  }

  get step(): number {
    return stepOf(this.viewport);
  }

  #draw(): void {
    renew(this.root, ...planePicture(this));
  }

  #hover(event: PointerEvent): void {
    if (this.#fingers.move(event.pointerId, this.#pixel(event), this.viewport)) return this.#draw();
    if (this.#tool === "move") return;
    this.cursor = this.#spot(this.#pixel(event), event.shiftKey).at;
    this.#draw();
  }

  #down(event: PointerEvent): void {
    if (event.button > 0) return;
    event.preventDefault();
    this.root.focus({ preventScroll: true });
    this.#fingers.put(event.pointerId, this.#pixel(event));
    if (this.#fingers.count > 1) return this.#takeBack();
    this.#begun = [this.drawing, [...this.spots]];
    const spot = this.#spot(this.#pixel(event), event.shiftKey);
    if (this.#tool !== "move") return this.#put(spot);
    const before = this.drawing;
    const { picture } = before;
    let last = this.#pixel(event);
    const start = this.viewport.world(...last);
    const held = picture && this.chosen && "picture" in this.chosen;
    const grip = held && spot.knot === null ? gripAt(picture, start, GRIP / this.viewport.scale) : null;
    if (!grip) this.#choose(spot, start);
    this.root.setPointerCapture(event.pointerId);
    const moves = (next: PointerEvent) => {
      if (this.#fingers.count > 1) return;
      const now = this.#pixel(next);
      if (grip) {
        const place = this.viewport.world(...now);
        this.drawing = { ...before, picture: gripped(picture!, grip, start, place) };
      } else if (spot.knot === null) this.viewport.pan(now[0] - last[0], now[1] - last[1]);
      else this.drawing = moved(before, spot.knot, this.#spot(now, false, spot.knot).at);
      last = now;
      this.#draw();
    };
    const up = (next: PointerEvent) => {
      this.root.removeEventListener("pointermove", moves);
      this.root.removeEventListener("pointerup", up);
      this.root.removeEventListener("pointercancel", up);
      if (this.drawing === before) return;
      const placed = this.drawing;
      const target = spot.knot === null ? null : this.#spot(this.#pixel(next), false, spot.knot).knot;
      this.drawing = before;
      this.change((target !== null && joined(before, spot.knot!, target)) || placed);
      if (grip) this.#choose(spot, this.viewport.world(...last));
    };
    this.root.addEventListener("pointermove", moves);
    this.root.addEventListener("pointerup", up);
    this.root.addEventListener("pointercancel", up);
  }

  /** What the first of two fingers put was not meant. */
  #takeBack(): void {
    const [drawing, spots] = this.#begun;
    if (this.#tool === "move") this.drawing = drawing;
    else if (this.drawing !== drawing) this.undo();
    this.spots = spots;
    this.#draw();
  }

  #choose(spot: Spot, place = spot.at): void {
    const { picture } = this.drawing;
    this.chosen = picture && gripAt(picture, place, GRIP / this.viewport.scale) ? { picture: true } : null;
    if (spot.knot !== null) this.chosen = { knot: spot.knot };
    else if (spot.link !== null) this.chosen = { link: spot.link };
    this.#draw();
    this.#showChoice();
  }

  #key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey) return;
    const way = WAYS[event.key];
    const tool = KEYS[event.key.toLowerCase()];
    if (way) {
      const step = event.shiftKey ? this.step / 5 : this.step;
      this.cursor = [this.cursor[0] + step * way[0], this.cursor[1] + step * way[1]];
      this.#draw();
    } else if (event.key === "Enter" || event.key === " ") {
      const spot = this.#spot(this.viewport.screen(...this.cursor), false);
      if (this.#tool === "move") this.#choose(spot);
      else this.#put(spot);
    } else if (event.key === "Delete" || event.key === "Backspace") removeChosen(this);
    else if (event.key === "Escape") {
      this.spots = [];
      this.#draw();
    } else if (tool) this.#take(tool);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  // --- beside it -----------------------------------------------------------------------------------------------------

  #showChoice(): void {
    renew(this.#choice, ...choiceOf(this));
  }

  async move(): Promise<void> {
    try {
      const document = documentOfDrawing(this.drawing, "mm");
      this.page.open(await this.page.ask<Model>("open_document", { document, name: t("A drawn mechanism") }));
    } catch (error) {
      this.page.say((error as Error).message);
    }
  }
}

function same(one: Spot, two: Spot): boolean {
  return one.at[0] === two.at[0] && one.at[1] === two.at[1];
}

/** The drawing that was kept when the page was left. */
function kept(): Drawing {
  try {
    const found = JSON.parse(localStorage.getItem(KEPT) ?? "null") as Drawing | null;
    return found && Array.isArray(found.knots) && Array.isArray(found.drives) ? found : EMPTY;
  } catch {
    return EMPTY;
  }
}
