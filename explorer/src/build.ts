/** The view in which a mechanism is drawn on an empty plane; its mobility is told while it grows. */

import { enlarged, gripAt, gripped } from "./backdrop";
import { choiceOf, field, isLow, removeChosen } from "./choice";
import { DEGREE } from "./cycle";
import { h, lowered, option, renew, svg } from "./dom";
import {
  counted,
  type Drawing,
  EMPTY,
  joined,
  joining,
  linksOf,
  movedAlone,
  type Spot,
  same,
  turned,
  unitOf,
} from "./drawing";
import { Fingers, pixelIn, wheelZooms, whileDown } from "./fingers";
import { stepOf } from "./grid";
import { zoomedBy } from "./help";
import { History } from "./history";
import { away } from "./hull";
import { keepDrawing, keepDrawn, keptDrawing, keptDrawn, saveDrawing } from "./kept";
import { spaced, t } from "./language";
import { markLengths } from "./lengthlist";
import { movedKept } from "./lengths";
import type { Linkage } from "./linkage";
import { type Drawn, MobilityPanel } from "./mobility";
import { hintOf, KEYS, palette, type Tool, withTool, wordsOf } from "./palette";
import { placesPanel } from "./places";
import { type Aim, type Chosen, GRIP, isPicture, linkFor, type Plane, planePicture, spotAt } from "./plane";
import { WAYS } from "./pointer";
import type { Pair } from "./rows";
import { zoomButtons } from "./shell";
import { extentOf, starters } from "./starters";
import { isOf, openDrawn } from "./taken";
import type { Page, View } from "./view";
import { type Box, Viewport } from "./viewport";

// an empty plane, and that of a phone
const FIRST: Box = { left: -60, right: 140, bottom: -50, top: 90 };
const SMALL: Box = { left: -10, right: 64, bottom: -20, top: 40 };

export class BuildView implements View, Plane, Drawn {
  readonly element = h("div.view.motion", { "data-page": "build" });
  drawing: Drawing = keptDrawing();
  viewport = new Viewport();
  /** That of the whole picture of a phone, which is there again after a low one. */
  #whole = this.viewport;
  /** The drawing as it was found, which Motion need not show, or what Motion was last given, and made of it. */
  #known = this.drawing;
  #made: Linkage | null = null;
  /** The linkage whose loads are those of the drawing. */
  #before: Linkage | null = null;
  /** What Motion showed at the last change. */
  #seen: Linkage | null = null;
  #tool: Tool = this.drawing.knots.length ? "link" : "ground";
  spots: Spot[] = [];
  chosen: Chosen | null = null;
  cursor: Pair = [0, 0];
  aim: Aim = "here";
  #snapping = true;
  /** Whether the spot that waits is the end of the last link. */
  #goingOn = false;
  readonly #fingers = new Fingers();
  /** What was there when the first finger came. */
  #begun: [Drawing, Spot[]] = [EMPTY, []];
  readonly #history = new History<Drawing>();
  private readonly root = svg("svg.drawing", {
    role: "application",
    tabindex: 0,
    onpointerdown: (event: PointerEvent) => this.#down(event),
    onpointermove: (event: PointerEvent) => this.#hover(event),
    onpointerleave: () => this.#aimAt("away"),
    onpointerup: (event: PointerEvent) => {
      this.#fingers.lift(event.pointerId);
      this.#typeDistance();
    },
    // of a finger what is pressed has the focus after it is lifted
    onclick: ({ target }: Event) => {
      this.#typeDistance();
      const { span } = (target as SVGElement).dataset;
      if (span) this.#side.querySelector<HTMLElement>(`[data-span="${span}"]`)?.focus();
    },
    onpointercancel: (event: PointerEvent) => this.#fingers.lift(event.pointerId),
  });
  readonly #tools = h("div.transport.palette", {});
  readonly #hint = h("div.hint", {});
  readonly #buttons = h("div.tools", {});
  readonly #starters = h("div.starters", {});
  readonly #instead = h("div.form", { "data-place": "instead" });
  readonly #side = h("div.side", {});
  private readonly mobility = new MobilityPanel(this);
  readonly #choice = h("div.form.choosing", {});
  readonly #places = h("section.panel.options", {});

  constructor(readonly page: Page) {
    const { past, tool } = keptDrawn(this.drawing);
    if (tool) this.#tool = tool;
    for (const one of past) this.#history.add(one);
    const stage = h("div.stage.adding", {}, this.root, this.#hint, this.#choice, this.#starters, this.#buttons);
    this.element.append(stage, this.#tools, this.#side);
    wheelZooms(this.root, (...about) => this.zoom(...about));
    new ResizeObserver(() => this.#resize()).observe(stage);
    lowered(stage);
  }

  #resize(): void {
    const { width, height } = this.root.getBoundingClientRect();
    if (!width) return;
    const before = this.viewport;
    const changed = width < 500 && before.fitted && height !== before.height;
    // a phone's low picture shows all of it, too
    if (changed) this.viewport = height < this.#whole.height ? new Viewport() : this.#whole;
    const { viewport } = this;
    const fits = viewport.width < 2 || (changed && viewport === before);
    Object.assign(viewport, { width, height, lowest: 152 });
    this.root.setAttribute("viewBox", `0 0 ${width} ${height}`);
    if (fits) this.fit();
    else this.#draw();
  }

  zoom(factor: number, x?: number, y?: number): void {
    this.viewport.zoom(factor, x, y);
    this.#draw();
  }

  /** Show all that is drawn. */
  fit(): void {
    const box = extentOf(this.drawing);
    const wide = box.right - box.left;
    const seen = wide + box.top - box.bottom > 0;
    const { viewport } = this;
    const { narrow } = viewport;
    const room = narrow ? 0 : 0.1 * wide; // for letters
    box.left -= room;
    box.right += room;
    // what can be done with what is chosen
    const below = narrow ? Math.min(64, viewport.height / 4) : 29;
    const { knots } = this.drawing;
    const rails = knots.some(({ slide }) => slide !== undefined);
    const first = narrow ? SMALL : FIRST;
    const places = knots.map(({ at }) => at);
    viewport.fit(seen ? box : first, 1e-9, below, places, rails ? 48 : 34);
    this.#draw();
  }

  #aimAt(aim: Aim, cursor = this.cursor): void {
    Object.assign(this, { aim, cursor });
    this.#draw();
  }

  arrange(): void {
    renew(this.#tools, ...palette(this.#tool, (tool) => this.#take(tool)));
    renew(this.#buttons, ...zoomButtons(this));
    const snap = option(t("Snap to joints, grid, angles and lengths"), this.#snapping, (on) => (this.#snapping = on));
    renew(
      this.#side,
      h("section.panel", {}, this.#instead, h("h2", {}, t("Mobility")), this.mobility.element),
      h("section.panel.options", {}, snap),
      this.#places,
    );
    this.root.setAttribute("aria-label", t("Plane to draw on"));
    this.#changed();
  }

  appeared(): void {
    const { linkage } = this.page;
    if (isOf(linkage, this.drawing)) this.#before = linkage;
    this.#offer();
    this.#resize();
  }

  /** What can be begun with, over the empty plane; else beside it what was opened after the last change. */
  #offer(): void {
    const { drawing, page } = this;
    const empty = !drawing.knots.length;
    const none = !empty && (page.linkage === this.#seen || isOf(page.linkage, drawing));
    const offered = none ? [] : starters(this, page.linkage, empty);
    renew(this.#starters, ...(empty ? offered : []));
    renew(this.#instead, ...(empty ? [] : offered));
  }

  begin(drawing: Drawing, known = false, tool: Tool = "move"): void {
    this.change(drawing);
    if (known) this.#known = drawing;
    this.#before = known ? this.page.linkage : null;
    this.#take(tool);
    this.viewport = this.#whole;
    this.fit();
    this.#resize();
  }

  empty(): void {
    this.begin(EMPTY, false, "ground");
  }

  /** Two places of the picture are put, then their distance is typed. */
  scale(): void {
    this.#take("scale");
  }

  #take(tool: Tool): void {
    this.#tool = tool;
    this.spots = [];
    this.chosen = null;
    this.aim = "away";
    this.arrange();
  }

  // --- changes -------------------------------------------------------------------------------------------------------

  change(next: Drawing | null, text = t("A link cannot meet itself.")): void {
    if (!next) {
      this.#draw();
      return this.page.say(text);
    }
    const { chosen, drawing } = this;
    const all = next.knots.length === drawing.knots.length;
    const stays = chosen?.link ? linksOf(next).includes(chosen.link) : all && !isPicture(chosen);
    if (!stays) this.chosen = null;
    this.#history.add(drawing);
    this.#seen = this.page.linkage;
    this.page.say("");
    this.#goTo(next);
  }

  get undoable(): [boolean, boolean] {
    return this.#history.possible;
  }

  undo(): void {
    this.#goBack(this.#history.undo(this.drawing));
  }

  redo(): void {
    this.#goBack(this.#history.redo(this.drawing));
  }

  #goBack(old: Drawing | undefined): void {
    if (!old) return;
    this.chosen = null;
    this.#goTo(old);
  }

  #goTo(drawing: Drawing): void {
    this.drawing = drawing;
    this.spots = []; // what they lay on may be gone
    this.#changed();
    this.page.changed();
  }

  #changed(): void {
    keepDrawing(this.drawing);
    keepDrawn(this.drawing, this.#history.all, this.#tool);
    this.#offer();
    this.#showPlaces();
    this.#draw();
    void this.mobility.tell();
  }

  /** Places and lengths as they are drawn, beside the plane and over it. */
  #showPlaces(): void {
    renew(this.#places, ...placesPanel(this));
    this.#showChoice();
  }

  /** What a click, a tap or Enter does at a place. */
  #put(spot: Spot): void {
    const { drawing } = this;
    const tool = this.#tool;
    const [held] = this.spots;
    if (this.#goingOn && held && joining(drawing, held, spot)) this.spots = []; // another link begins there
    this.#goingOn = false;
    const { spots } = this;
    spots.push(spot);
    if (this.aim === "aiming") this.aim = "here";
    if (tool === "scale") {
      if (spots.length > 2) this.spots = [spot]; // other places are wanted
      this.#draw();
      return this.#showChoice();
    }
    if (spots.length < wordsOf(tool).length - 1) return this.#draw();
    this.spots = [];
    const [from] = spots as [Spot];
    const link = tool === "link" && !same(from, spot) && joining(drawing, from, spot);
    if (link) return this.change(null, t("{link} joins them already.", { link: spaced(link) }));
    this.change(withTool(tool, drawing, spots));
    if (tool === "link" && spot.knot === null && spot.link === null) this.#goOn(spot.at);
  }

  /** The next link begins where the last one ends. */
  #goOn(at: Pair): void {
    const knot = this.drawing.knots.findIndex((one) => one.at === at);
    if (knot < 0) return;
    this.spots = [{ at, knot, link: null }];
    this.#goingOn = true;
    this.#draw();
  }

  /** A press puts a place; where the pointer is let go elsewhere the next one is put, too. */
  #pull(spot: Spot, event: PointerEvent, at: Pair): void {
    if (this.#tool === "slider" || this.#tool === "point") return this.#shape(spot, event, at);
    const again = this.spots.length === 1 && same(this.spots[0]!, spot);
    if (!again) this.#put(spot);
    if (this.spots.length !== 1 || (this.#goingOn && !again)) return;
    const waiting = this.spots;
    this.root.setPointerCapture(event.pointerId);
    const stop = whileDown(
      this.root,
      () => {},
      (next) => {
        stop();
        if (this.spots !== waiting || next.type !== "pointerup") return;
        const end = pixelIn(this.root, next);
        if (away(at, ...end) > GRIP) this.#put(this.#spot(end, next.shiftKey));
        else if (this.#goingOn || !again) this.#goingOn = false;
        else this.spots = [];
        this.#draw();
      },
    );
  }

  /** A slide that is dragged on gets its direction, a point its place. */
  #shape(spot: Spot, event: PointerEvent, start: Pair): void {
    const point = this.#tool === "point";
    const link = point ? linkFor(this, spot, start) : null;
    if (point && link === null) return this.page.say(t("Draw a link first."));
    if (point && spot.knot !== null && !this.drawing.knots[spot.knot]!.links[1]) return; // it is one
    const before = this.drawing;
    this.#put(point ? { ...spot, knot: null, link } : spot);
    const made = this.drawing;
    const last = made.knots.length - 1;
    if (made === before) return;
    this.root.setPointerCapture(event.pointerId);
    const moves = (next: PointerEvent) => {
      const now = pixelIn(this.root, next);
      if (this.#fingers.count > 1 || away(start, ...now) < GRIP) return;
      const [x, y] = made.knots[last]!.at;
      const [u, v] = this.viewport.world(...now);
      const degrees = Math.atan2(v - y, u - x) / DEGREE;
      const step = this.#snapping ? 15 : 1;
      if (point) this.cursor = this.#spot(now, next.shiftKey, last).at;
      this.drawing = point
        ? movedAlone(made, last, this.cursor)
        : turned(made, last, step * Math.round(degrees / step));
      this.#draw();
    };
    const stop = whileDown(this.root, moves, () => {
      stop();
      if (this.drawing === made || this.drawing === before) return;
      this.#goTo(this.drawing);
    });
  }

  // --- the pointer ---------------------------------------------------------------------------------------------------

  #spot(pixel: Pair, upright: boolean, but = -1): Spot {
    if (this.#tool === "scale") return { at: this.viewport.world(...pixel), knot: null, link: null };
    return spotAt(this, pixel, { snapping: this.#snapping, upright, but });
  }

  get step(): number {
    return stepOf(this.viewport);
  }

  /** What the mobility is once the tool has its last place there. */
  get ahead(): string {
    const { cursor, drawing, spots } = this;
    const tool = this.#tool;
    const more = wordsOf(tool).length - spots.length; // and its name
    if (this.aim !== "aiming" || tool === "move" || tool === "scale" || more > 2) return "";
    const spot = this.#spot(this.viewport.screen(...cursor), false);
    const next = withTool(tool, drawing, [...spots, spot]);
    return next?.frame && linksOf(next)[2] ? `F = ${counted(next)}` : "";
  }

  #draw(): void {
    this.#choice.classList.toggle("above", isLow(this));
    renew(this.#hint, ...hintOf(this.#tool, this.spots.length));
    renew(this.root, ...planePicture(this, this.#starters.offsetHeight));
  }

  #hover(event: PointerEvent): void {
    const now = pixelIn(this.root, event);
    if (this.#fingers.move(event.pointerId, now, this.viewport)) return this.#draw();
    if (this.#tool !== "move") this.#aimAt("aiming", this.#spot(now, event.shiftKey).at);
  }

  #down(event: PointerEvent): void {
    if (event.button > 0 || (event.target as SVGElement).dataset.span) return;
    let last = pixelIn(this.root, event);
    this.#fingers.put(event.pointerId, last);
    if (this.#fingers.count > 1) return this.#takeBack();
    this.#begun = [this.drawing, [...this.spots]];
    const spot = this.#spot(last, event.shiftKey);
    if (this.#tool !== "move") return this.#pull(spot, event, last);
    const before = this.drawing;
    const { picture } = before;
    const start = this.viewport.world(...last);
    const grip =
      picture && isPicture(this.chosen) && spot.knot === null
        ? gripAt(picture, start, GRIP / this.viewport.scale)
        : null;
    if (!grip) this.#choose(spot, start);
    this.root.setPointerCapture(event.pointerId);
    const moves = (next: PointerEvent) => {
      if (this.#fingers.count > 1) return;
      const now = pixelIn(this.root, next);
      if (grip) {
        const place = this.viewport.world(...now);
        this.drawing = { ...before, picture: gripped(picture!, grip, start, place) };
      } else if (spot.knot === null) this.viewport.pan(now[0] - last[0], now[1] - last[1]);
      else {
        this.cursor = this.#spot(now, false, spot.knot).at;
        this.aim = "aiming";
        this.drawing = movedKept(before, spot.knot, this.cursor) ?? before;
        this.#showPlaces();
      }
      last = now;
      this.#draw();
    };
    const up = (next: PointerEvent) => {
      stop();
      this.#aimAt("away");
      if (this.drawing === before) return;
      const placed = this.drawing;
      const target = spot.knot === null ? null : this.#spot(pixelIn(this.root, next), false, spot.knot).knot;
      this.drawing = before;
      this.change((target !== null && joined(before, spot.knot!, target)) || placed);
      if (grip) this.#choose(spot, this.viewport.world(...last));
    };
    const stop = whileDown(this.root, moves, up);
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
    const picked = picture && gripAt(picture, place, GRIP / this.viewport.scale);
    this.chosen = picked || !isPicture(spot) ? spot : null;
    this.#showChoice();
    this.#draw();
  }

  press(event: KeyboardEvent, target: Element): boolean {
    const here = target === this.root; // elsewhere these keys scroll and press buttons
    const way = here && WAYS[event.key];
    const tool = KEYS[event.key.toLowerCase()];
    if (way) {
      const step = event.shiftKey ? this.step / 5 : this.step;
      this.#aimAt("aiming", [this.cursor[0] + step * way[0], this.cursor[1] + step * way[1]]);
    } else if (here && (event.key === "Enter" || event.key === " ")) {
      const spot = this.#spot(this.viewport.screen(...this.cursor), false);
      if (this.#tool === "move") this.#choose(spot);
      else this.#put(spot);
    } else if (event.key === "Delete" || event.key === "Backspace") removeChosen(this);
    else if (event.key === "Escape") {
      this.spots = [];
      if (this.#tool === "scale") this.#take("move");
      this.#draw();
    } else if (tool) this.#take(tool);
    else return zoomedBy(event, this);
    return true;
  }

  // --- beside it -----------------------------------------------------------------------------------------------------

  /** How far two places of the picture lie apart. */
  #distance(from: Pair, to: Pair): HTMLElement {
    const { drawing } = this;
    const far = away(to, ...from);
    return field(this, `${t("Distance")} [${unitOf(drawing)}]`, "distance", far, (distance) => {
      if (!(distance > 0)) return null;
      this.#take("move");
      return { ...drawing, picture: enlarged(drawing.picture!, from, distance / far) };
    });
  }

  #typeDistance(): void {
    this.#choice.querySelector<HTMLElement>('[data-field="distance"]')?.focus();
  }

  #showChoice(): void {
    const [from, to] = this.#tool === "scale" ? this.spots : [];
    renew(this.#choice, ...(from && to ? [this.#distance(from.at, to.at)] : choiceOf(this)));
    this.#hint.hidden = !!(this.chosen || to);
    markLengths(this.#places, this);
  }

  get title(): string {
    return this.drawing.title ?? t("New drawing");
  }

  save(): void {
    saveDrawing(this.page, this.drawing, this.title);
  }

  moves(): boolean {
    const { drawing } = this;
    const fresh = drawing !== this.#known || (this.#made && this.page.linkage !== this.#made);
    if (!fresh || this.mobility.moving !== drawing) return false;
    void this.move();
    return true;
  }

  async move(): Promise<void> {
    const known = this.#known;
    this.#known = this.drawing;
    const opened = await openDrawn(this.page, this.drawing, this.#before);
    if (opened) this.#made = this.#before = this.page.linkage;
    else this.#known = known;
  }
}
