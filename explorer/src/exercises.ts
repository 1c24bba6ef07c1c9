/** Exercises: a fresh task, the student's answers marked with their hints, the solution step by step. */

import { h, renew } from "./dom";
import { t } from "./language";
import type { Page, View } from "./view";
import { moment } from "./waiting";

interface Task {
  id: string;
  name: string;
  task: string;
  asked: { key: string; name: string; unit: string; choice: boolean }[];
}

interface Marked {
  marks: { key: string; mark: "right" | "near" | "wrong"; hint: string }[];
  solution: string;
}

export class ExercisesView implements View {
  readonly element = h("div", { class: "view", "data-page": "exercises" });
  private kind = "mobility";
  private level = 1;
  private seed = 1 + Math.floor(Math.random() * 9999);
  private task: Task | null = null;
  private readonly place = h("div", {});
  private readonly kinds = h("select", { onchange: () => (this.kind = this.kinds.value) });
  private answers: Record<string, string> = {};

  constructor(private readonly page: Page) {}

  appeared(): void {
    if (!this.kinds.options.length) void this.fillKinds().then(() => this.fresh());
  }

  arrange(): void {
    this.kinds.setAttribute("aria-label", t("Theory"));
    const level = h(
      "select",
      { "aria-label": t("Level"), onchange: () => (this.level = Number(level.value)) },
      ...[1, 2, 3].map((k) => h("option", { value: k, selected: k === this.level }, t("Level {level}", { level: k }))),
    );
    renew(
      this.element,
      h(
        "div",
        { class: "page" },
        h("h2", {}, t("Exercises")),
        h(
          "div",
          { class: "form" },
          this.kinds,
          level,
          h(
            "button",
            {
              class: "key",
              "data-act": "fresh",
              onclick: () => {
                this.seed += 1;
                void this.fresh();
              },
            },
            t("A fresh task"),
          ),
        ),
        this.place,
      ),
    );
    if (this.kinds.options.length) void this.fillKinds().then(() => this.fresh());
  }

  private async fillKinds(): Promise<void> {
    if (!this.task) renew(this.place, moment());
    const kinds = await this.page.ask<{ kind: string; name: string }[]>("exercise_kinds", {});
    renew(
      this.kinds,
      ...kinds.map(({ kind, name }) => h("option", { value: kind, selected: kind === this.kind }, name)),
    );
  }

  private async fresh(): Promise<void> {
    try {
      this.task = await this.page.ask<Task>("exercise", { kind: this.kind, level: this.level, seed: this.seed });
      this.answers = {};
      this.show(null);
    } catch (error) {
      renew(this.place, h("p", { class: "error" }, (error as Error).message));
    }
  }

  private show(marked: Marked | null): void {
    const task = this.task!;
    const words = { right: t("right"), near: t("nearly right"), wrong: t("wrong") };
    const rows = task.asked.map(({ key, name, unit }) => {
      const mark = marked?.marks.find((one) => one.key === key);
      const input = h("input", {
        id: `answer-${key}`,
        value: this.answers[key] ?? "",
        "data-answer": key,
        oninput: () => (this.answers[key] = input.value),
      });
      return h(
        "tr",
        {},
        h("td", {}, h("label", { for: `answer-${key}` }, name)),
        h("td", {}, input, ` ${unit}`),
        h(
          "td",
          {},
          mark ? h("b", { "data-mark": mark.mark }, words[mark.mark]) : null,
          mark?.hint ? h("div", { class: "note" }, mark.hint) : null,
        ),
      );
    });
    renew(
      this.place,
      h("h2", {}, task.name),
      h("p", {}, task.task),
      h(
        "form",
        {
          onsubmit: (event: Event) => {
            event.preventDefault();
            void this.mark();
          },
        },
        h("table", {}, ...rows),
        h("div", { class: "form" }, h("button", { class: "key", "data-act": "mark" }, t("Mark my answers"))),
      ),
      ...(marked
        ? [h("details", {}, h("summary", {}, t("The solution")), h("div", {}, h("pre", {}, marked.solution)))]
        : []),
    );
  }

  private async mark(): Promise<void> {
    try {
      this.show(await this.page.ask<Marked>("mark", { id: this.task!.id, answers: this.answers }));
    } catch (error) {
      this.page.say((error as Error).message);
    }
  }
}
