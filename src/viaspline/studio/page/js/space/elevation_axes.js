/** The scales of the elevation, and its legend. */

import { BOTTOM_PX, LEFT_PX, RIGHT_PX, TOP_PX, stroke } from "./elevation_frame.js";

/** @param {import("./elevation_picture.js").ElevationPicture} picture @param {any} colours */
export function drawAxes(picture, colours) {
  const { ctx, width, height } = picture;
  const [low, high] = picture.range;
  ctx.font = "500 10px Inter, system-ui, sans-serif";
  ctx.textBaseline = "middle";
  ctx.textAlign = "right";
  const step = roundStep(((high - low) * 26) / (height - TOP_PX - BOTTOM_PX));
  ctx.lineWidth = 1;
  for (let z = Math.ceil(low / step) * step; z <= high; z += step) {
    const y = Math.round(picture.y(z)) + 0.5;
    ctx.strokeStyle = colours.grid;
    ctx.beginPath();
    ctx.moveTo(LEFT_PX, y);
    ctx.lineTo(width - RIGHT_PX, y);
    ctx.stroke();
    ctx.fillStyle = colours.muted;
    ctx.fillText(String(Number(z.toFixed(2))), LEFT_PX - 6, y);
  }
  ctx.textAlign = "left";
  ctx.fillText("height [m] along the path", LEFT_PX, 8);
  const length = picture.app.store.curve.length;
  const along = roundStep((length * 90) / (width - LEFT_PX - RIGHT_PX));
  drawLegend(picture, colours);
  ctx.fillStyle = colours.muted;
  ctx.textAlign = "center";
  for (let s = 0; s <= length; s += along) ctx.fillText(s ? String(s) : "0 m", Math.max(picture.x(s), LEFT_PX + 8), height - 8);
}

/** What is what, on the right above the drawing. @param {import("./elevation_picture.js").ElevationPicture} picture @param {any} colours */
function drawLegend(picture, colours) {
  const { ctx, width } = picture;
  const { profile } = picture.space;
  const has = (/** @type {(number|null)[]|undefined} */ edge) => !!edge?.some((z) => z !== null);
  const beside = (/** @type {number} */ m) => !!profile?.near.some((/** @type {any} */ one) => one.meets.includes(m));
  /** @type {[string, string, string, boolean][]} */ const all = [
    ["altitude band", colours.zone, "", has(profile?.low) || has(profile?.high)],
    [`beside, within ${profile?.beside ?? 10} m`, colours.haloEdge, colours.halo, beside(0)],
    ["under or over", colours.obstacleEdge, colours.obstacle, beside(1)],
  ];
  let right = width - RIGHT_PX;
  ctx.textAlign = "right";
  for (const [text, edge, face, isThere] of all) {
    const wide = ctx.measureText(text).width;
    if (!isThere || right - wide < LEFT_PX + 200) continue;
    ctx.fillStyle = colours.muted;
    ctx.fillText(text, right, 8);
    right -= wide + 18;
    ctx.beginPath();
    if (face) ctx.rect(right, 4, 13, 8);
    else {
      ctx.moveTo(right - 4, 8);
      ctx.lineTo(right + 14, 8);
    }
    if (face) {
      ctx.fillStyle = face;
      ctx.fill();
    }
    stroke(ctx, edge, 1, face ? [] : [5, 3]);
    right -= 16;
  }
}

/** The next of 1, 2 and 5 times a power of ten. @param {number} least */
function roundStep(least) {
  const power = 10 ** Math.floor(Math.log10(Math.max(least, 1e-9)));
  return power * (least / power <= 1 ? 1 : least / power <= 2 ? 2 : least / power <= 5 ? 5 : 10);
}
