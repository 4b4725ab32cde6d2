/** Maps from files: they come from the server, as pictures or as rings. */

import { FROM_A_FILE } from "./shape.js";

/** @type {import("./shape.js").Shape} */
export const map = {
  ...FROM_A_FILE,
  key: "map",
  name: "map",
  icon: "M9 4L3 6.500v14L9 18l6 2.500 6-2.500v-14L15 6.500zM9 4v14M15 6.500v14",
  isSound: (item) => typeof item.map === "string",
  title: () => "map",
  usualName: (item) => item.map.replace(/^.*\//, ""),
  fields: (item) => [
    { type: "note", text: item.map },
    {
      type: "choice", label: "Squares that nobody has seen", value: item.unknown ?? "",
      options: [["", "blocked, as usual"], ["blocked", "blocked"], ["free", "free"]],
      put(now, value) {
        const { unknown: _, ...rest } = now;
        return value ? { ...now, unknown: value } : rest;
      },
    },
  ],
};
