// node use_web.mjs URL PROTOCOL: connects to a flexcast-web that shows the world of a scene with a body "rope" which is
// paused, uses everything it offers, and prints what it saw as one JSON object. Whatever is not as promised is an
// error.
import { WebClient } from "./web_client.mjs";

function require(claim, what) {
  if (!claim) throw new Error(what);
}

async function use(url, protocol) {
  const client = new WebClient(url, protocol);
  const info = await client.wait("server info", () => client.info?.metadata.world && client.info);
  require(client.protocol === protocol, `the server speaks '${client.protocol}'`);

  for (const topic of ["scene", "topology", "parameters", "status", "events", "frames", "points"])
    await client.subscribe(`flexcast/${topic}`);
  const scene = (await client.message("flexcast/scene")).value;
  await client.wait("topology of every body", () => {
    const topologies = client.messages("flexcast/topology").map(({ value }) => value);
    return topologies.reduce((sum, value) => sum + value.rest_positions.length, 0) === 3 * scene.particles;
  });
  const first = await client.message("flexcast/frames");
  require(Math.abs(Number(first.timestamp) / 1e6 - Date.now()) < 3.6e6, "a timestamp that is not of today");

  const values = await client.getParameters([], "all");
  client.watchParameters([]);
  const set = await client.setParameters([{ name: "rope.stiffness", value: 25, type: "float64" }], "set");
  const update = await client.update("rope.stiffness");
  const refused = await client.setParameters([{ name: "rope.stiffness", value: -1, type: "float64" }], "refused");
  const refusal = client.statuses.findLast((status) => status.level === 2)?.message;

  const stepped = await client.call("flexcast/step", { count: 10 });
  const frame = await client.message("flexcast/frames", (value) => value.step === 10n);
  const points = await client.message("flexcast/points", (value) => value.timestamp.sec > 0);
  const grabbed = await client.call("flexcast/grab", { particle: 3, target: [0, 0, 1] });
  const released = await client.call("flexcast/release", { particle: 3 });
  const failure = await client.call("flexcast/step", { count: "many" });
  const unknown = await client.call("flexcast/set", { values: { "no.such": 1 } });
  const reset = await client.call("flexcast/reset", {});
  const again = await client.message("flexcast/frames", (value) => value.run_id.toString() === reset.run_id);
  client.close();
  return {
    protocol: client.protocol,
    world: info.metadata.world,
    channels: [...client.channels.keys()],
    services: [...client.services.keys()],
    particles: scene.particles,
    young: values["rope.stiffness"],
    set: set["rope.stiffness"],
    update,
    refused: refused["rope.stiffness"],
    refusal,
    stepped,
    frame: { step: frame.value.step, positions: frame.value.positions64.length + frame.value.positions.length },
    points: { fields: points.value.fields.map(({ name }) => name), bytes: points.value.data.length,
              stride: points.value.point_stride, frame: points.value.frame_id },
    grabbed: grabbed.outcome,
    released: released.outcome,
    failure: failure.failure,
    unknown,
    reset,
    again: again.value.step,
  };
}

try {
  const report = await use(process.argv[2], process.argv[3]);
  console.log(JSON.stringify(report, (_key, value) => (typeof value === "bigint" ? Number(value) : value)));
  process.exit(0);
} catch (error) {
  console.error(error.message);
  process.exit(1);
}
