import { WORLD_STATES } from "./decode/idl.js";
import { get } from "./ui/dom.js";
import { COLOURINGS } from "./view/colouring.js";

/** What buttons and keys do. A command that was not applied is said. */
export class Actions {
  constructor(app) {
    this.app = app;
  }

  keys() {
    return {
      " ": () => this.toggle(),
      s: () => this.step(1),
      ArrowRight: () => this.step(1),
      ArrowLeft: () => this.step(-1),
      r: () => this.reset(),
      c: () => this.nextColour(),
      v: () => this.toggleMode(),
      f: () => this.fit(),
      g: () => this.toggleHand(),
      p: () => this.togglePanel(),
      o: () => this.openFile(),
      "?": () => this.toggleHelp(),
    };
  }

  toggle() {
    const { player, running } = this.app;
    if (player) return running ? player.pause() : player.play();
    return this.command(running ? "pause" : "resume");
  }

  async step(direction) {
    const { player, running } = this.app;
    if (player) return player.step(direction);
    if (direction < 0) return undefined;
    if (running && !(await this.command("pause"))) return undefined;
    return this.command("step", { count: 1 });
  }

  reset() {
    if (this.app.player) return this.app.player.seek(0);
    return this.command("reset");
  }

  setRate(rate) {
    return this.command("set", { values: { "server.rate": rate } });
  }

  setSpeed(speed) {
    if (this.app.player) this.app.player.speed = speed;
  }

  seek(seconds) {
    return this.app.player?.seek(seconds);
  }

  goLive() {
    this.app.goLive();
  }

  chooseWorld(name) {
    const address = new URL(location.href);
    address.searchParams.set("world", name);
    history.replaceState(null, "", address);
    this.app.live.choose(name);
  }

  /** The reply to a batch of parameters {name: value}. */
  setParameters(values) {
    return this.app.live.command("set", { values });
  }

  colourBy(colouring) {
    this.app.viewport.colourBy(colouring);
    this.app.screen.refresh();
  }

  nextColour() {
    const names = Object.keys(COLOURINGS).filter((name) => !this.app.viewport.unavailable(name));
    this.colourBy(names[(names.indexOf(this.app.viewport.colouring) + 1) % names.length]);
  }

  toggleMode() {
    const { viewport } = this.app;
    viewport.show(viewport.body?.mode === "surface" ? "particles" : "surface");
    this.app.screen.refresh();
  }

  toggleHand() {
    this.app.grab.always = !this.app.grab.always;
    this.app.screen.refresh();
  }

  fit() {
    this.app.viewport.fit({ home: true });
  }

  toggleTheme() {
    this.app.screen.theme.toggle();
  }

  togglePanel() {
    this.app.screen.panel.toggle();
  }

  toggleHelp() {
    const help = get("help");
    if (help.open) help.close();
    else help.showModal();
  }

  openFile() {
    get("file").click();
  }

  /** True when it was applied. */
  async command(verb, request = {}) {
    const { app } = this;
    try {
      const reply = await app.live.command(verb, request);
      if (reply.outcome === "applied") {
        if (app.world.status && WORLD_STATES.includes(reply.state)) app.world.status.state = WORLD_STATES.indexOf(reply.state);
        app.screen.refresh();
        return true;
      }
      app.screen.say(reply.reason || `The server answered ${reply.outcome}.`);
    } catch (error) {
      app.screen.say(error.message);
    }
    return false;
  }
}
