// The meshes of sizes.js, as three.js's geometries.
import { readFile } from "node:fs/promises";
import { BufferAttribute, BufferGeometry } from "three";

/** The bunny, with smooth normals, and texture coordinates about its axis. */
export async function bunny() {
  const lines = String(await readFile(new URL("../../host/mesh/data/bunny.obj", import.meta.url))).split("\n");
  const rows = (key) =>
    lines.filter((line) => line.startsWith(`${key} `)).map((line) => line.split(" ").slice(1, 4).map(parseFloat));
  const geometry = indexed(
    rows("v").flat(),
    rows("f")
      .flat()
      .map((vertex) => vertex - 1),
  );
  geometry.computeVertexNormals();
  const uvs = rows("v").flatMap(([x, y, z]) => [Math.atan2(x, z), y]);
  return geometry.setAttribute("uv", new BufferAttribute(new Float32Array(uvs), 2));
}

/** Hills over a square of 1000 by 1000 vertices, with the normals of their formula. */
export function million() {
  const side = 1000;
  const positions = new Float32Array(3 * side * side);
  const normals = new Float32Array(3 * side * side);
  const uvs = new Float32Array(2 * side * side);
  const waves = [
    [3, 5, 0.05],
    [11, -7, 0.02],
    [37, 29, 0.006],
    [90, 113, 0.002],
  ];
  for (let i = 0; i < side * side; i++) {
    const [x, z] = [(i % side) / side, Math.floor(i / side) / side];
    const sum = (term) => waves.reduce((total, wave) => total + term(wave), 0);
    const slope = (along) => sum(([a, b, height]) => (along ? a : b) * height * Math.cos(a * x + b * z));
    positions.set([x, sum(([a, b, height]) => height * Math.sin(a * x + b * z)), z], 3 * i);
    const length = Math.hypot(slope(true), 1, slope(false));
    normals.set([-slope(true) / length, 1 / length, -slope(false) / length], 3 * i);
    uvs.set([x, z], 2 * i);
  }
  const corners = [];
  for (let i = 0; i < side * (side - 1); i++) {
    if ((i + 1) % side) corners.push(i, i + side, i + 1, i + 1, i + side, i + side + 1);
  }
  return indexed(positions, corners)
    .setAttribute("normal", new BufferAttribute(normals, 3))
    .setAttribute("uv", new BufferAttribute(uvs, 2));
}

function indexed(positions, corners) {
  const index = new BufferAttribute(new (positions.length < 3 * 65536 ? Uint16Array : Uint32Array)(corners), 1);
  return new BufferGeometry().setIndex(index).setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
}
