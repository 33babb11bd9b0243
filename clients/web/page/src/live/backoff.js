/** How long to wait before the next attempt, ms: doubles from `first` to `longest`, until something worked. */
export class Backoff {
  #next;

  constructor(first = 250, longest = 4000) {
    this.first = first;
    this.longest = longest;
    this.#next = first;
  }

  next() {
    const wait = this.#next;
    this.#next = Math.min(2 * wait, this.longest);
    return wait;
  }

  reset() {
    this.#next = this.first;
  }
}
