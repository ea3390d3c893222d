// SPDX-License-Identifier: MIT

/** @import {Body, Point, Scene} from "./scene.js" */
import { bodyAt, isPresent, positionAt } from "./motion.js";

/**
 * Two bodies touch where the second one's position, as seen from the first one, is `radius` away from
 * the convex polygon `core`: the sum of the first and the mirror image of the second.
 * @typedef {{core: Point[], radius: number, reach: number}} Contact
 */

/**
 * @param {Body} a
 * @param {Body} b
 * @returns {Contact}
 */
export function contactOf(a, b) {
  const first = a.corners.length > 0 ? a.corners : [{ x: 0, y: 0 }];
  const second = b.corners.length > 0 ? b.corners : [{ x: 0, y: 0 }];
  const sums = first.flatMap((p) => second.map((q) => ({ x: p.x - q.x, y: p.y - q.y })));
  const radius = (a.corners.length > 0 ? 0 : a.radius) + (b.corners.length > 0 ? 0 : b.radius);
  return { core: convexHull(sums), radius, reach: a.radius + b.radius };
}

/**
 * Counter-clockwise where y goes up; the monotone chain.
 * @param {Point[]} points
 * @returns {Point[]}
 */
export function convexHull(points) {
  const sorted = [...points].sort((p, q) => p.x - q.x || p.y - q.y);
  const chain = (/** @type {Point[]} */ list) => {
    /** @type {Point[]} */
    const hull = [];
    for (const point of list) {
      while (hull.length > 1 && side(hull[hull.length - 2], hull[hull.length - 1], point) <= 0)
        hull.pop();
      hull.push(point);
    }
    hull.pop();
    return hull;
  };
  const hull = [...chain(sorted), ...chain(sorted.reverse())];
  return hull.length > 0 ? hull : [points[0]];
}

/**
 * Positive when c is to the left of the line from a to b.
 * @param {Point} a
 * @param {Point} b
 * @param {Point} c
 * @returns {number}
 */
function side(a, b, c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/**
 * The free space between the two; negative when they overlap: by as much one has to be moved.
 * @param {Contact} contact
 * @param {number} x  of the second one, as seen from the first one
 * @param {number} y
 * @param {number} z  0 for a polygon: it is flat
 * @returns {number}
 */
export function gapOf(contact, x, y, z) {
  const { core, radius } = contact;
  if (core.length === 1) return Math.hypot(x - core[0].x, y - core[0].y, z) - radius;
  let nearest = Infinity;
  let inside = true;
  for (let i = 0; i < core.length; ++i) {
    const p = core[i];
    const q = core[(i + 1) % core.length];
    const [ex, ey, px, py] = [q.x - p.x, q.y - p.y, x - p.x, y - p.y];
    const share = Math.min(1, Math.max(0, (ex * px + ey * py) / (ex * ex + ey * ey)));
    nearest = Math.min(nearest, Math.hypot(px - share * ex, py - share * ey));
    if (ex * py - ey * px < 0) inside = false;
  }
  return (inside ? -nearest : nearest) - radius;
}

/** The clearances of one scene. */
export class Clearances {
  /** @param {Scene} scene */
  constructor(scene) {
    this.scene = scene;
    /** @type {Map<number, Contact>} */
    this.contacts = new Map();
    this.largest = Math.max(0, ...scene.bodies.map((body) => body.radius));
  }

  /**
   * Of two agents at a time.
   * @param {number} i
   * @param {number} j
   * @param {number} time
   * @returns {Contact}
   */
  contact(i, j, time) {
    const { agents, bodies } = this.scene;
    const [a, b] = [bodyAt(agents[i], time), bodyAt(agents[j], time)];
    const key = a * bodies.length + b;
    let contact = this.contacts.get(key);
    if (!contact) {
      contact = contactOf(bodies[a], bodies[b]);
      this.contacts.set(key, contact);
    }
    return contact;
  }

  /**
   * Of two agents at a time; infinite when one of them is gone.
   * @param {number} i
   * @param {number} j
   * @param {number} time
   * @returns {number}
   */
  between(i, j, time) {
    if (!isPresent(this.scene.agents[i], time) || !isPresent(this.scene.agents[j], time)) return Infinity;
    const p = positionAt(this.scene.agents[i], time);
    const q = positionAt(this.scene.agents[j], time);
    return gapOf(this.contact(i, j, time), q.x - p.x, q.y - p.y, q.z - p.z);
  }

  /**
   * The pair that is nearest at a time, or null for fewer than two agents with paths. A sweep from
   * left to right: agents that are further apart in x than the best gap so far need no look.
   * @param {number} time
   * @returns {{agents: [number, number], gap: number} | null}
   */
  leastAt(time) {
    const here = this.scene.agents.filter((agent) => agent.times.length > 0 && isPresent(agent, time));
    const items = here.map((agent) => {
      const { x, y, z } = positionAt(agent, time);
      return { x, y, z, index: agent.index, radius: this.scene.bodies[bodyAt(agent, time)].radius };
    });
    items.sort((a, b) => a.x - b.x || a.index - b.index);
    /** @type {{agents: [number, number], gap: number} | null} */
    let best = null;
    let gap = Infinity;
    for (let a = 0; a < items.length; ++a) {
      const p = items[a];
      for (let b = a + 1; b < items.length; ++b) {
        const q = items[b];
        if (q.x - p.x - p.radius - this.largest > gap) break;
        const [i, j] = p.index < q.index ? [p, q] : [q, p];
        const own = gapOf(this.contact(i.index, j.index, time), j.x - i.x, j.y - i.y, j.z - i.z);
        if (own < gap) {
          gap = own;
          best = { agents: [i.index, j.index], gap };
        }
      }
    }
    return best;
  }

  /**
   * All pairs that overlap by more than a length unit.
   * @param {number} time
   * @returns {[number, number][]}
   */
  overlapsAt(time) {
    const suspects = new Set();
    for (const { agents, gap } of this.scene.nearest)
      if (gap < 0) suspects.add(agents[0] * this.scene.agents.length + agents[1]);
    for (const { agents } of this.scene.violations)
      if (agents.length > 1) suspects.add(agents[0] * this.scene.agents.length + agents[1]);
    /** @type {[number, number][]} */
    const found = [];
    for (const key of suspects) {
      const i = Math.floor(key / this.scene.agents.length);
      const j = key % this.scene.agents.length;
      if (this.between(i, j, time) < 0) found.push([i, j]);
    }
    return found;
  }
}
