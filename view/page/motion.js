// SPDX-License-Identifier: MIT

/** @import {Agent, Obstacle, Place, Scene} from "./scene.js" */

/**
 * The last frame of the path that is not after the time; -1 before the first one. Binary search.
 * @param {Agent | Obstacle} agent
 * @param {number} time
 * @returns {number}
 */
export function frameAt(agent, time) {
  const { times } = agent;
  let low = -1;
  let high = times.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

/**
 * Where an agent is: at its start without a path, at the end of its path for ever.
 * @param {Agent} agent
 * @param {number} time
 * @returns {Place}
 */
export function positionAt(agent, time) {
  const { times } = agent;
  if (times.length === 0) return { ...agent.start };
  return placeOn(agent, time);
}

/**
 * Its body then, into Scene.bodies.
 * @param {Agent} agent
 * @param {number} time
 * @returns {number}
 */
export function bodyAt(agent, time) {
  if (agent.looks.length === 0) return agent.body;
  return agent.looks[Math.max(0, frameAt(agent, time))];
}

/**
 * Where it faces then, in degrees; null if it has no headings. It turns the shorter way round.
 * @param {Agent} agent
 * @param {number} time
 * @returns {number | null}
 */
export function headingAt(agent, time) {
  const { times, headings } = agent;
  if (headings.length === 0) return null;
  const k = Math.max(0, frameAt(agent, time));
  if (k + 1 === times.length || time <= times[k]) return headings[k];
  const share = (time - times[k]) / (times[k + 1] - times[k]);
  const turn = headings[k + 1] - headings[k];
  return headings[k] + (turn - 360 * Math.round(turn / 360)) * share;
}

/**
 * Whether it is anywhere: one that leaves is at its goal for a moment only.
 * @param {Agent} agent
 * @param {number} time
 */
export function isPresent(agent, time) {
  return !agent.leaves || agent.cost === null || time <= agent.cost;
}

/**
 * Where a moving obstacle is, if it is anywhere.
 * @param {Obstacle} obstacle
 * @param {number} time
 * @returns {Place | null}
 */
export function obstacleAt(obstacle, time) {
  const { times, leaves } = obstacle;
  if (time < times[0] || (leaves && time > times[times.length - 1])) return null;
  return placeOn(obstacle, time);
}

/**
 * @param {Agent | Obstacle} mover  with at least one frame
 * @param {number} time
 * @returns {Place}
 */
function placeOn(mover, time) {
  const { times, xs, ys, zs } = mover;
  const k = Math.max(0, frameAt(mover, time));
  if (k + 1 === times.length || time <= times[k]) return { x: xs[k], y: ys[k], z: zs[k] };
  const share = (time - times[k]) / (times[k + 1] - times[k]);
  return {
    x: xs[k] + (xs[k + 1] - xs[k]) * share, y: ys[k] + (ys[k + 1] - ys[k]) * share,
    z: zs[k] + (zs[k + 1] - zs[k]) * share,
  };
}

/**
 * Whether it stands between a frame and the next one.
 * @param {Agent} agent
 * @param {number} k
 */
function stands({ xs, ys, zs }, k) {
  return xs[k] === xs[k + 1] && ys[k] === ys[k + 1] && zs[k] === zs[k + 1];
}

/**
 * What an agent does at a time.
 * @param {Agent} agent
 * @param {number} time
 * @returns {"no path" | "waits" | "moves" | "arrived"}
 */
export function activityAt(agent, time) {
  const { times } = agent;
  if (times.length === 0) return "no path";
  const k = Math.max(0, frameAt(agent, time));
  if (agent.cost === null || k + 1 === times.length || time >= agent.cost) return "arrived";
  return stands(agent, k) ? "waits" : "moves";
}

/**
 * How long the agent stands before it has arrived.
 * @param {Agent} agent
 * @returns {number}
 */
export function totalWait(agent) {
  let total = 0;
  for (let k = 0; k + 1 < agent.times.length; ++k)
    {if (stands(agent, k))
      total += Math.max(0, Math.min(agent.times[k + 1], agent.cost ?? 0) - agent.times[k]);}
  return total;
}

/**
 * The moments at which anything begins or ends, in order, without repetitions.
 * @param {Scene} scene
 * @returns {Float64Array}
 */
export function eventTimes(scene) {
  const all = new Set([0]);
  for (const agent of scene.agents) for (const time of agent.times) all.add(time);
  return Float64Array.from(all).sort();
}

/**
 * The next moment of `events` after `time`, or the last one before it; `time` where there is none.
 * @param {Float64Array} events
 * @param {number} time
 * @param {1 | -1} direction
 * @returns {number}
 */
export function neighbouringEvent(events, time, direction) {
  let low = 0;
  let high = events.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (direction > 0 ? events[middle] <= time : events[middle] < time) low = middle + 1;
    else high = middle;
  }
  const found = direction > 0 ? low : low - 1;
  return found >= 0 && found < events.length ? events[found] : time;
}
