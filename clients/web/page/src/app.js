import { Actions } from "./actions.js";
import { Connection } from "./live/connection.js";
import { GrabStream } from "./live/grab_stream.js";
import { LiveWorld } from "./live/live_world.js";
import { Timings } from "./model/timings.js";
import { troublePoints } from "./model/trouble.js";
import { World } from "./model/world.js";
import { Player } from "./recording/player.js";
import { Recording } from "./recording/recording.js";
import { get } from "./ui/dom.js";
import { listenToFiles } from "./ui/drop.js";
import { listenToKeys } from "./ui/keyboard.js";
import { Screen } from "./ui/screen.js";
import { Grab } from "./view/grab.js";
import { Viewport } from "./view/viewport.js";

const STATES = { running: 0, failed: 3 };

/** The page: one World, fed by a bridge or by a recording, and what shows it. */
export class App {
  world = new World();
  player = null; // of the recording that is played
  timings = new Timings();
  shown = 0; // frames of this run that were drawn
  troubled = false; // the world has failed
  ready; // the first picture was drawn, ms after the page began

  #run = null;
  #lastTick = performance.now();
  #lastFrame = 0;

  constructor() {
    const wanted = new URLSearchParams(location.search).get("world") ?? "";
    this.connection = new Connection(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/`);
    this.live = new LiveWorld(this.connection, this.world, wanted);
    this.connection.open(); // what it answers comes while the rest is made
    this.viewport = new Viewport(get("view"), this.world);
    this.actions = new Actions(this);
    this.screen = new Screen(this, this.actions);
    this.#makeGrab();
    this.world.on("status", (status) => this.#showTrouble(status));
    this.live.on("message", (text) => this.screen.say(text));
    listenToKeys(this.actions.keys());
    listenToFiles(get("drop-hint"), get("file"), (file) => this.open(file));
    document.addEventListener("visibilitychange", () => this.live.showFrames(!document.hidden));
    requestAnimationFrame((now) => this.#tick(now));
  }

  get running() {
    return this.player ? this.player.playing : this.world.status?.state === STATES.running;
  }

  /** Whether commands would be heard. */
  get commandable() {
    return this.player !== null || (this.live.link.state === "connected" && this.world.status !== null);
  }

  /** Plays a recording in place of the live world. */
  async open(file) {
    try {
      const recording = await Recording.open(file);
      this.live.feed(false);
      this.player?.pause();
      this.world.clear();
      this.player = new Player(recording, this.world);
      this.player.on("error", ({ message }) => this.screen.say(message));
      this.screen.setRecording(recording);
      await this.player.start();
    } catch (error) {
      this.screen.say(error.message);
    }
  }

  /** Back from a recording to the live world. */
  goLive() {
    this.player?.pause();
    this.player = null;
    this.world.clear();
    this.screen.setRecording(null);
    this.live.feed(true);
  }

  #makeGrab() {
    const stream = new GrabStream(
      (verb, request) => this.live.command(verb, request),
      (text) => this.screen.say(text),
    );
    this.grab = new Grab(this.viewport, get("view"), {
      enabled: () => this.player === null && this.commandable,
      moved: (particle, target) => stream.move(particle, target),
      released: () => {
        stream.release();
        this.#markGrab();
      },
    });
  }

  #tick(now) {
    const elapsed = Math.min((now - this.#lastTick) / 1000, 0.25);
    this.#lastTick = now;
    this.player?.advance(elapsed);
    this.#drawFrame(now);
    this.screen.tick(now);
    requestAnimationFrame((next) => this.#tick(next));
  }

  #drawFrame(now) {
    const began = performance.now();
    const fresh = this.world.nextFrame();
    const decoded = performance.now();
    if (fresh) {
      this.#count();
      this.viewport.update((now - this.#lastFrame) / 1000);
      this.#showTrouble(this.world.status);
      this.#lastFrame = now;
    }
    if (this.grab.particle >= 0) this.#markGrab();
    const prepared = performance.now();
    const drawn = this.viewport.draw();
    if (!fresh || !drawn) return;
    const done = performance.now();
    this.timings.add(decoded - began, prepared - decoded, done - prepared);
    this.ready ??= done;
  }

  #count() {
    const { run_id } = this.world.particles;
    if (run_id !== this.#run) this.shown = 0;
    this.#run = run_id;
    this.shown += 1;
  }

  #markGrab() {
    const { particle, target } = this.grab;
    const from = particle >= 0 && this.viewport.body ? Array.from(this.viewport.body.positions.subarray(3 * particle, 3 * particle + 3)) : null;
    this.viewport.marks.showGrab(from, target);
    this.viewport.changed = true;
  }

  #showTrouble(status) {
    if ((status?.state === STATES.failed) !== this.troubled && this.world.particles.total) {
      this.troubled = status?.state === STATES.failed;
      this.viewport.update(0);
    }
    const points = troublePoints(status, this.world.topology, this.viewport.body?.positions);
    this.viewport.marks.showTrouble(points);
    this.viewport.changed = true;
  }
}
