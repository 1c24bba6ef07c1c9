/** What can be undone and done again. */

const OLDEST = 200;

export class History<State> {
  #past: State[] = [];
  #future: State[] = [];

  clear(): void {
    this.#past = [];
    this.#future = [];
  }

  /** A change was made; this is what was before. */
  add(before: State): void {
    this.#past.push(before);
    if (this.#past.length > OLDEST) this.#past.shift();
    this.#future = [];
  }

  /** All that can be undone, the oldest first. */
  get all(): readonly State[] {
    return this.#past;
  }

  /** What was before the last change, if there is one; what is now can be done again. */
  undo(now: State): State | undefined {
    return step(this.#past, this.#future, now);
  }

  redo(now: State): State | undefined {
    return step(this.#future, this.#past, now);
  }

  /** Whether there is something to undo, and something to do again. */
  get possible(): [boolean, boolean] {
    return [this.#past.length > 0, this.#future.length > 0];
  }
}

function step<State>(from: State[], to: State[], now: State): State | undefined {
  const old = from.pop();
  if (old !== undefined) to.push(now);
  return old;
}
