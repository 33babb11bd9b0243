// Tally: takes the records of a recording one by one, decodes every message and keeps count.
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";

import { FrameTally } from "./frame_tally.mjs";

export class Tally {
  header = { library: "", profile: "" };
  topics = {};
  attachments = {};
  metadata = {};
  messages = 0;
  complete = true;
  frames = new FrameTally();

  #schemas = new Map();
  #channels = new Map();
  #readers = new Map(); // of a schema id
  #definitions = new Map(); // of an IDL text

  add(record) {
    switch (record.type) {
      case "Header":
        this.header = record;
        break;
      case "Schema":
        this.#schemas.set(record.id, record);
        break;
      case "Channel":
        this.#addChannel(record);
        break;
      case "Message":
        this.#addMessage(record);
        break;
      case "Attachment":
        this.attachments[record.name] = record.data.length;
        break;
      case "Metadata":
        this.metadata[record.name] = Object.fromEntries(record.metadata);
        break;
    }
  }

  report() {
    return {
      complete: this.complete,
      topics: this.topics,
      attachments: Object.keys(this.attachments),
      metadata: this.metadata,
      library: this.header.library,
      profile: this.header.profile,
      ...this.frames.report(),
    };
  }

  #addChannel(channel) {
    if (this.#channels.has(channel.id)) return; // the summary repeats it
    this.#channels.set(channel.id, channel);
    this.topics[channel.topic] ??= {
      schema: this.#schemas.get(channel.schemaId)?.name ?? "",
      messages: 0,
      first_sequence: null,
      last_sequence: null,
      gaps: 0,
    };
  }

  #addMessage(message) {
    const channel = this.#channels.get(message.channelId);
    const topic = this.topics[channel.topic];
    const { sequence } = message;
    // A smaller number than the last starts a new run; the same again is a further chunk of one frame.
    if (topic.last_sequence !== null) topic.gaps += Math.max(0, sequence - topic.last_sequence - 1);
    topic.first_sequence ??= sequence;
    topic.last_sequence = sequence;
    topic.messages += 1;
    this.messages += 1;

    const schema = this.#schemas.get(channel.schemaId);
    if (schema?.encoding !== "omgidl") return;
    const decoded = this.#decode(schema, channel, message);
    if (schema.name === "flexcast::ParticleFrame") this.frames.add(decoded, sequence);
  }

  #decode(schema, channel, message) {
    try {
      if (!this.#readers.has(schema.id)) this.#readers.set(schema.id, this.#makeReader(schema));
      return this.#readers.get(schema.id).readMessage(message.data);
    } catch (error) {
      const what = `${channel.topic}, message ${message.sequence}`;
      throw new Error(`${what} does not decode as ${schema.name}: ${error.message}`);
    }
  }

  #makeReader(schema) {
    const text = new TextDecoder().decode(schema.data);
    if (!this.#definitions.has(text)) this.#definitions.set(text, parseIDL(text));
    return new MessageReader(schema.name, this.#definitions.get(text));
  }
}
