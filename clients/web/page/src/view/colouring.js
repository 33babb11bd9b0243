/**
 * What a body can be coloured by. `available(world)`: "" or a sentence why not. `calc(world, values)` fills one number a
 * particle and gives the largest magnitude. `noise(size)`: what is nothing, for a scene of that size in metres.
 */
export const COLOURINGS = {
  speed: {
    label: "Speed",
    unit: "m/s",
    diverging: false,
    noise: (size) => 0.01 * size,
    available: () => "",
    calc: (world, values) => magnitudes(world.velocity.of(world.particles), values),
  },
  stretch: {
    label: "Stretch",
    unit: "%",
    diverging: true,
    noise: () => 0.1,
    available: ({ particles, topology }) =>
      particles.stretch || onlySprings(topology) ? "" : 'The stream has none: add "stretch" to [stream] fields.',
    calc: ({ particles, springStretch }, values) => {
      const stretch = particles.stretch ?? springStretch.of(particles);
      return scaled(stretch, 100, values);
    },
  },
  stress: {
    label: "Stress",
    unit: "Pa",
    diverging: false,
    noise: () => 0,
    available: ({ particles }) => (particles.stress ? "" : 'The stream has none: add "stress" to [stream] fields.'),
    calc: ({ particles }, values) => scaled(particles.stress, 1, values),
  },
  plain: { label: "Plain", unit: "", diverging: false, available: () => "", calc: null },
};

const onlySprings = (topology) => topology && topology.springs.length > 0 && topology.tetrahedra.length === 0;

function magnitudes(vectors, values) {
  let most = 0;
  for (let i = 0, k = 0; i < values.length; ++i, k += 3) {
    const square = vectors[k] * vectors[k] + vectors[k + 1] * vectors[k + 1] + vectors[k + 2] * vectors[k + 2];
    values[i] = Math.sqrt(square);
    if (square > most) most = square;
  }
  return Math.sqrt(most);
}

function scaled(numbers, factor, values) {
  let most = 0;
  for (let i = 0; i < values.length; ++i) {
    values[i] = factor * numbers[i];
    const magnitude = Math.abs(values[i]);
    if (magnitude > most) most = magnitude;
  }
  return most;
}

/** Velocities as streamed, else from the difference of the last two frames of a run. */
export class Velocity {
  #before = new Float32Array(0);
  #differences = new Float32Array(0);
  #time = 0;
  #run = null;

  of(particles) {
    if (particles.velocities) return particles.velocities;
    const { positions, time, run_id } = particles;
    if (positions.length !== this.#before.length || run_id !== this.#run) {
      this.#before = positions.slice();
      this.#differences = new Float32Array(positions.length);
    } else if (time !== this.#time) {
      const rate = 1 / (time - this.#time);
      for (let i = 0; i < positions.length; ++i) {
        this.#differences[i] = (positions[i] - this.#before[i]) * rate;
      }
      this.#before.set(positions);
    }
    this.#time = time;
    this.#run = run_id;
    return this.#differences;
  }
}

/** Length over rest length minus 1, the mean of a particle's springs. */
export class SpringStretch {
  #topology;
  #rest; // 1 / rest length
  #count; // 1 / springs of a particle
  #values;

  constructor(topology) {
    this.#topology = topology;
    const { springs, rest_positions } = topology;
    this.#rest = new Float32Array(springs.length / 2);
    this.#count = new Float32Array(rest_positions.length / 3);
    this.#values = new Float32Array(rest_positions.length / 3);
    for (let s = 0; s < this.#rest.length; ++s) {
      this.#rest[s] = 1 / length(rest_positions, springs[2 * s], springs[2 * s + 1]);
      ++this.#count[springs[2 * s]];
      ++this.#count[springs[2 * s + 1]];
    }
    for (let p = 0; p < this.#count.length; ++p) this.#count[p] = this.#count[p] ? 1 / this.#count[p] : 0;
  }

  of({ positions }) {
    const { springs } = this.#topology;
    const values = this.#values.fill(0);
    for (let s = 0; s < this.#rest.length; ++s) {
      const [p, q] = [springs[2 * s], springs[2 * s + 1]];
      const stretch = length(positions, p, q) * this.#rest[s] - 1;
      values[p] += stretch;
      values[q] += stretch;
    }
    for (let p = 0; p < values.length; ++p) values[p] *= this.#count[p];
    return values;
  }
}

function length(positions, p, q) {
  const x = positions[3 * q] - positions[3 * p];
  const y = positions[3 * q + 1] - positions[3 * p + 1];
  const z = positions[3 * q + 2] - positions[3 * p + 2];
  return Math.sqrt(x * x + y * y + z * z);
}
