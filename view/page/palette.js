// SPDX-License-Identifier: MIT

/** Okabe and Ito's colours, which people see apart whatever their kind of colour vision. */
export const AGENT_COLOURS = [
  "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#f0e442", "#8c8c8c",
];

/**
 * @param {number} index
 * @returns {string}
 */
export function agentColour(index) {
  return AGENT_COLOURS[index % AGENT_COLOURS.length];
}

/**
 * Black or white, whichever is easier to read on the colour of this agent.
 * @param {number} index
 * @returns {string}
 */
export function labelColour(index) {
  const hex = parseInt(agentColour(index).slice(1), 16);
  const brightness = 0.299 * (hex >> 16) + 0.587 * ((hex >> 8) & 255) + 0.114 * (hex & 255);
  return brightness > 125 ? "#000000" : "#ffffff";
}

/**
 * What the style sheet says for the theme that is on.
 * @typedef {{page: string, text: string, faint: string, line: string, free: string,
 *   blocked: string, road: string, alarm: string, panel: string}} Theme
 * @returns {Theme}
 */
export function currentTheme() {
  const style = getComputedStyle(document.documentElement);
  const value = (/** @type {string} */ name) => style.getPropertyValue("--" + name).trim();
  return {
    page: value("page"), text: value("text"), faint: value("faint"), line: value("line"),
    free: value("free"), blocked: value("blocked"), road: value("road"), alarm: value("alarm"),
    panel: value("panel"),
  };
}
