/** What acts on a linkage, typed by the reader: the speed of its drive, masses, forces and moments, springs, weight. */

import { h, option, renew } from "./dom";
import { bound } from "./factlist";
import { softened } from "./header";
import { namedLinks } from "./labels";
import { number, parsed, t } from "./language";
import type { Linkage } from "./linkage";
import type { End, Spring } from "./model";
import type { Pair } from "./rows";
import { endsOf } from "./springs";
import { lengthUnit } from "./wording";

const MOST = 1e9;
const ANY: Pair = [-MOST, MOST];
const AMOUNT: Pair = [0, MOST];

/** A force on a joint, a point or another place, or a moment, as x, on a link. */
interface Load {
  on: string;
  number: number;
  x: number;
  y: number;
  /** The number of a load of the document that has a law of its own. */
  known?: number | null;
}

/** What acts, as the library knows it. */
export interface Acting {
  /** Of each link, in kilograms. */
  masses: number[];
  gravity: boolean;
  loads: Load[];
  /** Of each load of the document by which law it changes. */
  laws: string[];
  /** Places that are neither joints nor points, as they are chosen, and what they are called. */
  places: [string, string][];
  springs: Spring[];
  /** In rad/s or lengths a second; the usual one if there is none. */
  speed: number | null;
  /** What the speed is called, in which unit it is shown, and how much that is. */
  rate: [string, string, number];
}

/** A part of it in place of what is in the document; with bars of steel the masses follow the lengths. */
export type Change = Partial<Acting> & { bars?: "steel" };

export class LoadForm {
  readonly element = h("div", {});
  /** At which speed of the drive the forces are. */
  readonly rate = h("div.rows", {});
  /** What the reader changed, until the document has it. */
  change: Change = {};
  #acting!: Acting;

  constructor(private readonly changed: () => void) {}

  put(more: Change): void {
    this.change = { ...this.change, ...more };
    this.#acting = { ...this.#acting, ...more };
    this.changed();
  }

  /** None while the library has not said what acts. */
  get springs(): readonly Spring[] | null {
    return this.element.firstChild && this.#acting.springs;
  }

  show(linkage: Linkage, acting: Acting): void {
    this.#acting = acting;
    const { model, sizes } = linkage;
    const { gravity, laws, loads, masses, places, rate, speed } = acting;
    const links = namedLinks(linkage);
    const [called, its, factor] = rate;
    renew(
      this.rate,
      ...this.row("speed", called, its, speed! / factor, (v) => this.put({ speed: v * factor || null }), AMOUNT),
    );
    const rows: HTMLElement[] = [h("p.note", {}, t("Masses"))];
    for (const link of links) {
      const name = linkage.linkName(link);
      const put = (mass: number) => this.put({ masses: replaced(this.#acting.masses, link, mass) });
      const row = this.row(`mass-${link}`, name, "kg", masses[link]!, put, AMOUNT);
      row[1]!.ariaLabel = t("Mass {link}", { link: name }); // read without the heading
      rows.push(...row);
    }
    const all: [string, string][] = [
      ["", t("none")],
      ...sizes.points.map(({ name }, k): [string, string] => [`point ${k}`, linkage.pointName(name)]),
      ...model.joints.map(({ name }, k): [string, string] => [`joint ${k}`, linkage.jointName(name)]),
      ...links.map((link): [string, string] => [`link ${link}`, linkage.linkName(link)]),
      ...places,
    ];
    const placeOf = (load?: Load | null) => (load ? `${load.on} ${load.number}` : "");
    const taken = loads.map(placeOf);
    // one row for each, and an empty one
    for (const [k, load] of [...loads, null].entries()) {
      const chosen = placeOf(load);
      const free = all.filter(([one]) => one === chosen || !taken.includes(one));
      const put = (more: Partial<Load> | null) => {
        const next = { ...this.#acting.loads[k], ...more } as Load;
        this.put({ loads: replaced(this.#acting.loads, k, more && next) });
      };
      rows.push(
        ...chooser(`force-load-${k}`, t("Load on"), free, chosen, (place) => {
          const [on, which] = free[place]![0].split(" ");
          put(on ? { on, number: +which! } : null);
          this.show(linkage, this.#acting);
        }),
      );
      const part = (key: "x" | "y", label: string, unit: string) =>
        rows.push(...this.row(`${key}-${k}`, label, unit, load![key], (v) => put({ [key]: v })));
      if (typeof load?.known === "number") rows.push(h("p.note", {}, laws[load.known]));
      else if (load?.on === "link") part("x", t("Moment"), "N·m");
      else if (load) {
        part("x", "Fx", "N");
        part("y", "Fy", "N");
      }
    }
    rows.push(...this.#springRows(linkage));
    const weight = option(t("Weight, downward"), gravity, (on) => this.put({ gravity: on }));
    renew(this.element, h("div.rows", {}, ...rows), h("div.form", {}, weight));
  }

  /** For each spring its kind, its ends and its rates, and a row for another one. */
  #springRows(linkage: Linkage): HTMLElement[] {
    const { model } = linkage;
    const unit = lengthUnit(model);
    const places = endsOf(linkage);
    const links = [...Array(model.own).keys()];
    const rows: HTMLElement[] = [];
    const select = (...asked: Parameters<typeof chooser>) => rows.push(...chooser(...asked));
    /** With the end that is chosen, if it is neither joint nor point. */
    const ended = (options: [End, string, string?][], [link, x, y]: End) =>
      options.some(([end]) => `${end}` === `${[link, x, y]}`)
        ? options
        : [...options, [[link, x, y], `${linkage.linkName(link)}: ${number(x)}; ${number(y)}`] as [End, string]];
    for (const [k, spring] of [...this.#acting.springs, null].entries()) {
      const put = (more: Partial<Spring> | null) => {
        const next = { ...this.#acting.springs[k]!, ...more };
        this.put({ springs: replaced(this.#acting.springs, k, more && next) });
      };
      const again = (more: Partial<Spring> | null) => {
        put(more);
        this.show(linkage, this.#acting);
      };
      const kinds: [unknown, string][] = [
        ["", t("none")],
        [false, t("straight")],
        [true, t("torsion")],
      ];
      select(`spring-${k}`, t("Spring, damper"), kinds, spring ? spring.turning : "", (kind) => {
        const turning = kind === 2;
        // no two joints of one link, which stay as far apart as they are
        const linksOf = (name: string) => model.joints.find((one) => one.name === name)?.links ?? [];
        const near = linksOf(places[0]![2]);
        const away = places.find(([, , name]) => !linksOf(name).some((link) => near.includes(link))) ?? places[0]!;
        const ends: Spring["ends"] = turning
          ? [
              [model.frame, 0, 0],
              [+!model.frame, 0, 0],
            ]
          : [places[0]![0], away[0]];
        again(kind ? { turning, ends } : null); // the library adds what it has not
      });
      if (!spring) break;
      const { ends, turning } = spring;
      const options: [End, string, string?][] = turning
        ? links.map((link) => [[link, 0, 0], linkage.linkName(link)])
        : places;
      for (const side of [0, 1] as const)
        select(`spring-${k}-${side}`, side ? t("to") : t("from"), ended(options, ends[side]), ends[side], (which) => {
          const other = [...ends] as Spring["ends"];
          other[side] = options[which]?.[0] ?? ends[side];
          again({ ends: other });
        });
      const force = turning ? "N·m" : "N";
      const [by, factor] = turning ? ["rad", Math.PI / 180] : [unit, 1];
      const part = (key: "stiffness" | "free" | "preload" | "damping", label: string, its: string, scale = 1) =>
        rows.push(
          ...this.row(`${key}-${k}`, label, its, spring[key] / scale, (value) => put({ [key]: value * scale })),
        );
      part("stiffness", t("Stiffness"), `${force}/${by}`);
      part("free", turning ? t("Free angle") : t("Free length"), turning ? "°" : unit, factor);
      part("preload", t("Preload"), force);
      part("damping", t("Damping"), `${force}·s/${by}`);
    }
    return rows;
  }

  /** A field with its label and unit, and what it expects if something else is typed; the one in which the reader types
   * stays as it is. */
  row(
    key: string,
    label: string,
    unit: string,
    value: number,
    take: (value: number) => void,
    [least, most]: Pair = ANY,
  ): HTMLElement[] {
    const id = `force-${key}`;
    const onchange = () => {
      const typed = parsed(field.value || "0");
      const right = typed >= least && typed <= most;
      field.setAttribute("aria-invalid", `${!right}`);
      const ends = { least: endText(least), most: endText(most) };
      if (unitText.nextElementSibling?.matches(".error")) unitText.nextElementSibling.remove();
      if (right) take(typed);
      else unitText.after(h("p.note.error", { role: "alert" }, t("Expected a number from {least} to {most}.", ends)));
    };
    const onkeydown = (event: KeyboardEvent) => event.stopPropagation();
    const shown = value ? number(value) : "";
    const made = h("input", { id, value: shown, inputmode: "decimal", onchange, onkeydown });
    const old = this.element.querySelector<HTMLInputElement>(":focus");
    const field = old?.id === id ? old : made;
    const unitText = h("span.unit", {}, unit);
    return [h("label", { for: id }, bound(softened(label))), field, unitText];
  }
}

function endText(value: number): string {
  return Math.abs(value) < MOST ? number(value) : `${value < 0 ? "−" : ""}10⁹`;
}

/** A list with another item in place of one, or without it. */
function replaced<Item>(list: readonly Item[], k: number, item: Item | null): Item[] {
  return [...list.slice(0, k), ...(item === null ? [] : [item]), ...list.slice(k + 1)];
}

/** One of several, by its place among them, with what it is for. */
function chooser(
  id: string,
  label: string,
  options: [unknown, string, string?][],
  chosen: unknown,
  take: (place: number) => void,
): HTMLElement[] {
  const field = h(
    "select",
    { id, onchange: () => take(field.selectedIndex) },
    ...options.map(([value, text]) =>
      h("option", { value: value as string, selected: `${value}` === `${chosen}` }, text),
    ),
  );
  return [h("label", { for: id }, label), field];
}
