/** Several things selected at once: added one by one, by a box, or all; moved and taken out together. */

import { anchorOf, areasOf, movingOf, obstaclesOf, outlined, pointsOf, shapedAt, whole } from "../core/mission.js";
import { theme } from "../draw/theme.js";
import { allOf, countWords, groupable, movedBy, withoutAll } from "./group_edits.js";

/** @typedef {import("../input/pointer.js").Gesture} Gesture */

export class Selecting {
  /** @param {any} app */
  constructor(app) {
    this.app = app;
    /** The box that is drawn: two of its corners [m]. @type {number[][]|null} */ this.box = null;
    app.scene.overlays.push((/** @type {import("../draw/pen.js").Pen} */ pen) => this.draw(pen));
  }

  get isGroup() {
    return this.app.store.chosen.length > 1;
  }

  /** Select it besides what is selected, or no longer. @param {string} id */
  toggle(id) {
    const { store } = this.app;
    const one = groupable(id);
    if (!one) return;
    const rest = store.chosen.map((/** @type {string} */ other) => groupable(other)).filter((/** @type {string|null} */ other) => other && other !== one);
    const isIn = store.chosen.some((/** @type {string} */ other) => whole(other) === one);
    if (isIn) store.select(rest.at(-1) ?? null, rest);
    else store.select(one, [...rest, one]);
    this.tell();
  }

  /** Keep the one that is selected, while Tab goes on to others; or let it go. */
  pin() {
    const { store } = this.app;
    const one = groupable(store.selection);
    if (!one) return;
    const isPinned = store.others.includes(one);
    store.select(one, isPinned ? store.others.filter((/** @type {string} */ id) => id !== one) : [...store.others, one]);
    this.app.say(isPinned ? "no longer kept" : `kept; Tab goes on to the next; ${countWords(store.chosen)} selected`);
  }

  all() {
    const ids = allOf(this.app.store.doc);
    this.app.store.select(ids.at(-1) ?? null, ids);
    this.tell();
  }

  tell() {
    const { chosen } = this.app.store;
    this.app.say(chosen.length ? `${countWords(chosen)} selected` : "nothing is selected");
  }

  /** Draw a box; what lies in it is selected besides. @param {number[]} from @returns {Gesture} */
  boxed(from) {
    const { app } = this;
    const before = app.store.chosen;
    return {
      move: (at) => {
        this.box = [from, at];
        app.scene.later();
      },
      end: (moved, at) => {
        this.box = null;
        app.scene.later();
        if (!moved) return;
        const found = this.within(from, at);
        const ids = [...new Set([...before.map((/** @type {string} */ id) => groupable(id)).filter(Boolean), ...found])];
        app.store.select(ids.at(-1) ?? null, ids);
        this.tell();
      },
      cancel: () => {
        this.box = null;
        app.scene.later();
      },
    };
  }

  /** What lies whole within a box. @param {number[]} a @param {number[]} b @returns {string[]} */
  within(a, b) {
    const { doc } = this.app.store;
    const low = [Math.min(a[0], b[0]), Math.min(a[1], b[1])], high = [Math.max(a[0], b[0]), Math.max(a[1], b[1])];
    const isIn = (/** @type {number[]|null|undefined} */ box) => !!box && box[0] >= low[0] && box[1] >= low[1] && box[2] <= high[0] && box[3] <= high[1];
    const obstacles = obstaclesOf(doc);
    return [
      ...pointsOf(doc).filter(({ at }) => at && isIn([at[0], at[1], at[0], at[1]])).map(({ id }) => id),
      ...[...outlined(obstacles), ...movingOf(obstacles)].filter(({ shape, item }) => isIn(shape.box(item))).map(({ id }) => id),
      ...areasOf(doc).filter(({ id }) => {
        const area = shapedAt(doc, id);
        return area && isIn(area.shape.box(area.item));
      }).map(({ id }) => id),
    ];
  }

  /** All that is selected is dragged by one of it. @param {string} id @param {number[]} from @returns {Gesture} */
  dragged(id, from) {
    const { store, pointer } = this.app;
    const { doc, chosen } = store;
    const anchor = anchorOf(doc, id) ?? from;
    const merge = `drag:${pointer.dragging.count}`;
    const [dx, dy] = [anchor[0] - from[0], anchor[1] - from[1]];
    pointer.canvas.style.cursor = "grabbing";
    pointer.snap.begin(chosen);
    return {
      move: (at, event) => {
        const place = pointer.snapped([at[0] + dx, at[1] + dy]);
        store.edit(movedBy(doc, chosen, [place[0] - anchor[0], place[1] - anchor[1]]), { merge, inputAt: event.timeStamp });
      },
      end: (moved) => {
        if (!moved) store.select(id);
      },
    };
  }

  /** Move all of it by a step of the keyboard. @param {number[]} by [m] */
  nudge(by) {
    const { store, say } = this.app;
    store.edit(movedBy(store.doc, store.chosen, by), { merge: `nudge:${store.chosen.join()}` });
    say(`${countWords(store.chosen)} moved`);
  }

  /** Take out all that is selected, as one step. */
  erase() {
    const { store, say } = this.app;
    const chosen = [...new Set(store.chosen.map((/** @type {string} */ id) => groupable(id)).filter(Boolean))];
    const { doc, left } = withoutAll(store.doc, chosen);
    if (doc === store.doc) {
      say("that can't be deleted");
      return;
    }
    const { revision } = store;
    store.edit(doc);
    if (store.revision === revision) return; // it stands in another file: that was told
    store.select(null);
    say(`${countWords(chosen.filter((id) => !left.includes(id)))} deleted${left.length ? "; the rest is needed" : ""}`);
  }

  /** What is selected besides, and the box. @param {import("../draw/pen.js").Pen} pen */
  draw(pen) {
    const { ctx, camera } = pen;
    const { store } = this.app;
    const colours = theme();
    for (const id of store.chosen) {
      if (id === store.selection) continue;
      const found = shapedAt(store.doc, id);
      ctx.beginPath();
      if (found?.shape.hasOutline) {
        found.shape.trace(pen, found.item);
        pen.stroke(colours.select, 2.5);
        continue;
      }
      const at = anchorOf(store.doc, id);
      if (!at) continue;
      const [x, y] = camera.toScreen(at[0], at[1]);
      ctx.arc(x, y, 15, 0, 2 * Math.PI);
      pen.fill(colours.selectSoft);
      pen.stroke(colours.select, 2);
    }
    if (!this.box) return;
    const [[ax, ay], [bx, by]] = this.box.map(([x, y]) => camera.toScreen(x, y));
    ctx.beginPath();
    ctx.rect(Math.min(ax, bx), Math.min(ay, by), Math.abs(bx - ax), Math.abs(by - ay));
    pen.fill(colours.selectSoft);
    pen.stroke(colours.select, 1.5, [5, 4]);
  }
}
