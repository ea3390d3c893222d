// SPDX-License-Identifier: MIT
// Opens pages in Debian's Chromium and notes whatever goes wrong in them.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
];

/**
 * Each frame is drawn this much later, in ms: on a busy machine a page lags behind what was asked of
 * it, and a test that reads before the page has drawn fails there only. So it fails here.
 */
const FRAME_DELAY = 40;
const slowFrames = `(() => {
  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (draw) => window.setTimeout(() => request(draw), ${FRAME_DELAY});
})()`;

/**
 * Until the expression is true, for ten seconds at most. The page's policy forbids what
 * waitForFunction does when it has to ask twice.
 * @param {import("playwright-core").Page} page
 * @param {string} expression
 */
export async function until(page, expression) {
  const end = Date.now() + 10_000;
  while (!(await page.evaluate(expression))) {
    assert.ok(Date.now() < end, `it never came true: ${expression}`);
    await page.waitForTimeout(10);
  }
}

/** A folder for the files of one test program, and a browser. */
export class Laboratory {
  static async open() {
    const laboratory = new Laboratory();
    laboratory.folder = mkdtempSync(join(tmpdir(), "quadrille-view-"));
    laboratory.browser = await chromium.launch({
      executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: FLAGS, timeout: 120000,
    });
    return laboratory;
  }

  async close() {
    await this.browser?.close();
    if (this.folder) rmSync(this.folder, { recursive: true });
  }

  /**
   * Runs the program under test.
   * @param {string[]} options
   * @returns {string} what it wrote to standard output
   */
  run(...options) {
    const program = process.env.QUADRILLE_PROGRAM;
    assert.ok(program, "QUADRILLE_PROGRAM names the program");
    return execFileSync(program, options, { cwd: this.folder, encoding: "utf8" });
  }

  /**
   * @param {string} name
   * @param {string} text
   * @returns {string} where it is
   */
  write(name, text) {
    const path = join(this.folder, name);
    writeFileSync(path, text);
    return path;
  }

  /**
   * @param {string} file
   * @param {{hash?: string, viewport?: {width: number, height: number}, touch?: boolean,
   *   dark?: boolean, ratio?: number}} options
   */
  async visit(file, options = {}) {
    const context = await this.browser.newContext({
      viewport: options.viewport ?? { width: 1000, height: 700 },
      hasTouch: options.touch ?? false,
      colorScheme: options.dark ? "dark" : "light",
      deviceScaleFactor: options.ratio ?? 1,
    });
    await context.addInitScript(slowFrames);
    const page = await context.newPage();
    page.setDefaultTimeout(60000);
    const visit = new Visit(context, page);
    const url = pathToFileURL(file).href;
    page.on("request", (request) => {
      const own = request.url().split("#")[0] === url || request.url().startsWith("data:");
      if (!own) visit.faults.push(`request: ${request.url()}`);
    });
    page.on("console", (message) => visit.faults.push(`console: ${message.text()}`));
    page.on("pageerror", (error) => visit.faults.push(`error: ${error.message}`));
    await page.goto(url + (options.hash ?? ""));
    return visit;
  }
}

/** One page that is open. */
export class Visit {
  /**
   * @param {import("playwright-core").BrowserContext} context
   * @param {import("playwright-core").Page} page
   */
  constructor(context, page) {
    this.context = context;
    this.page = page;
    /** @type {string[]} */
    this.faults = [];
  }

  /** Closes the page. It must not have asked for anything, nor complained. */
  async leave() {
    await this.context.close();
    assert.deepEqual(this.faults, []);
  }

  /**
   * Until what was asked of the page is drawn, and the map has the same size and scale twice: what is
   * opened beside it changes both.
   */
  async settled() {
    const look = `new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => {
      const { width, height } = document.getElementById("map").getBoundingClientRect();
      done([width, height, ...quadrille.pixel(0)].join(" "));
    })))`;
    const end = Date.now() + 10_000;
    let last = "";
    for (let now = await this.page.evaluate(look); now !== last; now = await this.page.evaluate(look)) {
      assert.ok(Date.now() < end, "the map keeps changing its size");
      last = now;
    }
  }

  /**
   * What the page shows in an element.
   * @param {string} id
   */
  async text(id) {
    await this.settled();
    return this.page.locator(`#${id}`).textContent();
  }

  /** The moment and the selection change at once, before they are drawn. */
  time() {
    return this.page.evaluate("quadrille.time()");
  }

  selected() {
    return this.page.evaluate("quadrille.selected()");
  }
}
