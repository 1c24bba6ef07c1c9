/** The page: its header, its views, its language and theme, the link that is its document. */

import { BuildView } from "./build";
import { CatalogView } from "./catalog";
import { h, renew } from "./dom";
import { ExercisesView } from "./exercises";
import { saveDocument, showExport } from "./export";
import { languageMenu, partsOf, saving, sayIn, sayWhetherOn, tabs, viewNames } from "./header";
import { showKeys } from "./help";
import { Backend, type HostModel } from "./host";
import { keptLink } from "./kept";
import { loadKernel } from "./kernel";
import { type Keyed, listenToKeys } from "./keys";
import { currentLanguage, firstLanguage, type Language, setLanguage, t } from "./language";
import { LibraryView } from "./library";
import { packed } from "./link";
import type { Change } from "./loads";
import type { Model } from "./model";
import { MotionView } from "./motion";
import { contentOf, takeDropped } from "./opening";
import { bytesOf } from "./packed";
import { openShared, type Shared, sharedOf, shareLink, unshared } from "./sharing";
import { firstTheme, setTheme, shell, themeTool, tool } from "./shell";
import { IN_SPACE, type InSpace, store, stored } from "./storing";
import { StructureView } from "./structure";
import { SynthesisView } from "./synthesis";
import type { Page, Place, View } from "./view";
import { drawn } from "./waiting";

const TYPED = "gruebler-typed"; // for the page that is loaded again
const LEFT = "gruebler-left"; // what the address did not hold yet when the page was left, with this address
const PATIENCE = 10_000; // ms, until a page appears without what its address names

/** With the linkage, where the address does not hold it yet. */
type Kept = Place & { shared?: Shared };

export class App implements Page {
  readonly backend: Backend;
  readonly motion: MotionView;
  /** The views that were wanted until now, by their names in `makers`. */
  private readonly views: Record<string, View>;
  readonly #makers: Record<string, () => View>;
  private view = "motion";
  /** The machine in space that Motion shows, on a page of its own, in place of the linkage at hand. */
  #space = "";
  /** How far each view was scrolled when it was left. */
  readonly #scrolled: Record<string, number> = {};
  readonly #header = h("header", {});
  private readonly message = h("div.message", { role: "status", hidden: true });
  private readonly lost = h("div.lost", { role: "status", hidden: true });
  private readonly root: HTMLElement;
  readonly #place: HTMLElement;
  private readonly host: HTMLElement;
  readonly #shadow: ShadowRoot;
  /** Whether the address is that of a link that could not be read, or tells view and language: it stays until something
   * is changed. */
  #unread = false;
  #writing = 0;
  /** Whether the address holds what is shown. */
  #written = true;
  private hash = "";
  /** How often the reader went to another view, or chose what is to be opened. */
  #turns = 0;

  constructor(
    readonly model: HostModel,
    element: HTMLElement,
  ) {
    const height = model.get("host") === "notebook" ? `${Number(model.get("height") ?? 640)}px` : "100%";
    const { host, shadow } = shell(element, height, String(model.get("styles") ?? ""));
    this.host = host;
    this.#shadow = shadow;
    setLanguage(firstLanguage(String(model.get("lang") ?? "")));
    setTheme(this.host, firstTheme(), this.#linkable);
    this.backend = new Backend(model);
    this.motion = new MotionView(this);
    this.views = { motion: this.motion };
    this.#makers = { motion: () => this.motion };
    if (this.backend.present) {
      this.#makers = {
        build: () => (this.served ? new BuildView(this) : new LibraryView()),
        structure: () => new StructureView(this),
        ...this.#makers,
        synthesis: () => new SynthesisView(this),
        catalog: () => new CatalogView(this),
        exercises: () => new ExercisesView(this),
      };
    }
    // a notebook has its own main part
    this.#place = h(this.#linkable ? "main" : "div", { class: "views" }, this.motion.element);
    this.root = h("div.app", {}, this.#header, this.lost, this.message, this.#place);
    listenToKeys(() => this.#keyed, this.#linkable ? null : this.root);
    takeDropped(host, (file) => void this.openFile(file));
    model.on("connection", ((on: boolean) => sayWhetherOn(this.lost, on)) as (message: never) => void);
    model.on("change:machine", (() => this.open(model.get("machine") as Model)) as (message: never) => void);
  }

  async start(): Promise<void> {
    try {
      await loadKernel(bytesOf(String(this.model.get("motion"))));
    } catch (why) {
      this.#shadow.append(this.root);
      this.#appear();
      return this.say(t("This page needs WebAssembly: {why}", { why: String(why) }), "error");
    }
    const addressed = this.#linkable && location.hash.length > 1;
    this.#unread = addressed; // until it is read
    const place = history.state as Kept | null; // that of a page which is loaded again, before it is written anew
    await drawn();
    this.motion.take(this.model.get("machine") as Model);
    await drawn();
    for (const _ of this.motion.pieces()) {
      if (!this.root.isConnected) {
        this.show("motion");
        this.#shadow.append(this.root); // out of sight beside the outline
        if (!addressed) this.#appear();
      }
      await drawn();
    }
    if (this.shown.plays && !addressed) this.motion.run();
    if (this.#linkable) {
      const read = this.#read(place?.shared).then(() => this.#returnTo(place)); // its view, however late
      await Promise.race([read, new Promise((go) => setTimeout(go, PATIENCE))]);
      this.motion.forget();
      if (addressed) this.motion.recall();
      const typed = stored<{ of: string; change: Change }>(TYPED);
      if (typed?.of === this.hash) void this.motion.side.forces.typedBefore(typed.change);
      this.#appear();
      this.#arrangeHeader();
      history.scrollRestoration = "manual"; // each view knows where it was
      addEventListener("popstate", (event) => void this.#goneBack(event));
      addEventListener("pagehide", () => {
        this.#leaveField();
        store(TYPED, { of: location.hash, change: this.motion.side.forces.typed });
        store(LEFT, this.#written ? null : { of: location.hash, shared: this.#shared() });
        if (!this.#written) this.motion.keep(location.hash);
      });
    }
  }

  #appear(): void {
    this.#shadow.querySelector(".loading")?.remove(); // the outline, which stood there until now
  }

  destroy(): void {
    this.motion.transport.pause();
    this.motion.stage.destroy();
    this.host.remove();
  }

  get served(): boolean {
    return this.backend.served;
  }

  get linkage() {
    return this.motion.linkage;
  }

  get shown(): Model {
    return this.motion.linkage.model;
  }

  get limits(): Page["limits"] {
    return (this.model.get("limits") ?? {}) as Page["limits"];
  }

  get #linkable(): boolean {
    return this.model.get("host") !== "notebook";
  }

  // --- views ---------------------------------------------------------------------------------------------------------

  show(name: string): void {
    const turned = this.view !== name;
    if (turned) {
      this.#turns++;
      this.say("");
      this.#scrolled[this.view] = scrollY;
    }
    this.view = name;
    const fresh = !this.views[name];
    const view = this.#viewOf(name);
    for (const [key, { element }] of Object.entries(this.views)) element.classList.toggle("shown", key === name);
    if (name === "motion") this.#space = "";
    else {
      this.motion.transport.endFall();
      this.motion.transport.pause();
    }
    this.#arrangeHeader();
    if (fresh) view.arrange();
    if (turned && this.#linkable) scrollTo(0, name === "motion" ? 0 : (this.#scrolled[name] ?? 0));
    view.appeared?.();
  }

  /** A view, which is made when it is first wanted. */
  #viewOf(name: string): View {
    const view = this.views[name] ?? this.#makers[name]!();
    if (!this.views[name]) this.#place.append(view.element);
    this.views[name] = view;
    return view;
  }

  /** Show another view, to which the browser's way back leads from the next one. */
  #turnTo(name: string): void {
    if (name === "motion") {
      if (this.views[this.view]!.moves?.()) return;
      if (this.#space) return location.assign(`${this.#spacePage}/again`);
    }
    this.#goTo(name);
  }

  #goTo(name: string): void {
    if (name !== this.view) this.#remember(name);
    this.show(name);
  }

  /** Whose changes are undone: a view that draws, else the motion, to which it leads back from a machine in space. */
  get #undoing(): Keyed["undoing"] {
    const view = this.views[this.view]!;
    if (view.undoable) return view;
    return this.#space ? { undoable: [true, false], undo: () => this.#goTo("motion") } : this.motion;
  }

  /** A new place in the history of the browser; the one before keeps its view and its linkage. */
  #remember(view: string): void {
    if (!this.#linkable) return;
    clearTimeout(this.#writing);
    const shared = this.#written ? undefined : this.#shared(); // which its address does not hold yet
    history.replaceState({ ...this.#placed(this.view), shared }, "", this.hash || null);
    history.pushState(this.#placed(view), "", this.hash || null);
    if (shared) this.#write();
  }

  #placed(view: string): Place {
    return { view, space: this.#space };
  }

  /** Back, or forth: the view, and the linkage if it was another one. */
  async #goneBack(event: PopStateEvent): Promise<void> {
    const place = event.state as Kept | null;
    if (place?.shared || location.hash !== this.hash) {
      clearTimeout(this.#writing);
      this.#unread = location.hash.length > 1;
      await this.#read(place?.shared);
    }
    this.#returnTo(place);
  }

  #returnTo(place: Place | null): void {
    const { view = "", space = "" } = place ?? {};
    if (!(view in this.#makers)) return;
    this.#space = space;
    this.show(view);
  }

  get inSpace(): InSpace | null {
    return this.#space ? stored(IN_SPACE) : null;
  }

  /** Where the machine in space is. */
  get #spacePage(): string {
    return `space/${this.#space}.html#${currentLanguage()}`;
  }

  /** The name of the mechanism in the language of the page. */
  get #name(): string {
    const own = this.views[this.view]?.title;
    if (own) return own;
    const space = this.inSpace;
    const name = (space ? space.titles[currentLanguage()] : this.motion.linkage?.title) ?? "";
    return name && (space ?? this.motion).changed ? t("{name}, changed", { name }) : name;
  }

  #arrangeHeader(): void {
    this.host.lang = currentLanguage();
    const names = viewNames();
    const keys = Object.keys(this.#makers);
    const [back, forth] = this.#undoing.undoable!;
    const file = h("input", { type: "file", hidden: true, onchange: () => void this.openFile(file.files?.[0]) });
    if (keys.length > 1)
      for (const [key, { element }] of Object.entries(this.views)) {
        element.setAttribute("role", "tabpanel");
        element.setAttribute("aria-label", names[key]!);
      }
    if (this.#linkable) {
      document.documentElement.lang = currentLanguage();
      document.title = this.#name ? `${this.#name} – gruebler` : "gruebler";
    }
    renew(
      this.#header,
      h("h1", { title: this.#name }, "gruebler ", h("small", {}, ...partsOf(this.#name))),
      ...(keys.length > 1 ? [tabs(keys, this.view, (key) => this.#turnTo(key))] : []),
      h("span.spring", {}),
      tool("undo", t("Undo"), () => this.#undoing.undo?.(), !back),
      tool("redo", t("Redo"), () => this.#undoing.redo?.(), !forth),
      file,
      tool("open", t("Open a file"), () => file.click()),
      saving(() => void this.#save(() => showExport(this.root, this, this.motion))),
      tool("link", t("Copy the link"), () => void this.share()),
      themeTool(this.host, this.#linkable, () => this.motion.stage.recoloured()),
      tool("keys", t("Keys"), () => this.#keyed.showKeys()),
      languageMenu(() => this.arrange()),
    );
  }

  /** Everything anew, in another language. */
  arrange(): void {
    for (const view of Object.values(this.views)) view.arrange();
    this.motion.measured();
    this.motion.stage.build();
    this.show(this.view);
    this.say("");
  }

  say(text: string, kind: "error" | "done" = "error", action?: HTMLElement): void {
    sayIn(this.message, text, kind, action);
  }

  ask<Result>(method: string, params: Record<string, unknown>, progress?: (text: string) => void) {
    return this.backend.ask<Result>(method, params, currentLanguage(), progress);
  }

  // --- the document --------------------------------------------------------------------------------------------------

  open(model: Model, drive?: number): void {
    this.say("");
    if (this.motion.linkage) this.#remember("motion");
    this.hash = ""; // not that of this machine: who goes back at once is shown the one before
    const drawnIn = this.views[this.view]?.title && this.view;
    this.show("motion");
    this.motion.open(model, drawnIn);
    if (drive === undefined) this.motion.run();
    else this.motion.transport.pick(drive);
    // what had the focus is out of sight
    if (this.#shadow.activeElement) this.root.querySelector<HTMLElement>(".play")?.focus({ preventScroll: true });
  }

  async choose<Answer>(request: Promise<Answer>, open: (answer: Answer) => void): Promise<boolean> {
    const turn = ++this.#turns;
    const wanted = () => turn === this.#turns;
    try {
      const answer = await request;
      if (!wanted()) return false;
      open(answer);
      return true;
    } catch (error) {
      if (wanted()) this.say((error as Error).message);
      return false;
    }
  }

  move(): void {
    this.#turnTo("motion");
    this.motion.run();
  }

  /** Show the structure of a text. */
  describe(text: string): void {
    this.#turnTo("structure");
    void (this.#viewOf("structure") as StructureView).describe(text, true);
  }

  /** After a change: the link follows, a notebook is told. */
  changed(): void {
    this.#arrangeHeader();
    if (this.#unread && !this.motion.undoable[0]) return;
    this.#unread = false;
    this.#written = false;
    this.#write();
  }

  /** Let the address follow, a moment later. */
  #write(): void {
    clearTimeout(this.#writing);
    this.#writing = setTimeout(() => void this.write(), 150);
  }

  /** Copy the address with the linkage in it. */
  async share(): Promise<void> {
    if (this.#space) return shareLink(this, new URL(this.#spacePage, location.href).href);
    await this.#typed();
    await this.write();
    await shareLink(this, this.#linkable ? location.href : `#${await packed(this.#shared())}`);
  }

  #shared(): Shared {
    return sharedOf(this.motion, this.backend.present && !this.served);
  }

  private async write(): Promise<void> {
    const shared = this.#shared();
    this.model.set("document", shared.document);
    this.model.save_changes();
    if (!this.#linkable) return;
    const hash = `#${await packed(shared)}`;
    if (this.#unread) return; // the reader went back meanwhile
    this.hash = hash;
    this.motion.keep(this.hash);
    history.replaceState(this.#placed(this.view), "", this.hash);
    this.#written = true;
  }

  async #read(kept?: Shared): Promise<void> {
    let text = location.hash.slice(1);
    const left = stored<{ of: string; shared: Shared }>(LEFT);
    const shared = (left?.of === location.hash && left.shared) || kept; // the later one
    store(LEFT, null);
    if (!text && !shared) return;
    this.hash = location.hash;
    const [lang, named = "", space] = text.split("/");
    const view = named.replace("forces", "motion"); // a part of it
    const below = view in this.#makers; // from the page of a machine in space
    if (below) {
      setLanguage(lang as Language);
      text = keptLink().slice(1);
    }
    try {
      if ((shared || text) && (await openShared(shared || (await unshared(text)), this)) && !below) this.show("motion");
      this.#unread = false;
      this.changed();
    } catch (error) {
      this.#unread = true;
      this.say((error as Error).message);
    }
    if (!below) return;
    clearTimeout(this.#writing);
    this.#unread = this.#written = true;
    this.#returnTo({ view, space });
    this.arrange();
    if (view !== named) this.motion.side.open(named);
  }

  // --- files ---------------------------------------------------------------------------------------------------------

  async openFile(file: File | undefined): Promise<void> {
    const found = file && (await contentOf(file, this));
    if (!found) return;
    if (found.document) this.motion.openDocument(found.document);
    else if (found.model) this.open(found.model);
    else if (found.drawing) {
      this.#turnTo("build");
      (this.#viewOf("build") as BuildView).begin(found.drawing);
    } else if (found.text) this.describe(found.text);
    else if (found.points) {
      this.#turnTo("synthesis");
      (this.#viewOf("synthesis") as SynthesisView).take(found.points, found.closed ?? false, found.order);
    }
    if (found.note) this.say(found.note, "done");
  }

  /** What is typed counts, also what is still in its field. */
  async #typed(): Promise<void> {
    this.#leaveField();
    await this.motion.side.forces.settled();
  }

  #leaveField(): void {
    (this.#shadow.activeElement as HTMLElement | null)?.blur();
  }

  /** What the view shows is saved by itself, else the machine at hand. */
  async #save(machine: () => void): Promise<void> {
    await this.#typed();
    const view = this.views[this.view];
    if (view?.save) view.save();
    else if (this.#space) location.assign(`${this.#spacePage}/again/save`);
    else machine();
  }

  /** What its keys need. */
  get #keyed(): Keyed {
    return {
      here: this.views[this.view]!,
      motion: this.motion,
      save: () => void this.#save(() => saveDocument(this, this.motion)),
      showKeys: () => showKeys(this.root, this.served),
      undoing: this.#undoing,
    };
  }
}
