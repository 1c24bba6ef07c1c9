/** A chain as the library describes it: its picture, whose joints are buttons, and the types that a joint may have. */

import { h, picture, svg } from "./dom";
import { t } from "./language";

/** A mechanism of the chain. */
export interface Choice {
  text: string;
  frame: string;
  drives: string[];
  /** The same with the numbers of the links in the picture, where it has these instead of names. */
  brief: string[];
  family: string;
  picture: string;
}

export interface Structure {
  text: string;
  /** The text in the letters of the language, where they are others. */
  read?: string;
  /** The same for all chains of one structure. */
  code: string;
  /** How many links it has. */
  size: number;
  /** That of the chain in the literature, if it has one and the library says it. */
  name?: string;
  /** How many joints its links have, and where it falls apart. */
  kinds: string;
  /** The frame of the list that is like the one of the text, or like the one it is given. */
  chosen: string;
  /** The text of the driven mechanism of the list that is; empty if none is. */
  driver: string;
  picture: string;
  /** The names of the links by their numbers, where these stand in the picture. */
  numbered: Record<string, string>;
  joints: {
    name: string;
    at: [number, number];
    types: { symbol: string; name: string; text: string; chosen: boolean }[];
  }[];
  links: {
    name: string;
    outline: [number, number][];
    overconstrained: boolean;
    rigid: boolean;
  }[];
  frame: string;
  counted: number;
  generic: number;
  /** That of the linkage at hand, if its sizes give another one. */
  own?: number | null;
  verdict: string;
  lines: string[];
  drives: string;
  /** Whether drives that are not at the frame are listed since those at it fix nothing; unsaid if it is no choice. */
  anywhere?: boolean;
  inversions: Choice[];
  driven: Choice[];
}

/** Whether it is a chain of the plane; the text of another one begins with its space. */
export function inPlane({ text }: Structure): boolean {
  return !/^sp\w+:/.test(text);
}

/** The picture of the chain with its strained links; a click on a joint picks it. */
export function chainPicture(found: Structure, joint: number, pick: (joint: number) => void): Element {
  const drawn = picture(found.picture, found.text) as SVGSVGElement;
  drawn.setAttribute("role", "group"); // its joints are buttons
  const marks: SVGElement[] = found.links
    .filter((link) => link.overconstrained || link.rigid)
    .map((link) =>
      svg("polyline", {
        points: link.outline.join(" "),
        fill: "none",
        "stroke-width": 18,
        opacity: 0.6,
        "stroke-linecap": "round",
        stroke: link.overconstrained ? "var(--accent)" : "var(--purple)",
        "data-strained": link.name,
      }),
    );
  const joints = found.joints.map((one, k) =>
    svg(
      "circle",
      {
        cx: one.at[0],
        cy: one.at[1],
        r: 13,
        fill: "transparent",
        stroke: k === joint ? "var(--key)" : "transparent",
        "stroke-width": 3,
        tabindex: 0,
        role: "button",
        "aria-label": one.name,
        "data-joint": one.name,
        cursor: "pointer",
        onclick: () => pick(k),
        onkeydown: (event: KeyboardEvent) => {
          if (event.key !== "Enter" && event.key !== " ") return;
          event.preventDefault();
          pick(k);
        },
      },
      svg("title", {}, one.name),
    ),
  );
  drawn.querySelector(".gr-ground")!.after(...marks); // around the links: letters and joints lie above
  drawn.append(...joints);
  return drawn;
}

/** The types of a joint, of which one is chosen; without one, what those of the chain are called. */
export function typesOf({ joints }: Structure, number: number, choose: (text: string) => void): HTMLElement {
  const joint = joints[number];
  const own = joints.flatMap(({ types }) => types.filter(({ chosen }) => chosen));
  const told = new Set(own.map(({ name, symbol }) => `${symbol}\u00a0${name}`.trim()));
  return joint
    ? h(
        "div.said",
        {},
        h("p.note", {}, t("Type of {joint}", { joint: joint.name })),
        h(
          "div.chips",
          {},
          ...joint.types.map((type) =>
            h(
              "button",
              {
                class: type.chosen ? "key" : "plain",
                "data-type": type.symbol,
                onclick: () => choose(type.text),
              },
              `${type.symbol} ${type.name}`,
            ),
          ),
        ),
      )
    : h("p.note", {}, `${[...told].join(", ")}. `, t("Choose a joint to change its type."));
}
