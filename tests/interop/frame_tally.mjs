// FrameTally: which frames of which run there are, and the first coordinates of the first and the last one.
const FRAME_NUMBERS = 2 ** 32; // the sequence of a message is the low 32 bits of the frame number
const POSITIONS = 6; // two particles

export class FrameTally {
  #runs = new Map();
  #first = [];
  #last = [];

  // `frame`: a decoded flexcast::ParticleFrame, which may be one chunk of several; `sequence`: of its message.
  add(frame, sequence) {
    if (frame.frame % BigInt(FRAME_NUMBERS) !== BigInt(sequence)) {
      throw new Error(`flexcast/frames: frame ${frame.frame} is recorded as message ${sequence}`);
    }
    const key = frame.run_id.toString();
    if (!this.#runs.has(key)) this.#runs.set(key, { chunks: new Map(), first: frame.frame, last: frame.frame });
    const run = this.#runs.get(key);
    if (frame.frame < run.first) run.first = frame.frame;
    if (frame.frame > run.last) run.last = frame.frame;
    run.chunks.set(frame.frame, (run.chunks.get(frame.frame) ?? 0) + 1);
    run.chunks_per_frame = frame.chunks;
    if (frame.chunk === 0) this.#addPositions(frame);
  }

  report() {
    const frames = {};
    for (const [key, run] of this.#runs) {
      const counts = [...run.chunks.values()];
      frames[key] = {
        count: counts.length,
        first: run.first,
        last: run.last,
        missing: run.last - run.first + 1n - BigInt(counts.length),
        incomplete: counts.filter((chunks) => chunks !== run.chunks_per_frame).length,
      };
    }
    return { frames, first_positions: this.#first, last_positions: this.#last };
  }

  #addPositions(frame) {
    const stored = [frame.positions, frame.positions64, frame.positions16].find((values) => values.length > 0) ?? [];
    this.#last = Array.from(stored.slice(0, POSITIONS));
    if (this.#first.length === 0) this.#first = this.#last;
  }
}
