/** The view of the synthesis: points that a coupler point is to pass, clicked into a plane; four-bars that do it. */

import { h, renew, svg, thumbnail } from "./dom";
import { angle, number, parsed, t } from "./language";
import type { LinkageDocument, Model } from "./model";
import type { Page, View } from "./view";
import { awaited } from "./waiting";

interface Item {
  document: LinkageDocument;
  picture: string;
  form: string;
  transmission: number | null;
  error: number | null;
}

interface Designs {
  total: number;
  refused: number;
  items: Item[];
}

const WIDE = 240;
const HIGH = 150; // the plane, in units of length
const FEWEST = 5; // fewer points leave infinitely many four-bars
const STEP = 10; // between lines of its grid

export class SynthesisView implements View {
  readonly element = h("div", { class: "view", "data-page": "synthesis" });
  points: [number, number][] = [];
  private closed = false;
  private crank = true;
  private least = 20; // degrees
  private designs: Designs | null = null;
  private moving = -1;
  private readonly plane = svg("svg", {
    class: "plane",
    viewBox: `${-WIDE / 2} ${-HIGH / 2} ${WIDE} ${HIGH}`,
    role: "application",
    tabindex: 0,
  });
  private readonly list = h("div", {});
  private readonly found = h("div", {});
  private readonly status = h("div", { class: "form" });

  constructor(private readonly page: Page) {
    this.plane.addEventListener("pointerdown", (event) => this.down(event));
    this.plane.addEventListener("pointermove", (event) => this.moving >= 0 && this.put(this.moving, this.at(event)));
    this.plane.addEventListener("pointerup", () => (this.moving = -1));
    this.plane.addEventListener("pointercancel", () => (this.moving = -1));
  }

  /** Other points, out of a file. */
  take(points: [number, number][], closed: boolean): void {
    this.points = points;
    this.closed = closed;
    this.designs = null;
    this.arrange();
  }

  arrange(): void {
    const option = (text: string, checked: boolean, set: (on: boolean) => void, key: string) => {
      const box = h("input", { type: "checkbox", checked, "data-field": key, onchange: () => set(box.checked) });
      return h("label", {}, box, text);
    };
    const least = h("input", {
      type: "number",
      min: 0,
      max: 90,
      value: this.least,
      "data-field": "least",
      onchange: () => (this.least = Number(least.value)),
    });
    this.plane.setAttribute("aria-label", t("Points that are to be passed"));
    renew(
      this.element,
      h(
        "div",
        { class: "page" },
        h("h2", {}, t("A four-bar through points")),
        h(
          "p",
          { class: "note" },
          t(
            "Click points in the order in which a coupler point is to pass them; drag them to move them. " +
              "Five to nine points are met exactly where that is possible, more as closely as possible.",
          ),
        ),
        h(
          "div",
          { class: "two" },
          h("div", { class: "chain-picture" }, this.plane),
          h(
            "div",
            {},
            this.list,
            h(
              "div",
              { class: "form" },
              option(
                t("closed curve"),
                this.closed,
                (on) => {
                  this.closed = on;
                  this.draw();
                },
                "closed",
              ),
              option(t("the crank turns fully"), this.crank, (on) => (this.crank = on), "crank"),
              h("label", {}, t("transmission angle from"), least, "°"),
            ),
            h(
              "div",
              { class: "form" },
              h(
                "button",
                { class: "key", "data-act": "synthesise", onclick: () => void this.search() },
                t("Find four-bars"),
              ),
              h("button", { class: "plain", "data-act": "clear", onclick: () => this.clear() }, t("Remove all points")),
            ),
            this.status,
          ),
        ),
        this.found,
      ),
    );
    this.draw();
    this.showDesigns();
  }

  private at(event: PointerEvent): [number, number] {
    const box = this.plane.getScreenCTM()!.inverse();
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(box);
    const round = (value: number) => Math.round(value * 10) / 10;
    return [round(point.x), round(-point.y)];
  }

  private down(event: PointerEvent): void {
    const [x, y] = this.at(event);
    this.plane.setPointerCapture(event.pointerId);
    const near = this.points.findIndex(([u, v]) => Math.hypot(u - x, v - y) < 4);
    if (near >= 0) this.moving = near;
    else {
      this.points.push([x, y]);
      this.moving = this.points.length - 1;
      this.draw();
    }
  }

  private put(k: number, [x, y]: [number, number]): void {
    this.points[k] = [x, y];
    this.draw();
  }

  private clear(): void {
    this.points = [];
    this.designs = null;
    this.draw();
    this.showDesigns();
  }

  private draw(): void {
    const lines: SVGElement[] = [];
    for (let x = -WIDE / 2; x <= WIDE / 2; x += STEP)
      lines.push(svg("path", { class: x === 0 ? "axis" : "mesh", d: `M${x} ${-HIGH / 2}V${HIGH / 2}` }));
    for (let y = -HIGH / 2 + 5; y <= HIGH / 2; y += STEP)
      lines.push(svg("path", { class: y === 0 ? "axis" : "mesh", d: `M${-WIDE / 2} ${y}H${WIDE / 2}` }));
    const d =
      this.points.map(([x, y], k) => `${k ? "L" : "M"}${x} ${-y}`).join("") +
      (this.closed && this.points.length > 2 ? "Z" : "");
    const marks = this.points.map(([x, y], k) =>
      svg(
        "g",
        { "data-point": String(k), transform: `translate(${x} ${-y})` },
        svg("circle", { r: 2.6 }),
        svg("text", { x: 3.4, y: -3.4 }, String(k + 1)),
      ),
    );
    renew(this.plane, ...lines, svg("path", { class: "polygon", d }), ...marks);
    const cell = (k: number, axis: 0 | 1) => {
      const input = h("input", {
        value: number(this.points[k]![axis], 6),
        inputmode: "decimal",
        "aria-label": `${t("Point {number}", { number: k + 1 })} ${axis ? "y" : "x"}`,
        onchange: () => {
          const value = parsed(input.value);
          input.setAttribute("aria-invalid", String(!Number.isFinite(value)));
          if (Number.isFinite(value)) this.put(k, axis ? [this.points[k]![0], value] : [value, this.points[k]![1]]);
        },
      });
      return h("td", {}, input);
    };
    renew(
      this.list,
      this.points.length
        ? h(
            "div",
            { class: "points" },
            h(
              "table",
              {},
              h("tr", {}, h("th", {}, t("Point")), h("th", {}, "x"), h("th", {}, "y"), h("th", {}, "")),
              ...this.points.map((_, k) =>
                h(
                  "tr",
                  {},
                  h("td", {}, String(k + 1)),
                  cell(k, 0),
                  cell(k, 1),
                  h(
                    "td",
                    {},
                    h(
                      "button",
                      {
                        class: "quiet",
                        "aria-label": t("Remove {name}", { name: t("Point {number}", { number: k + 1 }) }),
                        onclick: () => {
                          this.points.splice(k, 1);
                          this.draw();
                        },
                      },
                      "×",
                    ),
                  ),
                ),
              ),
            ),
          )
        : h("p", { class: "note" }, t("No points yet.")),
    );
  }

  private async search(): Promise<void> {
    if (this.points.length < FEWEST)
      return renew(
        this.status,
        h("span", { class: "error", role: "alert" }, t("Give at least {count} points.", { count: FEWEST })),
      );
    const question = { points: this.points, closed: this.closed, crank: this.crank, transmission: this.least };
    const found = await awaited(this.status, (progress) => this.page.ask<Designs>("synthesise", question, progress));
    if (!found) return;
    this.designs = found;
    this.showDesigns();
    this.found.scrollIntoView({ block: "nearest", behavior: "smooth" });
  }

  private showDesigns(): void {
    const { designs } = this;
    if (!designs) return renew(this.found);
    renew(
      this.found,
      h("h2", {}, t("{count} designs", { count: designs.total })),
      h(
        "p",
        { class: "note" },
        designs.refused ? t("{count} others do not meet what is asked.", { count: designs.refused }) : "",
      ),
      h(
        "div",
        { class: "cards", "data-list": "designs" },
        ...designs.items.map((item) =>
          h(
            "button",
            {
              class: "card",
              onclick: () => void this.open(item),
            },
            thumbnail(item.picture, item.form),
            h("b", {}, item.form),
            h("span", {}, item.transmission === null ? "" : `μ ≥ ${angle((item.transmission * Math.PI) / 180, 3)}`),
            h(
              "span",
              {},
              item.error === null
                ? ""
                : t("deviation {value} %", { value: number(100 * (Math.abs(item.error) < 1e-9 ? 0 : item.error), 2) }),
            ),
          ),
        ),
      ),
    );
  }

  private async open(item: Item): Promise<void> {
    try {
      this.page.open(
        await this.page.ask<Model>("open_document", {
          document: item.document,
          name: t("A design for {count} points", { count: this.points.length }),
        }),
      );
    } catch (error) {
      this.page.say((error as Error).message);
    }
  }
}
