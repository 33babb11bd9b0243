import assert from "node:assert/strict";
import { test } from "node:test";

import { idl, sample } from "../support/samples.mjs";
import { page } from "./page.mjs";

const { Connection } = await page("live/connection.js");
const { LiveWorld } = await page("live/live_world.js");
const { Backoff } = await page("live/backoff.js");
const { World } = await page("model/world.js");

// A bridge at the other end of a socket that is none.
class FakeSocket {
  readyState = 1;
  texts = [];
  calls = [];

  send(data) {
    if (typeof data === "string") return this.texts.push(JSON.parse(data));
    const view = new DataView(data.buffer);
    const body = 13 + view.getUint32(9, true);
    return this.calls.push({ service: view.getUint32(1, true), call: view.getUint32(5, true), body: JSON.parse(Buffer.from(data.subarray(body)).toString()) });
  }

  say(message) {
    this.onmessage({ data: JSON.stringify(message) });
  }

  advertise(prefix = "", firstId = 1) {
    const channels = ["frames", "scene", "topology", "parameters", "status", "events"].map((topic, i) => ({
      id: firstId + i, topic: `${prefix}flexcast/${topic}`, encoding: "cdr", schemaEncoding: "omgidl", schema: idl,
      schemaName: `flexcast::${{ frames: "ParticleFrame", scene: "SceneInfo", topology: "Topology", parameters: "ParameterSet", status: "Status", events: "Event" }[topic]}`,
    }));
    this.say({ op: "advertise", channels });
    this.say({ op: "advertiseServices", services: [{ id: firstId + 20, name: `${prefix}flexcast/pause` }] });
    return channels;
  }

  message(subscription, bytes) {
    const data = Buffer.concat([Buffer.alloc(13), bytes]);
    const view = new DataView(data.buffer, data.byteOffset);
    view.setUint8(0, 1);
    view.setUint32(1, subscription, true);
    view.setBigUint64(5, 2_000_000_000n, true);
    this.onmessage({ data: data.buffer.slice(data.byteOffset, data.byteOffset + data.length) });
  }

  answer({ service, call }, body) {
    const payload = Buffer.from(JSON.stringify(body));
    const data = Buffer.concat([Buffer.alloc(17), payload]);
    data.writeUInt8(3, 0);
    data.writeUInt32LE(service, 1);
    data.writeUInt32LE(call, 5);
    data.writeUInt32LE(4, 9);
    data.write("json", 13);
    this.onmessage({ data: data.buffer.slice(data.byteOffset, data.byteOffset + data.length) });
  }
}

function connected(wanted = "") {
  const sockets = [];
  const connection = new Connection("ws://x/", () => {
    sockets.push(new FakeSocket());
    return sockets.at(-1);
  });
  const world = new World();
  const live = new LiveWorld(connection, world, wanted);
  const begin = () => {
    const socket = sockets.at(-1);
    socket.onopen();
    socket.say({ op: "serverInfo", name: "flexcast-web", capabilities: [], metadata: { world: "home" } });
    return socket;
  };
  connection.open();
  return { connection, world, live, sockets, begin, socket: begin() };
}

const subscriptions = (socket) => socket.texts.filter(({ op }) => op === "subscribe").flatMap((message) => message.subscriptions);

test("subscribes to the home world's topics, frames last, and takes what comes", () => {
  const { socket, world, live } = connected();
  const channels = socket.advertise();
  const topics = subscriptions(socket).map(({ channelId }) => channels.find(({ id }) => id === channelId).topic);
  assert.equal(topics.length, 6);
  assert.equal(topics.at(-1), "flexcast/frames");
  assert.equal(live.link.state, "connected");
  const status = subscriptions(socket).find(({ channelId }) => channelId === 5);
  socket.message(status.id, sample("Status", { world: "home", state: 1 }));
  assert.equal(world.status.state, 1);
  assert.equal(world.history.seconds.at(-1), 2);
});

test("another world's names begin with its own", () => {
  const { socket, live, connection } = connected("other");
  socket.advertise();
  assert.equal(live.link.state, "waiting");
  socket.advertise("other/", 101);
  assert.equal(live.link.state, "connected");
  assert.deepEqual(live.worlds, ["home", "other"]);
  assert.ok(subscriptions(socket).every(({ channelId }) => channelId > 100));
  live.command("pause");
  assert.equal(socket.calls.at(-1).service, 121);
  live.choose("home");
  assert.ok(connection.isSubscribed(1));
  assert.ok(!connection.isSubscribed(101));
});

test("another home world under the same names is asked for anew", () => {
  const { socket, world } = connected();
  socket.advertise();
  const status = subscriptions(socket).find(({ channelId }) => channelId === 5);
  socket.message(status.id, sample("Status", { world: "home" }));
  socket.say({ op: "serverInfo", name: "flexcast-web", capabilities: [], metadata: { world: "next" } });
  assert.equal(world.status, null);
  assert.equal(subscriptions(socket).length, 12);
});

test("a service's answer belongs to its call, and a failure is its sentence", async () => {
  const { socket, live } = connected();
  socket.advertise();
  const [first, second] = [live.command("pause"), live.command("pause")];
  socket.answer(socket.calls[1], { outcome: "applied", applied_step: 12 });
  assert.equal((await second).applied_step, 12);
  socket.say({ op: "serviceCallFailure", serviceId: 21, callId: socket.calls[0].call, message: "no answer" });
  await assert.rejects(first, /no answer/);
  await assert.rejects(live.command("nothing"), /no service/);
});

test("a lost connection fails what waits, comes back by itself and subscribes again", async (context) => {
  let later;
  context.mock.method(globalThis, "setTimeout", (then, wait) => (later = { then, wait }));
  const { socket, live, sockets, begin } = connected();
  socket.advertise();
  const call = live.command("pause");
  socket.onclose();
  await assert.rejects(call, /lost/);
  assert.equal(live.link.state, "lost");
  assert.equal(later.wait, 250);
  later.then();
  assert.equal(sockets.length, 2);
  begin().advertise();
  assert.equal(live.link.state, "connected");
  assert.equal(subscriptions(sockets[1]).length, 6);
});

test("attempts wait longer and longer, up to a bound, and start anew after one that worked", () => {
  const backoff = new Backoff(250, 4000);
  assert.deepEqual(Array.from({ length: 6 }, () => backoff.next()), [250, 500, 1000, 2000, 4000, 4000]);
  backoff.reset();
  assert.equal(backoff.next(), 250);
});

test("a world that falls silent is said, until it is back", () => {
  const { socket, live } = connected();
  socket.advertise();
  socket.say({ op: "status", level: 2, id: "world:home", message: "home is silent" });
  assert.deepEqual(live.link, { state: "silent", text: "home is silent" });
  socket.say({ op: "removeStatus", statusIds: ["world:home"] });
  assert.equal(live.link.state, "connected");
});

test("frames are not asked for while nobody can see them, nor anything while a recording plays", () => {
  const { socket, live, connection } = connected();
  socket.advertise();
  live.showFrames(false);
  assert.ok(!connection.isSubscribed(1));
  assert.ok(connection.isSubscribed(5));
  live.showFrames(true);
  assert.ok(connection.isSubscribed(1));
  live.feed(false);
  assert.ok(![1, 2, 3, 4, 5, 6].some((id) => connection.isSubscribed(id)));
  live.feed(true);
  assert.ok(connection.isSubscribed(1));
});

test("frames wait for the topology they belong to", () => {
  const world = new World();
  const scene = sample("SceneInfo", { topology_revision: 4n, particles: 1, bodies: [{ name: "b", particles: 1 }] });
  const topology = sample("Topology", { topology_revision: 4n, chunks: 1, rest_positions: [0, 0, 0] });
  const frame = sample("ParticleFrame", { topology_revision: 4n, chunks: 1, total: 1, positions: [1, 2, 3] });
  const take = (topic, bytes, type) => world.take(topic, bytes, (raw) => decoders[type](raw), 0);
  take("frames", frame);
  assert.equal(world.nextFrame(), false);
  take("topology", topology, "Topology");
  take("scene", scene, "SceneInfo");
  assert.equal(world.nextFrame(), true);
  assert.deepEqual(Array.from(world.particles.positions), [1, 2, 3]);
  assert.equal(world.nextFrame(), false);
});

const { makeDecoder } = await page("decode/idl.js");
const decoders = { Topology: makeDecoder(idl, "flexcast::Topology"), SceneInfo: makeDecoder(idl, "flexcast::SceneInfo") };
