import { make } from "./dom.js";

/** What is said in the middle while there is nothing to see. */
export class Greeting {
  #element;
  #title = make("h1");
  #text = make("p");
  #open;

  constructor(element, openFile) {
    this.#element = element;
    this.#open = make("button", { class: "quiet", onclick: openFile }, "Open a recording");
    element.append(this.#title, this.#text, this.#open);
  }

  update(link, nothing) {
    this.#element.hidden = !nothing;
    if (!nothing) return;
    const [title, text] = this.#words(link);
    if (this.#title.textContent !== title) this.#title.textContent = title;
    if (this.#text.textContent !== text) this.#text.textContent = text;
  }

  #words({ state, text }) {
    switch (state) {
      case "connected":
        return ["Waiting for the first frame", "The world is there; its shape and frames come next."];
      case "waiting":
        return ["No world yet", `${text} Start one: flexcast-server server/scenes/cloth.toml`];
      default:
        return ["Connecting", "To flexcast-web. Meanwhile a recording (.mcap) can be dropped here."];
    }
  }
}
