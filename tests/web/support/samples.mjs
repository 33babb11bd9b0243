// Samples of the contract and recordings of them, made by libraries that others wrote.
import { readFileSync } from "node:fs";

import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageWriter } from "@foxglove/omgidl-serialization";
import { McapWriter } from "@mcap/core";

export const idl = readFileSync(new URL("../../../idl/flexcast.idl", import.meta.url), "utf8");
const definitions = parseIDL(idl);

/** A sample of flexcast::TYPE; members that are left out are zero, empty or "". */
export function sample(type, message) {
  return new MessageWriter(`flexcast::${type}`, definitions).writeMessage(complete(`flexcast::${type}`, message));
}

function complete(type, message) {
  const { definitions: fields } = definitions.find(({ name }) => name === type);
  return Object.fromEntries(fields.map((field) => [field.name, completeField(field, message[field.name])]));
}

function completeField({ type, isArray, isComplex, arrayLengths, enumType }, value) {
  const one = (item) => (isComplex && !enumType ? complete(type, item ?? {}) : (item ?? zero(type)));
  if (arrayLengths) return value ?? Array.from({ length: arrayLengths[0] }, () => one(undefined));
  if (!isArray) return one(value);
  return isComplex && !enumType ? (value ?? []).map(one) : (value ?? []);
}

const zero = (type) => (type === "string" ? "" : type.endsWith("int64") ? 0n : type === "bool" ? false : 0);

/** The bytes as a WebSocket brings them: 13 bytes into a buffer. */
export function atOffset(bytes, offset = 13) {
  const buffer = new Uint8Array(offset + bytes.length);
  buffer.set(bytes, offset);
  return buffer.subarray(offset);
}

const TYPES = {
  scene: "SceneInfo",
  topology: "Topology",
  parameters: "ParameterSet",
  frames: "ParticleFrame",
  status: "Status",
  events: "Event",
};

/** A recording, as bytes, of [{topic, seconds, message}] in the order given. */
export async function recordingOf(messages, { compressChunk, chunkSize = 2000 } = {}) {
  const parts = [];
  let size = 0n;
  const writable = {
    write: async (bytes) => {
      parts.push(bytes.slice());
      size += BigInt(bytes.length);
    },
    position: () => size,
  };
  const writer = new McapWriter({ writable, chunkSize, compressChunk });
  await writer.start({ profile: "", library: "test" });
  const channels = {};
  for (const [topic, type] of Object.entries(TYPES)) {
    const schemaId = await writer.registerSchema({ name: `flexcast::${type}`, encoding: "omgidl", data: Buffer.from(idl) });
    channels[topic] = await writer.registerChannel({ topic: `flexcast/${topic}`, schemaId, messageEncoding: "cdr", metadata: new Map() });
  }
  for (const { topic, seconds, message } of messages) {
    const time = 1_000_000_000_000n + BigInt(Math.round(seconds * 1e9));
    const data = sample(TYPES[topic], message);
    await writer.addMessage({ channelId: channels[topic], sequence: 0, logTime: time, publishTime: time, data });
  }
  await writer.end();
  return Buffer.concat(parts);
}
