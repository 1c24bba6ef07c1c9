/** The page of a linkage in space: go round it, play it, pull a drive or a link, see the paths of points. */

import { loadTexts, setLanguage } from "../language";
import type { Model } from "./model";
import { SpaceView } from "./view";

const given = (name: string) => document.getElementById(`gruebler-${name}`)!.textContent!;
const model: Model = JSON.parse(given("model"));
await loadTexts(given("texts"));
const [asked = "", back, sheet] = location.hash.slice(1).split("/");
setLanguage((asked in model.texts ? asked : document.documentElement.lang) as keyof Model["texts"]);
const [entry] = performance.getEntriesByType("navigation") as PerformanceNavigationTiming[];
const view = new SpaceView(document.body, model, back !== undefined || entry?.type !== "navigate");
if (sheet) {
  history.replaceState(null, "", `#${asked}/${back}`); // once
  view.showExport();
}
Object.assign(window, { gruebler: view });
