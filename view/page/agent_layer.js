// SPDX-License-Identifier: MIT

/** @import {Camera} from "./camera.js" */
/** @import {Agent, Body, Point} from "./scene.js" */
/** @import {State} from "./state.js" */
import { convexHull } from "./clearance.js";
import { tracePath } from "./map_layer.js";
import { bodyAt, frameAt, headingAt, isPresent, obstacleAt, positionAt } from "./motion.js";
import { agentColour, AGENT_COLOURS, labelColour } from "./palette.js";
import { drawPrecedences } from "./precedences.js";

/**
 * The bodies at the moment that is shown, and what belongs to the selected agent.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 */
export function drawAgents(context, state) {
  const { scene, player } = state;
  const positions = scene.agents.map((agent) => positionAt(agent, player.time));
  const selected = state.agent();
  if (selected !== null && state.showSwept) drawSwept(context, state, selected);
  if (selected !== null) {
    drawOtherGoals(context, state, selected);
    drawSelectedPath(context, state, selected);
  }
  drawObstacles(context, state);
  AGENT_COLOURS.forEach((colour, kind) => {
    context.fillStyle = colour;
    // One by one: browsers fill many small paths sooner than one that covers the whole map.
    for (let i = kind; i < positions.length; i += AGENT_COLOURS.length)
      {if (isPresent(scene.agents[i], player.time))
        fillBody(context, state.camera, scene.bodies[bodyAt(scene.agents[i], player.time)], positions[i]);}
  });
  drawHeadings(context, state, positions);
  outline(context, state, positions);
  if (state.showOrder) drawPrecedences(context, state);
  drawLabels(context, state, positions);
}

/**
 * Dashed squares where the agent may end, and does not.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 * @param {Agent} agent
 */
function drawOtherGoals(context, { camera, scene }, agent) {
  const size = Math.max(2.5, Math.min(0.6 * scene.bodies[agent.body].radius * camera.scale, 12));
  context.save();
  context.strokeStyle = agentColour(agent.index);
  context.lineWidth = 1.5;
  context.setLineDash([3, 2]);
  for (const goal of agent.otherGoals)
    context.strokeRect(camera.toPixelX(goal.x) - size, camera.toPixelY(goal.y) - size, 2 * size, 2 * size);
  context.restore();
}

/**
 * Bodies of others, in grey.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 */
function drawObstacles(context, state) {
  const { scene, camera, player, theme } = state;
  context.fillStyle = theme.blocked;
  for (const obstacle of scene.obstacles) {
    const at = obstacleAt(obstacle, player.time);
    if (at !== null) fillBody(context, camera, scene.bodies[obstacle.body], at);
  }
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Camera} camera
 * @param {Body} body
 * @param {Point} at
 */
function fillBody(context, camera, body, at) {
  if (body.radius * camera.scale < 2) {
    // As large as its dot would be; nobody sees that it is square.
    context.fillRect(camera.toPixelX(at.x) - 1.75, camera.toPixelY(at.y) - 1.75, 3.5, 3.5);
    return;
  }
  context.beginPath();
  traceBody(context, camera, body, at);
  context.fill();
}

/**
 * Adds a body to the path of the canvas; one that is very small is drawn as a dot.
 * @param {CanvasRenderingContext2D} context
 * @param {Camera} camera
 * @param {Body} body
 * @param {Point} at
 * @param {number} grow  pixels
 */
function traceBody(context, camera, body, at, grow = 0) {
  const [x, y] = [camera.toPixelX(at.x), camera.toPixelY(at.y)];
  const radius = body.radius * camera.scale;
  if (x + radius < -9 || y + radius < -9 || x - radius > camera.width + 9 || y - radius > camera.height + 9)
    return;
  if (body.corners.length === 0 || radius < 2) {
    const drawn = Math.max(radius, 2) + grow;
    context.moveTo(x + drawn, y);
    context.arc(x, y, drawn, 0, 2 * Math.PI);
    return;
  }
  const factor = camera.scale * (1 + grow / radius);
  body.corners.forEach((corner, k) => {
    const [cx, cy] = [x + corner.x * factor, y + camera.flip * corner.y * factor];
    if (k === 0) context.moveTo(cx, cy);
    else context.lineTo(cx, cy);
  });
  context.closePath();
}

/**
 * An arrow head at the front of each robot that has a heading.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 * @param {Point[]} positions
 */
function drawHeadings(context, { scene, camera, player }, positions) {
  for (const agent of scene.agents) {
    const heading = headingAt(agent, player.time);
    const radius = scene.bodies[agent.body].radius * camera.scale;
    if (heading === null || radius < 4 || !isPresent(agent, player.time)) continue;
    const [x, y] = [camera.toPixelX(positions[agent.index].x), camera.toPixelY(positions[agent.index].y)];
    const angle = (heading * Math.PI) / 180;
    const [ahead, aside] = [Math.cos(angle), camera.flip * Math.sin(angle)];
    const point = (/** @type {number} */ far, /** @type {number} */ left) => /** @type {const} */ (
      [x + radius * (far * ahead - left * aside), y + radius * (far * aside + left * ahead)]);
    context.fillStyle = labelColour(agent.index);
    context.beginPath();
    context.moveTo(...point(0.95, 0));
    context.lineTo(...point(0.6, 0.35));
    context.lineTo(...point(0.6, -0.35));
    context.closePath();
    context.fill();
  }
}

/**
 * Rings around the selected agent, and around those that collide just now.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 * @param {Point[]} positions
 */
function outline(context, state, positions) {
  const { scene, camera, theme } = state;
  const ring = (/** @type {number} */ i, /** @type {string} */ colour) => {
    context.strokeStyle = colour;
    context.lineWidth = 3;
    context.beginPath();
    const body = scene.bodies[bodyAt(scene.agents[i], state.player.time)];
    traceBody(context, camera, body, positions[i], 2.5);
    context.stroke();
  };
  const agent = state.agent();
  if (agent !== null && isPresent(agent, state.player.time)) ring(agent.index, theme.text);
  for (const pair of state.clearances.overlapsAt(state.player.time))
    for (const i of pair) ring(i, theme.alarm);
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 * @param {Point[]} positions
 */
function drawLabels(context, state, positions) {
  const { scene, camera } = state;
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const agent of scene.agents) {
    const body = scene.bodies[bodyAt(agent, state.player.time)];
    const radius = body.radius * camera.scale;
    const text = String(agent.index);
    if (radius < 4 + 3 * text.length || !isPresent(agent, state.player.time)) continue;
    const at = positions[agent.index];
    const [x, y] = [camera.toPixelX(at.x + body.centre.x), camera.toPixelY(at.y + body.centre.y)];
    if (x < 0 || y < 0 || x > camera.width || y > camera.height) continue;
    const size = Math.min(body.corners.length > 0 ? radius / 2 : radius, 18);
    context.font = `600 ${size.toFixed(0)}px system-ui, sans-serif`;
    context.fillStyle = labelColour(agent.index);
    context.fillText(text, x, y + 1);
  }
}

/**
 * Its path: dashed where it has been, and a dot where it waits, which is larger for a longer wait.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 * @param {Agent} agent
 */
function drawSelectedPath(context, state, agent) {
  const { camera, player, scene } = state;
  const { times, xs, ys } = agent;
  if (times.length === 0) return;
  const at = positionAt(agent, player.time);
  const now = Math.max(0, frameAt(agent, player.time));
  context.strokeStyle = agentColour(agent.index);
  context.lineWidth = 3;
  context.lineCap = "round";
  context.lineJoin = "round";
  const trace = (/** @type {number} */ from, /** @type {number} */ to) => {
    for (let k = from; k < to; ++k) context.lineTo(camera.toPixelX(xs[k]), camera.toPixelY(ys[k]));
  };
  context.setLineDash([2, 6]);
  context.beginPath();
  trace(0, now + 1);
  context.lineTo(camera.toPixelX(at.x), camera.toPixelY(at.y));
  context.stroke();
  context.setLineDash([]);
  context.beginPath();
  context.moveTo(camera.toPixelX(at.x), camera.toPixelY(at.y));
  trace(now + 1, times.length);
  context.stroke();
  context.fillStyle = agentColour(agent.index);
  for (let k = 0; k + 1 < times.length; ++k) {
    if (xs[k] !== xs[k + 1] || ys[k] !== ys[k + 1]) continue;
    const wait = (times[k + 1] - times[k]) * scene.unit;
    context.beginPath();
    context.arc(camera.toPixelX(xs[k]), camera.toPixelY(ys[k]), 3 + Math.min(6, 2 * Math.sqrt(wait)),
      0, 2 * Math.PI);
    context.fill();
  }
}

/**
 * All places that the body of an agent ever covers.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 * @param {Agent} agent
 */
function drawSwept(context, state, agent) {
  const { scene, camera } = state;
  const body = scene.bodies[agent.body];
  context.globalAlpha = 0.25;
  if (body.corners.length === 0 && agent.looks.length === 0) {
    context.strokeStyle = agentColour(agent.index);
    context.lineWidth = 2 * body.radius * camera.scale;
    context.lineCap = "round";
    context.lineJoin = "round";
    context.beginPath();
    tracePath(context, camera, agent);
    context.stroke();
  } else {
    context.fillStyle = agentColour(agent.index);
    context.beginPath();
    for (let k = 0; k + 1 < Math.max(2, agent.xs.length); ++k)
      traceSweep(context, state, agent, scene.bodies[agent.looks[k] ?? agent.body], k);
    context.fill();
  }
  context.globalAlpha = 1;
}

/**
 * Adds what a polygon covers between two frames. All such shapes go round the same way, so that
 * filling them together gives their union.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 * @param {Agent} agent
 * @param {Body} body
 * @param {number} k
 */
function traceSweep(context, state, agent, body, k) {
  const { camera } = state;
  const last = Math.min(k + 1, agent.xs.length - 1);
  const corners = [k, last].flatMap((frame) => body.corners.map((corner) => (
    { x: agent.xs[frame] + corner.x, y: agent.ys[frame] + corner.y })));
  convexHull(corners).forEach((corner, index) => {
    const [x, y] = [camera.toPixelX(corner.x), camera.toPixelY(corner.y)];
    if (index === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  });
  context.closePath();
}
