/** The sheet of what can be taken away: files, the link, pictures, tables, the same on a command line and in Python. */

import { action, h, menu } from "./dom";
import { showOver } from "./help";
import { currentLanguage, t } from "./language";
import { chainText, type LinkageDocument } from "./model";
import { fromBase64 } from "./packed";
import { film, filmType, imageOf } from "./video";
import type { Page } from "./view";

/** What is taken away. */
export interface Exported {
  /** Whether it has other sizes than what its name and its source stand for. */
  readonly changed: boolean;
  document(): LinkageDocument;
  /** The picture as an SVG file. */
  picture(): string;
  /** The pictures of a film: once through its motion, from the pose that is shown. */
  pictures(): Generator<string>;
  /** The curves as CSV. */
  table(): string;
}

export function download(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  const anchor = h("a", { href: address, download: name });
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/** A row of the sheet: what it is for, and the ways to take it. */
export function group(title: string, note: string, ...ways: (Node | null)[]): HTMLElement {
  return h("div.form", { "data-group": "" }, h("p", {}, h("b", {}, title), h("small", {}, note)), ...ways);
}

interface Saved {
  base64: string;
  type: string;
  ending?: string;
  note?: string;
}

const WIDTHS = [640, 1280, 1920]; // pixels
const GIF_WIDTH = 423; // of a GIF with a zoom of 1
const LARGEST_ZOOM = 4;

/** What the reader chose, for the next time that the sheet is shown. */
const choice = { width: 1280, kind: "linkage2" };
const kinds = new Map<string, Promise<{ name: string; title: string }[]>>();

/** Show the sheet over the page until something of it is taken. */
export function showExport(root: HTMLElement, page: Page, shown: Exported): void {
  const told = h("p.told", { role: "status" });
  const say = (text: string, failed = false) => {
    told.replaceChildren(text);
    told.className = `told ${failed ? "error" : "good"}`;
  };
  const dialog = showOver(root, `${t("Save")}: ${page.linkage.title}`, ...groupsOf(page, shown, say));
  dialog.querySelector("h2")!.after(told); // in its place
  dialog.dataset.panel = "export";
  dialog.addEventListener("click", ({ target }) => {
    if (target === dialog || (target as Element).matches("[data-act=share]")) dialog.close();
  });
}

type Say = (text: string, failed?: boolean) => void;

/** Save the linkage as it is opened again, and say under which name. */
export function saveDocument(page: Page, shown: Exported, say: Say = (text) => page.say(text, "done")): void {
  save(page, say, "json", "application/json", JSON.stringify(shown.document(), null, 1));
}

function stemOf({ shown }: Page): string {
  return (shown.source || shown.name || "linkage").replace(/[^\w-]+/g, "_");
}

function save(page: Page, say: Say, suffix: string, type: string, content: string | Blob, note = ""): void {
  const name = `${stemOf(page)}.${suffix}`;
  download(name, content instanceof Blob ? content : new Blob([content], { type }));
  say(`${t("Saved: {name}", { name })}. ${note}`);
}

function groupsOf(page: Page, shown: Exported, say: Say): (Node | null)[] {
  const button = (text: string, act: () => void) => h("button.plain", { onclick: act }, text);
  const failed = (error: Error) => say(error.message, true);
  const ask = (kind: string, more: Record<string, unknown> = {}) => {
    page
      .ask<Saved>("export", { document: shown.document(), kind, name: page.shown.name, ...more })
      .then(({ base64, type, ending, note }) => {
        const bytes = fromBase64(base64);
        save(page, say, ending?.slice(1) ?? kind, type, new Blob([bytes], { type }), note);
      }, failed);
  };
  const recorded = filmType();
  const record = async () => {
    say(t("The video is being recorded …"));
    const blob = await film(shown.pictures(), choice.width, recorded!);
    save(page, say, recorded!.startsWith("video/mp4") ? "mp4" : "webm", recorded!, blob);
  };
  const gif = () => ask("gif", { zoom: Math.min(LARGEST_ZOOM, choice.width / GIF_WIDTH) });
  const widths = WIDTHS.map((value): [string, string] => [`${value}`, `${value} px`]);
  const width = menu(t("Width of videos"), widths, String(choice.width), (value) => (choice.width = Number(value)));
  const served = (name: string, kind = name.toLowerCase()) => (page.served ? button(name, () => ask(kind)) : null);
  const { unit } = page.shown;
  const groups = [
    group(
      t("Continue here"),
      t("JSON opens here again, TOML is to be read and edited"),
      h("button.key", { onclick: () => saveDocument(page, shown, say) }, "JSON"),
      served("TOML"),
    ),
    group(
      t("For others"),
      "",
      action("share", () => void page.share(), t("Copy the link")),
      served("HTML"),
    ),
    group(
      t("Picture"),
      t("PNG: twice as large as on the screen"),
      button("PNG", () => void png(shown.picture()).then((blob) => save(page, say, "png", "image/png", blob), failed)),
      button("SVG", () => save(page, say, "svg", "image/svg+xml", shown.picture())),
      served("PDF"),
    ),
    group(
      t("Moving picture"),
      "",
      width,
      recorded ? button(t("Video"), () => void record().catch(failed)) : null,
      page.served ? button("GIF", gif) : null,
    ),
    ...(page.served
      ? [
          group(t("Drawing for CAD"), unit && `1 : 1, ${/in|ft/.test(unit) ? "in" : "mm"}`, served("DXF")),
          group(t("Simulation"), "", served("MuJoCo", "mjcf"), served("URDF")),
        ]
      : []),
    group(
      t("Data"),
      t("CSV: the motion, a row for each position"),
      button("CSV", () => save(page, say, "csv", "text/csv", shown.table())),
    ),
    ...(page.served ? [group(t("Other programs"), "", ...programs(page, ask))] : []),
  ];
  const model = page.shown;
  const named = model.source && !shown.changed; // by its name the library finds it as it was
  const stem = stemOf(page);
  const file = `${stem}.json`;
  const word = named ? model.source : file;
  return [
    ...groups,
    page.served ? null : h("p.note", {}, t("DXF and files of other programs: gruebler convert FILE OUT")),
    h(
      "details.words",
      {},
      h("summary", {}, t("As text, in Python")),
      h("p.note", {}, t("The chain as text")),
      h("pre", { "data-text": "chain" }, chainText(model)),
      named ? null : h("p.note", { "data-note": "file" }, t("Save it as JSON; the commands read {file}.", { file })),
      h("p.note", {}, t("The same on the command line")),
      h("pre", {}, `gruebler analyse ${word}\ngruebler draw ${word} -o ${stem}.svg`),
      h("p.note", {}, "Python"),
      h("pre", {}, `import gruebler as gr\n\nlinkage = gr.read("${word}")\nprint(gr.measures(linkage).explain())`),
    ),
  ];
}

/** The formats of other programs, which the library writes. */
function programs(page: Page, ask: (kind: string) => void): HTMLElement[] {
  const onchange = () => (choice.kind = kind.value);
  const kind = h("select", { "aria-label": t("File of another program"), "data-field": "kind", onchange });
  kind.style.cssText = "flex: 1; width: 18em"; // before they are known, too
  const lang = currentLanguage();
  if (!kinds.has(lang)) kinds.set(lang, page.ask("saved_kinds", {}));
  kinds.get(lang)!.then(
    (found) =>
      kind.append(
        ...found.map(({ name, title }) => h("option", { value: name, selected: name === choice.kind }, title)),
      ),
    () => kinds.delete(lang), // it is asked again
  );
  return [kind, action("save", () => ask(kind.value), t("Save"))];
}

async function png(file: string): Promise<Blob> {
  const image = await imageOf(file);
  const canvas = h("canvas", { width: 2 * image.naturalWidth, height: 2 * image.naturalHeight });
  canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no picture")))),
  );
}
