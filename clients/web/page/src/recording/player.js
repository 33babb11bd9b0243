import { Emitter } from "../model/emitter.js";

const AHEAD = 1; // s of playing that are read in advance
const MOST_AHEAD = 2000; // messages
const BACK = 1e-9; // s, the resolution of a recording's times

/**
 * Plays a recording into a World, as if it were live. `seconds` is where it is. Says "moved", "playing" (began or
 * stopped) and "error" with an Error.
 */
export class Player extends Emitter {
  seconds = 0;
  speed = 1;
  playing = false;

  #world;
  #read = []; // messages that follow `seconds`, in order
  #source = null; // iterator of what follows them; null: nothing does
  #from = 0; // statuses up to it are known
  #filling = null;
  #seeks = 0; // so that a seek knows that a later one has begun
  #seeking = false;
  #taken = {}; // topic -> number of the kept message that the world has
  #events = 0; // that the world has
  #frameSeconds = 0; // when the frame that is shown was received

  constructor(recording, world) {
    super();
    this.recording = recording;
    this.#world = world;
  }

  async start() {
    for (const { seconds, status } of await this.recording.statuses()) this.#world.history.add(seconds, status);
    await this.seek(0);
    this.play();
  }

  play() {
    if (this.seconds >= this.recording.duration) this.seek(0);
    this.#setPlaying(true);
  }

  pause() {
    this.#setPlaying(false);
  }

  /** Goes to a time; the last of several seeks wins. */
  async seek(seconds) {
    const mine = ++this.#seeks;
    const at = Math.min(Math.max(seconds, 0), this.recording.duration);
    this.seconds = at;
    this.#seeking = true;
    this.#read = [];
    this.#source = null;
    try {
      const [frame, status] = await Promise.all([this.recording.frameAt(at), this.recording.statusAt(at)]);
      if (mine !== this.#seeks) return;
      this.#world.clearTime();
      this.#events = 0;
      this.#frameSeconds = frame?.seconds ?? 0;
      this.#takeKept();
      for (const bytes of frame?.samples ?? []) this.#give({ topic: "frames", seconds: frame.seconds, bytes });
      if (status) this.#give({ topic: "status", seconds: at, bytes: status });
      // From the frame's first chunk on: those of the next frame may be among its own.
      this.#source = this.recording.from(frame?.begins ?? at);
      this.#from = at;
      this.#seeking = false;
      this.emit("moved");
      await this.#fill();
    } catch (error) {
      this.emit("error", error);
    }
  }

  /** Goes to the next frame, or with -1 to the one before. */
  async step(direction = 1) {
    this.pause();
    if (direction < 0) {
      await this.seek(this.#frameSeconds - BACK);
      this.seconds = this.#frameSeconds;
    } else {
      await this.#fill();
      while (this.#read.length && !this.#give(this.#read.shift()));
    }
    this.#takeKept();
    this.emit("moved");
  }

  /** Called before each picture with the wall time since the last one, s. */
  advance(elapsed) {
    if (!this.playing || this.#seeking) return;
    const until = Math.min(this.seconds + elapsed * this.speed, this.recording.duration);
    while (this.#read.length && this.#read[0].seconds <= until) this.#give(this.#read.shift());
    // Where what comes next is not read yet, the recording is slower rather than that it leaves something out.
    if (this.#read.length || this.#source === null) this.seconds = until;
    this.#takeKept();
    if (this.seconds >= this.recording.duration) this.pause();
    this.emit("moved");
    this.#fill().catch((error) => this.emit("error", error));
  }

  #setPlaying(playing) {
    if (playing === this.playing) return;
    this.playing = playing;
    this.emit("playing", playing);
  }

  // Reads on until enough is there. One reader at a time.
  #fill() {
    this.#filling ??= this.#readOn().finally(() => (this.#filling = null));
    return this.#filling;
  }

  async #readOn() {
    while (this.#source && this.#read.length < MOST_AHEAD) {
      if (this.#read.length && this.#read.at(-1).seconds > this.seconds + AHEAD * this.speed) return;
      const source = this.#source;
      const { done, value } = await source.next();
      if (source !== this.#source) continue; // a seek began meanwhile
      if (done) this.#source = null;
      else if (value.topic === "frames" || value.seconds > this.#from) this.#read.push(value);
    }
  }

  // True when the message completed a frame.
  #give({ topic, seconds, bytes }) {
    if (!this.#take(topic, { seconds, bytes })) return false;
    this.#frameSeconds = seconds;
    this.seconds = Math.max(this.seconds, seconds);
    return true;
  }

  // What was in force at the time, and the events up to it. The first scene and parameters hold from the start, since
  // topics have no common order.
  #takeKept() {
    const now = Math.max(this.seconds, this.#frameSeconds);
    const { scene, topology, parameters, events } = this.recording.kept;
    if (this.#takeNewest("scene", scene, now)) for (const message of topology) this.#take("topology", message);
    this.#takeNewest("parameters", parameters, now);
    for (; this.#events < events.length && events[this.#events].seconds <= now; ++this.#events) {
      this.#take("events", events[this.#events]);
    }
  }

  // True when it was another than the one that the world has.
  #takeNewest(topic, messages, now) {
    let newest = 0;
    while (newest + 1 < messages.length && messages[newest + 1].seconds <= now) ++newest;
    if (messages.length === 0 || this.#taken[topic] === newest) return false;
    this.#taken[topic] = newest;
    this.#take(topic, messages[newest]);
    return true;
  }

  #take(topic, { seconds, bytes }) {
    return this.#world.take(topic, bytes, this.recording.decoder(topic), seconds);
  }
}
