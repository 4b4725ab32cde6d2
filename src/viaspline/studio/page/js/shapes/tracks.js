/** Recorded motions from files: a disc for each id in it, which come from the server. */

import { FROM_A_FILE } from "./shape.js";

const SMALLEST_M = 0.01;

/** @type {import("./shape.js").Shape} */
export const tracks = {
  ...FROM_A_FILE,
  key: "tracks",
  name: "recorded tracks",
  icon: "M4 18c4 0 4-6 8-6s4-6 8-6M4 18h.01M12 12h.01M20 6h.01",
  isSound: (item) => typeof item.tracks === "string",
  title: () => "recorded tracks",
  usualName: (item) => item.tracks.replace(/^.*\//, ""),
  fields: (item) => [
    { type: "note", text: item.tracks },
    { type: "number", label: "Radius of the discs", unit: "m", min: SMALLEST_M, value: Number(item.radius_m), put: (now, value) => ({ ...now, radius_m: value }) },
    {
      type: "choice", label: "Where rows end, a disc", value: item.after ?? "stay",
      options: [["stay", "stays"], ["vanish", "vanishes"], ["loop", "begins again"], ["bounce", "goes back"]],
      put: (now, value) => ({ ...now, after: value }),
    },
  ],
};
