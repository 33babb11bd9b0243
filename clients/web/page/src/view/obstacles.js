import * as THREE from "three";

/**
 * The obstacles of the scene, found by their parameters: contact.NAME with center and radius, with lo and hi, or with
 * point and normal. Gives [{name, kind, numbers...}].
 */
export function obstaclesOf(parameters) {
  const found = new Map();
  for (const { name, numbers } of parameters?.values ?? []) {
    const match = /^contact\.([^.]+)\.(center|radius|lo|hi|point|normal)$/.exec(name);
    if (!match) continue;
    if (!found.has(match[1])) found.set(match[1], { name: match[1] });
    found.get(match[1])[match[2]] = match[2] === "radius" ? numbers[0] : Array.from(numbers);
  }
  return [...found.values()].map((obstacle) => ({ kind: kindOf(obstacle), ...obstacle }));
}

const kindOf = ({ radius, lo }) => (radius !== undefined ? "sphere" : lo ? "box" : "plane");

/** The height of the highest level plane, or null. */
export function groundHeight(obstacles) {
  const heights = obstacles.filter(({ kind, normal }) => kind === "plane" && isUp(normal)).map(({ point }) => point[2]);
  return heights.length ? Math.max(...heights) : null;
}

const isUp = (normal) => normal && normal[2] > 0.999 * Math.hypot(...normal);

/** Draws obstacles: level planes are the ground's grid, others a pale sheet. */
export class Obstacles {
  group = new THREE.Group();

  #key = "";
  #material = new THREE.MeshLambertMaterial({ color: "#8d97a5" });
  #sheet = new THREE.MeshLambertMaterial({ color: "#8d97a5", transparent: true, opacity: 0.35, side: THREE.DoubleSide });

  constructor() {
    const sky = new THREE.HemisphereLight("#ffffff", "#70747c", 2.2);
    sky.position.set(0, 0, 1);
    const sun = new THREE.DirectionalLight("#ffffff", 1.1);
    sun.position.set(-0.4, -0.6, 1);
    this.lights = [sky, sun];
  }

  /** True when something changed. `size`: of the scene, m. */
  update(obstacles, size) {
    const key = JSON.stringify([obstacles, size]);
    if (key === this.#key) return false;
    this.#key = key;
    for (const mesh of this.group.children) mesh.geometry.dispose();
    this.group.clear();
    for (const obstacle of obstacles) {
      const mesh = this.#make(obstacle, size);
      if (mesh) this.group.add(mesh);
    }
    return true;
  }

  setColour(colour) {
    this.#material.color.set(colour);
    this.#sheet.color.set(colour);
  }

  // A little smaller than they are, so that what lies on them is not cut by rounding.
  #make({ kind, center, radius, lo, hi, point, normal }, size) {
    if (kind === "sphere") {
      const mesh = new THREE.Mesh(new THREE.SphereGeometry(0.99 * radius, 64, 40), this.#material);
      mesh.position.set(...center);
      return mesh;
    }
    if (kind === "box") {
      const sizes = hi.map((value, axis) => value - lo[axis]);
      const mesh = new THREE.Mesh(new THREE.BoxGeometry(...sizes), this.#material);
      mesh.position.set(...hi.map((value, axis) => (value + lo[axis]) / 2));
      return mesh;
    }
    if (isUp(normal)) return null;
    const mesh = new THREE.Mesh(new THREE.PlaneGeometry(3 * size, 3 * size), this.#sheet);
    mesh.position.set(...point);
    mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), new THREE.Vector3(...normal).normalize());
    return mesh;
  }
}
