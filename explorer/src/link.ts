/** A linkage as the part of an address behind #: version, packed document, checksum. */

import { t } from "./language";
import { base64Of, fromBase64, through } from "./packed";

const VERSION = "1";
const LONGEST = 200_000;

/** CRC-32, as in zip files. */
export function checksum(bytes: Uint8Array): string {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let k = 0; k < 8; k++) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  return (~crc >>> 0).toString(16).padStart(8, "0");
}

export async function packed(content: unknown): Promise<string> {
  const stream = new CompressionStream("deflate-raw");
  const bytes = new Uint8Array(await through(stream, JSON.stringify(content)).arrayBuffer());
  const text = base64Of(bytes);
  return `${VERSION}.${text.replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "")}.${checksum(bytes)}`;
}

export async function unpacked(text: string): Promise<unknown> {
  const [version, data, sum] = text.split(".");
  if (version !== VERSION && /^\d+$/.test(version ?? ""))
    throw new Error(t("This address was made by a newer version of this page."));
  try {
    const bytes = fromBase64(data!.replace(/-/g, "+").replace(/_/g, "/"));
    if (checksum(bytes) === sum && text.length < LONGEST)
      return await through(new DecompressionStream("deflate-raw"), bytes).json();
  } catch {
    // said below
  }
  throw new Error(t("This address is damaged or not complete."));
}
