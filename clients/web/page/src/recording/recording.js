import { McapIndexedReader } from "@mcap/core";

import { peekFrame } from "../decode/particle_frame.js";
import { makeDecoder } from "../decode/idl.js";
import { BlobReadable } from "./blob_readable.js";
import { decompressHandlers } from "./decompress.js";

// Topics with few messages: they are kept, so that any moment is put together without reading them again.
const KEPT = ["scene", "topology", "parameters", "events"];
const TOPIC_PREFIX = "flexcast/";
const SMALL_FILE = 64 << 20; // bytes; statuses of larger ones are not read in advance

/** A recording, read through its index: what is needed of the file, when it is needed. Times are seconds from its start. */
export class Recording {
  kept = Object.fromEntries(KEPT.map((topic) => [topic, []])); // topic -> [{seconds, bytes}]

  #reader;
  #decoders = new Map(); // topic -> function

  /** Opens a recording. Rejects with a sentence that says what is wrong with the file. */
  static async open(file) {
    let reader;
    try {
      reader = await McapIndexedReader.Initialize({ readable: new BlobReadable(file), decompressHandlers });
    } catch (error) {
      throw new Error(`${file.name} cannot be played: ${explain(error)}`);
    }
    const recording = new Recording(file, reader);
    if (!recording.#decoders.has("frames")) throw new Error(`${file.name} has no frames of flexcast.`);
    for await (const message of recording.#messages(KEPT)) {
      recording.kept[message.topic].push({ seconds: message.seconds, bytes: message.bytes });
    }
    return recording;
  }

  constructor(file, reader) {
    this.name = file.name;
    this.bytes = file.size;
    this.#reader = reader;
    const { messageStartTime = 0n, messageEndTime = 0n } = reader.statistics ?? {};
    this.start = messageStartTime; // ns
    this.duration = this.#seconds(messageEndTime);
    for (const channel of reader.channelsById.values()) {
      const schema = reader.schemasById.get(channel.schemaId);
      if (!channel.topic.startsWith(TOPIC_PREFIX) || schema?.encoding !== "omgidl") continue;
      const text = new TextDecoder().decode(schema.data);
      this.#decoders.set(channel.topic.slice(TOPIC_PREFIX.length), makeDecoder(text, schema.name));
    }
  }

  decoder(topic) {
    return this.#decoders.get(topic);
  }

  /** All statuses in order as [{seconds, status}]; none of a large file, where that would mean to read it whole. */
  async statuses() {
    const statuses = [];
    if (this.bytes > SMALL_FILE || !this.#decoders.has("status")) return statuses;
    const decode = this.#decoders.get("status");
    for await (const { seconds, bytes } of this.#messages(["status"])) statuses.push({ seconds, status: decode(bytes) });
    return statuses;
  }

  /** Frames and statuses from a time on, in order, as {topic, seconds, bytes}. */
  from(seconds) {
    return this.#messages(["frames", "status"], { startTime: this.#nanoseconds(seconds) });
  }

  /**
   * The last whole frame at a time, or the first one when the recording begins later: {seconds, begins, samples}, with the
   * times of its last and its first sample; null when there is none at all.
   */
  async frameAt(seconds) {
    const endTime = this.#nanoseconds(seconds);
    const before = await firstWhole(this.#messages(["frames"], { endTime, reverse: true }));
    return before ?? firstWhole(this.#messages(["frames"], { startTime: endTime }));
  }

  /** The bytes of the last status at a time, or undefined. */
  async statusAt(seconds) {
    for await (const { bytes } of this.#messages(["status"], { endTime: this.#nanoseconds(seconds), reverse: true })) {
      return bytes;
    }
    return undefined;
  }

  async *#messages(topics, options = {}) {
    const names = topics.map((topic) => TOPIC_PREFIX + topic);
    for await (const { channelId, logTime, data } of this.#reader.readMessages({ topics: names, ...options })) {
      const topic = this.#reader.channelsById.get(channelId).topic.slice(TOPIC_PREFIX.length);
      yield { topic, seconds: this.#seconds(logTime), bytes: data };
    }
  }

  #seconds(nanoseconds) {
    return Number(nanoseconds - this.start) / 1e9;
  }

  #nanoseconds(seconds) {
    return this.start + BigInt(Math.round(Math.max(seconds, 0) * 1e9));
  }
}

// Chunks of a frame are written one after the other, but those of two frames may be mixed.
async function firstWhole(messages) {
  const open = new Map();
  for await (const { seconds, bytes } of messages) {
    const { run_id, frame, chunk, chunks } = peekFrame(bytes);
    const key = `${run_id} ${frame}`;
    const parts = open.get(key) ?? { samples: [], times: [] };
    parts.samples[chunk] = bytes;
    parts.times.push(seconds);
    open.set(key, parts);
    if (parts.samples.length < chunks || parts.samples.includes(undefined)) continue;
    return { seconds: Math.max(...parts.times), begins: Math.min(...parts.times), samples: parts.samples };
  }
  return null;
}

function explain(error) {
  if (/magic|footer|index|too small|empty/i.test(error.message)) {
    return "it has no index, as when a recorder was killed. Finish it first: flexcast-record --recover FILE";
  }
  return error.message;
}
