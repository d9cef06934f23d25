// Orientations as brands write them. The job has roll, pitch and yaw [deg] about the fixed x, y and z axes, in this
// order: R = Rz(yaw) Ry(pitch) Rx(roll). The core's export/orientation.rs has the same conventions.

const DEG = Math.PI / 180;
const PLACES = 10; // of a degree or of a quaternion: the last bits of sines and cosines are noise
const UNIT = 1e-3; // how far from 1 the length of a quaternion may be: they are typed with four digits or more

const ANGLES = ["roll", "pitch", "yaw"];
/** @param {number[]} values */
const same = (values) => [...values];
/**
 * @template T
 * @param {T[]} values
 */
const reversed = ([a, b, c]) => [c, b, a];

/**
 * @typedef {{
 *   names: string[],
 *   ids: string[],
 *   meaning: string,
 *   of(rpy: number[]): number[],
 *   rpy(values: number[]): number[],
 * }} Convention
 */

/**
 * By brand: the names of the values; which angle of the job each is nearest to, for their ids; what they mean; `of(rpy)`
 * and its inverse `rpy(values)`.
 * @type {Record<string, Convention>}
 */
export const CONVENTIONS = {
  other: { names: ANGLES, ids: ANGLES, meaning: "", of: same, rpy: same },
  KUKA: {
    names: ["A", "B", "C"],
    ids: reversed(ANGLES),
    meaning: "As KUKA counts: A about z, B about the new y, C about the new x.",
    of: reversed,
    rpy: reversed,
  },
  FANUC: {
    names: ["W", "P", "R"],
    ids: ANGLES,
    meaning: "As FANUC counts: W, P, R about the fixed x, y and z axes, in this order.",
    of: same,
    rpy: same,
  },
  Yaskawa: {
    names: ["Rx", "Ry", "Rz"],
    ids: ANGLES,
    meaning: "As Yaskawa counts: Rx, Ry, Rz about the fixed x, y and z axes, in this order.",
    of: same,
    rpy: same,
  },
  Stäubli: {
    names: ["Rx", "Ry", "Rz"],
    ids: ANGLES,
    meaning: "As Stäubli counts: Rx about x, Ry about the new y, Rz about the new z.",
    of: (rpy) => rounded(movingXyz(matrix(rpy))),
    rpy: (angles) => rounded(rollPitchYaw(transposed(matrix(angles.map((angle) => -angle))))),
  },
  ABB: {
    names: ["q1", "q2", "q3", "q4"],
    ids: ["q1", "q2", "q3", "q4"],
    meaning: "As ABB counts: a quaternion of length 1, scalar first.",
    of: (rpy) => rounded(quaternion(rpy)),
    rpy: (q) => rounded(rollPitchYaw(matrixOf(normalised(q)))),
  },
};

/**
 * Length of a quaternion, if that is too far from 1 to be a rotation; undefined otherwise.
 * @param {number[]} q
 */
export function strayLength(q) {
  const length = Math.hypot(...q);
  return Math.abs(length - 1) <= UNIT ? undefined : length;
}

/** @param {number[]} values */
const rounded = (values) => values.map((value) => Number(value.toFixed(PLACES)) + 0);

/**
 * R = Rz Ry Rx, by rows.
 * @param {number[]} values
 */
function matrix([roll, pitch, yaw]) {
  const [[sr, cr], [sp, cp], [sy, cy]] = [roll, pitch, yaw].map((angle) => [
    Math.sin(angle * DEG),
    Math.cos(angle * DEG),
  ]);
  return [
    [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
    [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
    [-sp, cp * sr, cp * cr],
  ];
}

/** @param {number[][]} m */
const transposed = (m) => m.map((_, i) => m.map((row) => row[i]));

/**
 * Roll is found after undoing yaw, so that the three belong together where pitch is 90 deg as well.
 * @param {number[][]} m
 */
function rollPitchYaw(m) {
  const level = Math.hypot(m[0][0], m[1][0]);
  const yaw = level < 1e-12 ? 0 : Math.atan2(m[1][0], m[0][0]);
  const [sin, cos] = [Math.sin(yaw), Math.cos(yaw)];
  const roll = Math.atan2(sin * m[0][2] - cos * m[1][2], cos * m[1][1] - sin * m[0][1]);
  return [roll, Math.atan2(-m[2][0], level), yaw].map((angle) => angle / DEG);
}

/**
 * About x, the new y, the new z: the transpose turns by their negatives about z, y, x.
 * @param {number[][]} m
 */
const movingXyz = (m) => rollPitchYaw(transposed(m)).map((angle) => -angle);

/** @param {number[]} rpy */
function quaternion(rpy) {
  const [[sr, cr], [sp, cp], [sy, cy]] = rpy.map((angle) => [Math.sin((angle * DEG) / 2), Math.cos((angle * DEG) / 2)]);
  const q = [
    cr * cp * cy + sr * sp * sy,
    sr * cp * cy - cr * sp * sy,
    cr * sp * cy + sr * cp * sy,
    cr * cp * sy - sr * sp * cy,
  ];
  const sign = q[0] < 0 ? -1 : 1; // q and -q are the same rotation
  return q.map((value) => sign * value);
}

/** @param {number[]} q */
const normalised = (q) => q.map((value) => value / Math.hypot(...q));

/** @param {number[]} values */
const matrixOf = ([w, x, y, z]) => [
  [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
  [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
  [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
];
