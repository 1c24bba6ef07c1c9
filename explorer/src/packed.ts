/** What stands packed in the module, unpacked. */

export function unpackedBytes(packed: BlobPart): Promise<ArrayBuffer> {
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

/** The bytes that `written` of build.mjs made a text of. */
export function bytesOf(text: string): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array((4 * text.length) / 5);
  for (let from = 0, to = 0; from < text.length; from += 5) {
    let value = 0;
    for (let k = from; k < from + 5; k++) {
      const code = k < text.length ? text.charCodeAt(k) : 126;
      value = 85 * value + code - 40 - Number(code > 60) - Number(code > 92);
    }
    for (let shift = 24; shift >= 0; shift -= 8) out[to++] = value / 2 ** shift;
  }
  return out;
}

/** The text of its packed bytes: of a style sheet, of a table of texts. */
export async function textOf(packed: string): Promise<string> {
  return new TextDecoder().decode(await unpackedBytes(bytesOf(packed)));
}
