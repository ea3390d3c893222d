// SPDX-License-Identifier: MIT

/** @import {Agent} from "./scene.js" */
/** @import {State} from "./state.js" */
import { agentColour } from "./palette.js";
import { fittedContext } from "./state.js";

/** A row per agent is readable up to here; above it the agents are counted. */
const MOST_ROWS = 48;
const MOVES = "#56b4e9";
const WAITS = "#d55e00";
const MARGIN = 4;

/** Time from left to right: who waits when, or the selected path as a space-time diagram. */
export class Strip {
  /**
   * @param {State} state
   * @param {HTMLCanvasElement} canvas
   */
  constructor(state, canvas) {
    this.state = state;
    this.canvas = canvas;
    this.picture = document.createElement("canvas");
    this.key = "";
  }

  /** @param {number} time */
  toX(time) {
    const width = this.canvas.clientWidth - 2 * MARGIN;
    return MARGIN + (this.state.scene.end > 0 ? (time / this.state.scene.end) * width : 0);
  }

  /** @param {number} x  in pixels of the strip */
  toTime(x) {
    const width = Math.max(1, this.canvas.clientWidth - 2 * MARGIN);
    return ((x - MARGIN) / width) * this.state.scene.end;
  }

  /**
   * The agent whose row this is, if there are rows.
   * @param {number} y
   * @returns {number | null}
   */
  agentAt(y) {
    const count = this.state.scene.agents.length;
    if (this.showsPath() || count > MOST_ROWS) return null;
    const row = Math.floor((y / this.canvas.clientHeight) * count);
    return row >= 0 && row < count ? row : null;
  }

  showsPath() {
    const agent = this.state.agent();
    return this.state.alongPath && agent !== null && agent.times.length > 1;
  }

  draw() {
    const { state } = this;
    const { context, width, height } = fittedContext(this.canvas);
    const key = [width, height, window.devicePixelRatio, state.dark, state.selected,
      this.showsPath()].join(" ");
    if (key !== this.key) {
      this.render(width, height);
      this.key = key;
    }
    context.clearRect(0, 0, width, height);
    context.drawImage(this.picture, 0, 0, width, height);
    context.fillStyle = state.theme.text;
    context.fillRect(this.toX(state.player.time) - 0.75, 0, 1.5, height);
  }

  /**
   * @param {number} width
   * @param {number} height
   */
  render(width, height) {
    this.picture.width = this.canvas.width;
    this.picture.height = this.canvas.height;
    const context = this.picture.getContext("2d");
    if (!context || width === 0) return;
    const ratio = window.devicePixelRatio || 1;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const selected = this.state.agent();
    if (this.showsPath() && selected !== null) this.drawAlong(context, selected, height);
    else if (this.state.scene.agents.length <= MOST_ROWS) this.drawRows(context, height);
    else this.drawCounts(context, width, height);
    context.fillStyle = this.state.theme.alarm;
    for (const { time } of this.state.scene.violations) context.fillRect(this.toX(time) - 1, 0, 2, 6);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} height
   */
  drawRows(context, height) {
    const { scene, selected, theme } = this.state;
    const size = height / Math.max(1, scene.agents.length);
    for (const agent of scene.agents) {
      const top = agent.index * size;
      if (agent.index === selected) {
        context.fillStyle = theme.line;
        context.fillRect(0, top, this.canvas.clientWidth, size);
      }
      const inset = Math.min(2, size / 5);
      for (const { from, to, waits } of stretches(agent)) {
        context.fillStyle = waits ? WAITS : MOVES;
        context.fillRect(this.toX(from), top + inset, Math.max(0.5, this.toX(to) - this.toX(from)),
          size - 2 * inset);
      }
    }
  }

  /**
   * How many agents wait, and how many move, at each moment.
   * @param {CanvasRenderingContext2D} context
   * @param {number} width
   * @param {number} height
   */
  drawCounts(context, width, height) {
    const { scene } = this.state;
    const columns = Math.max(1, Math.floor(width));
    const waiting = new Float64Array(columns + 1);
    const busy = new Float64Array(columns + 1);
    for (const agent of scene.agents)
      {for (const { from, to, waits } of stretches(agent)) {
        const [first, last] = [Math.round(this.toX(from)), Math.round(this.toX(to))];
        busy[Math.min(first, columns)] += 1;
        busy[Math.min(last, columns)] -= 1;
        if (!waits) continue;
        waiting[Math.min(first, columns)] += 1;
        waiting[Math.min(last, columns)] -= 1;
      }}
    let [now, idle] = [0, 0];
    for (let x = 0; x < columns; ++x) {
      now += busy[x];
      idle += waiting[x];
      const unit = height / scene.agents.length;
      context.fillStyle = MOVES;
      context.fillRect(x, height - now * unit, 1, (now - idle) * unit);
      context.fillStyle = WAITS;
      context.fillRect(x, height - idle * unit, 1, idle * unit);
    }
  }

  /**
   * Upwards: how far along the path of the selected agent. Others are drawn where they are on it.
   * @param {CanvasRenderingContext2D} context
   * @param {Agent} selected
   * @param {number} height
   */
  drawAlong(context, selected, height) {
    const { lengths, total } = lengthsAlong(selected);
    const toY = (/** @type {number} */ length) => height - 3 - (length / total) * (height - 6);
    for (const agent of this.state.scene.agents) {
      const own = agent.index === selected.index;
      context.strokeStyle = own ? this.state.theme.text : agentColour(agent.index);
      context.lineWidth = own ? 2.5 : 1.5;
      context.beginPath();
      for (let k = 0; k + 1 < agent.times.length; ++k) {
        const here = lengths.get(placeKey(agent, k));
        const there = lengths.get(placeKey(agent, k + 1));
        if (here === undefined || there === undefined) continue;
        context.moveTo(this.toX(agent.times[k]), toY(here));
        context.lineTo(this.toX(agent.times[k + 1]), toY(there));
      }
      const last = agent.times.length - 1;
      const end = last < 0 ? undefined : lengths.get(placeKey(agent, last));
      if (end !== undefined) {
        context.moveTo(this.toX(agent.times[last]), toY(end));
        context.lineTo(this.toX(this.state.scene.end), toY(end));
      }
      context.stroke();
    }
  }
}

/**
 * The waits and the moves of an agent before it arrives, consecutive moves as one.
 * @param {Agent} agent
 * @returns {{from: number, to: number, waits: boolean}[]}
 */
export function stretches(agent) {
  const { times, xs, ys } = agent;
  /** @type {{from: number, to: number, waits: boolean}[]} */
  const list = [];
  for (let k = 0; k + 1 < times.length; ++k) {
    if (agent.cost !== null && times[k] >= agent.cost) break;
    const waits = xs[k] === xs[k + 1] && ys[k] === ys[k + 1];
    const last = list[list.length - 1];
    if (last && last.waits === waits) last.to = times[k + 1];
    else list.push({ from: times[k], to: times[k + 1], waits });
  }
  return list;
}

/**
 * @param {Agent} agent
 * @param {number} k
 * @returns {string}
 */
function placeKey(agent, k) {
  return `${agent.xs[k]} ${agent.ys[k]} ${agent.zs[k]}`;
}

/**
 * How far along its path each place of it is; of a place that is passed more than once the first time.
 * @param {Agent} agent
 * @returns {{lengths: Map<string, number>, total: number}}
 */
function lengthsAlong(agent) {
  const lengths = new Map();
  let total = 0;
  for (let k = 0; k < agent.times.length; ++k) {
    if (k > 0)
      {total += Math.hypot(agent.xs[k] - agent.xs[k - 1], agent.ys[k] - agent.ys[k - 1],
        agent.zs[k] - agent.zs[k - 1]);}
    if (!lengths.has(placeKey(agent, k))) lengths.set(placeKey(agent, k), total);
  }
  return { lengths, total: total || 1 };
}
