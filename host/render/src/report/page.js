"use strict";

// The same logic as `unitvec choose`: what meets the demand, fewest bytes first, then the cheapest, then the finest. Where no error
// is named, any code would do: then the finest comes first.
function candidates(codecs, demand) {
  const cost = (codec) => {
    const [encode, decode] = codec.costs[demand.gpu];
    return encode === null || decode === null ? Infinity : encode + decode;
  };
  const mean = (codec) => (demand.hemisphere ? codec.mean_above : codec.mean);
  const meets = (codec) =>
    codec.bits <= demand.bits &&
    (codec.unit || demand.raw) &&
    (!codec.hemisphere || demand.hemisphere) &&
    !(codec.by_table && demand.noTable) &&
    codec.max <= demand.max &&
    mean(codec) <= demand.mean &&
    (demand.cost === Infinity || cost(codec) <= demand.cost) &&
    (demand.format === "" || (demand.format === "*" ? codec.format !== null : codec.format === demand.format));
  const asked = demand.max < Infinity || demand.mean < Infinity;
  const finest = (a, b) => mean(a) - mean(b);
  const cheapest = (a, b) => a.bytes - b.bytes || (cost(a) === cost(b) ? 0 : cost(a) - cost(b)) || finest(a, b);
  return codecs.filter(meets).sort(asked ? cheapest : finest);
}

function startTable() {
  const codecs = JSON.parse(document.getElementById("codecs-data").textContent);
  const form = document.getElementById("demand");
  const body = document.querySelector("#codecs tbody");
  const domain = document.getElementById("domain");
  const choice = document.getElementById("choice");
  const fields = form.elements;
  const seen = new Set();
  for (const option of form.querySelectorAll("option.format")) {
    if (seen.has(option.value)) option.remove();
    seen.add(option.value);
  }
  const limit = (field) => (field.value === "" || !(Number(field.value) >= 0) ? Infinity : Number(field.value));
  const shown = (cost) => (cost === null ? "-" : cost.toFixed(1));

  const update = () => {
    const demand = {
      bits: Number(fields.bits.value),
      max: limit(fields.max),
      mean: limit(fields.mean),
      cost: limit(fields.cost),
      format: fields.format.value,
      gpu: Number(fields.gpu.value),
      hemisphere: fields.hemisphere.checked,
      noTable: fields.no_table.checked,
      raw: fields.raw.checked,
    };
    const found = candidates(codecs, demand);
    domain.textContent = demand.hemisphere ? "z >= 0" : "the directions that a codec is for";
    for (const row of body.rows) {
      row.hidden = true;
      row.classList.remove("best");
    }
    for (const codec of found) {
      const row = document.getElementById(`codec-${codec.id}`);
      row.hidden = false;
      row.querySelectorAll(".cost").forEach((cell, at) => { cell.textContent = shown(codec.costs[demand.gpu][at]); });
      const mean = row.querySelector(".mean");
      mean.textContent = demand.hemisphere ? mean.dataset.above : mean.dataset.all;
      body.append(row);
    }
    if (found.length === 0) {
      choice.textContent = "No codec meets this: allow more bits or a larger error.";
      return;
    }
    document.getElementById(`codec-${found[0].id}`).classList.add("best");
    const asked = demand.max < Infinity || demand.mean < Infinity;
    choice.textContent = asked
      ? `${found.length} codecs meet this. Take ${found[0].id}: the fewest bytes, and the cheapest at that size.`
      : `${found[0].id} is the finest of ${found.length} codecs. Name an error to find the smallest and cheapest that keeps to it.`;
  };
  form.addEventListener("input", update);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.hidden = false;
  update();
}

function startViewer(viewer) {
  const pictures = JSON.parse(viewer.querySelector("script").textContent);
  const [codec, material, slider] = ["codec", "material", "slider"].map((name) => viewer.querySelector(`.${name}`));
  const [coded, float] = ["coded", "float"].map((name) => viewer.querySelector(`img.${name}`));
  const update = () => {
    const picture = pictures[`${material.value}/${codec.value}`];
    coded.src = picture.uri;
    coded.alt = `${material.value} surfaces with normals as ${codec.value}`;
    float.src = pictures[`${material.value}/float`].uri;
    float.alt = `${material.value} surfaces with normals as floats`;
    viewer.querySelector(".right").textContent = codec.value;
    viewer.querySelector(".words").textContent = `Difference to floats: ${picture.words}.`;
  };
  const slide = () => { float.style.clipPath = `inset(0 ${100 - slider.value}% 0 0)`; };
  codec.addEventListener("change", update);
  material.addEventListener("change", update);
  slider.addEventListener("input", slide);
  viewer.hidden = false;
  update();
  slide();
}

// Paper shows what is folded away, too.
const folded = () => document.querySelectorAll("details:not([open])");
let opened = [];
addEventListener("beforeprint", () => { opened = [...folded()]; opened.forEach((one) => { one.open = true; }); });
addEventListener("afterprint", () => { opened.forEach((one) => { one.open = false; }); });

startTable();
document.querySelectorAll(".viewer").forEach(startViewer);
