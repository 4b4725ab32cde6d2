/**
 * Where a place on the map snaps to: a point or a corner nearby, else the grid. Alt or Ctrl lets it go free.
 * What it has snapped to is shown with its name.
 */

import { anchorOf, areasOf, isPoint, movingOf, obstaclesOf, outlined, pointsOf, shapedAt, whole } from "../core/mission.js";
import { theme } from "../draw/theme.js";

const REACH_PX = 8;
const GRID_PX = 28; // at least between two lines of the grid

/** @typedef {{at: number[], name: string}} Target */

export class Snap {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    this.isFree = false; // a key is held that lets it
    this.isPointing = false; // by mouse or finger: steps of the keyboard don't stick to points
    /** @type {readonly string[]} */ this.moving = []; // what is dragged doesn't snap to itself
    this.isRoute = false; // points of the route keep away from corners: they snap to other points of it
    /** @type {any} */ this.doc = null;
    /** @type {Target[]} */ this.targets = [];
    /** @type {{at: number[], name: string|null}|null} */ this.shown = null;
    app.scene.overlays.push((/** @type {import("../draw/pen.js").Pen} */ pen) => this.draw(pen));
  }

  /** Something is dragged from now on; without ids, a point of the route that is yet to be made. @param {readonly string[]} ids */
  begin(ids) {
    this.moving = ids.map(whole);
    this.isRoute = ids.every(isPoint);
    this.doc = null;
  }

  /** Nothing is dragged any more. */
  end() {
    this.moving = [];
    this.isRoute = false;
    this.doc = null;
    this.forget();
  }

  forget() {
    if (!this.shown) return;
    this.shown = null;
    this.app.scene.later();
  }

  /** A place as it snaps; a single length keeps to the steps of the grid. @param {number[]} at @returns {number[]} */
  place(at) {
    const { camera, store } = this.app;
    const isGrid = store.show.snap && !this.isFree;
    const grid = isGrid ? camera.step(GRID_PX) : null;
    if (at.length !== 2) return camera.rounded(at, grid);
    const target = this.isPointing && store.show.points && !this.isFree ? this.nearest(at) : null;
    const place = target ? [...target.at] : camera.rounded(at, grid);
    this.shown = target ?? (isGrid && this.isPointing ? { at: place, name: null } : null);
    return place;
  }

  /** @param {number[]} at @returns {Target|null} */
  nearest(at) {
    const { camera } = this.app;
    let best = REACH_PX / camera.scale;
    /** @type {Target|null} */ let found = null;
    for (const target of this.known()) {
      const away = Math.hypot(target.at[0] - at[0], target.at[1] - at[1]);
      if (away < best) {
        best = away;
        found = target;
      }
    }
    return found;
  }

  /** Points, corners, centres and keyframes; while something is dragged, as they were at its start. */
  known() {
    const { store } = this.app;
    const isHeld = this.moving.length > 0 && this.doc !== null; // none of the others moves meanwhile
    if (isHeld || this.doc === store.doc) return this.targets;
    this.doc = store.doc;
    this.targets = targetsOf(store.doc).filter(({ id }) => !this.moving.includes(id) && (!this.isRoute || isPoint(id)));
    return this.targets;
  }

  /** @param {import("../draw/pen.js").Pen} pen */
  draw(pen) {
    if (!this.shown) return;
    const { ctx, camera } = pen;
    const colours = theme();
    const [x, y] = camera.toScreen(this.shown.at[0], this.shown.at[1]);
    ctx.beginPath();
    if (this.shown.name === null) { // a line of the grid either way
      ctx.moveTo(x - 16, y);
      ctx.lineTo(x + 16, y);
      ctx.moveTo(x, y - 16);
      ctx.lineTo(x, y + 16);
      pen.stroke(colours.select, 1);
      return;
    }
    ctx.rect(x - 12, y - 12, 24, 24);
    pen.stroke(colours.paper, 4);
    pen.stroke(colours.select, 2);
    ctx.font = "600 11px Inter, system-ui, sans-serif";
    const width = ctx.measureText(this.shown.name).width;
    ctx.beginPath();
    ctx.roundRect(x + 16, y - 28, width + 10, 18, 5);
    pen.fill(colours.select);
    ctx.fillStyle = colours.paper;
    ctx.textAlign = "left";
    ctx.textBaseline = "middle";
    ctx.fillText(this.shown.name, x + 21, y - 18.5);
  }
}

/** @param {any} doc @returns {(Target & {id: string})[]} `id` of what they belong to */
function targetsOf(doc) {
  const found = pointsOf(doc).flatMap(({ id, at, name }) => (at ? [{ id, at: at.slice(0, 2), name }] : []));
  const obstacles = obstaclesOf(doc);
  const areas = areasOf(doc).map(({ id, name }) => ({ id, name, shaped: shapedAt(doc, id) }));
  for (const { id, name, shape, item } of [...outlined(obstacles), ...movingOf(obstacles), ...areas.flatMap(({ id, name, shaped }) => (shaped ? [{ id, name, ...shaped }] : []))]) {
    const vertices = shape.vertices(item);
    vertices.forEach((at, i) => found.push({ id, at: [...at].slice(0, 2), name: `${name}, ${shape.vertexName} ${i + 1}` }));
    const anchor = vertices.length ? null : anchorOf(doc, id);
    if (anchor) found.push({ id, at: anchor.slice(0, 2), name: `${name}, middle` });
  }
  return found;
}
