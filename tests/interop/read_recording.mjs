// Reads a flexcast recording with libraries that others wrote and prints what it found as one JSON object.
//
//   node read_recording.mjs RUN.mcap              through the index, and once more from front to back
//   node read_recording.mjs --stream RUN.mcap     from front to back only: the file may lack its end
//
// Every message must decode with the schema in the file. Exit code 1 and a sentence on stderr if anything does not.
import { createReadStream } from "node:fs";
import { open } from "node:fs/promises";

import lz4 from "@foxglove/wasm-lz4";
import * as zstd from "@foxglove/wasm-zstd";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

import { Tally } from "./tally.mjs";

const decompressHandlers = {
  lz4: (packed, bytes) => lz4(packed, Number(bytes)),
  zstd: (packed, bytes) => zstd.decompress(packed, Number(bytes)),
};

// What McapIndexedReader wants from a file.
class ReadableFile {
  constructor(handle) {
    this.handle = handle;
  }

  async size() {
    return BigInt((await this.handle.stat()).size);
  }

  async read(offset, bytes) {
    const buffer = new Uint8Array(Number(bytes));
    const { bytesRead } = await this.handle.read(buffer, 0, buffer.length, Number(offset));
    if (bytesRead !== buffer.length) {
      throw new Error(`the file ends before byte ${offset + bytes}, where its index points to`);
    }
    return buffer;
  }
}

async function readThroughIndex(path) {
  const handle = await open(path);
  try {
    const reader = await McapIndexedReader.Initialize({ readable: new ReadableFile(handle), decompressHandlers });
    const tally = new Tally();
    tally.add(reader.header);
    for (const schema of reader.schemasById.values()) tally.add(schema);
    for (const channel of reader.channelsById.values()) tally.add(channel);
    for await (const attachment of reader.readAttachments({ validateCrcs: true })) tally.add(attachment);
    for await (const metadata of reader.readMetadata()) tally.add(metadata);
    for await (const message of reader.readMessages({ validateCrcs: true })) tally.add(message);
    if (reader.statistics?.messageCount !== BigInt(tally.messages)) {
      throw new Error(`the statistics say ${reader.statistics?.messageCount} messages, ${tally.messages} were read`);
    }
    return tally;
  } finally {
    await handle.close();
  }
}

async function readAsStream(path) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  const tally = new Tally();
  for await (const bytes of createReadStream(path, { highWaterMark: 1 << 20 })) {
    reader.append(bytes);
    for (let record; (record = reader.nextRecord()) !== undefined; ) tally.add(record);
  }
  tally.complete = reader.done();
  return tally;
}

// Both ways must find the same messages; the index gives them by log time, the stream as they were received.
function compare(indexed, streamed) {
  if (!streamed.complete) throw new Error("the file has an index but no end");
  for (const [topic, { messages }] of Object.entries(streamed.topics)) {
    const found = indexed.topics[topic]?.messages ?? 0;
    if (found !== messages) throw new Error(`${topic}: ${messages} messages in the file, ${found} through its index`);
  }
  for (const kind of ["attachments", "metadata"]) {
    const [there, found] = [streamed[kind], indexed[kind]].map((values) => Object.keys(values).sort().join(", "));
    if (there !== found) throw new Error(`${kind}: "${there}" in the file, "${found}" through its index`);
  }
}

async function main(args) {
  const streamOnly = args[0] === "--stream";
  const paths = streamOnly ? args.slice(1) : args;
  if (paths.length !== 1) throw new Error("usage: node read_recording.mjs [--stream] RUN.mcap");
  await Promise.all([lz4.isLoaded, zstd.isLoaded]);
  const streamed = await readAsStream(paths[0]);
  if (!streamOnly) compare(await readThroughIndex(paths[0]), streamed);
  console.log(JSON.stringify(streamed.report(), (_, value) => (typeof value === "bigint" ? value.toString() : value)));
}

try {
  await main(process.argv.slice(2));
} catch (error) {
  console.error(`read_recording: ${error.message}`);
  process.exitCode = 1;
}
