// SPDX-License-Identifier: MIT

/** @import {Agent} from "./scene.js" */
/** @import {State} from "./state.js" */
/** @import {Strip} from "./strip.js" */
import { isPresent, positionAt } from "./motion.js";

/** A press that moves less than this many pixels is a click. */
const CLICK = 5;

/**
 * The agent at a pixel, or near it: fingers are not precise.
 * @param {State} state
 * @param {number} px
 * @param {number} py
 * @returns {Agent | null}
 */
export function agentAt(state, px, py) {
  const { scene, camera, player } = state;
  /** @type {Agent | null} */
  let best = null;
  let nearest = Infinity;
  for (const agent of scene.agents) {
    if (!isPresent(agent, player.time)) continue;
    const at = positionAt(agent, player.time);
    const away = Math.hypot(camera.toPixelX(at.x) - px, camera.toPixelY(at.y) - py);
    const reach = Math.max(scene.bodies[agent.body].radius * camera.scale, 10);
    if (away <= reach && away < nearest) [best, nearest] = [agent, away];
  }
  return best;
}

/**
 * Drag to pan, wheel or two fingers to zoom, click to select.
 * @param {State} state
 * @param {HTMLCanvasElement} canvas
 */
export function listenToMap(state, canvas) {
  /** @type {Map<number, {x: number, y: number}>} */
  const pressed = new Map();
  let travelled = 0;
  const place = (/** @type {PointerEvent | WheelEvent} */ event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const spread = () => {
    const [a, b] = [...pressed.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.max(1, Math.hypot(a.x - b.x, a.y - b.y)) };
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (pressed.size === 0) travelled = 0;
    pressed.set(event.pointerId, place(event));
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pressed.get(event.pointerId);
    if (before === undefined) return;
    const after = place(event);
    travelled += Math.hypot(after.x - before.x, after.y - before.y);
    if (pressed.size === 1 && travelled >= CLICK) {
      state.following = false;
      state.camera.pan(after.x - before.x, after.y - before.y);
      pressed.set(event.pointerId, after);
      state.changed();
    } else if (pressed.size === 2) {
      const old = spread();
      pressed.set(event.pointerId, after);
      const now = spread();
      state.camera.pan(now.x - old.x, now.y - old.y);
      state.camera.zoom(now.apart / old.apart, now.x, now.y);
      state.changed();
    }
  });
  const release = (/** @type {PointerEvent} */ event) => {
    const was = pressed.size;
    if (!pressed.delete(event.pointerId)) return;
    if (event.type === "pointercancel" || was > 1) travelled = CLICK;
    if (travelled >= CLICK) return;
    const { x, y } = place(event);
    state.select(agentAt(state, x, y)?.index ?? null);
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const { x, y } = place(event);
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    state.camera.zoom(Math.exp(-event.deltaY * lines * 0.0015), x, y);
    state.changed();
  }, { passive: false });
}

/**
 * Press or drag in the strip to go to a moment; in a row it selects the agent.
 * @param {State} state
 * @param {HTMLCanvasElement} canvas
 * @param {Strip} strip
 */
export function listenToStrip(state, canvas, strip) {
  const go = (/** @type {PointerEvent} */ event) => {
    if (event.buttons === 0) return;
    const box = canvas.getBoundingClientRect();
    state.player.pause();
    state.player.seek(strip.toTime(event.clientX - box.left));
    const agent = event.type === "pointerdown" ? strip.agentAt(event.clientY - box.top) : null;
    if (agent !== null) state.select(agent);
    state.changed();
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    go(event);
  });
  canvas.addEventListener("pointermove", go);
}
