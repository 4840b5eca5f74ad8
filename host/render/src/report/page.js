// The same logic as `unitvec choose`: what meets the demand, fewest bytes first, then the cheapest, then the least mean. Where no error
// is named, any code would do: then the least bound comes first. Misses are near, and would be better than the first.
const NEAR = 1.25;

function candidates(codecs, demand) {
  const cost = ({ costs }) =>
    demand.weights.reduce((sum, weight, at) => sum + (weight === 0 ? 0 : weight * (costs[demand.gpu][at] ?? Infinity)), 0);
  const mean = (codec) => (demand.hemisphere ? codec.mean_above : codec.mean);
  const suits = (codec) =>
    codec.frame === demand.frame &&
    (codec.unit || demand.raw) &&
    (!codec.hemisphere || demand.hemisphere) &&
    !(codec.by_table && demand.noTable) &&
    (demand.format === "" || (demand.format === "*" ? codec.format !== null : codec.format === demand.format));
  const times = (codec) =>
    Math.max(codec.bits / demand.bits, codec.bound / demand.bound, mean(codec) / demand.mean, cost(codec) / demand.cost || 0);
  const first = demand.bound < Infinity ? (a, b) => a.bytes - b.bytes : (a, b) => a.bound - b.bound;
  const order = (a, b) => first(a, b) || (cost(a) === cost(b) ? 0 : cost(a) - cost(b)) || mean(a) - mean(b);
  const all = codecs.filter(suits);
  const found = all.filter((codec) => times(codec) <= 1).sort(order);
  const isNear = (codec) => found.length === 0 || (times(codec) <= NEAR && order(codec, found[0]) < 0);
  const misses = all.filter((codec) => times(codec) > 1 && isNear(codec)).sort((a, b) => times(a) - times(b) || order(a, b)).slice(0, 3);
  return { found, misses: misses.map((codec) => `${codec.id} (${Number(times(codec).toPrecision(3))} times what is asked)`) };
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
      frame: fields.element.value === "frame",
      bits: Number(fields.bits.value),
      bound: limit(fields.max),
      mean: limit(fields.mean),
      cost: limit(fields.cost),
      weights: [fields.encode, fields.decode].map((field) => Math.max(0, Number(field.value))),
      format: fields.format.value,
      gpu: Number(fields.gpu.value),
      hemisphere: fields.hemisphere.checked,
      noTable: fields.no_table.checked,
      raw: fields.raw.checked,
    };
    const { found, misses } = candidates(codecs, demand);
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
    const near = (words) => (misses.length === 0 ? "" : ` ${words}: ${misses.join(", ")}.`);
    if (found.length === 0) {
      choice.textContent = `No codec meets this.${near("Nearest")}`;
      return;
    }
    document.getElementById(`codec-${found[0].id}`).classList.add("best");
    choice.textContent = demand.bound < Infinity
      ? `${found.length} codecs meet this. Take ${found[0].id}: the fewest bytes, and the cheapest at that size.${near("Near misses")}`
      : `${found[0].id} has the least bound of ${found.length} codecs. Name a bound to find the smallest and cheapest that keeps to it.${near("Near misses")}`;
  };
  form.addEventListener("input", update);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.hidden = false;
  update();
}

startTable();
