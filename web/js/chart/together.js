// A chart of the shown result with those of pinned ones, all on the same axes.

/**
 * Resolves with `{ own, others }`: the chart `name` that `values` draws and those of the pinned results
 * `pins` as [{ pin, chart }], on axes that hold all of them where `view`, { x, y }, asks for no range.
 */
export async function drawnTogether(name, options, view, values, pins) {
  const own = await values.chart(name, options);
  if (!pins.length) return { own, others: [] };
  const alike = { ...options, ...(own.y.floor !== undefined && { scale: own.y.log ? "log" : "linear" }) };
  const ask = (pin, how) => pin.chart(name, how).catch(() => null); // it may be unpinned meanwhile
  const found = (await Promise.all(pins.map((pin) => ask(pin, alike)))).filter(Boolean);
  if (!found.length) return { own, others: [] };
  const [x, y] = ["x", "y"].map((axis) => joined([own, ...found].map((chart) => chart[axis].full)));
  const all = { ...alike, x_range: view.x ?? x, y_range: view.y ?? y };
  const [drawn, ...charts] = await Promise.all([values.chart(name, all), ...pins.map((pin) => ask(pin, all))]);
  [drawn.x.full, drawn.y.full] = [x, y];
  return { own: drawn, others: pins.map((pin, i) => ({ pin, chart: charts[i] })).filter(({ chart }) => chart) };
}

/** The range that holds all of these. */
const joined = (ranges) => [Math.min(...ranges.map(([low]) => low)), Math.max(...ranges.map(([, high]) => high))];
