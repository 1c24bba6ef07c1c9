/** Four-bars through nine points, found by a worker of the site. */

import type { Found } from "../designs";
import { Cancelled } from "../host";
import type { Language } from "../language";
import type { LinkageDocument, Model } from "../model";
import type { Question, Said } from "../points";
import { pack } from "./packs";

type TextKey =
  | ("progress" | "complete" | "missing" | "equal" | "line" | "circle")
  | ("form" | "balanced" | "best" | "none" | "exact");

/** The script of the worker, the model of some four-bar, and what is said (`gruebler.page.site_points`). */
interface PointsPack {
  script: string;
  template: Question["template"];
  texts: Record<Language, Record<TextKey, string>>;
}

/** A generic task, and its solutions as float32. */
interface GenericPack {
  task: number[];
  solutions: string;
}

type Asked = Pick<Question, "rows" | "crank" | "transmission">;

export const NINE = 9;

export class DesignWorker {
  #models: Model[] = [];
  /** What ends the work that is under way, by the numbers of the requests. */
  readonly #working = new Map<number, (why: Error) => void>();

  cancel(id: number): void {
    this.#working.get(id)?.(new Cancelled());
  }

  /** The model of a design that was found here last. */
  opened(document: LinkageDocument, name: string): Model | undefined {
    const key = (one: LinkageDocument) => JSON.stringify([one.elements, one.points, one.reference_pose]);
    const found = this.#models.find((model) => key(model.document) === key(document));
    return found && { ...found, name, document };
  }

  /** The four-bars through the points of a request; its files are loaded when the first one is asked. */
  async found(id: number, asked: Asked, lang: Language, progress: (text: string) => void): Promise<Found> {
    const givenUp = new Promise<never>((_, reject) => this.#working.set(id, reject));
    const files = Promise.all([pack<PointsPack>("points"), pack<GenericPack>("nine_points")]);
    try {
      return await this.#worked(await Promise.race([givenUp, files]), givenUp, asked, lang, progress);
    } finally {
      this.#working.delete(id);
    }
  }

  /** What a worker finds, unless it is given up. */
  async #worked(
    [{ script, template, texts }, { task, solutions }]: [PointsPack, GenericPack],
    givenUp: Promise<never>,
    asked: Asked,
    lang: Language,
    progress: (text: string) => void,
  ): Promise<Found> {
    const say = (text: TextKey, values: Record<string, number> = {}) =>
      texts[lang][text].replace(/\{(\w+)\}/g, (_, name: string) => String(values[name]));
    const question: Question = {
      ...asked,
      template,
      task,
      solutions: Uint8Array.from(atob(solutions), (c) => c.charCodeAt(0)).buffer,
    };
    // a page from the disk may start no module as a worker
    const plain = `(async()=>{${script.replace(/export\s*\{[^}]*\};?\s*$/, "")}})()`;
    const address = URL.createObjectURL(new Blob([plain], { type: "text/javascript" }));
    const worker = new Worker(address);
    try {
      const answer = new Promise<Found>((resolve, reject) => {
        worker.onerror = (event) => reject(new Error(event.message || address));
        worker.onmessage = ({ data }: MessageEvent<Said>) => {
          if ("ready" in data) worker.postMessage(question);
          else if ("done" in data) progress(say("progress", { done: data.done, total: data.total }));
          else if ("error" in data) reject(new Error(data.error));
          else if ("fault" in data) {
            const [[what, value]] = Object.entries(data.fault) as [["equal" | "line" | "circle", number | number[]]];
            const [first, second] = [value].flat() as [number, number];
            reject(new Error(say(what, { first, second, count: first, most: 6 })));
          } else {
            const { found, missing, real } = data;
            this.#models = found.items.map((design) => (design as { model?: Model }).model!);
            const items = found.items.map((design) => ({ ...design, model: undefined, form: texts[lang].form }));
            const count = found.total;
            const note = [
              say("complete", { real }),
              missing ? say("missing", { count: missing }) : "",
              items.length < count ? say("best", { count }) : "",
              say(count ? "exact" : "none"),
            ];
            resolve({ ...found, items, words: say("balanced"), note: note.join("\n") });
          }
        };
      });
      return await Promise.race([givenUp, answer]);
    } finally {
      worker.terminate();
      URL.revokeObjectURL(address);
    }
  }
}
