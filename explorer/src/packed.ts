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
  const out = new Uint8Array(((13 * text.length) / 2) >> 3);
  const digit = (k: number) => {
    const code = text.charCodeAt(k);
    return code - 32 - Number(code > 34) - Number(code > 60) - Number(code > 92);
  };
  let [rest, bits, to] = [0, 0, 0];
  for (let k = 0; k < text.length; k += 2) {
    const wide = k + 1 < text.length ? 13 : 6;
    rest = (rest << wide) | (wide > 6 ? 91 * digit(k) + digit(k + 1) : digit(k));
    for (bits += wide; bits >= 8; ) {
      bits -= 8;
      out[to++] = rest >> bits;
      rest &= (1 << bits) - 1;
    }
  }
  return out;
}

/** The text of its packed bytes. */
export function textOf(packed: string): Promise<string> {
  return unpacked(bytesOf(packed)).text();
}
