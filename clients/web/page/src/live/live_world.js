import { makeDecoder } from "../decode/idl.js";
import { Emitter } from "../model/emitter.js";

const TOPICS = ["scene", "topology", "parameters", "status", "events", "frames"];
const STATUS_TOPIC = "flexcast/status";

/**
 * Follows one of the bridge's worlds and feeds it to a World. The home world's names are plain, those of any other begin
 * with "NAME/". Says "link" when `link` changed and "worlds" when the list of worlds did.
 */
export class LiveWorld extends Emitter {
  link = { state: "connecting", text: "" };
  worlds = [];

  #connection;
  #world;
  #wanted; // name of the world, "" for the home world
  #decoders = new Map(); // channel id -> function
  #problems = new Map(); // id of a server's status -> text
  #frames = true;
  #feeding = true;
  #wasOpen = false;
  #current = null; // name of the world that is followed

  constructor(connection, world, wanted = "") {
    super();
    this.#connection = connection;
    this.#world = world;
    this.#wanted = wanted;
    connection
      .on("open", () => this.#opened())
      .on("closed", () => this.#setLink("lost", "The connection is lost. Trying again."))
      .on("info", () => this.#subscribe())
      .on("channels", () => this.#subscribe())
      .on("status", (status) => this.#noteProblem(status))
      .on("removeStatus", ({ statusIds }) => this.#forgetProblems(statusIds))
      .on("message", (message) => this.#take(message));
  }

  get name() {
    return this.#wanted || this.#connection.info?.metadata?.world || "";
  }

  /** Follows another world. */
  choose(name) {
    this.#wanted = name;
    this.#subscribe();
    this.#updateLink();
  }

  /** Whether the page can be seen: frames are not asked for while it cannot. */
  showFrames(wanted) {
    this.#frames = wanted;
    this.#subscribe();
  }

  /** Stops feeding the world, or begins again with all its newest. */
  feed(wanted) {
    this.#feeding = wanted;
    this.#subscribe();
  }

  /** Runs one of the services, "pause" say. Rejects with a sentence when there was no answer. */
  command(verb, request = {}) {
    return this.#connection.call(`${this.#prefix()}flexcast/${verb}`, request);
  }

  #prefix() {
    const home = this.#connection.info?.metadata?.world;
    return this.#wanted && this.#wanted !== home ? `${this.#wanted}/` : "";
  }

  #opened() {
    this.#problems.clear();
    this.#decoders.clear();
    if (this.#wasOpen) this.#world.clearTime();
    this.#wasOpen = true;
    this.#setLink("waiting", "Looking for a world.");
  }

  #listWorlds() {
    const home = this.#connection.info?.metadata?.world ?? "";
    const names = [...this.#connection.channels.values()]
      .map(({ topic }) => topic)
      .filter((topic) => topic.endsWith(STATUS_TOPIC))
      .map((topic) => topic.slice(0, -STATUS_TOPIC.length - 1) || home);
    if (names.join() === this.worlds.join()) return;
    this.worlds = names;
    this.emit("worlds", names);
  }

  #subscribe() {
    if (!this.#connection.info) return;
    this.#listWorlds();
    const wanted = new Map();
    if (this.#feeding) {
      for (const topic of TOPICS) if (topic !== "frames" || this.#frames) wanted.set(`${this.#prefix()}flexcast/${topic}`, topic);
    }
    const channels = [...this.#connection.channels.values()];
    // Under the same names there may be another home world now: all of it is asked for anew.
    const changed = this.#feeding && this.#current !== this.name;
    for (const { id, topic } of channels) if (changed || !wanted.has(topic)) this.#connection.unsubscribe(id);
    if (changed) {
      this.#world.clear();
      this.#current = this.name;
    }
    // By the order of TOPICS, so that scene and topology come before frames.
    for (const topic of wanted.keys()) {
      const channel = channels.find((candidate) => candidate.topic === topic);
      if (channel) this.#connection.subscribe(channel.id);
    }
    this.#updateLink();
  }

  #take({ channel, timestamp, payload }) {
    const topic = channel.topic.slice(this.#prefix().length + "flexcast/".length);
    this.#world.take(topic, payload, this.#decoderOf(channel), Number(timestamp) / 1e9);
  }

  #decoderOf(channel) {
    if (!this.#decoders.has(channel.id)) {
      this.#decoders.set(channel.id, makeDecoder(channel.schema, channel.schemaName));
    }
    return this.#decoders.get(channel.id);
  }

  #noteProblem({ id, message, level }) {
    if (id) this.#problems.set(id, message);
    else if (level > 0) this.emit("message", message);
    this.#updateLink();
  }

  #forgetProblems(ids) {
    for (const id of ids) this.#problems.delete(id);
    this.#updateLink();
  }

  #updateLink() {
    if (!this.#connection.isOpen) return;
    const problem = this.#problems.get(`world:${this.name}`);
    if (problem) return this.#setLink("silent", problem);
    const topic = `${this.#prefix()}${STATUS_TOPIC}`;
    const there = [...this.#connection.channels.values()].some((channel) => channel.topic === topic);
    if (there) return this.#setLink("connected", "");
    this.#setLink("waiting", this.#problems.get("no-world") ?? `Waiting for the world ${this.name || "of a server"}.`);
  }

  #setLink(state, text) {
    if (state === this.link.state && text === this.link.text) return;
    this.link = { state, text };
    this.emit("link", this.link);
  }
}
