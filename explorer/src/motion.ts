/** The view of the motion: stage, slider, sizes, measures, plots, export. */

import { h, svg } from "./dom";
import { exportPanel } from "./export";
import { Cancelled } from "./host";
import { Status } from "./kernel";
import { angle, currentLanguage, number, parsed, t } from "./language";
import { type Cycle, Machine, Refused, type Snapshot, type Stop } from "./machine";
import type { LinkageDocument, Model } from "./model";
import { Plot, type Series } from "./plots";
import { type Shown, Stage } from "./stage";
import { Track } from "./track";
import type { Page, View } from "./view";

const TURN = 2 * Math.PI;
const GOOD = (40 / 180) * Math.PI;
const OLDEST = 200;

export class MotionView implements View {
  readonly element = h("div", { class: "view motion" });
  machine!: Machine;
  playing = false;
  speed = 12; // turns a minute; of a slide, strokes
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
  };
  private way = 1;
  private last = 0;
  private frame = 0;
  private past: Snapshot[] = [];
  private future: Snapshot[] = [];
  private before: Snapshot | null = null;
  private dead: number[] = [];
  private least: { value: number; mu: number } | null = null;
  private pointNumber = 0;
  readonly stage: Stage;
  private readonly track = new Track((value, beyond) => this.pick(value, beyond));
  private readonly value = h("span", { class: "value" });
  private readonly play = h("button", { class: "play", onclick: () => this.toggle() });
  private readonly side = h("div", { class: "side" });
  private readonly facts = h("dl", { class: "facts" });
  private readonly sizes = h("div", { class: "rows" });
  private readonly plots = h("div", {});
  private readonly checked = h("p", { class: "note" });
  private plotParts: { plot: Plot; make: (rows: number[]) => Series }[] = [];
  private opened = new Set(["sizes", "measures", "plots"]);
  /** Milliseconds of the last frames in which something was drawn. */
  readonly frames: number[] = [];
  private measuring = 0;

  constructor(private readonly page: Page) {
    this.stage = new Stage(
      {
        dragStart: () => this.begin(),
        dragJoint: (joint, x, y) => this.tryTo(() => this.machine.dragJoint(joint, x, y)),
        dragEnd: () => this.end(),
        pull: (link, u, v, x, y) => this.pull(link, u, v, x, y),
        addPoint: (link, x, y) => this.addPoint(link, x, y),
        moveJointBy: (joint, dx, dy) => {
          this.begin();
          const [x, y] = this.machine.jointAt(joint);
          this.tryTo(() => this.machine.dragJoint(joint, x + dx, y + dy));
          this.end();
        },
      },
      this.shown,
    );
  }

  // --- what is shown -------------------------------------------------------------------------------------------------

  open(model: Model, state?: Snapshot): void {
    this.machine = new Machine(model);
    this.past = [];
    this.future = [];
    this.shown.link = this.floatingLink();
    if (state) this.machine.restore(state);
    this.pointNumber = this.machine.points.length;
    this.arrange();
    this.stage.show(this.machine, this.shown);
    this.measured();
    this.stage.fit();
    this.page.changed();
  }

  /** Other sizes of the same structure, as a link holds them. */
  openDocument(document: LinkageDocument, drive: number): void {
    this.tryTo(() => this.machine.apply(document, drive));
    this.past = [];
    this.future = [];
    this.pointNumber = this.machine.points.length;
    this.arrange();
    this.stage.show(this.machine, this.shown);
    this.measured();
    this.stage.fit();
    this.page.changed();
  }

  /** The link whose poles are shown first: no neighbour of the frame, if there is one. */
  private floatingLink(): number {
    const { model } = this.machine;
    const near = new Set(model.joints.filter((j) => j.links.includes(model.frame)).flatMap((j) => j.links));
    for (let link = 0; link < model.own; link++) if (!near.has(link)) return link;
    return model.own - 1;
  }

  /** Lay the view out anew, in the language of the page. */
  arrange(): void {
    const { machine } = this;
    const button = (sign: string, title: string, act: () => void, pressed?: boolean) =>
      h(
        "button",
        {
          title,
          "aria-label": title,
          onclick: act,
          ...(pressed === undefined ? {} : { "aria-pressed": String(pressed) }),
        },
        sign,
      );
    const adder = button(
      "✛",
      t("Add a coupler point: click on a link"),
      () => {
        this.stage.adding = !this.stage.adding;
        adder.setAttribute("aria-pressed", String(this.stage.adding));
        this.stage.element.classList.toggle("adding", this.stage.adding);
      },
      this.stage.adding,
    );
    this.stage.element.querySelector(".tools")?.remove();
    this.stage.element.querySelector(".hint")?.remove();
    this.stage.element.append(
      h(
        "div",
        { class: "tools" },
        button("+", t("Zoom in"), () => this.stage.zoom(1.25)),
        button("−", t("Zoom out"), () => this.stage.zoom(0.8)),
        button("⤢", t("Show everything"), () => this.stage.fit()),
        adder,
      ),
      h("div", { class: "hint" }, t("Drag a joint to change sizes, a link to move it.")),
    );
    const speed = h("input", {
      type: "range",
      min: 1,
      max: 60,
      value: this.speed,
      "aria-label": t("Speed"),
      oninput: () => (this.speed = Number(speed.value)),
    });
    const drives =
      machine.model.drives.length > 1
        ? h(
            "select",
            {
              "aria-label": t("Drive"),
              onchange: (event: Event) => this.choose(Number((event.target as HTMLSelectElement).value)),
            },
            ...machine.model.drives.map((drive, k) =>
              h("option", { value: k, selected: k === machine.active }, drive.name),
            ),
          )
        : null;
    const bar = h(
      "div",
      { class: "transport" },
      this.play,
      drives,
      this.track.element,
      this.value,
      h("label", { class: "speed" }, t("Speed"), speed),
    );
    this.setPlay();
    this.side.replaceChildren(
      this.panel("measures", t("Measures"), this.facts, this.checked),
      this.panel("sizes", t("Sizes"), this.sizes),
      this.panel("plots", t("Plots"), this.plots),
      this.panel("points", t("Coupler points"), this.pointsPanel()),
      this.panel("modes", t("Assembly modes"), this.modesPanel()),
      this.panel("show", t("Show"), this.optionsPanel()),
      this.panel("export", t("Export"), exportPanel(this.page, this)),
    );
    this.element.replaceChildren(this.stage.element, this.side, bar);
    this.makePlots();
  }

  private panel(key: string, title: string, ...content: (Node | null)[]): HTMLElement {
    const element = h(
      "details",
      { open: this.opened.has(key), "data-panel": key },
      h("summary", {}, title),
      h("div", {}, ...content),
    );
    element.addEventListener("toggle", () => {
      if (element.open) this.opened.add(key);
      else this.opened.delete(key);
      if (key === "plots" && element.open) this.drawPlots();
    });
    return element;
  }

  private refresh(key: string, content: Node): void {
    this.side.querySelector(`[data-panel="${key}"] > div`)?.replaceChildren(content);
  }

  private pointsPanel(): HTMLElement {
    const { machine } = this;
    const colours = ["--motion", "--accent", "--green", "--purple"];
    const chips = machine.points.map((point, k) => {
      const chip = h(
        "span",
        { class: "chip" },
        h("i", {}),
        `${point.name} · ${machine.linkName(point.link)}`,
        h(
          "button",
          {
            "aria-label": t("Remove {name}", { name: point.name }),
            onclick: () => this.edit(() => machine.points.splice(k, 1)),
          },
          "×",
        ),
      );
      chip.style.setProperty("--own", `var(${colours[k % colours.length]!})`);
      return chip;
    });
    return h(
      "div",
      {},
      h("div", { class: "chips" }, ...chips),
      h("p", { class: "note" }, t("Double-click on a link to add a point that traces its curve.")),
    );
  }

  private modesPanel(): HTMLElement {
    const { machine } = this;
    const rows = machine.model.groups
      .filter((group) => group.modes)
      .map((group) => {
        const text = `${group.form} {${machine.linkList(group.links)}}`;
        if (!group.dyad) return h("div", { class: "chip" }, text);
        return h(
          "button",
          {
            class: "plain",
            "data-mode": group.number,
            onclick: () => {
              this.begin();
              this.tryTo(() => machine.switchMode(group.number));
              this.end();
            },
          },
          `${text}  ${machine.state.signs[group.number]! < 0 ? "−" : "+"}`,
        );
      });
    if (!rows.length) return h("p", { class: "note" }, t("There is one assembly mode only."));
    const larger = machine.model.groups.some((group) => group.modes && !group.dyad);
    if (!larger || !this.page.served) return h("div", { class: "chips" }, ...rows);
    const all = h(
      "div",
      { class: "chips" },
      h(
        "button",
        { class: "plain", "data-act": "modes", onclick: () => void this.listModes(all) },
        t("All assembly modes at this position"),
      ),
    );
    return h("div", {}, h("div", { class: "chips" }, ...rows), all);
  }

  /** The assembly modes of larger groups, which the library finds; a click takes one. */
  private async listModes(place: HTMLElement): Promise<void> {
    const { machine } = this;
    const drives = [...machine.drives].slice(0, machine.model.drives.length);
    const request = this.page.ask<{ label: string; document: LinkageDocument }[]>("modes", {
      document: machine.document(),
      drives,
    });
    place.replaceChildren(
      h("progress", {}),
      h("button", { class: "plain", onclick: () => request.cancel() }, t("Cancel")),
    );
    try {
      const found = await request;
      if (machine !== this.machine) return;
      place.replaceChildren(
        ...found.map(({ label, document }) =>
          h(
            "button",
            {
              class: "plain",
              "data-mode": label,
              onclick: () => {
                const here = machine.drives[machine.active]!;
                this.begin();
                this.tryTo(() =>
                  machine.apply(
                    { ...document, elements: machine.document().elements! },
                    drives[machine.active] ?? here,
                  ),
                );
                this.end();
                this.stage.show(machine, this.shown);
              },
            },
            label,
          ),
        ),
      );
    } catch (error) {
      place.replaceChildren(
        h("span", { class: "error" }, error instanceof Cancelled ? t("Cancelled.") : (error as Error).message),
      );
    }
  }

  private optionsPanel(): HTMLElement {
    const { machine, shown } = this;
    const option = (
      key: "curves" | "velocities" | "accelerations" | "hodographs" | "poles" | "inflection" | "labels" | "grid",
      text: string,
    ) => {
      const box = h("input", {
        type: "checkbox",
        checked: shown[key],
        onchange: () => {
          shown[key] = box.checked;
          this.stage.show(machine, shown);
        },
      });
      return h("label", {}, box, text);
    };
    const link = h(
      "select",
      {
        "aria-label": t("Link"),
        onchange: () => {
          shown.link = Number(link.value);
          this.stage.draw();
        },
      },
      ...machine.model.links
        .slice(0, machine.model.own)
        .flatMap((_, k) =>
          k === machine.model.frame ? [] : [h("option", { value: k, selected: k === shown.link }, machine.linkName(k))],
        ),
    );
    return h(
      "div",
      { class: "options" },
      option("curves", t("Coupler curves")),
      option("velocities", t("Velocities")),
      option("accelerations", t("Accelerations")),
      option("hodographs", t("Hodographs of the points")),
      option("poles", t("Pole and centrodes")),
      option("inflection", t("Inflection circle")),
      h("label", {}, t("of the link"), link),
      option("labels", t("Names")),
      option("grid", t("Grid")),
    );
  }

  // --- changes -------------------------------------------------------------------------------------------------------

  begin(): void {
    this.before = this.machine.snapshot();
  }

  end(): void {
    if (
      this.before &&
      JSON.stringify(this.before.at) + JSON.stringify(this.before.points) + String(this.before.signs) !==
        JSON.stringify([...this.machine.at]) +
          JSON.stringify(this.machine.points) +
          String([...this.machine.state.signs])
    ) {
      this.past.push(this.before);
      if (this.past.length > OLDEST) this.past.shift();
      this.future = [];
    }
    this.before = null;
    this.measured();
    this.page.changed();
  }

  private edit(act: () => void): void {
    this.begin();
    act();
    this.end();
    this.stage.show(this.machine, this.shown);
    this.arrange();
  }

  private tryTo(act: () => void): void {
    const start = performance.now();
    try {
      act();
      this.page.say("");
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      this.page.say(
        error.stop ? this.stopText({ ...error.stop, status: Status.START }) : t("This size is not possible."),
      );
    }
    this.followed();
    this.timed(start);
  }

  /** After each step of a drag: what follows at once. */
  private followed(): void {
    this.stage.sized();
    this.showTrack();
    this.showPose();
    if (this.opened.has("plots")) this.drawPlots();
  }

  private timed(start: number): void {
    this.frames.push(performance.now() - start);
    if (this.frames.length > 2000) this.frames.shift();
  }

  undo(): void {
    this.step(this.past, this.future);
  }

  redo(): void {
    this.step(this.future, this.past);
  }

  private step(from: Snapshot[], to: Snapshot[]): void {
    const old = from.pop();
    if (!old) return;
    to.push(this.machine.snapshot());
    this.machine.restore(old);
    this.page.say("");
    this.arrange();
    this.stage.show(this.machine, this.shown);
    this.measured();
    this.page.changed();
  }

  get undoable(): [boolean, boolean] {
    return [this.past.length > 0, this.future.length > 0];
  }

  addPoint(link: number, x: number, y: number): void {
    this.edit(() => {
      const taken = new Set([...this.machine.points.map((p) => p.name), ...this.machine.model.links]);
      let name = "";
      do name = `K${++this.pointNumber}`;
      while (taken.has(name));
      this.machine.addPoint(name, link, x, y);
    });
  }

  private choose(active: number): void {
    this.machine.active = active;
    this.machine.pose = this.machine.pose;
    this.machine.restore(this.machine.snapshot());
    this.measured();
    this.stage.sized();
  }

  // --- the drive -----------------------------------------------------------------------------------------------------

  pick(value: number, beyond = false): void {
    this.pause();
    this.go(value);
    const { stops, low, high } = this.machine.cycle;
    const stop = Math.abs(value - low) < Math.abs(value - high) ? stops[0] : stops[1];
    this.page.say(beyond && stop ? this.stopText(stop) : "");
  }

  /** Move the drive by so many degrees, or hundredths of the size. */
  nudge(steps: number): void {
    const { drive, drives, active, size } = this.machine;
    if (!drive) return;
    const value = this.track.wrapped(drives[active]!) + steps * (drive.turning ? TURN / 360 : size / 200);
    const [low, high] = this.track.range;
    const full = this.machine.cycle.full;
    this.pick(full ? value : Math.max(low, Math.min(high, value)), !full && (value < low || value > high));
  }

  private go(value: number): void {
    if (!this.machine.moveTo(value)) return;
    this.stage.draw();
    this.showPose();
  }

  private pull(link: number, u: number, v: number, x: number, y: number): void {
    this.pause();
    const { machine } = this;
    const limit = machine.drive?.turning ? 0.35 : 0.1 * machine.size;
    for (let k = 0; k < 4; k++) {
      const [px, py] = machine.place(machine.pose, 0, link, u, v),
        [vx, vy] = machine.place(machine.pose, 0, link, u, v, 1);
      const square = vx * vx + vy * vy;
      if (!(square > 1e-18) || !Number.isFinite(square)) break;
      const step = Math.max(-limit, Math.min(limit, ((x - px) * vx + (y - py) * vy) / square));
      let value = machine.drives[machine.active]! + step;
      if (!machine.cycle.full) value = Math.max(this.track.range[0], Math.min(this.track.range[1], value));
      if (!machine.moveTo(value) || Math.abs(step) < 1e-4 * limit) break;
    }
    this.stage.draw();
    this.showPose();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else {
      this.playing = true;
      this.last = performance.now();
      this.setPlay();
      this.frame = requestAnimationFrame((now) => this.tick(now));
    }
  }

  pause(): void {
    if (!this.playing) return;
    this.playing = false;
    cancelAnimationFrame(this.frame);
    this.setPlay();
    this.page.changed();
  }

  private setPlay(): void {
    const text = this.playing ? t("Pause") : t("Play");
    this.play.setAttribute("aria-label", text);
    this.play.title = text;
    this.play.replaceChildren(
      svg(
        "svg",
        { viewBox: "0 0 18 18", "aria-hidden": "true" },
        svg("path", { d: this.playing ? "M3 2h4v14H3zM11 2h4v14h-4z" : "M4 1.5v15l12.5-7.5z" }),
      ),
    );
  }

  private tick(now: number): void {
    if (!this.playing) return;
    const start = performance.now();
    const { machine } = this;
    const seconds = Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    const [low, high] = this.track.range;
    let value = this.track.wrapped(machine.drives[machine.active] ?? 0);
    if (machine.cycle.full) value += (seconds * this.speed * TURN) / 60;
    else {
      value += (this.way * seconds * this.speed * (high - low) * 2) / 60;
      if (value >= high || value <= low) {
        this.way = value >= high ? -1 : 1;
        value = Math.max(low, Math.min(high, value));
      }
    }
    if (high > low && machine.moveTo(value)) {
      this.stage.draw();
      this.showPose();
    }
    this.timed(start);
    this.frame = requestAnimationFrame((next) => this.tick(next));
  }

  // --- what is read off ----------------------------------------------------------------------------------------------

  /** After a change: what takes longer than a frame, and what Python says. */
  measured(): void {
    this.dead = this.machine.deadCentres().map((one) => one.value);
    this.least = this.machine.leastTransmission();
    this.showTrack();
    this.showPose();
    this.showSizes();
    this.refresh("modes", this.modesPanel());
    if (this.opened.has("plots")) this.drawPlots();
    this.ask();
  }

  private ask(): void {
    this.checked.textContent = "";
    if (!this.page.served || !this.machine.drive || this.machine.model.drives.length > 1) return;
    clearTimeout(this.measuring);
    const { machine } = this;
    const said = (text: string) => {
      if (machine === this.machine) this.checked.textContent = text;
    };
    this.measuring = window.setTimeout(() => {
      const document = machine.document(machine.cycle.rows, machine.cycle.home);
      this.page.ask<{ lines: string[] }>("measures", { document, source: machine.model.source }).then(
        ({ lines }) => said(lines.join(" ")),
        (error: Error) => said(error.message),
      );
    }, 350);
  }

  private showTrack(): void {
    const { machine } = this;
    this.track.show(
      machine.cycle,
      machine.drive?.turning ?? true,
      machine.model.span.between,
      this.dead,
      this.least?.value ?? null,
      machine.model.unit,
    );
  }

  /** Where in the period an extreme lies; it is known to about a millionth of a radian. */
  private placeOf(value: number): number {
    const place = this.track.wrapped(value);
    return this.machine.drive?.turning ? Math.round(place * 1e6) / 1e6 : place;
  }

  shownDrive(value: number, digits = 5): string {
    const { drive, model } = this.machine;
    return drive?.turning ? angle(value, digits) : `${number(value, digits)} ${model.unit}`;
  }

  stopText(stop: Stop): string {
    const { model, active } = this.machine;
    const drives = `${model.drives[active]?.name ?? ""} = ${this.shownDrive(stop.value, 9)}`;
    const links = this.machine.linkList(stop.links);
    if (stop.status === "open")
      return t("The motion ends at {drives}: there {form} is open.", { drives, form: stop.form });
    if (stop.status === Status.START)
      return t("With these sizes {form} {{links}} cannot be assembled at {drives}; nothing was changed.", {
        drives,
        form: stop.form,
        links,
      });
    if (stop.status === Status.SINGULAR)
      return t("The motion ends at {drives}: there two assembly modes of {form} {{links}} meet.", {
        drives,
        form: stop.form,
        links,
      });
    return t("The motion ends at {drives}: there {form} {{links}} can no longer be assembled.", {
      drives,
      form: stop.form,
      links,
    });
  }

  private showPose(): void {
    const { machine } = this;
    const drive = machine.drives[machine.active];
    this.value.textContent = drive === undefined ? "" : this.shownDrive(this.track.wrapped(drive), 4);
    if (drive !== undefined) this.track.set(drive);
    const output = machine.model.outputs[0];
    const mu = machine.transmission(machine.pose, 0);
    const facts: [string, string, string?][] = [];
    if (output) {
      const [value, rate] = machine.output(machine.pose, 0);
      const turning = output.joint === null;
      facts.push([
        t("Output {name}", { name: machine.linkName(output.link) }),
        turning ? angle(this.onPlot(value), 5) : `${number(value, 5)} ${machine.model.unit}`,
      ]);
      facts.push([t("Velocity by the drive"), number(rate, 4)]);
    }
    if (Number.isFinite(mu)) {
      facts.push([t("Transmission angle"), angle(mu), mu < GOOD ? "bad" : "good"]);
      if (this.least)
        facts.push([
          t("smallest"),
          `${angle(this.least.mu)} · ${this.shownDrive(this.placeOf(this.least.value), 4)}`,
          this.least.mu < GOOD ? "bad" : "good",
        ]);
    }
    const { cycle } = machine;
    if (machine.drive) {
      const full = cycle.turns === 1 ? t("full turns") : t("full turns, repeats after {turns}", { turns: cycle.turns });
      const part = `${this.shownDrive(cycle.low, 5)} … ${this.shownDrive(cycle.high, 5)}`;
      facts.push([t("Range of the drive"), cycle.full ? full : part]);
    }
    if (this.dead.length)
      facts.push([
        t("Dead centres"),
        this.dead
          .map((value) => this.placeOf(value))
          .sort((a, b) => a - b)
          .map((value) => this.shownDrive(value, 5))
          .join(", "),
      ]);
    this.facts.replaceChildren(
      ...facts.flatMap(([name, text, style]) => [h("dt", {}, name), h("dd", { class: style ?? "" }, text)]),
    );
    for (const { plot } of this.plotParts) if (drive !== undefined) plot.at(this.plotted(drive));
  }

  private showSizes(): void {
    const { machine } = this;
    const { model } = machine;
    const letters = (k: number) => {
      const joint = model.joints[model.elements[k]!.joint]!;
      return joint.links
        .filter((link) => link !== model.elements[k]!.link)
        .map((link) => machine.linkName(link))
        .join(", ");
    };
    const rows = machine
      .lengths()
      .slice(0, 60)
      .flatMap(({ link, first, second, value }) => {
        const id = `size-${first}-${second}`;
        const input = h("input", {
          id,
          value: number(value, 7),
          inputmode: "decimal",
          onchange: () => {
            const wanted = parsed(input.value);
            input.setAttribute("aria-invalid", String(!(wanted >= 0)));
            if (!(wanted >= 0))
              return this.page.say(t("Expected a length, such as {value}.", { value: number(value, 4) }));
            this.begin();
            this.tryTo(() => machine.setLength(first, second, wanted));
            this.end();
          },
          onkeydown: (event: KeyboardEvent) => event.stopPropagation(),
        });
        return [
          h(
            "label",
            { for: id, title: `${machine.linkName(link)}: ${letters(first)} – ${letters(second)}` },
            h("b", {}, machine.linkName(link)),
            ` ${letters(first)} – ${letters(second)}`,
          ),
          input,
          h("span", { class: "unit" }, model.unit),
        ];
      });
    this.sizes.replaceChildren(...rows);
  }

  // --- plots ---------------------------------------------------------------------------------------------------------

  private lap: { cycle: Cycle; drives: Float64Array; values: Float64Array } | null = null;

  /** The rows of the cycle in the order in which they are plotted: of full turns from 0 on. */
  private plottedRows(): { drives: Float64Array; rows: number[] } {
    const { cycle } = this.machine;
    const count = cycle.values.length;
    if (!cycle.full) return { drives: cycle.values, rows: Array.from({ length: count }, (_, row) => row) };
    const rows = Array.from({ length: count - 1 }, (_, row) => row).sort(
      (a, b) => this.plotted(cycle.values[a]!) - this.plotted(cycle.values[b]!),
    );
    const drives = Float64Array.from([
      ...rows.map((row) => this.plotted(cycle.values[row]!)),
      TURN * cycle.turns + this.plotted(cycle.values[rows[0]!]!),
    ]);
    return { drives, rows: [...rows, rows[0]!] };
  }

  private plotted(drive: number): number {
    return this.track.wrapped(drive);
  }

  /** The angle of the output in the pose that is shown, in the lap in which it is plotted. */
  private onPlot(value: number): number {
    const { machine } = this;
    if (this.lap?.cycle !== machine.cycle) {
      const { drives, rows } = this.plottedRows();
      this.lap = { cycle: machine.cycle, drives, values: machine.outputAlong(rows) };
    }
    const { drives, values } = this.lap;
    const drive = this.plotted(machine.drives[machine.active] ?? 0);
    let low = 0,
      high = drives.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (drives[middle]! <= drive) low = middle;
      else high = middle;
    }
    return value + TURN * Math.round((values[low]! - value) / TURN);
  }

  private makePlots(): void {
    const { machine } = this;
    const output = machine.model.outputs[0];
    this.plotParts = [];
    const add = (make: (rows: number[]) => Series) =>
      this.plotParts.push({
        plot: new Plot(machine.drive?.turning ? TURN / 360 : 1, (value) => this.pick(value)),
        make,
      });
    const along = (rows: number[], f: (row: number) => number) => Float64Array.from(rows, f);
    if (output) {
      const turning = output.joint === null;
      const name = machine.linkName(output.link);
      add((rows) => ({
        title: t("Output {name}", { name }) + (turning ? " [°]" : ` [${machine.model.unit}]`),
        colour: "--motion",
        values: machine.outputAlong(rows).map((value) => (turning ? (value * 360) / TURN : value)),
      }));
      add((rows) => ({
        title: t("Its velocity by the drive"),
        colour: "--green",
        values: along(rows, (row) => machine.output(machine.cycle.rows, row)[1]),
      }));
      add((rows) => ({
        title: t("Its acceleration by the drive"),
        colour: "--purple",
        values: along(rows, (row) => machine.output(machine.cycle.rows, row)[2]),
      }));
      if (output.legs.length)
        add((rows) => ({
          title: `${t("Transmission angle")} [°]`,
          colour: "--accent",
          floor: 40,
          values: along(rows, (row) => (machine.transmission(machine.cycle.rows, row) * 360) / TURN),
        }));
    }
    for (const point of machine.points)
      add((rows) => ({
        title: t("Speed of {name} by the drive", { name: point.name }),
        colour: "--ink",
        values: along(rows, (row) =>
          Math.hypot(...machine.place(machine.cycle.rows, row, point.link, point.at[0], point.at[1], 1)),
        ),
      }));
    const note = output?.note[currentLanguage()];
    this.plots.replaceChildren(
      ...this.plotParts.map(({ plot }) => plot.element),
      ...(note ? [h("p", { class: "note" }, note)] : []),
    );
    this.drawPlots();
  }

  private drawPlots(): void {
    const { cycle, drives, active } = this.machine;
    if (cycle.values.length < 2) return;
    const shown = this.plottedRows();
    for (const { plot, make } of this.plotParts) {
      plot.show(shown.drives, make(shown.rows), cycle.full ? [0, TURN * cycle.turns] : [cycle.low, cycle.high]);
      plot.at(this.plotted(drives[active]!));
    }
  }

  picture(): string {
    return this.stage.file();
  }

  /** The curves as a table: the drive, the output and the points, with their derivatives. */
  table(): string {
    const { machine } = this;
    const { cycle, model } = machine;
    const turning = machine.drive?.turning ?? true;
    const head = [turning ? "drive_deg" : `drive_${model.unit}`];
    const output = model.outputs[0];
    if (output) head.push("output", "output_velocity", "output_acceleration", "transmission_angle_deg");
    for (const point of machine.points)
      head.push(`${point.name}_x`, `${point.name}_y`, `${point.name}_vx`, `${point.name}_vy`);
    const outputs = machine.outputAlong(Array.from(cycle.values.keys()));
    const rows = Array.from(cycle.values, (value, row) => {
      const line = [turning ? (value * 360) / TURN : value];
      if (output) {
        const [, first, second] = machine.output(cycle.rows, row),
          psi = outputs[row]!;
        line.push(
          output.joint === null ? (psi * 360) / TURN : psi,
          first,
          second,
          (machine.transmission(cycle.rows, row) * 360) / TURN,
        );
      }
      for (const point of machine.points)
        line.push(
          ...machine.place(cycle.rows, row, point.link, ...point.at),
          ...machine.place(cycle.rows, row, point.link, ...point.at, 1),
        );
      return line.map((x) => (Number.isFinite(x) ? String(x) : "")).join(",");
    });
    return (
      [head.map((name) => (/[",]/.test(name) ? `"${name.replace(/"/g, '""')}"` : name)).join(","), ...rows].join("\n") +
      "\n"
    );
  }
}
