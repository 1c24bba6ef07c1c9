/** What the page stands on: a server, a notebook, or nothing but itself.
 *
 * The interface is that of an anywidget model, so that one module serves all three. Requests go as custom messages
 * {id, method, params, lang}; answers come as {id, result}, {id, error}, or {id, progress}. */

export interface HostModel {
  get(name: string): unknown;
  set(name: string, value: unknown): void;
  save_changes(): void;
  on(event: string, callback: (message: never) => void): void;
  off?(event: string, callback?: (message: never) => void): void;
  send(content: unknown): void;
}

/** The request was cancelled by the reader. */
export class Cancelled extends Error {}

/** An answer that is awaited and can be given up. */
export type Request<Result> = Promise<Result> & { cancel(): void };

interface Waiting {
  resolve(result: unknown): void;
  reject(error: Error): void;
  progress: ((text: string) => void) | undefined;
}

interface Answer {
  id: number;
  result?: unknown;
  error?: string;
  progress?: string;
  cancelled?: boolean;
}

export class Backend {
  #next = 1;
  readonly #waiting = new Map<number, Waiting>();

  constructor(private readonly model: HostModel) {
    model.on("msg:custom", ((answer: Answer) => this.#answered(answer)) as (message: never) => void);
  }

  /** Whether somebody answers: Python, or the files of a static site. */
  get present(): boolean {
    return this.model.get("host") !== "file";
  }

  /** Whether there is a Python behind the page. */
  get served(): boolean {
    return this.present && this.model.get("host") !== "site";
  }

  #answered(answer: Answer): void {
    const request = this.#waiting.get(answer.id);
    if (!request) return;
    if (answer.progress !== undefined) return request.progress?.(answer.progress);
    this.#waiting.delete(answer.id);
    if (answer.cancelled) request.reject(new Cancelled());
    else if (answer.error !== undefined) request.reject(new Error(sentence(answer.error)));
    else request.resolve(answer.result);
  }

  ask<Result>(
    method: string,
    params: Record<string, unknown>,
    lang: string,
    progress?: (text: string) => void,
  ): Request<Result> {
    const id = this.#next++;
    const promise = new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject, progress });
      this.model.send({ id, method, params, lang });
    }) as Promise<Result>;
    const cancel = () => {
      this.model.send({ id, cancel: true });
      this.#answered({ id, cancelled: true }); // whoever works may need a moment to end
    };
    return Object.assign(promise, { cancel });
  }
}

type Listener = (message: never) => void;

/** A message as it stands alone: it begins with a capital letter, unless with a name. */
function sentence(text: string): string {
  return text.replace(/^\p{Ll}(?=\p{L}*[ ,])/u, (letter) => letter.toUpperCase());
}

/** A model without anything behind it. */
export class StillModel implements HostModel {
  protected readonly values: Record<string, unknown>;
  protected readonly listeners = new Map<string, Set<Listener>>();

  constructor(values: Record<string, unknown>) {
    this.values = values;
  }
  get(name: string): unknown {
    return this.values[name];
  }
  set(name: string, value: unknown): void {
    this.values[name] = value;
  }
  save_changes(): void {
    // nobody is told
  }
  on(event: string, callback: Listener): void {
    if (!this.listeners.has(event)) this.listeners.set(event, new Set());
    this.listeners.get(event)!.add(callback);
  }
  send(_content: unknown): void {
    // nobody answers
  }
  protected emit(event: string, message: unknown): void {
    for (const listener of this.listeners.get(event) ?? []) listener(message as never);
  }
}

/** A model over a WebSocket.
 *
 * When the server goes, requests wait; when it is back, they are sent again in their order. */
export class SocketModel extends StillModel {
  private socket: WebSocket | null = null;
  private readonly pending = new Map<number, unknown>();
  #delay = 250;

  constructor(
    values: Record<string, unknown>,
    private readonly address: string,
  ) {
    super(values);
    this.#open();
  }

  #open(): void {
    const socket = new WebSocket(this.address);
    this.socket = socket;
    socket.onopen = () => {
      this.#delay = 250;
      this.emit("connection", true);
      for (const content of this.pending.values()) socket.send(JSON.stringify(content));
    };
    socket.onmessage = (event) => {
      const answer = JSON.parse(String(event.data)) as Answer;
      if (answer.progress === undefined) this.pending.delete(answer.id);
      this.emit("msg:custom", answer);
    };
    socket.onclose = () => {
      this.socket = null;
      this.emit("connection", false);
      setTimeout(() => this.#open(), this.#delay);
      this.#delay = Math.min(4000, 2 * this.#delay);
    };
  }

  override send(content: unknown): void {
    const { id, cancel } = content as { id: number; cancel?: boolean };
    if (!cancel) this.pending.set(id, content);
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(content));
    // it was not sent, or is lost
    else if (cancel && this.pending.delete(id)) this.emit("msg:custom", { id, cancelled: true });
  }
}
