import { peekFrame } from "./particle_frame.js";

/** Puts the chunks of frames together and keeps the newest whole frame, undecoded, until it is taken. */
export class FrameAssembler {
  #run = null;
  #newest = null; // number of the newest whole frame of the run
  #open = new Map(); // frame number -> its chunks so far
  #whole = null;

  /** Frames of this run: received whole, and those that the numbers say there were in between. */
  received = 0;
  absent = 0;

  /** Takes one sample; true when it completed a frame that is newer than all before. */
  add(bytes) {
    const { run_id, frame, chunk, chunks } = peekFrame(bytes);
    if (run_id !== this.#run) this.#begin(run_id);
    if (this.#newest !== null && frame <= this.#newest) return false;
    if (chunks === 1) return this.#complete(frame, [bytes]);
    const parts = this.#open.get(frame) ?? [];
    parts[chunk] = bytes;
    this.#open.set(frame, parts);
    return parts.length === chunks && !parts.includes(undefined) && this.#complete(frame, parts);
  }

  /** The samples of the newest whole frame, or null when it was taken before. */
  take() {
    const whole = this.#whole;
    this.#whole = null;
    return whole;
  }

  /** Forgets everything: what follows may be older. */
  clear() {
    this.#begin(null);
  }

  #begin(run) {
    this.#run = run;
    this.#newest = null;
    this.#whole = null;
    this.#open.clear();
    this.received = this.absent = 0;
  }

  #complete(frame, samples) {
    this.received += 1;
    if (this.#newest !== null) this.absent += Number(frame - this.#newest) - 1;
    this.#newest = frame;
    this.#whole = samples;
    for (const number of this.#open.keys()) if (number <= frame) this.#open.delete(number);
    return true;
  }
}
