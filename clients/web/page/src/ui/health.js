import { WORLD_STATES } from "../decode/idl.js";
import { make, setText } from "./dom.js";
import { formatCount, formatNumber, formatTime } from "./format.js";

const STATE_TEXT = {
  connecting: "connecting",
  lost: "connection lost",
  silent: "world is silent",
  waiting: "no world",
};

/** What state a world is in and how the page gets on with it, on one line. */
export class Health {
  #dot = make("span", { class: "dot" });
  #state = make("strong", { id: "state", "aria-live": "polite" });
  #world = make("span", { class: "world" });
  #choose;
  #values = {};

  /** `choose(name)`: follow another world. */
  constructor(element, choose) {
    this.#choose = make("select", { "aria-label": "World", hidden: true, onchange: ({ target }) => choose(target.value) });
    const value = (name, label, title) => {
      this.#values[name] = make("b");
      return make("span", { class: `value ${name}`, title }, make("i", {}, label), this.#values[name]);
    };
    element.append(
      make("span", { class: "who" }, this.#dot, this.#choose, this.#world, this.#state),
      value("step", "step", "Steps of this run"),
      value("time", "time", "Simulated time"),
      value("factor", "real-time factor", "Simulated over wall seconds, lately. 1 is real time"),
      value("shown", "frames shown", "Frames of this run that this page has drawn"),
      value("missed", "missed", "Frames that this page left out, since it draws the newest at each refresh of the screen. A recorder gets them all"),
    );
  }

  setWorlds(worlds, chosen) {
    this.#choose.hidden = worlds.length < 2;
    this.#world.hidden = worlds.length > 1;
    this.#choose.replaceChildren(...worlds.map((name) => make("option", { value: name, selected: name === chosen }, name)));
  }

  /** `recording`: its name, or null. `counts`: {shown, missed}. */
  update({ link, status, scene, recording, counts, particles }) {
    const state = recording || link.state === "connected" ? (WORLD_STATES[status?.state] ?? "waiting") : link.state;
    this.#dot.dataset.state = state;
    setText(this.#state, `${recording ? "recorded, " : ""}${STATE_TEXT[state] ?? state}`);
    setText(this.#world, recording ?? status?.world ?? scene?.world ?? "flexcast");
    const running = status ? status.report : null;
    setText(this.#values.step, particles.total ? formatCount(particles.step) : running ? formatCount(running.step) : "–");
    setText(this.#values.time, formatTime(particles.total ? particles.time : running?.time));
    setText(this.#values.factor, status ? formatNumber(status.real_time_factor, 3) : "–");
    setText(this.#values.shown, formatCount(counts.shown));
    setText(this.#values.missed, formatCount(counts.missed));
  }
}
