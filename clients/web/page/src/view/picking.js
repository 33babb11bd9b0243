/**
 * The particle under a ray: the corner nearest to where the ray first meets the surface; without a hit the particle that
 * is nearest to the ray, within `reach` (a slope: distance from the ray over distance along it). -1: none.
 * `origin`, `direction` (of length 1): arrays of three.
 */
export function pickParticle(origin, direction, positions, triangles, reach) {
  const hit = firstHit(origin, direction, positions, triangles);
  if (hit) return nearestCorner(hit, positions, triangles);
  return nearestToRay(origin, direction, positions, reach);
}

// Möller and Trumbore, 1997; both sides.
function firstHit(origin, direction, positions, triangles) {
  const [ox, oy, oz] = origin;
  const [dx, dy, dz] = direction;
  let nearest = Infinity;
  let triangle = -1;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1], uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1], vz = positions[c + 2] - positions[a + 2];
    const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) continue;
    const sx = ox - positions[a], sy = oy - positions[a + 1], sz = oz - positions[a + 2];
    const u = (sx * px + sy * py + sz * pz) / determinant;
    if (u < 0 || u > 1) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
    const v = (dx * qx + dy * qy + dz * qz) / determinant;
    if (v < 0 || u + v > 1) continue;
    const distance = (vx * qx + vy * qy + vz * qz) / determinant;
    if (distance > 0 && distance < nearest) {
      nearest = distance;
      triangle = t;
    }
  }
  return triangle < 0 ? null : { triangle, point: origin.map((value, axis) => value + nearest * direction[axis]) };
}

function nearestCorner({ triangle, point }, positions, triangles) {
  const corners = Array.from(triangles.slice(triangle, triangle + 3));
  const distance = (p) => Math.hypot(...point.map((value, axis) => positions[3 * p + axis] - value));
  return corners.reduce((best, corner) => (distance(corner) < distance(best) ? corner : best));
}

function nearestToRay(origin, direction, positions, reach) {
  let best = reach * reach;
  let particle = -1;
  for (let p = 0, k = 0; k < positions.length; ++p, k += 3) {
    const x = positions[k] - origin[0], y = positions[k + 1] - origin[1], z = positions[k + 2] - origin[2];
    const along = x * direction[0] + y * direction[1] + z * direction[2];
    if (along <= 0) continue;
    const slope = (x * x + y * y + z * z) / (along * along) - 1; // tan^2 of the angle between them
    if (slope < best) {
      best = slope;
      particle = p;
    }
  }
  return particle;
}
