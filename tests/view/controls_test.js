// SPDX-License-Identifier: MIT
// What people do with a page: buttons, keys, pointer and touch, links, search, jumps.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Laboratory, until } from "./browser.js";

/** @import {Visit} from "./browser.js" */

/** @type {Laboratory} */
let laboratory;
let good = "";
let bad = "";
let discs = "";

const MAP = "type octile\nheight 3\nwidth 6\nmap\n......\n.@@@@.\n......\n";
const SCEN = "version 1\n" +
  "0\tm.map\t6\t3\t0\t0\t5\t0\t5\n" +
  "0\tm.map\t6\t3\t5\t2\t0\t2\t5\n" +
  "0\tm.map\t6\t3\t0\t2\t0\t1\t1\n";

before(async () => {
  laboratory = await Laboratory.open();
  const map = laboratory.write("m.map", MAP);
  const scen = laboratory.write("m.scen", SCEN);
  const input = ["--map", map, "--scen", scen, "--agents", "3"];
  good = `${laboratory.folder}/good.html`;
  laboratory.run("solve", ...input, "--quiet", "--view", good);
  // The second one waits for two timesteps; the first and the third one meet in (0, 1).
  const plan = laboratory.write("bad.txt",
    "Agent 0: (0,0)->(1,0)->(0,0)->(0,1)->(0,2)->(0,3)->(0,4)->(0,5)->\n" +
    "Agent 1: (2,5)->(2,5)->(2,5)->(2,4)->(2,3)->(2,2)->(2,1)->(2,0)->\n" +
    "Agent 2: (2,0)->(1,0)->\n");
  bad = `${laboratory.folder}/bad.html`;
  laboratory.run("view", ...input, "--output", bad, plan);
  discs = `${laboratory.folder}/discs.html`;
  laboratory.run("solve", "--instance", `${process.env.QUADRILLE_SOURCE_DIR}/examples/maps/siding.json`,
    "--quiet", "--view", discs);
});
after(() => laboratory.close());

test("a valid plan: costs, bound, no violations", async () => {
  const visit = await laboratory.visit(good);
  assert.match(await visit.text("summary"), /^3 agents · sum of costs 11 · makespan 5 · optimal$/);
  assert.ok(await visit.page.locator("#violations").isHidden());
  await visit.leave();
});

test("keys: steps, ends, speed, selection, theme, help", async () => {
  const visit = await laboratory.visit(good);
  const { page } = visit;
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  assert.equal(await visit.time(), 2);
  await page.keyboard.press("ArrowLeft");
  assert.equal(await visit.time(), 1);
  await page.keyboard.press("End");
  assert.equal(await visit.time(), 5);
  await page.keyboard.press("Home");
  assert.equal(await visit.time(), 0);
  for (let k = 0; k < 9; ++k) await page.keyboard.press("]");
  await visit.settled();
  assert.equal(await page.locator("#speed").inputValue(), "50");
  for (let k = 0; k < 12; ++k) await page.keyboard.press("[");
  await visit.settled();
  assert.equal(await page.locator("#speed").inputValue(), "0.1");
  await page.keyboard.press(".");
  await page.keyboard.press(".");
  assert.equal(await visit.selected(), 1);
  await page.keyboard.press("Escape");
  assert.equal(await visit.selected(), null);
  await page.keyboard.press("t");
  assert.ok(await page.evaluate("document.documentElement.classList.contains('dark')"));
  await page.keyboard.press("?");
  assert.ok(await page.locator("#help").isVisible());
  await page.keyboard.press("Escape");
  assert.ok(await page.locator("#help").isHidden());
  await visit.leave();
});

test("playing comes to the end and stops", async () => {
  const visit = await laboratory.visit(good);
  const { page } = visit;
  await page.locator("#speed").selectOption("50");
  await page.locator("#play").click();
  await until(page, "quadrille.time() === 5");
  await until(page, "document.getElementById('play').getAttribute('aria-label') === 'Play'");
  await page.locator("#map").focus();
  await page.keyboard.press(" ");
  await until(page, "quadrille.time() > 0 && quadrille.time() < 6");
  await visit.leave();
});

test("a click on an agent shows its path, free cost and delay", async () => {
  const visit = await laboratory.visit(bad);
  const { page } = visit;
  await page.evaluate("quadrille.seek(2.5)");
  await clickAgent(visit, 1);
  assert.equal(await visit.selected(), 1);
  await until(page, "document.getElementById('agent-facts').innerText !== ''");
  const facts = await page.locator("#agent-facts").innerText();
  assert.match(facts.replace(/\s+/g, " "), /cost 7 free cost 5 delay 2 waits 2 now moves, \(4.5, 2\)/);
  await page.locator("#deselect").click();
  assert.equal(await visit.selected(), null);
  await visit.leave();
});

test("violations are listed, and n and a click go there", async () => {
  const visit = await laboratory.visit(bad);
  const { page } = visit;
  assert.equal(await visit.text("violations-title"), "Violations (1)");
  assert.match(await page.locator("#violation-list button").innerText(), /agents 0 and 2 .*\(0, 1\)/);
  await page.keyboard.press("n");
  assert.equal(await visit.time(), 1);
  await page.keyboard.press("End");
  await page.locator("#violation-list button").click();
  // A busy machine takes a moment.
  await until(page, "quadrille.time() === 1");
  assert.equal(await visit.selected(), 0);
  await visit.leave();
});

test("a link leads to a moment, and the page's address follows", async () => {
  const visit = await laboratory.visit(bad, { hash: "#t=3.25&a=2" });
  const { page } = visit;
  assert.equal(await visit.time(), 3.25);
  assert.equal(await visit.selected(), 2);
  await page.keyboard.press("ArrowRight");
  await until(page, "location.hash === '#t=4&a=2'");
  await page.evaluate("location.hash = '#t=1.5&a=1'");
  await until(page, "quadrille.time() === 1.5 && quadrille.selected() === 1");
  // Nonsense is ignored.
  await page.evaluate("location.hash = '#t=abc&a=99'");
  await until(page, "quadrille.selected() === null");
  assert.equal(await visit.time(), 1.5);
  await visit.leave();
});

test("search finds agents and places, and says what it does not find", async () => {
  const visit = await laboratory.visit(good);
  const { page } = visit;
  const ask = async (/** @type {string} */ text) => {
    await page.locator("#search").fill(text);
    await page.keyboard.press("Enter");
    return visit.text("search-answer");
  };
  assert.equal(await ask("2"), "agent 2");
  assert.equal(await visit.selected(), 2);
  assert.equal(await ask("(5, 0)"), "agent 0 ends there");
  assert.equal(await ask("7"), "'7' is none of the agents 0 to 2");
  assert.equal(await ask("3,0"), "no agent starts or ends there");
  await visit.leave();
});

test("zoom and pan; a zoom keeps what is under the pointer; follow keeps the agent in the middle", async () => {
  const visit = await laboratory.visit(good);
  const { page } = visit;
  const [x, y] = await onPage(visit, 1);
  await page.mouse.move(x, y);
  await page.mouse.wheel(0, -400);
  await page.evaluate("quadrille.seek(0)");
  const zoomed = await onPage(visit, 1);
  assert.ok(Math.hypot(zoomed[0] - x, zoomed[1] - y) < 1, `${zoomed} is not ${[x, y]}`);
  await page.mouse.down();
  await page.mouse.move(x - 30, y - 20, { steps: 3 });
  await page.mouse.up();
  const panned = await onPage(visit, 1);
  assert.ok(Math.hypot(panned[0] - (x - 30), panned[1] - (y - 20)) < 6);
  assert.equal(await visit.selected(), null);
  await page.keyboard.press(".");
  await page.keyboard.press("f");
  await page.evaluate("quadrille.seek(2.5)");
  await visit.settled();
  const middle = await page.evaluate(
    "[document.getElementById('map').clientWidth / 2, document.getElementById('map').clientHeight / 2]");
  const [px, py] = await page.evaluate("quadrille.pixel(0)");
  assert.ok(Math.hypot(px - middle[0], py - middle[1]) < 1);
  await visit.leave();
});

test("touch: a tap selects, two fingers zoom", async () => {
  const visit = await laboratory.visit(good, { touch: true, viewport: { width: 420, height: 800 } });
  const { page } = visit;
  const [x, y] = await onPage(visit, 2);
  await page.touchscreen.tap(x, y);
  assert.equal(await visit.selected(), 2);
  const session = await visit.context.newCDPSession(page);
  const apart = async () => {
    const [a, b] = [await onPage(visit, 0), await onPage(visit, 2)];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };
  const earlier = await apart();
  const fingers = (/** @type {number} */ d) => [{ x: 200 - d, y: 200, id: 1 }, { x: 200 + d, y: 200, id: 2 }];
  await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: fingers(40) });
  for (const d of [50, 65, 80])
    await session.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: fingers(d) });
  await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await page.evaluate("quadrille.seek(0)");
  const ratio = (await apart()) / earlier;
  assert.ok(Math.abs(ratio - 2) < 0.1, `zoomed by ${ratio}`);
  await visit.leave();
});

test("the strip and the slider go to a moment", async () => {
  const visit = await laboratory.visit(bad);
  const { page } = visit;
  const box = await page.locator("#strip").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  assert.ok(Math.abs(await visit.time() - 3.5) < 0.02);
  assert.equal(await visit.selected(), 1);
  await page.locator("#time").fill("2");
  assert.equal(await visit.time(), 2);
  await page.keyboard.press("v");
  await page.waitForSelector("#strip-mode[aria-pressed=true]");
  await visit.leave();
});

test("continuous time: clearance now, and the list of the least ones leads there", async () => {
  const visit = await laboratory.visit(discs);
  const { page } = visit;
  assert.match(await visit.text("summary"), /2 agents · sum of costs 5.015 · makespan 2.9 · optimal/);
  await page.locator("#nearest-list button").first().click();
  assert.ok(Math.abs(await visit.time() - 0.623) < 0.001);
  assert.match(await visit.text("clearance-now"), /^7\.\d+e-5, agents 0 and 1$/);
  await page.keyboard.press("b");
  await page.waitForSelector("#swept[aria-pressed=true]");
  await visit.leave();
});

test("everything that can be operated has a name", async () => {
  const visit = await laboratory.visit(bad);
  const nameless = await visit.page.evaluate(`[...document.querySelectorAll("button,input,select,canvas")]
    .filter((e) => !(e.getAttribute("aria-label") || e.textContent.trim() || e.labels?.length))
    .map((e) => e.outerHTML)`);
  assert.deepEqual(nameless, []);
  const dark = await laboratory.visit(bad, { dark: true });
  assert.ok(await dark.page.evaluate("document.documentElement.classList.contains('dark')"));
  await dark.leave();
  await visit.leave();
});

/**
 * Where an agent is drawn in the window.
 * @param {Visit} visit
 * @param {number} agent
 * @returns {Promise<[number, number]>}
 */
async function onPage(visit, agent) {
  await visit.settled();
  const box = await visit.page.locator("#map").boundingBox();
  const [x, y] = await visit.page.evaluate(`quadrille.pixel(${agent})`);
  return [box.x + x, box.y + y];
}

/**
 * @param {Visit} visit
 * @param {number} agent
 */
async function clickAgent(visit, agent) {
  await visit.page.mouse.click(...await onPage(visit, agent));
}
