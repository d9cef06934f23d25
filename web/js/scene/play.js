// Runs the page's cursor along the path, at the speed of the run or a multiple of it. It starts
// only when somebody asks.

import { cursor, onCursor, setCursor } from "../page/cursor.js";
import { make } from "../page/dom.js";

const SPEEDS = [0.1, 0.25, 1, 2, 5, 10, 50];

export class Player {
  #duration = 0;
  #playing = false;
  #last = 0; // when the last picture was shown [ms]
  #button = make("button", { type: "button", className: "play" });
  #slider = make("input", {
    type: "range",
    min: "0",
    max: "1",
    step: "any",
    value: "0",
    "aria-label": "Time of the run",
  });
  #now = make("span");
  #whole = make("span", { className: "whole" });
  #time = make("output", { className: "time" }, this.#now, this.#whole);
  #speed = make("select", { "aria-label": "Speed of play" });

  constructor() {
    this.#speed.append(
      ...SPEEDS.map((speed) => make("option", { value: String(speed), selected: speed === 1 }, `× ${speed}`)),
    );
    this.node = make("div", { className: "player" }, this.#button, this.#slider, this.#time, this.#speed);
    this.#button.addEventListener("click", () => this.toggle());
    this.#slider.addEventListener("input", () => {
      this.pause();
      setCursor(Number(this.#slider.value), "play");
    });
    onCursor((time, from) => {
      if (from !== "play") this.pause();
      this.#show();
    });
    this.#label();
    this.#show();
  }

  /**
   * Takes over a run's duration [s]; what plays stops.
   * @param {number} seconds
   */
  set duration(seconds) {
    this.pause();
    this.#duration = seconds;
    this.#slider.max = String(seconds);
    // Whole steps for the keys, fine enough for the eye.
    this.#slider.step = String(seconds / 1000);
    this.#show();
  }

  get playing() {
    return this.#playing;
  }

  toggle() {
    if (this.#playing) return this.pause();
    if ((cursor() ?? 0) >= this.#duration) setCursor(0, "play");
    this.#playing = true;
    this.#last = performance.now();
    this.#label();
    requestAnimationFrame(this.#step);
  }

  pause() {
    if (!this.#playing) return;
    this.#playing = false;
    this.#label();
  }

  #step = (/** @type {number} */ now) => {
    if (!this.#playing) return;
    const passed = Math.max(0, now - this.#last) / 1000;
    this.#last = now;
    const time = Math.min(this.#duration, (cursor() ?? 0) + passed * Number(this.#speed.value));
    setCursor(time, "play");
    if (time >= this.#duration) this.pause();
    else requestAnimationFrame(this.#step);
  };

  #label() {
    this.#button.textContent = this.#playing ? "Pause" : "Play";
    this.node.dataset.playing = String(this.#playing);
  }

  #show() {
    const time = Math.min(this.#duration, cursor() ?? 0);
    this.#slider.value = String(time);
    this.#slider.setAttribute("aria-valuetext", `${time.toFixed(2)} s`);
    this.#now.textContent = `${time.toFixed(2)} s`;
    this.#whole.textContent = ` of ${this.#duration.toFixed(2)} s`;
  }
}
