/** A field for a size of a cam or a roller: the library assembles the machine with another one. */

import { digits } from "./digits";
import { savedDocument } from "./document";
import { h } from "./dom";
import { softened } from "./header";
import { number, parsed, t } from "./language";
import type { RoundSize } from "./lifts";
import type { Linkage } from "./linkage";
import type { Model } from "./model";
import type { Page } from "./view";

/** What shows the sizes. */
export interface Resizer {
  readonly page: Page;
  readonly linkage: Linkage;
  /** Show the same machine with other sizes of its cams; it can be undone. */
  resized(model: Model): void;
}

/** Its label, the field, and its unit. */
export function roundField(editor: Resizer, k: number, name: string, size: RoundSize): HTMLElement[] {
  const { joint, link } = editor.linkage.sizes.element(k);
  const { what, value, unit, set } = size;
  const id = `round-${joint}-${link}-${what}-${value}`; // another value is another row
  const input = h("input", {
    id,
    ...digits(value),
    inputmode: "decimal",
    readonly: !set,
    onchange: () => {
      const wanted = parsed(input.value);
      const [least, most] = [0.001, unit === "°" ? 360 : 1e6];
      const right = wanted >= least && wanted <= most;
      input.setAttribute("aria-invalid", String(!right));
      if (right) void resize(editor, k, set!(wanted), input);
      else editor.page.say(t("Expected a number from {least} to {most}.", { least: number(least), most: `${most}` }));
    },
    onkeydown: (event: KeyboardEvent) => event.stopPropagation(),
  });
  const label = h("label", { for: id }, h("b", {}, softened(name)), `, ${what}`);
  return [label, input, h("span.unit", {}, unit), h("span", {})];
}

/** Let the library assemble the machine anew, with other sizes of an element. */
export async function resize(editor: Resizer, k: number, sizes: Record<string, unknown>, input: HTMLInputElement) {
  const { linkage, page } = editor;
  const { drives, model } = linkage;
  const { joint, link } = linkage.sizes.element(k);
  const resized = {
    joint: model.joints[joint]!.name,
    link: model.links[link]!,
    sizes,
    drives: [...drives.slice(0, model.drives.length)],
  };
  const rows = input.closest(".sizes")!;
  const { name, names, source, span } = model;
  const fields = () => [...rows.querySelectorAll("input")];
  const open = fields().filter((field) => !field.readOnly);
  for (const field of open) field.readOnly = true;
  page.say(t("One moment …"), "done");
  try {
    const document = savedDocument(linkage);
    const made = await page.ask<Model>("open_document", { document, name, source, resized });
    if (linkage !== editor.linkage) return; // another machine was opened
    const focus = fields().findIndex((field) => field.matches(":focus"));
    editor.resized({ ...made, names, changed: true, span: { ...made.span, stops: span.stops ?? [] } });
    fields()[focus]?.focus();
  } catch (error) {
    page.say((error as Error).message);
    for (const field of open) field.readOnly = false;
    input.setAttribute("aria-invalid", "true");
  }
}
