// Draws tubes with WebGL2, plain or as translucent bodies.

import { asBody, program } from "./gl.js";

/** @import { Uniforms } from "./gl.js" */

/** @typedef {{ model: Float32Array, top: number, colour: number[], strength?: number }} Solid a tube to draw */

// A tube from z = 0 to 1 of radius 1, narrowed towards its top; lit from over the reader's
// shoulder.
const VERTEX = `#version 300 es
layout(location = 0) in vec3 place; layout(location = 1) in vec3 normal;
uniform mat4 camera, model; uniform float top;
out vec3 outward;
void main() {
  vec3 narrowed = vec3(place.xy * mix(1.0, top, place.z), place.z);
  outward = mat3(model) * normal;
  gl_Position = camera * (model * vec4(narrowed, 1.0));
}`;

const FRAGMENT = `#version 300 es
precision highp float;
in vec3 outward;
uniform vec3 colour, light; uniform float strength; uniform bool plain;
out vec4 pixel;
void main() {
  float lit = plain ? 1.0 : 0.5 + 0.5 * dot(normalize(outward), light);
  pixel = vec4(plain ? colour : colour * (0.55 + 0.5 * lit * lit), strength);
}`;

const SIDES = 32;

/** Draws tubes with a painter's WebGL. */
export class TubePainter {
  #gl;
  #program;
  #tube;

  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.#gl = gl;
    this.#program = program(gl, VERTEX, FRAGMENT);
    this.#tube = tube(gl);
  }

  /**
   * What all tubes of a picture have in common.
   * @param {Uniforms} picture
   */
  begin(picture) {
    this.#gl.useProgram(this.#program.program);
    this.#program.set(picture);
  }

  /**
   * Draws tubes { model, top, colour, strength } as one body that what is behind it shines through.
   * @param {Solid[]} parts
   */
  solids(parts) {
    asBody(this.#gl, () => this.#tubes(parts, { plain: 0 }));
  }

  /**
   * Draws tubes in plain colour that hide nothing.
   * @param {Solid[]} parts
   */
  stains(parts) {
    const gl = this.#gl;
    gl.depthMask(false);
    this.#tubes(parts, { plain: 1 });
    gl.depthMask(true);
  }

  /**
   * @param {Solid[]} parts
   * @param {Uniforms} style
   */
  #tubes(parts, style) {
    const gl = this.#gl;
    gl.useProgram(this.#program.program);
    gl.bindVertexArray(this.#tube.array);
    this.#program.set(style);
    for (const { model, top, colour, strength = 1 } of parts) {
      this.#program.set({ model, top, colour, strength });
      gl.drawArrays(gl.TRIANGLES, 0, this.#tube.count);
    }
  }
}

/** @param {WebGL2RenderingContext} gl */
function tube(gl) {
  const numbers = [];
  /** @param {number} i */
  const rim = (i) => [Math.cos((2 * Math.PI * i) / SIDES), Math.sin((2 * Math.PI * i) / SIDES)];
  for (let i = 0; i < SIDES; i++) {
    const [[ax, ay], [bx, by]] = [rim(i), rim(i + 1)];
    for (const [x, y, z] of [
      [ax, ay, 0],
      [bx, by, 0],
      [ax, ay, 1],
      [ax, ay, 1],
      [bx, by, 0],
      [bx, by, 1],
    ])
      numbers.push(x, y, z, x, y, 0);
    for (const [x, y] of [
      [0, 0],
      [ax, ay],
      [bx, by],
    ])
      numbers.push(x, y, 1, 0, 0, 1);
    for (const [x, y] of [
      [0, 0],
      [bx, by],
      [ax, ay],
    ])
      numbers.push(x, y, 0, 0, 0, -1);
  }
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
  for (const slot of [0, 1]) {
    gl.enableVertexAttribArray(slot);
    gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 24, slot * 12);
  }
  gl.bindVertexArray(null);
  return { array, count: numbers.length / 6 };
}
