/** Exercises: a fresh task with its figure, answers marked with hints, its linkage to try, the solution, the score. */

import { choice, h, indexed, menu, picture, renew, unbroken } from "./dom";
import { t } from "./language";
import type { Model } from "./model";
import type { Page, View } from "./view";
import { drawn, moment } from "./waiting";

interface Asked {
  key: string;
  name: string;
  symbol: string;
  unit: string;
  choices: string[];
}

interface Task {
  id: string;
  name: string;
  task: string;
  remark: string;
  /** Pictures of what can be tried, each with a name where there are several. */
  figures: { name: string; picture: string }[];
  /** What the buttons say that open what can be tried, and what stands before several; tasks in space have none. */
  trial: string;
  tries: string[];
  asked: Asked[];
}

/** A kind of fresh tasks, or the exercises of the text. */
interface Kind {
  kind: string;
  name: string;
  tasks: { id: string; name: string }[];
}

interface Mark {
  key: string;
  mark: "right" | "near" | "wrong" | "missing";
  hint: string;
}

/** A part of a solution: a heading, a step with its formula, a table under its title, or a sentence. */
interface Part {
  text: string;
  formula: string;
  heading: boolean;
  rows: string[][];
}

interface Marked {
  marks: Mark[];
  solution: Part[];
}

const PHONE = 340; // pixels

/** A formula whose quantities are slanted, with their indices: s1 and l_a; units behind numbers are upright. It breaks
 * before operators. */
function formula(text: string): (string | Node)[] {
  return unbroken(text, / (?![=+−<≤±] )(?<!\p{L}{4} )|(?<=\([^()\s]+) (?=[+−])/gu)
    .split(/(?<!(?!Δ)\p{L}|\d\s(?:\w+\/)?(?=[msh]²?(?![\w·])))(\p{L}(?:_[\p{L}\d]+|\d+|(?!\()))(?!\p{L})/u)
    .map((part, k) => (k % 2 ? h("i", {}, part[0], h("sub", {}, part.replace(/._?/, ""))) : part));
}

function partOf({ text, formula: line, heading, rows }: Part): HTMLElement {
  if (heading) return h("h3", {}, text);
  const [head, ...body] = rows;
  // columns of numbers are flush right
  const cells = (tag: "th" | "td", row: string[]) =>
    h(
      "tr",
      {},
      ...row.map((cell, k) =>
        h(tag, { class: /^−?\d/.test(body[0]![k]!) && "value" }, ...(k && /=/.test(cell) ? formula : indexed)(cell)),
      ),
    );
  return h(
    "div",
    {},
    h("p", {}, ...indexed(text)),
    line && h("p.formula", {}, ...formula(line)),
    head && h("table", {}, cells("th", head), ...body.map((row) => cells("td", row))),
  );
}

/** A figure that tells how wide it is, in screens of a phone: there its letters are larger by as much. */
function legible(figure: SVGSVGElement): SVGSVGElement {
  figure.style.setProperty("--own", `${13 * Math.max(1, figure.viewBox.baseVal.width / PHONE)}px`);
  return figure;
}

interface Tried {
  model?: Model;
  text?: string;
  drive?: number | null;
}

export class ExercisesView implements View {
  readonly element = h("div.view", { "data-page": "exercises" });
  private kind = "mobility";
  #listed: Kind[] = [];
  #chosen = "exercise-1";
  private level = 1;
  private seed = 1 + Math.floor(Math.random() * 9999);
  private task: Task | null = null;
  /** The id of the task that was asked for last. */
  #wanted = "";
  #marked: Marked | null = null;
  readonly #place = h("div", {});
  readonly #kinds = h("div", {});
  readonly #tasks = h("div", {});
  readonly #score = h("span.note", { role: "status" });
  readonly #verdict = h("b", { role: "status", "data-result": "" });
  #answers: Record<string, string> = {};
  /** The tasks that were marked, and whether all their answers were right. */
  private readonly record = new Map<string, boolean>();
  readonly #page: Page;

  constructor(page: Page) {
    this.#page = page;
  }

  appeared(): void {
    if (!this.task) void this.#fillKinds();
  }

  arrange(): void {
    renew(
      this.element,
      h(
        "div.page",
        {},
        h("div.form", {}, h("h2", {}, t("Exercises")), this.#score),
        this.#kinds,
        this.#tasks,
        this.#place,
      ),
    );
    this.#showScore();
    if (this.task) void this.#fillKinds();
  }

  async #fillKinds(): Promise<void> {
    if (!this.task) renew(this.#kinds, moment());
    this.#listed = await this.#page.ask<Kind[]>("exercise_kinds", {});
    const named = ({ kind, name }: Kind): [string, string] => [kind, name];
    const choose = (kind: string) => {
      this.kind = kind;
      void this.fresh();
    };
    const kinds = choice(t("Topic"), this.#listed.map(named), this.kind, choose, { class: "choice palette" });
    kinds.prepend(h("span", {}, t("Topic")));
    renew(this.#kinds, kinds);
    return this.fresh();
  }

  /** The exercises of the text; none for a kind of fresh tasks. */
  #numbered(): Kind["tasks"] {
    return this.#listed.find(({ kind }) => kind === this.kind)?.tasks ?? [];
  }

  #next(): void {
    const tasks = this.#numbered();
    this.seed += 1;
    this.#chosen = tasks[(tasks.findIndex(({ id }) => id === this.#chosen) + 1) % tasks.length]?.id ?? this.#chosen;
    void this.fresh();
  }

  /** Between which tasks of a kind one chooses: levels, or exercises of the text. */
  #showTasks(): void {
    const tasks = this.#numbered();
    if (tasks.length) {
      const named = ({ id, name }: { id: string; name: string }): [string, string] => [id, name];
      const list = menu(t("Exercises"), tasks.map(named), this.#chosen, (id) => {
        this.#chosen = id;
        void this.fresh();
      });
      return renew(this.#tasks, list);
    }
    const levels: [string, string][] = [..."123"].map((k) => [k, k]);
    const level = choice(t("Level"), levels, `${this.level}`, (value) => {
      this.level = Number(value);
      void this.fresh();
    });
    level.prepend(t("Level"));
    renew(this.#tasks, level);
  }

  /** The task that is chosen, from what stands above its heading on; of the one that is shown the answers stay. */
  private async fresh(): Promise<void> {
    this.#showTasks();
    const id = this.#numbered().length ? this.#chosen : `${this.kind}-${this.level}-${this.seed}`;
    this.#wanted = id;
    this.#wait(true);
    try {
      const task = await this.#page.ask<Task>("exercise", { id });
      if (id !== this.#wanted) return;
      if (task.id !== this.task?.id) this.#answers = {};
      this.task = task;
      this.#marked = null;
      this.#show();
      this.#tasks.scrollIntoView({ block: "nearest" });
    } catch (error) {
      renew(this.#place, h("p.error", {}, (error as Error).message));
    }
    this.#wait(false);
  }

  /** Another task is on its way: the one before is faded. */
  #wait(busy: boolean): void {
    this.#place.setAttribute("aria-busy", String(busy));
    this.#place.classList.toggle("faded", busy);
  }

  #show(): void {
    const marked = this.#marked;
    const task = this.task!;
    const solved = this.record.get(task.id);
    this.#verdict.textContent = "";
    const act = (name: string, text: string, key?: boolean, onclick?: () => void) =>
      h("button", { class: key ? "key" : "plain", "data-act": name, type: onclick && "button", onclick }, text);
    renew(
      this.#place,
      h(
        "div.task",
        {},
        h(
          "div",
          {},
          h("h2", {}, task.name),
          h("p", {}, ...indexed(task.task)),
          task.remark && h("p.note", {}, ...indexed(task.remark)),
        ),
        h(
          "div",
          { class: task.figures.length === 2 && "pair" }, // one below the other
          ...task.figures.map(({ name, picture: figure }) =>
            h(
              "figure.chain-picture",
              {},
              legible(picture(figure, name || t("The figure of the task")) as SVGSVGElement),
              name && h("figcaption", {}, unbroken(name)),
            ),
          ),
        ),
        h(
          "form",
          {
            onsubmit: (event: Event) => {
              event.preventDefault();
              void this.#mark();
            },
          },
          ...task.asked.map((one) => this.#row(one)),
          h(
            "div.form.go",
            {},
            act("mark", t("Mark my answers"), !solved),
            act("next", t("Next task"), solved, () => this.#next()),
            this.#verdict,
          ),
          marked &&
            h(
              "div.form",
              {},
              task.trial,
              ...task.tries.map((text, k) => act("try", text, false, () => void this.#tryIt(k))),
            ),
          marked &&
            h("details.words.solution", {}, h("summary", {}, t("The solution")), ...marked.solution.map(partOf)),
        ),
      ),
    );
  }

  /** What is asked, with a field or a choice, and its mark. */
  #row({ key, name, symbol, unit, choices }: Asked): HTMLElement {
    const mark: Omit<Mark, "key"> | null =
      this.#marked && (this.#marked.marks.find((one) => one.key === key) ?? { mark: "missing", hint: "" });
    const given = this.#answers[key] ?? "";
    const set = (value: string) => (this.#answers[key] = value);
    const [id, hint] = [`answer-${key}`, `hint-${key}`];
    const words = {
      right: `✓ ${t("right")}`,
      near: `≈ ${t("nearly right")}`,
      wrong: `✗ ${!choices.length && !/\d/.test(given) ? t("not a number") : t("wrong")}`,
      missing: t("missing"),
    };
    const input = h("input", {
      id,
      value: given,
      size: 10,
      autocomplete: "off",
      "data-answer": key,
      "aria-invalid": mark?.mark === "wrong" && "true",
      "aria-describedby": mark?.hint && hint,
      oninput: () => set(input.value),
    });
    const field = choices.length
      ? choice(
          name,
          choices.map((one) => [one, one]),
          given,
          set,
          { "data-answer": key },
        )
      : h("span", {}, symbol && h("span.symbol", {}, ...formula(symbol), " ="), input, `\u00a0${unit}`);
    return h(
      "div.answer",
      { "data-mark": mark?.mark },
      h(choices.length ? "span" : "label", { for: !choices.length && id }, ...indexed(name)),
      field,
      mark && h("b", {}, words[mark.mark]),
      mark?.hint && h("div", { id: hint }, ...indexed(mark.hint)),
    );
  }

  async #mark(): Promise<void> {
    const task = this.task!;
    if (!Object.values(this.#answers).join("").trim()) {
      this.#verdict.textContent = t("Give at least one answer.");
      return;
    }
    try {
      this.#marked = await this.#page.ask<Marked>("mark", { id: task.id, answers: this.#answers });
    } catch (error) {
      return this.#page.say((error as Error).message);
    }
    this.#page.say("");
    const count = task.asked.length;
    const right = this.#marked.marks.filter(({ mark }) => mark === "right").length;
    this.record.set(task.id, right === count);
    this.#show();
    this.#showScore();
    await drawn(); // what comes with its place is not read out
    if (task !== this.task) return;
    this.#verdict.className = right === count ? "good" : "bad";
    // what is wrong in sight with what can be chosen there, first of all the first of it
    const hints = this.#place.querySelectorAll(".answer > [id]");
    for (const hint of [...hints].reverse()) hint.parentElement!.scrollIntoView({ block: "nearest" });
    this.#verdict.textContent = t("{right} of {count} right", { right, count });
  }

  #showScore(): void {
    const tasks = this.record.size;
    const solved = [...this.record.values()].filter(Boolean).length;
    if (tasks) this.#score.textContent = t("{solved} of {tasks} solved", { solved, tasks });
  }

  async #tryIt(part: number): Promise<void> {
    await this.#page.choose(this.#page.ask<Tried>("try", { id: this.task!.id, part }), ({ model, text, drive }) => {
      if (model) this.#page.open(model, drive ?? undefined);
      else this.#page.describe(text!);
    });
  }
}
