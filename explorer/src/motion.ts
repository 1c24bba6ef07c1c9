/** The view of the motion: stage, slider, sizes, measures, plots, export. */

import { TURN, wrapped } from "./cycle";
import { applyDocument, documentOf } from "./document";
import { h, renew } from "./dom";
import { Dragging } from "./dragging";
import { exportPanel } from "./export";
import { driveValue, type Found, factsOf } from "./facts";
import { type Fall, Falling } from "./falling";
import { type Arrow, Forces } from "./forces";
import { History } from "./history";
import { type Icon, icon } from "./icons";
import { type Rows, Status } from "./kernel";
import { t } from "./language";
import { Linkage, Refused, type Snapshot } from "./linkage";
import { deadCentres, leastTransmission } from "./measures";
import type { LinkageDocument, Model } from "./model";
import { type Editor, modesPanel, optionsPanel, pointsPanel, SizeRows } from "./panels";
import { later, Player } from "./player";
import { Plots } from "./plots";
import { place } from "./rows";
import type { Shown } from "./shown";
import { Stage } from "./stage";
import { tableOf } from "./table";
import { Track } from "./track";
import { FRAMES } from "./video";
import type { Page, View } from "./view";
import { stopText } from "./wording";

const MOST_FRAMES = 2000;
const ASKED_AFTER = 350; // milliseconds

/** What is shown, to be shown again. */
interface State {
  linkage: Linkage;
  dragging: Dragging;
  sizes: Snapshot;
}

export class MotionView implements View, Editor {
  readonly element = h("div", { class: "view motion" });
  readonly shown: Shown = {
    curves: true,
    velocities: false,
    accelerations: false,
    hodographs: false,
    poles: false,
    inflection: false,
    labels: true,
    grid: true,
    link: 0,
    forces: () => this.arrows(),
  };
  linkage!: Linkage;
  dragging!: Dragging;
  readonly stage: Stage;
  readonly plots = new Plots((value) => this.pick(value));
  readonly player = new Player(
    (seconds) => this.advance(seconds),
    () => {
      this.land();
      this.page.changed();
    },
  );
  /** Milliseconds of the last frames in which something was drawn. */
  readonly frames: number[] = [];
  /** What was found over the cycle. */
  found: Found = { dead: [], least: null };
  private readonly history = new History<State>();
  /** What was before the change that is going on. */
  private before: State | null = null;
  private speed = 12; // turns a minute; of a slide, strokes
  private way = 1;
  private readonly track = new Track((value, beyond) => this.pick(value, beyond));
  private readonly value = h("span", { class: "value" });
  private readonly side = h("div", { class: "side" });
  private readonly bar = h("div", { class: "transport" });
  private readonly facts = h("dl", { class: "facts" });
  private readonly sizes = new SizeRows(this);
  private readonly checked = h("p", { class: "note" });
  private readonly words = h("details", { class: "words" });
  private readonly opened = new Set(["sizes", "measures", "plots"]);
  private readonly forces = new Forces(this, () => this.opened.has("forces"));
  private falling: Falling | null = null;
  private measuring = 0;

  constructor(readonly page: Page) {
    this.stage = new Stage(
      {
        dragStart: () => this.begin(),
        dragJoint: (joint, x, y) => this.tryTo(() => this.dragging.dragJoint(joint, x, y)),
        dragEnd: () => this.end(),
        dragCancel: () => this.cancel(),
        dragPoint: (point, x, y) => this.putPoint(point, x, y),
        movePointBy: (point, dx, dy) => this.movePointBy(point, dx, dy),
        pull: (link, u, v, x, y) => this.pull(link, u, v, x, y),
        addPoint: (link, x, y) => this.addPoint(link ?? this.shown.link, x, y),
        moveJointBy: (joint, dx, dy) => {
          const [x, y] = this.linkage.jointAt(joint);
          this.attempt(() => this.dragging.dragJoint(joint, x + dx, y + dy));
        },
      },
      this.shown,
    );
    this.element.append(this.stage.element, this.side, this.bar);
  }

  // --- what is shown -------------------------------------------------------------------------------------------------

  /** Show another linkage; the way back to the one before is undoing. */
  open(model: Model): void {
    this.pause();
    if (this.linkage) this.history.add(this.state());
    this.linkage = new Linkage(model);
    this.dragging = new Dragging(this.linkage);
    this.shown.link = floatingLink(model);
    this.renewed();
  }

  /** Other sizes of the same structure, as a link holds them. */
  openDocument(document: LinkageDocument, drive?: number): void {
    this.history.add(this.state());
    this.tryTo(() => applyDocument(this.linkage, document, drive));
    this.renewed();
  }

  /** Nothing can be undone from here on. */
  forget(): void {
    this.history.clear();
  }

  private state(): State {
    const { linkage, dragging } = this;
    return { linkage, dragging, sizes: linkage.snapshot() };
  }

  private renewed(): void {
    this.stage.cancelDrag();
    this.arrange();
    this.show();
    this.measured();
    this.stage.fit();
    this.page.changed();
  }

  show(): void {
    this.stage.show(this.linkage, this.dragging, this.shown);
  }

  redraw(): void {
    this.stage.draw();
  }

  /** Lay the view out anew, in the language of the page. */
  arrange(): void {
    this.arrangeTools();
    this.player.arrange();
    renew(this.words, h("summary", {}, t("In words")), this.checked);
    this.words.hidden = !this.page.served;
    const { scrollTop } = this.side; // before its parts leave it for new panels
    renew(
      this.side,
      this.panel("measures", t("Measures"), this.facts, this.words),
      this.panel("sizes", t("Sizes"), this.sizes.element),
      this.panel("plots", t("Plots"), this.plots.element),
      this.panel("forces", t("Forces"), this.forces.element),
      this.panel("points", t("Coupler points"), pointsPanel(this)),
      this.panel("modes", t("Assembly modes"), modesPanel(this)),
      this.panel("show", t("Show"), optionsPanel(this)),
      this.panel("export", t("Export"), exportPanel(this.page, this)),
    );
    this.side.scrollTop = scrollTop;
    renew(this.bar, ...this.transport());
    this.plots.arrange(this.linkage);
  }

  /** The buttons on the picture. */
  private arrangeTools(): void {
    const { stage } = this;
    const button = (sign: Icon, title: string, onclick: () => void) =>
      h("button", { title, "aria-label": title, onclick }, icon(sign));
    const adder = button("point", t("Add a coupler point: click on a link"), () => {
      stage.adding = !stage.adding;
      adder.setAttribute("aria-pressed", String(stage.adding));
      stage.element.classList.toggle("adding", stage.adding);
    });
    adder.setAttribute("aria-pressed", String(stage.adding));
    for (const old of stage.element.querySelectorAll(".tools, .hint")) old.remove();
    stage.element.append(
      h(
        "div",
        { class: "tools" },
        button("more", t("Zoom in"), () => stage.zoom(1.25)),
        button("less", t("Zoom out"), () => stage.zoom(0.8)),
        button("fit", t("Show everything"), () => stage.fit()),
        adder,
      ),
      h("div", { class: "hint" }, t("Drag a joint to change sizes, a link to move it.")),
    );
  }

  /** The row under the picture: play, the drive, its slider and value, the speed. */
  private transport(): HTMLElement[] {
    const { active, model } = this.linkage;
    const speed = h("input", {
      type: "range",
      min: 1,
      max: 60,
      value: this.speed,
      "aria-label": t("Speed"),
      oninput: () => {
        this.speed = Number(speed.value);
        rate.textContent = `${this.speed}/min`;
      },
    });
    const rate = h("span", {}, `${this.speed}/min`);
    const onchange = (event: Event) => this.choose(Number((event.target as HTMLSelectElement).value));
    const choices = model.drives.map((drive, k) => h("option", { value: k, selected: k === active }, drive.name));
    const drives = choices.length > 1 ? h("select", { "aria-label": t("Drive"), onchange }, ...choices) : null;
    const speedLabel = h("label", { class: "speed" }, t("Speed"), speed, rate);
    return [this.player.button, ...(drives ? [drives] : []), this.track.element, this.value, speedLabel];
  }

  private panel(key: string, title: string, ...content: Node[]): HTMLElement {
    const element = h(
      "details",
      { open: this.opened.has(key), "data-panel": key },
      h("summary", {}, title),
      h("div", {}, ...content),
    );
    element.addEventListener("toggle", () => {
      if (element.open) this.opened.add(key);
      else this.opened.delete(key);
      if (key === "plots" && element.open) this.plots.draw(this.linkage);
      if (key !== "forces") return;
      this.forces.changed();
      this.redraw();
    });
    return element;
  }

  private refresh(key: string, content: Node): void {
    const panel = this.side.querySelector(`[data-panel="${key}"] > div`);
    if (panel) renew(panel, content);
  }

  // --- changes -------------------------------------------------------------------------------------------------------

  attempt(change: () => void): void {
    this.begin();
    this.tryTo(change);
    this.end();
  }

  edit(change: () => void): void {
    this.begin();
    change();
    this.end();
    this.show();
    this.arrange();
  }

  private begin(): void {
    if (this.falling) this.pause();
    this.before = this.state();
  }

  /** Give up the change that is going on. */
  private cancel(): void {
    const { before } = this;
    this.before = null;
    if (before) this.goTo(before);
  }

  private end(): void {
    if (this.before && !sameSizes(this.before.sizes, this.linkage.snapshot())) this.history.add(this.before);
    this.before = null;
    this.measured();
    this.page.changed();
  }

  private tryTo(change: () => void): void {
    const start = performance.now();
    try {
      change();
      this.page.say("");
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      const stop = error.stop && { ...error.stop, status: Status.START };
      this.page.say(stop ? stopText(this.linkage, stop) : t("This size is not possible."));
    }
    this.followed();
    this.timed(start);
  }

  /** After each step of a drag: what follows at once. */
  private followed(): void {
    this.stage.sized();
    this.showTrack();
    this.showPose();
    if (this.opened.has("plots")) this.plots.draw(this.linkage);
  }

  private timed(start: number): void {
    this.frames.push(performance.now() - start);
    if (this.frames.length > MOST_FRAMES) this.frames.shift();
  }

  undo(): void {
    this.goTo(this.history.undo(this.state()));
  }

  redo(): void {
    this.goTo(this.history.redo(this.state()));
  }

  private goTo(old: State | undefined): void {
    if (!old) return;
    if (this.falling) this.pause();
    const other = old.linkage !== this.linkage;
    this.linkage = old.linkage;
    this.dragging = old.dragging;
    this.linkage.restore(old.sizes);
    this.page.say("");
    if (other) this.shown.link = floatingLink(this.linkage.model);
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
    return this.history.possible;
  }

  addPoint(link: number, x: number, y: number): void {
    this.edit(() => {
      const { model, sizes } = this.linkage;
      const taken = new Set([...sizes.points.map((p) => p.name), ...model.links]);
      let number = 1;
      while (taken.has(`K${number}`)) number++;
      this.linkage.addPoint(`K${number}`, link, x, y);
    });
  }

  /** Take a point of a link to a place in the plane. */
  private putPoint(number: number, x: number, y: number): void {
    const point = this.linkage.sizes.points[number]!;
    point.at = this.linkage.toLocal(point.link, x, y);
    this.followed();
  }

  private movePointBy(number: number, dx: number, dy: number): void {
    const { link, at } = this.linkage.sizes.points[number]!;
    const [x, y] = place(this.linkage.pose, 0, link, ...at);
    this.begin();
    this.putPoint(number, x + dx, y + dy);
    this.end();
  }

  private choose(active: number): void {
    this.linkage.choose(active);
    this.measured();
    this.stage.sized();
  }

  // --- the drive -----------------------------------------------------------------------------------------------------

  pick(value: number, beyond = false): void {
    this.pause();
    this.go(value);
    const { stops, low, high } = this.linkage.cycle;
    const stop = Math.abs(value - low) < Math.abs(value - high) ? stops[0] : stops[1];
    this.page.say(beyond && stop ? stopText(this.linkage, stop) : "");
  }

  /** Move the drive by so many degrees, or hundredths of the size. */
  nudge(steps: number): void {
    const { active, cycle, drive, drives, size } = this.linkage;
    if (!drive) return;
    const value = wrapped(cycle, drives[active]!) + steps * (drive.turning ? TURN / 360 : size / 200);
    const [low, high] = this.track.range;
    if (cycle.full) this.pick(value);
    else this.pick(Math.max(low, Math.min(high, value)), value < low || value > high);
  }

  private go(value: number): void {
    if (!this.linkage.moveTo(value)) return;
    this.stage.draw();
    this.showPose();
  }

  /** Let the drive follow a place of a link that is pulled, in a few steps along its velocity. */
  private pull(link: number, u: number, v: number, x: number, y: number): void {
    this.pause();
    const { linkage } = this;
    const [low, high] = this.track.range;
    const limit = linkage.drive?.turning ? 0.35 : 0.1 * linkage.size;
    for (let k = 0; k < 4; k++) {
      const [px, py] = place(linkage.pose, 0, link, u, v);
      const [vx, vy] = place(linkage.pose, 0, link, u, v, 1);
      const square = vx * vx + vy * vy;
      if (!(square > 1e-18) || !Number.isFinite(square)) break;
      const step = Math.max(-limit, Math.min(limit, ((x - px) * vx + (y - py) * vy) / square));
      let value = linkage.drives[linkage.active]! + step;
      if (!linkage.cycle.full) value = Math.max(low, Math.min(high, value));
      if (!linkage.moveTo(value) || Math.abs(step) < 1e-4 * limit) break;
    }
    this.stage.draw();
    this.showPose();
  }

  toggle(): void {
    this.player.toggle();
  }

  pause(): void {
    this.player.pause();
  }

  /** Play poses of a free motion once, in real time. */
  play(fall: Fall): void {
    this.pause();
    this.falling = new Falling(fall, this.linkage);
    this.toggle();
  }

  /** A free motion is over: the linkage is as it was. */
  private land(): void {
    if (!this.falling) return;
    this.linkage.pose = this.falling.start;
    this.falling = null;
    this.stage.draw();
    this.showPose();
  }

  private fall(falling: Falling, seconds: number): void {
    const pose = falling.later(seconds);
    if (!pose) return this.pause();
    this.linkage.pose = pose;
    this.value.textContent = falling.text;
    this.stage.draw();
  }

  private advance(seconds: number): void {
    if (this.falling) return this.fall(this.falling, seconds);
    const start = performance.now();
    const { active, cycle, drives } = this.linkage;
    const { range } = this.track;
    const next = later(wrapped(cycle, drives[active] ?? 0), this.way, seconds, this.speed, cycle, range);
    this.way = next.way;
    if (range[1] > range[0]) this.go(next.value);
    this.timed(start);
  }

  /** The value of the drive as it is plotted. */
  get drive(): number {
    const { active, cycle, drives } = this.linkage;
    return wrapped(cycle, drives[active] ?? 0);
  }

  get range(): [number, number] {
    return this.track.range;
  }

  private arrows(): Arrow[] {
    return this.falling ? [] : this.forces.arrows();
  }

  // --- what is read off ----------------------------------------------------------------------------------------------

  /** After a change: what takes longer than a frame, and what Python says. */
  measured(): void {
    this.found = { dead: deadCentres(this.linkage), least: leastTransmission(this.linkage) };
    this.showTrack();
    this.showPose();
    this.sizes.show();
    this.refresh("points", pointsPanel(this));
    this.refresh("modes", modesPanel(this));
    this.refresh("export", exportPanel(this.page, this));
    if (this.opened.has("plots")) this.plots.draw(this.linkage);
    this.forces.changed();
    this.ask();
  }

  private ask(): void {
    const { linkage } = this;
    if (!this.page.served || !linkage.drive || linkage.model.drives.length > 1) {
      this.checked.textContent = "";
      return;
    }
    this.checked.classList.add("waiting"); // it keeps its room until there is another one
    clearTimeout(this.measuring);
    const said = (text: string) => {
      if (linkage !== this.linkage) return;
      this.checked.classList.remove("waiting");
      this.checked.textContent = text;
    };
    this.measuring = window.setTimeout(() => {
      const document = this.document(linkage.cycle.rows, linkage.cycle.home);
      this.page.ask<{ lines: string[] }>("measures", { document, source: linkage.model.source }).then(
        ({ lines }) => said(lines.join(" ")),
        (error: Error) => said(error.message),
      );
    }, ASKED_AFTER);
  }

  private showTrack(): void {
    const { cycle, drive, model } = this.linkage;
    const { dead, least } = this.found;
    const places = dead.map(({ value }) => value);
    this.track.show(cycle, drive?.turning ?? true, model.span.between, places, least?.value ?? null, model.unit);
  }

  private showPose(): void {
    const { linkage } = this;
    this.value.textContent = driveValue(linkage);
    const drive = linkage.drives[linkage.active];
    if (drive !== undefined) {
      this.track.set(drive);
      this.plots.at(this.drive);
      this.forces.at(this.drive);
    }
    const facts = factsOf(linkage, this.found, (angle) => this.plots.plottedAngle(linkage, angle));
    this.facts.replaceChildren(
      ...facts.map(({ name, text, style, note }) =>
        h(
          "div",
          {},
          h("dt", {}, name),
          h("dd", { class: style ?? "" }, text, note ? h("small", {}, ` ${note}`) : null),
        ),
      ),
    );
  }

  // --- what is taken away --------------------------------------------------------------------------------------------

  document(rows?: Rows, row?: number): LinkageDocument {
    return documentOf(this.linkage, rows, row);
  }

  picture(): string {
    return this.stage.file();
  }

  *pictures(): Generator<string> {
    this.pause();
    const { active, cycle, drives } = this.linkage;
    const start = drives[active] ?? 0;
    const turns = cycle.full ? cycle.turns : 1;
    let [value, way] = [wrapped(cycle, start), 1];
    for (let left = Math.round((turns * 60 * FRAMES) / this.speed); left > 0; left--) {
      yield this.stage.file();
      ({ value, way } = later(value, way, 1 / FRAMES, this.speed, cycle, this.track.range));
      this.go(value);
    }
    this.go(start);
  }

  table(): string {
    return tableOf(this.linkage);
  }
}

/** The link whose poles are shown first: no neighbour of the frame, if there is one. */
function floatingLink({ frame, joints, own }: Model): number {
  const near = new Set(joints.filter((j) => j.links.includes(frame)).flatMap((j) => j.links));
  for (let link = 0; link < own; link++) if (!near.has(link)) return link;
  return own - 1;
}

/** Whether sizes, points and assembly mode are the same but for rounding. */
function alike(one: Snapshot, two: Snapshot, size: number): boolean {
  const values = ({ at, angles, points, signs }: Snapshot) => [
    ...[...at, ...points.flatMap((point) => point.at)].map((value) => value / size),
    ...angles,
    ...signs,
  ];
  const [first, second] = [values(one), values(two)];
  const names = ({ points }: Snapshot) => points.map(({ name, link }) => `${name} ${link}`).join();
  return (
    first.length === second.length &&
    names(one) === names(two) &&
    first.every((value, k) => Math.abs(value - second[k]!) < 1e-9)
  );
}

/** Whether a change of the sizes, the points or the assembly mode left everything as it was. */
function sameSizes(one: Snapshot, two: Snapshot): boolean {
  const key = ({ at, points, signs }: Snapshot) => JSON.stringify([at, points, signs]);
  return key(one) === key(two);
}
