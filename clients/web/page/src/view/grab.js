import { pickParticle } from "./picking.js";

const REACH = 18; // px
const LONG_PRESS = 350; // ms
const STILL = 8; // px

/**
 * Turns presses and drags on a body into a particle and where to pull it, in the plane of the picture. A mouse grabs at
 * once (with Shift it turns the view), a finger after a long press, or at once while `always`. Calls `moved(particle,
 * target)` and `released()`.
 */
export class Grab {
  always = false;
  particle = -1;
  target = null;

  #viewport;
  #options;
  #pointer = null;
  #waiting = null;

  constructor(viewport, canvas, options) {
    this.#viewport = viewport;
    this.#options = options;
    this.canvas = canvas;
    // Before the controls of the camera, which listen to the canvas itself.
    const capture = { capture: true };
    canvas.parentElement.addEventListener("pointerdown", (event) => event.target === canvas && this.#down(event), capture);
    canvas.parentElement.addEventListener("pointermove", (event) => this.#move(event), capture);
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.parentElement.addEventListener(end, (event) => this.#up(event), capture);
    }
  }

  #down(event) {
    if (this.#pointer !== null) return this.#cancel(); // a second finger
    if (!this.#options.enabled() || event.button !== 0 || event.shiftKey || event.ctrlKey) return;
    if (event.pointerType === "mouse" || this.always) return this.#take(event);
    const { pointerId, clientX, clientY } = event;
    const timer = setTimeout(() => this.#take(event), LONG_PRESS);
    this.#pointer = pointerId;
    this.#waiting = { timer, clientX, clientY };
  }

  #take(event) {
    this.#pointer = null;
    this.#waiting = null;
    const particle = this.pick(event);
    if (particle < 0) return;
    this.#pointer = event.pointerId;
    this.particle = particle;
    this.#viewport.controls.enabled = false;
    this.canvas.classList.add("grabbing");
    if (event.pointerType !== "mouse") navigator.vibrate?.(10);
    this.#pull(event);
  }

  #move(event) {
    if (event.pointerId !== this.#pointer) return this.#hover(event);
    if (this.#waiting) {
      const { clientX, clientY } = this.#waiting;
      if (Math.hypot(event.clientX - clientX, event.clientY - clientY) > STILL) this.#cancel();
    } else {
      this.#pull(event);
    }
  }

  #up(event) {
    if (event.pointerId === this.#pointer) this.#cancel();
  }

  #cancel() {
    clearTimeout(this.#waiting?.timer);
    this.#pointer = null;
    this.#waiting = null;
    if (this.particle < 0) return;
    this.particle = -1;
    this.target = null;
    this.#viewport.controls.enabled = true;
    this.canvas.classList.remove("grabbing");
    this.#options.released();
  }

  #hover(event) {
    if (event.pointerType !== "mouse" || event.buttons || event.target !== this.canvas) return;
    const can = this.#options.enabled() && !event.shiftKey && this.pick(event) >= 0;
    this.canvas.classList.toggle("grabbable", can);
  }

  /** The particle under the pointer, or -1. */
  pick(event) {
    const { body } = this.#viewport;
    if (!body) return -1;
    const { origin, direction } = this.#ray(event);
    return pickParticle(origin, direction, body.positions, body.pickable, this.#viewport.slope(REACH));
  }

  #ray(event) {
    const box = this.canvas.getBoundingClientRect();
    return this.#viewport.ray(event.clientX - box.left, event.clientY - box.top);
  }

  // To where the ray meets the plane through the particle that faces the camera.
  #pull(event) {
    const { origin, direction } = this.#ray(event);
    const { positions } = this.#viewport.body;
    const at = Array.from(positions.subarray(3 * this.particle, 3 * this.particle + 3));
    this.depth = this.target ? this.depth : depthOf(at, origin, this.#forward());
    const along = this.depth / dot(direction, this.#forward());
    this.target = origin.map((value, axis) => value + along * direction[axis]);
    this.#options.moved(this.particle, this.target);
  }

  #forward() {
    const e = this.#viewport.camera.matrixWorld.elements;
    return [-e[8], -e[9], -e[10]];
  }
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const depthOf = (place, origin, forward) => dot(place.map((value, axis) => value - origin[axis]), forward);
