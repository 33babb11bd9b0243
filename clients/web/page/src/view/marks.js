import * as THREE from "three";

const DOT = 11; // px

/** What is drawn over the bodies: the line from a grabbed particle to where it is pulled, and the place of a failure. */
export class Marks {
  group = new THREE.Group();

  #grab = marked("#ff9f1c", 2);
  #trouble = marked("#ff3b4e", 12);

  constructor() {
    this.group.add(this.#grab.group, this.#trouble.group);
  }

  /** `from`, `to`: arrays of three, or null for none. */
  showGrab(from, to) {
    place(this.#grab, from ? [from, to] : [], from ? [from, to] : []);
  }

  /** The corners of an element, or one particle; its edges are drawn, too. */
  showTrouble(points) {
    const lines = [];
    for (let a = 0; a < points.length; ++a) for (let b = a + 1; b < points.length; ++b) lines.push(points[a], points[b]);
    place(this.#trouble, points, lines);
  }
}

function marked(colour, capacity) {
  const over = { color: colour, depthTest: false, depthWrite: false, transparent: true };
  const dot = { ...over, map: roundTexture(), size: DOT * Math.min(devicePixelRatio, 2), sizeAttenuation: false };
  const points = new THREE.Points(buffer(capacity), new THREE.PointsMaterial(dot));
  const lines = new THREE.LineSegments(buffer(capacity), new THREE.LineBasicMaterial(over));
  const group = new THREE.Group();
  for (const object of [lines, points]) {
    object.frustumCulled = false;
    object.renderOrder = 10;
    group.add(object);
  }
  group.visible = false;
  return { group, points, lines };
}

function buffer(capacity) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * capacity), 3));
  return geometry;
}

function place({ group, points, lines }, at, segments) {
  group.visible = at.length > 0;
  for (const [object, places] of [[points, at], [lines, segments]]) {
    const attribute = object.geometry.getAttribute("position");
    places.forEach((place, i) => attribute.setXYZ(i, ...place));
    attribute.needsUpdate = true;
    object.geometry.setDrawRange(0, places.length);
  }
}

function roundTexture() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 32;
  const context = canvas.getContext("2d");
  context.fillStyle = "#fff";
  context.arc(16, 16, 14, 0, 2 * Math.PI);
  context.fill();
  return new THREE.CanvasTexture(canvas);
}
