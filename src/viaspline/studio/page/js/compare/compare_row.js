/** A row of the comparison: a variant, and what came of it. */

/** @typedef {{name: string, make: (doc: any) => any, state: "waiting"|"planning"|"done"|"stopped", result: any}} Row */

/** A row that nothing has come of yet. @param {import("./variant_kinds.js").Variant} variant @returns {Row} */
export const rowOf = ({ name, make }) => ({ name, make, state: "stopped", result: null });

/** What a row is called beside its path: A, B, C ... @param {number} index */
export const letterOf = (index) => String.fromCharCode(65 + index);
