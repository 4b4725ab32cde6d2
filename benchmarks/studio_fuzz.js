// Random edits of every kind, made through the page's own modules. Read by studio_fuzz.py and tests.
(() => {
  window.studioFuzz = async (seed, count) => {
    const edits = await import("/page/js/core/edits.js");
    const mission = await import("/page/js/core/mission.js");
    const { store, camera } = studio;
    let state = seed >>> 0 || 1;
    const random = () => { // xorshift
      state ^= state << 13; state >>>= 0;
      state ^= state >>> 17;
      state ^= state << 5; state >>>= 0;
      return state / 2 ** 32;
    };
    const pick = (list) => list[Math.floor(random() * list.length)];
    const box = [20, 20, 480, 480];
    const place = () => [box[0] + random() * (box[2] - box[0]), box[1] + random() * (box[3] - box[1])].map((v) => Math.round(v * 10) / 10);
    const near = ([x, y], d) => [x + (random() - 0.5) * d, y + (random() - 0.5) * d].map((v) => Math.round(v * 100) / 100);
    const kinds = {
      move: () => { const id = pick(mission.idsOf(store.doc)); const at = id && mission.anchorOf(store.doc, id); return at ? edits.moveTo(store.doc, id, near(at, 30)) : store.doc; },
      via: () => ((store.doc.route.via ?? []).length < 9 ? edits.addVia(store.doc, Math.floor(random() * ((store.doc.route.via ?? []).length + 1)), place()) : store.doc),
      circle: () => ((store.doc.world.known ?? []).length < 20 ? edits.addObstacle(store.doc, pick(["known", "unseen"]), { circle: { center: place(), radius: 2 + Math.round(random() * 12) } }) : store.doc),
      polygon: () => {
        if ((store.doc.world.known ?? []).length >= 20) return store.doc;
        const [x, y] = place(), r = 4 + random() * 14;
        const n = 3 + Math.floor(random() * 4);
        return edits.addObstacle(store.doc, "known", { polygon: Array.from({ length: n }, (_, i) => [x + r * Math.cos((2 * Math.PI * i) / n), y + r * Math.sin((2 * Math.PI * i) / n)].map((v) => Math.round(v * 100) / 100)) });
      },
      remove: () => { const ids = mission.idsOf(store.doc).filter((id) => id !== "start" && id !== "goal"); return ids.length ? edits.remove(store.doc, pick(ids)) : store.doc; },
      tension: () => edits.setTension(store.doc, random() < 0.3 ? null : Math.floor(random() * mission.spanCount(store.doc)), Math.round((random() * 2 - 1) * 20) / 20),
      order: () => { const n = (store.doc.route.via ?? []).length; return n > 1 ? edits.moveVia(store.doc, Math.floor(random() * n), Math.floor(random() * n)) : store.doc; },
      side: () => { const n = (store.doc.world.known ?? []).length; return n ? edits.forceSide(store.doc, [Math.floor(random() * n)], pick(["left", "right", null, null])) : store.doc; },
      unseen: () => { const ids = mission.obstaclesOf(store.doc).map((o) => o.id); return ids.length ? edits.toggleUnseen(store.doc, pick(ids))[0] : store.doc; },
      zone: () => {
        const [x, y] = place(), r = 10 + random() * 60;
        return (store.doc.world.speed_zones ?? []).length < 4 ? edits.addArea(store.doc, "zone", [[x, y], [x + r, y], [x, y + r]])[0] : store.doc;
      },
      fence: () => ((store.doc.world.fences ?? []).length < 1 ? edits.addArea(store.doc, "fence", [[-5, -5], [505, -5], [505, 505], [-5, 505]])[0] : store.doc),
      clearance: () => edits.replaced(store.doc, ["robot", "clearance_m"], Math.round(random() * 30) / 10),
      heading: () => edits.setOnPoint(store.doc, "start", "heading_deg", random() < 0.3 ? undefined : Math.round(random() * 360)),
      dwell: () => { const n = (store.doc.route.via ?? []).length; return n ? edits.setOnPoint(store.doc, `via:${Math.floor(random() * n)}`, "dwell_s", random() < 0.5 ? undefined : Math.round(random() * 20)) : store.doc; },
    };
    const often = ["move", "move", "move", "move", "move", "move", "via", "circle", "polygon", "remove", "remove", "tension", "order", "side", "unseen", "clearance", "zone", "fence", "heading", "dwell", "undo", "undo", "redo", "zoom", "select"];
    for (let i = 0; i < count; i += 1) {
      const kind = pick(often);
      if (kind === "undo") store.undo();
      else if (kind === "redo") store.redo();
      else if (kind === "zoom") { camera.zoom(random() < 0.5 ? 0.8 : 1.25, random() * camera.width, random() * camera.height); store.tell("view"); }
      else if (kind === "select") store.select(pick([null, ...mission.idsOf(store.doc)]));
      else store.edit(kinds[kind](), { merge: random() < 0.3 ? "drag:fuzz" : null });
      if (i % 4 === 0) await new Promise((resolve) => setTimeout(resolve, 0));
      if (i % 100 === 99) { studio.fit(); await new Promise(requestAnimationFrame); }
    }
    await studio.settled();
    return store.revision;
  };

  // What is left has a path after the page's own remedies, or after obstacles are taken away.
  window.studioMend = async () => {
    const edits = await import("/page/js/core/edits.js");
    const { store } = studio;
    for (let i = 0; i < 60; i += 1) {
      await studio.settled();
      if (store.plan.ok) return true;
      const button = document.querySelector(".is-remedy");
      const list = (store.doc.world.known ?? []).length ? "known" : "unseen";
      if (button && i % 3 < 2) button.click();
      else store.edit(edits.remove(store.doc, `${list}:0`));
      await new Promise((resolve) => setTimeout(resolve, 150));
    }
    return store.plan.ok;
  };
})();
