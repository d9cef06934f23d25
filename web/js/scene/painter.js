// Draws lines and tubes on a canvas with WebGL2, picture by picture.

import { LinePainter } from "./line-gl.js";
import { TubePainter } from "./tube-gl.js";

/**
 * Draws on a canvas, which is clear until its first picture; `null` where the browser has no WebGL2.
 * @param {HTMLCanvasElement} canvas
 */
export function painterOn(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: true, stencil: true, powerPreference: "low-power" });
  return gl && new Painter(gl);
}

export class Painter {
  /** @param {WebGL2RenderingContext} gl what it draws with */
  constructor(gl) {
    this.gl = gl;
    this.lines = new LinePainter(gl);
    this.tubes = new TubePainter(gl);
  }

  /**
   * Begins a picture of `width` by `height` pixels.
   * @param {{
   *   camera: Float32Array, width: number, height: number, paper: number[], rapidColour: number[],
   *   light: number[], pixelsPerMm: number,
   * }} picture
   */
  begin({ camera, width, height, paper, rapidColour, light, pixelsPerMm }) {
    const { gl } = this;
    gl.viewport(0, 0, width, height);
    gl.colorMask(true, true, true, true);
    gl.clearColor(paper[0], paper[1], paper[2], 1);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.colorMask(true, true, true, false); // what is drawn stays as opaque as the paper
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE); // smooth edges that still hide what is behind them
    this.lines.begin({ camera, size: [width, height], paper, rapidColour, pixelsPerMm });
    this.tubes.begin({ camera, light });
  }
}
