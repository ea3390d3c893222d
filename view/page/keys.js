// SPDX-License-Identifier: MIT

/** @import {Actions} from "./controls.js" */

/**
 * Keys, what the help says, and what they do.
 * @param {Actions} actions
 * @returns {{keys: string[], name: string, text: string, act: () => void}[]}
 */
function bindings(actions) {
  return [
    { keys: [" ", "k"], name: "space", text: "play or pause", act: actions.toggle },
    { keys: ["ArrowRight"], name: "→", text: "one step forward", act: () => actions.step(1) },
    { keys: ["ArrowLeft"], name: "←", text: "one step back", act: () => actions.step(-1) },
    { keys: ["Home"], name: "Home", text: "to the start", act: () => actions.toEnd(-1) },
    { keys: ["End"], name: "End", text: "to the end", act: () => actions.toEnd(1) },
    { keys: ["]"], name: "]", text: "faster", act: () => actions.speed(1) },
    { keys: ["["], name: "[", text: "slower", act: () => actions.speed(-1) },
    { keys: ["n"], name: "n", text: "next violation", act: () => actions.violation(1) },
    { keys: ["N"], name: "N", text: "previous violation", act: () => actions.violation(-1) },
    { keys: ["+", "="], name: "+", text: "zoom in", act: () => actions.zoom(1.25) },
    { keys: ["-"], name: "-", text: "zoom out", act: () => actions.zoom(0.8) },
    { keys: ["0"], name: "0", text: "show everything", act: actions.fit },
    { keys: ["a"], name: "a", text: "left", act: () => actions.pan(60, 0) },
    { keys: ["d"], name: "d", text: "right", act: () => actions.pan(-60, 0) },
    { keys: ["w"], name: "w", text: "up", act: () => actions.pan(0, 60) },
    { keys: ["s"], name: "s", text: "down", act: () => actions.pan(0, -60) },
    { keys: ["."], name: ".", text: "next agent", act: () => actions.agent(1) },
    { keys: [","], name: ",", text: "previous agent", act: () => actions.agent(-1) },
    { keys: ["f"], name: "f", text: "follow the selected agent", act: actions.follow },
    { keys: ["/"], name: "/", text: "find an agent", act: actions.search },
    { keys: ["p"], name: "p", text: "show all paths", act: actions.paths },
    { keys: ["g"], name: "g", text: "show starts and goals", act: actions.goals },
    { keys: ["b"], name: "b", text: "show what the selected agent sweeps", act: actions.swept },
    { keys: ["o"], name: "o", text: "show who goes before and after the selected agent", act: actions.order },
    { keys: ["h"], name: "h", text: "show where agents are in each other's way", act: actions.heat },
    { keys: ["v"], name: "v", text: "strip: waits, or along the selected path", act: actions.alongPath },
    { keys: ["t"], name: "t", text: "dark or light", act: actions.theme },
    { keys: ["Escape"], name: "Esc", text: "select no agent", act: actions.deselect },
    { keys: ["?"], name: "?", text: "this list", act: actions.help },
  ];
}

/**
 * @param {Actions} actions
 * @param {HTMLElement} help  a list of definitions, which is filled
 */
export function listenToKeys(actions, help) {
  const list = bindings(actions);
  for (const { name, text } of list) {
    const term = document.createElement("dt");
    const key = document.createElement("kbd");
    key.textContent = name;
    term.append(key);
    const description = document.createElement("dd");
    description.textContent = text;
    help.append(term, description);
  }
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isTaken(event)) return;
    const binding = list.find(({ keys }) => keys.includes(event.key));
    if (binding === undefined) return;
    event.preventDefault();
    binding.act();
  });
}

/**
 * Whether the key belongs to what has the focus.
 * @param {KeyboardEvent} event
 * @returns {boolean}
 */
function isTaken(event) {
  const { target, key } = event;
  if (document.querySelector("dialog[open]")) return true;
  if (target instanceof HTMLInputElement && target.type === "search") {
    if (key === "Escape") target.blur();
    return true;
  }
  if (target instanceof HTMLSelectElement) return true;
  return target instanceof HTMLButtonElement && key === " ";
}
