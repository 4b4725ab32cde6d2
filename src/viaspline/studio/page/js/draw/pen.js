/** A canvas context that takes metres: the few strokes that every layer is made of. */

import { isDark } from "./theme.js";

/** @typedef {import("../geometry/camera.js").Camera} Camera */

export class Pen {
  /** @param {CanvasRenderingContext2D} ctx @param {Camera} camera @param {import("./theme.js").Theme} colours */
  constructor(ctx, camera, colours) {
    this.ctx = ctx;
    this.camera = camera;
    this.colours = colours;
    this.isDark = isDark();
  }

  /** @param {number[][]} ring */
  ring(ring) {
    const { ctx, camera } = this;
    ring.forEach((p, i) => {
      const [x, y] = camera.toScreen(p[0], p[1]);
      if (i) ctx.lineTo(x, y);
      else ctx.moveTo(x, y);
    });
    ctx.closePath();
  }

  /** @param {number} x @param {number} y @param {number} radius [m] */
  disc(x, y, radius) {
    const [px, py] = this.camera.toScreen(x, y);
    const r = radius * this.camera.scale;
    this.ctx.moveTo(px + r, py);
    this.ctx.arc(px, py, r, 0, 2 * Math.PI);
  }

  /** The outline of an obstacle with its holes. @param {import("../core/mission.js").Outlined} obstacle */
  shape({ shape, item }) {
    shape.trace(this, item);
  }

  /** Bézier spans as they are, exact. @param {number[]} spans @param {number} [from] @param {number} [to] */
  spans(spans, from = 0, to = spans.length / 8) {
    const { ctx, camera } = this;
    for (let k = from; k < to; k += 1) {
      const p = [];
      for (let j = 0; j < 4; j += 1) p.push(...camera.toScreen(spans[8 * k + 2 * j], spans[8 * k + 2 * j + 1]));
      if (k === from) ctx.moveTo(p[0], p[1]);
      ctx.bezierCurveTo(p[2], p[3], p[4], p[5], p[6], p[7]);
    }
  }

  /** @param {string} colour @param {number} width [CSS pixel] @param {number[]} [dash] */
  stroke(colour, width, dash = []) {
    const { ctx } = this;
    ctx.strokeStyle = colour;
    ctx.lineWidth = width;
    ctx.setLineDash(dash);
    ctx.stroke();
    if (dash.length) ctx.setLineDash([]);
  }

  /** @param {string} colour @param {CanvasFillRule} [rule] */
  fill(colour, rule = "nonzero") {
    this.ctx.fillStyle = colour;
    this.ctx.fill(rule);
  }
}
