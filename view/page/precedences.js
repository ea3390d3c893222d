// SPDX-License-Identifier: MIT

/** @import {Precedence} from "./scene.js" */
/** @import {State} from "./state.js" */
import { positionAt } from "./motion.js";

/** More arrows than the next few would hide the map. */
const MOST_ARROWS = 4;

/**
 * Who has to wait for the agent and for whom it has to wait, what comes first first.
 * @param {Precedence[]} list
 * @param {number} agent
 * @param {number} time
 * @returns {Precedence[]} those whose leader has not ended its move by then
 */
export function openPrecedences(list, agent, time) {
  return list
    .filter(({ leader, follower, leaderEnd }) =>
      (leader === agent || follower === agent) && leaderEnd > time)
    .sort((a, b) => a.followerBegin - b.followerBegin || a.leader - b.leader || a.follower - b.follower);
}

/**
 * Arrows from those who go first to those who follow, for what the selected agent does next.
 * @param {CanvasRenderingContext2D} context
 * @param {State} state
 */
export function drawPrecedences(context, state) {
  const { scene, player, camera, selected, theme } = state;
  if (selected === null) return;
  context.strokeStyle = theme.text;
  context.fillStyle = theme.text;
  context.lineWidth = 1.5;
  const open = openPrecedences(scene.precedences, selected, player.time);
  for (const { leader, follower } of open.slice(0, MOST_ARROWS)) {
    const from = positionAt(scene.agents[leader], player.time);
    const to = positionAt(scene.agents[follower], player.time);
    drawOrder(context, [camera.toPixelX(from.x), camera.toPixelY(from.y)],
      [camera.toPixelX(to.x), camera.toPixelY(to.y)]);
  }
}

/**
 * An arrow with its head beyond the middle.
 * @param {CanvasRenderingContext2D} context
 * @param {[number, number]} from
 * @param {[number, number]} to
 */
function drawOrder(context, [ax, ay], [bx, by]) {
  const length = Math.hypot(bx - ax, by - ay);
  if (length < 12) return;
  const [ux, uy] = [(bx - ax) / length, (by - ay) / length];
  context.beginPath();
  context.moveTo(ax, ay);
  context.lineTo(bx, by);
  context.stroke();
  const [x, y] = [ax + 0.6 * (bx - ax), ay + 0.6 * (by - ay)];
  context.beginPath();
  context.moveTo(x + 7 * ux, y + 7 * uy);
  context.lineTo(x - 4 * uy, y + 4 * ux);
  context.lineTo(x + 4 * uy, y - 4 * ux);
  context.fill();
}
