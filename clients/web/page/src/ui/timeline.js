import { describe } from "./events.js";
import { make } from "./dom.js";
import { formatClock } from "./format.js";

const STEPS = 10000;
const MOST_MARKS = 400;

/** The time line of a recording: a slider, with marks where something happened. One seek at a time, the newest wins. */
export class Timeline {
  element;

  #slider;
  #marks = make("div", { class: "marks" });
  #recording = null;
  #wanted = null;
  #busy = false;
  #held = false;

  /** `seek(seconds)`: promises to be there. */
  constructor(seek) {
    this.seek = seek;
    this.#slider = make("input", {
      type: "range",
      min: 0,
      max: STEPS,
      value: 0,
      "aria-label": "Time line",
      onpointerdown: () => (this.#held = true),
      onpointerup: () => (this.#held = false),
      onpointercancel: () => (this.#held = false),
      oninput: ({ target }) => this.#go((Number(target.value) / STEPS) * this.#recording.duration),
    });
    this.element = make("div", { class: "timeline" }, this.#marks, this.#slider);
  }

  setRecording(recording) {
    this.#recording = recording;
    const decode = recording.decoder("events");
    const events = recording.kept.events.slice(0, MOST_MARKS).map(({ seconds, bytes }) => ({ seconds, event: decode(bytes) }));
    this.#marks.replaceChildren(
      ...events.map(({ seconds, event }) => {
        const mark = make("span", { title: `${formatClock(seconds)}, step ${event.step}: ${describe(event)}`, class: event.state === 3 ? "bad" : "" });
        mark.style.left = `${(100 * seconds) / recording.duration}%`;
        return mark;
      }),
    );
  }

  update(seconds) {
    if (this.#held || this.#busy) return;
    this.#slider.value = Math.round((STEPS * seconds) / (this.#recording.duration || 1));
    this.#slider.setAttribute("aria-valuetext", formatClock(seconds));
  }

  async #go(seconds) {
    this.#wanted = seconds;
    if (this.#busy) return;
    this.#busy = true;
    while (this.#wanted !== null) {
      const next = this.#wanted;
      this.#wanted = null;
      await this.seek(next);
    }
    this.#busy = false;
  }
}
