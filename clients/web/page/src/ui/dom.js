/** Makes an element: make("button", {class: "quiet", title: "Fit", onclick: f}, "text", child). */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child != null));
  return element;
}

/** One of the symbols of index.html. */
export function icon(name) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const use = document.createElementNS("http://www.w3.org/2000/svg", "use");
  use.setAttribute("href", `#icon-${name}`);
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  svg.append(use);
  return svg;
}

export const get = (id) => document.getElementById(id);

/** Sets a text, only where it differs. */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Changes what a button shows and says. */
export function setButton(button, symbol, label) {
  if (button.dataset.symbol === symbol && button.title === label) return;
  button.dataset.symbol = symbol;
  button.title = label;
  button.setAttribute("aria-label", label);
  button.querySelector("use").setAttribute("href", `#icon-${symbol}`);
}
