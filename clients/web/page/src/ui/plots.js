import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

import { make } from "./dom.js";
import { formatNumber, formatQuantity } from "./format.js";

const HEIGHT = 132; // px
const SPANS = [10, 30, 120, 600]; // s
const PLOTS = [
  {
    title: "Energies",
    unit: "J",
    series: [
      ["kinetic", "--series-1"],
      ["elastic", "--series-2"],
      ["gravity", "--series-3"],
      ["contact", "--series-4"],
      ["work", "--series-5"],
      ["dissipated", "--series-6"],
    ],
  },
  { title: "Real-time factor", unit: "", series: [["real_time_factor", "--series-1"]], zero: true },
  { title: "Time of a step", unit: "ms", series: [["step_ms", "--series-2"]], zero: true },
  { title: "Error estimate", unit: "m", series: [["error_estimate", "--series-5"]], logarithmic: true },
  { title: "Stability margin", unit: "", series: [["stability_margin", "--series-3"]], logarithmic: true, line: 1 },
];

/** Plots of a History over the last seconds, or over a whole recording with a mark where it is played. */
export class Plots {
  element;

  #history;
  #plots = [];
  #span = 30;
  #cursor = null; // s, null: live
  #duration = 0; // s, of a recording
  #drawn = "";
  #holder = make("div", { class: "plots" });

  constructor(history) {
    this.#history = history;
    const options = SPANS.map((span) => make("option", { value: span, selected: span === this.#span }, span < 60 ? `${span} s` : `${span / 60} min`));
    this.spanSelect = make("select", { "aria-label": "Time shown", onchange: ({ target }) => this.#setSpan(Number(target.value)) }, ...options);
    const label = make("label", { class: "row" }, "Last", this.spanSelect);
    this.element = make("section", { class: "plots-tab" }, label, this.#holder);
  }

  /** Where a recording of that length is, s, or null: live. */
  setCursor(seconds, duration = 0) {
    this.#cursor = seconds;
    this.#duration = duration;
    this.spanSelect.parentElement.hidden = seconds !== null;
  }

  /** Draws what is new. Only while the plots are seen. */
  draw() {
    const width = this.#holder.clientWidth;
    if (!width) return;
    const key = `${width} ${this.#history.seconds.length} ${this.#history.seconds.at(-1)} ${this.#cursor} ${this.#span}`;
    if (key === this.#drawn) return;
    this.#drawn = key;
    if (this.#plots.length === 0) this.#make(width);
    const seconds = this.#history.seconds;
    for (const { plot, options } of this.#plots) {
      if (plot.width !== width) plot.setSize({ width, height: HEIGHT });
      const columns = options.series.map(([name]) => positiveOnly(this.#history.columns[name], options.logarithmic));
      plot.setData([seconds, ...columns], false);
      plot.setScale("x", this.#shown(seconds));
    }
  }

  /** The colours have changed. */
  restyle() {
    for (const { plot } of this.#plots) plot.destroy();
    this.#plots = [];
    this.#holder.replaceChildren();
    this.#drawn = "";
  }

  #setSpan(span) {
    this.#span = span;
    this.draw();
  }

  #shown(seconds) {
    if (this.#cursor !== null) return { min: 0, max: Math.max(this.#duration, 1e-3) };
    const now = seconds.at(-1) ?? 0;
    return { min: now - this.#span, max: now };
  }

  #make(width) {
    const style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(name).trim();
    for (const options of PLOTS) {
      const heading = make("h3", {}, options.title, make("span", { class: "unit" }, options.unit));
      const holder = make("div", { class: "plot" }, heading);
      this.#holder.append(holder);
      const plot = new uPlot(this.#options(options, width, colour), [[]], holder);
      this.#plots.push({ plot, options });
    }
  }

  #options(options, width, colour) {
    const axis = { stroke: colour("--quiet"), grid: { stroke: colour("--hair"), width: 1 }, ticks: { show: false }, font: "11px system-ui, sans-serif" };
    return {
      width,
      height: HEIGHT,
      legend: { show: options.series.length > 1, live: false },
      cursor: { show: false },
      scales: { x: { time: false }, y: options.logarithmic ? { distr: 3 } : { range: (_, low, high) => padded(low, high, options.zero) } },
      axes: [
        { ...axis, size: 22, values: (_, places) => places.map((place) => this.#label(place)) },
        { ...axis, size: 46, values: (_, places) => places.map((place) => (place === null ? "" : options.unit === "J" ? formatQuantity(place, "", 3) : formatNumber(place, 3))) },
      ],
      series: [{}, ...options.series.map(([name, series]) => ({ label: name.replaceAll("_", " "), stroke: colour(series), width: 1.5, points: { show: false } }))],
      hooks: { draw: [(plot) => this.#mark(plot, options.line, colour)] },
    };
  }

  #label(place) {
    if (this.#cursor !== null) return `${formatNumber(place, 3)} s`;
    const ago = Math.round(place - (this.#history.seconds.at(-1) ?? 0));
    return ago === 0 ? "now" : `${ago} s`;
  }

  #mark(plot, line, colour) {
    const { ctx, bbox } = plot;
    ctx.save();
    if (line !== undefined && line > plot.scales.y.min && line < plot.scales.y.max) {
      stroke(ctx, colour("--bad"), [[bbox.left, plot.valToPos(line, "y", true)], [bbox.left + bbox.width, plot.valToPos(line, "y", true)]]);
    }
    if (this.#cursor !== null) {
      const x = plot.valToPos(this.#cursor, "x", true);
      stroke(ctx, colour("--accent"), [[x, bbox.top], [x, bbox.top + bbox.height]]);
    }
    ctx.restore();
  }
}

function stroke(context, colour, [from, to]) {
  context.strokeStyle = colour;
  context.lineWidth = devicePixelRatio;
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}

// A logarithmic axis has no place for zero.
const positiveOnly = (column, logarithmic) => (logarithmic ? column.map((value) => (value > 0 ? value : null)) : column);

function padded(low, high, zero) {
  if (low === null || high === null) return [0, 1];
  const bottom = zero ? Math.min(0, low) : low;
  const room = 0.06 * (high - bottom || Math.abs(high) || 1);
  return [zero && bottom === 0 ? 0 : bottom - room, high + room];
}
