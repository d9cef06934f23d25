// How often the picture is drawn, and takes over results while they stream in: they are not to wait for it.

const SHARE = 4; // it rests so many times as long as it has worked

/**
 * `action`, which may return a promise, called at once, and then again no sooner than `least` ms and `SHARE` times its
 * own duration after it ended. The last call is never lost.
 * @param {any} action
 * @param {any} least
 */
export function paced(action, least) {
  let isBusy = false;
  let isDue = false;
  return async function take() {
    isDue = true;
    if (isBusy) return;
    isBusy = true;
    try {
      while (isDue) {
        isDue = false;
        const began = performance.now();
        await action();
        const pause = Math.max(least, SHARE * (performance.now() - began));
        await new Promise((resolve) => setTimeout(resolve, pause));
      }
    } finally {
      isBusy = false;
    }
  };
}

/**
 * `action`, called with the next picture however often it is asked for, with what was given last.
 * @template {unknown[]} A
 * @param {(...args: A) => void} action
 * @returns {(...args: A) => void}
 */
export function eachFrame(action) {
  /** @type {A | null} */
  let given = null;
  return (...args) => {
    if (!given)
      requestAnimationFrame(() => {
        const last = /** @type {A} */ (given);
        given = null;
        action(...last);
      });
    given = args;
  };
}
