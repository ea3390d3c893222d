// SPDX-License-Identifier: MIT
// The report of a campaign with many systems and long names, and the lists of a plan that breaks
// many rules: nothing is wider than the page, nothing is cut off, nothing is left out.

import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Laboratory } from "./browser.js";

/** @type {Laboratory} */
let laboratory;
const WIDTH = 1100;
const LONG = "lazy-clause-generation-with-everything-that-there-is-and-a-name-without-a-blank";
const MAP = "warehouse-20-40-10-2-2-and-more-words-in-the-name-of-a-map";

before(async () => {
  laboratory = await Laboratory.open();
});
after(() => laboratory.close());

/** Texts of figures that are not inside them, and the width of the page. Runs in the page. */
const look = `({
  width: document.documentElement.scrollWidth,
  tables: [...document.querySelectorAll("table")].map((table) => table.getBoundingClientRect().right),
  outside: [...document.querySelectorAll("svg text")].filter((text) => {
    const own = text.getBoundingClientRect();
    const all = text.ownerSVGElement.getBoundingClientRect();
    return own.left < all.left - 1 || own.right > all.right + 1 || own.bottom > all.bottom + 1;
  }).map((text) => text.textContent),
})`;

test("a report with twelve systems fits a page of 1,100 pixels", async () => {
  const source = process.env.QUADRILLE_SOURCE_DIR ?? "";
  const fake = join(source, "tests", "cli", "campaign", "fake_solver.py");
  laboratory.write(`${MAP}.map`, "type octile\nheight 1\nwidth 3\nmap\n...\n");
  const row = `0\t${MAP}.map\t3\t1\t0\t0\t1\t0\t1\n`;
  laboratory.write(`${MAP}-random-1.scen`, `version 1\n${row}`);
  laboratory.write("reference.csv", `map,scenario,agents,${LONG}-of-others_cpu_s\n${MAP},random-1,1,0.5\n`);
  const systems = {};
  for (let i = 0; i < 12; ++i)
    {systems[`${i === 7 ? "W".repeat(90) : LONG}, setting ${i}`] =
      { program: fake, options: ["--fake", "table:1:1", "--number", String(i)] };}
  laboratory.write("m.yaml", JSON.stringify({
    title: LONG.repeat(3), reference: "reference.csv", limits: { cpu: 20 }, systems,
    instances: [{ maps: `${MAP}.map`, scenarios: "{map}-*.scen", agents: 1 }],
  }));
  laboratory.run("campaign", "run", "m.yaml", "--quiet");
  laboratory.run("campaign", "merge", "m.yaml", "--quiet");
  const report = join(laboratory.folder, "m.campaign", "merged", "report.html");
  const visit = await laboratory.visit(report, { viewport: { width: WIDTH, height: 900 } });
  const found = await visit.page.evaluate(look);
  assert.ok(found.width <= WIDTH, `${found.width} pixels`);
  for (const right of found.tables) assert.ok(right <= WIDTH, `a table ends at ${right}`);
  assert.deepEqual(found.outside, []);
  await visit.leave();
});

/**
 * Two discs that pass through each other again and again; a tick is a quarter of a unit of time.
 * @param {number} times
 */
function crossing(times) {
  const stops = (/** @type {number} */ from) => Array.from({ length: times + 1 }, (_, k) => ({
    vertex: (from + k) % 2, arrive_ticks: k * 16, ...(k < times ? { depart_ticks: k * 16 } : {}),
  }));
  return { quadrille: "plan", version: 1, resolution: 0.25, plan: [stops(0), stops(1)] };
}

test("all violations of a plan are listed, with times of the input", async () => {
  const times = 701;
  laboratory.write("discs.json", JSON.stringify({
    quadrille: "instance", version: 1, resolution: 0.25,
    roadmap: { vertices: [[0, 0], [4, 0]], edges: [[0, 1], [1, 0]] },
    agents: [{ start: 0, goal: 1, radius: 0.5 }, { start: 1, goal: 0, radius: 0.5 }],
  }));
  laboratory.write("plan.json", JSON.stringify(crossing(times)));
  let verdict = "";
  try {
    laboratory.run("verify", "--instance", "discs.json", "--quiet", "--json", "-", "plan.json");
  } catch (error) {
    verdict = error.stdout;
  }
  assert.equal(JSON.parse(verdict).violations.length, times);
  laboratory.run("view", "--instance", "discs.json", "--output", "bad.html", "plan.json");
  const visit = await laboratory.visit(join(laboratory.folder, "bad.html"));
  const { page } = visit;
  assert.equal(await visit.text("violations-title"), `Violations (${times})`);
  const buttons = page.locator("#violation-list button");
  for (const shown of [300, 600]) {
    assert.equal(await buttons.count(), shown + 1);
    assert.equal(await buttons.last().textContent(), `${times - shown} more`);
    await buttons.last().click();
  }
  assert.equal(await buttons.count(), times);
  assert.match(await buttons.nth(1).textContent(),
    /^6 {2}collision: agents 0 and 1 collide between times 5.5 and 6.5: nearest at about 6, /);
  assert.doesNotMatch(await page.locator("#violation-list").innerText(), /tick|length unit/);
  await buttons.last().click();
  assert.equal(await visit.time(), times * 4 - 2);
  await visit.leave();
});
