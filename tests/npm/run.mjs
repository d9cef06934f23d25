// Runs in Node what the package offers; prints its fingerprint and writes what it answered as TypeScript, so that
// `tsc` can hold the answers against the declared types: a key too many or too few is an error there.

import { writeFileSync } from "node:fs";
import init, * as armill from "armill";

await init();
const program = {
  ...JSON.parse(armill.default_job()),
  path: { kind: "gcode", text: "G21 G90 M8\nS4000 M3\nG0 X600 Y-60 Z120\nG1 Z100 F1200\nY20\nM30" },
};
const result = armill.run(armill.default_job());
const other = armill.run(JSON.stringify(program));
const box = { kind: "box", from_mm: [550, -100, 80], to_mm: [650, 60, 105] };
const stocked = armill.run(JSON.stringify({ ...program, stock: box }));
const coarse = JSON.stringify({ ...JSON.parse(armill.default_job()), motion: { feed_mm_s: 100, sample_time_s: 0.02 } });
const studies = [
  armill.Study.sweep(coarse, ["cutting.axial_depth_mm=1:3:2", "motion.feed_mm_s=50:100:2"]),
  armill.Study.scan(coarse, "cutting.axial_depth_mm=1:3"),
  armill.Study.robots(coarse, "kept"),
  armill.Study.robots(coarse, "front"),
  armill.Study.robots(coarse, "sought"),
  armill.Study.sweep(coarse, ["shaper.kind=zv,ei", "start_branch.elbow=all"]),
  armill.Study.choices(coarse),
  armill.Study.loops(coarse),
];
const curves = new armill.StudyCurves(
  "Axial depth",
  "mm",
  0.1,
  2,
  new Float64Array([1, 2]),
  new Float64Array([1, 0.1, 0.2, 0.3, 2, 0.2, 0.4, 0.6]),
);
const intervals = new armill.StudyIntervals(
  "Robots",
  "Error",
  0.1,
  undefined,
  ["a", "b"],
  new Float64Array([0.1, 0.2, NaN, NaN]),
  new Uint8Array([0, 1]),
);
const grid = new armill.StudyGrid(
  "Depth and feed",
  ["Depth, mm", "Feed, mm/s"],
  ["1", "2"],
  ["10"],
  new Float64Array([0.5, 0]),
  0.1,
  new Float64Array([0.05, 0.2]),
);
const charts = result.charts().map(({ name }) => result.chart(name, { width: 640, height: 300 }));
const answers = {
  fields: [armill.fields()],
  formats: [armill.formats()],
  presets: [armill.presets()],
  opening_job: [armill.opening_job()],
  proposed_cutting: [armill.proposed_cutting(JSON.stringify(program)), armill.proposed_cutting(armill.default_job())],
  zip: [armill.zip("figures", ["a.csv"], ["x,y\n1,2\n"])],
  proposed_stock: [armill.proposed_stock(JSON.stringify(program)), armill.proposed_stock(armill.default_job())],
  thesis_recomputed: [armill.thesis_recomputed()],
  largest: [
    armill.largest(coarse, "cutting.axial_depth_mm=0.1:10", "uncompensated"),
    armill.largest(coarse, "cutting.axial_depth_mm=8:9", "nominal", new Float64Array(9).fill(1)),
  ],
  tornado: [armill.tornado(coarse)],
};
const methods = {
  summary: [result.summary(), other.summary(), stocked.summary()],
  columns: [result.columns()],
  column: [result.column("time_s")],
  charts: [result.charts()],
  chart: charts,
  chart_data: [result.chart_data("before-after", { length: "inch" })],
  frames: [result.frames(0)],
  joint_excess: [result.joint_excess(0)],
  track: [result.track(100)],
  stock_solid: [result.stock_solid(), stocked.stock_solid()],
  export: [result.export("krl")],
  columns_csv: [result.columns_csv(0, 3)],
  package: [result.package(), other.package("gcode")],
  package_zip: [result.package_zip("kuka")],
  interface_zip: [result.interface_zip("kuka-rsi"), result.interface_zip("abb-egm")],
  promise: [result.promise(), result.promise("krl")],
  replay: [other.replay("gcode")],
  simulated_part: [stocked.simulated_part("after"), stocked.simulated_part("nominal", 2)],
  part_map: [stocked.part_map(5)],
  part_mesh: [stocked.part_mesh()],
  part_section: [stocked.part_section(0)],
  fingerprint: [result.fingerprint()],
};

const survey = new armill.Survey(armill.default_job());
const surveyed = {
  extent: [survey.extent()],
  places: [survey.places(new Float64Array([0, 0, 0]))],
  turns: [survey.turns(new Float64Array([0, 0, 0]), new Float64Array([0, 90]))],
  part: [survey.part()],
  base: [survey.base()],
};
const counts = Object.values(surveyed).map(([numbers]) => numbers.length);
if (String(counts) !== "6,4,8,24,6") throw new Error(`a survey answers ${counts} numbers`);

// Made-up loads on twelve poses, and a vibration that dies away: for the types of what is identified.
const pose = (i) => [
  10 * i - 60,
  20 + ((7 * i) % 50),
  30 - ((5 * i) % 40),
  (15 * i) % 90,
  30 + 4 * i,
  (20 * i) % 180,
  100,
  50 * ((i % 3) - 1),
  -80,
  0.1 + 0.01 * i,
  0.02 * (i % 4),
  -0.05,
];
const poses = Array.from({ length: 12 }, (_, i) => pose(i).join(",")).join("\n");
const vibration = Array.from({ length: 2000 }, (_, i) => `${i / 1000},${Math.exp(-i / 800) * Math.cos(i / 20)}`).join(
  "\n",
);
const turned = Array.from({ length: 500 }, (_, i) => {
  const [swing, torque] = [30 * Math.sin(i / 40), 1000 * Math.cos(i / 70)];
  return [i / 100, swing, swing - torque / 1e5 - 1e-3 * Math.sin(i / 3), torque];
});
const gear = `time_s,motor_q3_deg,load_q3_deg,model_load_3_nm\n${turned.map((row) => row.join()).join("\n")}`;
const identified = [
  armill.identify_gear(armill.default_job(), gear, gear),
  armill.evidence_encoders(gear, gear),
  armill.evidence_slots(),
  armill.identify_stiffness(armill.default_job(), poses, "table"),
  armill.identify_response(`time_s,x\n${vibration}`),
];

const literal = (value) => {
  if (value instanceof Float64Array) return `new Float64Array([${value.slice(0, 3)}])`;
  if (value instanceof Float32Array) return `new Float32Array([${value.slice(0, 3)}])`;
  if (value instanceof Uint32Array) return `new Uint32Array([${value.slice(0, 3)}])`;
  if (value instanceof Uint8Array) return `new Uint8Array([${value.slice(0, 3)}])`;
  if (Array.isArray(value)) return `[${value.map(literal)}]`;
  if (value === undefined) return "undefined";
  if (value === null || typeof value !== "object") return JSON.stringify(value);
  return `{${Object.entries(value).map(([key, each]) => `${JSON.stringify(key)}: ${literal(each)}`)}}`;
};
const lines = ['import * as armill from "armill";'];
const write = (type, values) => values.forEach((value) => lines.push(`((_: ${type}) => {})(${literal(value)});`));
for (const [name, values] of Object.entries(answers)) write(`ReturnType<typeof armill.${name}>`, values);
for (const [name, values] of Object.entries(methods)) write(`ReturnType<armill.Run["${name}"]>`, values);
for (const [name, values] of Object.entries(surveyed)) write(`ReturnType<armill.Survey["${name}"]>`, values);
write(
  'ReturnType<armill.Identified["summary"]>',
  identified.map((each) => each.summary()),
);
write(
  'ReturnType<armill.Identified["chart"]>',
  identified.map((each) => each.chart({ width: 640, height: 300 })),
);
write(
  'ReturnType<armill.Study["row"]>',
  studies.flatMap((study) => [study.row(0), study.row(study.count() - 1)]),
);
write('ReturnType<armill.StudyCurves["chart"]>', [curves.chart({ width: 640, height: 300 })]);
write('ReturnType<armill.StudyCurves["chart_data"]>', [curves.chart_data({ length: "inch" })]);
for (const [name, drawn] of Object.entries({ StudyIntervals: intervals, StudyGrid: grid }))
  write(`ReturnType<armill.${name}["draw"]>`, [drawn.draw({ width: 640, height: 300, length: "inch" })]);
writeFileSync("values.ts", `${lines.join("\n")}\n`);

// Whatever a run offers was asked for: what is new has to be added above.
const offered = Object.getOwnPropertyNames(armill.Run.prototype).filter(
  (name) => !["constructor", "free", "__destroy_into_raw"].includes(name),
);
const missing = offered.filter((name) => !(name in methods));
if (missing.length) throw new Error(`not tried: ${missing.join(", ")}`);

const refused = {};
try {
  armill.check('{ "version": 1, "motion": { "feed_mm_s": -1 } }');
} catch ({ code, field, message }) {
  Object.assign(refused, { code, field, message });
}
console.log(
  JSON.stringify({
    version: armill.version(),
    model: armill.model(),
    fingerprint: result.fingerprint(),
    samples: result.column("time_s").length,
    refused,
  }),
);
