/** Voxels from files: they come from the server, with all that stands in a world in space. */

import { FROM_A_FILE } from "./shape.js";

/** @type {import("./shape.js").Shape} */
export const voxels = {
  ...FROM_A_FILE,
  key: "voxels",
  name: "voxels",
  icon: "M4 8l4-2 4 2-4 2zM4 8v5l4 2v-5M12 8v5l-4 2M12 12l4-2 4 2-4 2zM12 12v5l4 2v-5M20 12v5l-4 2",
  hasSides: true,
  isSound: (item) => typeof item.voxels?.file === "string",
  title: () => "voxels",
  usualName: (item) => item.voxels.file.replace(/^.*\//, ""),
  fields: (item) => [{ type: "note", text: item.voxels.file }],
};
