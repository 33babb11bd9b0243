import * as THREE from "three";

import { boundsOf, edgesOf } from "../model/topology.js";
import { SEQUENTIAL } from "./colour_map.js";
import { calcNormals } from "./normals.js";
import { BALLS, RIBBONS, SHADOW, SURFACE } from "./shaders.js";

const MOST_RIBBON = 3; // px

/** The bodies of a world as a lit surface, or as particles and springs. Everything is drawn from one array of positions. */
export class Body {
  group = new THREE.Group();
  mode = "surface"; // or "particles"

  #topology;
  #positions;
  #normals;
  #values;
  #uniforms;
  #edges;
  #ribbonEnds;
  #ribbonValues;
  #surface;
  #balls;
  #ribbons = null; // made when first shown
  #shadow;

  constructor(topology) {
    this.#topology = topology;
    const { rest_positions, triangles } = topology;
    const particles = rest_positions.length / 3;
    this.#positions = dynamic(rest_positions.slice(), 3);
    this.#normals = dynamic(new Float32Array(3 * particles), 3);
    this.#values = dynamic(new Float32Array(particles), 1);
    this.#uniforms = {
      map: { value: mapTexture(SEQUENTIAL) },
      scale: { value: new THREE.Vector2(1, 0) },
      plain: { value: new THREE.Color() },
      mapped: { value: 1 },
      radius: { value: ballRadius(topology) },
      pixels: { value: 1 },
      ratio: { value: 1 },
      width: { value: 2 },
      opacity: { value: 1 },
      resolution: { value: new THREE.Vector2(1, 1) },
      ground: { value: 0 },
      lift: { value: 0 },
      strength: { value: 0.3 },
    };
    const surface = geometry({ position: this.#positions, normal: this.#normals, value: this.#values });
    surface.setIndex(new THREE.BufferAttribute(triangles, 1));
    this.#surface = new THREE.Mesh(surface, this.#material(SURFACE, { side: THREE.DoubleSide }));
    this.#shadow = new THREE.Mesh(surface, this.#material(SHADOW, SHADOW_ONCE));
    this.#shadow.renderOrder = -1;
    const balls = geometry({ position: this.#positions, value: this.#values });
    this.#balls = new THREE.Points(balls, this.#material(BALLS));
    for (const object of [this.#surface, this.#shadow, this.#balls]) this.#add(object);
    this.show(this.hasSurface ? "surface" : "particles");
  }

  get hasSurface() {
    return this.#topology.triangles.length > 0;
  }

  /** The triangles that a pointer meets: none where particles are shown. */
  get pickable() {
    return this.mode === "surface" ? this.#topology.triangles : [];
  }

  get particles() {
    return this.#positions.count;
  }

  get positions() {
    return this.#positions.array;
  }

  /** One number a particle, to be filled before `moved()`. */
  get values() {
    return this.#values.array;
  }

  show(mode) {
    this.mode = this.hasSurface ? mode : "particles";
    if (this.mode === "particles" && !this.#ribbons) this.#makeRibbons();
    this.#surface.visible = this.#shadow.visible = this.mode === "surface";
    this.#balls.visible = this.mode === "particles";
    if (this.#ribbons) this.#ribbons.visible = this.mode === "particles";
    this.moved();
  }

  /** The positions or values have changed. */
  moved() {
    this.#positions.needsUpdate = this.#values.needsUpdate = true;
    if (this.mode === "surface") {
      calcNormals(this.#positions.array, this.#topology.triangles, this.#normals.array);
      this.#normals.needsUpdate = true;
    } else {
      this.#fillRibbons();
    }
  }

  /** What colours mean: the map (null: none), and the value at its end; a diverging one begins at -most. */
  setScale(map, most, diverging) {
    this.#uniforms.mapped.value = map ? 1 : 0;
    if (map && this.#uniforms.map.value.image.data !== map) {
      this.#uniforms.map.value.dispose();
      this.#uniforms.map.value = mapTexture(map);
    }
    const factor = most > 0 ? 1 / most : 0;
    this.#uniforms.scale.value.set(diverging ? factor / 2 : factor, diverging ? 0.5 : 0);
  }

  setPlain(colour) {
    this.#uniforms.plain.value.set(colour).convertLinearToSRGB();
  }

  /** Size of the picture in device pixels, and how many of them are a pixel. */
  setSize(width, height, ratio) {
    this.#uniforms.pixels.value = height;
    this.#uniforms.ratio.value = ratio;
    this.#uniforms.resolution.value.set(width, height);
    const springs = this.#topology.springs.length / 2;
    this.#uniforms.width.value = Math.min(MOST_RIBBON, springs && springs < 300 ? 3 : 1.25) * ratio;
    this.#uniforms.opacity.value = springs && springs < 300 ? 1 : 0.75;
  }

  setGround(height, size, strength) {
    this.#uniforms.ground.value = height;
    this.#uniforms.lift.value = 0.0005 * size;
    this.#uniforms.strength.value = strength;
  }

  dispose() {
    for (const object of this.group.children) {
      object.geometry.dispose();
      object.material.dispose();
    }
    this.#uniforms.map.value.dispose();
  }

  #add(object) {
    object.frustumCulled = false;
    this.group.add(object);
  }

  #material(shader, options = {}) {
    return new THREE.ShaderMaterial({ ...shader, uniforms: this.#uniforms, ...options });
  }

  #makeRibbons() {
    this.#edges = edgesOf(this.#topology);
    const count = this.#edges.length / 2;
    this.#ribbonEnds = new Float32Array(6 * count);
    this.#ribbonValues = dynamicInstanced(new Float32Array(2 * count), 2);
    const ends = new THREE.InstancedInterleavedBuffer(this.#ribbonEnds, 6);
    ends.setUsage(THREE.DynamicDrawUsage);
    const ribbon = new THREE.InstancedBufferGeometry();
    ribbon.setAttribute("position", new THREE.BufferAttribute(new Float32Array(12), 3)); // three counts by it
    ribbon.setAttribute("corner", new THREE.BufferAttribute(new Float32Array([0, -1, 0, 1, 1, -1, 1, 1]), 2));
    ribbon.setAttribute("start", new THREE.InterleavedBufferAttribute(ends, 3, 0));
    ribbon.setAttribute("end", new THREE.InterleavedBufferAttribute(ends, 3, 3));
    ribbon.setAttribute("values", this.#ribbonValues);
    ribbon.setIndex([0, 2, 1, 1, 2, 3]);
    ribbon.instanceCount = count;
    this.#ribbons = new THREE.Mesh(ribbon, this.#material(RIBBONS, { side: THREE.DoubleSide, transparent: true }));
    this.#ribbons.renderOrder = 1;
    this.#add(this.#ribbons);
  }

  #fillRibbons() {
    const [positions, values, ends, ribbonValues] = [
      this.#positions.array, this.#values.array, this.#ribbonEnds, this.#ribbonValues.array,
    ];
    for (let i = 0; i < this.#edges.length; ++i) {
      const particle = this.#edges[i];
      ends[3 * i] = positions[3 * particle];
      ends[3 * i + 1] = positions[3 * particle + 1];
      ends[3 * i + 2] = positions[3 * particle + 2];
      ribbonValues[i] = values[particle];
    }
    this.#ribbons.geometry.getAttribute("start").data.needsUpdate = true;
    this.#ribbonValues.needsUpdate = true;
  }
}

// Every place of the ground is darkened once, however many triangles are above it.
const SHADOW_ONCE = {
  side: THREE.DoubleSide,
  transparent: true,
  depthWrite: false,
  stencilWrite: true,
  stencilFunc: THREE.EqualStencilFunc,
  stencilRef: 0,
  stencilZPass: THREE.IncrementStencilOp,
};

function dynamic(array, size) {
  return new THREE.BufferAttribute(array, size).setUsage(THREE.DynamicDrawUsage);
}

function dynamicInstanced(array, size) {
  return new THREE.InstancedBufferAttribute(array, size).setUsage(THREE.DynamicDrawUsage);
}

function geometry(attributes) {
  const made = new THREE.BufferGeometry();
  for (const [name, attribute] of Object.entries(attributes)) made.setAttribute(name, attribute);
  return made;
}

function mapTexture(bytes) {
  const texture = new THREE.DataTexture(bytes, bytes.length / 4, 1);
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

// A fifth of the usual distance of particles.
function ballRadius({ rest_positions }) {
  const bounds = boundsOf(rest_positions);
  const sizes = [0, 1, 2].map((axis) => bounds[axis + 3] - bounds[axis]).sort((a, b) => b - a);
  const particles = rest_positions.length / 3;
  const dimensions = sizes.filter((size) => size > 0.02 * sizes[0]).length || 1;
  const measure = sizes.slice(0, dimensions).reduce((product, size) => product * size, 1);
  return 0.2 * (measure / particles) ** (1 / dimensions) || 0.02;
}
