import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader } from "@foxglove/omgidl-serialization";

const parsed = new Map(); // schema text -> its definitions: every channel brings the same one

/**
 * A function that decodes samples of the type `name` of an IDL text. Its 64-bit integers are BigInt, enums are numbers.
 * Throws when the text is no IDL or has no such type.
 */
export function makeDecoder(text, name) {
  if (!parsed.has(text)) parsed.set(text, parseIDL(text));
  const reader = new MessageReader(name, parsed.get(text));
  return (bytes) => reader.readMessage(bytes);
}

/** The enumerators of the contract, by their numbers; idl/flexcast.idl. A number that is not here is "unknown". */
export const WORLD_STATES = ["running", "paused", "finished", "failed"];
export const VALUE_KINDS = ["number", "integer", "vector", "choice", "boolean"];
export const EVENT_KINDS = ["command", "state", "choice", "warning"];
export const COMMAND_KINDS = [
  "set", "get", "describe", "reset", "pause", "resume", "step", "run_until", "load", "save", "restore", "grab",
  "release", "status",
];
