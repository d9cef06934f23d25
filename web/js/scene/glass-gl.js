// Draws bodies like glass with WebGL2: plain flat faces that hide nothing.

import { blended, program } from "./gl.js";

const VERTEX = `#version 300 es
layout(location = 0) in vec3 place;
uniform mat4 camera, frame;
void main() { gl_Position = camera * (frame * vec4(place, 1.0)); }`;

const FRAGMENT = `#version 300 es
precision highp float;
uniform vec3 colour; uniform float strength;
out vec4 pixel;
void main() { pixel = vec4(colour, strength); }`;

/** Draws glass with a painter's WebGL. */
export class GlassPainter {
  #gl;
  #program;
  /** @type {{ array: WebGLVertexArrayObject, buffer: WebGLBuffer, count: number, isFan: boolean }[]} */
  #faces = []; // { array, buffer, count, isFan }

  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.#gl = gl;
    this.#program = program(gl, VERTEX, FRAGMENT);
  }

  /**
   * Takes over faces: `triangles` and outlines of flat faces, `fans`, each as x, y, z of its corners.
   * @param {{ triangles: ArrayLike<number>, fans: ArrayLike<number>[] }} faces
   */
  take({ triangles, fans }) {
    this.clear();
    this.#add(triangles, false);
    for (const fan of fans) this.#add(fan, true);
  }

  /**
   * @param {ArrayLike<number>} places
   * @param {boolean} isFan
   */
  #add(places, isFan) {
    const gl = this.#gl;
    const [array, buffer] = [gl.createVertexArray(), gl.createBuffer()];
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(places), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    gl.bindVertexArray(null);
    this.#faces.push({ array, buffer, count: places.length / 3, isFan });
  }

  /** Frees the faces. */
  clear() {
    for (const { array, buffer } of this.#faces) {
      this.#gl.deleteVertexArray(array);
      this.#gl.deleteBuffer(buffer);
    }
    this.#faces = [];
  }

  /**
   * Draws the faces; `style` = { camera, frame, colour, strength }.
   * @param {import("./gl.js").Uniforms} style
   */
  draw(style) {
    const gl = this.#gl;
    gl.useProgram(this.#program.program);
    this.#program.set(style);
    gl.depthMask(false);
    gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    blended(gl, () => {
      for (const { array, count, isFan } of this.#faces) {
        gl.bindVertexArray(array);
        if (isFan) this.#fill(count);
        else gl.drawArrays(gl.TRIANGLES, 0, count);
      }
    });
    gl.bindVertexArray(null);
    gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    gl.depthMask(true);
  }

  /**
   * Fills an outline, which need not be convex: triangles from its first corner cover each place inside an odd number of
   * times, and drawing a place for the first time ends it.
   * @param {number} count
   */
  #fill(count) {
    const gl = this.#gl;
    gl.enable(gl.STENCIL_TEST);
    gl.colorMask(false, false, false, false);
    gl.stencilFunc(gl.ALWAYS, 0, 1);
    gl.stencilOp(gl.INVERT, gl.INVERT, gl.INVERT);
    gl.drawArrays(gl.TRIANGLE_FAN, 0, count);
    gl.colorMask(true, true, true, false);
    gl.stencilFunc(gl.EQUAL, 1, 1);
    gl.stencilOp(gl.ZERO, gl.ZERO, gl.ZERO);
    gl.drawArrays(gl.TRIANGLE_FAN, 0, count);
    gl.disable(gl.STENCIL_TEST);
  }
}
