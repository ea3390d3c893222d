// SPDX-License-Identifier: MIT

/** @import {State} from "./state.js" */

/**
 * What a link to a moment says: "#t=12.4&a=7".
 * @param {string} hash
 * @returns {{time: number | null, agent: number | null}}
 */
export function readLink(hash) {
  const values = new URLSearchParams(hash.replace(/^#/, ""));
  const number = (/** @type {string} */ key) => {
    const text = values.get(key);
    const value = text === null || text.trim() === "" ? NaN : Number(text);
    return Number.isFinite(value) ? value : null;
  };
  return { time: number("t"), agent: number("a") };
}

/**
 * @param {State} state
 * @returns {string}
 */
export function linkOf(state) {
  const time = Number(((state.scene.now + state.player.time) * state.scene.unit).toPrecision(12));
  return `#t=${time}` + (state.selected === null ? "" : `&a=${state.selected}`);
}

/**
 * Goes where the page's address says.
 * @param {State} state
 */
export function followLink(state) {
  const { time, agent } = readLink(window.location.hash);
  if (time !== null) {
    state.player.pause();
    state.player.seek(time / state.scene.unit - state.scene.now);
  }
  if (agent !== null) state.select(agent);
  state.changed();
}

/** Browsers refuse a page that changes its address all the time, and it is slow. In milliseconds. */
const LINK_PAUSE = 200;
let linkIsDue = false;

/**
 * Makes the page's address a link to what is shown, soon. A page inside of another one may have no
 * address.
 * @param {State} state
 */
export function updateLink(state) {
  if (state.player.playing || linkIsDue) return;
  linkIsDue = true;
  window.setTimeout(() => {
    linkIsDue = false;
    const link = linkOf(state);
    if (state.player.playing || window.location.hash === link) return;
    try {
      window.history.replaceState(null, "", link);
    } catch {
      // No address, no link.
    }
  }, LINK_PAUSE);
}
