// three.js: WebGLRenderer, or with `webgpu` and `webgl` WebGPURenderer.
import { WIDTH, HEIGHT, MAPPED, compare, meshOfServer, normalMap } from "./common.js";

const KINDS = ["Normal", "Lambert", "Phong", "Toon", "Matcap", "Standard", "Physical"];

/**
 * Differences of all materials. `THREE` is the module of the renderer's edition, `codes` that of the package, and
 * `pixelsOf(scene, camera)` draws.
 */
export async function run({ THREE, GLTFLoader, codes, suffix, pixelsOf }) {
  const mesh = await meshOfServer();
  const bumps = new THREE.DataTexture(normalMap(), 64, 64);
  bumps.wrapS = bumps.wrapT = THREE.RepeatWrapping;
  bumps.needsUpdate = true;
  const camera = new THREE.PerspectiveCamera(45, WIDTH / HEIGHT, 0.1, 10);
  camera.position.z = 4.2;

  const draw = async (name, codec) => {
    const object = name === "glTF" ? await loaded(codec) : made(name, codec);
    const sun = new THREE.DirectionalLight(0xffffff, 3);
    sun.position.set(1, 2, 3);
    return pixelsOf(new THREE.Scene().add(object, sun, new THREE.AmbientLight(0x404060)), camera);
  };
  const made = (name, codec) => {
    const geometry = new THREE.BufferGeometry().setIndex(new THREE.BufferAttribute(mesh.index, 1));
    const isMapped = name.endsWith(MAPPED);
    geometry.setAttribute("position", new THREE.BufferAttribute(mesh.positions, 3));
    if (isMapped) geometry.setAttribute("uv", new THREE.BufferAttribute(mesh.uvs, 2));
    if (isMapped) geometry.setAttribute("tangent", new THREE.BufferAttribute(mesh.tangents, 4));
    if (!codec) geometry.setAttribute("normal", new THREE.BufferAttribute(mesh.normals, 3));
    if (codec === "frame32") geometry.deleteAttribute("tangent");
    const material = new THREE[`Mesh${name.replace(MAPPED, "")}${suffix}`]();
    if (material.color && material.type !== "MeshMatcapMaterial") material.color.set(0xccccff);
    if ("roughness" in material) Object.assign(material, { roughness: 0.25, metalness: 0.3 });
    if (isMapped) Object.assign(material, { normalMap: bumps });
    if (codec) codes.useCodes(material, codec);
    return new THREE.Mesh(codec ? codes.setCodes(geometry, mesh[codec], codec) : geometry, material);
  };
  const loaded = async (codec) => {
    const loader = new GLTFLoader();
    if (codec) loader.register(codes.codesPlugin);
    return (await loader.loadAsync(`/mesh/${codec ?? "floats"}.glb`)).scene;
  };
  return compare([...KINDS, `Normal${MAPPED}`, `Standard${MAPPED}`, "glTF"], draw);
}
