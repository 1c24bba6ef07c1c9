/** The view of the synthesis: what a linkage is to do, put into a plane or a table; designs that do it play over it. */

import { DEGREE } from "./cycle";
import { Demands } from "./demands";
import { type Design, DesignCards, type Found } from "./designs";
import { action, choice, h, option, renew } from "./dom";
import { History } from "./history";
import { t } from "./language";
import type { Model, Target } from "./model";
import { store, stored } from "./storing";
import { ARM, armOf, evenly, rowsTable, tip } from "./targets";
import { TaskPicture } from "./taskpicture";
import { FEWEST, type Kind, PLACE, wordsOf } from "./tasks";
import type { Page, View } from "./view";
import { awaited } from "./waiting";

/** What a click or a stroke puts. */
type Puts = "" | "pivot" | "curve";

/** What is undone: the kind that is shown, and whether the curve is closed, rows and pivots as a text. */
type State = [Kind, string];

/** Points of a page without the library. */
const NINE = 9;

/** Where the targets are kept for a page that is loaded again. */
const KEPT = "gruebler-targets";
const WIDE = 240; // of the plane in which points of files are seen, in millimetres
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
  readonly #demands = new Demands();
  #shownDesign: Design | null = null;
  /** How wide the plane is before there is anything in it; that of points out of a file is as wide as they need. */
  #home = 0;
  /** The curve that is being drawn. */
  #line: number[][] | null = null;
  readonly #history = new History<State>();
  /** The question that the designs answer. */
  #asked = "";
  /** The targets before the change that is going on. */
  #before = this.#state;
  /** What the pointer takes along. */
  #held: ((at: [number, number]) => void) | null = null;
  readonly #picture = new TaskPicture(() => this.element.classList.contains("shown"));
  readonly #key = h("button.key", { "data-act": "synthesise", onclick: () => void this.#search() });
  readonly #list = h("div.targets", {});
  /** How many targets are missing; whether the designs answer another question. */
  readonly #told = h("span.note", { "data-fact": "set" });
  private readonly designs = new DesignCards(
    (design) => this.#play(design),
    (design, title) => void this.#open(design, title),
  );
  private readonly status = h("div.told", {});
  /** What stays in sight beside the designs. */
  readonly #doing = h("div.doing", {});
  readonly #clearing = action("clear", () => this.#clear());
  readonly #page: Page;
  readonly #say = (text: string) => this.#page.say(text);

  constructor(page: Page) {
    this.#page = page;
    const kept = stored<State>(KEPT);
    if (kept) this.#restore(kept);
    const { plane } = this.#picture;
    plane.addEventListener("pointerdown", (event) => this.#down(event));
    plane.addEventListener("pointermove", (event) => this.#held?.(this.#placeOf(event)));
    for (const event of ["pointerup", "pointercancel"])
      plane.addEventListener(event, () => {
        this.#held = null;
        this.#line = null;
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
    this.#demands.order = order.map((rank) => rank ?? "–").join(" ");
    const far = Math.max(...points.flat().map(Math.abs));
    this.#home = far > WIDE / 2 || far < WIDE / 12 ? 2.4 * far : 0;
    this.#begin();
  }

  /** Nothing is found yet. */
  #begin(): void {
    this.designs.show(null);
    this.#play(null);
    this.arrange();
  }

  private get points(): number[][] {
    return this.rows[this.kind];
  }

  get #planar(): boolean {
    return this.kind === "points" || this.kind === "positions";
  }

  /** How large a curve is all of which is wanted; 0 of single points. */
  get #curve(): number {
    if (this.kind !== "points" || !(this.#puts || this.points[NINE])) return 0;
    const spans = [0, 1].map((axis) => {
      const values = this.points.map((row) => row[axis]!);
      return Math.max(...values) - Math.min(...values);
    });
    return +Math.max(0, ...spans).toPrecision(2);
  }

  arrange(): void {
    const kinds = (["points", "positions", "function", "dead-centres"] as const).map((kind): [Kind, string] => [
      kind,
      wordsOf(kind).name,
    ]);
    const clicks: [string, string][] =
      this.kind === "points"
        ? [
            ["", t("Place points")],
            ["curve", t("Draw a curve")],
          ]
        : [
            ["", t("Place positions")],
            ["pivot", t("Place fixed pivots")],
          ];
    const hints: Record<Puts, string> = {
      "": wordsOf(this.kind).hint,
      pivot: t("Place one or two pivots that the linkage shall have on the frame."),
      curve: t("Draw the curve in one stroke, a closed one to its start; the nearest coupler curves are found."),
    };
    this.#picture.plane.setAttribute("aria-label", t("What is to be met"));
    this.element.classList.toggle("typed", !this.#planar);
    renew(this.#key, t("Find linkages"));
    renew(this.#clearing, t("Clear"));
    const back = () => this.element.scrollIntoView();
    const close = (on: boolean) => {
      this.#closed = on;
      this.#draw();
    };
    const put = (value: string) => {
      this.#puts = value as Puts;
      this.arrange();
    };
    renew(
      this.#doing,
      this.#picture.element,
      h(
        "div.form",
        {},
        this.#key,
        this.#planar && this.#clearing,
        h("button.plain", { "data-act": "back", title: t("To the targets"), onclick: back }, "↑"),
        this.status,
      ),
    );
    this.#picture.element.prepend(this.#told);
    const demands = this.#demands.form(
      this.kind === "points" && option(t("Closed curve"), this.#closed, close, "closed"),
      this.kind !== "dead-centres",
      this.#planar && this.#page.served,
      this.#curve,
      () => this.#draw(),
    );
    renew(
      this.element,
      h(
        "div.page",
        {},
        h("h2", {}, t("Synthesis")),
        choice(t("What a linkage is to do"), kinds, this.kind, (kind) => this.#turnTo(kind as Kind)),
        this.#page.served
          ? null
          : h("p.note", {}, t("Here four-bars through nine points are found; for all else: gruebler explore")),
        h(
          "div.two.wide",
          {},
          h(
            "div",
            {},
            h("p.note", {}, hints[this.#puts]),
            this.#planar && choice(t("What is to be met"), clicks, this.#puts, put),
            this.#doing,
          ),
          h("div", {}, ...(this.#planar ? [demands, this.#list] : [this.#list, demands]), this.designs.element),
        ),
      ),
    );
    this.#draw();
    this.designs.arrange();
  }

  #turnTo(kind: Kind): void {
    this.kind = kind;
    this.#puts = "";
    this.status.querySelector("button")?.click(); // what is looked for is given up
    renew(this.status);
    this.#begin();
  }

  #placeOf(event: PointerEvent): [number, number] {
    return this.#picture.at(event, this.#puts !== "curve");
  }

  #down(event: PointerEvent): void {
    if (this.kind === "dead-centres") return;
    const [x, y] = this.#placeOf(event);
    this.#picture.plane.setPointerCapture(event.pointerId);
    if (this.#puts === "curve") return this.#stroke(x, y);
    const { unit, marked } = this.#picture;
    const reach = (event.pointerType === "touch" ? 2 : 1) * NEAR * unit;
    const near = ([u, v]: number[]) => Math.hypot(u! - x, v! - y) < reach;
    const move = (row: number[]) => {
      this.#held = ([u, v]) => {
        [row[0], row[1]] = [u, v];
        this.#draw();
      };
    };
    const arm = marked * armOf(this.points, ARM, marked);
    const turned = this.kind === "positions" && this.points.find((row) => near(tip(row, arm)));
    // an arrow points where its end is dragged to, that of a new position from its place on
    const turn = (row: number[]) => {
      this.#held = ([u, v]) => {
        if (near([u, v]) && row !== turned) return;
        row[2] = Math.round(Math.atan2(v - row[1]!, u - row[0]!) / DEGREE);
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
      this.#line = line;
      line.push(place);
      const { places, closed } = evenly(line, OF_STROKE);
      if (this.#shownDesign) this.#play(null);
      this.rows.points = places;
      this.#closed = closed;
      this.#draw();
    };
  }

  #clear(): void {
    if (this.#searching) return;
    this.rows[this.kind] = [];
    this.#pivots = [];
    this.#closed = false;
    this.#begin();
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
    store(KEPT, this.#before);
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
    if (this.kind !== state[0]) this.#puts = ""; // the other kind has no such tool
    this.#restore(state);
    this.#play(null);
    this.arrange();
    this.#page.changed();
  }

  #restore(state: State): void {
    store(KEPT, state);
    this.#before = state;
    [this.kind] = state;
    [this.#closed, this.rows, this.#pivots] = JSON.parse(state[1]);
  }

  #drawList(): void {
    const { name, row, heads } = wordsOf(this.kind);
    const single = this.kind === "dead-centres";
    const last = this.points.at(-1) ?? [];
    const table = (rows: number[][], title: string, head: string[]) =>
      rowsTable(rows, title, head, !single, () => this.#draw(), this.#say, single ? () => "" : undefined);
    const add = () => {
      this.points.push(last.map((value) => value + 30));
      this.#draw();
    };
    const count = this.points.length;
    const wanted = this.#page.served || this.kind !== "points" ? FEWEST[this.kind] : NINE;
    const lacks = count < wanted ? t("{count} set, at least {wanted} needed", { count, wanted }) : "";
    this.#key.disabled = !!lacks;
    this.#key.title = lacks;
    this.#clearing.disabled = !count && !this.#pivots.length;
    const former =
      this.designs.element.firstChild && this.#asked !== this.#question && t("Designs for the former requirements");
    this.#told.textContent = (this.#puts !== "curve" && lacks) || former || "";
    this.designs.outdate(former || "");
    const tables = h(
      "div.points",
      {},
      table(this.points, row, heads),
      this.kind === "positions" && !!this.#pivots.length && table(this.#pivots, t("Fixed pivot"), PLACE),
    );
    const { open } = this.#list.querySelector("details") ?? {};
    if (this.kind === "function") tables.append(h("div.form", {}, action("pair", add, t("Another pair"))));
    const folds = this.points[NINE] || (!single && this.designs.element.firstChild);
    const set = folds ? h("details.words", { open }, h("summary", {}, `${name} · ${count}`), tables) : tables;
    renew(this.#list, count ? set : "");
  }

  /** Meanwhile its buttons do nothing. */
  get #searching(): boolean {
    return !!this.status.querySelector("progress");
  }

  /** What the library is asked, as a text. */
  get #question(): string {
    const { kind } = this;
    return JSON.stringify({
      kind,
      rows: this.points,
      pivots: kind === "positions" ? this.#pivots : [],
      closed: kind === "points" && this.#closed,
      ...this.#demands.asked(this.#planar, this.#curve),
    });
  }

  async #search(): Promise<void> {
    if (this.#searching) return;
    this.#page.say(""); // why the search before found nothing
    const { kind } = this;
    const asked = this.#question;
    const found = await awaited(this.status, (progress) =>
      this.#page.ask<Found>("synthesise", JSON.parse(asked), progress),
    );
    if (kind !== this.kind) return renew(this.status);
    const why = this.status.textContent;
    if (!found && why !== t("Cancelled.")) {
      renew(this.status); // in a bar there is no room for a sentence
      this.#page.say(why);
    }
    if (!found) return;
    this.#asked = asked;
    this.#play(this.designs.show(found));
    this.#drawList();
    // on a phone below the plane, which stays in sight
    const { element } = this.designs;
    element.style.scrollMarginTop = `${this.#doing.offsetHeight - this.#key.offsetHeight}px`;
    if (element.offsetLeft < this.#doing.offsetWidth) element.scrollIntoView();
  }

  // --- a design plays over its targets -------------------------------------------------------------------------------

  #paint(): void {
    const { kind, points } = this;
    const pivots = kind === "positions" ? this.#pivots : [];
    const closed = kind === "points" && this.#closed;
    const region = this.#planar ? this.#demands.region([...points, ...pivots], this.#curve) : [];
    const [stroke, design, home] = [this.#line, this.#shownDesign, this.#home];
    const task = { kind, points, pivots, region, closed, stroke, design, home };
    this.#picture.paint(task, !!this.#held);
  }

  #play(design: Design | null): void {
    this.#shownDesign = design;
    if (!design) this.designs.mark(null);
    this.#paint();
  }

  async #open(design: Design, title: string): Promise<void> {
    const name = `${wordsOf(this.kind).name}: ${title}`;
    const document = {
      ...design.document,
      page: { targets: this.targets, pairs: design.pairs, backward: design.backward },
    };
    await this.#page.choose(this.#page.ask<Model>("open_document", { document, name }), (model) =>
      this.#page.open(model),
    );
  }
}
