/** The smallest of 1, 2, 5 times a power of ten that is not below a positive value. */
export function niceAbove(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  for (const factor of [1, 2, 5, 10]) if (value <= factor * power * (1 + 1e-9)) return factor * power;
  return 10 * power;
}

/**
 * The end of a colour scale: grows at once with the values and shrinks only after they have been much smaller for a
 * while, so that colours are calm.
 */
export class ColourRange {
  most = 0;

  #quiet = 0; // s since the values last came near the end

  /** The end is never below it: what is smaller is noise. */
  floor = 0;

  constructor(patience = 3) {
    this.patience = patience;
  }

  /** The largest `magnitude` of a frame, `elapsed` seconds after the one before. True when the range changed. */
  update(magnitude, elapsed) {
    const largest = Math.max(magnitude, this.floor);
    if (!Number.isFinite(largest) || largest <= 0) return false;
    if (largest > this.most) return this.#set(niceAbove(largest));
    this.#quiet = largest > this.most / 2.5 ? 0 : this.#quiet + elapsed;
    return this.#quiet > this.patience && this.#set(niceAbove(largest));
  }

  clear() {
    this.most = 0;
    this.#quiet = 0;
  }

  #set(most) {
    this.#quiet = 0;
    if (most === this.most) return false;
    this.most = most;
    return true;
  }
}
