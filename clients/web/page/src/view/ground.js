import * as THREE from "three";

import { niceAbove } from "./colour_range.js";
import { GRID } from "./shaders.js";

/** A grid at the height of the ground, with its x and y in metres along two sides. */
export class Ground {
  group = new THREE.Group();
  height = 0; // m
  spacing = 1; // m, of the labelled lines

  #plane;
  #uniforms = {
    spacing: { value: 1 },
    reach: { value: 10 },
    centre: { value: new THREE.Vector2() },
    line: { value: new THREE.Color() },
    strength: { value: 0.5 },
  };
  #labels = new THREE.Group();
  #ink = "#000";
  #bounds = null;

  constructor() {
    const material = new THREE.ShaderMaterial({
      ...GRID,
      uniforms: this.#uniforms,
      transparent: true,
      depthWrite: false,
      side: THREE.DoubleSide,
    });
    this.#plane = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), material);
    this.#plane.renderOrder = -2;
    this.#plane.frustumCulled = false;
    this.group.add(this.#plane, this.#labels);
  }

  /** Lays the grid under a body of these bounds. */
  lay(bounds, height) {
    this.#bounds = bounds;
    this.height = height;
    const size = Math.max(bounds[3] - bounds[0], bounds[4] - bounds[1], 0.5 * (bounds[5] - bounds[2]), 1e-6);
    this.spacing = niceAbove(size / 5);
    const centre = [0, 1].map((axis) => (bounds[axis] + bounds[axis + 3]) / 2);
    const reach = 4 * size;
    this.#uniforms.spacing.value = this.spacing;
    this.#uniforms.reach.value = reach;
    this.#uniforms.centre.value.set(...centre);
    this.#plane.position.set(...centre, height);
    this.#plane.scale.setScalar(2 * reach);
    this.#write();
  }

  setInk(ink, strength) {
    this.#ink = ink;
    this.#uniforms.line.value.set(ink).convertLinearToSRGB();
    this.#uniforms.strength.value = strength;
    if (this.#bounds) this.#write();
  }

  #write() {
    for (const label of this.#labels.children) {
      label.material.map.dispose();
      label.material.dispose();
    }
    this.#labels.clear();
    const { spacing } = this;
    const [[left, right], [near, far]] = [0, 1].map((axis) => [
      Math.floor(this.#bounds[axis] / spacing + 1e-6) * spacing,
      Math.ceil(this.#bounds[axis + 3] / spacing - 1e-6) * spacing,
    ]);
    for (let x = left; x < right + spacing / 2; x += spacing) this.#put(`${written(x, spacing)}`, x, near - 0.3 * spacing);
    for (let y = near; y < far + spacing / 2; y += spacing) this.#put(`${written(y, spacing)}`, right + 0.3 * spacing, y);
    this.#put("x in m", (left + right) / 2, near - 0.85 * spacing);
    this.#put("y in m", right + 1.0 * spacing, (near + far) / 2);
  }

  #put(text, x, y) {
    const label = new THREE.Sprite(
      new THREE.SpriteMaterial({ map: writing(text, this.#ink), transparent: true, depthWrite: false, opacity: 0.75 }),
    );
    label.position.set(x, y, this.height);
    const { width, height } = label.material.map.image;
    label.scale.set((0.2 * this.spacing * width) / height, 0.2 * this.spacing, 1);
    label.renderOrder = -1;
    this.#labels.add(label);
  }
}

const written = (value, spacing) => Number((Math.round(value / spacing) * spacing).toPrecision(6));

function writing(text, ink) {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const font = "500 36px system-ui, sans-serif";
  context.font = font;
  canvas.width = Math.ceil(context.measureText(text).width) + 8;
  canvas.height = 48;
  context.font = font;
  context.fillStyle = ink;
  context.textBaseline = "middle";
  context.fillText(text, 4, 25);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  return texture;
}
