// A camera that looks at a target from a direction: orbit, pan, zoom, fit. Lengths in mm, z up.

/** @typedef {ArrayLike<number> & Iterable<number>} Vector three numbers */

/** @typedef {[low: number[], high: number[]]} Box */

const HALF = Math.tan((15 * Math.PI) / 180); // tangent of half the upright field of view
const MARGIN = 1.08; // around what a fitted picture shows
const RIGHT_ANGLE = Math.PI / 2;

/**
 * Directions to look from: [azimuth, elevation] in degrees.
 * @type {Record<string, [azimuth: number, elevation: number]>}
 */
export const VIEWS = { iso: [-58, 26], top: [-90, 90], front: [-90, 0], side: [0, 0] };

/** @type {(a: Vector, b: Vector) => number} */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** @type {(a: Vector, b: Vector) => number[]} */
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
/** @type {(a: Vector, b: Vector, factor?: number) => number[]} */
export const plus = (a, b, factor = 1) => [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];
/** @type {(a: Vector, b: Vector) => number[]} */
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
/** @type {(a: Vector) => number} */
export const length = (a) => Math.hypot(...a);

export class Camera {
  azimuth = 0; // [rad]
  elevation = 0; // [rad]
  distance = 1000;
  target = [0, 0, 0];
  width = 1;
  height = 1;

  /** The unit vectors to the right, up and out of the picture, towards the eye. */
  axes() {
    const [ca, sa, ce, se] = [
      Math.cos(this.azimuth),
      Math.sin(this.azimuth),
      Math.cos(this.elevation),
      Math.sin(this.elevation),
    ];
    return { right: [-sa, ca, 0], up: [-se * ca, -se * sa, ce], out: [ce * ca, ce * sa, se] };
  }

  /**
   * @param {number} azimuth [rad]
   * @param {number} elevation [rad]
   */
  orbit(azimuth, elevation) {
    this.azimuth = (this.azimuth + azimuth) % (2 * Math.PI);
    this.elevation = Math.min(RIGHT_ANGLE, Math.max(-RIGHT_ANGLE, this.elevation + elevation));
  }

  /**
   * Moves what is seen by so many pixels.
   * @param {number} x
   * @param {number} y
   */
  pan(x, y) {
    const { right, up } = this.axes();
    this.target = plus(plus(this.target, right, -x * this.pixel()), up, y * this.pixel());
  }

  /** @param {number} factor */
  zoom(factor) {
    this.distance = Math.min(1e6, Math.max(0.5, this.distance / factor));
  }

  /** The size of a pixel at the target [mm]. */
  pixel() {
    return (2 * HALF * this.distance) / this.height;
  }

  /**
   * Looks from one of `VIEWS`.
   * @param {[azimuth: number, elevation: number]} view [deg]
   */
  look([azimuth, elevation]) {
    [this.azimuth, this.elevation] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
  }

  /**
   * Looks from a direction in space; from straight above as the view from the top does.
   * @param {number[]} direction
   */
  lookFrom([x, y, z]) {
    this.azimuth = Math.hypot(x, y) > 1e-6 ? Math.atan2(y, x) : -RIGHT_ANGLE;
    this.elevation = Math.atan2(z, Math.hypot(x, y));
  }

  /**
   * Shows all points. At the edges of the picture `above` and `below` pixels are left for what is written there.
   * @param {Vector[]} points
   */
  fit(points, { above = 0, below = 0 } = {}) {
    const { right, up, out } = this.axes();
    const free = Math.max(0.4, 1 - (above + below) / this.height); // share of the height
    const aspect = this.width / this.height;
    this.target = [0, 0, 0];
    for (const axis of [right, up, out]) {
      const places = points.map((point) => dot(axis, point));
      this.target = plus(this.target, axis, (Math.min(...places) + Math.max(...places)) / 2);
    }
    this.distance = 1;
    for (const point of points) {
      const way = minus(point, this.target);
      const needed = Math.max(Math.abs(dot(way, right)) / aspect, Math.abs(dot(way, up)) / free) / HALF;
      this.distance = Math.max(this.distance, dot(way, out) + MARGIN * needed);
    }
    this.target = plus(this.target, up, ((above - below) / 2) * this.pixel());
  }

  /** From the base frame to the picture, column by column. */
  matrix() {
    const { right, up, out } = this.axes();
    const [near, far] = [this.distance / 100, this.distance * 4 + 20000];
    const [sx, sy] = [this.height / this.width / HALF, 1 / HALF];
    const [a, b] = [(near + far) / (near - far), (2 * near * far) / (near - far)];
    const [tx, ty, tz] = [dot(right, this.target), dot(up, this.target), dot(out, this.target) + this.distance];
    return new Float32Array([
      ...[0, 1, 2].flatMap((i) => [sx * right[i], sy * up[i], a * out[i], -out[i]]),
      -sx * tx,
      -sy * ty,
      b - a * tz,
      tz,
    ]);
  }
}

/**
 * Where a point stands in the picture [px], and its depth; a depth that is not positive is behind
 * the eye.
 * @param {Float32Array} m the camera's matrix
 * @param {Vector} point
 * @param {number} width
 * @param {number} height
 */
export function project(m, point, width, height) {
  const [x, y, z] = [point[0], point[1], point[2]];
  const w = m[3] * x + m[7] * y + m[11] * z + m[15];
  return [
    ((m[0] * x + m[4] * y + m[8] * z + m[12]) / w + 1) * 0.5 * width,
    (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w) * 0.5 * height,
    w,
  ];
}
