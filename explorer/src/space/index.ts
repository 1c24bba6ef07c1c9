/** The page of a linkage in space: go round it, play it, pull a drive or a link, see the paths of points. */

import { setLanguage } from "../language";
import type { Model } from "./model";
import { SpaceView } from "./view";

const model: Model = JSON.parse(document.getElementById("gruebler-model")!.textContent!);
const asked = location.hash.slice(1);
setLanguage((asked in model.texts ? asked : document.documentElement.lang) as keyof Model["texts"]);
const view = new SpaceView(document.body, model);
Object.assign(window, { gruebler: view });
