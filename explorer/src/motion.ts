/** The view of the motion: stage, drive, sizes, measures, plots. */

import type { Stop } from "./cycle";
import { applyDocument, savedDocument } from "./document";
import { action, h, wantsStill } from "./dom";
import { Dragging } from "./dragging";
import type { Found } from "./facts";
import type { Kept } from "./forces";
import { drivenBy } from "./help";
import { History } from "./history";
import { keepSizes, keptSizes } from "./kept";
import { t } from "./language";
import { Linkage } from "./linkage";
import { floatingLink } from "./measures";
import type { LinkageDocument, Model } from "./model";
import type { Editor } from "./panels";
import { PlaneTransport } from "./planetransport";
import type { Plots } from "./plots";
import { Refused } from "./refused";
import { type Pair, place } from "./rows";
import { AT_FIRST, type Shown } from "./shown";
import { Side } from "./side";
import { snappedOn } from "./snapping";
import { alike, type Snapshot, sameSizes } from "./snapshot";
import { Stage } from "./stage";
import { tableOf } from "./table";
import { type Driven, SPEED } from "./transport";
import type { Page, View } from "./view";
import { whole } from "./waiting";
import { refusedText, stopText } from "./wording";

const MOST_FRAMES = 2000;

/** What is shown, to be shown again. */
interface State {
  linkage: Linkage;
  dragging: Dragging;
  sizes: Snapshot;
}

export class MotionView implements View, Editor, Driven {
  readonly element = h("div.view.motion", {});
  readonly shown: Shown = {
    ...AT_FIRST,
    forces: (drive) => this.side.forces.arrows(drive),
    springs: (linkage) => this.side.forces.springsOf(linkage.model),
  };
  linkage!: Linkage;
  dragging!: Dragging;
  readonly stage: Stage;
  readonly transport = new PlaneTransport(this);
  readonly side: Side;
  /** Milliseconds of the last frames in which something was drawn. */
  readonly frames: number[] = [];
  readonly #history = new History<State>();
  /** The views in which linkages were drawn. */
  readonly #drawnIn = new WeakMap<Linkage, string>();
  /** What was before the change that is going on. */
  #before: State | null = null;

  constructor(readonly page: Page) {
    this.side = new Side(this);
    this.stage = new Stage(
      {
        dragStart: () => this.#begin(),
        dragJoint: (joint, at, snap) =>
          this.#tryTo(() => this.dragging.dragJoint(joint, ...this.#meant(joint, at, snap))),
        dragEnd: () => this.#end(),
        dragCancel: () => this.#cancel(),
        dragPoint: (point, at, snap) => this.#putPoint(point, ...this.#meant(null, at, snap)),
        movePointBy: (point, dx, dy) => this.#movePointBy(point, dx, dy),
        pull: (link, u, v, x, y) => this.transport.pull(link, u, v, x, y),
        addPoint: (link, x, y) => this.addPoint(link ?? this.shown.link, x, y),
        choose: (link) => (this.stage.adding ? this.#carry(link) : this.#choose(link)),
        holdJoint: (joint) => {
          this.attempt(() => this.dragging.locks.hold(joint));
          this.show();
          this.stage.focus(joint);
        },
        moveJointBy: (joint, dx, dy) => {
          const [x, y] = this.linkage.jointAt(joint);
          this.attempt(() => this.dragging.dragJoint(joint, x + dx, y + dy));
        },
      },
      this.shown,
    );
    this.element.append(this.stage.element, this.transport.element, this.side.element);
  }

  // --- what is shown -------------------------------------------------------------------------------------------------

  /** Show another linkage; the way back to the one before is undoing. */
  open(model: Model, view?: string): void {
    this.transport.endFall();
    this.transport.pause();
    if (this.linkage) this.#history.add(this.#state());
    this.take(model);
    this.transport.speed = SPEED; // not that of the loads of the one before
    this.side.element.scrollTop = 0;
    if (view) this.#drawnIn.set(this.linkage, view);
    this.#renewed();
  }

  /** Show the same machine with other sizes of its cams, at the same value of the drive; it can be undone. */
  resized(model: Model): void {
    const { active, drives } = this.linkage;
    const linkage = new Linkage(model);
    if (active) linkage.choose(active);
    linkage.moveTo(drives[active]!);
    this.#history.add(this.#state());
    this.#goTo({ linkage, dragging: new Dragging(linkage), sizes: linkage.snapshot() });
  }

  /** Another linkage, which is not shown yet. */
  take(model: Model): void {
    this.linkage = new Linkage(model);
    this.dragging = new Dragging(this.linkage);
    this.shown.chosen = null;
    this.shown.link = floatingLink(model);
  }

  /** Let what was opened move, unless the reader wants no motion. */
  run(): void {
    if (this.linkage.drive && !wantsStill()) this.transport.toggle();
  }

  /** Other sizes of the same structure, as a link holds them. */
  openDocument(document: LinkageDocument, drive?: number): void {
    this.#history.add(this.#state());
    this.#tryTo(() => applyDocument(this.linkage, document, drive));
    this.#renewed();
  }

  /** Nothing can be undone from here on. */
  forget(): void {
    this.#history.clear();
  }

  /** Keep what can be undone for the same page when it is loaded again, with the part of the address that holds it. */
  keep(link: string): void {
    const past = this.#history.all.flatMap(({ linkage, sizes }) => (linkage === this.linkage ? [sizes] : []));
    keepSizes(this.linkage.model, past, link);
  }

  /** What could be undone before the page was loaded again. */
  recall(): void {
    const { dragging, linkage } = this;
    for (const sizes of keptSizes(linkage.model)) this.#history.add({ linkage, dragging, sizes });
  }

  #state(): State {
    const { linkage, dragging } = this;
    return { linkage, dragging, sizes: linkage.snapshot() };
  }

  #renewed(): void {
    whole(this.pieces());
  }

  /** Everything anew, in pieces: between them the browser may draw what is there. */
  *pieces(): Generator<void> {
    this.stage.cancelDrag();
    this.stage.setAdding(false);
    this.#arrangeStage();
    this.show();
    this.stage.fit();
    // until all panels are filled, those below one would jump
    this.side.element.style.visibility = "hidden";
    yield;
    this.side.arrange();
    yield;
    yield* this.side.measuring();
    this.side.element.style.visibility = "";
    this.page.changed();
  }

  show(): void {
    this.stage.show(this.linkage, this.dragging, this.shown);
  }

  redraw(): void {
    this.stage.sized();
  }

  /** Lay the view out anew, in the language of the page. */
  arrange(): void {
    this.transport.endFall();
    this.#arrangeStage();
    this.side.arrange();
  }

  #arrangeStage(): void {
    this.stage.arrange();
    this.transport.arrange();
  }

  // --- changes -------------------------------------------------------------------------------------------------------

  attempt(change: (part?: number) => void, told?: (part: number) => string): void {
    this.#begin();
    this.#tryTo(change, told);
    this.#end();
    if (told) this.stage.keepInside();
  }

  edit(change: () => void): void {
    this.#begin();
    change();
    this.arrange();
    this.show();
    this.#end();
  }

  keepLoads({ bars, loads }: Kept, typed: boolean): void {
    const { linkage } = this;
    if (typed) this.#history.add(this.#state());
    linkage.loads = loads;
    linkage.beside = { ...linkage.beside, bars: bars[0] && bars };
    this.page.changed();
  }

  #begin(): void {
    this.transport.endFall();
    this.#before = this.#state();
    this.linkage.drag(true);
  }

  /** Give up the change that is going on. */
  #cancel(): void {
    const before = this.#before;
    this.#before = null;
    this.linkage.drag(false);
    if (before) this.#goTo(before);
  }

  #end(): void {
    this.linkage.drag(false);
    this.stage.sized();
    if (this.#before && !sameSizes(this.#before.sizes, this.linkage.snapshot())) this.#history.add(this.#before);
    this.#before = null;
    this.measured();
    this.page.changed();
  }

  /** Change the sizes; what is refused at this drive value is offered where it fits, if it is to be looked for; else it
   * is told how much of it fits. */
  #tryTo(change: (part?: number) => void, told?: (part: number) => string): void {
    const start = performance.now();
    try {
      change();
      this.page.say("");
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      const { linkage } = this;
      const before = linkage.snapshot();
      const tried = (part: number) => {
        const fits = linkage.elsewhere(() => change(part));
        if (fits) linkage.restore(before);
        return fits;
      };
      const fits = error.stop && told && tried(1);
      let text = refusedText(linkage, error, this.transport.drive);
      if (error.stop && told && !fits) {
        let most = 0;
        for (let step = 0.5; step > 0.005; step /= 2) if (tried(most + step)) most += step;
        text = t("{all} fits at no position of the drive, but {some} does.", { all: told(1), some: told(0.99 * most) });
      }
      const onclick = () => this.attempt(() => linkage.elsewhere(change));
      this.page.say(text, "error", fits ? action("elsewhere", onclick, t("Move the drive there")) : undefined);
    }
    this.#followed();
    this.timed(start);
  }

  #followed(): void {
    this.stage.sized();
    this.side.follow();
  }

  timed(start: number): void {
    this.frames.push(performance.now() - start);
    if (this.frames.length > MOST_FRAMES) this.frames.shift();
  }

  undo(): void {
    const { linkage } = this;
    this.#goTo(this.#history.undo(this.#state()));
    const view = this.#drawnIn.get(linkage);
    if (view && linkage !== this.linkage) this.page.show(view);
  }

  redo(): void {
    this.#goTo(this.#history.redo(this.#state()));
  }

  #goTo(old: State | undefined): void {
    if (!old) return;
    this.transport.endFall();
    const other = old.linkage !== this.linkage;
    this.linkage = old.linkage;
    this.dragging = old.dragging;
    this.linkage.restore(old.sizes);
    this.page.say("");
    if (other) Object.assign(this.shown, { chosen: null, link: floatingLink(this.linkage.model) });
    this.arrange();
    this.show();
    this.measured();
    if (other) this.stage.fit();
    this.page.changed();
  }

  /** Whether its sizes, points or assembly mode are other than those with which it was opened. */
  get changed(): boolean {
    const { linkage } = this;
    return linkage.model.changed === true || !alike(linkage.opened, linkage.snapshot(), linkage.size);
  }

  get undoable(): [boolean, boolean] {
    return this.#history.possible;
  }

  addPoint(link: number, x: number, y: number): void {
    this.edit(() => this.linkage.addPoint(link, x, y));
    this.stage.setAdding(false);
    this.side.open("points");
  }

  /** Mark a link: its sizes, and new points and poles are its own. */
  #choose(link: number | null): void {
    Object.assign(this.shown, { chosen: link, ...(link !== null && { link }) });
    this.redraw();
    this.side.chosen();
  }

  press(event: KeyboardEvent, target: Element): boolean {
    return drivenBy(event, target, this.transport, this.stage);
  }

  /** The link that is to carry a coupler point; it stands still then. */
  #carry(link: number | null): void {
    this.transport.endFall();
    this.transport.pause();
    this.page.say(link === null ? t("Coupler point: choose its link.") : "");
    this.#choose(link);
  }

  /** Give up what is going on, what is chosen; whether there was anything. */
  escape(): boolean {
    if (this.stage.cancelDrag() || this.stage.setAdding(false)) return true;
    const { chosen } = this.shown;
    if (chosen !== null) this.#choose(null);
    return chosen !== null;
  }

  /** Where a joint or a point is meant that is dragged to a place. */
  #meant(joint: number | null, at: Pair, snap: boolean): Pair {
    return snap || this.shown.snap ? snappedOn(this.linkage, joint, at, this.stage.viewport) : at;
  }

  /** Take a point of a link to a place in the plane. */
  #putPoint(number: number, x: number, y: number): void {
    const point = this.linkage.sizes.points[number]!;
    point.at = this.linkage.toLocal(point.link, x, y);
    this.#followed();
  }

  #movePointBy(number: number, dx: number, dy: number): void {
    const { link, at } = this.linkage.sizes.points[number]!;
    const [x, y] = place(this.linkage.pose, 0, link, ...at);
    this.#begin();
    this.#putPoint(number, x + dx, y + dy);
    this.#end();
  }

  chosen(): void {
    this.measured();
    this.stage.sized();
  }

  paused(): void {
    this.stage.settled();
    this.page.changed();
  }

  picked(stop: Stop | null): void {
    this.page.say(stop ? stopText(this.linkage, stop) : "");
  }

  posed(): void {
    this.stage.draw();
    this.side.showPose();
  }

  // --- what is read off ----------------------------------------------------------------------------------------------

  get found(): Found {
    return this.side.found;
  }

  get plots(): Plots {
    return this.side.plots;
  }

  /** After a change: what takes longer than a frame, and what Python says. */
  measured(): void {
    whole(this.side.measuring());
  }

  // --- what is taken away --------------------------------------------------------------------------------------------

  document(): LinkageDocument {
    return savedDocument(this.linkage, this.transport.pose);
  }

  picture(): string {
    return this.stage.file();
  }

  pictures(): Generator<string> {
    return this.transport.film(() => this.stage.file());
  }

  table(): string {
    return tableOf(this.linkage, this.side.forces.columns);
  }
}
