// SPDX-License-Identifier: MIT

/** @import {Scene} from "./scene.js" */
import { eventTimes, neighbouringEvent } from "./motion.js";

/** At 1 a timestep, or a unit of time of the input, takes a second. */
export const SPEEDS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50];

/** The clock of the page: which moment is shown, and how it goes on. */
export class Player {
  /** @param {Scene} scene */
  constructor(scene) {
    this.scene = scene;
    this.time = 0;
    this.playing = false;
    this.speed = 1;
    /** @type {number | null} */
    this.last = null;
    /** @type {Float64Array | null} */
    this.events = null;
  }

  /** @param {number} time */
  seek(time) {
    this.time = Math.min(Math.max(Number.isFinite(time) ? time : 0, 0), this.scene.end);
  }

  toggle() {
    if (!this.playing && this.time >= this.scene.end) this.time = 0;
    this.playing = !this.playing && this.scene.end > 0;
    this.last = null;
  }

  pause() {
    this.playing = false;
    this.last = null;
  }

  /**
   * To the next moment at which something begins or ends.
   * @param {1 | -1} direction
   */
  step(direction) {
    this.pause();
    if (this.events === null) this.events = eventTimes(this.scene);
    this.seek(neighbouringEvent(this.events, this.time, direction));
  }

  /** @param {1 | -1} direction */
  changeSpeed(direction) {
    const index = SPEEDS.indexOf(this.speed) + direction;
    this.speed = SPEEDS[Math.min(Math.max(index, 0), SPEEDS.length - 1)];
  }

  /**
   * A frame at this moment of the real world, in milliseconds.
   * @param {number} now
   */
  advance(now) {
    if (!this.playing) return;
    if (this.last !== null) {
      // A page that was hidden goes on where it was.
      const seconds = Math.min((now - this.last) / 1000, 0.25);
      this.seek(this.time + (seconds * this.speed) / this.scene.unit);
    }
    this.last = now;
    if (this.time >= this.scene.end) this.pause();
  }
}
