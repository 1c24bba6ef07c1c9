/** What acts on a linkage, typed by the reader: the speed of its drive, masses, a force or moment, weight. */

import { h, renew } from "./dom";
import { number, parsed, t } from "./language";
import type { Linkage } from "./linkage";

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
  /** Of each link, in kilograms; as the library knows them where there is none. */
  masses: number[] = [];
  /** In rad/s or lengths a second; the usual one if there is none. */
  speed: number | null = null;
  private weight = true;
  private loads: Load[] = [];

  constructor(private readonly changed: () => void) {}

  /** Nothing is typed yet. */
  clear(): void {
    Object.assign(this, { masses: [], speed: null, loads: [] });
    renew(this.element);
  }

  /** As the library is told of it. */
  get record(): Record<string, unknown> {
    const { loads, masses, weight } = this;
    return { masses, gravity: weight, loads };
  }

  show(linkage: Linkage, masses: number[], speed: number): void {
    const { drive, model, sizes } = linkage;
    const links = [...Array(model.own).keys()].filter((link) => link !== model.frame);
    const factor = drive?.turning ? RPM : 1;
    const rows = this.row(
      "speed",
      t("Drive speed"),
      drive?.turning ? "1/min" : `${model.unit}/s`,
      speed / factor,
      (v) => {
        this.speed = v > 0 ? v * factor : null;
      },
    );
    for (const link of links)
      rows.push(
        ...this.row(`mass-${link}`, t("Mass {link}", { link: linkage.linkName(link) }), "kg", masses[link]!, (v) => {
          this.masses = masses.map((mass, k) => (k === link ? Math.max(0, v) : mass));
        }),
      );
    const places = [
      ["", t("none")],
      ...sizes.points.map(({ name }, k) => [`point ${k}`, name]),
      ...model.joints.map(({ name }, k) => [`joint ${k}`, name]),
      ...links.map((link) => [`link ${link}`, linkage.linkName(link)]),
    ];
    // one row for each, and an empty one
    for (const [k, load] of [...this.loads, null].entries()) {
      const chosen = load ? `${load.on} ${load.number}` : "";
      const onchange = () => {
        const [on, which] = where.value.split(" ");
        this.loads.splice(k, 1, ...(on ? [{ x: 0, y: 0, ...load, on, number: Number(which) }] : []));
        this.changed();
        this.show(linkage, masses, speed);
      };
      const options = places.map(([value, text]) => h("option", { value, selected: value === chosen }, text));
      const id = `force-load-${k}`;
      const where = h("select", { id, onchange }, ...options);
      rows.push(h("label", { for: id }, t("Load on")), where, h("span", {}));
      const part = (key: "x" | "y", label: string, unit: string) =>
        rows.push(...this.row(`${key}-${k}`, label, unit, load![key], (v) => (load![key] = v)));
      if (load?.on === "link") part("x", t("Moment"), `N·${model.unit}`);
      else if (load) {
        part("x", "Fx", "N");
        part("y", "Fy", "N");
      }
    }
    const weigh = () => {
      this.weight = weight.checked;
      this.changed();
    };
    const weight = h("input", { type: "checkbox", checked: this.weight, onchange: weigh });
    renew(this.element, h("div.rows", {}, ...rows), h("div.form", {}, h("label", {}, weight, t("Weight, downward"))));
  }

  private row(key: string, label: string, unit: string, value: number, take: (value: number) => void): HTMLElement[] {
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
