// What everything that is drawn with WebGL2 needs: programs, textures, and bodies that let things shine through.

/** @typedef {Record<string, number | Float32Array | number[]>} Uniforms */

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
