import { DIVERGING, SEQUENTIAL } from "../view/colour_map.js";
import { COLOURINGS } from "../view/colouring.js";
import { make, setText } from "./dom.js";
import { formatQuantity } from "./format.js";

/** What the colours mean: name, map, ends with unit; or why there are none. */
export class ColourBar {
  #element;
  #title = make("span", { class: "title" });
  #canvas = make("canvas", { width: 256, height: 1 });
  #low = make("span");
  #middle = make("span");
  #high = make("span");
  #reason = make("p", { class: "reason" });
  #key = "";

  constructor(element) {
    this.#element = element;
    this.ends = make("div", { class: "ends" }, this.#low, this.#middle, this.#high);
    element.append(this.#title, this.#canvas, this.ends, this.#reason);
  }

  update(colouring, most, reason, present) {
    const key = `${colouring} ${most} ${reason} ${present}`;
    if (key === this.#key) return;
    this.#key = key;
    const { label, unit, diverging } = COLOURINGS[colouring];
    this.#element.hidden = colouring === "plain" || !present;
    setText(this.#title, label);
    setText(this.#reason, reason);
    this.#canvas.hidden = this.ends.hidden = Boolean(reason);
    const map = diverging ? DIVERGING : SEQUENTIAL;
    this.#canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(map), 256, 1), 0, 0);
    setText(this.#low, formatQuantity(diverging ? -most : 0, unit));
    setText(this.#middle, formatQuantity(diverging ? 0 : most / 2, unit));
    setText(this.#high, formatQuantity(most, unit));
    this.#element.setAttribute("aria-label", reason || `${label} from ${this.#low.textContent} to ${this.#high.textContent}`);
  }
}
