/** What stands packed in the module, unpacked. */

export function unpackedBytes(packed: BlobPart): Promise<ArrayBuffer> {
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

/** The text in base64 of its packed bytes: of a style sheet, of a table of texts. */
export async function textOf(packed: string): Promise<string> {
  return new TextDecoder().decode(await unpackedBytes(Uint8Array.from(atob(packed), (c) => c.charCodeAt(0))));
}
