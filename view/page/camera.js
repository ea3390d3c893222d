// SPDX-License-Identifier: MIT

/** @import {Point, Scene} from "./scene.js" */

/** Which part of the scene is seen, and how large. Sizes are in pixels of the style sheet. */
export class Camera {
  /** @param {Scene} scene */
  constructor(scene) {
    this.scene = scene;
    this.width = 1;
    this.height = 1;
    /** Pixels per unit of the scene. */
    this.scale = 1;
    /** What is in the middle. */
    this.x = 0;
    this.y = 0;
    this.fitScale = 1;
    this.touched = false;
    this.flip = scene.yUp ? -1 : 1;
  }

  /**
   * Keeps what is in the middle, or fits everything as long as the user has not looked elsewhere.
   * @param {number} width
   * @param {number} height
   */
  resize(width, height) {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    const { box } = this.scene;
    const margin = 1.04;
    const spanX = Math.max(box.right - box.left, 1e-9) * margin;
    const spanY = Math.max(box.bottom - box.top, 1e-9) * margin;
    this.fitScale = Math.min(this.width / spanX, this.height / spanY);
    if (!this.touched) this.fit();
  }

  fit() {
    const { box } = this.scene;
    this.touched = false;
    this.scale = this.fitScale;
    this.x = (box.left + box.right) / 2;
    this.y = (box.top + box.bottom) / 2;
  }

  /** @param {Point} point */
  centreOn(point) {
    this.touched = true;
    this.x = point.x;
    this.y = point.y;
  }

  /**
   * @param {number} dx  in pixels
   * @param {number} dy
   */
  pan(dx, dy) {
    this.touched = true;
    this.x -= dx / this.scale;
    this.y -= (this.flip * dy) / this.scale;
  }

  /**
   * Zooms so that what is under the pixel stays there.
   * @param {number} factor
   * @param {number} px
   * @param {number} py
   */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    this.touched = true;
    const before = this.toScene(px, py);
    const most = 400 / this.smallest();
    this.scale = Math.min(Math.max(this.scale * factor, this.fitScale / 8), Math.max(most, this.fitScale));
    const after = this.toScene(px, py);
    this.x += before.x - after.x;
    this.y += before.y - after.y;
  }

  /** The size of the smallest body: it need not fill the screen. */
  smallest() {
    return Math.max(1e-9, Math.min(...this.scene.bodies.map((body) => body.radius)));
  }

  /** @param {number} x */
  toPixelX(x) {
    return (x - this.x) * this.scale + this.width / 2;
  }

  /** @param {number} y */
  toPixelY(y) {
    return this.flip * (y - this.y) * this.scale + this.height / 2;
  }

  /**
   * @param {number} px
   * @param {number} py
   * @returns {Point}
   */
  toScene(px, py) {
    return {
      x: (px - this.width / 2) / this.scale + this.x,
      y: (this.flip * (py - this.height / 2)) / this.scale + this.y,
    };
  }

  /** What the layer of the map depends on. */
  key() {
    return [this.scale, this.x, this.y, this.width, this.height].join(" ");
  }
}
