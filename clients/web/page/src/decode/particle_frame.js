// flexcast::ParticleFrame by its fixed offsets (idl/README.md, "Frames"). `bytes` is one sample as it came off the wire,
// CDR header included. Sequences are views of the sample's memory, not copies; empty ones are null.

const CDR_HEADER = 4;
const LENGTH_OF_WORLD = 124;
const WORLD = 128;
const SEQUENCES = [
  ["positions", Float32Array],
  ["velocities", Float32Array],
  ["positions64", Float64Array],
  ["velocities64", Float64Array],
  ["positions16", Uint16Array],
  ["stretch", Float32Array],
  ["stress", Float32Array],
];

const viewOf = (bytes) => new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);

/** Number, run, topology and chunk of a sample, without looking further. 64-bit numbers are BigInt. */
export function peekFrame(bytes) {
  requireHeader(bytes);
  const view = viewOf(bytes);
  return {
    run_id: view.getBigUint64(4, true),
    frame: view.getBigUint64(12, true),
    topology_revision: view.getBigUint64(44, true),
    chunk: view.getUint32(60, true),
    chunks: view.getUint32(64, true),
  };
}

/** Decodes one sample. Throws a RangeError when it is shorter than it says. */
export function decodeFrame(sample) {
  requireHeader(sample);
  const bytes = aligned(sample);
  const view = viewOf(bytes);
  const frame = {
    run_id: view.getBigUint64(4, true),
    frame: view.getBigUint64(12, true),
    step: view.getBigUint64(20, true),
    time: view.getFloat64(28, true),
    parameter_revision: view.getBigUint64(36, true),
    topology_revision: view.getBigUint64(44, true),
    chunk: view.getUint32(60, true),
    chunks: view.getUint32(64, true),
    first: view.getUint32(68, true),
    total: view.getUint32(72, true),
    bounds: Array.from({ length: 6 }, (_, i) => view.getFloat64(76 + 8 * i, true)),
  };
  let offset = WORLD + view.getUint32(LENGTH_OF_WORLD, true);
  for (const [name, Type] of SEQUENCES) {
    offset = align(offset, 4);
    const count = view.getUint32(offset, true);
    offset += 4;
    frame[name] = null;
    if (count === 0) continue;
    if (Type === Float64Array) offset = align(offset, 8);
    frame[name] = new Type(bytes.buffer, bytes.byteOffset + offset, count);
    offset += count * Type.BYTES_PER_ELEMENT;
    if (offset > bytes.byteLength) throw new RangeError(`flexcast/frames: ${name} ends after the sample`);
  }
  return frame;
}

function requireHeader(bytes) {
  if (bytes.byteLength < WORLD) throw new RangeError(`flexcast/frames: a sample of ${bytes.byteLength} bytes`);
  if (bytes[0] !== 0 || bytes[1] !== 1) throw new RangeError("flexcast/frames: not little-endian XCDR1");
}

// CDR counts its alignment from the end of the header. A message of a WebSocket begins at offset 13, so it is copied
// once to where typed arrays can look at it.
function aligned(bytes) {
  if ((bytes.byteOffset + CDR_HEADER) % 8 === 0) return bytes;
  const copy = new Uint8Array(CDR_HEADER + bytes.byteLength);
  copy.set(bytes, CDR_HEADER);
  return copy.subarray(CDR_HEADER);
}

const align = (offset, to) => CDR_HEADER + Math.ceil((offset - CDR_HEADER) / to) * to;
