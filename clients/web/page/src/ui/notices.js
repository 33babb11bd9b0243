import { WORLD_STATES } from "../decode/idl.js";
import { icon, make } from "./dom.js";
import { formatCount } from "./format.js";

const TOAST = 8000; // ms

/** What must be said: why a world failed, what it warns of, and for a while what was refused. */
export class Notices {
  #element;
  #toasts = new Map(); // text -> timer
  #key = "";
  #standing = [];
  #reset;

  constructor(element, reset) {
    this.#element = element;
    this.#reset = reset;
  }

  /** `recorded`: there is nobody to reset. `atRest`: bodies are shown in their rest shape. */
  update(status, link, { recorded, atRest }) {
    const standing = [];
    if (!recorded && (link.state === "lost" || link.state === "silent")) standing.push({ kind: "bad", text: link.text });
    const failed = WORLD_STATES[status?.state] === "failed";
    if (failed) standing.push({ kind: "bad failure", trouble: status.trouble, recorded, atRest });
    // The reason of a failure has been warned of; its suggestion says more.
    for (const text of failed ? [] : (status?.warnings ?? [])) standing.push({ kind: "warning", text });
    const key = JSON.stringify(standing, (_, value) => (typeof value === "bigint" ? value.toString() : value));
    if (key === this.#key) return;
    this.#key = key;
    this.#standing = standing;
    this.#draw();
  }

  /** Shows a sentence for some seconds. */
  say(text) {
    clearTimeout(this.#toasts.get(text));
    this.#toasts.set(text, setTimeout(() => this.#drop(text), TOAST));
    this.#draw();
  }

  #drop(text) {
    clearTimeout(this.#toasts.get(text));
    this.#toasts.delete(text);
    this.#draw();
  }

  #draw() {
    const standing = this.#standing.map(({ kind, text, trouble, recorded, atRest }) =>
      trouble ? this.#failure(trouble, kind, recorded, atRest) : make("p", { class: `notice ${kind}` }, text),
    );
    const toasts = [...this.#toasts.keys()].map((text) =>
      make("p", { class: "notice toast" }, text, make("button", { class: "tiny", "aria-label": "Close", onclick: () => this.#drop(text) }, icon("close"))),
    );
    this.#element.replaceChildren(...standing, ...toasts);
  }

  #failure({ cause, body, element, particle, step, suggestion }, kind, recorded, atRest) {
    const what = element >= 0 ? `element ${element}` : particle >= 0 ? `particle ${particle}` : "";
    const where = [body && `body ${body}`, what].filter(Boolean).join(", ");
    const sentences = [
      where && `${capital(where)}, is marked in red.`,
      atRest && "The bodies are shown at rest: they flew apart.",
      suggestion && `${capital(suggestion)}.`,
    ];
    return make(
      "div",
      { class: `notice ${kind}`, role: "alert" },
      make("strong", {}, `Stopped before step ${formatCount(step)}: ${cause}`),
      make("span", {}, sentences.filter(Boolean).join(" ")),
      recorded ? null : make("button", { class: "quiet", onclick: this.#reset }, "Reset"),
    );
  }
}

const capital = (text) => text[0].toUpperCase() + text.slice(1);
