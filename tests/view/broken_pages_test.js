// SPDX-License-Identifier: MIT
// A page whose file is damaged says what is wrong, instead of showing nothing or half of a plan.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { Laboratory } from "./browser.js";

/** @type {Laboratory} */
let laboratory;
let whole = "";

before(async () => {
  laboratory = await Laboratory.open();
  laboratory.write("m.map", "type octile\nheight 2\nwidth 3\nmap\n...\n...\n");
  laboratory.write("m.scen", "version 1\n0\tm.map\t3\t2\t0\t0\t2\t1\t3\n");
  laboratory.run("solve", "--map", "m.map", "--scen", "m.scen", "--agents", "1", "--quiet", "--view",
    "whole.html");
  whole = readFileSync(`${laboratory.folder}/whole.html`, "utf8");
});
after(() => laboratory.close());

/**
 * @param {string} html
 * @param {RegExp} message
 */
async function expectProblem(html, message) {
  assert.notEqual(html, whole, "the page is damaged");
  const visit = await laboratory.visit(laboratory.write("broken.html", html));
  const problem = visit.page.locator("#problem");
  assert.ok(await problem.isVisible());
  assert.match(await problem.innerText(), message);
  await visit.leave();
}

test("a whole page shows no problem", async () => {
  const visit = await laboratory.visit(`${laboratory.folder}/whole.html`);
  assert.ok(await visit.page.locator("#problem").isHidden());
  assert.equal(await visit.page.evaluate("quadrille.agents"), 1);
  await visit.leave();
});

const data = () => whole.indexOf('{"quadrille"');

test("cut off in the data", () =>
  expectProblem(whole.slice(0, data() + 90), /damaged, or the file is cut off/));
test("cut off before the data", () =>
  expectProblem(whole.slice(0, data()), /no data: the file may be cut off/));
test("cut off in the script", () => expectProblem(whole.slice(0, data() - 3000), /not complete/));
test("data of something else", () =>
  expectProblem(whole.replace('{"quadrille":"scene"', '{"quadrille":"result"'), /not those of a plan/));
test("data of another version", () =>
  expectProblem(whole.replace('"version":1', '"version":7'), /of version 7, and it reads version 1/));
test("cells are missing", () =>
  expectProblem(whole.replace('"runs":"6."', '"runs":"5."'), /has 6 cells, and the data of this page say 5/));
