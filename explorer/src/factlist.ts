/** The measures beside the stage, and what the library says of them in words. */

import { h, renew, unbroken, withMinus } from "./dom";
import type { Fact } from "./facts";
import { softened } from "./header";
import { t } from "./language";
import type { Linkage } from "./linkage";
import type { LinkageDocument } from "./model";
import type { Page } from "./view";

const ASKED_AFTER = 350; // milliseconds

/** With numbers beside what they belong to: a unit, or the word before them. */
export function bound(text: string): string {
  return unbroken(unbroken(text), / (?=\d)/g);
}

export class FactList {
  readonly element = h("dl.facts", {});

  /** With what follows when a line with a hint is pointed at, or no more. */
  constructor(private readonly point: (on: boolean) => void = () => {}) {}

  /** What each line is made of but for its value. */
  readonly #told: string[] = [];

  /** From pose to pose most stay as they are, or have another value. */
  show(facts: readonly Fact[]): void {
    const { children } = this.element;
    facts.forEach(({ hint, name, text, style = "", note }, k) => {
      const told = [name, style, note, hint].join();
      const old = children[k];
      if (old && told === this.#told[k]) {
        const value = old.lastChild!.firstChild as Text;
        if (value.data !== text) value.data = text;
        return;
      }
      this.#told[k] = told;
      const value = h("dd", { class: style }, new Text(text), note && " ", note && h("small", {}, bound(note)));
      const on = { onpointerenter: () => this.point(true), onpointerleave: () => this.point(false) };
      const made = h("div", hint ? { title: hint, ...on } : {}, h("dt", {}, bound(softened(name))), value);
      if (old) old.replaceWith(made);
      else this.element.append(made);
    });
    while (children.length > facts.length) this.element.lastChild!.remove();
  }
}

export class InWords {
  readonly element = h("details.words", {});
  readonly #said = h("p.note", {});
  #asked: Linkage | null = null;
  #timer = 0;

  constructor(private readonly page: Page) {}

  /** Of another linkage nothing is said yet. */
  arrange(linkage: Linkage): void {
    if (linkage !== this.#asked) this.#said.textContent = "…";
    this.#asked = linkage;
    renew(this.element, h("summary", {}, t("In words")), this.#said);
    this.element.hidden = !this.page.served;
  }

  /** After a change what was said holds no more; it keeps its room until there is an answer. */
  wait(): void {
    this.#said.classList.add("waiting");
  }

  /** Ask for it after a while without a change. */
  ask(linkage: Linkage, documentOf: () => LinkageDocument): void {
    this.#asked = linkage;
    if (!this.page.served) return;
    this.wait();
    clearTimeout(this.#timer);
    const tell = (text: string) => {
      if (linkage !== this.#asked) return;
      this.#said.classList.remove("waiting");
      this.#said.textContent = withMinus(text);
    };
    this.#timer = setTimeout(() => {
      const { cycle, model } = linkage;
      const between = model.span.between && !cycle.full ? [cycle.low, cycle.high] : []; // where the machine is used
      const question = { document: documentOf(), source: model.source, between };
      this.page.ask<{ lines: string[] }>("measures", question).then(
        ({ lines }) => tell(lines.join(" ")),
        (error: Error) => tell(error.message),
      );
    }, ASKED_AFTER);
  }
}
