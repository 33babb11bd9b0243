import { FrameAssembler } from "../decode/frame_assembler.js";
import { peekFrame } from "../decode/particle_frame.js";
import { Particles } from "../decode/particles.js";
import { Emitter } from "./emitter.js";
import { History } from "./history.js";
import { TopologyAssembler } from "./topology.js";

const MOST_EVENTS = 256;

/**
 * The newest of everything a world said, wherever it came from: a server or a recording. Says "scene", "topology",
 * "parameters", "status", "events" when they change. Frames are looked at when one is to be drawn.
 */
export class World extends Emitter {
  scene = null;
  topology = null;
  parameters = null;
  status = null;
  events = [];
  history = new History();
  particles = new Particles();
  frames = new FrameAssembler();

  #topologies = new TopologyAssembler();
  #held = null; // samples of a frame whose topology is not here yet

  /**
   * Takes one message; true when it completed a frame. `topic` is the name after "flexcast/", `decode` that of its
   * channel, `seconds` when it was sent.
   */
  take(topic, bytes, decode, seconds) {
    switch (topic) {
      case "frames":
        return this.frames.add(bytes);
      case "scene":
        this.scene = decode(bytes);
        this.emit("scene", this.scene);
        this.#completeTopology();
        break;
      case "topology":
        this.#topologies.add(decode(bytes));
        this.#completeTopology();
        break;
      case "parameters":
        this.parameters = decode(bytes);
        this.emit("parameters", this.parameters);
        break;
      case "status":
        this.setStatus(decode(bytes), seconds);
        break;
      case "events":
        this.#addEvent(decode(bytes));
        break;
      default: // a topic of a later version
    }
    return false;
  }

  setStatus(status, seconds) {
    this.status = status;
    this.history.add(seconds, status);
    this.emit("status", status);
  }

  /** Decodes the newest frame into `particles`; false when there is none that was not decoded before. */
  nextFrame() {
    const samples = this.frames.take() ?? this.#held;
    this.#held = null;
    if (!samples) return false;
    if (peekFrame(samples[0]).topology_revision !== this.topology?.revision) {
      this.#held = samples;
      return false;
    }
    this.particles.update(samples);
    return true;
  }

  /** Forgets the frames and events: what follows may be of another time. */
  clearTime() {
    this.frames.clear();
    this.#held = null;
    this.events = [];
    this.emit("events", this.events);
  }

  clear() {
    this.clearTime();
    this.scene = this.topology = this.parameters = this.status = null;
    this.history.clear();
    for (const name of ["scene", "topology", "parameters", "status"]) this.emit(name, null);
  }

  #completeTopology() {
    if (!this.scene || this.scene.topology_revision === this.topology?.revision) return;
    const topology = this.#topologies.complete(this.scene);
    if (!topology) return;
    this.topology = topology;
    this.emit("topology", topology);
  }

  #addEvent(event) {
    if (this.events.length && this.events.at(-1).run_id !== event.run_id) this.events = [];
    this.events.push(event);
    if (this.events.length > MOST_EVENTS) this.events.shift();
    this.emit("events", this.events);
  }
}
