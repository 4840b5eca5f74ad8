// The error over the sphere, as discs of both hemispheres.

const STOPS = [[15, 13, 56], [135, 28, 107], [242, 107, 46], [252, 237, 153]];

// As `heat` of the shaders, for t of 0 to 1.
const heat = (t) => {
  const at = Math.min(Math.max(t, 0), 1) * 3;
  const k = Math.min(Math.floor(at), 2);
  return STOPS[k].map((c, i) => c + (STOPS[k + 1][i] - c) * (at - k));
};

export const GRADIENT = `linear-gradient(90deg, ${STOPS.map((c) => `rgb(${c})`).join(", ")})`;

// Places within a pixel; their mean error is its colour, so that lattices finer than pixels leave no false patterns.
const WITHIN = [[0.125, 0.625], [0.375, 0.125], [0.625, 0.875], [0.875, 0.375]];

// Draws the errors as `errorOf` gives them in degrees for many directions, x to the right and y up; z >= 0 on the left.
export async function drawSphere(canvas, errorOf, most, isHemisphere) {
  const radius = canvas.height / 2 - 1;
  const middles = isHemisphere ? [canvas.width / 2] : [radius + 2, canvas.width - radius - 2];
  const [places, directions] = [[], []];
  middles.forEach((middle, side) => {
    for (let row = 0; row < canvas.height; row++) {
      for (let column = Math.floor(middle - radius); column < middle + radius; column++) {
        const there = WITHIN.map(([dx, dy]) => [(column + dx - middle) / radius, (canvas.height / 2 - row - dy) / radius]);
        const inside = there.filter(([x, y]) => x * x + y * y < 1);
        if (!inside.length) continue;
        places.push([row * canvas.width + column, inside.length]);
        for (const [x, y] of inside) directions.push(x, y, (side ? -1 : 1) * Math.sqrt(1 - x * x - y * y));
      }
    }
  });
  const errors = await errorOf(new Float32Array(directions));
  const context = canvas.getContext("2d");
  const picture = context.createImageData(canvas.width, canvas.height);
  let at = 0;
  for (const [place, count] of places) {
    const mean = errors.subarray(at, (at += count)).reduce((sum, angle) => sum + angle, 0) / count;
    picture.data.set([...heat(mean / most), (255 * count) / WITHIN.length], 4 * place);
  }
  context.putImageData(picture, 0, 0);
}
