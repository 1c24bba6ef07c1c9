/** The page of a machine in space: header, picture, drive, and beside them measures, drives, links, options. */

import { TURN, wrapped } from "../cycle";
import { choice, h, renew, wantsStill } from "../dom";
import { download, group } from "../export";
import { FactList } from "../factlist";
import type { Fact } from "../facts";
import { centred, languageMenu, saving, sayIn, softened, viewNames } from "../header";
import { drivenBy, showOver, showRows } from "../help";
import { angle, currentLanguage, type Language, number, t } from "../language";
import { fromBase64 } from "../packed";
import { firstTheme, panelOf, setTheme, shell, themeTool, tool } from "../shell";
import { IN_SPACE, type InSpace, store } from "../storing";
import { driveText } from "../track";
import { type Driven, Transport } from "../transport";
import { FLAT, moved } from "./algebra";
import { asked } from "./asking";
import { endsOf, Machine } from "./machine";
import type { Model } from "./model";
import { OutputPlots } from "./outputs";
import { Resizing } from "./resizing";
import { Scene } from "./scene";
import { stlOf } from "./solids";

/** Angles of the views along axes, in radians: from where, from how high. */
const VIEWS: Record<string, [number, number]> = {
  front: [-Math.PI / 2, 0],
  side: [0, 0],
  top: [-Math.PI / 2, Math.PI / 2],
};
const DIGITS = 4;

/** The name of a machine without what explains it. */
function shortOf(name: string): string {
  return name.split(/,| \(| (?:with|between|mit|zwischen|on|auf) /, 1)[0]!;
}

export class SpaceView implements Driven {
  linkage: Machine;
  readonly scene: Scene;
  readonly transport = new Transport(this);
  readonly #host: HTMLElement;
  readonly #root: HTMLElement;
  readonly #header = h("header", {});
  readonly #message = h("div.message", { role: "status", hidden: true });
  readonly #side = h("div.side", {});
  readonly #facts = new FactList();
  readonly #sizes = new FactList();
  #plots: OutputPlots | null = null;
  #sliders: { input: HTMLInputElement; output: HTMLElement }[] = [];
  /** Of the links. */
  #chips: HTMLElement[] = [];
  /** The view that is shown, if it is one with a name. */
  #view = "oblique";
  #views: HTMLElement | null = null;
  readonly #options = h("div.options", {});
  /** Whether what is said is done, and stays while it plays. */
  #told = false;
  readonly #resizing = new Resizing({
    shown: () => this.data,
    take: (data) => this.#take(data),
  });

  constructor(
    parent: HTMLElement,
    private data: Model,
    /** Whether it comes back with the sizes that it had. */
    again: boolean,
  ) {
    if (again) this.data = this.#resizing.recalled(data);
    const { host, shadow } = shell(parent, "100%");
    this.#host = host;
    this.linkage = new Machine(this.data);
    this.scene = new Scene(this.linkage, {
      taken: () => {
        this.transport.pause();
        this.#arrangeOptions();
        this.#pointed(null);
        this.posed();
      },
      pulled: () => this.posed(),
      turned: () => {
        this.#view = "";
        for (const button of this.#views?.children ?? []) button.setAttribute("aria-pressed", "false");
      },
      pointed: (link) => this.#pointed(link),
    });
    const view = h("div.view.motion.shown", {}, this.scene.element, this.transport.element, this.#side);
    this.#root = h("div.app", {}, this.#header, this.#message, h("main.views", {}, view));
    shadow.append(this.#root);
    setTheme(host, firstTheme(), true);
    document.addEventListener("keydown", (event) => this.#key(event));
    this.#arrange();
    if (!wantsStill() && this.linkage.drive) this.transport.toggle();
  }

  get #words(): Record<string, string> {
    return this.#texts.words;
  }

  get #texts() {
    return this.data.texts[currentLanguage()];
  }

  // --- laid out ------------------------------------------------------------------------------------------------------

  /** Everything anew, in another language. */
  #arrange(): void {
    document.documentElement.lang = currentLanguage();
    this.#host.lang = currentLanguage();
    this.#arrangeHeader();
    this.scene.arrange(this.#texts.title, this.#texts.links, this.#words, this.data.unit);
    this.transport.arrange();
    renew(this.#side, ...this.#panels());
    this.#say("");
    this.chosen();
  }

  #arrangeHeader(): void {
    const { title: name } = this.#texts;
    const changed = (one: string) => (this.#resizing.changed ? t("{name}, changed", { name: one }) : one);
    const title = changed(name);
    document.title = `${title} – gruebler`;
    this.#keep();
    const first = shortOf(name);
    // where the header is narrow it has the first part alone
    const rest = h("span.letter", {}, softened(name.slice(first.length)));
    renew(
      this.#header,
      h("h1", { title }, "gruebler ", h("small", {}, softened(first), rest, changed(""))),
      ...(this.data.home ? [this.#ways()] : []),
      h("span.spring", {}),
      ...this.#tools(),
      themeTool(this.#host, true, () => this.scene.recoloured()),
      tool("keys", t("Keys"), () => this.#help()),
      languageMenu(() => {
        history.replaceState(null, "", `#${currentLanguage()}`);
        this.#arrange();
      }),
    );
  }

  /** What the views on the page above show of it. */
  #keep(): void {
    const { names, text, texts } = this.data;
    const { changed } = this.#resizing;
    const both = <Value>(of: (language: Language) => Value) => ({ en: of("en"), de: of("de") });
    const machine: InSpace = {
      changed,
      document: this.data.document,
      text,
      titles: both((language) => texts[language].title),
      links: both((language) => Object.fromEntries(names.map((name, k) => [name, texts[language].links[k]!]))),
    };
    store(IN_SPACE, machine);
  }

  /** Show the machine with other sizes, where the drive stands. */
  #take(data: Model): void {
    const { active, drives } = this.linkage;
    const { playing } = this.transport.player;
    this.transport.pause();
    this.data = data;
    this.linkage = new Machine(data);
    this.scene.take(this.linkage);
    this.linkage.choose(active < data.motions.length ? active : 0);
    this.#arrange();
    const { full, high, low } = this.linkage.cycle;
    const value = drives[this.linkage.active]!;
    if (!this.linkage.drive) return;
    this.transport.pick(full ? value : Math.min(Math.max(value, low), high));
    if (playing) this.transport.toggle();
  }

  /** The ways to the other views, which are on the page above. */
  #ways(): HTMLElement {
    const way = ([key, name]: [string, string]) => {
      const to: Record<string, string> = key === "motion" ? { "aria-current": "page" } : { href: this.#above(key) };
      return h("a", { ...to, "data-text": name }, name);
    };
    return centred(h("nav", {}, ...Object.entries(viewNames()).map(way)));
  }

  /** The address of another view, to which this page is what Motion shows. */
  #above(view: string): string {
    const [, own] = location.pathname.match(/([^/]*)\.html$/) ?? [];
    return `${location.protocol === "file:" ? "../index.html" : "../"}#${currentLanguage()}/${view}/${own}`;
  }

  /** As in the other views: files are opened on the page above. */
  #tools(): HTMLElement[] {
    const save = saving(() => this.showExport());
    if (!this.data.home) return [save];
    const { changed, redoable } = this.#resizing;
    const steps = [
      tool("undo", t("Undo"), () => this.#resizing.undo(), !changed),
      tool("redo", t("Redo"), () => this.#resizing.redo(), !redoable),
    ];
    const open = tool("open", t("Open a file"), () => location.assign(this.#above("motion")));
    return [...steps, open, save, tool("link", t("Copy the link"), () => void this.#share())];
  }

  /** What can be taken away: the linkage as the library reads it, its page, a picture, bodies. */
  showExport(): void {
    const { data, linkage, scene } = this;
    const words = this.#words;
    const told = h("p.told", { role: "status" });
    const say = (text: string, failed = false) => {
      told.className = `told ${failed ? "error" : "good"}`;
      told.replaceChildren(text);
    };
    const save = (ending: string, content: Blob | null, note = "") => {
      if (content) say(`${this.#download(ending, content)}. ${note}`);
    };
    const button = (ending: string, make: () => void, name = ending.toUpperCase()) =>
      h("button.plain", { onclick: make }, name);
    const made = (kind: string, name?: string) => {
      const ask = async () => {
        say(t("One moment …"));
        try {
          const file = await asked<{ base64: string; type: string; note?: string }>("export_in_space", data, { kind });
          save(kind, new Blob([fromBase64(file.base64)], { type: file.type }), file.note);
        } catch (error) {
          say((error as Error).message, true);
        }
      };
      return data.asks ? [button(kind, () => void ask(), name)] : [];
    };
    const stl = () => save("stl", new Blob([stlOf(data.bodies, linkage.poses)], { type: "model/stl" }));
    const png = () => scene.canvas.toBlob((content) => save("png", content));
    const dialog = showOver(
      this.#root,
      `${t("Save")}: ${this.#texts.title}`,
      group(
        words.file!,
        words.document!,
        button("json", () => save("json", this.#document())),
        ...made("toml"),
      ),
      ...(data.asks ? [group(t("For others"), "", ...made("html"))] : []),
      group(t("Picture"), "", button("png", png)),
      group(words.bodied!, data.asks ? words.bodies! : words.stl!, button("stl", stl), ...made("glb", "glTF")),
      ...(data.asks ? [group(t("Simulation"), "", ...made("urdf"))] : [h("p.note", {}, words.convert)]),
    );
    dialog.querySelector("h2")!.after(told);
    dialog.dataset.panel = "export";
  }

  #document(): Blob {
    return new Blob([JSON.stringify(this.data.document, null, 1)], { type: "application/json" });
  }

  /** Save a file, and say so. */
  #download(ending: string, content: Blob): string {
    const name = `${this.#texts.title}.${ending}`;
    download(name, content);
    return t("Saved: {name}", { name });
  }

  #panels(): HTMLElement[] {
    const { data, linkage } = this;
    const [texts, words] = [this.#texts, this.#words];
    const measured = linkage.drive || linkage.spots.length;
    const { title } = texts;
    const panels: HTMLElement[] = title === shortOf(title) ? [] : [h("h2.whole", {}, title)];
    const sign = h("p.note", {}, words.sign);
    if (measured) panels.push(panelOf("measures", t("Measures"), true, this.#facts.element, sign));
    const { scene } = this;
    const look = (name: string) => {
      this.#view = name;
      const along = VIEWS[name];
      scene.look(...(along ?? scene.oblique), along && FLAT);
    };
    this.#views = choice(
      words.view!,
      ["oblique", ...Object.keys(VIEWS)].map((key) => [key, words[key]!]),
      this.#view,
      look,
    );
    this.#arrangeOptions();
    panels.push(panelOf("show", t("Show"), true, this.#views, this.#options));
    const alone = words.alone ? [h("p.note", {}, words.alone)] : [];
    if (!linkage.drive) alone.push(h("p.note", {}, words.none), ...this.#driven());
    this.#sliders = data.motions.length > 1 ? data.motions.map((_, k) => this.#slider(k)) : [];
    const rows = this.#sliders.flatMap(({ input, output }) => [
      h("label", { for: input.id }, input.title),
      input,
      output,
    ]);
    if (rows.length + alone.length)
      panels.push(panelOf("drives", words.drives!, true, h("div.rows", {}, ...rows), ...alone));
    if (data.sizes.length) {
      const size = (distance: number | null) => distance !== null && `${number(distance, DIGITS)} ${data.unit}`;
      const sizes = data.sizes.map(({ link, distance, angle: crossed }) => ({
        name: texts.links[link]!,
        text: [size(distance), crossed !== null && `${number(crossed, DIGITS)}°`].filter(Boolean).join(" · "),
      }));
      this.#sizes.show(sizes);
      const shown = data.resizable ? this.#resizing.element : this.#sizes.element;
      const without = (key: "angle" | "distance") => data.sizes.filter((each) => each[key] === null).length;
      const all = data.sizes.length;
      const some = without("angle") ? words.mixed : words.axes;
      const said = (without("distance") === all && words.tilted) || (without("angle") === all && words.apart) || some;
      panels.push(panelOf("sizes", t("Sizes"), true, shown, h("p.note", {}, said)));
    }
    this.#resizing.arrange();
    const pick = (value: number) => this.transport.pick(value);
    this.#plots = new OutputPlots(linkage, texts, pick, () => this.#facts.show(this.#measures()));
    sign.hidden = !this.#plots.total;
    if (linkage.drive) panels.push(panelOf("plots", t("Plots"), true, this.#plots.element));
    this.#chips = texts.links.map((name, link) => {
      const chip = h("span.chip", {}, h("i", {}), name);
      const colour = data.bodies[link]!.colour.map((part) => Math.round(255 * part)).join(" ");
      chip.style.setProperty("--own", `rgb(${colour})`);
      chip.addEventListener("pointerenter", () => this.scene.mark(link));
      chip.addEventListener("pointerleave", () => this.scene.mark(null));
      return chip;
    });
    panels.push(panelOf("links", t("Links"), true, h("div.chips", {}, ...this.#chips)));
    const open = this.#side.querySelector<HTMLDetailsElement>('[data-panel="joints"]')?.open ?? false;
    panels.push(panelOf("joints", words.joints!, open, h("p.note", {}, words.placed), this.#resizing.joints));
    return panels;
  }

  /** The way to the machine of the catalog that is this one with a drive. */
  #driven(): HTMLParagraphElement[] {
    const { driven, home } = this.data;
    if (!driven || !home) return [];
    const lang = currentLanguage();
    const told = `${this.#words.driven!} `;
    return [h("p.note", {}, told, h("a", { href: `${driven.id}.html#${lang}` }, driven.titles[lang]))];
  }

  /** What is shown beside the bodies, as far as there is any of it. */
  #arrangeOptions(): void {
    const { linkage, scene } = this;
    const option = (key: keyof Scene["shown"], text: string, there = true) => {
      const change = () => {
        scene.shown[key] = box.checked;
        scene.draw();
      };
      const box = h("input", { type: "checkbox", checked: scene.shown[key], onchange: change });
      return there ? [h("label", {}, box, text)] : [];
    };
    renew(
      this.#options,
      ...option("floor", t("Grid")),
      ...option("paths", this.#words.paths!, linkage.spots.length > 0),
      ...option("names", scene.few ? t("Names") : this.#words.spotted!, scene.few || linkage.spots.length > 0),
    );
  }

  /** A slider of one of several drives. */
  #slider(drive: number): { input: HTMLInputElement; output: HTMLElement } {
    const { linkage } = this;
    const { full, high, low } = linkage.cycleOf(drive);
    const input = h("input", {
      id: `drive-${drive}`,
      title: linkage.driveName(drive),
      type: "range",
      min: full ? 0 : low,
      max: full ? TURN : high,
      step: "any",
      oninput: () => {
        const value = Number(input.value); // before it is written anew
        if (drive !== linkage.active) {
          linkage.choose(drive);
          this.transport.arrange();
          this.chosen();
        }
        this.transport.pick(value);
      },
    });
    return { input, output: h("output.value", {}) };
  }

  #say(text: string, kind: "done" | "error" = "error"): void {
    this.#told = kind === "done";
    sayIn(this.#message, text, kind);
  }

  async #share(): Promise<void> {
    const { copied, without } = this.#words;
    const address = location.href.replace(/#.*/, `#${currentLanguage()}`);
    await navigator.clipboard.writeText(address).catch(() => undefined);
    this.#say([copied!, ...(this.#resizing.changed ? [without!] : [])].join(" "), "done");
  }

  // --- driven --------------------------------------------------------------------------------------------------------

  chosen(): void {
    this.transport.showRange({ dead: [], least: null });
    this.posed();
  }

  paused(): void {}

  picked(): void {}

  timed(): void {}

  posed(): void {
    const { linkage } = this;
    if (linkage.ended) this.transport.pause();
    const drive = linkage.driveName(linkage.active);
    if (linkage.ended || !this.#told) this.#say(linkage.ended ? this.#words.end!.replace("{drive}", drive) : "");
    this.scene.draw();
    this.transport.showValue();
    this.#facts.show(this.#measures());
    this.#plots?.follow();
    this.#sliders.forEach(({ input, output }, k) => {
      const value = wrapped(linkage.cycleOf(k), linkage.drives[k]!);
      input.value = String(value);
      output.textContent = this.#valueOf(k, value);
    });
  }

  #valueOf(drive: number, value: number): string {
    const turning = this.data.motions[drive]!.unit === "°";
    return driveText({ drive: { turning }, model: this.linkage.model }, value, DIGITS);
  }

  #measures(): Fact[] {
    const { data, linkage } = this;
    const [texts, words] = [this.#texts, this.#words];
    const { poses } = linkage;
    const facts = this.#plots?.facts ?? [];
    for (const { name, link, at } of linkage.spots) {
      const called = name ?? words.traced!.replace("{link}", texts.links[link]!);
      const text = moved(poses[link]!, at).map((v) => number(Math.abs(v) < 1e-9 * data.size ? 0 : v, DIGITS));
      facts.push({
        name: [called, texts.letters?.[called]].filter(Boolean).join(", "),
        text: text.join(" | "),
        style: "wide",
        note: data.unit,
      });
    }
    if (linkage.drive) {
      const { full } = linkage.cycle;
      const [low, high] = endsOf(data.motions[linkage.active]!) as [number, number];
      const from = linkage.drive.turning ? angle(low) : number(low, DIGITS);
      const ends = `${from} … ${this.#valueOf(linkage.active, high).replace(" ", "\u00a0")}`;
      facts.push({ name: t("Range of the drive"), text: full ? t("full turns") : ends });
    }
    return facts;
  }

  /** The name of the link under the mouse, as a tip; it, else the one that was taken, is marked among the links. */
  #pointed(link: number | null): void {
    const marked = link ?? this.linkage.traced?.link;
    for (const [k, chip] of this.#chips.entries()) chip.classList.toggle("on", k === marked);
    this.scene.element.title = link === null ? "" : this.#texts.links[link]!;
  }

  // --- keys ----------------------------------------------------------------------------------------------------------

  #help(): void {
    const words = this.#words;
    showRows(this.#root, [
      [words.pull!, words.pulled!],
      [words.round!, words.rounded!],
      [words.near!, words.nearer!],
      [t("Space"), t("play and pause")],
      ["← →", t("move the drive a little (an angle by 1°), with Shift ten times as far")],
      ["+ − 0", t("zoom, show everything")],
      ["?", t("this list")],
    ]);
  }

  #key(event: KeyboardEvent): void {
    const target = event.composedPath()[0] as HTMLElement;
    const ctrl = event.ctrlKey || event.metaKey;
    const typing = /^(INPUT|SELECT)$/.test(target.tagName);
    if (ctrl ? !/[syz]/.test(event.key) || (typing && event.key !== "s") : typing) return;
    if (ctrl && event.key === "s") this.#download("json", this.#document());
    else if (ctrl) this.#resizing[event.key === "z" ? "undo" : "redo"]();
    else if (event.key === "?") this.#help();
    else if (!drivenBy(event, target, this.transport, this.scene)) return;
    event.preventDefault();
  }
}
