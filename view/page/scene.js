// SPDX-License-Identifier: MIT

/**
 * Times are in timesteps or ticks, positions in cells or length units.
 *
 * @typedef {{x: number, y: number, z?: number}} Point  z: the height, where the scene has heights
 * @typedef {{x: number, y: number, z: number}} Place
 * @typedef {{radius: number, corners: Point[], centre: Point}} Body  A polygon has corners, and the
 *   radius of the disc around the agent's position that contains it; its centre need not be there.
 * @typedef {object} Agent
 * @property {number} index
 * @property {string} name     "agent 3", or what it is called
 * @property {Place} start
 * @property {Place} goal
 * @property {number} body       into Scene.bodies; of one whose body changes that at its start
 * @property {number[]} looks    of one whose body changes: that from each of the times on
 * @property {number[]} headings where it faces at each of the times, in degrees from the axis of x towards
 *   that of y; none if it has no headings
 * @property {number | null} free   what it costs alone
 * @property {number | null} cost   null without a path
 * @property {Float64Array} times  of the ends of all moves and waits, in order
 * @property {Float64Array} xs     where it is then
 * @property {Float64Array} ys
 * @property {Float64Array} zs
 * @property {boolean} leaves   it is nowhere after its arrival
 * @property {Place[]} otherGoals   where it may end, too
 *
 * A body of others on a known path, nowhere before the first time, and if it leaves nowhere after the last.
 * @typedef {{body: number, leaves: boolean, times: Float64Array, xs: Float64Array, ys: Float64Array,
 *   zs: Float64Array}} Obstacle
 *
 * @typedef {{kind: string, agents: number[], time: number, message: string}} Violation
 * @typedef {{agents: [number, number], gap: number, time: number}} Nearness
 * @typedef {{width: number, height: number, pitch: number, passable: Uint8Array}} Cells
 *
 * Why no plan is cheaper: the lower bound is the free costs and all raises. Of a site, where two
 * agents are in each other's way, each line is points of the map; end is null for ever.
 * @typedef {{amount: number, agents: number[]}} Raise
 * @typedef {{agents: number[], lines: Point[][], begin: number, end: number | null, lemmas: number}} Site
 * @typedef {{freeBound: number, lowerBound: number, raises: Raise[], sites: Site[]}} Attribution
 *
 * Why there is no plan: the agents that the reason names, and the place, in the order of the way.
 * @typedef {{reason: string, agents: number[], points: Point[]}} Obstruction
 *
 * The leader has ended its move before the follower gets further than the slack behind it.
 * @typedef {{leader: number, leaderBegin: number, leaderEnd: number, follower: number,
 *   followerBegin: number, followerEnd: number, slack: number}} Precedence
 *
 * @typedef {object} Scene
 * @property {string} title
 * @property {boolean} continuous
 * @property {boolean} hasLayout
 * @property {boolean} yUp
 * @property {boolean} heights    bodies are spheres in space, seen from above
 * @property {number} unit        a tick or timestep, as the user counts time
 * @property {number} lengthUnit  a length unit, as the user counts lengths
 * @property {number} end         when the last agent arrives
 * @property {string} objective
 * @property {string | null} status
 * @property {number | null} lowerBound
 * @property {number} sumOfCosts
 * @property {number} makespan
 * @property {number} now         when the plan begins; all other times count from there
 * @property {Cells | null} cells
 * @property {Point[]} places     vertices of a roadmap or graph
 * @property {number[]} links     pairs of places
 * @property {number[]} oneWay    pairs of places, from and to
 * @property {number} hiddenLinks
 * @property {Body[]} bodies
 * @property {Agent[]} agents
 * @property {Obstacle[]} obstacles
 * @property {Violation[]} violations
 * @property {Nearness[]} nearest
 * @property {Attribution | null} attribution
 * @property {Obstruction | null} obstruction
 * @property {Precedence[]} precedences
 * @property {{left: number, top: number, right: number, bottom: number}} box
 */

const STEP = { R: [1, 0], L: [-1, 0], D: [0, 1], U: [0, -1], ".": [0, 0] };

/**
 * Reads the data of the page. Throws an Error that says what is wrong with them.
 * @param {string} text
 * @returns {Scene}
 */
export function readScene(text) {
  const data = parse(text);
  if (data.quadrille !== "scene") throw new Error("the data of this page are not those of a plan");
  if (data.version !== 1)
    throw new Error(`the data of this page are of version ${data.version}, and it reads version 1`);
  if (!Array.isArray(data.agents)) throw new Error("the data of this page name no agents");
  const bodies = readBodies(data.bodies ?? []);
  const names = data.names ?? [];
  const agents = data.agents.map((/** @type {any} */ agent, /** @type {number} */ index) =>
    readAgent(agent, index, names[index] ?? null));
  /** @type {Scene} */
  const scene = {
    title: String(data.title), continuous: Boolean(data.continuous),
    hasLayout: Boolean(data.hasLayout), yUp: Boolean(data.yUp),
    heights: Boolean(data.heights), unit: Number(data.unit),
    lengthUnit: Number(data.lengthUnit),
    end: 0, objective: String(data.objective), status: data.status ?? null,
    lowerBound: data.lowerBound ?? null, sumOfCosts: data.sumOfCosts, makespan: data.makespan,
    now: data.now ?? 0,
    cells: data.cells ? readCells(data.cells) : null,
    places: pairs(data.places ?? []), links: data.links ?? [], oneWay: data.oneWay ?? [],
    hiddenLinks: data.hiddenLinks ?? 0, bodies, agents,
    obstacles: (data.obstacles ?? []).map(readObstacle), violations: data.violations ?? [],
    nearest: (data.nearest ?? []).map(readNearness),
    attribution: data.attribution ? readAttribution(data.attribution) : null,
    obstruction: data.obstruction
      ? { ...data.obstruction, points: pairs(data.obstruction.points) } : null,
    precedences: readPrecedences(data.precedences ?? []),
    box: { left: 0, top: 0, right: 1, bottom: 1 },
  };
  for (const agent of agents)
    if (agent.times.length > 0) scene.end = Math.max(scene.end, agent.times[agent.times.length - 1]);
  scene.box = boxOf(scene);
  return scene;
}

/**
 * @param {string} text
 * @returns {any}
 */
function parse(text) {
  if (text.trim() === "") throw new Error("this page has no data: the file may be cut off");
  try {
    return JSON.parse(text);
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    throw new Error(`the data of this page are damaged, or the file is cut off (${reason})`);
  }
}

/**
 * @param {number[]} flat
 * @returns {Point[]}
 */
function pairs(flat) {
  const points = [];
  for (let i = 0; i + 1 < flat.length; i += 2) points.push({ x: flat[i], y: flat[i + 1] });
  return points;
}

/**
 * @param {{radius?: number, corners?: number[]}[]} list
 * @returns {Body[]}
 */
function readBodies(list) {
  // In cells: no matter how large.
  if (list.length === 0) return [{ radius: 0.4, corners: [], centre: { x: 0, y: 0 } }];
  return list.map((body) => {
    const corners = pairs(body.corners ?? []);
    const reach = Math.max(0, ...corners.map((corner) => Math.hypot(corner.x, corner.y)));
    const centre = { x: 0, y: 0 };
    for (const corner of corners) {
      centre.x += corner.x / corners.length;
      centre.y += corner.y / corners.length;
    }
    return { radius: body.radius ?? reach, corners, centre };
  });
}

/**
 * @param {{width: number, height: number, pitch: number, runs: string}} data
 * @returns {Cells}
 */
function readCells(data) {
  const passable = new Uint8Array(data.width * data.height);
  let at = 0;
  for (const [, count, letter] of data.runs.matchAll(/(\d*)([.@])/g)) {
    const length = count === "" ? 1 : Number(count);
    if (letter === ".") passable.fill(1, at, at + length);
    at += length;
  }
  if (at !== passable.length)
    throw new Error(`the map has ${passable.length} cells, and the data of this page say ${at}`);
  return { width: data.width, height: data.height, pitch: data.pitch, passable };
}

/**
 * @param {any} data
 * @param {number} index
 * @param {string | null} name
 * @returns {Agent}
 */
function readAgent(data, index, name) {
  /** @type {number[][]} */
  const frames = data.moves !== undefined ? framesOfMoves(data.from, data.moves)
    : framesOfStops(data.stops ?? [], data.heights ?? []);
  return {
    index, name: name ?? `agent ${index}`, start: readPlace(data.start), goal: readPlace(data.goal),
    body: data.body ?? 0, looks: data.looks ? looksOf(data.looks, data.stops) : [],
    headings: data.headings ? headingsOf(data.headings, data.stops) : [],
    free: data.free ?? null, cost: data.cost ?? null,
    leaves: Boolean(data.leaves), otherGoals: (data.other_goals ?? []).map(readPlace),
    ...columnsOf(frames),
  };
}

/**
 * @param {number[]} data
 * @returns {Place}
 */
function readPlace([x, y, z]) {
  return { x, y, z: z ?? 0 };
}

/**
 * @param {{body: number, stops: number[], heights?: number[], leaves: boolean}} data
 * @returns {Obstacle}
 */
function readObstacle({ body, stops, heights, leaves }) {
  return { body, leaves, ...columnsOf(framesOfStops(stops, heights ?? [])) };
}

/**
 * @param {number[][]} frames  time, x, y and z each
 */
function columnsOf(frames) {
  return {
    times: Float64Array.from(frames, (frame) => frame[0]),
    xs: Float64Array.from(frames, (frame) => frame[1]),
    ys: Float64Array.from(frames, (frame) => frame[2]),
    zs: Float64Array.from(frames, (frame) => frame[3]),
  };
}

/**
 * Moves between cells, such as "3R.2D".
 * @param {[number, number]} from
 * @param {string} moves
 * @returns {number[][]}
 */
function framesOfMoves(from, moves) {
  let [x, y] = from;
  let time = 0;
  const frames = [[0, x, y, 0]];
  for (const [, count, letter] of moves.matchAll(/(\d*)([RLDU.])/g)) {
    const times = count === "" ? 1 : Number(count);
    if (letter === ".") {
      time += times;
      frames.push([time, x, y, 0]);
      continue;
    }
    const [dx, dy] = STEP[/** @type {keyof typeof STEP} */ (letter)];
    for (let i = 0; i < times; ++i) frames.push([++time, x += dx, y += dy, 0]);
  }
  return frames;
}

/**
 * Four numbers per stop: x, y, arrival, departure.
 * @param {number[]} stops
 * @param {number[]} heights  one per stop, or none
 * @returns {number[][]}
 */
function framesOfStops(stops, heights) {
  const frames = [];
  for (let i = 0; i + 3 < stops.length; i += 4) {
    const [x, y, arrive, depart] = stops.slice(i, i + 4);
    const z = heights[i / 4] ?? 0;
    frames.push([arrive, x, y, z]);
    if (depart > arrive) frames.push([depart, x, y, z]);
  }
  return frames;
}

/**
 * The bodies from each frame of the stops on, of those at the stops and between them.
 * @param {number[]} looks
 * @param {number[]} stops
 * @returns {number[]}
 */
function looksOf(looks, stops) {
  const bodies = [];
  for (let i = 0; i + 3 < stops.length; i += 4) {
    const [at, away] = [looks[i / 2], looks[i / 2 + 1] ?? looks[i / 2]];
    if (stops[i + 3] > stops[i + 2]) bodies.push(at, away);
    else bodies.push(away);
  }
  return bodies;
}

/**
 * The headings at each frame of the stops.
 * @param {number[]} headings  one per stop
 * @param {number[]} stops
 * @returns {number[]}
 */
function headingsOf(headings, stops) {
  const waits = (/** @type {number} */ k) => stops[4 * k + 3] > stops[4 * k + 2];
  return headings.flatMap((heading, k) => (waits(k) ? [heading, heading] : [heading]));
}

/**
 * @param {[number, number, number, number]} data
 * @returns {Nearness}
 */
function readNearness([agent, other, gap, time]) {
  return { agents: [agent, other], gap, time };
}

/**
 * @param {any} data
 * @returns {Attribution}
 */
function readAttribution(data) {
  const sites = data.sites.map((/** @type {any} */ site) => ({ ...site, lines: site.lines.map(pairs) }));
  return { ...data, sites };
}

/**
 * @param {number[]} flat  seven numbers each
 * @returns {Precedence[]}
 */
function readPrecedences(flat) {
  const list = [];
  for (let i = 0; i + 6 < flat.length; i += 7) {
    const [leader, leaderBegin, leaderEnd, follower, followerBegin, followerEnd, slack] = flat.slice(i, i + 7);
    list.push({ leader, leaderBegin, leaderEnd, follower, followerBegin, followerEnd, slack });
  }
  return list;
}

/**
 * @param {Scene} scene
 * @returns {Scene["box"]}
 */
function boxOf(scene) {
  const box = { left: Infinity, top: Infinity, right: -Infinity, bottom: -Infinity };
  const include = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ margin) => {
    box.left = Math.min(box.left, x - margin);
    box.right = Math.max(box.right, x + margin);
    box.top = Math.min(box.top, y - margin);
    box.bottom = Math.max(box.bottom, y + margin);
  };
  if (scene.cells) {
    const { width, height, pitch } = scene.cells;
    include(0, 0, 0.5 * pitch);
    include((width - 1) * pitch, (height - 1) * pitch, 0.5 * pitch);
  }
  for (const place of scene.places) include(place.x, place.y, 0);
  for (const agent of scene.agents) {
    const reach = scene.bodies[agent.body].radius;
    include(agent.start.x, agent.start.y, reach);
    include(agent.goal.x, agent.goal.y, reach);
    for (let k = 0; k < agent.times.length; ++k) include(agent.xs[k], agent.ys[k], reach);
  }
  if (box.left > box.right) return { left: 0, top: 0, right: 1, bottom: 1 };
  if (box.right === box.left && box.bottom === box.top) include(box.left, box.top, 1);
  return box;
}
