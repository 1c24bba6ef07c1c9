/** Cards whose pictures move while the pointer or the focus is on them. */

import { thumbnail, wantsStill } from "./dom";

const PATIENCE = 150; // ms: who passes by a card does not ask

/** Let the picture of a card move: what moves is asked for once, when it is first wanted. */
export function movesOnHover(card: HTMLElement, label: string, ask: () => Promise<{ picture: string }>): void {
  let moving: SVGSVGElement | null = null;
  let still: Element | null = null;
  let wanted = false;
  const begin = async () => {
    wanted = !wantsStill();
    await new Promise((resolve) => setTimeout(resolve, PATIENCE));
    if (!wanted) return;
    try {
      moving ??= thumbnail((await ask()).picture, label) as SVGSVGElement;
    } catch {
      return; // what has no single drive stands still
    }
    still ??= card.querySelector("svg");
    if (!wanted || !still?.isConnected) return;
    still.replaceWith(moving);
    // what comes into a page later does not begin by itself in every browser, nor before its first frame
    const turns = moving.querySelectorAll<SVGAnimationElement>("animateTransform,animate");
    requestAnimationFrame(() => {
      for (const turn of turns) turn.beginElement();
    });
  };
  const end = () => {
    wanted = false;
    if (still && moving?.isConnected) moving.replaceWith(still);
  };
  for (const event of ["pointerenter", "focus"]) card.addEventListener(event, () => void begin());
  for (const event of ["pointerleave", "blur"]) card.addEventListener(event, end);
}
