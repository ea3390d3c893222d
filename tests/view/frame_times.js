// SPDX-License-Identifier: MIT
// frame_times.js <page.html>: how long a frame of a page takes, drawn into memory by the processor
// alone. Not a test: what it says depends on the machine.

import { statSync } from "node:fs";
import { resolve } from "node:path";
import { Laboratory } from "./browser.js";

const FRAMES = 200;
const laboratory = await Laboratory.open();
const file = resolve(process.argv[2]);
const visit = await laboratory.visit(file, { viewport: { width: 1280, height: 800 } });
const times = await visit.page.evaluate(`(() => {
  const canvas = document.getElementById("map");
  const times = [];
  for (let k = 0; k <= ${FRAMES}; ++k) {
    const begin = performance.now();
    quadrille.seek((k / ${FRAMES}) * quadrille.end);
    canvas.getContext("2d").getImageData(0, 0, 1, 1);  // waits until it is drawn
    times.push(performance.now() - begin);
  }
  return times.slice(1).sort((a, b) => a - b);
})()`);
const at = (/** @type {number} */ share) => times[Math.floor(share * (times.length - 1))].toFixed(1);
process.stdout.write(`${(statSync(file).size / 1e6).toFixed(2)} MB, ${FRAMES} frames: ` +
  `10 % within ${at(0.1)} ms, median ${at(0.5)} ms, 90 % within ${at(0.9)} ms\n`);
await laboratory.close();
