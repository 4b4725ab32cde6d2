/** Areas on the ground: where the robot drives more slowly, and the strip that its path stays inside of. */

/** @typedef {import("./pen.js").Pen} Pen */

/** @param {Pen} pen @param {{kind: string, ring: number[][]}[]} areas */
export function drawZones(pen, areas) {
  const { ctx, colours } = pen;
  ctx.lineJoin = "round";
  for (const { kind, ring } of areas) {
    if (kind !== "zone" || !ring.length) continue;
    ctx.beginPath();
    pen.ring(ring);
    pen.fill(colours.zoneFill);
    pen.stroke(colours.zone, 1.4, [1.5, 4]);
  }
}

/** @param {Pen} pen @param {number[][][]} rings the outer one, then the islands in it [m] */
export function drawCorridor(pen, rings) {
  if (!rings?.length) return;
  const { ctx, colours } = pen;
  ctx.lineJoin = "round";
  ctx.beginPath();
  for (const ring of rings) pen.ring(ring);
  pen.fill(colours.corridorFill, "evenodd");
  pen.stroke(colours.corridor, 1.6, [9, 4]);
}

/** What stands beside a zone or a fence. @param {{kind: string, name: string, given: string|null, speed: number|null}} area */
export function wordsOf({ kind, name, given, speed }) {
  if (kind === "fence") return name;
  const limit = speed === null ? "" : `≤ ${Number(speed.toFixed(2))} m/s`;
  return given ? `${given} ${limit}` : limit || name;
}
