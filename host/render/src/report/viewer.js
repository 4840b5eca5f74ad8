"use strict";

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

document.querySelectorAll(".viewer").forEach(startViewer);
