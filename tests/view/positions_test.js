// SPDX-License-Identifier: MIT
// Pages of random plans: where agents are, and how near they come, as the page has it and as the
// program that made the pages has it from the plan and from verify.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { Laboratory } from "./browser.js";

const CASES = Math.max(1, Math.round(12 * Number(process.env.QUADRILLE_TEST_SCALE ?? 1)));
/** @type {Laboratory} */
let laboratory;
let pages = "";
before(async () => {
  laboratory = await Laboratory.open();
  pages = laboratory.folder;
  const program = process.env.QUADRILLE_VIEW_PAGES;
  assert.ok(program, "QUADRILLE_VIEW_PAGES names the program that makes pages");
  execFileSync(program, [pages, String(CASES)]);
});
after(() => laboratory.close());

/**
 * @param {number} actual
 * @param {number} expected
 * @param {string} what
 */
function near(actual, expected, what) {
  if (actual === expected) return;  // Both may be infinite.
  const slack = 1e-9 * Math.max(1, Math.abs(expected));
  assert.ok(Math.abs(actual - expected) <= slack, `${what}: ${actual}, but it is ${expected}`);
}

/** @param {string} name */
async function compare(name) {
  const expected = JSON.parse(readFileSync(join(pages, `${name}.json`), "utf8"));
  const visit = await laboratory.visit(join(pages, `${name}.html`));
  const { page } = visit;
  assert.equal(await page.title(), expected.title);
  assert.equal(await page.evaluate("quadrille.agents"), expected.agents);
  const found = await page.evaluate(`(${askPage})(${JSON.stringify(expected)})`);
  expected.positions.forEach(([agent, time, ...place], k) => {
    assert.equal(found.positions[k].length, place.length);
    place.forEach((value, axis) =>
      near(found.positions[k][axis], value, `${"xyz"[axis]} of agent ${agent} at ${time}`));
  });
  const facts = await page.locator("#summary").textContent();
  assert.equal(/seen from above/.test(facts), expected.heights ?? false);
  expected.clearances.forEach(([a, b, gap, time], k) => {
    near(found.clearances[k], gap, `clearance of ${a} and ${b} at ${time}`);
    // It is the least one over all time.
    for (const elsewhere of found.elsewhere[k]) assert.ok(elsewhere >= gap - 1e-9, `${a} and ${b}`);
  });
  if (expected.clearances.length > 0) {
    const least = expected.clearances.reduce((p, q) => (q[2] < p[2] ? q : p));
    // verify leaves out agents with broken paths, which the page draws.
    if (found.complete) near(found.least.gap, least[2], "the least clearance of all");
    near(Number((await page.locator("#nearest-list button").first().textContent()).split(" ")[0]),
      Number(least[2].toFixed(4)), "the first one in the list");
  }
  for (const [k, time, ...place] of expected.obstacles ?? []) {
    const at = await page.evaluate(`quadrille.obstacle(${k}, ${time})`);
    if (place[0] === null) assert.equal(at, null, `obstacle ${k} at ${time}`);
    else assert.deepEqual(at, place, `obstacle ${k} at ${time}`);
  }
  for (const [agent, arrival, later, stays] of expected.present ?? []) {
    assert.ok(await page.evaluate(`quadrille.isPresent(${agent}, ${arrival})`), `agent ${agent}`);
    assert.equal(await page.evaluate(`quadrille.isPresent(${agent}, ${later})`), stays, `agent ${agent}`);
  }
  for (const [least, gaps] of found.moments) near(least, Math.min(...gaps), "at a moment");
  assert.deepEqual(found.violations.sort(), expected.violations.sort());
  await visit.leave();
}

/** Runs in the page. */
const askPage = `(expected) => {
  const { quadrille } = window;
  const times = Array.from({ length: 30 }, (_, k) => (k / 29) * (quadrille.end + 1));
  const pairs = expected.clearances.map(([a, b]) => [a, b]);
  const least = expected.clearances.length === 0 ? [0, 0, 0, 0]
    : expected.clearances.reduce((p, q) => (q[2] < p[2] ? q : p));
  const complete = pairs.length === expected.agents * (expected.agents - 1) / 2 && pairs.length > 0;
  return {
    positions: expected.positions.map(([agent, time]) => quadrille.position(agent, time)),
    clearances: expected.clearances.map(([a, b, , time]) => quadrille.clearance(a, b, time)),
    elsewhere: pairs.map(([a, b]) => times.map((time) => quadrille.clearance(a, b, time))),
    complete,
    least: quadrille.leastClearance(least[3]),
    moments: complete ? times.map((time) => [quadrille.leastClearance(time)?.gap ?? Infinity,
      pairs.map(([a, b]) => quadrille.clearance(a, b, time))]) : [],
    violations: [...document.querySelectorAll("#violation-list button")]
      .map((button) => button.textContent.replace(/^[^:]*: /, "")),
  };
}`;

for (let seed = 1; seed <= CASES; ++seed)
  for (const kind of ["grid", "roadmap", "space"]) test(`${kind}-${seed}`, () => compare(`${kind}-${seed}`));
