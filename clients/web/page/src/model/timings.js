const KEPT = 600;

/** How long the script took for each frame that was drawn, ms: decoding, preparing what is drawn, drawing. */
export class Timings {
  frames = []; // the last ones
  drawn = 0; // in all

  add(decode, prepare, draw) {
    this.drawn += 1;
    this.frames.push({ decode, prepare, draw, total: decode + prepare + draw });
    if (this.frames.length > 2 * KEPT) this.frames.splice(0, KEPT);
  }

  /** The median of each part over the last frames. */
  medians(last = KEPT) {
    const frames = this.frames.slice(-last);
    const median = (name) => frames.map((frame) => frame[name]).sort((a, b) => a - b)[frames.length >> 1] ?? NaN;
    return { frames: frames.length, decode: median("decode"), prepare: median("prepare"), draw: median("draw"), total: median("total") };
  }
}
