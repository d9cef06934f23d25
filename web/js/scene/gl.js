// Draws thick lines and plain solids with WebGL2.
//
// A line's points lie in a texture, and a quad is spanned around each of its pieces: so one buffer
// serves any thinning, and machines without graphics hardware draw it tens of times as fast as with
// instances. A point is VERTEX numbers: its place, the value that gives its colour, a way that is
// added `factor` times, and the length so far (minus that and one on a rapid move).

/**
 * @import { Vector } from "./camera.js"
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

/** @typedef {{ model: Float32Array, top: number, colour: number[], strength?: number }} Solid a tube to draw */

/** @typedef {Record<string, number | Float32Array | number[]>} Uniforms */

export const VERTEX = 8;
const WIDTH = 1024; // of a texture of points: 512 points

/**
 * The numbers of a point.
 * @param {Vector} place
 * @param {{ way?: Vector, value?: number, along?: number, faint?: boolean }} [more]
 */
export const vertex = (place, { way = [0, 0, 0], value = 0 } = {}) => [...place, value, ...way, 0];

const LINE_VERTEX = `#version 300 es
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

const LINE_FRAGMENT = `#version 300 es
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

// A tube from z = 0 to 1 of radius 1, narrowed towards its top; lit from over the reader's
// shoulder.
const SOLID_VERTEX = `#version 300 es
layout(location = 0) in vec3 place; layout(location = 1) in vec3 normal;
uniform mat4 camera, model; uniform float top;
out vec3 outward;
void main() {
  vec3 narrowed = vec3(place.xy * mix(1.0, top, place.z), place.z);
  outward = mat3(model) * normal;
  gl_Position = camera * (model * vec4(narrowed, 1.0));
}`;

const SOLID_FRAGMENT = `#version 300 es
precision highp float;
in vec3 outward;
uniform vec3 colour, light; uniform float strength; uniform bool plain;
out vec4 pixel;
void main() {
  float lit = plain ? 1.0 : 0.5 + 0.5 * dot(normalize(outward), light);
  pixel = vec4(plain ? colour : colour * (0.55 + 0.5 * lit * lit), strength);
}`;

const SIDES = 32;

/**
 * Draws on a canvas, which is clear until its first picture; `null` where the browser has no WebGL2.
 * @param {HTMLCanvasElement} canvas
 */
export function painterOn(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: true, stencil: true, powerPreference: "low-power" });
  return gl && new Painter(gl);
}

export class Painter {
  #gl;
  #line;
  #solid;
  #tube;
  /** @type {Line[]} */
  #lines = [];
  /** @type {Line | undefined} */
  #piece;
  #nothing; // lines take their points from textures

  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.#gl = gl;
    this.#line = program(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.#solid = program(gl, SOLID_VERTEX, SOLID_FRAGMENT);
    this.#tube = tube(gl);
    this.#nothing = gl.createVertexArray();
    gl.useProgram(this.#line.program);
    gl.uniform1i(gl.getUniformLocation(this.#line.program, "ramp"), 0);
    gl.uniform1i(gl.getUniformLocation(this.#line.program, "points"), 1);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    parameters(gl, gl.LINEAR);
    gl.activeTexture(gl.TEXTURE1);
  }

  /** What it draws with. */
  get gl() {
    return this.#gl;
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
  line(points, pairs = false) {
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
  clearLines() {
    for (const { texture } of this.#lines) this.#gl.deleteTexture(texture);
    this.#lines = [];
    this.#piece = undefined;
  }

  /**
   * Begins a picture of `width` by `height` pixels.
   * @param {{
   *   camera: Float32Array, width: number, height: number, paper: number[], rapidColour: number[],
   *   light: number[], pixelsPerMm: number,
   * }} picture
   */
  begin({ camera, width, height, paper, rapidColour, light, pixelsPerMm }) {
    const gl = this.#gl;
    gl.viewport(0, 0, width, height);
    gl.colorMask(true, true, true, true);
    gl.clearColor(paper[0], paper[1], paper[2], 1);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.colorMask(true, true, true, false); // what is drawn stays as opaque as the paper
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE); // smooth edges that still hide what is behind them
    gl.useProgram(this.#line.program);
    this.#line.set({ camera, size: [width, height], paper, rapidColour, pixelsPerMm });
    gl.useProgram(this.#solid.program);
    this.#solid.set({ camera, light });
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
    gl.useProgram(this.#line.program);
    const { texture, pairs, count } = line;
    const [stride, ahead] = pairs ? [2, 1] : [every, every];
    const pieces = pairs ? count / 2 : Math.ceil((count - 1) / every);
    this.#line.set({
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
    else this.#piece = this.line(points, true);
    gl.depthFunc(gl.ALWAYS);
    this.draw(this.#piece, style);
    gl.depthFunc(gl.LEQUAL);
  }

  /**
   * Draws tubes { model, top, colour, strength } as one body that what is behind it shines through.
   * @param {Solid[]} parts
   */
  solids(parts) {
    asBody(this.#gl, () => this.#tubes(parts, { plain: 0 }));
  }

  /**
   * Draws a line as a body that what is behind it shines through.
   * @param {Line} line
   * @param {LineStyle} style
   */
  veil(line, style) {
    asBody(this.#gl, () => this.draw(line, style));
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
    gl.useProgram(this.#solid.program);
    gl.bindVertexArray(this.#tube.array);
    this.#solid.set(style);
    for (const { model, top, colour, strength = 1 } of parts) {
      this.#solid.set({ model, top, colour, strength });
      gl.drawArrays(gl.TRIANGLES, 0, this.#tube.count);
    }
  }
}

/**
 * Draws a translucent body by `draw()`: first only how near its surface is, then its colour where it is the surface, so
 * that none of its own insides show.
 * @param {WebGL2RenderingContext} gl
 * @param {any} draw
 */
export function asBody(gl, draw) {
  gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
  gl.colorMask(false, false, false, false);
  draw();
  gl.colorMask(true, true, true, false);
  gl.depthFunc(gl.EQUAL);
  blended(gl, draw);
  gl.depthFunc(gl.LEQUAL);
  gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
}

/**
 * Draws by `draw()` over what is there, as opaque as its pixels say.
 * @param {WebGL2RenderingContext} gl
 * @param {any} draw
 */
export function blended(gl, draw) {
  gl.enable(gl.BLEND);
  gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  draw();
  gl.disable(gl.BLEND);
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {number} filter
 */
export function parameters(gl, filter) {
  for (const [key, value] of [
    [gl.TEXTURE_MIN_FILTER, filter],
    [gl.TEXTURE_MAG_FILTER, filter],
    [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
    [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE],
  ]) {
    gl.texParameteri(gl.TEXTURE_2D, key, value);
  }
}

/**
 * A program of a vertex and a fragment shader, whose `set(values)` takes uniforms by name.
 * @param {WebGL2RenderingContext} gl
 * @param {string[]} sources
 */
export function program(gl, ...sources) {
  const made = gl.createProgram();
  for (const [i, source] of sources.entries()) {
    const shader = gl.createShader(i ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER);
    if (!shader) continue; // the context is lost
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = (gl.getAttachedShaders(made) ?? []).map((shader) => gl.getShaderInfoLog(shader));
    throw new Error(`The shaders do not link: ${[gl.getProgramInfoLog(made), ...logs].join(" ")}`);
  }
  const places = new Map();
  /** @param {Uniforms} values */
  const set = (values) => {
    for (const [name, value] of Object.entries(values)) {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(made, name));
      const place = places.get(name);
      if (typeof value === "number") gl.uniform1f(place, value);
      else if (value.length === 16) gl.uniformMatrix4fv(place, false, value);
      else if (value.length === 2) gl.uniform2fv(place, value);
      else gl.uniform3fv(place, value);
    }
  };
  return { program: made, set };
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
