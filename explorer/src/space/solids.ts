/** Bodies as a file. */

import { moved, type Vector } from "./algebra";
import type { Body } from "./model";

/** The bodies of all links in their poses as a binary STL file. */
export function stlOf(bodies: Body[], poses: ArrayLike<number>[]): ArrayBuffer {
  const count = bodies.reduce((sum, { triangles }) => sum + triangles.length / 3, 0);
  const file = new DataView(new ArrayBuffer(84 + 50 * count)); // head, number of triangles; normal, corners, nothing
  file.setUint32(80, count, true);
  let at = 84;
  bodies.forEach(({ triangles, vertices }, link) => {
    const corners = triangles.map((n) => moved(poses[link]!, vertices.slice(3 * n, 3 * n + 3) as unknown as Vector));
    for (let first = 0; first < corners.length; first += 3) {
      const numbers = [[0, 0, 0], ...corners.slice(first, first + 3)].flat();
      numbers.forEach((value, k) => {
        file.setFloat32(at + 4 * k, value, true);
      });
      at += 50;
    }
  });
  return file.buffer;
}
