// What a new job still has from the job before it. A program that is opened brings its path and its spindle
// speed; which robot mills it, with which tool, in what and where, only the person knows. What has not
// been looked at is listed until it is changed or confirmed.

import { byId, make } from "../page/dom.js";

const KEY = "armill-asked";
const PARTS = {
  robot: ["Robot", "robot"],
  tool_frame: ["Tool frame", "frames"],
  workpiece_frame: ["Part’s place", "frames"],
  stock: ["Stock", "stock"],
  tool: ["Tool", "tool"],
  material: ["Material", "material"],
};
const DEPTHS = ["Depths of cut", "cutting"]; // of a job without a stock, which would give them

/** @type {() => Promise<boolean>} */
let placeInFront = async () => false;

/**
 * `place()` puts the part in front of the robot, and says whether it did.
 * @param {() => Promise<boolean>} place
 */
export const offerPlace = (place) => (placeInFront = place);

/** @param {unknown} part */
const textOf = (part) => JSON.stringify(part ?? null);

/**
 * Whether a stock is somebody's own rather than none, or what follows from the program.
 * @param {import("../../pkg/armill.js").Stock | undefined} stock
 */
const isOwn = (stock) => !["none", "extents"].includes(stock?.kind ?? "none");

/**
 * Parts of `data` that are still as they were when they were asked about, `asked`: [name, group] each.
 * @param {import("../job/data.js").JobData} data
 * @param {Record<string, string>} asked
 */
export function stillAsked(data, asked) {
  const parts = { ...PARTS, ...((data.stock?.kind ?? "none") === "none" && { cutting: DEPTHS }) };
  return Object.entries(parts)
    .filter(([key]) => key !== "stock" || isOwn(data.stock))
    .filter(([key]) => asked[key] === textOf(data[key]))
    .map(([, names]) => names);
}

/**
 * The parts of a job, as they are compared later.
 * @param {import("../job/data.js").JobData} data
 */
export const askedOf = (data) =>
  Object.fromEntries([...Object.keys(PARTS), "cutting"].map((key) => [key, textOf(data[key])]));

/**
 * Asks about what `data` took over; `but` names parts that were just chosen.
 * @param {import("../job/data.js").JobData} data
 * @param {...string} but
 */
export function ask(data, ...but) {
  const asked = askedOf(data);
  for (const part of but) delete asked[part];
  keep(asked);
  showAsked(data);
}

/**
 * Writes the list of what is still asked about above the inputs.
 * @param {import("../job/data.js").JobData} data
 */
export function showAsked(data) {
  const box = byId("still-asked");
  const parts = stillAsked(data, kept());
  box.hidden = parts.length === 0;
  if (box.hidden) return;
  const links = parts.map(([name, group]) => {
    const button = make("button", { type: "button", className: "quiet" }, name);
    button.addEventListener("click", () => show(group));
    const isPlace = name === PARTS.workpiece_frame[0];
    return make("li", {}, button, ...(isPlace ? [placeButton(data)] : []));
  });
  const confirm = make("button", { type: "button", id: "confirm-asked" }, "These are right");
  confirm.addEventListener("click", () => (keep({}), showAsked(data)));
  box.replaceChildren(make("p", {}, "Still from the job before. Check:"), make("ul", {}, ...links), confirm);
}

/**
 * A program's zero may lie in the robot's foot, where the arm reaches it and nothing is wrong with the numbers. So
 * a place in front is offered always.
 * @param {import("../job/data.js").JobData} data
 */
function placeButton(data) {
  const button = make("button", { type: "button", id: "place-asked" }, "Place it in front");
  button.addEventListener("click", async () => {
    if (!(await placeInFront())) return;
    const { workpiece_frame: _, ...rest } = kept();
    keep(rest); // also where it stood there before
    showAsked(data);
    show("frames"); // the button is gone, and with it the focus
  });
  return button;
}

/** @param {string} group */
function show(group) {
  const details = /** @type {HTMLDetailsElement} */ (byId(`group-${group}`));
  details.open = true;
  details.scrollIntoView({ block: "nearest" });
  details.querySelector("summary")?.focus();
}

function kept() {
  try {
    return JSON.parse(sessionStorage.getItem(KEY) ?? "{}") ?? {};
  } catch {
    return {}; // denied, or not ours
  }
}

/** @param {Record<string, string>} asked */
function keep(asked) {
  try {
    sessionStorage.setItem(KEY, JSON.stringify(asked));
  } catch {
    // Denied: it is not asked again after a reload.
  }
}
