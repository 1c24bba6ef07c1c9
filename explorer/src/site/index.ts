/** What a static site adds to the page: a model that answers out of files what a server answers otherwise. */

import { Cancelled, StillModel } from "../host";
import type { Language } from "../language";
import type { LinkageDocument, Model } from "../model";
import { DesignWorker, NINE } from "./designs";
import { type Catalog, fitting } from "./machines";
import { type Answer, type Asked, marked, type Tolerances } from "./marks";
import { pack } from "./packs";
import { chainOf, type Pair, type StructurePack, structureOf } from "./structures";

/** What the requests that are answered here are given (`gruebler.page.params`). */
interface Params {
  id: string;
  text: string;
  links: number;
  mobility: number;
  start: number;
  assortment: number[] | null;
  part: number;
  answers: Record<string, string>;
  kind: string;
  rows: [number, number][];
  closed: boolean;
  crank: boolean;
  transmission: number;
  document: LinkageDocument;
  name: string;
}

interface MachinePack {
  model?: Model;
  moving?: string;
  structure: Record<Language, StructurePack>;
}

interface TaskPack extends Tolerances {
  tasks: {
    records: Record<Language, { id: string; asked: { key: string; choices: string[] }[] }>;
    solutions: Record<Language, unknown>;
    answers: Record<string, Asked | Record<Language, Record<string, Answer>>>;
    try: object[];
    structures: StructurePack[];
  }[];
}

interface Chains {
  assortments: object[];
  items: { text: string; assortment: number[] }[];
}
type Texts = (text: string, values?: Record<string, string | number>) => string;

class SiteModel extends StillModel {
  readonly #designs = new DesignWorker();
  /** Chains of tasks, whose links have other names than those of the lists. */
  readonly #tried = new Map<string, StructurePack>();

  constructor(
    values: Record<string, unknown>,
    private readonly t: Texts,
  ) {
    super(values);
  }

  override send(content: unknown): void {
    const { id, method, params, lang } = content as { id: number; method: string; params: Params; lang: Language };
    if (!method) return this.#designs.cancel(id); // nothing else takes so long
    const asked = method === "synthesise" ? this.#synthesised(id, params, lang) : this.#answer(method, params, lang);
    asked.then(
      (result) => this.emit("msg:custom", { id, result }),
      (error: Error) =>
        this.emit("msg:custom", error instanceof Cancelled ? { id, cancelled: true } : { id, error: error.message }),
    );
  }

  /** That only the library can answer. */
  #library(text = ""): Error {
    const command = `gruebler explore${text && ` "${text}"`}`;
    return new Error(
      this.t("This needs gruebler on your computer: pip install 'gruebler[web]', then: {command}", { command }),
    );
  }

  async #synthesised(id: number, params: Params, lang: Language): Promise<unknown> {
    const { kind, rows, closed } = params;
    if (kind !== "points" || rows.length !== NINE || closed) throw this.#library();
    return this.#designs.found(id, params, lang, (progress) => this.emit("msg:custom", { id, progress }));
  }

  async #answer(method: string, params: Params, lang: Language): Promise<unknown> {
    const { id, text } = params;
    switch (method) {
      case "catalog": {
        const found = fitting(await pack<Catalog>("catalog"), { ...params });
        return found.map(({ entries }) => entries[lang]);
      }
      case "picture": {
        const { machines } = await pack<Catalog>("catalog");
        const { pictures } = machines.find(({ entries }) => entries.en.id === id)!;
        return { picture: pictures[lang] ?? pictures.en };
      }
      case "moving": {
        const { moving } = await pack<MachinePack>(`machine-${id}`);
        if (!moving) throw this.#library();
        return { picture: moving };
      }
      case "open":
        return await this.#machine(id);
      case "chains":
        return await this.#chains(params);
      case "structure":
        return await this.#structure(text, lang);
      case "realise": {
        const name = await this.#numberOf(chainOf(text));
        if (!name || !/^[3-6]-1-/.test(name)) throw this.#library(text);
        const found = (await pack<Record<string, Model>>(`moving-${name}`))[text];
        if (!found) throw this.#library(text);
        return found;
      }
      case "exercise_kinds":
        return (await pack<Record<Language, unknown>>("kinds"))[lang];
      case "exercise": {
        return (await this.#task(id)).task.records[lang];
      }
      case "mark":
        return await this.#marks(id, params.answers, lang);
      case "open_document": {
        const found = this.#designs.opened(params.document, params.name);
        if (!found) throw this.#library();
        return found;
      }
      case "try":
        return await this.#try(id, params.part);
    }
    throw this.#library();
  }

  async #machine(id: string): Promise<Model> {
    const { machines } = await pack<Catalog>("catalog");
    const known = machines.some(({ entries }) => entries.en.id === id);
    const model = known ? (await pack<MachinePack>(`machine-${id}`)).model : undefined;
    if (!model) throw this.#library(id);
    return model;
  }

  async #chains({ links, mobility, start, assortment }: Params): Promise<Chains & { total: number; start: number }> {
    const { assortments, items } = await this.#list(links, mobility);
    const found = items.filter((item) => !assortment || String(item.assortment) === String(assortment));
    return { total: found.length, start, assortments, items: found.slice(start, start + 60) };
  }

  /** All chains of a class; none where there are none, or none here. */
  async #list(links: number, mobility: number): Promise<Chains> {
    const here = (this.get("chains") as string[]).includes(`${links}-${mobility}`);
    return here ? await pack<Chains>(`chains-${links}-${mobility}`) : { assortments: [], items: [] };
  }

  /** Links, mobility and number of a chain of the lists, by which its files are named. */
  async #numberOf(chain: string): Promise<string> {
    const joints = chain.match(/R\([^)]*\)/g) ?? [];
    const links = new Set(joints.flatMap((joint) => joint.slice(2, -1).split("-"))).size;
    const mobility = 3 * (links - 1) - 2 * joints.length;
    const number = (await this.#list(links, mobility)).items.findIndex(({ text }) => text === chain);
    return number < 0 ? "" : `${links}-${mobility}-${number}`;
  }

  async #structure(text: string, lang: Language): Promise<unknown> {
    const chain = chainOf(text);
    const held = this.#tried.get(chain) ?? (await this.#held(chain, lang));
    const said = held && structureOf(held, text, lang, await pack<Pair[]>("pairs"));
    if (!said) throw this.#library(text);
    return said;
  }

  /** What is held of a chain of the lists or of a machine. */
  async #held(chain: string, lang: Language): Promise<StructurePack | undefined> {
    const name = await this.#numberOf(chain);
    if (name) return await pack<StructurePack>(`structure-${name}`);
    const { machines } = await pack<Catalog>("catalog");
    const found = machines.find(({ entries }) => chainOf(entries.en.text) === chain);
    return found && (await pack<MachinePack>(`machine-${found.entries.en.id}`)).structure[lang];
  }

  async #task(id: string): Promise<{ task: TaskPack["tasks"][number]; tolerances: Tolerances }> {
    const [, kind, number] = /^(.*)-(\w+)$/.exec(id)!;
    const { tasks, ...tolerances } = await pack<TaskPack>(`tasks-${kind}`);
    const task = tasks.find(({ records }) => records.en.id === id) ?? tasks[Number(number) % tasks.length]!;
    return { task, tolerances };
  }

  async #try(id: string, part: number): Promise<unknown> {
    const { task } = await this.#task(id);
    for (const held of task.structures) this.#tried.set(held.text, held);
    return task.try[part];
  }

  async #marks(id: string, answers: Record<string, string>, lang: Language): Promise<unknown> {
    const { task, tolerances } = await this.#task(id);
    const mark = ([key, answer]: [string, string]) => {
      const asked = task.answers[key]!;
      if (!("value" in asked)) return { key, ...asked[lang][answer]! };
      const { unit } = asked as Asked;
      const hint = unit
        ? this.t("Expected a number in {unit}, not {answer}", { unit, answer })
        : this.t("Expected a number, not {answer}", { answer });
      return { key, ...(marked(asked as Asked, answer, lang, tolerances) ?? { mark: "wrong", hint }) };
    };
    const given = Object.entries(answers).filter(([, answer]) => answer.trim());
    return { marks: given.map(mark), solution: task.solutions[lang] };
  }
}

Object.assign(window, { grueblerSite: (values: Record<string, unknown>, t: Texts) => new SiteModel(values, t) });
