// Foxglove's WebSocket protocol, as far as the page speaks it: binary messages in and out. Numbers are little-endian.

export const SUBPROTOCOL = "foxglove.sdk.v1";

const MESSAGE_DATA = 1;
const TIME = 2;
const SERVICE_RESPONSE = 3;
const SERVICE_REQUEST = 2; // from the client

const encoder = new TextEncoder();
const decoder = new TextDecoder();

/**
 * What a binary message of the server says:
 * {op: "message", subscription, timestamp, payload} with the payload as a view of the buffer,
 * {op: "time", timestamp}, {op: "response", service, call, body} with the JSON body decoded, or {op: "unknown"}.
 * Timestamps are BigInt, ns. Throws on a message that is too short or a body that is no JSON.
 */
export function parseBinary(buffer) {
  const view = new DataView(buffer);
  switch (view.getUint8(0)) {
    case MESSAGE_DATA:
      return {
        op: "message",
        subscription: view.getUint32(1, true),
        timestamp: view.getBigUint64(5, true),
        payload: new Uint8Array(buffer, 13),
      };
    case TIME:
      return { op: "time", timestamp: view.getBigUint64(1, true) };
    case SERVICE_RESPONSE: {
      const body = 13 + view.getUint32(9, true);
      return {
        op: "response",
        service: view.getUint32(1, true),
        call: view.getUint32(5, true),
        body: JSON.parse(decoder.decode(new Uint8Array(buffer, body))),
      };
    }
    default:
      return { op: "unknown" };
  }
}

/** A call of a service, as JSON. */
export function serviceRequest(service, call, body) {
  const encoding = encoder.encode("json");
  const payload = encoder.encode(JSON.stringify(body));
  const bytes = new Uint8Array(13 + encoding.length + payload.length);
  const view = new DataView(bytes.buffer);
  view.setUint8(0, SERVICE_REQUEST);
  view.setUint32(1, service, true);
  view.setUint32(5, call, true);
  view.setUint32(9, encoding.length, true);
  bytes.set(encoding, 13);
  bytes.set(payload, 13 + encoding.length);
  return bytes;
}
