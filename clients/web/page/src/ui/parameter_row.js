import { VALUE_KINDS } from "../decode/idl.js";
import { plainValue, rangeText, sameValue } from "../model/values.js";
import { icon, make, setText } from "./dom.js";
import { formatCount, formatNumber, formatUnit } from "./format.js";
import { SliderScale } from "./slider_scale.js";

const AXES = ["x", "y", "z"];

/**
 * One parameter: its fields and slider as its kind wants them. `set(name, value)` promises the reply of the server. The
 * newest value goes as soon as the one before is answered; what was answered is shown, with its step.
 */
export class ParameterRow {
  element;

  #descriptor;
  #kind;
  #set;
  #inForce;
  #inputs = [];
  #slider = null;
  #scale = null;
  #reset;
  #note;
  #wanted; // not sent yet
  #busy = false;
  #readOnly;

  constructor(descriptor, set) {
    this.#descriptor = descriptor;
    this.#kind = VALUE_KINDS[descriptor.kind];
    this.#set = set;
    this.#readOnly = !descriptor.live;
    this.initial = plainValue(descriptor.initial);
    this.#note = make("output", { class: "note" });
    this.#reset = make(
      "button",
      { class: "tiny", title: `Reset to ${this.#write(this.initial)}`, "aria-label": `Reset ${descriptor.name}`, hidden: true, onclick: () => this.send(this.initial) },
      icon("undo"),
    );
    const unit = make("span", { class: "unit" }, formatUnit(descriptor.unit));
    this.#inputs = this.#makeInputs();
    this.#slider = this.#makeSlider();
    const short = descriptor.name.slice(descriptor.name.indexOf(".") + 1);
    this.element = make(
      "div",
      { class: `parameter ${this.#kind}`, title: `${descriptor.name}: ${descriptor.description}\n${this.#allowed()}`, "data-name": descriptor.name },
      make("span", { class: "name" }, short),
      this.#reset,
      make("span", { class: "fields" }, ...this.#inputs, unit),
      this.#slider,
      make("span", { class: "about" }, descriptor.description),
      this.#note,
    );
  }

  get changed() {
    return !sameValue(this.#inForce, this.initial);
  }

  matches(words) {
    const text = `${this.#descriptor.name} ${this.#descriptor.description}`.toLowerCase();
    return words.every((word) => text.includes(word));
  }

  /** The value now in force, from the world. */
  update(value) {
    this.#inForce = value;
    this.#reset.hidden = !this.changed || this.#readOnly;
    this.element.classList.toggle("changed", this.changed);
    if (!this.#busy) this.#show(value);
  }

  setReadOnly(readOnly) {
    this.#readOnly = readOnly || !this.#descriptor.live;
    for (const input of [...this.#inputs, this.#slider]) if (input) input.disabled = this.#readOnly;
    this.#reset.hidden = !this.changed || this.#readOnly;
  }

  /** Asks for a value; the newest wins while one is on its way. */
  async send(value) {
    this.#wanted = value;
    if (this.#busy) return;
    this.#busy = true;
    while (this.#wanted !== undefined) {
      const next = this.#wanted;
      this.#wanted = undefined;
      await this.#sendOne(next);
    }
    this.#busy = false;
  }

  /** The field says what was refused, and shows again what is in force. */
  refuse(reason) {
    this.#say(reason, true);
    this.#show(this.#inForce);
  }

  async #sendOne(value) {
    try {
      const reply = await this.#set(this.#descriptor.name, value);
      if (reply.outcome !== "applied") {
        this.refuse(reply.reason || `The server answered ${reply.outcome}.`);
        return;
      }
      this.#inForce = reply.values?.[this.#descriptor.name] ?? value;
      if (this.#wanted === undefined) this.#show(this.#inForce, true);
      this.#say(`${this.#write(this.#inForce)} since step ${formatCount(reply.applied_step)}`, false);
    } catch (error) {
      this.refuse(error.message);
    }
  }

  #say(text, refused) {
    setText(this.#note, text);
    this.element.classList.toggle("refused", refused);
    this.element.classList.remove("answered");
    void this.element.offsetWidth; // so that the flash begins again
    this.element.classList.add("answered");
  }

  #allowed() {
    const { choices, live } = this.#descriptor;
    const allowed = this.#kind === "choice" ? choices.join(", ") : rangeText(this.#descriptor, formatNumber);
    return `Allowed: ${allowed}. Scene: ${this.#write(this.initial)}.${live ? "" : " Set before the start."}`;
  }

  #write(value) {
    if (Array.isArray(value)) return `(${value.map((number) => formatNumber(number)).join(", ")})`;
    return typeof value === "number" ? formatNumber(value, 8) : String(value);
  }

  #makeInputs() {
    const { name, choices } = this.#descriptor;
    const disabled = this.#readOnly;
    switch (this.#kind) {
      case "choice": {
        const options = choices.map((choice) => make("option", { value: choice }, choice));
        return [make("select", { "aria-label": name, disabled, onchange: ({ target }) => this.send(target.value) }, ...options)];
      }
      case "boolean":
        return [make("input", { type: "checkbox", "aria-label": name, disabled, onchange: ({ target }) => this.send(target.checked) })];
      case "vector":
        return AXES.map((axis) => this.#makeField(`${name} ${axis}`));
      default:
        return [this.#makeField(name)];
    }
  }

  #makeField(label) {
    return make("input", {
      type: "text",
      inputmode: "decimal",
      autocomplete: "off",
      spellcheck: "false",
      "aria-label": label,
      disabled: this.#readOnly,
      onchange: () => this.#sendFields(),
      onkeydown: ({ key, target }) => {
        if (key === "Escape") {
          this.#show(this.#inForce, true);
          target.blur();
        }
        if (key === "Enter") target.select();
      },
    });
  }

  #sendFields() {
    const numbers = this.#inputs.map(({ value }) => (value.trim() === "" ? NaN : Number(value.trim().replace("−", "-").replace(",", "."))));
    if (numbers.some((number) => !Number.isFinite(number))) return this.refuse("This is not a number.");
    this.send(this.#kind === "vector" ? numbers : numbers[0]);
  }

  #makeSlider() {
    if (this.#kind !== "number" && this.#kind !== "integer") return null;
    const { minimum, maximum, name } = this.#descriptor;
    this.#scale = new SliderScale(minimum, maximum, this.initial);
    return make("input", {
      type: "range",
      min: 0,
      max: SliderScale.steps,
      "aria-label": `${name}, slider`,
      disabled: this.#readOnly,
      oninput: ({ target }) => {
        const value = this.#scale.value(Number(target.value));
        const number = this.#kind === "integer" ? Math.round(value) : value;
        this.#inputs[0].value = this.#write(number);
        this.send(number);
      },
    });
  }

  // Fields that somebody is writing in are left alone.
  #show(value, also_focused = false) {
    const values = Array.isArray(value) ? value : [value];
    this.#inputs.forEach((input, i) => {
      if (input === document.activeElement && input.type === "text" && !also_focused && !this.element.classList.contains("refused")) return;
      if (input.type === "checkbox") input.checked = values[i];
      else input.value = typeof values[i] === "number" ? formatNumber(values[i], 8) : (values[i] ?? "");
    });
    if (this.#slider && this.#slider !== document.activeElement) this.#slider.value = this.#scale.place(value);
    else if (this.#slider && also_focused) this.#slider.setAttribute("aria-valuetext", this.#write(value));
  }
}
