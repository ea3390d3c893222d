// SPDX-License-Identifier: MIT
// What a page says of why no plan is cheaper, and of who goes first.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { Laboratory, until } from "./browser.js";

/** @type {Laboratory} */
let laboratory;
/** @type {any} */
let result;
let page_of_solve = "";
let page_of_result = "";
let discs = "";
let plain = "";

before(async () => {
  laboratory = await Laboratory.open();
  const maps = `${process.env.QUADRILLE_SOURCE_DIR}/examples/maps`;
  const input = ["--map", `${maps}/meeting.map`, "--scen", `${maps}/meeting.scen`, "--agents", "6"];
  const at = (/** @type {string} */ name) => `${laboratory.folder}/${name}`;
  page_of_solve = at("solve.html");
  page_of_result = at("result.html");
  discs = at("discs.html");
  plain = at("plain.html");
  laboratory.run("solve", ...input, "--explain", "--quiet", "--json", at("r.json"), "--view", page_of_solve);
  result = JSON.parse(readFileSync(at("r.json"), "utf8"));
  laboratory.run("view", ...input, "--output", page_of_result, at("r.json"));
  laboratory.run("solve", ...input, "--quiet", "--view", plain);
  laboratory.run("explain", "--instance", `${maps}/siding.json`, "--view", discs);
});
after(() => laboratory.close());

test("the bar and the list: free costs and raises make the bound", async () => {
  for (const file of [page_of_solve, page_of_result]) {
    const visit = await laboratory.visit(file);
    const { page } = visit;
    const { free_bound: free, lower_bound: bound, raises } = result.attribution;
    assert.equal(await visit.text("bound-text"),
      `Bound ${bound} = ${free} that the agents cost alone + ${bound - free}`);
    const parts = await page.evaluate(
      "[...document.querySelectorAll('#bound-bar span')].map((part) => Number(part.style.flexGrow))");
    assert.deepEqual(parts, [free, ...raises.map((/** @type {any} */ raise) => raise.amount)]);
    assert.equal(await page.locator("#raise-list button").count(), raises.length);
    await visit.leave();
  }
});

test("without a plan: the sentence, the agents, and the place in red", async () => {
  const at = (/** @type {string} */ name) => `${laboratory.folder}/${name}`;
  writeFileSync(at("corridor.map"), "type octile\nheight 1\nwidth 9\nmap\n.........\n");
  const entry = (/** @type {number} */ from, /** @type {number} */ to) =>
    `0\tm\t9\t1\t${from}\t0\t${to}\t0\t0\n`;
  writeFileSync(at("corridor.scen"), `version 1\n${entry(1, 6)}${entry(5, 2)}${entry(8, 8)}`);
  const input = ["--map", at("corridor.map"), "--scen", at("corridor.scen"), "--agents", "3"];
  const outputs = ["--quiet", "--json", at("no.json"), "--view", at("no.html")];
  assert.throws(() => laboratory.run("solve", ...input, ...outputs), { status: 20 });
  const { explanation, status } = JSON.parse(readFileSync(at("no.json"), "utf8"));
  assert.equal(status, "infeasible");
  const visit = await laboratory.visit(at("no.html"));
  const { page } = visit;
  assert.equal(await visit.text("obstruction-text"), `${explanation}.`);
  assert.match(await visit.text("summary"), /no plan exists · infeasible$/);
  assert.ok(await page.locator("#violations").isHidden());
  assert.deepEqual(await page.locator("#obstruction-list button").allTextContents(),
    ["agent 0: (1, 0) to (6, 0)", "agent 1: (5, 0) to (2, 0)"]);
  await visit.settled();
  const [x, y] = await page.evaluate("quadrille.pixelOf(4, 0)");
  const [r, g] = (await pixel(page, "map", x, y + 8)).split(" ").map(Number);
  assert.ok(r > g + 40, `${r} ${g}`);
  await page.locator("#obstruction-list button").nth(1).click();
  assert.equal(await page.evaluate("quadrille.selected()"), 1);
  await visit.leave();
});

test("without a plan on a roadmap: the vertices that both have to pass, and roads between them", async () => {
  const at = (/** @type {string} */ name) => `${laboratory.folder}/${name}`;
  // A corridor of two roads, and a dead end that is not deep enough for one of them to step aside.
  const roadmap = {
    vertices: [[0, 0], [2, 0], [4, 0], [2, 0.5], [4, 2]],
    edges: [[0, 1], [1, 2], [1, 3], [2, 4]].flatMap(([v, w]) => [[v, w], [w, v]]),
  };
  const agents = [
    { start: 0, goal: 2, radius: 0.3 }, { start: 2, goal: 0, radius: 0.3 }, { start: 4, goal: 4, radius: 0.3 },
  ];
  writeFileSync(at("dead_end.json"),
    JSON.stringify({ quadrille: "instance", version: 1, resolution: 0.01, roadmap, agents }));
  const outputs = ["--quiet", "--json", at("no.json"), "--view", at("no.html")];
  assert.throws(() => laboratory.run("solve", "--instance", at("dead_end.json"), ...outputs), { status: 20 });
  const { explanation } = JSON.parse(readFileSync(at("no.json"), "utf8"));
  assert.match(explanation, /^agents 0 and 1 .* vertices 0, 1 and 2, in opposite directions$/);
  const visit = await laboratory.visit(at("no.html"));
  const { page } = visit;
  assert.equal(await visit.text("obstruction-text"), `${explanation}.`);
  assert.equal(await page.locator("#obstruction-list button").count(), 2);
  await visit.settled();
  const isRed = async (/** @type {number} */ x, /** @type {number} */ y) => {
    const [px, py] = await page.evaluate(`quadrille.pixelOf(${x}, ${y})`);
    const [r, g] = (await pixel(page, "map", px, py + 5)).split(" ").map(Number);
    return r > g + 40;
  };
  // Beside the agents, which stand on the first vertex and the last.
  for (const x of [0.5, 1.3, 2, 2.7, 3.5]) assert.ok(await isRed(x, 0), `${x}`);
  for (const [x, y] of [[2, 0.5], [4, 1], [4, 2]]) assert.ok(!(await isRed(x, y)), `${x} ${y}`);
  await visit.leave();
});

test("a page without an attribution shows nothing of it", async () => {
  const visit = await laboratory.visit(plain);
  const { page } = visit;
  assert.ok(await page.locator("#reasons").isHidden());
  assert.ok(await page.locator("#heat").isHidden());
  await page.keyboard.press("h");
  assert.equal(await page.locator("#heat").getAttribute("aria-pressed"), "false");
  await visit.leave();
});

test("the matrix is red where two agents raise the bound together, and nowhere else", async () => {
  const visit = await laboratory.visit(page_of_result);
  const shown = await visit.page.evaluate("quadrille.matrix()");
  const together = (/** @type {number} */ a, /** @type {number} */ b) => result.attribution.raises
    .filter((/** @type {any} */ raise) => raise.agents.includes(a) && raise.agents.includes(b))
    .reduce((/** @type {number} */ sum, /** @type {any} */ raise) => sum + raise.amount, 0);
  assert.ok(shown.agents.length >= 2);
  for (const [row, a] of shown.agents.entries())
    {for (const [column, b] of shown.agents.entries()) {
      const amount = a === b ? 0 : together(a, b);
      assert.equal(shown.amounts[row][column], amount, `agents ${a} and ${b}`);
      const [x, y] = [20 + (column + 0.4) * shown.size, 20 + (row + 0.4) * shown.size];
      const colour = await pixel(visit.page, "matrix", x, y);
      assert.equal(colour === "255 255 255", amount === 0, `agents ${a} and ${b}: ${colour}`);
    }}
  await visit.leave();
});

test("heat: the map is coloured at the places of the sites, on demand", async () => {
  const visit = await laboratory.visit(page_of_result);
  const { page } = visit;
  await page.evaluate("quadrille.seek(quadrille.end)");  // agents are at their goals
  await visit.settled();
  const vertices = result.attribution.sites.map((/** @type {any} */ site) => site.place.from);
  const taken = result.plan.map((/** @type {any} */ path) => String(path[path.length - 1]));
  const free = vertices.find((/** @type {any} */ place) => !taken.includes(String(place)));
  assert.ok(free);
  const [x, y] = await page.evaluate(`quadrille.pixelOf(${free[0]}, ${free[1]})`);
  const cold = await pixel(page, "map", x + 3, y + 3);
  await page.keyboard.press("h");
  await until(page, "document.getElementById('heat').getAttribute('aria-pressed') === 'true'");
  await page.evaluate("quadrille.seek(quadrille.end)");
  const hot = await pixel(page, "map", x + 3, y + 3);
  assert.notEqual(hot, cold);
  const [red, , blue] = hot.split(" ").map(Number);
  assert.ok(red > blue + 40, `${hot} is not warm`);
  await page.locator("#heat").click();
  await until(page, "document.getElementById('heat').getAttribute('aria-pressed') === 'false'");
  await page.evaluate("quadrille.seek(quadrille.end)");
  assert.equal(await pixel(page, "map", x + 3, y + 3), cold);
  await visit.leave();
});

test("an entry of the list leads to when its agents are in each other's way", async () => {
  const visit = await laboratory.visit(page_of_result);
  const { page } = visit;
  const raises = [...result.attribution.raises].sort((a, b) => b.amount - a.amount);
  await page.locator("#raise-list button").first().click();
  assert.equal(await visit.selected(), raises[0].agents[0]);
  const inside = result.attribution.sites.filter((/** @type {any} */ site) =>
    site.agents.every((/** @type {number} */ agent) => raises[0].agents.includes(agent)));
  const most = Math.max(...inside.map((/** @type {any} */ site) => site.lemmas));
  const times = inside.filter((/** @type {any} */ site) => site.lemmas === most)
    .map((/** @type {any} */ site) => site.begin);
  assert.ok(inside.length === 0 || times.includes(await visit.time()));
  await visit.leave();
});

test("order: who goes before the selected agent, as verify's replay has it", async () => {
  const visit = await laboratory.visit(plain);
  const { page } = visit;
  for (let agent = 0; agent < 6; ++agent) {
    await page.keyboard.press(".");
    await until(page, `quadrille.selected() === ${agent}`);
    await page.evaluate("quadrille.seek(0)");
    const facts = (await page.locator("#agent-facts").innerText()).replace(/\s+/g, " ");
    const listed = facts.match(/ after agents? ([\d, ]+) /)?.[1].split(", ").map(Number) ?? [];
    assert.deepEqual(listed.sort(), leadersOf(result.plan, agent), `agent ${agent}: ${facts}`);
  }
  await page.keyboard.press("o");
  await until(page, "document.getElementById('order').getAttribute('aria-pressed') === 'true'");
  await visit.leave();
});

test("continuous time: the bound in the unit of the input, and heat on the roadmap", async () => {
  const visit = await laboratory.visit(discs);
  const { page } = visit;
  assert.match(await visit.text("bound-text"), /^Bound 5\.015 = [\d.]+ that the agents cost alone \+ [\d.]+$/);
  await page.keyboard.press("h");
  await until(page, "document.getElementById('heat').getAttribute('aria-pressed') === 'true'");
  await visit.leave();
});

/**
 * The colour of a pixel of a canvas.
 * @param {import("playwright-core").Page} page
 * @param {string} id
 * @param {number} x
 * @param {number} y
 * @returns {Promise<string>}
 */
function pixel(page, id, x, y) {
  return page.evaluate(`(() => {
    const copy = document.createElement("canvas");
    copy.width = copy.height = 1;
    const context = copy.getContext("2d", { willReadFrequently: true });
    context.drawImage(document.getElementById("${id}"), Math.round(${x}), Math.round(${y}), 1, 1, 0, 0, 1, 1);
    return [...context.getImageData(0, 0, 1, 1).data].slice(0, 3).join(" ");
  })()`);
}

/**
 * Those who leave a vertex last before the agent comes to it.
 * @param {[number, number][][]} plan
 * @param {number} agent
 * @returns {number[]}
 */
function leadersOf(plan, agent) {
  const leaders = new Set();
  const at = (/** @type {number} */ i, /** @type {number} */ t) =>
    String(plan[i][Math.min(t, plan[i].length - 1)]);
  for (let t = 1; t < plan[agent].length; ++t) {
    if (at(agent, t) === at(agent, t - 1)) continue;
    for (let earlier = t - 1, found = false; earlier >= 0 && !found; --earlier) {
      for (let i = 0; i < plan.length && !found; ++i) {
        if (at(i, earlier) !== at(agent, t)) continue;
        found = true;
        if (i !== agent) leaders.add(i);
      }
    }
  }
  return [...leaders].sort();
}
