import { plainValue } from "../model/values.js";
import { icon, make, setText } from "./dom.js";
import { ParameterRow } from "./parameter_row.js";

const LAST = ["time", "solver", "stream", "server"]; // what is about bodies comes before how they are computed

/** The parameters of a world, grouped by the first part of their names, with a filter. */
export class Parameters {
  element;

  #rows = new Map(); // name -> ParameterRow
  #groups = [];
  #key = "";
  #list = make("div", { class: "groups" });
  #filter;
  #resetAll;
  #empty = make("p", { class: "empty" }, "No parameters yet.");
  #set;
  #readOnly = false;

  /** `set(values)`: promises the reply to a batch {name: value}. */
  constructor(set) {
    this.#set = set;
    this.#filter = make("input", { type: "search", placeholder: "Filter", "aria-label": "Filter parameters", oninput: () => this.#applyFilter() });
    this.#resetAll = make("button", { class: "quiet", hidden: true, onclick: () => this.#resetChanged() }, icon("undo"), make("span"));
    this.element = make("section", { class: "parameters" }, make("div", { class: "row" }, this.#filter, this.#resetAll), this.#list, this.#empty);
  }

  update(parameters) {
    const descriptors = parameters?.descriptors ?? [];
    const key = descriptors.map(({ name, initial }) => `${name} ${plainValue(initial)}`).join("\n");
    if (key !== this.#key) this.#build(descriptors);
    this.#key = key;
    for (const value of parameters?.values ?? []) this.#rows.get(value.name)?.update(plainValue(value));
    this.#empty.hidden = descriptors.length > 0;
    this.#showChanged();
  }

  setReadOnly(readOnly) {
    this.#readOnly = readOnly;
    for (const row of this.#rows.values()) row.setReadOnly(readOnly);
    this.#showChanged();
  }

  #build(descriptors) {
    this.#rows.clear();
    const groups = new Map();
    for (const descriptor of descriptors) {
      const row = new ParameterRow(descriptor, (name, value) => this.#set({ [name]: value }));
      row.setReadOnly(this.#readOnly);
      this.#rows.set(descriptor.name, row);
      const dot = descriptor.name.lastIndexOf(".");
      const group = dot < 0 ? "scene" : descriptor.name.slice(0, descriptor.name.indexOf("."));
      groups.set(group, [...(groups.get(group) ?? []), row]);
    }
    const ordered = [...groups].sort(([a], [b]) => LAST.indexOf(a) - LAST.indexOf(b));
    this.#groups = ordered.map(([name, rows]) => {
      const element = make("details", { open: true }, make("summary", {}, name), ...rows.map((row) => row.element));
      return { element, rows };
    });
    this.#list.replaceChildren(...this.#groups.map(({ element }) => element));
    this.#applyFilter();
  }

  #applyFilter() {
    const words = this.#filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const { element, rows } of this.#groups) {
      for (const row of rows) row.element.hidden = !row.matches(words);
      element.hidden = rows.every((row) => row.element.hidden);
    }
  }

  #changed() {
    return [...this.#rows].filter(([, row]) => row.changed);
  }

  #showChanged() {
    const count = this.#changed().length;
    this.#resetAll.hidden = count === 0 || this.#readOnly;
    setText(this.#resetAll.lastElementChild, `Reset ${count} changed`);
  }

  // One batch, so that all or none go back; rows that take part show the answer.
  async #resetChanged() {
    const changed = this.#changed();
    const batch = this.#set(Object.fromEntries(changed.map(([name, row]) => [name, row.initial])));
    try {
      const reply = await batch;
      if (reply.outcome !== "applied") throw new Error(reply.reason || `The server answered ${reply.outcome}.`);
    } catch (error) {
      changed[0]?.[1].refuse(error.message);
    }
  }
}
