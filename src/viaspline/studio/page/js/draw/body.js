/** The robot's body: where it stands, and all that it sweeps along the path. */

/** @typedef {import("./pen.js").Pen} Pen */
/** @typedef {{footprint: number[][]|null, radius: number}} Body */
/** @typedef {{x: number, y: number, heading: number}} Pose */

const MAX_BODIES = 1000; // bodies along the path
const BODY_SPACING_PX = 2.5; // pixels between two of them

/** Put the outline of a body into the path of the canvas. @param {Pen} pen @param {Body} body @param {Pose} pose */
export function outline(pen, { footprint, radius }, { x, y, heading }) {
  if (!footprint) {
    pen.disc(x, y, radius);
    return;
  }
  const c = Math.cos(heading), s = Math.sin(heading);
  pen.ring(footprint.map(([px, py]) => [x + c * px - s * py, y + s * px + c * py]));
}

/** How large a body is on the screen [CSS pixel]. @param {Pen} pen @param {Body} body */
export function sizeOf({ camera }, { footprint, radius }) {
  return camera.scale * (footprint ? Math.max(...footprint.map(([x, y]) => Math.hypot(x, y))) : radius);
}

/** All that the body covers on its way, faint. @param {Pen} pen @param {import("../geometry/curve.js").Curve} curve @param {Body} body */
export function drawSwept(pen, curve, body) {
  const { ctx, camera, colours } = pen;
  if (sizeOf(pen, body) < 2) return;
  ctx.lineCap = ctx.lineJoin = "round";
  ctx.beginPath();
  if (!body.footprint) {
    pen.spans(curve.spans);
    pen.stroke(colours.swept, 2 * body.radius * camera.scale);
    return;
  }
  const count = Math.max(1, Math.min(MAX_BODIES, Math.ceil((curve.length * camera.scale) / BODY_SPACING_PX)));
  for (let i = 0; i <= count; i += 1) outline(pen, body, curve.at((curve.length * i) / count));
  pen.fill(colours.swept); // one area: bodies on each other don't add up
}

/** The body at a pose, as a thin line. @param {Pen} pen @param {Body} body @param {Pose} pose @param {string} colour */
export function drawBody(pen, body, pose, colour) {
  if (sizeOf(pen, body) < 4) return;
  pen.ctx.lineJoin = "round";
  pen.ctx.beginPath();
  outline(pen, body, pose);
  pen.stroke(colour, 1.4);
}
