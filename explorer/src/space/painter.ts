/** Bodies and lines of a linkage in space on a canvas, by WebGL 2: lit from over the shoulder, with dark outlines. */

import { cross, dot, minus, type Vector } from "./algebra";
import type { Body } from "./model";

const VERTEX = `#version 300 es
layout(location = 0) in vec3 place; layout(location = 1) in vec3 side; layout(location = 2) in vec3 out_;
uniform mat4 view; uniform mat4 pose; uniform vec2 rim; out vec3 normal; out vec3 at;
void main() {
  vec4 p = pose * vec4(place, 1.0); at = p.xyz; normal = mat3(pose) * side;
  gl_Position = view * p;
  vec2 away = (view * vec4(mat3(pose) * out_, 0.0)).xy;
  if (rim.x > 0.0) gl_Position.xy += normalize(away + vec2(1e-9)) * rim * gl_Position.w;
}`;
const FRAGMENT = `#version 300 es
precision highp float; in vec3 normal; in vec3 at; out vec4 shade;
uniform vec3 colour; uniform vec3 eye; uniform vec3 lamp; uniform float lit; uniform float alpha;
void main() {
  vec3 n = normalize(normal), e = normalize(eye - at);
  if (dot(n, e) < 0.0) n = -n;
  float light = 0.42 + 0.5 * max(dot(n, lamp), 0.0) + 0.16 * max(dot(n, e), 0.0);
  float gloss = 0.18 * pow(max(dot(n, normalize(lamp + e)), 0.0), 24.0);
  shade = vec4(mix(colour, colour * light + gloss, lit) * alpha, alpha);
}`;
const CREASE = 0.6; // cosine of the angle from which on an edge is sharp
const RIM = 1.3; // pixels
const GLASS = 0.45; // of light that does not go through what is seen through

/** Lines of one colour. */
export interface Drawn {
  colour: Vector;
  /** Whether each two places are a line of their own. */
  pairs: boolean;
  places: Vector[];
}

export class Painter {
  readonly #gl: WebGL2RenderingContext;
  readonly #at: (name: string) => WebGLUniformLocation | null;
  #buffers: { link: number; places: WebGLBuffer; count: number; colour: Vector; alpha: number }[] = [];
  readonly #line: WebGLBuffer;

  /** Throws where the browser has no WebGL 2. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    bodies: Body[],
    glass: (Body & { link: number })[],
  ) {
    const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("WebGL 2");
    this.#gl = gl;
    const program = gl.createProgram();
    for (const [kind, source] of [
      [gl.VERTEX_SHADER, VERTEX],
      [gl.FRAGMENT_SHADER, FRAGMENT],
    ] as const) {
      const shader = gl.createShader(kind)!;
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    const places = new Map<string, WebGLUniformLocation | null>();
    this.#at = (name) => {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
      return places.get(name)!;
    };
    this.#line = gl.createBuffer();
    this.load(bodies, glass);
  }

  /** Other bodies. */
  load(bodies: Body[], glass: (Body & { link: number })[]): void {
    const gl = this.#gl;
    for (const { places } of this.#buffers) gl.deleteBuffer(places);
    const solid = bodies.map((body, link) => ({ ...body, link, alpha: 1 }));
    this.#buffers = [...solid, ...glass.map((body) => ({ ...body, alpha: GLASS }))].map((body) => {
      const corners = cornersOf(body);
      const buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, corners, gl.STATIC_DRAW);
      const { alpha, colour, link } = body;
      return { link, places: buffer, count: corners.length / 9, colour, alpha };
    });
  }

  /** Everything at the poses of the links, (links, 12), over lines; the marked link stands out. */
  paint(
    { view, eye, lamp }: { view: Float32Array; eye: Vector; lamp: Vector },
    poses: ArrayLike<number>[],
    lines: Drawn[],
    { paper, ink, marked }: { paper: Vector; ink: Vector; marked: number | null },
  ): void {
    const { canvas } = this;
    const [at, gl] = [this.#at, this.#gl];
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...paper, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(at("view"), false, view);
    gl.uniform3fv(at("eye"), eye);
    gl.uniform3fv(at("lamp"), lamp);
    for (const k of [0, 1, 2]) gl.enableVertexAttribArray(k);
    const scale = 2 * RIM * (canvas.width / Math.max(canvas.clientWidth, 1));
    const bodies = (outline: boolean, glass: boolean): void => {
      // outlines are the far sides of bodies, somewhat larger
      gl.enable(gl.CULL_FACE);
      gl.cullFace(outline ? gl.FRONT : gl.BACK);
      gl.uniform1f(at("lit"), Number(!outline));
      gl.uniform2f(at("rim"), outline ? scale / canvas.width : 0, outline ? scale / canvas.height : 0);
      for (const body of this.#buffers) {
        if (body.alpha < 1 !== glass) continue;
        const p = poses[body.link]!;
        gl.uniformMatrix4fv(
          at("pose"),
          false,
          [0, 1, 2, 3].flatMap((c) => [p[c]!, p[c + 4]!, p[c + 8]!, c === 3 ? 1 : 0]),
        );
        const faded = marked === null || marked === body.link ? 0 : 0.7;
        const colour = (outline ? ink : body.colour).map((v, n) => v + faded * (paper[n]! - v));
        gl.uniform3fv(at("colour"), colour);
        gl.uniform1f(at("alpha"), body.alpha);
        gl.bindBuffer(gl.ARRAY_BUFFER, body.places);
        for (const n of [0, 1, 2]) gl.vertexAttribPointer(n, 3, gl.FLOAT, false, 36, 12 * n);
        gl.drawArrays(gl.TRIANGLES, 0, body.count);
      }
    };
    bodies(true, false);
    bodies(false, false);
    gl.disable(gl.CULL_FACE);
    gl.uniform1f(at("lit"), 0);
    gl.uniform1f(at("alpha"), 1);
    gl.uniform2f(at("rim"), 0, 0);
    gl.uniformMatrix4fv(at("pose"), false, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    for (const k of [1, 2]) gl.disableVertexAttribArray(k);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#line);
    for (const { colour, pairs, places } of lines) {
      gl.uniform3fv(at("colour"), colour);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(places.flat()), gl.DYNAMIC_DRAW);
      gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
      gl.drawArrays(pairs ? gl.LINES : gl.LINE_STRIP, 0, places.length);
    }
    for (const k of [1, 2]) gl.enableVertexAttribArray(k);
    // of glass the nearest side alone is seen: first its depths, then its colours
    gl.depthFunc(gl.LEQUAL);
    gl.colorMask(false, false, false, false);
    bodies(false, true);
    gl.colorMask(true, true, true, true);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    bodies(false, true);
    gl.disable(gl.BLEND);
    gl.depthFunc(gl.LESS);
  }
}

/** Of each corner of each triangle its place, its normal, round but for sharp edges, and the way out of the body. */
function cornersOf({ vertices, triangles }: Body): Float32Array {
  const vertex = (k: number): Vector => vertices.slice(3 * k, 3 * k + 3) as Vector;
  const normals: Vector[] = [];
  const around = new Map<number, Vector[]>();
  for (let k = 0; k < triangles.length; k += 3) {
    const [a, b, c] = [0, 1, 2].map((n) => vertex(triangles[k + n]!)) as [Vector, Vector, Vector];
    const normal = unit(cross(minus(b, a), minus(c, a)));
    normals.push(normal);
    for (let n = 0; n < 3; n++) {
      const corner = triangles[k + n]!;
      around.set(corner, [...(around.get(corner) ?? []), normal]);
    }
  }
  const sum = (all: Vector[]): Vector => unit([0, 1, 2].map((k) => all.reduce((s, v) => s + v[k]!, 0)) as Vector);
  return new Float32Array(
    triangles.flatMap((corner, k) => {
      const own = normals[Math.floor(k / 3)]!;
      const all = around.get(corner)!;
      return [...vertex(corner), ...sum(all.filter((other) => dot(own, other) > CREASE)), ...sum(all)];
    }),
  );
}

function unit(v: Vector): Vector {
  const size = Math.hypot(...v) || 1;
  return v.map((part) => part / size) as Vector;
}
