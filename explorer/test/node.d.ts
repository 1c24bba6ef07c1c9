/** What the tests use of node. */

declare module "node:test" {
  export function test(name: string, body: () => void | Promise<void>): void;
}

declare module "node:assert/strict" {
  const assert: {
    equal(found: unknown, wanted: unknown, message?: string): void;
    deepEqual(found: unknown, wanted: unknown, message?: string): void;
    ok(value: unknown, message?: string): asserts value;
    throws(body: () => unknown, wanted: (error: unknown) => boolean): void;
    rejects(body: Promise<unknown>, wanted: (error: unknown) => boolean): Promise<void>;
  };
  export default assert;
}

declare module "node:zlib" {
  export function deflateRawSync(bytes: Uint8Array): Uint8Array;
}
