/** Elements in few words: a tag with its classes, as "p.note". Attributes that begin with `on` are listeners. */

export type Child = Node | string | null | false | undefined;

type Attributes = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;

const SVG = "http://www.w3.org/2000/svg";

/** An element that is made by its name, with what stands after that in its tag as classes. */
function filled<E extends Element>(
  make: (name: string) => Element,
  tag: string,
  given: Attributes | Child,
  children: Child[],
): E {
  const [kind, ...classes] = tag.split(".");
  const element = make(kind!) as E;
  if (classes.length) element.setAttribute("class", classes.join(" "));
  const none = !given || typeof given === "string" || given instanceof Node; // it is a child (build.mjs)
  if (none) children.unshift(given);
  const attributes = none ? {} : given;
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name.slice(2), value as unknown as EventListener);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  const exact = element.tagName === "pre" || element.tagName === "PRE"; // may be a command
  for (const child of children)
    if (child !== null && child !== false && child !== undefined)
      element.append(typeof child === "string" && !exact ? withMinus(child) : child);
  return element;
}

/** A text with minus signs as long as the plus. */
export function withMinus(text: string): string {
  return text.replace(/(^|[\s(=])-(?=[\s\d(])/g, "$1−");
}

const GAPS = / (?=[=≤<] )|(?<=[=≤<+−-]) |(?<=\([^() ]+) (?=[+−-] )|(?<=\d) (?=\w{1,3}\b)/g;

/** A text that does not break at some gaps, else neither beside an equals sign nor behind another one, between a number
 * and its unit or its factor, nor in brackets such as (n − 1). */
export function unbroken(text: string, gaps = GAPS): string {
  return text.replace(gaps, "\u00a0");
}

/** A text in which what follows an underscore is an index, l_a, and the class of a joint, g1; a joint R(a-b) is one. */
export function indexed(text: string): (string | Node)[] {
  return unbroken(text)
    .split(/(?:(?<=[\p{L}\p{N}])_|(?<=\bg)(?=\d))([\p{L}\d]+)|(\p{Lu}\w*\((?:\S[^()]*)?\S-[^()]*\))/u)
    .map((part, k) => (part ? [part, h("sub", {}, part), h("nobr" as "b", {}, part)][k % 3]! : ""));
}

/** The same of the count of freedoms: its formula breaks before an equals sign alone, but not behind F, nor before the
 * number to which it comes. */
export function countOf(text: string): (string | Node)[] {
  return indexed(
    / [−-] /.test(text)
      ? unbroken(text, / (?=[+−-] )/g)
          .replace(/(?<!F) = (?!−?\d+(?:[.,]|$))/g, " \u200b= ")
          .replace(/(?<=[.,] )[^=]*$/, (end) => unbroken(end, / /g))
      : text,
  );
}

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K | `${K}.${string}`,
  attributes: Attributes | Child = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  return filled((name) => document.createElement(name), tag, attributes, children);
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K | `${K}.${string}`,
  attributes: Attributes | Child = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  return filled((name) => document.createElementNS(SVG, name), tag, attributes, children);
}

/** Give an element attributes: only those are written that are others than before, since to write one takes long. */
export function put(element: Element, attributes: Record<string, string | number>): void {
  for (const [name, value] of Object.entries(attributes)) {
    const text = String(value);
    if (element.getAttribute(name) !== text) element.setAttribute(name, text);
  }
}

/** Put other children into a place, which stays scrolled as it is; the focus goes to the element of the same name, or
 * to the first button where there is no such element any more. */
export function renew(place: Element, ...children: (Node | string | false)[]): void {
  const focused = (place.getRootNode() as Document | ShadowRoot).activeElement;
  const name = focused && focused !== place && place.contains(focused) ? selectorOf(focused) : "";
  // to ask others would lay out the page for each of them
  const scrollTop = place.matches(".view, .side") ? place.scrollTop : 0;
  place.replaceChildren(...children.filter((child) => child !== false));
  if (scrollTop) place.scrollTop = scrollTop;
  const next = name && (place.querySelector<HTMLElement>(name) ?? place.querySelector("button"));
  if (next) next.focus({ preventScroll: true });
}

/** What an element is called: its number in the document, its data, else what it is read as. */
function selectorOf(element: Element): string {
  const named = [...element.attributes].find(({ name }) => /^(id|data-.*|aria-label)$/.test(name));
  return element.tagName.toLowerCase() + (named ? `[${named.name}="${CSS.escape(named.value)}"]` : "");
}

/** Whether the page is a document of its own, not a cell of a notebook. */
export function ownPage(): boolean {
  return document.querySelector("[data-gruebler]") !== null;
}

/** A button that does something, which is called so. */
export function action(called: string, onclick: () => void, text = ""): HTMLButtonElement {
  return h("button.plain", { "data-act": called, onclick }, text);
}

/** Buttons of which one is pressed: values with their texts. */
export function choice(
  label: string,
  options: [string, string][],
  chosen: string,
  choose: (value: string) => void,
  more: Attributes = {},
): HTMLElement {
  const group: HTMLElement = h(
    "div.choice",
    { role: "group", "aria-label": label, ...more },
    ...options.map(([value, text]) => {
      const onclick = () => {
        press(group, value);
        choose(value);
      };
      return h("button", { type: "button", "data-value": value, onclick }, text);
    }),
  );
  press(group, chosen);
  return group;
}

/** Mark which of a choice is chosen; none if it has no such value. */
function press(group: HTMLElement, value: string): void {
  for (const one of group.children as Iterable<Element> as HTMLElement[])
    one.setAttribute("aria-pressed", String(one.dataset.value === value));
}

/** A box that is checked, with its text. */
export function option(text: string, checked: boolean, set: (on: boolean) => void, key?: string): HTMLElement {
  const box = h("input", { type: "checkbox", checked, "data-field": key, onchange: () => set(box.checked) });
  return h("label", {}, box, text);
}

/** A menu of which one entry is chosen: values with their texts. */
export function menu(
  label: string,
  options: [string, string][],
  chosen: string,
  choose: (value: string) => void,
  more: Attributes = {},
): HTMLSelectElement {
  const list = h(
    "select",
    { "aria-label": label, onchange: () => choose(list.value), ...more },
    ...options.map(([value, text]) => h("option", { value, selected: value === chosen }, text)),
  );
  return list;
}

/** The picture in SVG that Python wrote, as an element: parsed, not trusted as markup of the page. */
export function picture(text: string, label: string): Element {
  const parsed = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  for (const script of parsed.querySelectorAll("script, foreignObject")) script.remove();
  for (const element of [parsed, ...parsed.querySelectorAll("*")])
    for (const { name } of [...element.attributes]) if (/^on/i.test(name)) element.removeAttribute(name);
  for (const element of parsed.querySelectorAll("text, tspan"))
    if (!element.children.length) element.textContent = withMinus(element.textContent ?? "");
  parsed.setAttribute("role", "img");
  parsed.setAttribute("aria-label", label);
  return document.importNode(parsed, true);
}

/** The same, in the size of a card. */
export function thumbnail(drawn: string, label: string): Element {
  const made = picture(drawn, label);
  made.setAttribute("height", "120");
  made.removeAttribute("width");
  made.classList.toggle("many", !!made.querySelectorAll("text")[9]); // numbers too small to be read
  return made;
}

/** On a phone a stage is the lower the farther its view has gone up. Returns what ends that. */
export function lowered(stage: HTMLElement): () => void {
  const scrolled = () => {
    const gone = Math.max(0, -(stage.parentElement?.getBoundingClientRect().top ?? 0));
    stage.style.setProperty("--scrolled", `${gone}px`);
    stage.classList.toggle("low", gone > 99);
  };
  const how = { capture: true, passive: true };
  addEventListener("scroll", scrolled, how);
  return () => removeEventListener("scroll", scrolled, how);
}

/** Whether the reader wants nothing to move by itself. */
export function wantsStill(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
