// Balls as meshes, to draw them: the corners of the faces lie on the spheres.

const GOLD = (1 + Math.sqrt(5)) / 2;
const CORNERS = [-1, GOLD, 0, 1, GOLD, 0, -1, -GOLD, 0, 1, -GOLD, 0, 0, -1, GOLD, 0, 1, GOLD, 0, -1, -GOLD, 0, 1, -GOLD,
  GOLD, 0, -1, GOLD, 0, 1, -GOLD, 0, -1, -GOLD, 0, 1];
const FACES = [0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1, 8,
  3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1];
const MOST_FACES = 300000;

function onSphere(points) {
  for (let i = 0; i < points.length; i += 3) {
    const length = Math.hypot(points[i], points[i + 1], points[i + 2]);
    for (let k = 0; k < 3; ++k) points[i + k] /= length;
  }
  return points;
}

/** Each face becomes four. */
function divided({points, faces}) {
  const finer = [...points], found = [], middles = new Map();
  const middle = (a, b) => {
    const key = `${Math.min(a, b)} ${Math.max(a, b)}`;
    if (!middles.has(key)) {
      middles.set(key, finer.length / 3);
      for (let k = 0; k < 3; ++k) finer.push(finer[3 * a + k] + finer[3 * b + k]);
    }
    return middles.get(key);
  };
  for (let c = 0; c < faces.length; c += 3) {
    const [x, y, z] = faces.slice(c, c + 3), [xy, yz, zx] = [middle(x, y), middle(y, z), middle(z, x)];
    found.push(x, xy, zx, y, yz, xy, z, zx, yz, xy, yz, zx);
  }
  return {points: onSphere(finer), faces: found};
}

/** Centres are drawn points, and radii drawn lengths. */
export function ballsMesh(centers, radii) {
  let unit = {points: onSphere([...CORNERS]), faces: FACES};
  for (let i = 0; i < 3 && unit.faces.length / 3 * 4 * radii.length <= MOST_FACES; ++i) unit = divided(unit);
  const size = unit.points.length, positions = new Float32Array(size * radii.length);
  const triangles = new Uint32Array(unit.faces.length * radii.length);
  radii.forEach((radius, ball) => {
    for (let i = 0; i < size; ++i) positions[ball * size + i] = centers[3 * ball + i % 3] + radius * unit.points[i];
    unit.faces.forEach((v, c) => { triangles[ball * unit.faces.length + c] = ball * size / 3 + v; });
  });
  return {positions, triangles};
}
