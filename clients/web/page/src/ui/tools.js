import { COLOURINGS } from "../view/colouring.js";
import { icon, make, setButton } from "./dom.js";

/** The buttons beside the picture. `actions`: see main.js. */
export class Tools {
  colour;

  #mode;
  #theme;
  #hand;
  #panel;

  constructor(element, actions) {
    const button = (symbol, label, action, id) => {
      const made = make("button", { title: label, "aria-label": label, onclick: action, id }, icon(symbol));
      made.dataset.symbol = symbol;
      return made;
    };
    this.colour = make(
      "select",
      { id: "colour", "aria-label": "Colour by", title: "Colour by (c)", onchange: ({ target }) => actions.colourBy(target.value) },
      ...Object.entries(COLOURINGS).map(([value, { label }]) => make("option", { value }, label)),
    );
    this.#mode = button("particles", "Show particles and springs (v)", actions.toggleMode, "mode");
    this.#hand = button("hand", "A finger pulls the body (g)", actions.toggleHand, "hand");
    this.#theme = button("moon", "Dark", actions.toggleTheme, "theme");
    this.#panel = button("panel", "Parameters and plots (p)", actions.togglePanel, "panel-button");
    element.append(
      this.colour,
      this.#mode,
      button("fit", "Fit the view (f)", actions.fit, "fit"),
      this.#hand,
      button("file", "Open a recording (o)", actions.openFile, "open"),
      this.#theme,
      button("help", "Help (?)", actions.toggleHelp, "help-button"),
      this.#panel,
    );
  }

  update({ colouring, mode, hasSurface, hand, dark, panel, unavailable }) {
    this.colour.value = colouring;
    for (const option of this.colour.options) {
      const reason = unavailable(option.value);
      option.title = reason;
      option.textContent = COLOURINGS[option.value].label + (reason ? " (not streamed)" : "");
    }
    const other = mode === "surface" ? "particles" : "surface";
    setButton(this.#mode, other, other === "surface" ? "Show the surface (v)" : "Show particles and springs (v)");
    this.#mode.disabled = !hasSurface;
    this.#hand.setAttribute("aria-pressed", hand);
    this.#panel.setAttribute("aria-pressed", panel);
    setButton(this.#theme, dark ? "sun" : "moon", dark ? "Light" : "Dark");
  }
}
