import { get, icon, make, setButton, setText } from "./dom.js";
import { formatClock, formatNumber } from "./format.js";
import { Timeline } from "./timeline.js";

const RATES = [0.1, 0.25, 0.5, 1, 2, 5, 0];
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 10];

/** Pause and resume, step, reset and rate of a live world; play, scrub and speed of a recording. */
export class Transport {
  timeline;

  #play;
  #back;
  #step;
  #reset;
  #rate;
  #speed;
  #place = make("span");
  #length = make("span", { class: "wide" });
  #clock = make("span", { class: "clock" }, this.#place, this.#length);
  #live;
  #parts;

  /** `actions`: toggle, step(direction), reset, setRate(rate), setSpeed(speed), seek(seconds), goLive. */
  constructor(element, actions) {
    const button = (symbol, label, action, attributes = {}) =>
      make("button", { title: label, "aria-label": label, onclick: action, ...attributes }, icon(symbol));
    this.#play = button("pause", "Pause", actions.toggle, { class: "primary", id: "play" });
    this.#back = button("back", "One frame back (←)", () => actions.step(-1));
    this.#step = button("step", "One step (→)", () => actions.step(1), { id: "step" });
    this.#reset = button("reset", "Reset to the start (r)", actions.reset, { id: "reset" });
    this.#rate = make("select", { id: "rate", "aria-label": "Rate: simulated seconds per second", onchange: ({ target }) => actions.setRate(Number(target.value)) });
    this.#speed = make("select", { id: "speed", "aria-label": "Speed of playing", onchange: ({ target }) => actions.setSpeed(Number(target.value)) }, ...SPEEDS.map((speed) => make("option", { value: speed, selected: speed === 1 }, `${speed}×`)));
    this.timeline = new Timeline(actions.seek);
    this.#live = make("button", { class: "quiet", id: "go-live", title: "Back to the live world", onclick: actions.goLive }, make("span", { class: "wide" }, "Back to "), "live");
    const rate = make("label", { class: "rate" }, make("span", {}, "rate"), this.#rate);
    this.#parts = { live: [this.#reset, rate], recording: [this.#back, this.timeline.element, this.#clock, this.#speed, this.#live] };
    element.append(this.#play, this.#back, this.#step, this.#reset, this.timeline.element, this.#clock, this.#speed, rate, this.#live);
    this.setRecording(null);
  }

  setRecording(recording) {
    for (const part of this.#parts.live) part.hidden = recording !== null;
    for (const part of this.#parts.recording) part.hidden = recording === null;
    get("transport").classList.toggle("recording", recording !== null);
    if (recording) this.timeline.setRecording(recording);
  }

  /** `running`: whether the button pauses; `enabled`: whether anybody would hear. `rate`: null when not known. */
  update({ running, enabled, rate, player }) {
    const words = player ? ["Pause (space)", "Play (space)"] : ["Pause (space)", "Resume (space)"];
    setButton(this.#play, running ? "pause" : "play", words[running ? 0 : 1]);
    for (const control of [this.#play, this.#step, this.#reset, this.#rate]) control.disabled = !enabled;
    if (rate !== null && this.#rate.dataset.rate !== String(rate)) this.#showRate(rate);
    if (!player) return;
    this.timeline.update(player.seconds);
    setText(this.#place, formatClock(player.seconds));
    setText(this.#length, ` / ${formatClock(player.recording.duration)}`);
  }

  // A rate of somebody else's choice becomes one of the entries.
  #showRate(rate) {
    const rates = RATES.includes(rate) ? RATES : [rate, ...RATES];
    const options = rates.map((value) => make("option", { value, selected: value === rate }, value === 0 ? "max" : `${formatNumber(value, 4)}×`));
    this.#rate.replaceChildren(...options);
    this.#rate.dataset.rate = String(rate);
  }
}
