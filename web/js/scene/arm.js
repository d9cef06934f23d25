// The arm as a figure: tubes for links and joints, a spindle, a cutter. Only the joints' places and
// axes are the robot's own; the thickness of its links is unknown.

import { cross, dot, length, minus, plus } from "./camera.js";

/** @typedef {{ origin: number[], x: number[], y: number[], z: number[] }} Frame a place and three axes */

/** @typedef {{ base: Frame, joints: Frame[], tcp: Frame, workpiece: Frame }} Frames those of a pose */

/**
 * A tube, `top` times as wide at its end.
 *
 * @typedef {{ model: Float32Array, top: number, tone: "link" | "joint" | "tool" | "beyond" }} Tube
 */

const FRAME = 12; // numbers in a frame: origin, x, y, z axes
const JOINTS = 6;
const WIDE = 0.08; // about the largest radius of a link, as a share of the arm's length

/**
 * The frames of the core's answer.
 * @param {Float64Array} numbers
 * @returns {Frames}
 */
export function framesOf(numbers) {
  /** @param {number} i */
  const frame = (i) => {
    /** @param {number} k */
    const at = (k) => [...numbers.subarray(i * FRAME + 3 * k, i * FRAME + 3 * k + 3)];
    return { origin: at(0), x: at(1), y: at(2), z: at(3) };
  };
  const all = Array.from({ length: numbers.length / FRAME }, (_, i) => frame(i));
  return { base: all[0], joints: all.slice(1, 1 + JOINTS), tcp: all[1 + JOINTS], workpiece: all[2 + JOINTS] };
}

/**
 * The solids of the arm in a pose, for the painter; `tone` tells what they are. A joint that is beyond its range by
 * `excess` [deg] has a tone of its own.
 * @param {Frames} frames
 * @param {ArrayLike<number>} [excess]
 * @returns {Tube[]}
 */
export function armParts({ base, joints, tcp }, excess = []) {
  const stations = [base, ...joints];
  const lengths = joints.map(({ origin }, i) => length(minus(origin, stations[i].origin)));
  const size = lengths.reduce((sum, each) => sum + each, 0) || 1;
  // From the shoulder to the wrist an arm gets slimmer.
  /** @param {number} i */
  const radius = (i) => size * [0.062, 0.056, 0.047, 0.04, 0.031, 0.021, 0.02][i];
  /**
   * A joint that shares its place with the next one (shoulder, wrist) keeps to the side it comes from.
   *
   * @param {number[]} origin
   * @param {number[]} z
   * @param {number} i
   */
  const housing = (origin, z, i) => {
    const [wide, half] = [1.14 * radius(i + 1), i === JOINTS - 1 ? 0.4 * radius(i + 1) : 1.35 * radius(i)];
    const shared = lengths[i + 1] < 1;
    const back = dot(minus(origin, stations[i].origin), z) < 0 ? 1 : -1;
    const [from, to] = shared ? [1.3 * back * half, -0.6 * back * half] : [-half, half];
    return tubeBetween(plus(origin, z, from), plus(origin, z, to), wide, 1, excess[i] > 0 ? "beyond" : "joint");
  };
  const parts = [tubeBetween(base.origin, plus(base.origin, base.z, 0.02 * size), 1.55 * radius(0), 1, "joint")];
  const bare = length(minus(joints[5].origin, tcp.origin)) < 1; // the tip is at the flange: the tool takes the last link's place
  joints.slice(0, bare ? JOINTS - 1 : JOINTS).forEach(({ origin, z }, i) => {
    if (lengths[i] > 1)
      parts.push(tubeBetween(stations[i].origin, origin, radius(i), radius(i + 1) / radius(i), "link"));
    parts.push(housing(origin, z, i));
  });
  return [...parts, ...toolParts(joints, tcp, size, bare)];
}

/**
 * Points that an arm's solids stay within about, to fit a view to.
 * @param {{ base: any, joints: any, tcp: any }} given
 */
export function armPoints({ base, joints, tcp }) {
  const stations = [base, ...joints, tcp].map(({ origin }) => origin);
  const size = stations.slice(1).reduce((sum, origin, i) => sum + length(minus(origin, stations[i])), 0);
  const spread = [1, -1].flatMap((side) =>
    [0, 1, 2].map((axis) => [0, 1, 2].map((i) => (i === axis ? side * WIDE * size : 0))),
  );
  return stations.flatMap((origin) => spread.map((off) => plus(origin, off)));
}

/**
 * Cutter and spindle on the tool's axis; where the tip is off the flange's axis, a bracket between
 * the two.
 * @param {Frame[]} joints
 * @param {Frame} tcp
 * @param {number} size
 * @param {boolean} bare
 * @returns {Tube[]}
 */
function toolParts(joints, tcp, size, bare) {
  const [wrist, flange] = [joints[4].origin, joints[5].origin];
  const axis = tcp.z.map((v) => -v);
  /** @param {number[]} point */
  const height = (point) => dot(minus(point, tcp.origin), axis);
  const top = Math.max(height(bare ? wrist : flange), 0.06 * size);
  /** @param {number} share */
  const at = (share) => plus(tcp.origin, axis, share * top);
  const parts = [
    tubeBetween(at(0), at(0.45), 0.006 * size, 1, "tool"),
    tubeBetween(at(0.42), at(0.55), 0.012 * size, 1.6, "tool"),
    tubeBetween(at(0.55), at(1), 0.026 * size, 1, "joint"),
  ];
  if (!bare && length(minus(at(1), flange)) > 1) parts.push(tubeBetween(flange, at(0.95), 0.02 * size, 1, "link"));
  return parts;
}

/**
 * A tube from one point to another, `top` times as wide at its end.
 * @param {number[]} from
 * @param {number[]} to
 * @param {number} radius
 * @param {number} top
 * @param {Tube["tone"]} tone
 * @returns {Tube}
 */
function tubeBetween(from, to, radius, top, tone) {
  const way = minus(to, from);
  const along = way.map((v) => v / (length(way) || 1));
  const beside = cross(along, Math.abs(along[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]);
  const x = beside.map((v) => v / length(beside));
  const y = cross(along, x);
  const model = new Float32Array([
    ...x.map((v) => v * radius),
    0,
    ...y.map((v) => v * radius),
    0,
    ...way,
    0,
    ...from,
    1,
  ]);
  return { model, top, tone };
}

/**
 * The shadow that a part throws straight down on the floor.
 * @param {Pick<Tube, "model" | "top">} tube
 */
export function shadow({ model, top }) {
  const flat = Float32Array.from(model);
  for (const column of [0, 1, 2, 3]) flat[column * 4 + 2] = 0;
  return { model: flat, top };
}
