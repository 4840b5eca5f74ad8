// The object that the page begins with, and what it adds to meshes from files.

const SIDE = 32;

// A pebble: the star r(d) d over the unit sphere, r = 1 + h, with normals by the gradient of the polynomial h: r d - (g - (g.d) d).
export function pebble() {
  const places = [];
  const normals = [];
  const indices = [];
  for (const [axis, sign] of [[0, 1], [0, -1], [1, 1], [1, -1], [2, 1], [2, -1]]) {
    const first = places.length / 3;
    for (let j = 0; j <= SIDE; j++) {
      for (let i = 0; i <= SIDE; i++) {
        const [a, b] = [i, j].map((k) => Math.tan((Math.PI / 4) * ((2 * k) / SIDE - 1)));
        const d = [0, 0, 0];
        [d[axis], d[(axis + 1) % 3], d[(axis + 2) % 3]] = [sign, a, b * sign];
        const { place, normal } = onPebble(unit(d));
        places.push(...place);
        normals.push(...normal);
        if (i < SIDE && j < SIDE) {
          const at = first + j * (SIDE + 1) + i;
          indices.push(at, at + 1, at + SIDE + 2, at, at + SIDE + 2, at + SIDE + 1);
        }
      }
    }
  }
  return whole({ places: new Float32Array(places), normals: new Float32Array(normals), indices: new Uint32Array(indices) });
}

function onPebble([x, y, z]) {
  const r = 1 + 0.22 * x * y + 0.16 * y * z * x - 0.18 * y * y + 0.1 * x * x * z;
  const g = [0.22 * y + 0.16 * y * z + 0.2 * x * z, 0.22 * x + 0.16 * z * x - 0.36 * y, 0.16 * x * y + 0.1 * x * x];
  const along = g[0] * x + g[1] * y + g[2] * z;
  const d = [x, y, z];
  return { place: d.map((c) => r * c), normal: unit(d.map((c, k) => r * c - (g[k] - along * c))) };
}

// The mesh within the unit sphere about the origin, with the normals that it lacks.
export function whole({ places, normals, indices }) {
  const low = [Infinity, Infinity, Infinity];
  const high = low.map((x) => -x);
  places.forEach((x, at) => {
    low[at % 3] = Math.min(low[at % 3], x);
    high[at % 3] = Math.max(high[at % 3], x);
  });
  const middle = low.map((x, k) => (x + high[k]) / 2);
  let radius = 0;
  for (let at = 0; at < places.length; at += 3) radius = Math.max(radius, Math.hypot(...middle.map((m, k) => places[at + k] - m)));
  const fitted = places.map((x, at) => (x - middle[at % 3]) / (radius || 1));
  return { places: fitted, normals: scaled(normals ?? normalsOf(fitted, indices)), indices };
}

// Vectors of length 1; those without a length stay.
function scaled(vectors) {
  const out = new Float32Array(vectors.length);
  for (let at = 0; at < vectors.length; at += 3) {
    const length = Math.hypot(vectors[at], vectors[at + 1], vectors[at + 2]) || 1;
    for (let k = 0; k < 3; k++) out[at + k] = vectors[at + k] / length;
  }
  return out;
}

// Normals of vertices: the sum over their triangles, by area.
function normalsOf(places, indices) {
  const sums = new Float32Array(places.length);
  for (let at = 0; at < indices.length; at += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => indices[at + k] * 3);
    const [u, v] = [b, c].map((to) => [0, 1, 2].map((k) => places[to + k] - places[a + k]));
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (const to of [a, b, c]) n.forEach((x, k) => (sums[to + k] += x));
  }
  return sums;
}

// Seven floats a vertex, as codecs of frames take them, with the tangent that lies in the plane of y.
export function frames(normals) {
  const out = new Float32Array((normals.length / 3) * 7);
  for (let at = 0; at < normals.length / 3; at++) {
    const [x, y, z] = normals.subarray(3 * at, 3 * at + 3);
    out.set([x, y, z, -z, 0, x, 1], 7 * at);
  }
  return out;
}

const unit = (v) => v.map((x) => x / Math.hypot(...v));
