/**
 * The bits of a position in compact: those that a file can have (docs/formats/compact.md), and those of a node that
 * states no `positionBits`. src/containers/compact/compact_patch.h has the same.
 */
export const packedPositionBits = { min: 1, max: 30, default: 16 } as const;
