import { make, setText } from "./dom.js";
import { formatNumber } from "./format.js";

/** Tables of the probes' positions and velocities and of what handles exert. */
export class Probes {
  element = make("section", { class: "probes" });

  #tables = [];

  constructor() {
    this.#tables = [
      new Table("Probes", "probes", [["position", "m"], ["velocity", "m/s"]]),
      new Table("Handles", "handles", [["force", "N"], ["torque", "N m"]]),
    ];
    this.empty = make("p", { class: "empty" }, "This scene has no probes or handles. A scene file names them: [[probe]], handle.");
    this.element.append(...this.#tables.map(({ element }) => element), this.empty);
  }

  update(status) {
    for (const table of this.#tables) table.update(status);
    this.empty.hidden = this.#tables.some(({ element }) => !element.hidden);
  }
}

class Table {
  element;

  #rows = new Map(); // name -> cells
  #body = make("tbody");

  constructor(title, source, columns) {
    this.source = source;
    this.columns = columns;
    this.element = make("div", {}, make("h3", {}, title), make("table", {}, this.#body));
  }

  update(status) {
    const items = status?.[this.source] ?? [];
    this.element.hidden = items.length === 0;
    const names = items.map(({ name }) => name).join();
    if (names !== this.names) this.#build(items);
    this.names = names;
    for (const item of items) {
      this.columns.forEach(([column], row) => {
        this.#rows.get(item.name)[row].forEach((cell, axis) => setText(cell, formatNumber(item[column][axis], 4)));
      });
    }
  }

  #build(items) {
    this.#rows.clear();
    this.#body.replaceChildren();
    for (const { name } of items) {
      this.#body.append(make("tr", { class: "probe" }, make("th", { colspan: 5 }, name)));
      const rows = this.columns.map(([column, unit]) => {
        const cells = ["x", "y", "z"].map(() => make("td"));
        this.#body.append(make("tr", {}, make("th", { scope: "row" }, column), ...cells, make("td", { class: "unit" }, unit)));
        return cells;
      });
      this.#rows.set(name, rows);
    }
  }
}
