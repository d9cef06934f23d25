// Draws thick lines with WebGL2.
//
// A line's points lie in a texture, and a quad is spanned around each of its pieces: so one buffer
// serves any thinning, and machines without graphics hardware draw it tens of times as fast as with
// instances. A point is VERTEX numbers: its place, the value that gives its colour, a way that is
// added `factor` times, and the length so far (minus that and one on a rapid move).

import { asBody, parameters, program } from "./gl.js";

/**
 * @import { Vector } from "./camera.js"
 * @import { Uniforms } from "./gl.js"
 */

/** @typedef {{ texture: WebGLTexture, pairs: boolean, count: number }} Line one to draw */

/**
 * How a line is drawn; lengths in pixels but for `radius` and `dash` [mm]. Of points that crowd in a pixel only
 * `every` so many need to be joined.
 *
 * @typedef {{
 *   factor?: number,
 *   width?: number,
 *   radius?: number,
 *   colour?: number[],
 *   largest?: number,
 *   dash?: number,
 *   fade?: number,
 *   bias?: number,
 *   every?: number,
 *   rapid?: number,
 *   strength?: number,
 * }} LineStyle
 */

export const VERTEX = 8;
const WIDTH = 1024; // of a texture of points: 512 points

/**
 * The numbers of a point.
 * @param {Vector} place
 * @param {{ way?: Vector, value?: number, along?: number, faint?: boolean }} [more]
 */
export const vertex = (place, { way = [0, 0, 0], value = 0 } = {}) => [...place, value, ...way, 0];

const VERTEX_SHADER = `#version 300 es
uniform highp sampler2D points;
uniform mat4 camera; uniform vec2 size; uniform float factor, halfWidth, rapid, radius, pixelsPerMm, bias, stride, ahead, last;
out vec2 facts; out vec2 at; out float far; out float reach; flat out float isRapid;
vec4 texel(int i) {
  int width = textureSize(points, 0).x;
  return texelFetch(points, ivec2(i % width, i / width), 0);
}
void main() {
  int piece = gl_VertexID / 6, corner = gl_VertexID % 6;
  int first = piece * int(stride), next = min(first + int(ahead), int(last));
  vec4 placeA = texel(2 * first), wayA = texel(2 * first + 1), placeB = texel(2 * next), wayB = texel(2 * next + 1);
  vec4 a = camera * vec4(placeA.xyz + wayA.xyz * factor, 1.0), b = camera * vec4(placeB.xyz + wayB.xyz * factor, 1.0);
  float near = 0.1;
  isRapid = wayA.w < 0.0 || wayB.w < 0.0 ? 1.0 : 0.0;
  if ((a.w < near && b.w < near) || (isRapid > 0.5 && rapid <= 0.0)) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  vec2 from = a.xy / a.w * size * 0.5, to = b.xy / b.w * size * 0.5;
  float whole = distance(from, to);
  vec2 along = whole > 1e-4 ? (to - from) / whole : vec2(1.0, 0.0);
  bool second = corner == 2 || corner == 3 || corner == 5;
  float side = corner == 0 || corner == 2 || corner == 3 ? -1.0 : 1.0, end = second ? 1.0 : -1.0;
  vec4 here = second ? b : a;
  reach = isRapid > 0.5 ? rapid / 2.0 : max(halfWidth, radius * pixelsPerMm / here.w);
  vec2 off = (along * end + vec2(-along.y, along.x) * side) * (reach + 1.0);
  at = vec2((second ? whole : 0.0) + end * (reach + 1.0), side * (reach + 1.0));
  far = whole;
  facts = second ? vec2(placeB.w, wayB.w) : vec2(placeA.w, wayA.w);
  gl_Position = vec4(((second ? to : from) + off) / size * 2.0, here.z / here.w - bias, 1.0);
}`;

const FRAGMENT_SHADER = `#version 300 es
precision highp float;
in vec2 facts; in vec2 at; in float far; in float reach; flat in float isRapid;
uniform sampler2D ramp; uniform vec3 colour, paper, rapidColour; uniform float largest, dash, fade, strength;
out vec4 pixel;
void main() {
  float distance = length(vec2(at.x < 0.0 ? at.x : max(at.x - far, 0.0), at.y));
  float cover = clamp(reach - distance + 0.5, 0.0, 1.0);
  // The nearest piece gives a veil its colour: none may be thin there.
  bool veil = strength < 1.0;
  if (cover <= (veil ? 0.5 : 0.0) || (dash > 0.0 && fract(abs(facts.y) / dash) > 0.6)) discard;
  vec3 own = largest > 0.0 ? texture(ramp, vec2(clamp(facts.x / largest, 0.0, 1.0) * 0.996 + 0.002, 0.5)).rgb : colour;
  pixel = vec4(isRapid > 0.5 ? rapidColour : mix(own, paper, fade), veil ? strength : cover);
}`;

/** Draws lines with a painter's WebGL. */
export class LinePainter {
  #gl;
  #program;
  /** @type {Line[]} */
  #lines = [];
  /** @type {Line | undefined} */
  #piece;
  #nothing; // lines take their points from textures

  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.#gl = gl;
    this.#program = program(gl, VERTEX_SHADER, FRAGMENT_SHADER);
    this.#nothing = gl.createVertexArray();
    gl.useProgram(this.#program.program);
    gl.uniform1i(gl.getUniformLocation(this.#program.program, "ramp"), 0);
    gl.uniform1i(gl.getUniformLocation(this.#program.program, "points"), 1);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    parameters(gl, gl.LINEAR);
    gl.activeTexture(gl.TEXTURE1);
  }

  /**
   * The colours that values are drawn in, as a row of RGBA pixels.
   * @param {Uint8Array} texels
   */
  ramp(texels) {
    const gl = this.#gl;
    gl.activeTexture(gl.TEXTURE0);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, texels.length / 4, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
    gl.activeTexture(gl.TEXTURE1);
  }

  /**
   * A line to draw later: each point joined to the next, or (`pairs`) every second one to its next.
   * @param {Float32Array} points
   * @param {boolean} [pairs]
   */
  take(points, pairs = false) {
    const gl = this.#gl;
    const line = { texture: gl.createTexture(), pairs, count: 0 };
    gl.bindTexture(gl.TEXTURE_2D, line.texture);
    parameters(gl, gl.NEAREST);
    this.#fill(line, points);
    this.#lines.push(line);
    return line;
  }

  /**
   * @param {Line} line
   * @param {Float32Array} points
   */
  #fill(line, points) {
    const gl = this.#gl;
    const [texels, rows] = [points.length / 4, Math.ceil(points.length / 4 / WIDTH)];
    const width = Math.min(WIDTH, texels);
    const whole = new Float32Array(width * rows * 4);
    whole.set(points);
    line.count = points.length / VERTEX;
    gl.bindTexture(gl.TEXTURE_2D, line.texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, width, rows, 0, gl.RGBA, gl.FLOAT, whole);
  }

  /** Forgets every line. */
  clear() {
    for (const { texture } of this.#lines) this.#gl.deleteTexture(texture);
    this.#lines = [];
    this.#piece = undefined;
  }

  /**
   * What all lines of a picture have in common.
   * @param {Uniforms} picture
   */
  begin(picture) {
    this.#gl.useProgram(this.#program.program);
    this.#program.set(picture);
  }

  /**
   * Draws a line; lengths in pixels but for `radius` and `dash` [mm]. Rapid moves are `rapid` wide, and left out if that is
   * 0. Of points that crowd in a pixel only `every` so many need to be joined.
   * @param {Line} line
   * @param {LineStyle} style
   */
  draw(line, style) {
    const { factor = 0, width = 2, rapid = 0, radius = 0, colour = [0, 0, 0], largest = 0 } = style;
    const { dash = 0, fade = 0, bias = 0, every = 1, strength = 1 } = style;
    const gl = this.#gl;
    gl.useProgram(this.#program.program);
    const { texture, pairs, count } = line;
    const [stride, ahead] = pairs ? [2, 1] : [every, every];
    const pieces = pairs ? count / 2 : Math.ceil((count - 1) / every);
    this.#program.set({
      factor,
      halfWidth: width / 2,
      rapid,
      radius,
      colour,
      largest,
      dash,
      fade,
      strength,
      bias,
      stride,
      ahead,
      last: count - 1,
    });
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.bindVertexArray(this.#nothing);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * pieces);
  }

  /**
   * Draws one piece of a line that is not kept, from its two points; a piece without length is a
   * dot. Nothing hides it.
   * @param {Float32Array} points
   * @param {LineStyle} style
   */
  dot(points, style) {
    const gl = this.#gl;
    if (this.#piece) this.#fill(this.#piece, points);
    else this.#piece = this.take(points, true);
    gl.depthFunc(gl.ALWAYS);
    this.draw(this.#piece, style);
    gl.depthFunc(gl.LEQUAL);
  }

  /**
   * Draws a line as a body that what is behind it shines through.
   * @param {Line} line
   * @param {LineStyle} style
   */
  veil(line, style) {
    asBody(this.#gl, () => this.draw(line, style));
  }
}
