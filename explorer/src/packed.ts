/** What stands packed in the module, unpacked. */

/** What comes of something in a stream that packs or unpacks it. */
export function through(stream: CompressionStream | DecompressionStream, content: BlobPart): Response {
  return new Response(new Blob([content]).stream().pipeThrough(stream));
}

export function unpacked(content: BlobPart): Response {
  return through(new DecompressionStream("gzip"), content);
}

/** Bytes in base 64, and back. */
export function base64Of(bytes: Uint8Array): string {
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
}

export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
}

/** The bytes that `written` of build.mjs made a text of. */
export function bytesOf(text: string): Uint8Array<ArrayBuffer> {
  const groups = Math.ceil(text.length / 7);
  const out = new Uint8Array(text.length - groups);
  for (let group = 0; group < groups; group++) {
    const signs = text.slice(7 * group, 7 * group + 7);
    let value = 0;
    for (const sign of signs) {
      const code = sign.charCodeAt(0);
      const skipped = [0, 10, 13, 34, 60, 92].filter((one) => one < code).length;
      value = 122 * value + code - skipped;
    }
    for (let k = signs.length - 2; k >= 0; k--) {
      out[6 * group + k] = value;
      value = Math.floor(value / 256);
    }
  }
  return out;
}

/** The text of its packed bytes. */
export function textOf(packed: string): Promise<string> {
  return unpacked(bytesOf(packed)).text();
}
