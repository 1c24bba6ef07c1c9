/** What acts on a linkage, typed by the reader: the speed of its drive, masses, a force or moment, weight. */

import { h, option, renew } from "./dom";
import { number, parsed, t } from "./language";
import type { Linkage } from "./linkage";
import { type End, endsOf, type Spring } from "./springs";
import { lengthUnit, momentUnit } from "./wording";

/** A turn a minute, in rad/s. */
const RPM = Math.PI / 30;
const MOST = 1e9;

/** A force on a joint or a point, or a moment, as x, on a link. */
interface Load {
  on: string;
  number: number;
  x: number;
  y: number;
}

export class LoadForm {
  readonly element = h("div", {});
  /** At which speed of the drive the forces are. */
  readonly rate = h("div.rows", {});
  /** Whether the links are taken as bars of steel. */
  steel = false;
  /** Of each link, in kilograms; as the library knows them where there is none. */
  masses: number[] = [];
  /** In rad/s or lengths a second; the usual one if there is none. */
  speed: number | null = null;
  /** As the library knows them. */
  shown: readonly Spring[] = [];
  #springs: Spring[] | null = null;
  #weight = true;
  #loads: Load[] = [];

  constructor(private readonly changed: () => void) {}

  /** Nothing is typed yet. */
  clear(): void {
    [this.masses, this.#loads, this.shown] = [[], [], []];
    this.steel = false;
    this.speed = this.#springs = null;
    renew(this.element);
  }

  /** As the library is told of it. */
  get record(): Record<string, unknown> {
    return {
      steel: this.steel,
      masses: this.masses,
      gravity: this.#weight,
      loads: this.#loads,
      springs: this.#springs,
    };
  }

  show(linkage: Linkage, masses: number[], speed: number, springs: readonly Spring[], besides: string): void {
    this.shown = springs;
    const { drive, model, sizes } = linkage;
    const links = [...Array(model.own).keys()].filter((link) => link !== model.frame);
    const factor = drive?.turning ? RPM : 1;
    renew(
      this.rate,
      ...this.#row(
        "speed",
        drive?.turning ? t("Forces at drive speed") : t("Speed of the driven slide"),
        drive?.turning ? "1/min" : `${lengthUnit(model)}/s`,
        speed / factor,
        (v) => {
          this.speed = v > 0 ? v * factor : null;
        },
      ),
    );
    const rows: HTMLElement[] = [];
    for (const link of links)
      rows.push(
        ...this.#row(`mass-${link}`, t("Mass {link}", { link: linkage.linkName(link) }), "kg", masses[link]!, (v) => {
          this.masses = masses.map((mass, k) => (k === link ? Math.max(0, v) : mass));
          this.steel = false;
        }),
      );
    const places: [string, string][] = [
      ["", t("none")],
      ...sizes.points.map(({ name }, k): [string, string] => [`point ${k}`, linkage.pointName(name)]),
      ...model.joints.map(({ name }, k): [string, string] => [`joint ${k}`, linkage.jointName(name)]),
      ...links.map((link): [string, string] => [`link ${link}`, linkage.linkName(link)]),
    ];
    // one row for each, and an empty one
    for (const [k, load] of [...this.#loads, null].entries()) {
      const chosen = load ? `${load.on} ${load.number}` : "";
      rows.push(
        ...chooser(`force-load-${k}`, t("Load on"), places, chosen, (place) => {
          const [on, which] = places[place]![0].split(" ");
          this.#loads.splice(k, 1, ...(on ? [{ x: 0, y: 0, ...load, on, number: Number(which) }] : []));
          this.changed();
          this.show(linkage, masses, speed, springs, besides);
        }),
      );
      const part = (key: "x" | "y", label: string, unit: string) =>
        rows.push(...this.#row(`${key}-${k}`, label, unit, load![key], (v) => (load![key] = v)));
      if (load?.on === "link") part("x", t("Moment"), momentUnit(model));
      else if (load) {
        part("x", "Fx", "N");
        part("y", "Fy", "N");
      }
    }
    rows.push(...this.#springRows(linkage, springs, (own) => this.show(linkage, masses, speed, own, besides)));
    const weight = option(t("Weight, downward"), this.#weight, (on) => {
      this.#weight = on;
      this.changed();
    });
    renew(this.element, h("p.note", {}, besides), h("div.rows", {}, ...rows), h("div.form", {}, weight));
  }

  /** For each spring its kind, its ends and its rates, and a row for another one. */
  #springRows(linkage: Linkage, springs: readonly Spring[], again: (own: Spring[]) => void): HTMLElement[] {
    const unit = lengthUnit(linkage.model);
    const places = endsOf(linkage);
    const links = [...linkage.model.links.slice(0, linkage.model.own).keys()];
    const rows: HTMLElement[] = [];
    const select = (...asked: Parameters<typeof chooser>) => rows.push(...chooser(...asked));
    /** With the end that is chosen, if it is neither joint nor point. */
    const ended = (options: [End, string, string?][], [link, x, y]: End) =>
      options.some(([end]) => String(end) === String([link, x, y]))
        ? options
        : [...options, [[link, x, y], `${linkage.linkName(link)}: ${number(x)}; ${number(y)}`] as [End, string]];
    for (const [k, spring] of [...springs, null].entries()) {
      const put = (more: Partial<Spring> | null) => {
        const next = { ...spring!, ...more };
        this.#springs = [...springs.slice(0, k), ...(more ? [next] : []), ...springs.slice(k + 1)];
        this.changed();
        again(this.#springs);
      };
      const kinds: [unknown, string][] = [
        ["", t("none")],
        [false, t("straight")],
        [true, t("torsion")],
      ];
      select(`spring-${k}`, t("Spring, damper"), kinds, spring ? spring.turning : "", (kind) => {
        const turning = kind === 2;
        // no two joints of one link, which stay as far apart as they are
        const linksOf = (name: string) => linkage.model.joints.find((one) => one.name === name)?.links ?? [];
        const near = linksOf(places[0]![2]);
        const away = places.find(([, , name]) => !linksOf(name).some((link) => near.includes(link))) ?? places[0]!;
        const ends: Spring["ends"] = turning
          ? [
              [linkage.model.frame, 0, 0],
              [links.find((link) => link !== linkage.model.frame)!, 0, 0],
            ]
          : [places[0]![0], away[0]];
        put(kind ? { stiffness: 0, free: 0, preload: 0, damping: 0, known: null, turning, ends } : null);
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
          put({ ends: other });
        });
      const force = turning ? momentUnit(linkage.model) : "N";
      const [by, factor] = turning ? ["rad", Math.PI / 180] : [unit, 1];
      const part = (key: "stiffness" | "free" | "preload" | "damping", label: string, its: string, scale = 1) =>
        rows.push(
          ...this.#row(`${key}-${k}`, label, its, spring[key] / scale, (value) => put({ [key]: value * scale })),
        );
      part("stiffness", t("Stiffness"), `${force}/${by}`);
      part("free", turning ? t("Free angle") : t("Free length"), turning ? "°" : unit, factor);
      part("preload", t("Preload"), force);
      part("damping", t("Damping"), `${force}·s/${by}`);
    }
    return rows;
  }

  #row(key: string, label: string, unit: string, value: number, take: (value: number) => void): HTMLElement[] {
    const id = `force-${key}`;
    const onchange = () => {
      const typed = parsed(field.value || "0");
      const right = Math.abs(typed) <= MOST;
      field.setAttribute("aria-invalid", String(!right));
      if (!right) return;
      take(typed);
      this.changed();
    };
    const onkeydown = (event: KeyboardEvent) => event.stopPropagation();
    const field = h("input", { id, value: value ? number(value) : "", inputmode: "decimal", onchange, onkeydown });
    return [h("label", { for: id }, label), field, h("span.unit", {}, unit)];
  }
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
      h("option", { value: value as string, selected: String(value) === String(chosen) }, text),
    ),
  );
  return [h("label", { for: id }, label), field];
}
