// SPDX-License-Identifier: MIT

/** @import {Agent, Point} from "./scene.js" */
/** @import {State} from "./state.js" */
import { agentsName } from "./attribution.js";
import { activityAt, positionAt, totalWait } from "./motion.js";
import { openPrecedences } from "./precedences.js";
import { element } from "./state.js";

/** So many entries of a list at a time: a page with many thousands at once would be slow. */
const MOST_LISTED = 300;

/**
 * @param {State} state
 * @param {Point} point
 * @returns {string}
 */
export function placeName(state, point) {
  const { scene } = state;
  const factor = scene.lengthUnit;
  const round = (/** @type {number} */ value) => String(Number((value * factor).toFixed(3)));
  const height = scene.heights ? `, height ${round(point.z ?? 0)}` : "";
  if (scene.hasLayout) return `(${round(point.x)}, ${round(point.y)})${height}`;
  const index = scene.places.findIndex((place) => place.x === point.x && place.y === point.y);
  return index >= 0 ? `vertex ${index}` : "on its way";
}

/**
 * The line under the title.
 * @param {State} state
 * @returns {string}
 */
export function summaryOf(state) {
  const { scene } = state;
  const parts = [`${scene.agents.length} ${scene.agents.length === 1 ? "agent" : "agents"}`];
  if (scene.obstacles.length > 0)
    parts.push(`${scene.obstacles.length} moving ${scene.obstacles.length === 1 ? "obstacle" : "obstacles"}`);
  if (scene.obstruction !== null) parts.push("no plan exists");
  else if (scene.violations.length > 0)
    parts.push(`${scene.violations.length} ${scene.violations.length === 1 ? "violation" : "violations"}`);
  else
    parts.push(`sum of costs ${state.show(scene.sumOfCosts)}`, `makespan ${state.show(scene.makespan)}`);
  if (scene.status !== null) parts.push(scene.status);
  if (scene.obstruction === null && scene.lowerBound !== null && scene.status !== "optimal")
    parts.push(`lower bound ${state.show(scene.lowerBound)} (${scene.objective})`);
  if (!scene.hasLayout) parts.push("positions are made up");
  if (scene.heights) parts.push("seen from above");
  if (scene.hiddenLinks > 0) parts.push(`${scene.hiddenLinks} edges not shown`);
  return parts.join(" · ");
}

/** The lists and facts beside the map. */
export class Panel {
  /**
   * @param {State} state
   * @param {(time: number, agents: number[]) => void} jump
   */
  constructor(state, jump) {
    this.state = state;
    this.jump = jump;
    this.agentSection = element("agent", HTMLElement);
    this.facts = element("agent-facts", HTMLElement);
    this.agentTitle = element("agent-title", HTMLElement);
    this.clearance = element("clearance-now", HTMLElement);
    element("summary", HTMLElement).textContent = summaryOf(state);
    this.showObstruction();
    this.listViolations();
    this.listNearest();
    this.listDelays();
  }

  /**
   * @param {string} section
   * @param {string} list
   * @param {{text: string, time: number, agents: number[]}[]} entries
   */
  fill(section, list, entries) {
    element(section, HTMLElement).hidden = entries.length === 0;
    this.append(element(list, HTMLElement), entries);
  }

  /**
   * The first entries, and a button for the others.
   * @param {HTMLElement} parent
   * @param {{text: string, time: number, agents: number[]}[]} entries
   */
  append(parent, entries) {
    const add = (/** @type {string} */ text, /** @type {() => void} */ action) => {
      const button = document.createElement("button");
      button.textContent = text;
      button.addEventListener("click", action);
      const item = document.createElement("li");
      item.append(button);
      parent.append(item);
      return item;
    };
    for (const entry of entries.slice(0, MOST_LISTED))
      add(entry.text, () => this.jump(entry.time, entry.agents));
    if (entries.length <= MOST_LISTED) return;
    const rest = add(`${entries.length - MOST_LISTED} more`, () => {
      rest.remove();
      this.append(parent, entries.slice(MOST_LISTED));
    });
  }

  showObstruction() {
    const { state } = this;
    const { obstruction, agents } = state.scene;
    if (obstruction === null) return;
    element("obstruction-text", HTMLElement).textContent = `${obstruction.reason}.`;
    this.fill("obstruction", "obstruction-list", obstruction.agents.map((index) => {
      const { name, start, goal } = agents[index];
      const text = `${name}: ${placeName(state, start)} to ${placeName(state, goal)}`;
      return { text, time: 0, agents: [index] };
    }));
    element("obstruction", HTMLElement).hidden = false;
  }

  listViolations() {
    const { state } = this;
    const { violations } = state.scene;
    element("violations-title", HTMLElement).textContent = `Violations (${violations.length})`;
    const inOrder = [...violations].sort((a, b) => a.time - b.time);
    this.fill("violations", "violation-list", inOrder.map((violation) => ({
      text: `${state.showMoment(violation.time)}  ${violation.kind}: ${violation.message}`,
      time: violation.time, agents: violation.agents,
    })));
  }

  listNearest() {
    const { state } = this;
    if (!state.scene.continuous) return;
    const { lengthUnit } = state.scene;
    this.fill("nearest", "nearest-list", state.scene.nearest.map(({ agents, gap, time }) => {
      const names = agentsName(state.scene, agents, " and ");
      const text = `${showGap(gap * lengthUnit)}  ${names} at ${state.showMoment(time)}`;
      return { text, time, agents: [...agents] };
    }));
  }

  listDelays() {
    const { state } = this;
    const delayed = state.scene.agents.filter((agent) => delayOf(agent) > 0)
      .sort((a, b) => delayOf(b) - delayOf(a) || a.index - b.index);
    this.fill("delays", "delay-list", delayed.map((agent) => ({
      text: `+${state.show(delayOf(agent))}  ${agent.name}`,
      time: state.player.time, agents: [agent.index],
    })));
  }

  /** What depends on the moment and on the selection. */
  update() {
    const { state } = this;
    const { player, scene } = state;
    if (scene.continuous && scene.nearest.length > 0) {
      const least = state.clearances.leastAt(player.time);
      this.clearance.textContent = least === null ? "none"
        : `${showGap(least.gap * scene.lengthUnit)}, ${agentsName(scene, least.agents, " and ")}`;
    }
    const agent = state.agent();
    this.agentSection.hidden = agent === null;
    if (agent === null) return;
    this.agentTitle.textContent = agent.name[0].toUpperCase() + agent.name.slice(1);
    this.showFacts(agent);
  }

  /** @param {Agent} agent */
  showFacts(agent) {
    const { state } = this;
    const { scene, player } = state;
    /** @type {[string, string][]} */
    const facts = [
      ["start", placeName(state, agent.start)],
      ["goal", placeName(state, agent.goal)],
      ...otherGoals(state, agent),
      ["cost", agent.cost === null ? "no path" : state.show(agent.cost)],
      ["free cost", agent.free === null ? "no way to the goal" : state.show(agent.free)],
    ];
    if (agent.cost !== null && agent.free !== null)
      facts.push(["delay", state.show(agent.cost - agent.free)]);
    facts.push(["waits", state.show(totalWait(agent))]);
    if (scene.continuous) facts.push(["body", bodyName(state, agent)]);
    facts.push(...orderFacts(state, agent));
    const activity = activityAt(agent, player.time);
    facts.push(["now", `${activity}, ${placeName(state, positionAt(agent, player.time))}`]);
    this.facts.replaceChildren(...facts.flatMap(([name, value]) => {
      const term = document.createElement("dt");
      term.textContent = name;
      const text = document.createElement("dd");
      text.textContent = value;
      return [term, text];
    }));
  }
}

/**
 * Where else the agent may end: the first few.
 * @param {State} state
 * @param {Agent} agent
 * @returns {[string, string][]}
 */
function otherGoals(state, { otherGoals: goals }) {
  if (goals.length === 0) return [];
  const shown = goals.slice(0, 3).map((goal) => placeName(state, goal));
  const rest = goals.length - shown.length;
  return [["or goal", shown.join(" or ") + (rest > 0 ? ` or ${rest} more` : "")]];
}

/**
 * Whom the agent still has to let go first, and who has to wait for it.
 * @param {State} state
 * @param {Agent} agent
 * @returns {[string, string][]}
 */
function orderFacts(state, agent) {
  const open = openPrecedences(state.scene.precedences, agent.index, state.player.time);
  const names = (/** @type {number[]} */ agents) => agentsName(state.scene, [...new Set(agents)]);
  const before = open.filter(({ follower }) => follower === agent.index).map(({ leader }) => leader);
  const after = open.filter(({ leader }) => leader === agent.index).map(({ follower }) => follower);
  /** @type {[string, string][]} */
  const facts = [];
  if (before.length > 0) facts.push(["after", names(before)]);
  if (after.length > 0) facts.push(["before", names(after)]);
  return facts;
}

/**
 * @param {number} gap
 * @returns {string}
 */
function showGap(gap) {
  return gap !== 0 && Math.abs(gap) < 0.001 ? gap.toExponential(2) : String(Number(gap.toFixed(4)));
}

/**
 * @param {Agent} agent
 * @returns {number}
 */
function delayOf(agent) {
  return agent.cost === null || agent.free === null ? 0 : agent.cost - agent.free;
}

/**
 * @param {State} state
 * @param {Agent} agent
 * @returns {string}
 */
function bodyName(state, agent) {
  const body = state.scene.bodies[agent.body];
  if (body.corners.length > 0) return `polygon with ${body.corners.length} corners`;
  const radius = Number((body.radius * state.scene.lengthUnit).toPrecision(6));
  return `${state.scene.heights ? "sphere" : "disc"} of radius ${radius}`;
}
