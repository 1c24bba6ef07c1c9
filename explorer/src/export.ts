/** What can be taken away: pictures, tables, files, the link, and the same in Python and on a command line. */

import { h } from "./dom";
import { t } from "./language";
import { chainText, type LinkageDocument } from "./model";
import type { Page } from "./view";

/** What is taken away. */
export interface Exported {
  /** Whether it has other sizes than what its name and its source stand for. */
  readonly changed: boolean;
  document(): LinkageDocument;
  /** The picture as an SVG file. */
  picture(): string;
  /** The curves as CSV. */
  table(): string;
}

export function download(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  const anchor = h("a", { href: address, download: name });
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

export function exportPanel(page: Page, shown: Exported): HTMLElement {
  const stem = () => (page.shown.source || page.shown.name || "linkage").replace(/[^\w-]+/g, "_");
  const save = (suffix: string, type: string, content: string | Blob) =>
    download(`${stem()}.${suffix}`, content instanceof Blob ? content : new Blob([content], { type }));
  const button = (text: string, act: () => void) => h("button", { class: "plain", onclick: act }, text);
  const own = [
    button("SVG", () => save("svg", "image/svg+xml", shown.picture())),
    button("PNG", () => void png(shown.picture()).then((blob) => save("png", "image/png", blob))),
    button("CSV", () => save("csv", "text/csv", shown.table())),
    button("JSON", () => save("json", "application/json", JSON.stringify(shown.document(), null, 1))),
  ];
  const served = page.served
    ? ["TOML", "GIF", "HTML", "PDF"].map((kind) =>
        button(kind, () => {
          page
            .ask<{ base64: string; type: string }>("export", {
              document: shown.document(),
              kind: kind.toLowerCase(),
              name: page.shown.name,
            })
            .then(
              ({ base64, type }) =>
                save(
                  kind.toLowerCase(),
                  type,
                  new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type }),
                ),
              (error: Error) => page.say(error.message),
            );
        }),
      )
    : [];
  const model = page.shown;
  const [reader, measured] = ["from gruebler.files import read_linkage", "print(gr.measures(linkage).explain())"];
  const named = model.source && !shown.changed; // by its name the library finds it as it was
  const file = `${stem()}.json`;
  const word = named ? model.source : file;
  return h(
    "div",
    {},
    h(
      "div",
      { class: "chips" },
      ...own,
      ...served,
      button(t("Copy the link"), () => void page.share()),
    ),
    h("p", { class: "note" }, t("The chain as text")),
    h("pre", { "data-text": "chain" }, chainText(model)),
    named
      ? null
      : h("p", { class: "note", "data-note": "file" }, t("Save it as JSON first; the commands read {file}.", { file })),
    h("p", { class: "note" }, t("The same on the command line")),
    h("pre", {}, `gruebler analyse ${word}\ngruebler draw ${word} -o ${stem()}.svg`),
    h("p", { class: "note" }, t("The same in Python")),
    h(
      "pre",
      {},
      named && !model.source.includes(":")
        ? `import gruebler as gr\n\nlinkage = gr.teaching.catalog.entry("${model.source}").linkage()\n${measured}`
        : `${reader}\nimport gruebler as gr\n\nlinkage = read_linkage("${file}")\n${measured}`,
    ),
  );
}

async function png(file: string): Promise<Blob> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(file)}`;
  await image.decode();
  const canvas = h("canvas", { width: 2 * image.naturalWidth, height: 2 * image.naturalHeight });
  canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no picture")))),
  );
}
