// What is plotted of every status: name -> how to get it.
export const SERIES = {
  kinetic: (status) => status.report.kinetic,
  elastic: (status) => status.report.elastic,
  gravity: (status) => status.report.gravity,
  contact: (status) => status.report.contact,
  work: (status) => status.report.work,
  dissipated: (status) => status.report.dissipated,
  real_time_factor: (status) => status.real_time_factor,
  step_ms: (status) => 1000 * status.step_seconds,
  error_estimate: (status) => status.report.error_estimate,
  stability_margin: (status) => status.report.stability_margin,
};

/** The numbers of the last statuses over time, as columns; what is not finite is null, as uPlot wants it. */
export class History {
  seconds = [];
  columns = Object.fromEntries(Object.keys(SERIES).map((name) => [name, []]));

  constructor(most = 6000) {
    this.most = most;
  }

  add(seconds, status) {
    if (seconds <= this.seconds.at(-1)) return;
    this.seconds.push(seconds);
    for (const [name, read] of Object.entries(SERIES)) {
      const value = read(status);
      this.columns[name].push(Number.isFinite(value) ? value : null);
    }
    if (this.seconds.length > 1.25 * this.most) this.#shorten();
  }

  clear() {
    this.seconds.length = 0;
    for (const column of Object.values(this.columns)) column.length = 0;
  }

  // Seldom, and many at once.
  #shorten() {
    const drop = this.seconds.length - this.most;
    this.seconds.splice(0, drop);
    for (const column of Object.values(this.columns)) column.splice(0, drop);
  }
}
