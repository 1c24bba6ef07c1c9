/** What the server makes of a machine in space. */

import { currentLanguage } from "../language";
import type { Model } from "./model";

/** Ask for it with what the machine is called; an `Error` says why there is none. */
export async function asked<Result>(method: string, data: Model, params: object): Promise<Result> {
  const { between, document: linkage, texts } = data;
  const lang = currentLanguage();
  const said = (key: "drives" | "letters" | "links" | "title") =>
    Object.fromEntries(Object.entries(texts).map(([language, one]) => [language, one[key]]));
  const named = { titles: said("title"), drives: said("drives"), links: said("links"), letters: said("letters") };
  const body = JSON.stringify({ id: 0, lang, params: { document: linkage, between, ...named, ...params } });
  let answer: { error?: string; result?: Result };
  try {
    answer = await (await fetch(method, { method: "POST", body })).json();
  } catch {
    throw new Error(texts[lang].words.lost);
  }
  if (answer.error !== undefined) throw new Error(answer.error);
  return answer.result!;
}
