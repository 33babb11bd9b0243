const STORED = "flexcast.theme";

/** Light or dark: as the system has it, until the switch is used. */
export class Theme {
  #system = matchMedia("(prefers-color-scheme: dark)");
  #chosen = read();
  #changed;

  constructor(changed) {
    this.#changed = changed;
    this.#system.addEventListener("change", () => this.#apply());
    this.#apply();
  }

  get dark() {
    return this.#chosen ? this.#chosen === "dark" : this.#system.matches;
  }

  toggle() {
    this.#chosen = this.dark ? "light" : "dark";
    try {
      localStorage.setItem(STORED, this.#chosen);
    } catch {
      // No storage here: it holds for this page.
    }
    this.#apply();
  }

  #apply() {
    document.documentElement.dataset.theme = this.dark ? "dark" : "light";
    this.#changed(this.dark);
  }
}

function read() {
  try {
    return localStorage.getItem(STORED);
  } catch {
    return null;
  }
}
