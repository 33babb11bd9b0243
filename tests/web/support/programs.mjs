// The real programs on a DDS domain of the test's own. Whatever a test starts ends with it.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { PATIENCE } from "./browser.mjs";

const bin = process.env.FLEXCAST_BIN ?? fileURLToPath(new URL("../../../build-tests/bin", import.meta.url));
const [LOWEST, HIGHEST] = (process.env.FLEXCAST_DOMAINS ?? "1-99").split("-").map(Number);

/** A scene of the ones that come with the server. */
export const shippedScene = (name) => fileURLToPath(new URL(`../../../server/scenes/${name}.toml`, import.meta.url));

/** A folder and a domain; start() programs, and end() everything. */
export class Programs {
  folder = mkdtempSync(join(tmpdir(), "flexcast-web-"));
  domain = chooseDomain();

  #started = [];
  #killAtExit = () => this.#killAll();

  constructor() {
    process.on("exit", this.#killAtExit);
  }

  path(name) {
    return join(this.folder, name);
  }

  write(name, content) {
    writeFileSync(this.path(name), content);
    return this.path(name);
  }

  server(scene, ...options) {
    return this.#start("flexcast-server", [scene, ...options], "ready:");
  }

  /** Its `address` is the page's. Port 0: any that is free. */
  async web(port = 0) {
    const web = await this.#start("flexcast-web", ["--port", String(port)], "ready: ");
    web.address = /ready: (\S+)/.exec(web.said)[1];
    return web;
  }

  recorder(file, ...options) {
    return this.#start("flexcast-record", ["-o", this.path(file), ...options], "recording:");
  }

  async end() {
    await Promise.all(this.#started.map((program) => program.stop("SIGTERM")));
    process.off("exit", this.#killAtExit);
    rmSync(this.folder, { recursive: true });
  }

  async #start(name, options, ready) {
    const program = new Program(join(bin, name), [...options, "--domain", String(this.domain)], this.folder);
    this.#started.push(program);
    await program.waitFor(ready);
    return program;
  }

  #killAll() {
    for (const { child } of this.#started) child.kill("SIGKILL");
  }
}

class Program {
  said = "";

  constructor(path, options, cwd) {
    this.child = spawn(path, options, { cwd, stdio: ["ignore", "pipe", "pipe"] });
    this.ended = new Promise((resolve) => this.child.on("close", resolve));
    for (const stream of [this.child.stdout, this.child.stderr]) stream.on("data", (text) => (this.said += text));
    this.command = [path, ...options].join(" ");
  }

  async waitFor(text) {
    const latest = Date.now() + PATIENCE;
    while (!this.said.includes(text)) {
      if (this.child.exitCode !== null || Date.now() > latest) throw new Error(`${this.command} did not say "${text}":\n${this.said}`);
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
  }

  async stop(signal) {
    if (this.child.exitCode === null && this.child.signalCode === null) this.child.kill(signal);
    return this.ended;
  }
}

// One whose first port (DDSI: 7400 + 250 domain + 10) nobody has.
function chooseDomain() {
  const taken = new Set(
    readFileSync("/proc/net/udp", "utf8").split("\n").slice(1, -1).map((line) => parseInt(line.trim().split(/\s+/)[1].split(":")[1], 16)),
  );
  const count = HIGHEST - LOWEST + 1;
  for (let i = 0; i < count; ++i) {
    const domain = LOWEST + ((process.pid + 37 * i) % count);
    if (!taken.has(7410 + 250 * domain)) return domain;
  }
  throw new Error("every DDS domain is in use");
}
