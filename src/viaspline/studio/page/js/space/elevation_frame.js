/** What all drawings of the elevation share: its margins, and how lines are drawn. */

export const LEFT_PX = 52, RIGHT_PX = 14;
export const TOP_PX = 20, BOTTOM_PX = 20;

/** @param {CanvasRenderingContext2D} ctx @param {string} colour @param {number} width @param {number[]} [dash] */
export function stroke(ctx, colour, width, dash = []) {
  ctx.strokeStyle = colour;
  ctx.lineWidth = width;
  ctx.setLineDash(dash);
  ctx.stroke();
  ctx.setLineDash([]);
}
