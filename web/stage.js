// The picture: camera, split and the frames that are drawn.

import { mat4 } from "gl-matrix";

const FOV = 0.62;
const MOST_PIXELS = 2_500_000;
// Radians a millisecond.
const TURN = 0.00025;
const LEAST_QUALITY = 0.4;

// Runs the viewer on a `gpu`. `state` has yaw, pitch, distance, split, turn and show, which it reads, and writes when the user moves.
export function startStage(gpu, canvas, split, state, changed) {
  let [isDue, isReady, before, quality] = [false, false, 0, 1];
  const frame = (now) => {
    isDue = false;
    const took = now - before;
    before = now;
    const moves = state.turn || pointers.size > 0;
    if (state.turn && !pointers.size) state.yaw += Math.min(took, 50) * TURN;
    // Slow devices get fewer pixels while the picture moves, and all of them when it rests.
    quality = moves ? Math.min(Math.max(quality * (took > 40 ? 0.93 : took < 20 ? 1.02 : 1), LEAST_QUALITY), 1) : 1;
    resize();
    draw();
    if (state.turn) due();
  };
  const due = () => {
    if (!isDue) requestAnimationFrame(frame);
    isDue = true;
  };
  const draw = () => {
    if (!isReady || document.hidden) return;
    const { width, height } = canvas;
    const background = getComputedStyle(canvas).backgroundColor.match(/[\d.]+/g).slice(0, 3).map((c) => c / 255);
    const { clip, eye } = camera(state, width / height);
    gpu.draw(new Float32Array([...clip, ...eye, height, state.split * width, state.scale, 0, 0]), background);
  };
  const resize = () => {
    const { width, height } = canvas.getBoundingClientRect();
    const ratio = Math.min(devicePixelRatio, 2, Math.sqrt(MOST_PIXELS / (width * height))) * (Math.round(quality * 10) / 10);
    const [columns, lines] = [width, height].map((side) => Math.max(1, Math.round(side * ratio)));
    if (canvas.width !== columns) canvas.width = columns;
    if (canvas.height !== lines) canvas.height = lines;
  };
  new ResizeObserver(due).observe(canvas);

  const move = (yaw, pitch, closer = 1) => {
    state.yaw += yaw;
    state.pitch = Math.min(Math.max(state.pitch + pitch, -1.5), 1.5);
    state.distance = Math.min(Math.max(state.distance / closer, 1.25), 12);
    due();
    changed();
  };
  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const from = pointers.get(event.pointerId);
    if (!from) return;
    const apart = spread();
    const to = { x: event.clientX, y: event.clientY };
    pointers.set(event.pointerId, to);
    if (pointers.size > 1) move(0, 0, spread() / (apart || 1) || 1);
    else move((from.x - to.x) * 0.008, (to.y - from.y) * 0.008);
  });
  const release = ({ pointerId }) => {
    pointers.delete(pointerId);
    due();
  };
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, release);
  canvas.addEventListener("wheel", (event) => { event.preventDefault(); move(0, 0, Math.exp(-event.deltaY * 0.0012)); }, { passive: false });
  const by = (...step) => () => move(...step);
  const arrows = { ArrowLeft: by(0.1, 0), ArrowRight: by(-0.1, 0), ArrowUp: by(0, 0.1), ArrowDown: by(0, -0.1) };
  onKeys(canvas, { ...arrows, "+": by(0, 0, 1.1), "=": by(0, 0, 1.1), "-": by(0, 0, 1 / 1.1) });

  const setSplit = (part) => {
    state.split = Math.min(Math.max(part, 0), 1);
    split.style.left = `${100 * state.split}%`;
    const percent = Math.round(100 * state.split);
    split.setAttribute("aria-valuenow", percent);
    split.setAttribute("aria-valuetext", `${percent} % floats, ${100 - percent} % codes`);
    due();
  };
  split.addEventListener("pointerdown", (event) => { split.setPointerCapture(event.pointerId); event.preventDefault(); split.focus(); });
  split.addEventListener("pointermove", (event) => {
    if (!split.hasPointerCapture(event.pointerId)) return;
    const { left, width } = canvas.getBoundingClientRect();
    setSplit((event.clientX - left) / width);
    changed();
  });
  const step = (part) => () => { setSplit(state.split + part); changed(); };
  const small = { ArrowLeft: step(-0.02), ArrowDown: step(-0.02), ArrowRight: step(0.02), ArrowUp: step(0.02) };
  onKeys(split, { ...small, PageDown: step(-0.1), PageUp: step(0.1), Home: step(-1), End: step(1) });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", due);
  document.addEventListener("visibilitychange", due);

  // An address may say anything.
  move(0, 0);
  return { due, setSplit, ready: (is) => { isReady = is; due(); }, drawNow: draw };
}

function onKeys(element, actions) {
  element.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !Object.hasOwn(actions, event.key)) return;
    event.preventDefault();
    actions[event.key]();
  });
}

// The matrix of clip space and the eye, from angles in radians about the origin. Depth is from 0 to 1, which both APIs take.
function camera({ yaw, pitch, distance }, aspect) {
  // A narrow picture shows the whole object, too.
  const far = distance * Math.max(1, 1 / aspect);
  const eye = [far * Math.cos(pitch) * Math.sin(yaw), far * Math.sin(pitch), far * Math.cos(pitch) * Math.cos(yaw)];
  const clip = mat4.perspectiveZO(mat4.create(), FOV, aspect, Math.max(far - 2, 0.02), far + 2);
  return { clip: mat4.multiply(clip, clip, mat4.lookAt(mat4.create(), eye, [0, 0, 0], [0, 1, 0])), eye };
}
