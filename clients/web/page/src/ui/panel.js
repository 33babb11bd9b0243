import { icon, make } from "./dom.js";

/** Tabs; on a phone a drawer from below. */
export class Panel {
  #element;
  #tabs = [];
  #changed;

  /** `sections`: {label: {element}}; `changed()` after another is shown. */
  constructor(element, sections, changed) {
    this.#element = element;
    this.#changed = changed;
    const list = make("div", { class: "tabs", role: "tablist" });
    element.append(list);
    for (const [label, { element: section }] of Object.entries(sections)) {
      const id = `tab-${label.toLowerCase()}`;
      const tab = make("button", { role: "tab", id, "aria-controls": `${id}-panel`, onclick: () => this.show(label) }, label);
      section.id = `${id}-panel`;
      section.setAttribute("role", "tabpanel");
      section.setAttribute("aria-labelledby", id);
      this.#tabs.push({ label, tab, section });
      list.append(tab);
      element.append(section);
    }
    list.append(make("button", { class: "tiny close", title: "Close (p)", "aria-label": "Close the panel", onclick: () => this.toggle(false) }, icon("close")));
    list.addEventListener("keydown", (event) => this.#arrow(event));
    this.show(this.#tabs[0].label);
  }

  get open() {
    return !this.#element.hidden;
  }

  toggle(open = !this.open) {
    this.#element.hidden = !open;
    this.#changed();
  }

  show(label) {
    for (const { label: other, tab, section } of this.#tabs) {
      tab.setAttribute("aria-selected", other === label);
      tab.tabIndex = other === label ? 0 : -1;
      section.hidden = other !== label;
    }
    this.#changed();
  }

  #arrow(event) {
    const direction = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!direction) return;
    event.preventDefault();
    const now = this.#tabs.findIndex(({ tab }) => tab.getAttribute("aria-selected") === "true");
    const next = this.#tabs[(now + direction + this.#tabs.length) % this.#tabs.length];
    this.show(next.label);
    next.tab.focus();
  }
}
