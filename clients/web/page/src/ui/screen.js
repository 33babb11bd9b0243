import { ColourBar } from "./colour_bar.js";
import { get } from "./dom.js";
import { Events } from "./events.js";
import { Greeting } from "./greeting.js";
import { Health } from "./health.js";
import { fillHelp } from "./help.js";
import { Notices } from "./notices.js";
import { Panel } from "./panel.js";
import { Parameters } from "./parameters.js";
import { Plots } from "./plots.js";
import { Probes } from "./probes.js";
import { Theme } from "./theme.js";
import { Tools } from "./tools.js";
import { Transport } from "./transport.js";

const TEXT_PERIOD = 100; // ms
const PLOT_PERIOD = 250; // ms
const NARROW = 720; // px: the panel is a drawer

/** Everything around the picture. Texts follow at most ten times a second, so that they can be read. */
export class Screen {
  #app;
  #lastText = 0;
  #lastPlot = 0;
  #events = new Events();
  #probes = new Probes();

  constructor(app, actions) {
    this.#app = app;
    const bound = bind(actions);
    this.#makeParts(bound);
    this.theme = new Theme(() => this.#restyle());
    app.world
      .on("parameters", (parameters) => this.parameters.update(parameters))
      .on("status", (status) => this.#probes.update(status))
      .on("events", (events) => this.#eventsChanged(events));
    app.live.on("worlds", (worlds) => this.health.setWorlds(worlds, app.live.name)).on("link", () => this.refresh());
    const resized = new ResizeObserver(() => this.#place());
    for (const element of [document.body, get("health")]) resized.observe(element);
    this.panel.toggle(innerWidth > NARROW);
  }

  say(text) {
    this.notices.say(text);
  }

  setRecording(recording) {
    this.transport.setRecording(recording);
    this.parameters.setReadOnly(recording !== null);
    this.plots.setCursor(recording ? 0 : null, recording?.duration);
    this.refresh();
    this.#place();
  }

  /** Called before each picture. */
  tick(now) {
    if (now - this.#lastText >= TEXT_PERIOD) this.refresh(now);
    if (now - this.#lastPlot < PLOT_PERIOD) return;
    this.#lastPlot = now;
    const { player } = this.#app;
    if (player) this.plots.setCursor(player.seconds, player.recording.duration);
    this.plots.draw();
  }

  refresh(now = performance.now()) {
    this.#lastText = now;
    const { world, live, player, viewport, grab, shown, running, commandable } = this.#app;
    const { received, absent } = world.frames;
    const counts = { shown, missed: Math.max(0, received + absent - shown) };
    const recording = player?.recording.name ?? null;
    this.health.update({ link: live.link, status: world.status, scene: world.scene, recording, counts, particles: world.particles });
    this.transport.update({ running, enabled: commandable, rate: world.status?.rate ?? null, player });
    const { colouring, body } = viewport;
    const unavailable = (name) => (body ? viewport.unavailable(name) : "");
    this.tools.update({
      colouring, unavailable, mode: body?.mode, hasSurface: body?.hasSurface ?? false,
      hand: grab.always, dark: this.theme.dark, panel: this.panel.open,
    });
    this.colourBar.update(colouring, viewport.range, unavailable(colouring), body !== null);
    this.notices.update(world.status, live.link, { recorded: recording !== null, atRest: viewport.atRest });
    this.greeting.update(live.link, !(body && world.particles.total));
  }

  #makeParts(bound) {
    this.health = new Health(get("health"), bound.chooseWorld);
    this.transport = new Transport(get("transport"), bound);
    this.tools = new Tools(get("tools"), bound);
    this.colourBar = new ColourBar(get("colour-bar"));
    this.notices = new Notices(get("notices"), bound.reset);
    this.greeting = new Greeting(get("greeting"), bound.openFile);
    this.parameters = new Parameters(bound.setParameters);
    this.plots = new Plots(this.#app.world.history);
    const sections = { Parameters: this.parameters, Plots: this.plots, Probes: this.#probes, Events: this.#events };
    this.panel = new Panel(get("panel"), sections, () => this.#place());
    fillHelp(get("help"));
  }

  #eventsChanged(events) {
    if (this.#eventsDue) return;
    this.#eventsDue = true;
    setTimeout(() => {
      this.#eventsDue = false;
      this.#events.update(this.#app.world.events);
    }, events.length ? PLOT_PERIOD : 0);
  }

  #eventsDue = false;

  // What covers the picture.
  #place() {
    const panel = get("panel");
    const open = this.panel?.open;
    document.body.style.setProperty("--health-height", `${get("health").offsetHeight}px`);
    document.body.classList.toggle("panel-open", Boolean(open));
    const narrow = innerWidth <= NARROW;
    const beside = open && !narrow ? panel.offsetWidth + 12 : 0;
    const below = open && narrow ? panel.offsetHeight : 64;
    this.#app.viewport.setInsets({ left: 0, right: beside, top: get("health").offsetHeight, bottom: below });
    this.plots?.draw();
  }

  #restyle() {
    const style = getComputedStyle(document.documentElement);
    const read = (name) => style.getPropertyValue(name).trim();
    this.#app.viewport.setTheme({
      plain: read("--body"), ink: read("--ink"), grid: Number(read("--grid")), obstacle: read("--obstacle"), shadow: Number(read("--shadow")),
    });
    this.plots.restyle();
  }
}

// The methods of an object as functions of their own.
function bind(object) {
  const names = Object.getOwnPropertyNames(Object.getPrototypeOf(object));
  return Object.fromEntries(names.map((name) => [name, (...values) => object[name](...values)]));
}
