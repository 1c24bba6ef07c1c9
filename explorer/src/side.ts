/** The panels beside the motion: measures, sizes, plots, forces, points, assembly modes, options. */

import { documentOf } from "./document";
import { h, renew } from "./dom";
import { FactList, InWords } from "./factlist";
import { type Found, factsOf } from "./facts";
import { Forces, type Loaded } from "./forces";
import { t } from "./language";
import { deadCentres, isAngle, leastTransmission, shiftOf, travelOf } from "./measures";
import type { Model } from "./model";
import { type Editor, modesPanel, optionsPanel, pointsPanel, rulersPanel, SizeRows } from "./panels";
import { Plots } from "./plots";
import { panelOf } from "./shell";
import { whole } from "./waiting";

const MANY = 9; // links of which the sizes are folded at first
const RESTING = 100; // milliseconds without a step of a drag

/** The view that they stand beside. */
interface Panelled extends Editor, Loaded {
  readonly page: Loaded["page"];
  readonly linkage: Loaded["linkage"];
}

export class Side {
  readonly element = h("div.side", {});
  readonly plots: Plots;
  /** What was found over the cycle. */
  found: Found = { dead: [], travel: null, least: null };
  readonly forces: Forces;
  readonly #facts = new FactList((on) => {
    this.view.shown.way = on;
    this.view.redraw();
  });
  readonly #sizes: SizeRows;
  readonly #words: InWords;
  readonly #opened = new Set(["measures", "plots"]);
  #model: Model | null = null;
  /** What followed in the last step of a drag. */
  #turn = 0;
  #resting = 0;
  /** Whether it moves freely, and how far the panels, or on a phone the page, were scrolled before. */
  #falls = false;
  #scrolled = 0;

  constructor(private readonly view: Panelled) {
    this.plots = new Plots((value) => view.transport.pick(value));
    this.forces = new Forces(view, () => this.#opened.has("forces"));
    this.#sizes = new SizeRows(view);
    this.#words = new InWords(view.page);
  }

  /** Lay them out; what is measured is put into them afterwards. */
  arrange(): void {
    const { element, view } = this;
    const { model } = view.linkage;
    if (model !== this.#model) this.#opened[model.own > MANY ? "delete" : "add"]("sizes"); // plots would be far below
    this.#model = model;
    this.#words.arrange(view.linkage);
    const { scrollTop } = element; // before its parts leave it for new panels
    renew(
      element,
      this.#panel("measures", t("Measures"), this.#facts.element, rulersPanel(view), this.#words.element),
      this.#panel("sizes", t("Sizes"), this.#sizes.element),
      this.#panel("plots", t("Plots"), this.plots.element),
      this.#panel("forces", t("Forces"), this.forces.element),
      this.#panel("points", t("Coupler points"), pointsPanel(view)),
      this.#panel("modes", t("Assembly modes")),
      this.#panel("show", t("Show"), optionsPanel(view)),
    );
    if (this.#falls) this.#fall();
    element.scrollTop = scrollTop;
    this.plots.arrange(view.linkage);
  }

  /** Open a panel and bring it to sight. */
  open(key: string): void {
    const panel = this.element.querySelector<HTMLDetailsElement>(`[data-panel=${key}]`)!;
    panel.open = true;
    panel.scrollIntoView();
  }

  #panel(key: string, title: string, ...content: Node[]): HTMLElement {
    const element = panelOf(key, title, this.#opened.has(key), ...content);
    element.addEventListener("toggle", () => {
      if (element.open === this.#opened.has(key)) return; // as it was laid out
      if (element.open) this.#opened.add(key);
      else this.#opened.delete(key);
      if (key === "plots" && element.open) whole(this.plots.drawing(this.view.linkage));
      if (key !== "forces") return;
      this.forces.brings = element.open;
      this.forces.changed();
      this.view.redraw();
    });
    return element;
  }

  /** What is known of a free motion comes first, and what is known of the drive only is hidden; or all as before. */
  #fall(): void {
    const { element } = this;
    const falls = this.#falls;
    const panel = (key: string) => element.querySelector<HTMLElement>(`[data-panel=${key}]`)!;
    const forces = panel("forces");
    forces.firstElementChild!.textContent = falls ? t("Free motion") : t("Forces");
    for (const key of ["measures", "plots"]) panel(key).hidden = falls;
    if (falls) element.prepend(forces);
    else panel("points").before(forces);
  }

  #refresh(key: string, content: Node): void {
    const panel = this.element.querySelector(`[data-panel="${key}"] > div`);
    if (panel) renew(panel, content);
  }

  /** Another link is chosen. */
  chosen(): void {
    this.#sizes.show();
    this.#refresh("points", pointsPanel(this.view));
    this.#refresh("show", optionsPanel(this.view));
  }

  /** After a change: what takes longer than a frame, and what Python says, in pieces. */
  *measuring(): Generator<void> {
    const { linkage, transport } = this.view;
    this.#findTravel();
    this.#findLeast();
    yield;
    transport.showRange(this.found);
    clearTimeout(this.#resting);
    this.showPose();
    this.#sizes.show();
    yield;
    this.#refresh("points", pointsPanel(this.view));
    this.#refresh("modes", modesPanel(this.view));
    this.forces.changed();
    yield;
    if (this.#opened.has("plots")) yield* this.plots.drawing(linkage);
    this.#words.ask(linkage, () => documentOf(linkage, linkage.cycle.rows, linkage.cycle.home));
  }

  /** Where the output turns back, and how far it goes. */
  #findTravel(): void {
    const { linkage } = this.view;
    const dead = deadCentres(linkage);
    const travel = travelOf(linkage, dead);
    const shift = travel === 0 && isAngle(linkage) ? shiftOf(linkage) : 0;
    this.found = { ...this.found, dead, travel, shift };
  }

  #findLeast(): void {
    this.found = { ...this.found, least: leastTransmission(this.view.linkage) };
  }

  /** After each step of a drag: what follows at once. Texts, measures and plots take turns; where a cycle takes long,
   * texts and plots do in steps without one. All of them follow where it rests. */
  follow(): void {
    const { linkage, transport } = this.view;
    this.#words.wait();
    const alone = linkage.program.roots.length && !linkage.late;
    if (!alone) {
      const turn = (this.#turn + 1) % 4;
      this.#turn = turn;
      const soon = !linkage.program.roots.length;
      if (soon && turn === 1) this.#findTravel();
      else if (soon && turn === 2) this.#findLeast();
      else if (turn % 2 && this.#opened.has("plots")) this.plots.follow(linkage);
      else {
        transport.showRange(this.found);
        this.#sizes.follow();
        this.#showFacts();
      }
    }
    clearTimeout(this.#resting);
    this.#resting = setTimeout(() => this.#rest(), RESTING);
  }

  #rest(): void {
    const { linkage, transport } = this.view;
    linkage.rest();
    this.#findTravel();
    this.#findLeast();
    transport.showRange(this.found);
    this.#sizes.follow();
    this.view.redraw();
    if (this.#opened.has("plots")) whole(this.plots.drawing(linkage));
    this.showPose();
  }

  showPose(): void {
    const { linkage, transport } = this.view;
    const { element } = this;
    const turned = this.#falls !== !!transport.falling;
    if (turned) {
      this.#falls = !this.#falls;
      if (this.#falls) this.#scrolled = element.scrollTop || scrollY;
      this.#fall();
      // on a phone the picture is seen that moves
      const view = element.parentElement;
      if (this.#falls && view?.querySelector(".low")) view.scrollIntoView();
    }
    if (linkage.drive) {
      const drive = transport.falling ? NaN : transport.drive; // what is plotted is not of a free motion
      this.plots.at(drive);
      this.forces.at(drive);
    }
    if (turned) element.scrollTop = this.#falls ? 0 : this.#scrolled; // all panels have their heights
    if (transport.falling) transport.showValue();
    else this.#showFacts();
  }

  /** Show again, also on a phone, from where it was let go. */
  back(): void {
    if (this.element.clientHeight === this.element.scrollHeight) scrollTo(0, this.#scrolled);
  }

  #showFacts(): void {
    const { linkage, transport } = this.view;
    transport.showValue();
    this.#facts.show(factsOf(linkage, this.found, (angle) => this.plots.plottedAngle(linkage, angle)));
  }
}
