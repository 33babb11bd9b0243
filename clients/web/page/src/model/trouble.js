import { WORLD_STATES } from "../decode/idl.js";

/** Where a failed world's trouble is: the corners of the element, or the particle, or the place told; [] if it is none. */
export function troublePoints(status, topology, positions) {
  if (WORLD_STATES[status?.state] !== "failed" || !topology || !positions) return [];
  const { trouble } = status;
  const particles = troubleParticles(trouble, topology);
  if (particles.length) return particles.map((particle) => Array.from(positions.subarray(3 * particle, 3 * particle + 3)));
  return trouble.body && trouble.position.every(Number.isFinite) ? [Array.from(trouble.position)] : [];
}

// Elements and particles are numbered within their body.
function troubleParticles({ body: name, element, particle }, { bodies, tetrahedra, springs }) {
  const body = bodies.find((candidate) => candidate.name === name);
  if (!body) return [];
  if (element >= 0 && element < body.tetrahedra) {
    const at = 4 * (body.first_tetrahedron + element);
    return Array.from(tetrahedra.subarray(at, at + 4));
  }
  if (element >= 0 && element < body.springs) {
    const at = 2 * (body.first_spring + element);
    return Array.from(springs.subarray(at, at + 2));
  }
  return particle >= 0 && particle < body.particles ? [body.first_particle + particle] : [];
}
