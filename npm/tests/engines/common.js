// What the pages of all engines do: draw each material with float normals and with codes, and compare the pixels.

export const WIDTH = 800;
export const HEIGHT = 600;
export const CODECS = ["oct16p", "oct24p", "oct32p", "frame32"];
/** Components that may differ by more than a codec explains, those of four pixels. */
const JUMPS = 12;
/** Materials of this ending have a normal map. */
export const MAPPED = " + normal map";

/** Arrays of the mesh, and its codes by codec. */
export async function meshOfServer() {
  const read = async (name, type) => [name, new type(await (await fetch(`/mesh/${name}`)).arrayBuffer())];
  const floats = ["positions", "normals", "tangents", "uvs"].map((name) => read(name, Float32Array));
  const codes = CODECS.map((name) => read(name, name === "oct16p" ? Uint16Array : Uint32Array));
  return Object.fromEntries(await Promise.all([...floats, ...codes, read("index", Uint32Array)]));
}

/** A bumpy normal map, 64 texels wide, as RGBA. */
export function normalMap() {
  const texels = new Uint8Array(64 * 64 * 4);
  for (let i = 0; i < 64 * 64; i++) {
    const [x, y] = [0.2 * Math.sin((i % 64) / 4), 0.15 * Math.cos(Math.floor(i / 64) / 3)];
    const n = [x, y, Math.sqrt(1 - x * x - y * y)];
    texels.set([...n.map((c) => Math.round(127.5 + 127.5 * c)), 255], 4 * i);
  }
  return texels;
}

/**
 * Rows of materials and codecs: the largest difference from float normals of a colour's component, of 255, the one that
 * all but `JUMPS` keep, and how many differ, of those that are lit. `draw(material, codec)` gives pixels; its codec is
 * null for floats.
 */
export async function compare(materials, draw) {
  const rows = [];
  for (const material of materials) {
    const floats = await draw(material, null);
    const lit = floats.filter((value, i) => value > 0 && i % 4 < 3).length;
    for (const codec of CODECS) {
      const pixels = await draw(material, codec);
      const differences = pixels.map((value, i) => Math.abs(value - floats[i]));
      const sorted = differences.filter((d) => d > 0).sort();
      const [largest, usual] = [sorted.at(-1), sorted.at(-1 - JUMPS)];
      rows.push({ material, codec, largest, usual, different: sorted.length, lit });
    }
  }
  return rows;
}
