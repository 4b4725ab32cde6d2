/** The whole picture, layer by layer; it is drawn at most once a frame, when something has changed. */

import { areasOf, bodyOf, movingOf, obstaclesOf, outlined, pointsOf, requiredOf, tracksOf, whole } from "../core/mission.js";
import { polygon } from "../shapes/polygon.js";
import { down, metres, seconds } from "../units.js";
import { FleetLayer } from "../fleet/layer.js";
import { drawCorridor, drawZones, wordsOf } from "./areas.js";
import { drawBody, drawSwept } from "./body.js";
import { drawFollowed, drawRobot, drawSight, drawTrail } from "./drive_marks.js";
import { drawGrid, drawLimits, drawOutside, MapPictures } from "./ground.js";
import { drawLabels } from "./labels.js";
import { drawCross, drawCursor, drawDraft, drawProblem, drawRough, drawScale, drawTightest, drawTightestInTime } from "./marks.js";
import { boxOnScreen, drawMoving, drawTrails, placedAt } from "./moving.js";
import { drawHalos, drawHovered, drawKnown, drawPierced, drawUnseen, screenBox } from "./obstacles.js";
import { drawArrows, drawComb, drawLeg, drawLosers, drawPath } from "./path.js";
import { Pen } from "./pen.js";
import { drawDetours, drawHandles, drawPoints } from "./route.js";
import { theme } from "./theme.js";
import { thinned } from "./thinned.js";

/** @typedef {import("../core/mission.js").Outlined} Outlined */

const PATIENCE_MS = 30;
const FEW_POINTS = 40; // each of which is named, come what may
const MOST_NAMED = 12; // things that move with their names beside them

export class Scene {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {import("../core/store.js").Store} store
   * @param {import("../geometry/camera.js").Camera} camera
   * @param {import("../replay.js").Drive} drive
   * @param {import("../preview.js").Preview} preview
   */
  constructor(canvas, store, camera, drive, preview) {
    this.canvas = canvas;
    this.store = store;
    this.camera = camera;
    this.drive = drive;
    this.preview = preview;
    this.ctx = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { alpha: false }));
    this.maps = new MapPictures(() => this.later());
    this.fleet = new FleetLayer(store, preview, drive);
    /** @type {import("../early_path.js").EarlyPath|null} */ this.early = null;
    /** @type {import("../compare/compare.js").Compare|null} */ this.compare = null;
    this.isDue = false;
    this.patience = 0;
    /** Where the tools cover the map [CSS pixel]. */ this.tools = [0, 0, 0, 0];
    /** The picture under everything. @type {import("../geo/background.js").Background|null} */ this.background = null;
    /** Heights on the map, of a mission in space. @type {import("../space/plan_layer.js").PlanLayer|null} */ this.space = null;
    /** @type {HTMLCanvasElement|undefined} */ this.still = undefined;
    /** @type {any} */ this.stillWorld = null;
    this.stillKey = "";
    /** @type {any} */ this.draft = null; // what a tool is about to make
    /** @type {number[]|null} */ this.cross = null; // the keyboard's cursor [m]
    /** @type {any} */ this.hoveredSide = null;
    /** What tools draw over everything else. @type {((pen: Pen) => void)[]} */ this.overlays = [];
    /** @type {((time: number) => void)[]} */ this.drawn = []; // told once, after the next drawing
  }

  /** Draw with the plan that is on its way, or without it if it takes long: one frame, not two. */
  soon() {
    if (!this.patience) this.patience = setTimeout(() => this.later(), PATIENCE_MS);
  }

  /** Draw in the next frame. */
  later() {
    clearTimeout(this.patience);
    this.patience = 0;
    if (this.isDue) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      if (this.isDue) this.draw();
      this.isDue = false;
      this.told();
    });
  }

  /** Whether what there is to be seen was drawn. */
  get isUpToDate() {
    return !this.isDue && !this.patience;
  }

  /** Draw at once, for the next frame: a new path doesn't wait for it to begin. */
  now() {
    clearTimeout(this.patience);
    this.patience = 0;
    this.isDue = false;
    this.draw();
    requestAnimationFrame(() => this.told());
  }

  /** Draw in the frame after the one that is waited for: that one is not held up. */
  afterwards() {
    if (this.drawn.length) this.drawn.push(() => this.later());
    else this.later();
  }

  /** Tell who waits that the frame with the newest drawing was given away. */
  told() {
    const waiting = this.drawn;
    this.drawn = [];
    if (!waiting.length) return;
    const channel = new MessageChannel(); // its task comes after the frame
    channel.port1.onmessage = () => waiting.forEach((tell) => tell(performance.now()));
    channel.port2.postMessage(0);
  }

  /** Fit the canvas to its place. */
  resize() {
    const { width, height } = this.canvas.getBoundingClientRect();
    const ratio = Math.min(devicePixelRatio || 1, 3);
    this.tools = toolsBox(this.canvas);
    this.camera.width = width;
    this.camera.height = height;
    this.canvas.width = Math.max(1, Math.round(width * ratio));
    this.canvas.height = Math.max(1, Math.round(height * ratio));
    this.later();
  }

  /**
   * What stands still while points are dragged, drawn once: it is most of what there is to draw.
   * @param {Outlined[]} known @param {import("./theme.js").Theme} colours
   */
  ground(known, colours) {
    const { canvas, camera, store } = this;
    const { doc, show } = store;
    const grids = (store.plan?.grids?.length ? store.plan : store.goodPlan)?.grids ?? [];
    const required = requiredOf(doc);
    const view = [camera.x, camera.y, camera.scale, canvas.width, canvas.height, show.rings, show.grid, required, this.maps.count, colours.paper, this.space?.key, this.background?.key];
    const named = grids.map((/** @type {any} */ g) => g.picture ?? g.item);
    const key = [...view, ...named].join();
    if (this.still && this.stillWorld === doc.world && this.stillKey === key) return this.still;
    this.still ??= document.createElement("canvas");
    this.still.width = canvas.width;
    this.still.height = canvas.height;
    this.stillWorld = doc.world;
    this.stillKey = key;
    const ctx = /** @type {CanvasRenderingContext2D} */ (this.still.getContext("2d", { alpha: false }));
    const pen = new Pen(ctx, camera, colours);
    const ratio = canvas.width / camera.width;
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.fillStyle = colours.paper;
    ctx.fillRect(0, 0, camera.width, camera.height);
    drawOutside(pen, doc);
    this.background?.draw(pen);
    this.space?.drawGround(pen);
    this.maps.draw(pen, grids, required, show.rings);
    const areas = grids.filter((/** @type {any} */ g) => g.rings && g.list === "known").map((/** @type {any} */ g) => ({ id: "", shape: polygon, item: { polygon: g.rings[0], holes: g.rings.slice(1) }, side: null }));
    const shapes = [...known, ...areas];
    const isPierced = (/** @type {Outlined} */ one) => one.shape.isPierced(one.item);
    if (show.rings) drawHalos(pen, shapes, required);
    if (show.grid) drawGrid(pen);
    drawZones(pen, areasOf(doc));
    drawKnown(pen, shapes.filter((o) => !isPierced(o)));
    shapes.filter(isPierced).forEach((o) => drawPierced(pen, o));
    drawLimits(pen, doc, required, show.rings);
    return this.still;
  }

  draw() {
    const { ctx, canvas, camera, store, drive } = this;
    const { doc, show } = store;
    const colours = theme();
    const pen = new Pen(ctx, camera, colours);
    const ratio = canvas.width / camera.width;
    const obstacles = obstaclesOf(doc);
    const known = outlined(obstacles.filter((o) => o.list === "known"));
    const unseen = obstacles.filter((o) => o.list === "unseen");
    const maxSpeed = Number(doc.robot?.max_speed_mps ?? 2) || 1;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.drawImage(this.ground(known, colours), 0, 0);
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawCorridor(pen, store.goodPlan?.corridor ?? []);
    drawHovered(pen, known, store.hover);
    const isDriving = !!drive.run && !drive.run.fleet; // robots of a fleet keep to their paths
    const moving = placedAt([...movingOf(obstacles), ...tracksOf(store.plan?.tracks ?? [])], this.time);
    drawTrails(pen, moving, this.preview, store.selection && whole(store.selection));
    if (isDriving) drawSight(pen, drive);
    drawUnseen(pen, unseen, ({ index }) => isDriving && drive.hasSeen(index), store.hover);
    this.fleet.drawRoutes(pen);
    this.drawWays(pen, isDriving, maxSpeed);
    if (!isDriving) this.compare?.draw(pen);
    if (!isDriving) this.early?.draw(pen);
    drawMoving(pen, moving, {
      time: this.time, required: show.rings ? requiredOf(doc) : null, marked: [store.hover, store.selection].map((id) => id && whole(id)),
      isFound: ({ index }) => isDriving && drive.hasSeen(index),
    });
    if (show.detours && store.curve && store.plan?.ok && !isDriving) drawDetours(pen, store.curve.vias);
    const body = bodyOf(doc);
    if (show.body && store.curve && store.plan?.ok && !store.isLate && !isDriving) this.drawBodies(pen, body);
    const points = pointsOf(doc);
    const shown = thinned(points, camera, [store.selection, store.hover]);
    drawPoints(pen, points, { selection: store.selection, hover: store.hover, shown });
    drawHandles(pen, doc, store.selection);
    if (!isDriving && store.plan?.ok && !store.isLate) {
      drawTightest(pen, store.plan.certificate, known);
      drawTightestInTime(pen, store.plan.timing?.certificate);
      drawRough(pen, store.plan.drivability?.reasons ?? []);
    }
    for (const problem of store.plan?.ok === false ? store.plan.problems : []) {
      const where = problem.where ?? this.placeOfProblem(problem);
      if (where) drawProblem(pen, where);
    }
    if (store.cursor !== null && store.curve && !isDriving) drawCursor(pen, store.curve.at(store.cursor), body);
    if (!isDriving) this.space?.drawProvisional(pen);
    if (isDriving) drawRobot(pen, drive.state(), body, { colour: colours.robot, stop: drive.stay() });
    else if (store.fleetPlan) this.fleet.drawRobots(pen);
    else if (this.preview.isOn && !store.isLate && store.plan?.ok) this.drawPreviewed(pen, body);
    if (this.draft) drawDraft(pen, this.draft);
    if (this.cross) drawCross(pen, this.cross);
    this.drawNames(pen, points.filter((point) => shown.has(point.id)), points.length > FEW_POINTS, obstacles, isDriving, moving);
    drawScale(pen, 16, 16, show.speed ? maxSpeed : null);
    for (const draw of this.overlays) draw(pen);
  }

  /** The instant that is drawn, by the mission's clock [s]. */
  get time() {
    return this.drive.run ? this.drive.time : this.preview.time;
  }

  /** The robot where the plan has it at the instant. @param {Pen} pen @param {import("./body.js").Body} body */
  drawPreviewed(pen, body) {
    const state = this.preview.state();
    if (state) drawRobot(pen, { ...state, heading: /** @type {any} */ (state).yaw ?? state.heading }, body, { colour: pen.colours.path, stop: null });
  }

  /** The body at the start, and where it comes closest. @param {Pen} pen @param {import("./body.js").Body} body */
  drawBodies(pen, body) {
    const { curve, plan } = this.store;
    if (!curve) return;
    drawBody(pen, body, curve.at(0), pen.colours.start);
    if (plan.certificate.distance !== null) drawBody(pen, body, curve.at(plan.certificate.distance), pen.colours.tightest);
  }

  /** @param {Pen} pen @param {boolean} isDriving @param {number} maxSpeed */
  drawWays(pen, isDriving, maxSpeed) {
    const { store, drive } = this;
    const { show, curve } = store;
    if (!curve) return;
    const isStale = store.plan?.ok === false || store.isLate;
    if (isDriving) {
      drawFollowed(pen, drive, curve.spans);
      drawTrail(pen, drive, maxSpeed);
      return;
    }
    if (show.body && !isStale) drawSwept(pen, curve, bodyOf(store.doc));
    if (show.losers && !isStale) drawLosers(pen, store.ledger, this.hoveredSide);
    if (store.selection?.startsWith("span:") && !isStale) drawLeg(pen, curve, Number(store.selection.slice(5)));
    if (show.comb && !isStale) drawComb(pen, curve);
    drawPath(pen, curve, { speed: show.speed, isStale, maxSpeed, colour: this.fleet.chosenColour(pen) });
    if (!isStale) drawArrows(pen, curve);
  }

  /** @param {any} problem */
  placeOfProblem(problem) {
    const [section, key, index] = problem.path;
    if (section !== "route") return null;
    const id = key === "via" ? `via:${index}` : key;
    return pointsOf(this.store.doc).find((point) => point.id === id)?.at ?? null;
  }

  /** @param {Pen} pen @param {any[]} points @param {boolean} isCrowded whether there are more points than those @param {import("../core/mission.js").Obstacle[]} obstacles @param {boolean} isDriving @param {import("./moving.js").Placed[]} moving */
  drawNames(pen, points, isCrowded, obstacles, isDriving, moving) {
    const { camera, store } = this;
    const { colours } = pen;
    /** @type {import("./labels.js").Label[]} */ const labels = [];
    const avoid = points.filter((p) => p.at).map((p) => {
      const [x, y] = camera.toScreen(p.at[0], p.at[1]);
      return [x - 11, y - 11, x + 11, y + 11];
    });
    for (const { at, heading } of points) { // its arrow
      if (!at || heading === null) continue;
      const [x, y] = camera.toScreen(at[0], at[1]);
      for (const reach of [18, 31, 44]) {
        const [hx, hy] = [x + reach * Math.cos((heading * Math.PI) / 180), y - reach * Math.sin((heading * Math.PI) / 180)];
        avoid.push([hx - 7, hy - 7, hx + 7, hy + 7]);
      }
    }
    avoid.push([0, camera.height - 40, 250, camera.height]);
    avoid.push(this.tools, this.tools, this.tools); // what lies under them can't be read: worse than on something else
    const line = (store.curve?.samples ?? []).map((s) => camera.toScreen(s.x, s.y));
    if (store.show.names) {
      for (const point of points) {
        if (!point.at || (!point.given && store.selection !== point.id)) continue;
        const [x, y] = camera.toScreen(point.at[0], point.at[1]);
        const dwell = point.dwell > 0 ? ` · ${point.dwell} s` : "";
        labels.push({ text: point.name + dwell, x, y, away: 13, colour: colours.label, bold: true, rank: store.selection === point.id ? 0 : 1, yields: isCrowded && store.selection !== point.id });
      }
      for (const obstacle of outlined(obstacles)) {
        if (!obstacle.given) continue;
        const box = screenBox(camera, obstacle);
        const w = box[2] - box[0];
        if (box[2] < 0 || box[3] < 0 || box[0] > camera.width || box[1] > camera.height || w < 10) continue;
        const away = Math.min(w, box[3] - box[1]) / 2 + 4;
        labels.push({ text: obstacle.name, x: (box[0] + box[2]) / 2, y: (box[1] + box[3]) / 2, away: obstacle.side || w < 70 ? away : 0, colour: obstacle.list === "unseen" ? colours.unseen : colours.muted, rank: store.selection === obstacle.id ? 1 : 4 });
      }
    }
    if (store.show.names && moving.length <= MOST_NAMED) {
      for (const one of moving) {
        if (!one.given || !one.frame) continue;
        const box = boxOnScreen(pen, one);
        labels.push({ text: one.name, x: (box[0] + box[2]) / 2, y: (box[1] + box[3]) / 2, away: (box[3] - box[1]) / 2 + 4, colour: one.list === "unseen" ? colours.unseen : colours.moving, rank: store.selection === one.id ? 1 : 3 });
      }
    }
    if (store.show.names) {
      for (const area of areasOf(store.doc)) {
        if (!area.ring.length || (area.kind === "fence" && store.selection !== area.id)) continue;
        const [x, y] = camera.toScreen(Math.min(...area.ring.map((p) => p[0])), Math.max(...area.ring.map((p) => p[1])));
        labels.push({ text: wordsOf(area), x: x + 10 + 3.4 * wordsOf(area).length, y: y + 13, away: 0, colour: area.kind === "zone" ? colours.zone : colours.muted, rank: store.selection === area.id ? 0 : 2 });
      }
    }
    if (store.show.names && this.space) labels.push(...this.space.labels(pen));
    if (!isDriving) labels.push(...(this.early?.labels(pen) ?? []), ...(this.compare?.labels(pen) ?? []));
    const proof = store.plan?.ok && !store.isLate ? store.plan.certificate : null;
    if (proof && proof.clearance !== null && !isDriving) {
      const [x, y] = camera.toScreen(proof.at[0], proof.at[1]);
      labels.push({ text: `${down(proof.clearance)} clear`, x, y, away: 12, colour: colours.tightest, bold: true, rank: 0, plate: true });
    }
    if (store.show.losers && !isDriving && store.plan?.ok && store.ledger.length <= (camera.width < 700 ? 3 : 8)) {
      for (const entry of store.ledger) {
        const taken = entry.candidates.find((/** @type {any} */ c) => c.chosen);
        for (const loser of entry.candidates) {
          if (loser.chosen || !loser.spans.length || !taken?.length || !loser.length) continue;
          const k = Math.floor(loser.spans.length / 16);
          const [x, y] = camera.toScreen(loser.spans[8 * k], loser.spans[8 * k + 1]);
          const more = (/** @type {number} */ value, /** @type {string} */ words) => `${value >= 0 ? "+" : "−"}${words}`;
          const longer = loser.length - taken.length;
          const later = loser.duration - taken.duration;
          const text = `${loser.side} ${more(longer, metres(Math.abs(longer), 1))}, ${more(later, seconds(Math.abs(later)))}`;
          labels.push({ text, x, y, away: 9, colour: colours.loser, rank: 3 });
        }
      }
    }
    drawLabels(pen, [...labels, ...this.fleet.labels(pen)], avoid, line);
  }
}

/** Where the tools lie over a canvas [CSS pixel]. @param {HTMLCanvasElement} canvas */
function toolsBox(canvas) {
  const box = document.querySelector("#tools")?.getBoundingClientRect(), own = canvas.getBoundingClientRect();
  return box ? [box.left - own.left, box.top - own.top, box.right - own.left, box.bottom - own.top] : [0, 0, 0, 0];
}
