// SPDX-License-Identifier: MIT

/** @import {Attribution, Point, Site} from "./scene.js" */
/** @import {State} from "./state.js" */
import { element, fittedContext } from "./state.js";

/** From a little to a lot: light to dark, as people see apart whatever their colour vision. */
const HEAT = ["#f0e442", "#e69f00", "#d55e00", "#8b1a00"];
/** A raise of more agents says nothing about pairs. */
const MOST_IN_MATRIX = 24;
const MOST_RAISES = 100;

/**
 * A colour for a share of the largest value.
 * @param {number} share  in [0, 1]
 */
function heatColour(share) {
  return HEAT[Math.min(HEAT.length - 1, Math.floor(share * HEAT.length))];
}

/**
 * How many lemmas there are about each place.
 * @param {Site[]} sites
 * @returns {{points: Point[], lemmas: number}[]} the fewest first
 */
export function heatOf(sites) {
  /** @type {Map<string, {points: Point[], lemmas: number}>} */
  const places = new Map();
  for (const { lines, lemmas } of sites) {
    for (const points of lines) {
      const key = points.map(({ x, y }) => `${x} ${y}`).join(" ");
      const place = places.get(key) ?? { points, lemmas: 0 };
      place.lemmas += lemmas;
      places.set(key, place);
    }
  }
  return [...places.values()].sort((a, b) => a.lemmas - b.lemmas);
}

/**
 * The places where agents get in each other's way, the redder the more lemmas there were.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 */
export function drawHeat(context, state) {
  const { scene, camera } = state;
  const places = heatOf(scene.attribution?.sites ?? []);
  const most = Math.max(1, ...places.map((place) => place.lemmas));
  const unit = scene.cells === null ? camera.smallest() : 0.5 * scene.cells.pitch;
  context.globalAlpha = 0.6;
  context.lineCap = "round";
  context.lineJoin = "round";
  context.lineWidth = Math.max(5, 1.5 * unit * camera.scale);
  for (const { points, lemmas } of places) {
    context.strokeStyle = context.fillStyle = heatColour(lemmas / most);
    context.beginPath();
    points.forEach((point, index) => {
      const [x, y] = [camera.toPixelX(point.x), camera.toPixelY(point.y)];
      if (points.length === 1) context.arc(x, y, context.lineWidth / 2, 0, 2 * Math.PI);
      else if (index === 0) context.moveTo(x, y);
      else context.lineTo(x, y);
    });
    if (points.length > 1) context.stroke();
    if (points.length === 1 || isArea(points)) context.fill();
  }
  context.globalAlpha = 1;
}

/**
 * Whether a line comes back to where it begins: it goes around a rectangle.
 * @param {Point[]} points
 */
function isArea(points) {
  const last = points[points.length - 1];
  return points.length > 2 && points[0].x === last.x && points[0].y === last.y;
}

/**
 * The agents that raise the bound together, those with the most first, and by how much each two do.
 * @param {Attribution} attribution
 * @returns {{agents: number[], weights: Map<string, number>}}
 */
export function pairWeights(attribution) {
  /** @type {Map<string, number>} */
  const weights = new Map();
  /** @type {Map<number, number>} */
  const totals = new Map();
  const add = (/** @type {number} */ a, /** @type {number} */ b, /** @type {number} */ amount) => {
    weights.set(`${a} ${b}`, (weights.get(`${a} ${b}`) ?? 0) + amount);
    totals.set(a, (totals.get(a) ?? 0) + amount);
  };
  for (const { amount, agents } of attribution.raises) {
    if (agents.length > MOST_IN_MATRIX) continue;
    const pairs = agents.flatMap((a) => agents.filter((b) => b !== a).map((b) => [a, b]));
    for (const [a, b] of pairs) add(a, b, amount);
  }
  const total = (/** @type {number} */ agent) => totals.get(agent) ?? 0;
  const agents = [...totals.keys()].sort((a, b) => total(b) - total(a) || a - b);
  return { agents: agents.slice(0, MOST_IN_MATRIX), weights };
}

/** The section of the panel: why no plan is cheaper. */
export class Reasons {
  /**
   * @param {State} state
   * @param {(time: number, agents: number[]) => void} jump
   */
  constructor(state, jump) {
    this.state = state;
    this.jump = jump;
    this.key = "";
    /** Pixels of a row of the matrix. */
    this.size = 0;
    const { attribution } = state.scene;
    element("reasons", HTMLElement).hidden = attribution === null;
    element("heat", HTMLButtonElement).hidden = attribution === null;
    this.matrix = attribution === null ? null : pairWeights(attribution);
    element("matrix-part", HTMLElement).hidden = this.matrix === null || this.matrix.agents.length === 0;
    if (attribution === null) return;
    const raised = attribution.lowerBound - attribution.freeBound;
    element("bound-text", HTMLElement).textContent =
      `Bound ${state.show(attribution.lowerBound)} = ${state.show(attribution.freeBound)} ` +
      `${state.scene.objective === "makespan" ? "that one agent needs alone" : "that the agents cost alone"}` +
      ` + ${state.show(raised)}`;
    this.fillBar(attribution);
    this.listRaises(attribution);
  }

  /**
   * The free costs, and one part for each raise, as long as they are large.
   * @param {Attribution} attribution
   */
  fillBar({ freeBound, raises }) {
    const bar = element("bound-bar", HTMLElement);
    const append = (/** @type {string} */ kind, /** @type {number} */ amount, /** @type {string} */ text) => {
      const part = document.createElement("span");
      part.className = kind;
      part.style.flexGrow = String(amount);
      part.title = text;
      bar.append(part);
    };
    if (freeBound > 0) append("free", freeBound, `${this.state.show(freeBound)} free`);
    for (const { amount, agents } of raises)
      append("raised", amount, `+${this.state.show(amount)} ${agentsName(this.state.scene, agents)}`);
  }

  /** @param {Attribution} attribution */
  listRaises({ raises, sites }) {
    const list = element("raise-list", HTMLElement);
    const sorted = [...raises].sort((a, b) => b.amount - a.amount);
    for (const { amount, agents } of sorted.slice(0, MOST_RAISES)) {
      const button = document.createElement("button");
      button.textContent = `+${this.state.show(amount)}  ${agentsName(this.state.scene, agents)}`;
      button.addEventListener("click", () => this.jump(this.timeOf(agents, sites), agents));
      const item = document.createElement("li");
      item.append(button);
      list.append(item);
    }
    if (raises.length <= MOST_RAISES) return;
    const rest = document.createElement("li");
    rest.textContent = `and ${raises.length - MOST_RAISES} more`;
    list.append(rest);
  }

  /**
   * When these agents are most in each other's way; now if that is not known.
   * @param {number[]} agents
   * @param {Site[]} sites
   */
  timeOf(agents, sites) {
    const own = sites.filter((site) => site.agents.every((agent) => agents.includes(agent)));
    if (own.length === 0) return this.state.player.time;
    return own.reduce((best, site) => (site.lemmas > best.lemmas ? site : best)).begin;
  }

  /** What the matrix shows; null without one. */
  table() {
    if (this.matrix === null) return null;
    const { agents, weights } = this.matrix;
    const amounts = agents.map((a) => agents.map((b) => weights.get(`${a} ${b}`) ?? 0));
    return { agents, amounts, size: this.size };
  }

  /** The matrix: a row and a column for each agent, the redder the more two raise the bound together. */
  draw() {
    if (this.matrix === null || this.matrix.agents.length === 0) return;
    const { agents, weights } = this.matrix;
    const canvas = element("matrix", HTMLCanvasElement);
    const { context, width, height } = fittedContext(canvas);
    const key = [width, height, window.devicePixelRatio, this.state.dark].join(" ");
    if (key === this.key) return;
    this.key = key;
    context.clearRect(0, 0, width, height);
    const label = 20;
    const size = Math.min((Math.min(width, height) - label) / agents.length, 22);
    this.size = size;
    const most = Math.max(1, ...weights.values());
    context.font = `${Math.max(6, Math.min(11, 0.8 * size)).toFixed(0)}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    agents.forEach((a, row) => {
      const middle = label + (row + 0.5) * size;
      context.fillStyle = this.state.theme.faint;
      context.fillText(String(a), label / 2, middle);
      context.fillText(String(a), middle, label / 2);
      agents.forEach((b, column) => {
        const weight = weights.get(`${a} ${b}`) ?? 0;
        context.fillStyle = weight > 0 ? heatColour(weight / most) : this.state.theme.page;
        context.fillRect(label + column * size, label + row * size, size - 1, size - 1);
      });
    });
  }
}

/**
 * @param {import("./scene.js").Scene} scene
 * @param {number[]} agents
 * @param {string} [separator]
 * @returns {string}
 */
export function agentsName(scene, agents, separator = ", ") {
  if (agents.length > 8) return `${agents.length} agents`;
  const names = agents.map((index) => scene.agents[index]?.name ?? `agent ${index}`);
  if (agents.length === 1) return names[0];
  const areNumbered = names.every((name, k) => name === `agent ${agents[k]}`);
  return areNumbered ? `agents ${agents.join(separator)}` : names.join(separator);
}
