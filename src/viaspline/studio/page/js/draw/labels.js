/** Names and figures beside what they belong to, where they cover nothing that matters. */

import { LabelRoom } from "./label_room.js";

/**
 * One that `yields` is left out where it would lie on another; one that may stand at `others` as well
 * does so where there is no room at its first place [CSS pixel].
 * @typedef {{text: string, x: number, y: number, away: number, colour: string, bold?: boolean, rank: number, plate?: boolean, yields?: boolean, others?: number[][]}} Label
 */

const FONT_FAMILY = "Inter, system-ui, sans-serif";
const DIRECTIONS = [[1, 0], [-1, 0], [0, -1], [0, 1], [0.8, -0.8], [0.8, 0.8], [-0.8, -0.8], [-0.8, 0.8]];

const LONGEST_SHARE = 0.55; // of the map's width, that a name takes
const LETTER_PX = 6.8;
const MIDDLE_OFFSETS = [[0, 0], [0, -1.1], [0, 1.1]]; // on what is large enough

/** @type {Map<string, number>} */ const widths = new Map();

/** @param {CanvasRenderingContext2D} ctx @param {string} text @param {boolean} bold */
function widthOf(ctx, text, bold) {
  const key = `${bold ? 1 : 0}${text}`;
  let width = widths.get(key);
  if (width === undefined) {
    if (widths.size > 2000) widths.clear();
    ctx.font = `${bold ? 600 : 500} 12px ${FONT_FAMILY}`;
    width = ctx.measureText(text).width;
    widths.set(key, width);
  }
  return width;
}

/**
 * Draw labels, the lowest rank first; one that finds no place and isn't important is left out.
 * @param {import("./pen.js").Pen} pen
 * @param {Label[]} labels
 * @param {number[][]} avoid boxes that are taken
 * @param {number[][]} line points of the path [CSS pixel]
 */
export function drawLabels(pen, labels, avoid, line) {
  const { ctx, camera, colours } = pen;
  const room = new LabelRoom(camera);
  for (const box of avoid) room.take(box);
  for (const [x, y] of line) room.mark(x, y);
  ctx.textBaseline = "middle";
  ctx.textAlign = "left";
  const longest = Math.max(12, Math.floor((LONGEST_SHARE * camera.width) / LETTER_PX));
  for (const label of [...labels].sort((a, b) => a.rank - b.rank)) {
    const text = label.text.length > longest ? `${label.text.slice(0, longest - 1)}…` : label.text;
    const w = widthOf(ctx, text, !!label.bold) + 8, h = 18;
    /** @type {number[]|null} */ let best = null;
    let least = Infinity, isOnOther = false;
    const places = [[label.x, label.y], ...(label.others ?? [])];
    const directions = label.away ? DIRECTIONS : MIDDLE_OFFSETS;
    places.forEach(([atX, atY], k) => directions.forEach(([dx, dy], i) => {
      const away = label.away || 20;
      const x = atX + dx * away + (dx > 0.1 ? 0 : dx < -0.1 ? -w : -w / 2);
      const y = atY + dy * away + (label.away === 0 ? -h / 2 : dy > 0.1 ? 0 : dy < -0.1 ? -h : -h / 2);
      const box = [x, y, x + w, y + h];
      const others = room.overlaps(box);
      const cost = (k + i) * 0.4 + (room.holds(box) ? 0 : 60) + 40 * others + 4 * room.onPath(box);
      if (cost < least) {
        least = cost;
        best = box;
        isOnOther = others > 0 || !room.holds(box);
      }
    }));
    if (!best || (least >= 40 && label.rank > 2) || (label.yields && isOnOther)) continue;
    const box = /** @type {number[]} */ (best);
    room.take(box);
    ctx.font = `${label.bold ? 600 : 500} 12px ${FONT_FAMILY}`;
    ctx.beginPath();
    ctx.roundRect(box[0], box[1], w, h, 4);
    if (label.plate) {
      pen.fill(colours.plate);
    } else {
      ctx.globalAlpha = 0.7;
      pen.fill(colours.plate);
      ctx.globalAlpha = 1;
    }
    ctx.fillStyle = label.colour;
    ctx.fillText(text, box[0] + 4, box[1] + h / 2 + 0.5);
  }
}
