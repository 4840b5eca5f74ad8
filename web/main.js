// The page: its state, which the address keeps, and its controls.

import { GlbError, MOST_BYTES } from "./chunks.js";
import { LANGUAGES, json, textOf, unpacked } from "./code.js";
import { readGlb } from "./glb.js";
import { frames, pebble, whole } from "./mesh.js";
import { GRADIENT, drawSphere } from "./sphere.js";
import { startStage } from "./stage.js";
import { startWebGl } from "./webgl.js";
import { startWebGpu } from "./webgpu.js";

// Titles of families in the list; a family without one goes by its own name.
const TITLES = {
  oct: "Octahedral", oct_wide: "Octahedral", uoct: "Octahedral, unsigned", eaoct: "Octahedral, equal area", soct: "Octahedral, sign apart",
  hemioct: "Octahedral, half sphere", ico: "Icosahedral", hexcube: "Hexagons on a cube", fib: "Fibonacci's spiral", cube: "Cube",
  best_fit: "Best fit of components", snorm: "Raw components", unorm: "Raw components", float: "Raw components", azimuthal: "Azimuthal maps",
  spherical: "Angles", spherical_wide: "Angles", latlong: "Angles", cylindrical: "Angles", parallel: "Parallel projections",
  frame: "Normal with tangent",
};

const $ = (id) => document.getElementById(id);
const [panel, view] = [$("panel").elements, $("view").elements];
const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
// What the address keeps: `at` is where codes are stored, `split` the part of floats, angles are in radians, `distance` is in radii of the
// object, `gpu` a place in the list, and `api` is "webgl" to leave WebGPU out.
const first = {
  codec: "oct16p", dither: 0, at: "pixel", show: "mirror", split: 0.5, turn: isStill ? 0 : 1, gpu: 2, language: "glsl",
  yaw: 0.5, pitch: 0.35, distance: 3.15, api: "",
};
const state = { ...first };

const significant = (x) => (x === 0 ? "0" : x >= 0.001 ? String(Number(x.toPrecision(3))) : x.toExponential(2).replace("e-", "e−"));
const degrees = (x) => `${significant(x)}°`;
const seriesOf = ({ id }) => id.replace(/\d+/, "…");

// The data of the codecs, what draws, the object that is chosen and the one that the GPU has, and the name of its file.
let [facts, gpu, stage, mesh, drawn, own] = [];
let work = Promise.resolve();

const codec = () => facts.codecs.find(({ id }) => id === state.codec);
const series = (name) => facts.codecs.filter((other) => seriesOf(other) === name).sort((a, b) => a.bits - b.bits);

function readAddress() {
  for (const [key, value] of new URLSearchParams(location.hash.slice(1))) {
    if (!Object.hasOwn(first, key)) continue;
    const number = Number(value);
    if (typeof first[key] === "string") state[key] = value;
    else if (Number.isFinite(number)) state[key] = number;
  }
  if (!codec()) state.codec = first.codec;
  if (!Object.hasOwn(LANGUAGES, state.language)) state.language = first.language;
  if (!facts.gpus[state.gpu]) state.gpu = first.gpu;
  if (!["mirror", "gloss", "error"].includes(state.show)) state.show = first.show;
  if (!["pixel", "vertex"].includes(state.at)) state.at = first.at;
}

let later = 0;
function keepAddress() {
  clearTimeout(later);
  later = setTimeout(() => {
    const short = (x) => (typeof x === "number" ? Number(x.toFixed(3)) : x);
    const kept = Object.keys(first).filter((key) => state[key] !== first[key] && !(key === "yaw" && state.turn));
    history.replaceState(null, "", `#${new URLSearchParams(kept.map((key) => [key, short(state[key])]))}`);
  }, 200);
}

function tell(text) {
  $("message").textContent = text;
  $("message").hidden = !text;
}

const worker = new Worker(URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" })));
const asked = new Map();
worker.onmessage = ({ data: { id, result, reason } }) => {
  const [resolve, reject] = asked.get(id);
  asked.delete(id);
  if (reason) reject(Error(reason));
  else resolve(result);
};
worker.onerror = ({ message }) => tell(`The codecs cannot start: ${message ?? "this browser runs no worker here"}`);
let questions = 0;
// The worker's answer: words of codes for "encode", angles in degrees for "error".
function ask(question) {
  worker.postMessage({ id: ++questions, ...question });
  return new Promise((...both) => asked.set(questions, both));
}
const errorsOf = async (one, normals) => {
  const angles = await ask({ what: "error", codec: one.id, elements: floats(one, normals) });
  return one.frame ? angles.filter((_, at) => at % 2 === 0) : angles;
};

// Encoders by a table are for the CPU; half of the directions, and offsets of pixels, are for pixels.
const places = (one) => (one.by_table ? ["vertex"] : one.hemisphere || state.dither ? ["pixel"] : ["pixel", "vertex"]);
const place = (one) => (places(one).includes(state.at) ? state.at : places(one)[0]);
const floats = (one, normals) => (one.frame ? frames(normals) : normals);

// Shows the state on the GPU; one change after the other.
function render() {
  work = work.then(async () => {
    const [one, object] = [codec(), mesh];
    const at = place(one);
    const dither = Boolean(state.dither);
    try {
      const library = await textOf(gpu.name === "WebGPU" ? "wgsl" : "glsl-es", one, dither);
      const words = at === "vertex" ? await ask({ what: "encode", codec: one.id, elements: floats(one, object.normals) }) : null;
      await gpu.setCodec(library, { ...one, dither, at, show: state.show });
      if (drawn !== object) gpu.setMesh(object);
      drawn = object;
      gpu.setCodes(words);
      state.scale = 180 / Math.PI / one.errors[0][1];
      stage.ready(true);
    } catch (reason) {
      tell(reason.message);
    }
  });
  return work;
}

function rows(list, pairs) {
  list.replaceChildren(...pairs.map(([name, value, part]) => {
    const [pair, dt, dd] = ["div", "dt", "dd"].map((tag) => document.createElement(tag));
    dt.textContent = name;
    dd.textContent = value;
    if (part !== undefined) dd.style.setProperty("--part", part);
    pair.append(dt, dd);
    return pair;
  }));
}

function showCodec() {
  const one = codec();
  const widths = series(seriesOf(one));
  panel.family.value = seriesOf(one);
  panel.bits.max = widths.length - 1;
  panel.bits.value = widths.indexOf(one);
  panel.bits.disabled = widths.length === 1;
  panel.bits.setAttribute("aria-valuetext", `${one.bits} bits`);
  $("widths").replaceChildren(...widths.map((width) => {
    const item = document.createElement("li");
    item.textContent = width.bits;
    item.className = width === one ? "chosen" : "";
    return item;
  }));
  panel.dither.disabled = !one.dither;
  state.dither = one.dither ? state.dither : 0;
  panel.dither.checked = Boolean(state.dither);
  $("dither").title = one.dither ? "Noise in place of bands" : "This family has no dithered functions";
  for (const radio of view.at) radio.disabled = !places(one).includes(radio.value);
  view.at.value = place(one);
  $("codec").textContent = one.id;
  $("bytes").textContent = one.bits % 8 ? `${one.bits} bits` : `${one.bytes} byte${one.bytes > 1 ? "s" : ""}`;
  const uses = one.uses.length ? `Recommended — ${one.uses.join("; ")}` : (TITLES[one.family] ?? one.family);
  const half = one.hemisphere ? ", for z ≥ 0: here about the view" : "";
  $("use").textContent = `${uses}${half}${one.format ? ` ·\u00a0${one.format}` : ""}`;
  document.querySelector(".tag.right").textContent = one.id + (state.dither ? ", dithered" : "");
}

async function showFacts() {
  const one = codec();
  const [[mean, max, bound], tangent] = one.errors;
  $("most").textContent = degrees(max);
  const measured = [["mean", degrees(mean)], ["maximum", degrees(max)], ["bound", degrees(bound)]];
  if (tangent) measured.push(...["mean", "max", "bound"].map((name, at) => [`tangent, ${name}`, degrees(tangent[at])]));
  rows($("errors"), measured);
  showCosts(one);
  const half = one.hemisphere ? "z ≥ 0" : "z ≥ 0 and z ≤ 0";
  $("sphere").setAttribute("aria-label", `Error of ${one.id} over the sphere, ${half}: mean ${degrees(mean)}, maximum ${degrees(max)}`);
  $("sphere").setAttribute("aria-busy", "true");
  await drawSphere($("sphere"), (directions) => errorsOf(one, directions), max, one.hemisphere);
  if (own) {
    const errors = (await errorsOf(one, mesh.normals)).filter((angle) => !Number.isNaN(angle));
    const total = errors.reduce((sum, angle) => sum + angle, 0);
    measured.push(["your mesh, mean", degrees(total / errors.length || 0)], ["your mesh, max", degrees(errors.reduce((a, b) => Math.max(a, b), 0))]);
    rows($("errors"), measured);
  }
  $("sphere").removeAttribute("aria-busy");
}

function showCosts(one) {
  const row = (name, cost) => [name, cost === null ? "not known" : `${cost.toFixed(1)} × oct32`, Math.min((cost ?? 0) / 12, 1)];
  const [ofEncoder, ofDecoder] = one.costs[state.gpu];
  const ofFloats = one.frame ? 28 : 12;
  const memory = ["memory", `${one.bytes} of ${ofFloats} bytes`, one.bytes / ofFloats];
  rows($("costs"), [row("encode", ofEncoder), row("decode", ofDecoder), memory]);
}

async function showText() {
  const [language, one, dither] = [state.language, codec(), Boolean(state.dither)];
  const text = await textOf(language, one, dither);
  if (language === state.language && one === codec()) $("text").textContent = text;
}

let [factsWork, isAsked] = [null, false];
// Shows the facts of the chosen codec once those of earlier ones are there; what was chosen between is left out.
async function refreshFacts() {
  isAsked = true;
  factsWork ??= (async () => {
    while (isAsked) {
      isAsked = false;
      await showFacts().catch((reason) => tell(reason.message));
    }
    factsWork = null;
  })();
  return factsWork;
}

function change() {
  showCodec();
  showText();
  render();
  refreshFacts();
  keepAddress();
}

async function openFile(file) {
  try {
    if (file.size > MOST_BYTES) throw new GlbError(`the file has ${file.size} bytes; this page takes ${MOST_BYTES} at most`);
    mesh = whole(await readGlb(new Uint8Array(await file.arrayBuffer()), () => unpacked("data-draco")));
    own = file.name;
    tell("");
    say(`${file.name}: ${(mesh.places.length / 3).toLocaleString("en")} vertices`);
    show(true);
  } catch (reason) {
    tell(`${file.name}: ${reason instanceof GlbError ? reason.message : "this browser has no memory left for it"}`);
  }
}

const say = (text) => ($("said").textContent = text);

function show(isOwn) {
  $("reset").hidden = !isOwn;
  state.distance = first.distance;
  change();
}

function listen() {
  panel.family.addEventListener("input", () => {
    const widths = series(panel.family.value);
    const { bits } = codec();
    state.codec = widths.reduce((a, b) => (Math.abs(b.bits - bits) < Math.abs(a.bits - bits) ? b : a)).id;
    change();
  });
  panel.bits.addEventListener("input", () => { state.codec = series(seriesOf(codec()))[panel.bits.value].id; change(); });
  panel.dither.addEventListener("input", () => { state.dither = Number(panel.dither.checked); change(); });
  panel.gpu.addEventListener("input", () => { state.gpu = Number(panel.gpu.value); showCosts(codec()); keepAddress(); });
  panel.language.addEventListener("input", () => { state.language = panel.language.value; showText(); keepAddress(); });
  $("view").addEventListener("input", ({ target: { name, value, checked } }) => {
    if (name === "turn") state.turn = Number(checked);
    if (name === "show" || name === "at") { state[name] = value; showCodec(); render(); }
    stage.due();
    keepAddress();
  });
  for (const form of [$("panel"), $("view")]) form.addEventListener("submit", (event) => event.preventDefault());
  $("copy").addEventListener("click", async () => {
    // A page from a file may have no clipboard but that of its selection.
    getSelection().selectAllChildren($("text"));
    if (!document.execCommand("copy")) await navigator.clipboard?.writeText($("text").textContent);
    say("Copied");
    $("copy").textContent = "Copied";
    setTimeout(() => ($("copy").textContent = "Copy"), 1500);
  });
  $("open").addEventListener("click", () => $("file").click());
  $("file").addEventListener("change", () => { if ($("file").files[0]) openFile($("file").files[0]); $("file").value = ""; });
  $("reset").addEventListener("click", () => { mesh = pebble(); own = null; tell(""); show(false); $("open").focus(); });
  addEventListener("dragover", (event) => { event.preventDefault(); $("drop").hidden = false; });
  addEventListener("dragleave", (event) => { if (!event.relatedTarget) $("drop").hidden = true; });
  addEventListener("drop", (event) => { event.preventDefault(); $("drop").hidden = true; if (event.dataTransfer.files[0]) openFile(event.dataTransfer.files[0]); });
}

function fill() {
  const groups = new Map();
  for (const one of facts.codecs) {
    const title = TITLES[one.family] ?? one.family;
    if (!groups.has(title)) groups.set(title, new Set());
    groups.get(title).add(seriesOf(one));
  }
  for (const [title, names] of groups) {
    const group = document.createElement("optgroup");
    group.label = title;
    for (const name of names) {
      const widths = series(name);
      const bits = widths.length > 1 ? `${widths[0].bits} to ${widths.at(-1).bits} bits` : `${widths[0].bits} bits`;
      group.append(new Option(`${widths.length > 1 ? name : widths[0].id} · ${bits}`, name));
    }
    panel.family.append(group);
  }
  facts.gpus.forEach((name, at) => panel.gpu.append(new Option(name, at)));
  for (const [key, name] of Object.entries(LANGUAGES)) panel.language.append(new Option(name, key));
  [panel.gpu.value, panel.language.value, view.show.value, view.turn.checked] = [state.gpu, state.language, state.show, Boolean(state.turn)];
  document.documentElement.style.setProperty("--heat", GRADIENT);
}

// A browser whose process for the GPU has just ended, by a lost device of WebGPU, has no WebGL until the next one is there.
async function startedWebGl() {
  for (let tries = 1; ; tries++) {
    // A canvas keeps its first API.
    $("canvas").replaceWith($("canvas").cloneNode());
    try {
      return startWebGl($("canvas"));
    } catch (reason) {
      if (tries === 20) throw reason;
    }
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

async function start() {
  facts = await json("data-codecs");
  readAddress();
  fill();
  const codecs = ask({ wasm: await unpacked("data-wasm") });
  const onLoss = (why) => tell(`The GPU is gone (${why}): reload the page, with #api=webgl where it happens again.`);
  gpu = state.api === "webgl" ? null : await startWebGpu($("canvas"), onLoss).catch(() => null);
  gpu ??= await startedWebGl();
  $("api").textContent = `${gpu.name} · ${facts.version}`;
  stage = startStage(gpu, $("canvas"), $("split"), state, keepAddress);
  stage.setSplit(state.split);
  listen();
  mesh = pebble();
  await codecs;
  change();
  await work;
  // For tests.
  window.page = { state, gpu, stage, settled: () => Promise.all([work, factsWork]) };
}

start().catch((reason) => tell(`The page cannot start: ${reason.message}`));
