import { COMMAND_KINDS, EVENT_KINDS } from "../decode/idl.js";
import { plainValue } from "../model/values.js";
import { make } from "./dom.js";
import { formatCount, formatNumber } from "./format.js";

const MOST_ROWS = 100;

/** What happened in this run, the newest first. Runs of the same command (a drag, a slider) are one row. */
export class Events {
  element = make("section", { class: "events" });

  #list = make("ol");
  #empty = make("p", { class: "empty" }, "Nothing has happened in this run yet.");

  constructor() {
    this.element.append(this.#list, this.#empty);
  }

  update(events) {
    const rows = [];
    for (const event of events) {
      const kind = titleOf(event);
      if (rows.at(-1)?.kind === kind && event.kind === 0) rows.at(-1).count += 1;
      else rows.push({ kind, count: 1 });
      Object.assign(rows.at(-1), { step: event.step, text: describe(event), warns: EVENT_KINDS[event.kind] === "warning" });
    }
    this.#empty.hidden = rows.length > 0;
    this.#list.replaceChildren(...rows.slice(-MOST_ROWS).reverse().map(rowOf));
  }
}

const rowOf = ({ step, text, count, warns }) =>
  make("li", { class: warns ? "warning" : "" }, make("span", { class: "step" }, formatCount(step)), make("span", {}, text, count > 1 ? ` ×${count}` : ""));

/** What an event is about, so that events of the same kind can be told from others. */
export function titleOf(event) {
  if (EVENT_KINDS[event.kind] !== "command") return EVENT_KINDS[event.kind] ?? "unknown";
  const names = event.values.map(({ name }) => name).join(" ");
  return `${COMMAND_KINDS[event.command_kind] ?? "unknown"} ${names}`.trim();
}

export function describe(event) {
  if (event.text) return event.text;
  const values = event.values.map((value) => `${value.name} = ${write(plainValue(value))}`).join(", ");
  return `${titleOf(event).split(" ")[0].replace("_", " ")} ${values || event.name}`.trim();
}

const write = (value) =>
  Array.isArray(value) ? `(${value.map((number) => formatNumber(number)).join(", ")})` : typeof value === "number" ? formatNumber(value) : String(value);
