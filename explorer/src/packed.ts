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
  const out: number[] = [];
  for (let at = 0; at < text.length; at += 112) {
    const signs = [...text.slice(at, at + 112)];
    let value = 0n;
    for (const sign of signs) {
      const code = sign.charCodeAt(0);
      const skipped = [0, 10, 13, 34, 60, 92].filter((one) => one < code).length;
      value = 122n * value + BigInt(code - skipped);
    }
    const hex = value.toString(16).padStart(2 * signs.length - 30, "0");
    out.push(...hex.match(/../g)!.map((pair) => Number(`0x${pair}`)));
  }
  return Uint8Array.from(out);
}

/** The text of its packed bytes. */
export function textOf(packed: string): Promise<string> {
  return unpacked(bytesOf(packed)).text();
}
