// Undo and redo over states of the inputs. A state is plain data that is never changed once it is
// recorded.

const MOST = 200; // steps

/** @typedef {object} State plain data */

export class History {
  /** @type {State[]} */
  #states = [];
  #at = -1;
  /** @type {unknown} */
  #group; // edits of the same group are one step

  /**
   * Records what is now. Typing in one field, named by `group`, is one step until `rest` is called.
   * @param {State} state
   * @param {unknown} [group]
   */
  record(state, group) {
    if (same(state, this.#states[this.#at])) return;
    this.#states.length = this.#at + 1;
    if (group !== undefined && group === this.#group) this.#states.pop();
    this.#group = group;
    if (same(state, this.#states.at(-1)))
      this.#group = undefined; // typed, and taken back
    else this.#states.push(state);
    if (this.#states.length > MOST) this.#states.shift();
    this.#at = this.#states.length - 1;
  }

  /** What is typed next begins a new step. */
  rest() {
    this.#group = undefined;
  }

  get canUndo() {
    return this.#at > 0;
  }

  get canRedo() {
    return this.#at < this.#states.length - 1;
  }

  /**
   * The state before (`step` -1) or after (1) this one, which it becomes; undefined if there is
   * none.
   * @param {1 | -1} step
   * @returns {any}
   */
  move(step) {
    const state = this.#states[this.#at + step];
    if (state === undefined) return undefined;
    this.#at += step;
    this.#group = undefined;
    return state;
  }
}

/**
 * Whether two values of plain data are equal. Long texts are shared between states, so this is
 * quick.
 * @param {any} a
 * @param {any} b
 * @returns {boolean}
 */
function same(a, b) {
  if (a === b) return true;
  if (typeof a !== "object" || typeof b !== "object" || !a || !b) return false;
  const keys = Object.keys(a);
  return keys.length === Object.keys(b).length && keys.every((key) => key in b && same(a[key], b[key]));
}
