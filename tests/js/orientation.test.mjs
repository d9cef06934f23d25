// Orientations as brands write them: against rotations multiplied one by one, and there and back.

import assert from "node:assert/strict";
import { test } from "node:test";
import { frameIn } from "../../web/js/form/frame-text.js";
import { CONVENTIONS, strayLength } from "../../web/js/form/orientation.js";

/** A rotation by an angle [deg] about an axis, by Rodrigues' formula. */
function about(axis, degrees) {
  const [s, c] = [Math.sin((degrees * Math.PI) / 180), Math.cos((degrees * Math.PI) / 180)];
  const [x, y, z] = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] }[axis] ?? axis;
  const cross = [
    [0, -z, y],
    [z, 0, -x],
    [-y, x, 0],
  ];
  const square = product(cross, cross);
  return cross.map((row, i) => row.map((k, j) => (i === j ? 1 : 0) + s * k + (1 - c) * square[i][j]));
}

const product = (...all) =>
  all.reduce((a, b) => a.map((row) => b[0].map((_, j) => row.reduce((sum, value, k) => sum + value * b[k][j], 0))));

/** What the values of a brand mean, from its manual: turns about moving axes in their order. */
const MEANING = {
  KUKA: ([a, b, c]) => product(about("z", a), about("y", b), about("x", c)),
  FANUC: ([w, p, r]) => product(about("z", r), about("y", p), about("x", w)),
  Yaskawa: ([x, y, z]) => product(about("z", z), about("y", y), about("x", x)),
  Stäubli: ([x, y, z]) => product(about("x", x), about("y", y), about("z", z)),
  ABB([w, ...v]) {
    const sine = Math.hypot(...v);
    const axis = sine < 1e-12 ? [0, 0, 1] : v.map((part) => part / sine);
    return about(axis, (2 * Math.atan2(sine, w) * 180) / Math.PI);
  },
};

const apart = (a, b) => Math.max(...a.flat().map((value, i) => Math.abs(value - b.flat()[i])));

const SAMPLES = [
  [0, 0, 0],
  [10, 20, 30],
  [-170, 45, 100],
  [180, 0, 0],
  [0, 90, 0],
  [0, -90, 30],
  [35, 90, -20],
  [90, 0, 90],
  [179.9, -89.9, -179.9],
  [359, 200, -300],
];

test("each brand's values are the same rotation as roll, pitch and yaw, and lead back to it", () => {
  for (const rpy of SAMPLES) {
    const own = product(about("z", rpy[2]), about("y", rpy[1]), about("x", rpy[0]));
    for (const [brand, meaning] of Object.entries(MEANING)) {
      const { of, rpy: back, names } = CONVENTIONS[brand];
      const values = of(rpy);
      assert.equal(values.length, names.length);
      // Rounded to 1e-10 of a degree or of a quaternion.
      assert.ok(apart(meaning(values), own) < 1e-9, `${brand} ${rpy}: ${values}`);
      const [roll, pitch, yaw] = back(values);
      const again = product(about("z", yaw), about("y", pitch), about("x", roll));
      assert.ok(apart(again, own) < 1e-9, `${brand} ${rpy}: back ${[roll, pitch, yaw]}`);
    }
  }
  assert.equal(strayLength([0.7071, 0, 0.7071, 0]), undefined);
  assert.ok(strayLength([1, 0, 1, 0]) > 1.4);
});

test("a frame pasted as a controller writes it", () => {
  // Turned by 90 deg about y: z points along the flange's x axis, in every language.
  const across = { xyz_mm: [250, 0, 200.5], rpy_deg: [0, 90, 0] };
  for (const text of [
    "{X 250, Y 0, Z 200.5, A 0, B 90, C 0}",
    "TOOL_DATA[5]={x 250.0,y 0.0,z 200.5,a 0.0,b 90.0,c 0.0}",
    "[[250,0,200.5],[0.707106781,0,0.707106781,0]]",
    "PERS tooldata t:=[TRUE,[[250,0,200.5],[0.7071068,0,0.7071068,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];",
    "{X 250, Y 0, Z 200.5, Rx 0, Ry 90, Rz 0}",
    "{250, 0, 200.5, 0, 90, 0}",
    "X: 250.000 Y: 0.000 Z: 200.500\nW: 0.000 P: 90.000 R: 0.000",
    "X =   250.000  mm,\tY =     .000  mm,\tZ =   200.500  mm,\n\tW =     .000 deg,\tP =    90.000 deg,\tR =     .000 deg",
  ]) {
    assert.deepEqual(frameIn(text, "KUKA"), across, text);
  }
  // A is yaw, C roll.
  assert.deepEqual(frameIn("{X 1,Y 2,Z 3,A 10,B 20,C 30}").rpy_deg, [30, 20, 10]);
  assert.deepEqual(frameIn("X 1 Y 2 Z 3 Rx 10 Ry 20 Rz 30", "Yaskawa").rpy_deg, [10, 20, 30]);
  for (const text of ["250", "1 in", "{X 1, Y 2, Z 3}", "[[1,2,3],[1,1,0,0]]", "X1 Y2 Z3 A4"])
    assert.equal(frameIn(text), undefined, text);
});
