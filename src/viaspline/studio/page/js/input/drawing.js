/** What the tools draw, by a drag or corner by corner; it becomes an obstacle or an area. */

import { addArea, addObstacle } from "../core/edits.js";
import { shapeOf } from "../shapes/registry.js";
import { shapeToolOf } from "./tools.js";

/** @typedef {import("./pointer.js").Gesture} Gesture */
/** @typedef {import("../shapes/shape.js").Item} Item */

const CLICKED_PX = 40; // the size of what a click makes
const CLOSING_PX = 12; // from the first corner, where a click closes the ring

export class Drawing {
  /**
   * @param {import("../core/store.js").Store} store
   * @param {import("../geometry/camera.js").Camera} camera
   * @param {import("../draw/scene.js").Scene} scene
   * @param {(at: number[]) => number[]} snapped
   * @param {(text: string) => void} say
   */
  constructor(store, camera, scene, snapped, say) {
    this.store = store;
    this.camera = camera;
    this.scene = scene;
    this.snapped = snapped;
    this.say = say;
  }

  /** From where the mouse is pressed to where it is let go. @param {number[]} from @returns {Gesture} */
  drag(from) {
    const { drag } = shapeToolOf(this.store.tool) ?? {};
    if (!drag) return { move: () => {} };
    return {
      move: (at) => {
        const item = drag(from, at, this.snapped);
        this.scene.draft = { item, shape: shapeOf(item) };
        this.scene.later();
      },
      end: (moved, at) => {
        this.scene.draft = null;
        if (moved) this.finishObstacle(drag(from, at, this.snapped));
        else this.click(from);
      },
    };
  }

  /** Something of a size that can be seen. @param {number[]} at */
  click(at) {
    const { click } = shapeToolOf(this.store.tool) ?? {};
    if (click) this.finishObstacle(click(this.snapped(at), this.camera.step(CLICKED_PX)));
  }

  /** One corner more, or the first one again. @param {number} px @param {number} py @returns {Gesture} */
  corner(px, py) {
    const { scene, camera } = this;
    const corners = scene.draft?.corners ?? [];
    const first = corners[0] ? camera.toScreen(corners[0][0], corners[0][1]) : null;
    if (first && corners.length > 2 && Math.hypot(first[0] - px, first[1] - py) < CLOSING_PX) {
      this.close();
      return { move: () => {} };
    }
    this.addCorner(camera.toWorld(px, py));
    return { move: () => {} };
  }

  /** @param {number[]} at */
  addCorner(at) {
    const corners = this.scene.draft?.corners ?? [];
    const place = this.snapped(at), last = corners.at(-1);
    if (last && last[0] === place[0] && last[1] === place[1]) return;
    this.scene.draft = { corners: [...corners, place], at: null };
    this.say(`corner ${corners.length + 1}${corners.length >= 2 ? "; Enter closes the polygon" : ""}`);
    this.scene.later();
  }

  close() {
    const corners = this.scene.draft?.corners ?? [];
    const { tool } = this.store;
    this.scene.draft = null;
    if (corners.length < 3) this.say("a polygon needs three corners");
    else if (tool === "zone" || tool === "fence") this.finishArea(tool, corners);
    else {
      const item = shapeToolOf(tool)?.close?.(corners);
      if (item) this.finishObstacle(item);
    }
    this.scene.later();
  }

  /** @param {Item} obstacle */
  finishObstacle(obstacle) {
    const { store } = this;
    const doc = addObstacle(store.doc, "known", obstacle);
    store.edit(doc, { select: `known:${doc.world.known.length - 1}` });
    store.setTool("select");
    this.say(`${shapeOf(obstacle)?.name ?? "obstacle"} added`);
  }

  /** @param {"fence"|"zone"} kind @param {number[][]} corners */
  finishArea(kind, corners) {
    const { store } = this;
    const [doc, id] = addArea(store.doc, kind, corners);
    store.edit(doc, { select: id });
    store.setTool("select");
    this.say(kind === "fence" ? "fence added: the robot stays inside" : "speed zone added");
  }

  /** Stop what a tool has begun. */
  drop() {
    if (!this.scene.draft) return false;
    this.scene.draft = null;
    this.scene.later();
    return true;
  }
}
