// Bodies and lines of a linkage in space on a canvas, by WebGL 2: flat faces with light from the eye.

import type { Vector } from "./algebra";

export interface Body {
  colour: Vector;
  vertices: number[];
  triangles: number[];
}

const VERTEX = `#version 300 es
in vec3 place; uniform mat4 view; uniform mat4 pose; out vec3 at;
void main() { vec4 p = pose * vec4(place, 1.0); at = p.xyz; gl_Position = view * p; }`;
const FRAGMENT = `#version 300 es
precision highp float; in vec3 at; uniform vec3 colour; uniform vec3 eye; uniform float lit; out vec4 shade;
void main() {
  vec3 n = normalize(cross(dFdx(at), dFdy(at)));
  float light = 0.35 + 0.65 * abs(dot(n, normalize(eye - at)));
  shade = vec4(colour * mix(1.0, light, lit), 1.0);
}`;

export class Painter {
  readonly #gl: WebGL2RenderingContext;
  readonly #program: WebGLProgram;
  readonly #buffers: { places: WebGLBuffer; count: number; colour: Vector }[];
  readonly #line: WebGLBuffer;

  /** Throws where the browser has no WebGL 2. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    bodies: Body[],
  ) {
    const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("WebGL 2");
    this.#gl = gl;
    this.#program = gl.createProgram();
    for (const [kind, source] of [
      [gl.VERTEX_SHADER, VERTEX],
      [gl.FRAGMENT_SHADER, FRAGMENT],
    ] as const) {
      const shader = gl.createShader(kind)!;
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(this.#program, shader);
    }
    gl.bindAttribLocation(this.#program, 0, "place");
    gl.linkProgram(this.#program);
    gl.useProgram(this.#program);
    gl.enable(gl.DEPTH_TEST);
    this.#buffers = bodies.map((body) => {
      const places = new Float32Array(body.triangles.flatMap((k) => body.vertices.slice(3 * k, 3 * k + 3)));
      const buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, places, gl.STATIC_DRAW);
      return { places: buffer, count: places.length / 3, colour: body.colour };
    });
    this.#line = gl.createBuffer();
  }

  /** Everything at the poses of the links, (links, 12), with paths as lists of places. */
  paint(view: Float32Array, eye: Vector, poses: ArrayLike<number>[], paths: number[][], dark: boolean): void {
    const [gl, program] = [this.#gl, this.#program];
    const at = (name: string): WebGLUniformLocation | null => gl.getUniformLocation(program, name);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    const ground = dark ? 0.09 : 1;
    gl.clearColor(ground, ground, ground, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(at("view"), false, view);
    gl.uniform3fv(at("eye"), eye);
    gl.enableVertexAttribArray(0);
    gl.uniform1f(at("lit"), 1);
    this.#buffers.forEach((body, k) => {
      const p = poses[k]!;
      const columns = [0, 1, 2, 3].flatMap((c) => [p[c]!, p[c + 4]!, p[c + 8]!, c === 3 ? 1 : 0]);
      gl.uniformMatrix4fv(at("pose"), false, columns);
      gl.uniform3fv(at("colour"), body.colour);
      gl.bindBuffer(gl.ARRAY_BUFFER, body.places);
      gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
      gl.drawArrays(gl.TRIANGLES, 0, body.count);
    });
    gl.uniform1f(at("lit"), 0);
    gl.uniformMatrix4fv(at("pose"), false, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    gl.uniform3fv(at("colour"), [0.84, 0.37, 0]);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#line);
    for (const path of paths) {
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(path), gl.DYNAMIC_DRAW);
      gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
      gl.drawArrays(gl.LINE_STRIP, 0, path.length / 3);
    }
  }
}
