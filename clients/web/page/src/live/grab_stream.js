/**
 * Pulls a particle to a moving target: at most one request is on its way, then the newest target goes. `command(verb,
 * request)` gives a promise of the reply; `refused(sentence)` hears of the first refusal.
 */
export class GrabStream {
  #command;
  #refused;
  #particle = -1;
  #target = null; // not sent yet
  #releasing = false;
  #busy = false;

  constructor(command, refused) {
    this.#command = command;
    this.#refused = refused;
  }

  move(particle, target) {
    this.#particle = particle;
    this.#target = target;
    this.#releasing = false;
    this.#send();
  }

  release() {
    if (this.#particle < 0) return;
    this.#target = null;
    this.#releasing = true;
    this.#send();
  }

  async #send() {
    if (this.#busy) return;
    this.#busy = true;
    try {
      while (this.#target || this.#releasing) await this.#sendOne();
    } catch (error) {
      this.#target = null;
      this.#releasing = false;
      this.#refused(error.message);
    }
    this.#busy = false;
  }

  async #sendOne() {
    const particle = this.#particle;
    const target = this.#target;
    this.#target = null;
    const releases = !target;
    if (releases) {
      this.#releasing = false;
      this.#particle = -1;
    }
    const reply = await this.#command(releases ? "release" : "grab", releases ? { particle } : { particle, target });
    if (!releases && reply.outcome !== "applied") throw new Error(reply.reason || `The grab was answered ${reply.outcome}.`);
  }
}
