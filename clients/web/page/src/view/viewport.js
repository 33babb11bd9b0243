import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { WORLD_STATES } from "../decode/idl.js";
import { boundsOf } from "../model/topology.js";
import { Body } from "./body.js";
import { DIVERGING, SEQUENTIAL } from "./colour_map.js";
import { ColourRange } from "./colour_range.js";
import { COLOURINGS, SpringStretch, Velocity } from "./colouring.js";
import { Ground } from "./ground.js";
import { Marks } from "./marks.js";
import { Obstacles, groundHeight, obstaclesOf } from "./obstacles.js";

const FAR = 30; // times the size of a scene: nobody would look there
const VIEW = new THREE.Vector3(0.62, -1, 0.5).normalize(); // from where a scene is first seen

/** The picture: camera, ground, obstacles and bodies. It draws when something changed. */
export class Viewport {
  marks = new Marks();
  body = null;
  colouring = "speed";
  changed = true;
  atRest = false; // a world that failed and flew apart is shown in its rest shape

  #world;
  #renderer;
  #scene = new THREE.Scene();
  #camera = new THREE.PerspectiveCamera(40, 1, 0.01, 100);
  #ground = new Ground();
  #obstacles = new Obstacles();
  #range = new ColourRange();
  #velocity = new Velocity();
  #springStretch = null;
  #size = 1;
  #fitted = null; // name of the scene that the camera was set for
  #plain = "#888";
  #shadow = 0.3;
  #insets = { left: 0, right: 0, top: 0, bottom: 0 };
  #flight = null;
  #follows = true; // until somebody turns the view
  #fittedBounds = null;
  #grown = null; // what they have to be

  constructor(canvas, world) {
    this.#world = world;
    this.#renderer = new THREE.WebGLRenderer({ canvas, antialias: true, stencil: true, alpha: true });
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.#camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => (this.changed = true));
    this.controls.addEventListener("start", () => {
      this.#flight = null;
      this.#follows = false;
    });
    this.#scene.add(this.#ground.group, this.#obstacles.group, this.marks.group, ...this.#obstacles.lights);
    world.on("topology", (topology) => this.#setTopology(topology)).on("parameters", () => this.#setObstacles());
    new ResizeObserver(() => this.#resize()).observe(canvas);
  }

  get camera() {
    return this.#camera;
  }

  get range() {
    return this.#range.most;
  }

  /** Why the bodies cannot be coloured by this, or "". */
  unavailable(colouring) {
    return COLOURINGS[colouring].available(this.#sources());
  }

  colourBy(colouring) {
    this.colouring = colouring;
    this.#range.clear();
    this.#colour(0);
    this.body?.moved();
    this.changed = true;
  }

  show(mode) {
    this.body?.show(mode);
    this.changed = true;
  }

  /** Takes the newest positions; `elapsed` is the time since the last ones, s. */
  update(elapsed) {
    const { particles } = this.#world;
    if (!this.body || particles.total !== this.body.particles) return;
    this.atRest = this.#failed && this.#flewApart(particles.bounds);
    this.body.positions.set(this.atRest ? this.#world.topology.rest_positions : particles.positions);
    this.#colour(elapsed);
    this.body.moved();
    this.changed = true;
    this.#follow();
  }

  /** Draws if anything changed; true when it did. */
  draw() {
    this.#fly();
    this.controls.update();
    if (!this.changed) return false;
    this.changed = false;
    this.#renderer.render(this.#scene, this.#camera);
    return true;
  }

  setTheme({ plain, ink, grid, obstacle, shadow }) {
    this.#plain = plain;
    this.#shadow = shadow;
    this.#ground.setInk(ink, grid);
    this.#obstacles.setColour(obstacle);
    this.body?.setPlain(plain);
    this.#setShadow();
    this.changed = true;
  }

  /** How much of the picture other things cover, in px: what is looked at is in the middle of the rest. */
  setInsets(insets) {
    this.#insets = insets;
    this.#resize();
  }

  /** Brings everything into view, as first seen with `home`, else from where one looks. Smoothly, if asked. */
  fit({ home = false, smoothly = true } = {}) {
    if (!this.body) return;
    this.#follows ||= home;
    const bounds = (this.#fittedBounds = this.#seenBounds());
    const centre = new THREE.Vector3(...[0, 1, 2].map((axis) => (bounds[axis] + bounds[axis + 3]) / 2));
    const radius = Math.max(Math.hypot(...[0, 1, 2].map((axis) => bounds[axis + 3] - bounds[axis])) / 2, 0.25 * this.#size);
    const angle = THREE.MathUtils.degToRad(this.#camera.fov / 2);
    const { left, right, top, bottom } = this.#insets;
    const canvas = this.#renderer.domElement;
    const [width, height] = [canvas.clientWidth - left - right, canvas.clientHeight - top - bottom];
    const narrow = Math.min(1, width / Math.max(height, 1)) * Math.max(height / canvas.clientHeight, 0.3);
    const distance = (1.02 * radius) / Math.sin(Math.atan(Math.tan(angle) * narrow));
    const direction = home ? VIEW.clone() : this.#camera.position.clone().sub(this.controls.target).normalize();
    const position = centre.clone().addScaledVector(direction, distance);
    if (smoothly) {
      this.#flight = { position, target: centre, left: 24 };
    } else {
      this.#camera.position.copy(position);
      this.controls.target.copy(centre);
      this.controls.update();
    }
    this.changed = true;
  }

  /** The ray under a place of the canvas, px: {origin, direction} as arrays. */
  ray(x, y) {
    const { clientWidth, clientHeight } = this.#renderer.domElement;
    this.#camera.updateMatrixWorld();
    const far = new THREE.Vector3((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight, 0.5).unproject(this.#camera);
    const direction = far.sub(this.#camera.position).normalize();
    return { origin: this.#camera.position.toArray(), direction: direction.toArray() };
  }

  /** The slope of so many px beside a ray. */
  slope(pixels) {
    const { clientHeight } = this.#renderer.domElement;
    return (2 * pixels * Math.tan(THREE.MathUtils.degToRad(this.#camera.fov / 2))) / clientHeight;
  }

  /** Where on the canvas a place of the world is, px. */
  project(place) {
    const { clientWidth, clientHeight } = this.#renderer.domElement;
    this.#camera.updateMatrixWorld();
    const at = new THREE.Vector3(...place).project(this.#camera);
    return [((at.x + 1) / 2) * clientWidth, ((1 - at.y) / 2) * clientHeight];
  }

  #sources() {
    const { particles, topology } = this.#world;
    return { particles, topology, velocity: this.#velocity, springStretch: this.#springStretch };
  }

  #colour(elapsed) {
    if (!this.body) return;
    const colouring = COLOURINGS[this.colouring];
    if (!colouring.calc || this.unavailable(this.colouring)) {
      this.body.setScale(null, 0, false);
      return;
    }
    this.#range.floor = colouring.noise(this.#size);
    this.#range.update(colouring.calc(this.#sources(), this.body.values), elapsed);
    this.body.setScale(colouring.diverging ? DIVERGING : SEQUENTIAL, this.#range.most, colouring.diverging);
  }

  #setTopology(topology) {
    const mode = this.body?.mode ?? "surface";
    if (this.body) {
      this.#scene.remove(this.body.group);
      this.body.dispose();
      this.body = null;
    }
    this.changed = true;
    this.#range.clear();
    if (!topology) return;
    this.#springStretch = new SpringStretch(topology);
    this.body = new Body(topology);
    this.body.setPlain(this.#plain);
    this.body.show(this.body.hasSurface && mode === "particles" ? mode : "surface");
    this.#scene.add(this.body.group);
    const bounds = boundsOf(topology.rest_positions);
    this.#size = Math.max(Math.hypot(...[0, 1, 2].map((axis) => bounds[axis + 3] - bounds[axis])), 1e-6);
    this.#camera.near = 0.005 * this.#size;
    this.#camera.far = 60 * this.#size;
    this.controls.minDistance = 0.02 * this.#size;
    this.controls.maxDistance = 20 * this.#size;
    this.#setObstacles();
    this.#resize();
    const name = this.#world.scene?.name;
    if (name !== this.#fitted) this.fit({ home: true, smoothly: false });
    this.#fitted = name;
  }

  #setObstacles() {
    const { topology, parameters } = this.#world;
    if (!topology) return;
    const obstacles = obstaclesOf(parameters);
    if (!this.#obstacles.update(obstacles, this.#size) && this.#ground.revision === topology.revision) return;
    this.#ground.revision = topology.revision;
    const bounds = united(boundsOf(topology.rest_positions), obstacles);
    this.#ground.lay(bounds, groundHeight(obstacles) ?? this.#floor(bounds));
    this.#setShadow();
    this.changed = true;
  }

  get #failed() {
    return WORLD_STATES[this.#world.status?.state] === "failed";
  }

  #flewApart(bounds) {
    return !bounds.every((value) => Math.abs(value) < FAR * this.#size + Math.max(...this.#fittedBounds.map(Math.abs)));
  }

  // Steps back when bodies leave what the view was set for. It never comes nearer by itself.
  #follow() {
    if (!this.#follows || this.#flight || !this.#fittedBounds) return;
    const before = this.#fittedBounds;
    const { bounds } = this.#world.particles;
    if (this.#flewApart(bounds)) return;
    const margin = 0.1 * this.#size;
    if ([0, 1, 2].every((axis) => bounds[axis] > before[axis] - margin && bounds[axis + 3] < before[axis + 3] + margin)) return;
    this.#grown = [0, 1, 2, 3, 4, 5].map((i) => (i < 3 ? Math.min(before[i], bounds[i]) : Math.max(before[i], bounds[i])));
    this.fit();
  }

  // Of the bodies, and of the ground and obstacles they are about to meet.
  #seenBounds() {
    const grown = this.#grown;
    this.#grown = null;
    const bounds = grown ?? boundsOf(this.body.positions);
    const { height } = this.#ground;
    if (bounds[2] > height && bounds[2] - height < 1.5 * this.#size) bounds[2] = height;
    return united(bounds, obstaclesOf(this.#world.parameters));
  }

  // z = 0 where the scene is about there, else a line of the grid below it.
  #floor(bounds) {
    if (bounds[2] >= -1e-9 && bounds[2] < 2 * this.#size) return 0;
    const step = this.#size / 10;
    return Math.floor(bounds[2] / step) * step;
  }

  #setShadow() {
    this.body?.setGround(this.#ground.height, this.#size, this.#shadow);
  }

  #resize() {
    const canvas = this.#renderer.domElement;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (!width || !height) return;
    const { left, right, top, bottom } = this.#insets;
    this.#renderer.setSize(width, height, false);
    this.#camera.aspect = width / height;
    // The middle of the picture is moved to the middle of what is not covered.
    this.#camera.setViewOffset(width, height, (right - left) / 2, (bottom - top) / 2, width, height);
    this.#camera.updateProjectionMatrix();
    this.body?.setSize(canvas.width, canvas.height, this.#renderer.getPixelRatio());
    this.changed = true;
  }

  // A few pictures on the way to where fit() goes.
  #fly() {
    if (!this.#flight) return;
    const { position, target, left } = this.#flight;
    const part = 1 / Math.max(left / 4, 1);
    this.#camera.position.lerp(position, part);
    this.controls.target.lerp(target, part);
    this.#flight = left > 1 ? { position, target, left: left - 1 } : null;
    this.changed = true;
  }
}

// With balls and boxes, unless they are far larger than the bodies.
function united(bounds, obstacles) {
  const size = Math.max(...[0, 1, 2].map((axis) => bounds[axis + 3] - bounds[axis]));
  for (const { center, radius, lo, hi } of obstacles) {
    const box = lo ? [...lo, ...hi] : center ? [...center.map((x) => x - radius), ...center.map((x) => x + radius)] : null;
    if (!box || Math.max(...[0, 1, 2].map((axis) => box[axis + 3] - box[axis])) > 3 * size) continue;
    for (let axis = 0; axis < 3; ++axis) {
      bounds[axis] = Math.min(bounds[axis], box[axis]);
      bounds[axis + 3] = Math.max(bounds[axis + 3], box[axis + 3]);
    }
  }
  return bounds;
}
