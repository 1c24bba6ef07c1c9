/** The view of the synthesis: what a linkage is to do, put into a plane or a table; designs that do it play over it. */

import { type Area, areaOf, gridOf, viewBoxOf } from "./area";
import { type Design, DesignCards, type Found } from "./designs";
import { choice, h, renew, svg } from "./dom";
import { Ghost } from "./ghost";
import { History } from "./history";
import { t } from "./language";
import type { Model, Target } from "./model";
import { evenly, numberPlaces, rowsTable, swingMark, swingOf, targetMark, tip } from "./targets";
import { FEWEST, type Kind, wordsOf } from "./tasks";
import type { Page, View } from "./view";
import { awaited } from "./waiting";

/** What a click or a stroke puts. */
type Puts = "" | "pivot" | "curve";

/** What is undone: the kind that is shown, and whether the curve is closed, rows and pivots as a text. */
type State = [Kind, string];

/** Points of a page without the library. */
const NINE = 9;

const WIDE = 240; // of the plane, in millimetres; that of a phone is narrower
const NEAR = 4; // units of marks that a pointer reaches; a finger needs more
const TURN = 20; // degrees from a new position to the next
const OF_STROKE = 20; // points of a curve that is drawn

export class SynthesisView implements View {
  readonly element = h("div.view", { "data-page": "synthesis" });
  private kind: Kind = "points";
  private rows: Record<Kind, number[][]> = {
    positions: [],
    points: [],
    function: [
      [0, 0],
      [45, 25],
      [90, 60],
    ],
    "dead-centres": [[60, 1.2]],
  };
  #pivots: number[][] = [];
  #puts: Puts = "";
  #closed = false;
  #crank = true;
  /** Places of the targets in the order, as they are typed. */
  #order = "";
  #least = 20; // degrees
  #shownDesign: Design | null = null;
  /** How wide the plane is before there is anything in it; that of points out of a file is as wide as they need. */
  #home = 0;
  #area!: Area;
  readonly #history = new History<State>();
  /** The targets before the change that is going on. */
  #before = this.#state;
  /** What the pointer takes along. */
  #held: ((at: [number, number]) => void) | null = null;
  private readonly marks = svg("g");
  readonly #ghost = new Ghost(() => this.element.classList.contains("shown"));
  readonly #plane = svg("svg.plane", { role: "application", tabindex: 0 }, this.marks);
  readonly #list = h("div", {});
  /** How many are set; while linkages are looked for, how far that is stands in its place. */
  readonly #told = h("span.note", { "data-fact": "set" });
  private readonly designs = new DesignCards(
    (design) => this.#play(design),
    (design) => void this.#open(design),
  );
  private readonly status = h("div.form", {});
  readonly #page: Page;

  constructor(page: Page) {
    this.#page = page;
    this.#plane.addEventListener("pointerdown", (event) => this.#down(event));
    this.#plane.addEventListener("pointermove", (event) => this.#held?.(this.#at(event)));
    for (const event of ["pointerup", "pointercancel"])
      this.#plane.addEventListener(event, () => {
        this.#held = null;
        if (this.#puts === "curve")
          this.arrange(); // whether it is closed
        else this.#draw();
      });
  }

  appeared(): void {
    this.#play(this.#shownDesign); // now the width of the plane is known
  }

  /** Other points, out of a file. */
  take(points: [number, number][], closed: boolean, order: (number | null)[] = []): void {
    this.kind = "points";
    this.#puts = "";
    this.rows.points = points;
    this.#closed = closed;
    this.#order = order.map((rank) => rank ?? "–").join(" ");
    const far = Math.max(...points.flat().map(Math.abs));
    this.#home = far > WIDE / 2 || far < WIDE / 12 ? 2.4 * far : 0;
    this.designs.show(null);
    this.arrange();
  }

  private get points(): number[][] {
    return this.rows[this.kind];
  }

  get #planar(): boolean {
    return this.kind === "points" || this.kind === "positions";
  }

  /** Whether the rows lie in the plane: that of angles is free while no design plays in it. */
  get #plotted(): boolean {
    return this.#planar || (this.kind === "function" && !this.#shownDesign);
  }

  arrange(): void {
    const option = (text: string, checked: boolean, set: (on: boolean) => void, key: string) => {
      const box = h("input", { type: "checkbox", checked, "data-field": key, onchange: () => set(box.checked) });
      return h("label", {}, box, text);
    };
    const least = h("input", {
      type: "number",
      min: 0,
      max: 90,
      value: this.#least,
      "data-field": "least",
      onchange: () => (this.#least = Number(least.value)),
    });
    const order = h("input", {
      value: this.#order,
      "aria-label": t("order, if another"),
      placeholder: "1 2 3",
      "data-field": "order",
      onchange: () => (this.#order = order.value),
    });
    const kinds = (["points", "positions", "function", "dead-centres"] as const).map((kind): [Kind, string] => [
      kind,
      wordsOf(kind).name,
    ]);
    const clicks: [string, string][] =
      this.kind === "points"
        ? [
            ["", t("Put points")],
            ["curve", t("A curve drawn by hand")],
          ]
        : [
            ["", t("Put positions")],
            ["pivot", t("Put fixed pivots")],
          ];
    this.#plane.setAttribute("aria-label", t("What is to be met"));
    this.#list.classList.toggle("first", !this.#planar);
    const open = this.kind === "points";
    renew(
      this.element,
      h(
        "div.page",
        {},
        h("h2", {}, t("Synthesis")),
        choice(t("What a linkage is to do"), kinds, this.kind, (kind) => this.#turnTo(kind as Kind)),
        h("p.note", {}, wordsOf(this.kind).hint),
        this.#page.served
          ? null
          : h(
              "p.note",
              {},
              t("Here four-bars through nine points are found; everything else needs the library: gruebler explore"),
            ),
        h(
          "div.two.wide",
          {},
          h(
            "div",
            {},
            this.#planar
              ? choice(t("What is to be met"), clicks, this.#puts, (value) => (this.#puts = value as Puts))
              : null,
            h("div.chain-picture", {}, this.#plane),
          ),
          h(
            "div",
            {},
            h(
              "div.form",
              {},
              open ? option(t("closed curve"), this.#closed, (on) => this.#close(on), "closed") : null,
              option(t("the crank turns fully"), this.#crank, (on) => (this.#crank = on), "crank"),
              h("label", {}, t("transmission angle from"), least, "°"),
              ...(this.#planar && this.#page.served
                ? [
                    h(
                      "details.words",
                      { open: this.#order !== "" },
                      h("summary", {}, t("order, if another")),
                      order,
                      h(
                        "p.note",
                        {},
                        t("One number for each target: the same for those in any order, – for one at any time"),
                      ),
                    ),
                  ]
                : []),
            ),
            h(
              "div.form",
              {},
              h("button.key", { "data-act": "synthesise", onclick: () => void this.#search() }, t("Find linkages")),
              this.#planar
                ? h("button.plain", { "data-act": "clear", onclick: () => this.#clear() }, t("Remove all points"))
                : null,
            ),
            h("div.told", {}, this.status, this.#told),
            this.#list, // grows, and moves nothing
            this.designs.element,
          ),
        ),
      ),
    );
    this.#draw();
    this.designs.arrange();
  }

  #turnTo(kind: Kind): void {
    this.kind = kind;
    this.#puts = "";
    this.designs.show(null);
    this.#play(null);
    renew(this.status);
    this.arrange();
  }

  #close(on: boolean): void {
    this.#closed = on;
    this.#draw();
  }

  #at(event: PointerEvent): [number, number] {
    const box = this.marks.getScreenCTM()!.inverse();
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(box);
    const { left, right } = this.#area;
    const fine = 10 ** Math.ceil(Math.log10(1000 / (right - left)));
    const round = (value: number) => Math.round(value * fine) / fine;
    return [round(point.x), round(-point.y)];
  }

  #down(event: PointerEvent): void {
    if (!this.#plotted) return;
    const [x, y] = this.#at(event);
    this.#plane.setPointerCapture(event.pointerId);
    if (this.#puts === "curve") return this.#stroke(x, y);
    const { unit } = this.#area;
    const reach = (event.pointerType === "touch" ? 2 : 1) * NEAR * unit;
    const near = ([u, v]: number[]) => Math.hypot(u! - x, v! - y) < reach;
    const move = (row: number[]) => {
      this.#held = ([u, v]) => {
        [row[0], row[1]] = [u, v];
        this.#draw();
      };
    };
    const turned = this.kind === "positions" && this.points.find((row) => near(tip(row, unit)));
    // an arrow points where its end is dragged to, that of a new position from its place on
    const turn = (row: number[]) => {
      this.#held = ([u, v]) => {
        if (near([u, v]) && row !== turned) return;
        row[2] = Math.round((Math.atan2(v - row[1]!, u - row[0]!) * 180) / Math.PI);
        this.#draw();
      };
    };
    const here = [...this.points, ...(this.kind === "positions" ? this.#pivots : [])].find(near);
    if (turned) turn(turned);
    else if (here) move(here);
    else {
      const pivot = this.#puts === "pivot";
      const turns = this.kind === "positions" && !pivot;
      const row = turns ? [x, y, this.points.length ? this.points.at(-1)![2]! + TURN : 0] : [x, y];
      (pivot ? this.#pivots : this.points).push(row);
      if (turns) turn(row);
      else move(row);
      this.#draw();
    }
  }

  /** A curve in the place of the points; where it ends near its start it is closed. */
  #stroke(x: number, y: number): void {
    const line = [[x, y]];
    this.#held = (place) => {
      line.push(place);
      const { places, closed } = evenly(line, OF_STROKE);
      this.rows.points = places;
      this.#closed = closed;
      this.#draw();
    };
  }

  #clear(): void {
    this.rows[this.kind] = [];
    this.#pivots = [];
    this.designs.show(null);
    this.#play(null);
    this.#draw();
  }

  /** What is to be met, as the stage shows it. */
  private get targets(): Target[] {
    return this.#planar ? this.points.map((row) => [...row] as Target) : [];
  }

  #draw(): void {
    this.#paint();
    this.#drawList();
    if (!this.#held) this.#keep();
  }

  // --- what is undone ------------------------------------------------------------------------------------------------

  get #state(): State {
    return [this.kind, JSON.stringify([this.#closed, this.rows, this.#pivots])];
  }

  #keep(): void {
    const before = this.#before;
    this.#before = this.#state;
    if (before[1] === this.#before[1]) return;
    this.#history.add(before);
    if (!this.#planar) this.#play(null);
    this.#page.changed();
  }

  get undoable(): [boolean, boolean] {
    return this.#history.possible;
  }

  undo(): void {
    this.#step("undo");
  }

  redo(): void {
    this.#step("redo");
  }

  #step(way: "undo" | "redo"): void {
    const state = this.#held ? undefined : this.#history[way](this.#before);
    if (!state) return;
    this.#before[0] = state[0]; // where the change was made, which may be done again
    this.#before = state;
    if (this.kind !== state[0]) this.#puts = ""; // the other kind has no such tool
    this.kind = state[0];
    [this.#closed, this.rows, this.#pivots] = JSON.parse(state[1]);
    this.#play(null);
    this.arrange();
    this.#page.changed();
  }

  #drawList(): void {
    const { row, heads } = wordsOf(this.kind);
    const single = this.kind === "dead-centres";
    const last = this.points.at(-1) ?? [];
    const table = (rows: number[][], name: string, head: string[]) =>
      rowsTable(rows, name, head, !single, () => this.#draw());
    const add = () => {
      this.points.push(last.map((value) => value + 30));
      this.#draw();
    };
    const count = this.points.length;
    const wanted = this.#page.served || this.kind !== "points" ? FEWEST[this.kind] : NINE;
    const missing = wanted - count;
    const told =
      missing > 0
        ? t("{count} of {wanted} set, {missing} missing", { count, wanted, missing })
        : t("{count} set: enough to find linkages", { count });
    this.#told.textContent = this.#planar ? told : "";
    renew(
      this.#list,
      this.points.length
        ? h(
            "div.points",
            {},
            table(this.points, row, heads),
            this.kind === "positions" && this.#pivots.length ? table(this.#pivots, t("Fixed pivot"), ["x", "y"]) : null,
          )
        : "",
      this.kind === "function" ? h("button.plain", { "data-act": "pair", onclick: add }, t("Another pair")) : "",
      this.kind === "positions" && this.points.length > 1 && this.points.every(([, , angle]) => angle === last[2])
        ? h("p.note", {}, t("All at one angle: the link is shifted and does not turn."))
        : "",
    );
  }

  async #search(): Promise<void> {
    const count = FEWEST[this.kind];
    if (this.points.length < count)
      return renew(this.status, h("span.error", { role: "alert" }, t("Give at least {count} points.", { count })));
    const question = {
      kind: this.kind,
      rows: this.points,
      pivots: this.kind === "positions" ? this.#pivots : [],
      closed: this.kind === "points" && this.#closed,
      order: this.#planar ? (this.#order.match(/[^\s,;]+/g) ?? []).map((rank) => (/\d/.test(rank) ? +rank : null)) : [],
      crank: this.#crank,
      transmission: this.#least,
    };
    const found = await awaited(this.status, (progress) => this.#page.ask<Found>("synthesise", question, progress));
    if (!found) return;
    this.#play(this.designs.show(found));
    this.designs.element.scrollIntoView(); // beside the plane, which stays in sight
  }

  // --- a design plays over its targets -------------------------------------------------------------------------------

  /** The plane with what is put into it, and where the design that plays comes to; while a mark is held it stays. */
  #paint(): void {
    const { kind, points } = this;
    const [plotted, plane, shownDesign] = [this.#plotted, this.#plane, this.#shownDesign];
    const angles = kind === "function";
    const swung = plotted || shownDesign ? [] : swingOf(points[0]![0]!);
    const pivots = kind === "positions" ? this.#pivots : [];
    const places = [...(plotted ? [...points, ...pivots] : swung), ...(shownDesign?.frames.flat() ?? [])];
    if (!this.#held) {
      const narrow = plane.clientWidth && plane.clientWidth < 500;
      const wide = this.#planar ? this.#home || (narrow ? 0.6 : 1) * WIDE : 0;
      const part = narrow && shownDesign ? 0.32 : 0.6; // room for the designs
      this.#area = areaOf(shownDesign ? -Infinity : wide, part, places, plane);
      plane.setAttribute("viewBox", viewBoxOf(this.#area));
    }
    const { unit } = this.#area;
    const way = angles ? [...points].sort(([one], [two]) => one! - two!) : points;
    const line = kind === "positions" ? "" : way.map(([x, y]) => `${x} ${-y!}`).join("L");
    const d = line && `M${line}${this.#closed && !angles && points.length > 2 ? "Z" : ""}`;
    const at = numberPlaces(points, this.#closed && !angles, unit);
    const marks = [
      ...gridOf(this.#area, angles ? wordsOf(kind).heads : []),
      svg("path.polygon", { d }),
      this.#ghost.element,
      ...points.map((row, k) => targetMark(row, k, at[k]!, unit)),
      ...pivots.map(([x, y]) =>
        svg("path.pivot", { d: "M0 0l4 6h-8z", transform: `translate(${x} ${-y!}) scale(${unit})`, "data-pivot": "" }),
      ),
    ];
    const grid = shownDesign ? gridOf(this.#area, ["", ""]) : []; // of lengths whose ratios count
    renew(this.marks, ...(plotted ? marks : [...grid, this.#ghost.element, ...swingMark(swung, points[0]![0]!, unit)]));
  }

  #play(design: Design | null): void {
    this.#shownDesign = design;
    this.#paint();
    this.#ghost.play(design, this.#area.unit);
  }

  async #open(design: Design): Promise<void> {
    const name = wordsOf(this.kind, this.points.length).design;
    try {
      const document = { ...design.document, page: { targets: this.targets } };
      const model = await this.#page.ask<Model>("open_document", { document, name });
      this.#page.open({ ...model, plays: true });
    } catch (error) {
      this.#page.say((error as Error).message);
    }
  }
}
