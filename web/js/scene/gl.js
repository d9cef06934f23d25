// Draws thick lines and plain solids with WebGL2.
//
// A line is an instanced quad around each of its pieces. Its points are VERTEX numbers each: place, way (added `factor` times), value that
// gives the colour, length so far, and whether it is drawn in full strength.

export const VERTEX = 9;

const LINE_VERTEX = `#version 300 es
layout(location = 0) in vec3 placeA; layout(location = 1) in vec3 wayA; layout(location = 2) in vec3 factsA;
layout(location = 3) in vec3 placeB; layout(location = 4) in vec3 wayB; layout(location = 5) in vec3 factsB;
uniform mat4 camera; uniform vec2 size; uniform float factor, halfWidth, radius, pixelsPerMm, bias;
out vec3 facts; out vec2 at; out float far; out float reach;
void main() {
  vec4 a = camera * vec4(placeA + wayA * factor, 1.0), b = camera * vec4(placeB + wayB * factor, 1.0);
  float near = 0.1;
  if (a.w < near && b.w < near) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  vec2 from = a.xy / a.w * size * 0.5, to = b.xy / b.w * size * 0.5;
  float whole = distance(from, to);
  vec2 along = whole > 1e-4 ? (to - from) / whole : vec2(1.0, 0.0);
  bool second = gl_VertexID > 1;
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0, end = second ? 1.0 : -1.0;
  vec4 here = second ? b : a;
  reach = max(halfWidth, radius * pixelsPerMm / here.w);
  vec2 off = (along * end + vec2(-along.y, along.x) * side) * (reach + 1.0);
  at = vec2((second ? whole : 0.0) + end * (reach + 1.0), side * (reach + 1.0));
  far = whole;
  facts = second ? factsB : factsA;
  gl_Position = vec4(((second ? to : from) + off) / size * 2.0, here.z / here.w - bias, 1.0);
}`;

const LINE_FRAGMENT = `#version 300 es
precision highp float;
in vec3 facts; in vec2 at; in float far; in float reach;
uniform sampler2D ramp; uniform vec3 colour, paper; uniform float largest, dash, fade;
out vec4 pixel;
void main() {
  float distance = length(vec2(at.x < 0.0 ? at.x : max(at.x - far, 0.0), at.y));
  float cover = clamp(reach - distance + 0.5, 0.0, 1.0);
  if (cover <= 0.0 || (dash > 0.0 && fract(facts.y / dash) > 0.6)) discard;
  vec3 own = largest > 0.0 ? texture(ramp, vec2(clamp(facts.x / largest, 0.0, 1.0) * 0.996 + 0.002, 0.5)).rgb : colour;
  pixel = vec4(mix(own, paper, max(fade, facts.z < 0.5 ? 0.6 : 0.0)), cover);
}`;

// A tube from z = 0 to 1 of radius 1, narrowed towards its top; lit from over the reader's shoulder.
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

const SIDES = 40;

/** Draws on a canvas; `null` where the browser has no WebGL2. */
export function painterOn(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, powerPreference: "low-power" });
  return gl && new Painter(gl);
}

class Painter {
  #gl;
  #line;
  #solid;
  #tube;
  #lines = [];
  #piece;

  constructor(gl) {
    this.#gl = gl;
    this.#line = program(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.#solid = program(gl, SOLID_VERTEX, SOLID_FRAGMENT);
    this.#tube = tube(gl);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const [key, value] of [["MIN_FILTER", "LINEAR"], ["MAG_FILTER", "LINEAR"], ["WRAP_S", "CLAMP_TO_EDGE"], ["WRAP_T", "CLAMP_TO_EDGE"]]) {
      gl.texParameteri(gl.TEXTURE_2D, gl[`TEXTURE_${key}`], gl[value]);
    }
  }

  /** The colours that values are drawn in, as a row of RGBA pixels. */
  ramp(texels) {
    const gl = this.#gl;
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, texels.length / 4, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
  }

  /** A line to draw later: each point joined to the next, or (`pairs`) every second one to its next. */
  line(points, pairs = false) {
    const line = { points, pairs, levels: new Map() };
    this.#lines.push(line);
    return line;
  }

  /** The line with every so many of its points, rounded down to a power of two; made when first asked for. */
  #level(line, every) {
    const step = line.pairs ? 1 : 2 ** Math.floor(Math.log2(every));
    let level = line.levels.get(step);
    if (!level) line.levels.set(step, (level = this.#made(thinned(line.points, step), line.pairs)));
    return level;
  }

  #made(points, pairs) {
    const gl = this.#gl;
    const [array, buffer] = [gl.createVertexArray(), gl.createBuffer()];
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, points, gl.STATIC_DRAW);
    for (let slot = 0; slot < 6; slot++) {
      gl.enableVertexAttribArray(slot);
      gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, VERTEX * 4 * (pairs ? 2 : 1), slot * 12);
      gl.vertexAttribDivisor(slot, 1);
    }
    const count = points.length / VERTEX;
    return { array, buffer, pieces: Math.max(0, pairs ? count / 2 : count - 1) };
  }

  /** Forgets every line. */
  clearLines() {
    for (const { array, buffer } of this.#lines.flatMap(({ levels }) => [...levels.values()])) {
      this.#gl.deleteVertexArray(array);
      this.#gl.deleteBuffer(buffer);
    }
    this.#lines = [];
    this.#piece = undefined;
  }

  /** Begins a picture of `width` by `height` pixels. */
  begin({ camera, width, height, paper, light, pixelsPerMm }) {
    const gl = this.#gl;
    gl.viewport(0, 0, width, height);
    gl.clearColor(...paper, 1);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE); // smooth edges that still hide what is behind them
    gl.useProgram(this.#line.program);
    this.#line.set({ camera, size: [width, height], paper, pixelsPerMm });
    gl.useProgram(this.#solid.program);
    this.#solid.set({ camera, light });
  }

  /**
   * Draws a line; lengths in pixels but for `radius` and `dash` [mm]. Of points that crowd in a pixel only `every` so many
   * need to be joined. */
  draw(line, { factor = 0, width = 2, radius = 0, colour = [0, 0, 0], largest = 0, dash = 0, fade = 0, bias = 0, every = 1 }) {
    const gl = this.#gl;
    gl.useProgram(this.#line.program);
    this.#line.set({ factor, halfWidth: width / 2, radius, colour, largest, dash, fade, bias });
    const { array, pieces } = this.#level(line, every);
    gl.bindVertexArray(array);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, pieces);
  }

  /** Draws one piece of a line that is not kept, from its two points; a piece without length is a dot. */
  dot(points, style) {
    const gl = this.#gl;
    this.#piece ??= this.line(points, true);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#level(this.#piece, 1).buffer);
    gl.bufferData(gl.ARRAY_BUFFER, points, gl.DYNAMIC_DRAW);
    this.draw(this.#piece, style);
  }

  /** Draws tubes { model, top, colour } as one body that what is behind it shines through. */
  solids(parts) {
    const gl = this.#gl;
    gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    // First only how near its surface is, then its colour where it is the surface.
    gl.colorMask(false, false, false, false);
    this.#tubes(parts, { plain: 0, strength: 1 });
    gl.colorMask(true, true, true, true);
    gl.depthFunc(gl.EQUAL);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    this.#tubes(parts, { plain: 0, strength: 0.7 });
    gl.disable(gl.BLEND);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE);
  }

  /** Draws tubes in plain colour that hide nothing. */
  stains(parts) {
    const gl = this.#gl;
    gl.depthMask(false);
    this.#tubes(parts, { plain: 1, strength: 1 });
    gl.depthMask(true);
  }

  #tubes(parts, style) {
    const gl = this.#gl;
    gl.useProgram(this.#solid.program);
    gl.bindVertexArray(this.#tube.array);
    this.#solid.set(style);
    for (const { model, top, colour } of parts) {
      this.#solid.set({ model, top, colour });
      gl.drawArrays(gl.TRIANGLES, 0, this.#tube.count);
    }
  }
}

/** Every so many points of a line, and its last. */
function thinned(points, step) {
  if (step === 1) return points;
  const count = points.length / VERTEX;
  const kept = new Float32Array((Math.ceil((count - 1) / step) + 1) * VERTEX);
  for (let to = 0; to < kept.length; to += VERTEX) {
    const from = Math.min(to * step, (count - 1) * VERTEX);
    kept.set(points.subarray(from, from + VERTEX), to);
  }
  return kept;
}

function program(gl, ...sources) {
  const made = gl.createProgram();
  for (const [i, source] of sources.entries()) {
    const shader = gl.createShader(i ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = gl.getAttachedShaders(made).map((shader) => gl.getShaderInfoLog(shader));
    throw new Error(`The shaders do not link: ${[gl.getProgramInfoLog(made), ...logs].join(" ")}`);
  }
  const places = new Map();
  const set = (values) => {
    for (const [name, value] of Object.entries(values)) {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(made, name));
      const place = places.get(name);
      if (typeof value === "number") gl.uniform1f(place, value);
      else if (value.length === 16) gl.uniformMatrix4fv(place, false, value);
      else gl[`uniform${value.length}fv`](place, value);
    }
  };
  return { program: made, set };
}

function tube(gl) {
  const numbers = [];
  const rim = (i) => [Math.cos((2 * Math.PI * i) / SIDES), Math.sin((2 * Math.PI * i) / SIDES)];
  for (let i = 0; i < SIDES; i++) {
    const [[ax, ay], [bx, by]] = [rim(i), rim(i + 1)];
    for (const [x, y, z] of [[ax, ay, 0], [bx, by, 0], [ax, ay, 1], [ax, ay, 1], [bx, by, 0], [bx, by, 1]]) numbers.push(x, y, z, x, y, 0);
    for (const [x, y] of [[0, 0], [ax, ay], [bx, by]]) numbers.push(x, y, 1, 0, 0, 1);
    for (const [x, y] of [[0, 0], [bx, by], [ax, ay]]) numbers.push(x, y, 0, 0, 0, -1);
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
