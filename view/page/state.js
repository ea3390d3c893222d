// SPDX-License-Identifier: MIT

/** @import {Agent, Scene} from "./scene.js" */
/** @import {Theme} from "./palette.js" */
import { Camera } from "./camera.js";
import { Clearances } from "./clearance.js";
import { currentTheme } from "./palette.js";
import { Player } from "./player.js";

/** Everything that the parts of the page share. Who changes it calls `changed`. */
export class State {
  /** @param {Scene} scene */
  constructor(scene) {
    this.scene = scene;
    this.camera = new Camera(scene);
    this.player = new Player(scene);
    this.clearances = new Clearances(scene);
    /** @type {number | null} */
    this.selected = null;
    this.following = false;
    this.showPaths = false;
    this.showGoals = true;
    this.showSwept = false;
    this.showHeat = false;
    this.showOrder = false;
    this.alongPath = false;
    this.dark = false;
    /** @type {Theme} */
    this.theme = currentTheme();
    /** @type {(() => void)[]} */
    this.listeners = [];
  }

  /** @returns {Agent | null} */
  agent() {
    return this.selected === null ? null : this.scene.agents[this.selected];
  }

  /** @param {number | null} index */
  select(index) {
    const known = index !== null && index >= 0 && index < this.scene.agents.length;
    this.selected = known ? index : null;
    if (!known) {
      this.following = false;
      this.alongPath = false;
    }
    this.changed();
  }

  /** @param {boolean} dark */
  setDark(dark) {
    this.dark = dark;
    document.documentElement.classList.toggle("dark", dark);
    this.theme = currentTheme();
    this.changed();
  }

  /**
   * A stretch of time as the user counts it.
   * @param {number} time
   * @returns {string}
   */
  show(time) {
    const value = time * this.scene.unit;
    return String(Number(value.toFixed(Math.abs(value) < 10 ? 4 : 2)));
  }

  /**
   * A moment likewise.
   * @param {number} time
   * @returns {string}
   */
  showMoment(time) {
    return this.show(this.scene.now + time);
  }

  changed() {
    for (const listener of this.listeners) listener();
  }
}

/**
 * An element of the page.
 * @template {HTMLElement} T
 * @param {string} id
 * @param {new () => T} type
 * @returns {T}
 */
export function element(id, type) {
  const found = document.getElementById(id);
  if (!(found instanceof type)) throw new Error(`the page has no ${id}`);
  return found;
}

/**
 * The context of a canvas that is as large as the style sheet makes it, in real pixels; what is drawn
 * counts in pixels of the style sheet.
 * @param {HTMLCanvasElement} canvas
 * @returns {{context: CanvasRenderingContext2D, width: number, height: number}}
 */
export function fittedContext(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const { clientWidth, clientHeight } = canvas;
  const [width, height] = [Math.round(clientWidth * ratio), Math.round(clientHeight * ratio)];
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const context = canvas.getContext("2d");
  if (!context) throw new Error("this browser draws no canvas");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { context, width: clientWidth, height: clientHeight };
}
