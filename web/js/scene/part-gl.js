// Draws the part as it is cut: the core's mesh, each place moved by its deviation times a factor, coloured by the
// deviation along the surface's normal. Paths below its surface shine through.

import { asBody, parameters, program } from "./gl.js";

const STRENGTH = 0.8; // of its colour over a path below its surface

const VERTEX = `#version 300 es
layout(location = 0) in vec3 place; layout(location = 1) in vec4 shift;
uniform mat4 camera, frame; uniform float factor;
out vec3 nominal; out vec3 moved; out vec2 deviation;
void main() {
  nominal = place;
  moved = (frame * vec4(place + factor * shift.xyz, 1.0)).xyz;
  deviation = shift.zw;
  gl_Position = camera * vec4(moved, 1.0);
}`;

// Steep surface is a wall, whose excess counts; of any other the height counts, across the slope.
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 nominal; in vec3 moved; in vec2 deviation;
uniform sampler2D scale; uniform vec3 light, eye; uniform float largest, strength;
out vec4 pixel;
void main() {
  float level = abs(normalize(cross(dFdx(nominal), dFdy(nominal))).z);
  float excess = mix(deviation.y, deviation.x * level, smoothstep(0.4, 0.65, level));
  vec3 outward = normalize(cross(dFdx(moved), dFdy(moved)));
  float lit = 0.5 + 0.5 * dot(outward * (dot(outward, eye) < 0.0 ? -1.0 : 1.0), light);
  vec3 own = texture(scale, vec2(0.5 + 0.498 * clamp(excess / largest, -1.0, 1.0), 0.5)).rgb;
  pixel = vec4(own * (0.52 + 0.5 * lit * lit), strength);
}`;

/**
 * @import { PartMesh } from "../../pkg/armill.js"
 * @import { Uniforms } from "./gl.js"
 */

/** Draws parts with a painter's WebGL. */
export class PartPainter {
  #gl;
  #program;
  #scale;
  /** @type {WebGLBuffer[]} */
  #buffers = [];
  /** @type {Record<string, WebGLVertexArrayObject>} */
  #arrays = {}; // vertex arrays by "before" and "after"
  #count = 0;

  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.#gl = gl;
    this.#program = program(gl, VERTEX, FRAGMENT);
    gl.useProgram(this.#program.program);
    gl.uniform1i(gl.getUniformLocation(this.#program.program, "scale"), 2);
    this.#scale = gl.createTexture();
    this.#onScale(() => parameters(gl, gl.LINEAR));
  }

  /**
   * Runs with the scale's texture bound; lines keep theirs.
   * @param {() => void} run
   */
  #onScale(run) {
    const gl = this.#gl;
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, this.#scale);
    run();
    gl.activeTexture(gl.TEXTURE1);
  }

  /**
   * The colours of deviations, as a row of RGBA pixels.
   * @param {Uint8Array} texels
   */
  colours(texels) {
    const gl = this.#gl;
    this.#onScale(() =>
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, texels.length / 4, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels),
    );
  }

  /**
   * Takes over a mesh of the core.
   * @param {PartMesh} mesh
   */
  take({ places_mm, before_mm, after_mm, triangles }) {
    this.clear();
    const gl = this.#gl;
    /**
     * @param {number} target
     * @param {Float32Array | Uint32Array} numbers
     */
    const buffer = (target, numbers) => {
      const made = gl.createBuffer();
      gl.bindBuffer(target, made);
      gl.bufferData(target, numbers, gl.STATIC_DRAW);
      this.#buffers.push(made);
      return made;
    };
    /**
     * @param {number} index
     * @param {number} size
     * @param {WebGLBuffer} filled
     */
    const slot = (index, size, filled) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, filled);
      gl.enableVertexAttribArray(index);
      gl.vertexAttribPointer(index, size, gl.FLOAT, false, 0, 0);
    };
    gl.bindVertexArray(null);
    const places = buffer(gl.ARRAY_BUFFER, places_mm);
    const elements = buffer(gl.ELEMENT_ARRAY_BUFFER, triangles);
    for (const [side, shifts] of Object.entries({ before: before_mm, after: after_mm })) {
      const moved = buffer(gl.ARRAY_BUFFER, shifts);
      this.#arrays[side] = gl.createVertexArray();
      gl.bindVertexArray(this.#arrays[side]);
      slot(0, 3, places);
      slot(1, 4, moved);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, elements);
    }
    gl.bindVertexArray(null);
    this.#count = triangles.length;
  }

  /** Frees the mesh. */
  clear() {
    for (const buffer of this.#buffers) this.#gl.deleteBuffer(buffer);
    for (const array of Object.values(this.#arrays)) this.#gl.deleteVertexArray(array);
    [this.#buffers, this.#arrays, this.#count] = [[], {}, 0];
  }

  /**
   * Draws a side of the mesh; `style` = { camera, frame, factor, light, eye, largest }. Paths on the surface are to be seen.
   * @param {string} side
   * @param {Uniforms} style
   */
  draw(side, style) {
    const gl = this.#gl;
    if (!this.#count) return;
    gl.useProgram(this.#program.program);
    this.#program.set({ ...style, strength: STRENGTH });
    gl.bindVertexArray(this.#arrays[side]);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 2);
    asBody(gl, () => gl.drawElements(gl.TRIANGLES, this.#count, gl.UNSIGNED_INT, 0));
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.bindVertexArray(null);
  }
}
