/** The files of a static site: scripts beside the page, each of which hands over one packed text. */

import { fromBase64, unpacked } from "../packed";

const waiting = new Map<string, (data: string) => void>();
const packs = new Map<string, Promise<unknown>>();

Object.assign(window, { grueblerPack: (name: string, data: string) => waiting.get(name)?.(data) });

/** What a file holds; it is loaded when it is first wanted. */
export function pack<Content>(name: string): Promise<Content> {
  if (!packs.has(name)) packs.set(name, loaded(name));
  return packs.get(name) as Promise<Content>;
}

async function loaded(name: string): Promise<unknown> {
  const script = document.createElement("script");
  const data = await new Promise<string>((resolve, reject) => {
    waiting.set(name, resolve);
    script.src = `data/${name}.js`;
    script.onerror = () => {
      packs.delete(name); // it may come the next time
      reject(new Error(script.src));
    };
    document.head.append(script);
  });
  script.remove();
  return unpacked(fromBase64(data)).json();
}
