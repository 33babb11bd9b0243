import { decodeFrame } from "./particle_frame.js";

/** Where all particles of the world are: what the samples of one frame say, in single precision. */
export class Particles {
  total = 0;
  positions = new Float32Array(0);
  velocities = null; // null: the stream has none
  stretch = null;
  stress = null;
  run_id = null;
  frame = null;
  step = 0n;
  time = 0;
  bounds = [0, 0, 0, 0, 0, 0];
  topology_revision = null;

  /** Decodes the samples of one whole frame. */
  update(samples) {
    for (const bytes of samples) this.#take(decodeFrame(bytes));
  }

  #take(chunk) {
    if (chunk.total !== this.total) this.#resize(chunk.total);
    for (const name of ["run_id", "frame", "step", "time", "bounds", "topology_revision"]) this[name] = chunk[name];
    const at = 3 * chunk.first;
    if (chunk.positions) this.positions.set(chunk.positions, at);
    else if (chunk.positions64) this.positions.set(chunk.positions64, at);
    else if (chunk.positions16) unpack(chunk.positions16, chunk.bounds, this.positions, at);
    const velocities = chunk.velocities ?? chunk.velocities64;
    this.velocities = fill(this.velocities, velocities, 3 * this.total, at);
    this.stretch = fill(this.stretch, chunk.stretch, this.total, chunk.first);
    this.stress = fill(this.stress, chunk.stress, this.total, chunk.first);
  }

  #resize(total) {
    this.total = total;
    this.positions = new Float32Array(3 * total);
    this.velocities = this.stretch = this.stress = null;
  }
}

function fill(target, values, length, at) {
  if (!values) return null;
  const array = target ?? new Float32Array(length);
  array.set(values, at);
  return array;
}

// p = min + q / 65535 (max - min) on each axis.
function unpack(fractions, bounds, positions, at) {
  for (let axis = 0; axis < 3; ++axis) {
    const low = bounds[axis];
    const scale = (bounds[axis + 3] - low) / 65535;
    for (let i = axis; i < fractions.length; i += 3) positions[at + i] = low + scale * fractions[i];
  }
}
