// What a user of the package writes, checked by `tsc --strict`.

import init, {
  type ArmillError,
  check,
  default_job,
  type Field,
  fields,
  formats,
  model,
  presets,
  run,
  type Summary,
  version,
} from "armill";

await init();
const labels: string[] = fields().map((field: Field) => `${field.label} ${field.unit}`);
const robot: number | undefined = presets().robots[0]?.modified_dh[0]?.alpha_deg;
const progress = (fraction: number, stage: string): void => console.log(fraction, stage);
const result = run(default_job(), progress);
const summary: Summary = result.summary();
const comparable: boolean = summary.model === model();
const after: number = summary.after_mm.max;
const error: Float64Array = result.column("contour_error_mm");
const svg: string = result.chart("before-after", { width: 640, height: 300 }).svg;
const program: string = result.export(formats()[0]?.id ?? "gcode", 0.01);
try {
  check("{}");
} catch (thrown) {
  const { code, field, line }: ArmillError = thrown as ArmillError;
  console.log(code, field, line);
}
result.free();
console.log(version(), comparable, labels, robot, after, error, svg, program);

// @ts-expect-error A job is text.
run({ version: 1 });
// @ts-expect-error There is no such figure.
summary.median;
// @ts-expect-error A chart has a size.
result.chart("before-after", {});
