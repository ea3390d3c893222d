// SPDX-License-Identifier: MIT

import { drawAgents } from "./agent_layer.js";
import { Reasons } from "./attribution.js";
import { listenToControls, makeActions, updateControls } from "./controls.js";
import { listenToKeys } from "./keys.js";
import { followLink, updateLink } from "./link.js";
import { MapLayer } from "./map_layer.js";
import { isPresent, obstacleAt, positionAt } from "./motion.js";
import { Panel } from "./panel.js";
import { listenToMap, listenToStrip } from "./pointer.js";
import { readScene } from "./scene.js";
import { element, fittedContext, State } from "./state.js";
import { Strip } from "./strip.js";

/** Draws when something has changed, and all the time while the plan plays. */
class Page {
  /** @param {State} state */
  constructor(state) {
    this.state = state;
    this.canvas = element("map", HTMLCanvasElement);
    this.strip = new Strip(state, element("strip", HTMLCanvasElement));
    this.map = new MapLayer(state);
    this.panel = new Panel(state, (time, agents) => this.jump(time, agents));
    this.reasons = new Reasons(state, (time, agents) => this.jump(time, agents));
    this.live = element("live", HTMLElement);
    this.said = "";
    this.waiting = false;
  }

  start() {
    const { state } = this;
    const actions = makeActions(state, (time, agents) => this.jump(time, agents));
    listenToControls(state, actions);
    listenToKeys(actions, element("help-keys", HTMLElement));
    listenToMap(state, this.canvas);
    listenToStrip(state, this.strip.canvas, this.strip);
    state.listeners.push(() => this.invalidate());
    window.addEventListener("hashchange", () => followLink(state));
    new ResizeObserver(() => this.invalidate()).observe(this.canvas);
    const dark = window.matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", () => state.setDark(dark.matches));
    state.setDark(dark.matches);
    followLink(state);
    this.draw();
  }

  invalidate() {
    if (this.waiting) return;
    this.waiting = true;
    window.requestAnimationFrame((now) => {
      this.waiting = false;
      this.state.player.advance(now);
      this.draw();
      if (this.state.player.playing) this.invalidate();
    });
  }

  draw() {
    const { state } = this;
    const { context, width, height } = fittedContext(this.canvas);
    state.camera.resize(width, height);
    const agent = state.agent();
    if (state.following && agent !== null) state.camera.centreOn(positionAt(agent, state.player.time));
    if (width > 0 && height > 0) {
      this.map.draw(context, width, height);
      drawAgents(context, state);
    }
    this.strip.draw();
    this.panel.update();
    this.reasons.draw();
    updateControls(state);
    updateLink(state);
    this.say();
  }

  /** For those who hear the page. While the plan plays, nothing is said. */
  say() {
    const { state } = this;
    if (state.player.playing) return;
    const agent = state.agent();
    const time = state.showMoment(state.player.time);
    const text = `Time ${time}` + (agent === null ? "" : `, ${agent.name}`);
    if (text === this.said) return;
    this.said = text;
    this.live.textContent = text;
  }

  /**
   * To a moment, and to where these agents are then.
   * @param {number} time
   * @param {number[]} agents
   */
  jump(time, agents) {
    const { state } = this;
    state.player.pause();
    state.player.seek(time);
    const agent = state.scene.agents[agents[0]];
    if (agent !== undefined) {
      const at = positionAt(agent, state.player.time);
      const [x, y] = [state.camera.toPixelX(at.x), state.camera.toPixelY(at.y)];
      const margin = 30;
      const { width, height } = state.camera;
      const seen = x > margin && y > margin && x < width - margin && y < height - margin;
      if (!seen) state.camera.centreOn(at);
      state.select(agent.index);
    }
    state.changed();
  }
}

/**
 * What scripts and tests may use: `window.quadrille`. Times and positions are in units of the input.
 * @param {State} state
 * @param {Page} page
 */
function publicInterface(state, page) {
  const { scene, player } = state;
  const length = scene.lengthUnit;
  return Object.freeze({
    agents: scene.agents.length,
    end: scene.end * scene.unit,
    /** Shows this moment, and has drawn it on return. @param {number} time */
    seek(time) {
      player.pause();
      player.seek(time / scene.unit);
      page.draw();
    },
    time: () => player.time * scene.unit,
    selected: () => state.selected,
    /** @param {number} agent @param {number} time */
    position(agent, time) {
      const { x, y, z } = positionAt(scene.agents[agent], time / scene.unit);
      return scene.heights ? [x * length, y * length, z * length] : [x * length, y * length];
    },
    /** Whether it has not left yet. @param {number} agent @param {number} time */
    isPresent: (agent, time) => isPresent(scene.agents[agent], time / scene.unit),
    /** Of a moving obstacle; null if it is nowhere. @param {number} index @param {number} time */
    obstacle(index, time) {
      const at = obstacleAt(scene.obstacles[index], time / scene.unit);
      return at && [at.x, at.y, ...(scene.heights ? [at.z] : [])].map((value) => value * length);
    },
    /** Where the agent is drawn now, in pixels of the map. @param {number} agent */
    pixel(agent) {
      const { x, y } = positionAt(scene.agents[agent], player.time);
      return [state.camera.toPixelX(x), state.camera.toPixelY(y)];
    },
    /** Where a place is drawn now, in pixels of the map. @param {number} x @param {number} y */
    pixelOf: (x, y) => [state.camera.toPixelX(x / length), state.camera.toPixelY(y / length)],
    /** By how much each two agents raise the bound together, and how large that is drawn. */
    matrix: () => page.reasons.table(),
    /** The free space between two agents. @param {number} a @param {number} b @param {number} time */
    clearance: (a, b, time) => state.clearances.between(a, b, time / scene.unit) * length,
    /** @param {number} time */
    leastClearance(time) {
      const least = state.clearances.leastAt(time / scene.unit);
      return least && { agents: least.agents, gap: least.gap * length };
    },
  });
}

function start() {
  const problem = element("problem", HTMLElement);
  problem.hidden = true;
  try {
    const data = document.getElementById("data");
    const state = new State(readScene(data?.textContent ?? ""));
    const page = new Page(state);
    page.start();
    Object.assign(window, { quadrille: publicInterface(state, page) });
  } catch (error) {
    problem.hidden = false;
    problem.textContent = error instanceof Error ? error.message : String(error);
    for (const part of document.querySelectorAll("body > header, body > main, body > footer"))
      if (part instanceof HTMLElement) part.hidden = true;
  }
}

// The data come after the script: where the file is cut off, the script says so.
document.addEventListener("DOMContentLoaded", start);
