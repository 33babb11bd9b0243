/** Collects flexcast::Topology, body by body and chunk by chunk, until a scene's topology is complete. */
export class TopologyAssembler {
  #parts = new Map(); // "revision body chunk" -> message

  add(message) {
    this.#parts.set(key(message.topology_revision, message.body, message.chunk), message);
  }

  /** The whole topology of a scene, or null while parts are missing. Parts of other revisions are forgotten then. */
  complete(scene) {
    const revision = scene.topology_revision;
    const parts = [];
    for (let body = 0; body < scene.bodies.length; ++body) {
      const first = this.#parts.get(key(revision, body, 0));
      if (!first) return null;
      for (let chunk = 0; chunk < first.chunks; ++chunk) {
        const part = this.#parts.get(key(revision, body, chunk));
        if (!part) return null;
        parts.push(part);
      }
    }
    this.#parts = new Map(parts.map((part) => [key(revision, part.body, part.chunk), part]));
    return join(scene, parts);
  }
}

const key = (revision, body, chunk) => `${revision} ${body} ${chunk}`;

// Numbers of particles are those of the world. Elements are numbered within their body: `bodies` says where each begins.
function join(scene, parts) {
  const concatenate = (name, Type) => {
    const joined = new Type(parts.reduce((sum, part) => sum + part[name].length, 0));
    let at = 0;
    for (const part of parts) {
      joined.set(part[name], at);
      at += part[name].length;
    }
    return joined;
  };
  let tetrahedra = 0;
  let springs = 0;
  const bodies = scene.bodies.map((body) => {
    const info = { ...body, first_tetrahedron: tetrahedra, first_spring: springs };
    tetrahedra += body.tetrahedra;
    springs += body.springs;
    return info;
  });
  return {
    revision: scene.topology_revision,
    bodies,
    rest_positions: concatenate("rest_positions", Float32Array),
    tetrahedra: concatenate("tetrahedra", Uint32Array),
    springs: concatenate("springs", Uint32Array),
    triangles: concatenate("triangles", Uint32Array),
  };
}

/**
 * The lines to draw: springs, and the edges of tetrahedra (of surface triangles where there would be too many), each
 * once, as pairs of particles.
 */
export function edgesOf(topology, most = 60000) {
  const { springs, tetrahedra, triangles, rest_positions } = topology;
  const particles = rest_positions.length / 3;
  const inside = (tetrahedra.length / 4) * 1.3 < most; // a tetrahedral mesh has about 1.2 edges an element
  const pairs = new Set();
  const add = (p, q) => pairs.add(p < q ? p * particles + q : q * particles + p);
  for (let i = 0; i < springs.length; i += 2) add(springs[i], springs[i + 1]);
  const [cells, corners] = inside && tetrahedra.length ? [tetrahedra, 4] : springs.length ? [[], 1] : [triangles, 3];
  for (let i = 0; i < cells.length; i += corners) {
    for (let a = 0; a < corners; ++a) for (let b = a + 1; b < corners; ++b) add(cells[i + a], cells[i + b]);
  }
  const edges = new Uint32Array(2 * pairs.size);
  let at = 0;
  for (const pair of pairs) {
    edges[at++] = Math.floor(pair / particles);
    edges[at++] = pair % particles;
  }
  return edges;
}

/** [min x, y, z, max x, y, z] of flat positions. */
export function boundsOf(positions) {
  const bounds = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    const axis = i % 3;
    if (positions[i] < bounds[axis]) bounds[axis] = positions[i];
    if (positions[i] > bounds[axis + 3]) bounds[axis + 3] = positions[i];
  }
  return bounds;
}
