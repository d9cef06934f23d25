// The page's colours, for the picture.

/** @typedef {ReturnType<typeof tonesOf>} Tones */

/**
 * The page's colours as shares of red, green and blue, and whether the page is dark.
 * @param {HTMLElement} node
 */
export function tonesOf(node) {
  const probe = document.createElement("span");
  node.append(probe);
  /** @param {string} token */
  const read = (token) => {
    probe.style.setProperty("color", `var(--${token})`);
    const numbers = getComputedStyle(probe).color.match(/[\d.]+/g) ?? [];
    return numbers.slice(0, 3).map((v) => Number(v) / 255);
  };
  /**
   * @param {number[]} a
   * @param {number[]} b
   * @param {number} share
   */
  const mixed = (a, b, share) => a.map((v, i) => v + (b[i] - v) * share);
  const [paper, ink, line, faint, accent, wrong] = ["surface", "ink", "line", "line-2", "accent", "wrong"].map(read);
  const axes = ["vermillion", "green", "blue"].map(read);
  const dark = paper[0] + paper[1] + paper[2] < 1.5;
  const tones = {
    paper,
    ink,
    axes,
    dark,
    wrong,
    rapid: mixed(paper, faint, 0.75),
    outline: mixed(paper, faint, 0.8),
    glass: faint,
    tube: faint,
    grid: mixed(paper, line, 0.75),
    desired: dark ? ink : read("ink-2"),
    command: read("after"),
    shadow: mixed(paper, dark ? [0, 0, 0] : ink, dark ? 0.2 : 0.04),
    link: dark ? mixed(paper, ink, 0.55) : mixed(paper, faint, 0.38),
    joint: mixed(mixed(paper, ink, dark ? 0.55 : 0.45), accent, 0.22),
    beyond: wrong,
    tool: mixed(ink, faint, 0.35),
  };
  probe.remove();
  return tones;
}
