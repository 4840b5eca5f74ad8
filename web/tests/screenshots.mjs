// The pictures of docs/web.md: node screenshots.mjs FOLDER.

import { mkdir } from "node:fs/promises";
import { launch, open, picture } from "./browser.js";

const SHOTS = {
  desktop: [{ width: 1280, height: 800 }, "light", { codec: "oct16p" }],
  dark: [{ width: 1280, height: 800 }, "dark", { codec: "hemioct16", yaw: "-0.7" }],
  phone: [{ width: 360, height: 740 }, "light", { codec: "oct12p", show: "error" }],
};

const [folder] = process.argv.slice(2);
await mkdir(folder, { recursive: true });
const browser = await launch();
for (const [name, [size, value, state]] of Object.entries(SHOTS)) {
  const page = await open(browser, state, { ...size, features: [{ name: "prefers-color-scheme", value }] });
  await picture(page);
  await page.screenshot({ path: `${folder}/${name}.webp`, type: "webp", quality: 82 });
}
await browser.close();
