/** What the tools draw: circles, and polygons corner by corner, which become obstacles or areas. */

import { addArea, addObstacle, tidy } from "../core/edits.js";

/** @typedef {import("./pointer.js").Gesture} Gesture */

/** The tools that draw polygons. */
export const POLYGONS = ["polygon", "zone", "fence"];

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

  /** @param {number[]} from @returns {Gesture} */
  circle(from) {
    const center = this.snapped(from);
    const put = (/** @type {number[]} */ at) => {
      const [radius] = this.snapped([Math.hypot(at[0] - center[0], at[1] - center[1])]);
      this.scene.draft = { circle: { center, radius } };
      this.scene.later();
    };
    return {
      move: (at) => put(at),
      end: (moved, at) => {
        if (moved) put(at);
        const radius = moved ? this.scene.draft?.circle.radius : tidy(this.camera.step(40));
        this.scene.draft = null;
        this.finishObstacle({ circle: { center, radius: Math.max(radius || 0, 0.05) } });
      },
    };
  }

  /** @param {number} px @param {number} py @returns {Gesture} */
  polygon(px, py) {
    const { scene, camera } = this;
    const corners = scene.draft?.corners ?? [];
    const first = corners[0] ? camera.toScreen(corners[0][0], corners[0][1]) : null;
    if (first && corners.length > 2 && Math.hypot(first[0] - px, first[1] - py) < 12) {
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
    else this.finishObstacle({ polygon: corners });
    this.scene.later();
  }

  /** @param {any} obstacle */
  finishObstacle(obstacle) {
    const { store } = this;
    const doc = addObstacle(store.doc, "known", obstacle);
    store.edit(doc, { select: `known:${doc.world.known.length - 1}` });
    store.setTool("select");
    this.say("obstacle added");
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
