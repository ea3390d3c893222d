// SPDX-License-Identifier: MIT

/** @import {Camera} from "./camera.js" */
/** @import {Agent, Cells, Obstruction, Point, Scene} from "./scene.js" */
/** @import {State} from "./state.js" */
import { drawHeat } from "./attribution.js";
import { agentColour, AGENT_COLOURS } from "./palette.js";

/** What does not move: the map, and on demand starts, goals and paths. Drawn again only when the
 * view changes. */
export class MapLayer {
  /** @param {State} state */
  constructor(state) {
    this.state = state;
    this.canvas = document.createElement("canvas");
    this.key = "";
    /** One pixel per cell. @type {HTMLCanvasElement | null} */
    this.bitmap = null;
    this.bitmapKey = "";
  }

  /**
   * @param {CanvasRenderingContext2D} target
   * @param {number} width
   * @param {number} height
   */
  draw(target, width, height) {
    const { state } = this;
    const key = [state.camera.key(), state.dark, state.showPaths, state.showGoals, state.showHeat,
      window.devicePixelRatio].join(" ");
    if (key !== this.key) {
      this.render(width, height);
      this.key = key;
    }
    target.drawImage(this.canvas, 0, 0, width, height);
  }

  /**
   * @param {number} width
   * @param {number} height
   */
  render(width, height) {
    const { scene, camera, theme, showPaths, showGoals, showHeat } = this.state;
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const context = fittedContextOf(this.canvas, ratio);
    context.fillStyle = theme.page;
    context.fillRect(0, 0, width, height);
    if (scene.cells) this.drawCells(context, scene.cells);
    else this.drawRoads(context);
    if (showHeat) drawHeat(context, this.state);
    if (showPaths) this.drawPaths(context);
    if (scene.obstruction !== null) drawObstruction(context, this.state, scene.obstruction);
    if (showGoals) for (const agent of scene.agents) drawEnds(context, camera, agent, this.state);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Cells} cells
   */
  drawCells(context, cells) {
    const { camera, theme } = this.state;
    if (this.bitmap === null || this.bitmapKey !== theme.free + theme.blocked) {
      this.bitmap = bitmapOf(cells, theme.free, theme.blocked);
      this.bitmapKey = theme.free + theme.blocked;
    }
    const left = camera.toPixelX(-0.5 * cells.pitch);
    const top = camera.toPixelY(-0.5 * cells.pitch);
    const size = cells.pitch * camera.scale;
    context.imageSmoothingEnabled = size < 1;
    context.drawImage(this.bitmap, left, top, cells.width * size, cells.height * size);
    if (size < 12) return;
    context.strokeStyle = theme.line;
    context.lineWidth = 0.5;
    context.beginPath();
    for (let x = 0; x <= cells.width; ++x) {
      context.moveTo(left + x * size, top);
      context.lineTo(left + x * size, top + cells.height * size);
    }
    for (let y = 0; y <= cells.height; ++y) {
      context.moveTo(left, top + y * size);
      context.lineTo(left + cells.width * size, top + y * size);
    }
    context.stroke();
  }

  /** @param {CanvasRenderingContext2D} context */
  drawRoads(context) {
    const { scene, camera, theme } = this.state;
    context.strokeStyle = theme.road;
    context.lineWidth = 1;
    context.beginPath();
    for (const list of [scene.links, scene.oneWay])
      {for (let k = 0; k + 1 < list.length; k += 2) {
        const [from, to] = [scene.places[list[k]], scene.places[list[k + 1]]];
        context.moveTo(camera.toPixelX(from.x), camera.toPixelY(from.y));
        context.lineTo(camera.toPixelX(to.x), camera.toPixelY(to.y));
      }}
    context.stroke();
    context.fillStyle = theme.road;
    for (let k = 0; k + 1 < scene.oneWay.length; k += 2)
      drawArrow(context, camera, scene.places[scene.oneWay[k]], scene.places[scene.oneWay[k + 1]]);
    context.beginPath();
    for (const place of scene.places) {
      const [x, y] = [camera.toPixelX(place.x), camera.toPixelY(place.y)];
      if (x < -5 || y < -5 || x > camera.width + 5 || y > camera.height + 5) continue;
      context.moveTo(x + 2, y);
      context.arc(x, y, 2, 0, 2 * Math.PI);
    }
    context.fill();
  }

  /** All paths, those of one colour at once. @param {CanvasRenderingContext2D} context */
  drawPaths(context) {
    const { scene, camera } = this.state;
    context.globalAlpha = 0.6;
    context.lineWidth = 1.5;
    AGENT_COLOURS.forEach((colour, kind) => {
      context.strokeStyle = colour;
      context.beginPath();
      for (let i = kind; i < scene.agents.length; i += AGENT_COLOURS.length)
        tracePath(context, camera, scene.agents[i]);
      context.stroke();
    });
    context.globalAlpha = 1;
  }
}

/**
 * @param {HTMLCanvasElement} canvas
 * @param {number} ratio
 * @returns {CanvasRenderingContext2D}
 */
function fittedContextOf(canvas, ratio) {
  const context = canvas.getContext("2d");
  if (!context) throw new Error("this browser draws no canvas");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
}

/**
 * @param {Cells} cells
 * @param {string} free
 * @param {string} blocked
 * @returns {HTMLCanvasElement}
 */
function bitmapOf(cells, free, blocked) {
  const canvas = document.createElement("canvas");
  canvas.width = cells.width;
  canvas.height = cells.height;
  const context = fittedContextOf(canvas, 1);
  const image = context.createImageData(cells.width, cells.height);
  const colours = [blocked, free].map((colour) => parseInt(colour.slice(1), 16));
  for (let i = 0; i < cells.passable.length; ++i) {
    const colour = colours[cells.passable[i]];
    image.data.set([colour >> 16, (colour >> 8) & 255, colour & 255, 255], 4 * i);
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

/**
 * Half way along a road that may be used in one direction only.
 * @param {CanvasRenderingContext2D} context
 * @param {Camera} camera
 * @param {import("./scene.js").Point} from
 * @param {import("./scene.js").Point} to
 */
function drawArrow(context, camera, from, to) {
  const [ax, ay] = [camera.toPixelX(from.x), camera.toPixelY(from.y)];
  const [bx, by] = [camera.toPixelX(to.x), camera.toPixelY(to.y)];
  const length = Math.hypot(bx - ax, by - ay);
  if (length < 16) return;
  const [ux, uy] = [(bx - ax) / length, (by - ay) / length];
  const [x, y] = [(ax + bx) / 2, (ay + by) / 2];
  context.beginPath();
  context.moveTo(x + 5 * ux, y + 5 * uy);
  context.lineTo(x - 3 * ux - 3 * uy, y - 3 * uy + 3 * ux);
  context.lineTo(x - 3 * ux + 3 * uy, y - 3 * uy - 3 * ux);
  context.fill();
}

/**
 * Adds the path of an agent to the path of the canvas.
 * @param {CanvasRenderingContext2D} context
 * @param {Camera} camera
 * @param {Agent} agent
 */
export function tracePath(context, camera, agent) {
  const { xs, ys } = agent;
  if (xs.length === 0) return;
  context.moveTo(camera.toPixelX(xs[0]), camera.toPixelY(ys[0]));
  for (let k = 1; k < xs.length; ++k)
    {if (xs[k] !== xs[k - 1] || ys[k] !== ys[k - 1])
      context.lineTo(camera.toPixelX(xs[k]), camera.toPixelY(ys[k]));}
}

/**
 * A circle where the agent begins, a square where it has to go.
 * @param {CanvasRenderingContext2D} context
 * @param {Camera} camera
 * @param {Agent} agent
 * @param {State} state
 */
function drawEnds(context, camera, agent, state) {
  const size = Math.max(1.5, Math.min(0.6 * state.scene.bodies[agent.body].radius * camera.scale, 12));
  context.strokeStyle = agentColour(agent.index);
  context.lineWidth = Math.max(1, Math.min(2, size / 3));
  const [gx, gy] = [camera.toPixelX(agent.goal.x), camera.toPixelY(agent.goal.y)];
  context.strokeRect(gx - size, gy - size, 2 * size, 2 * size);
  context.beginPath();
  context.arc(camera.toPixelX(agent.start.x), camera.toPixelY(agent.start.y), size, 0, 2 * Math.PI);
  context.stroke();
}

/**
 * The links of which both ends are among the points.
 * @param {Scene} scene
 * @param {Point[]} points
 * @returns {[Point, Point][]}
 */
function linksWithin(scene, points) {
  const key = (/** @type {Point} */ { x, y }) => `${x} ${y}`;
  const within = new Set(points.map(key));
  /** @type {[Point, Point][]} */
  const links = [];
  for (const list of [scene.links, scene.oneWay]) {
    for (let k = 0; k + 1 < list.length; k += 2) {
      const [from, to] = [scene.places[list[k]], scene.places[list[k + 1]]];
      if (within.has(key(from)) && within.has(key(to))) links.push([from, to]);
    }
  }
  return links;
}

/**
 * The place where no two can pass, and where the agents want to go that the reason names.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 * @param {Obstruction} obstruction
 */
function drawObstruction(context, state, { agents, points }) {
  const { scene, camera, theme } = state;
  const unit = scene.cells === null ? camera.smallest() : 0.5 * scene.cells.pitch;
  const width = Math.max(6, unit * camera.scale);
  context.globalAlpha = 0.5;
  context.strokeStyle = theme.alarm;
  context.lineWidth = width;
  context.lineCap = "round";
  // In one stroke, so that nothing is painted twice. A line without length would not be painted.
  context.beginPath();
  for (const [from, to] of [...points.map((point) => [point, point]), ...linksWithin(scene, points)]) {
    context.moveTo(camera.toPixelX(from.x), camera.toPixelY(from.y));
    context.lineTo(camera.toPixelX(to.x) + 0.01, camera.toPixelY(to.y));
  }
  context.stroke();
  context.globalAlpha = 1;
  context.lineCap = "butt";
  context.setLineDash([6, 4]);
  context.lineWidth = 2;
  for (const { index, start, goal } of agents.map((agent) => scene.agents[agent])) {
    context.strokeStyle = agentColour(index);
    context.beginPath();
    context.moveTo(camera.toPixelX(start.x), camera.toPixelY(start.y));
    context.lineTo(camera.toPixelX(goal.x), camera.toPixelY(goal.y));
    context.stroke();
  }
  context.setLineDash([]);
}
