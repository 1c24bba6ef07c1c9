/** What the page and its views know of one another. */

import type { Request } from "./host";
import type { Linkage } from "./linkage";
import type { Model } from "./model";
import type { InSpace } from "./storing";

export interface View {
  readonly element: HTMLElement;
  /** Lay the view out anew, in the language of the page. */
  arrange(): void;
  /** It has come to sight. */
  appeared?(): void;
  /** What it shows in place of the machine at hand: its name, and how it is saved. */
  readonly title?: string;
  save?(): void;
  /** Whether Motion shows what is made here, which it then opens there. */
  moves?(): boolean;
  /** What it undoes by itself. */
  readonly undoable?: [boolean, boolean];
  undo?(): void;
  redo?(): void;
  /** Do what a key does wherever the focus is, but in a field; whether it does anything. */
  press?(event: KeyboardEvent, target: Element): boolean;
}

/** A place in the history of the browser: a view, and the machine in space that is shown in place of Motion. */
export interface Place {
  view?: string;
  space?: string;
}

/** The page as its views see it. */
export interface Page {
  /** Whether there is a Python behind the page. */
  readonly served: boolean;
  /** The linkage that is shown in motion, and what it was opened as. */
  readonly linkage: Linkage;
  readonly shown: Model;
  /** The machine in space that Motion shows in place of it. */
  readonly inSpace: InSpace | null;
  /** The chains of which lists are made, as far as there is somebody who makes them. */
  readonly limits: Partial<Record<"links" | "mobility", { min: number; max: number }>>;
  ask<Result>(method: string, params: Record<string, unknown>, progress?: (text: string) => void): Request<Result>;
  /** Show a view by its name. */
  show(view: string): void;
  /** Show another linkage, in motion, at a value of its drive; undoing leads back to the view that drew it. */
  open(model: Model, drive?: number): void;
  /** What is answered is opened, or the error said, unless the reader left or chose something else meanwhile; whether
   * it was opened. */
  choose<Answer>(request: Promise<Answer>, open: (answer: Answer) => void): Promise<boolean>;
  /** Let the machine at hand move. */
  move(): void;
  /** Show the structure of a text. */
  describe(text: string): void;
  /** A sentence for the reader, an error unless something is done; without a text the last one goes. */
  say(text: string, kind?: "error" | "done", action?: HTMLElement): void;
  /** After a change: the link follows, a notebook is told. */
  changed(): void;
  /** Copy the address with the linkage in it. */
  share(): Promise<void>;
}
