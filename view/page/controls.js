// SPDX-License-Identifier: MIT

/** @import {State} from "./state.js" */
import { SPEEDS } from "./player.js";
import { element } from "./state.js";

/**
 * What buttons and keys can do.
 * @typedef {object} Actions
 * @property {() => void} toggle
 * @property {(direction: 1 | -1) => void} step
 * @property {(direction: 1 | -1) => void} toEnd
 * @property {(direction: 1 | -1) => void} speed
 * @property {(direction: 1 | -1) => void} violation
 * @property {(factor: number) => void} zoom
 * @property {() => void} fit
 * @property {(dx: number, dy: number) => void} pan
 * @property {(direction: 1 | -1) => void} agent
 * @property {() => void} follow
 * @property {() => void} search
 * @property {() => void} paths
 * @property {() => void} goals
 * @property {() => void} swept
 * @property {() => void} order
 * @property {() => void} heat
 * @property {() => void} alongPath
 * @property {() => void} theme
 * @property {() => void} deselect
 * @property {() => void} help
 */

/**
 * @param {State} state
 * @param {(time: number, agents: number[]) => void} jump
 * @returns {Actions}
 */
export function makeActions(state, jump) {
  const { player, camera, scene } = state;
  const change = (/** @type {() => void} */ act) => () => {
    act();
    state.changed();
  };
  return {
    toggle: change(() => player.toggle()),
    step: (direction) => change(() => player.step(direction))(),
    toEnd: (direction) => change(() => {
      player.pause();
      player.seek(direction > 0 ? scene.end : 0);
    })(),
    speed: (direction) => change(() => player.changeSpeed(direction))(),
    violation: (direction) => jumpToViolation(state, jump, direction),
    zoom: (factor) => change(() => camera.zoom(factor))(),
    fit: change(() => {
      state.following = false;
      camera.fit();
    }),
    pan: (dx, dy) => change(() => {
      state.following = false;
      camera.pan(dx, dy);
    })(),
    agent: (direction) => {
      const count = scene.agents.length;
      const from = state.selected ?? (direction > 0 ? -1 : 0);
      if (count > 0) state.select((from + direction + count) % count);
    },
    follow: change(() => { state.following = !state.following && state.selected !== null; }),
    search: () => element("search", HTMLInputElement).focus(),
    paths: change(() => { state.showPaths = !state.showPaths; }),
    goals: change(() => { state.showGoals = !state.showGoals; }),
    swept: change(() => { state.showSwept = !state.showSwept; }),
    order: change(() => { state.showOrder = !state.showOrder && scene.precedences.length > 0; }),
    heat: change(() => { state.showHeat = !state.showHeat && scene.attribution !== null; }),
    alongPath: change(() => { state.alongPath = !state.alongPath && state.selected !== null; }),
    theme: () => state.setDark(!state.dark),
    deselect: () => state.select(null),
    help: () => element("help", HTMLDialogElement).showModal(),
  };
}

/**
 * @param {State} state
 * @param {(time: number, agents: number[]) => void} jump
 * @param {1 | -1} direction
 */
function jumpToViolation(state, jump, direction) {
  const { violations } = state.scene;
  const { time } = state.player;
  const beyond = violations.filter((violation) => (violation.time - time) * direction > 0);
  beyond.sort((a, b) => (a.time - b.time) * direction);
  const next = beyond[0] ?? (direction > 0 ? violations[0] : violations[violations.length - 1]);
  if (next !== undefined) jump(next.time, next.agents);
}

/**
 * Connects the buttons.
 * @param {State} state
 * @param {Actions} actions
 */
export function listenToControls(state, actions) {
  const speed = element("speed", HTMLSelectElement);
  for (const value of SPEEDS) speed.add(new Option(`${value} ×`, String(value), value === 1, value === 1));
  speed.addEventListener("change", () => {
    state.player.speed = Number(speed.value);
    state.changed();
  });
  const time = element("time", HTMLInputElement);
  time.addEventListener("input", () => {
    state.player.pause();
    state.player.seek(Number(time.value));
    state.changed();
  });
  /** @type {[string, () => void][]} */
  const buttons = [
    ["play", actions.toggle], ["back", () => actions.step(-1)], ["forward", () => actions.step(1)],
    ["to-start", () => actions.toEnd(-1)], ["to-end", () => actions.toEnd(1)], ["fit", actions.fit],
    ["follow", actions.follow], ["paths", actions.paths], ["goals", actions.goals],
    ["swept", actions.swept], ["order", actions.order], ["heat", actions.heat],
    ["theme", actions.theme], ["strip-mode", actions.alongPath],
    ["deselect", actions.deselect], ["help-open", actions.help],
  ];
  for (const [id, act] of buttons) element(id, HTMLButtonElement).addEventListener("click", act);
  listenToSearch(state);
}

/** @param {State} state */
function listenToSearch(state) {
  const input = element("search", HTMLInputElement);
  const answer = element("search-answer", HTMLElement);
  element("search-form", HTMLFormElement).addEventListener("submit", (event) => {
    event.preventDefault();
    answer.textContent = find(state, input.value.trim());
  });
}

/**
 * Looks for an agent by its number or name, or for those that begin or end at a place.
 * @param {State} state
 * @param {string} text
 * @returns {string} what was found
 */
export function find(state, text) {
  const { scene } = state;
  const factor = scene.lengthUnit;
  const place = text.match(/^\(?\s*(-?[\d.]+)\s*,\s*(-?[\d.]+)\s*\)?$/);
  if (place !== null) {
    const at = { x: Number(place[1]) / factor, y: Number(place[2]) / factor };
    const near = (/** @type {{x: number, y: number}} */ p) =>
      Math.hypot(p.x - at.x, p.y - at.y) * factor < 0.01;
    const here = scene.agents.filter((agent) => near(agent.start) || near(agent.goal));
    state.camera.centreOn(at);
    state.select(here[0]?.index ?? state.selected);
    if (here.length === 0) return "no agent starts or ends there";
    const what = (/** @type {typeof here[0]} */ agent) => (near(agent.start) ? "starts" : "ends");
    return here.map((agent) => `${agent.name} ${what(agent)} there`).join(", ");
  }
  const called = scene.agents.findIndex((agent) => agent.name === text);
  const index = called >= 0 ? called : /^\d+$/.test(text) ? Number(text) : NaN;
  if (!(index < scene.agents.length))
    {return scene.agents.length === 0 ? "there are no agents"
      : `'${text}' is none of the agents 0 to ${scene.agents.length - 1}`;}
  state.select(index);
  return scene.agents[index].name;
}

/**
 * Makes buttons and fields show the state.
 * @param {State} state
 */
export function updateControls(state) {
  const { player, scene } = state;
  const play = element("play", HTMLButtonElement);
  writeText(play, player.playing ? "||" : "▶");
  writeAttribute(play, "aria-label", player.playing ? "Pause" : "Play");
  const time = element("time", HTMLInputElement);
  writeAttribute(time, "max", String(scene.end));
  time.value = String(player.time);
  const now = state.showMoment(player.time), end = state.showMoment(scene.end);
  time.setAttribute("aria-valuetext", `${now} of ${end}`);
  element("clock", HTMLElement).textContent = `${now} / ${end}`;
  element("speed", HTMLSelectElement).value = String(player.speed);
  /** @type {[string, boolean][]} */
  const pressed = [
    ["follow", state.following], ["paths", state.showPaths], ["goals", state.showGoals],
    ["swept", state.showSwept], ["order", state.showOrder], ["heat", state.showHeat],
    ["theme", state.dark], ["strip-mode", state.alongPath],
  ];
  for (const [id, on] of pressed) writeAttribute(element(id, HTMLElement), "aria-pressed", String(on));
  for (const id of ["follow", "swept", "strip-mode"])
    element(id, HTMLButtonElement).disabled = state.selected === null;
}

// What is written again costs the browser a look at the whole page, even if nothing is different.

/**
 * @param {HTMLElement} target
 * @param {string} text
 */
function writeText(target, text) {
  if (target.textContent !== text) target.textContent = text;
}

/**
 * @param {HTMLElement} target
 * @param {string} name
 * @param {string} value
 */
function writeAttribute(target, name, value) {
  if (target.getAttribute(name) !== value) target.setAttribute(name, value);
}
