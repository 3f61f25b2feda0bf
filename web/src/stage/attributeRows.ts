// The table of vertex attributes whose meaning formats and shaders know: one row for each. Documents, delivery,
// decoders and the renderer loop over the rows. Positions, indices and further attributes (FloatVertexAttribute) are
// not in it.

export interface AttributeRow {
  /** The number of components, unless the document states another. */
  readonly components: 2 | 3 | 4;
  /** The largest number of components. */
  readonly maxComponents: 2 | 3 | 4;
  /** Its name in vertex buffers, which is three.js' name. */
  readonly bufferName: string;
  /** The #define of materials whose vertices have it; undefined: three.js has one, or shaders read zeros instead. */
  readonly define?: string;
  /** Whether its files are requested only for shapes with a texture. */
  readonly isForTextures: boolean;
  /** Default weight of its files in the order of requests. */
  readonly chunkWeight: number;
  /** The name of a patch's stage while the attribute is missing; undefined: it makes no difference. */
  readonly stageWithout: "surface" | "shaded" | undefined;
  /** Its image in SIG classic: channels, and bytes of the file for each vertex (an estimate). */
  readonly classic: { readonly channels: 1 | 2 | 3 | 4; readonly bytesPerVertex: number };
}

/** A set of texture coordinates beside the first. */
function furtherTexCoords<Set extends 1 | 2 | 3>(set: Set) {
  return {
    components: 2,
    maxComponents: 2,
    bufferName: `uv${set}`,
    define: `HAS_TEX_COORDS_${set}`,
    isForTextures: true,
    chunkWeight: 32,
    stageWithout: undefined,
    classic: { channels: 4, bytesPerVertex: 3 },
  } as const satisfies AttributeRow;
}

// In the order in which they become useful.
const rows = {
  normal: {
    components: 3,
    maxComponents: 3,
    bufferName: "normal",
    isForTextures: false,
    chunkWeight: 64,
    stageWithout: "surface",
    classic: { channels: 3, bytesPerVertex: 2.2 },
  },
  texCoord: {
    components: 2,
    maxComponents: 2,
    bufferName: "uv",
    define: "HAS_TEX_COORDS",
    isForTextures: true,
    chunkWeight: 32,
    stageWithout: undefined,
    classic: { channels: 4, bytesPerVertex: 3 },
  },
  texCoord1: furtherTexCoords(1),
  texCoord2: furtherTexCoords(2),
  texCoord3: furtherTexCoords(3),
  color: {
    components: 3,
    maxComponents: 4,
    bufferName: "color",
    isForTextures: false,
    chunkWeight: 16,
    stageWithout: "shaded",
    classic: { channels: 3, bytesPerVertex: 2 },
  },
} as const satisfies Record<string, AttributeRow>;

/** The name of a row. Fields of documents, members of descriptions and members of the shaders' `Vertex` have it too. */
export type VertexRole = keyof typeof rows;

export const attributeRows: Readonly<Record<VertexRole, AttributeRow>> = rows;

/** In the order in which the attributes become useful. */
export const vertexRoles = Object.keys(rows) as readonly VertexRole[];

/** The roles of texture coordinates, by set. Each texture of an appearance states its set. */
export const texCoordRoles = ["texCoord", "texCoord1", "texCoord2", "texCoord3"] as const satisfies VertexRole[];

/** A member for each set of texture coordinates. */
export function withTexCoordRoles<Value>(
  valueOf: (set: number) => Value,
): Record<(typeof texCoordRoles)[number], Value> {
  const [texCoord, texCoord1, texCoord2, texCoord3] = [valueOf(0), valueOf(1), valueOf(2), valueOf(3)];
  return { texCoord, texCoord1, texCoord2, texCoord3 };
}

/** What is known of some attributes; others are undefined. */
export type ByVertexRole<Value> = Readonly<Partial<Record<VertexRole, Value | undefined>>>;

/** A member for each attribute. */
export function byVertexRole<Value>(valueOf: (role: VertexRole) => Value): Record<VertexRole, Value> {
  return withRoleKeys((role) => role, valueOf);
}

/** A member for each attribute, with the role's name before a suffix as its key: "normalType". */
export function byVertexRoleWith<Suffix extends string, Value>(
  suffix: Suffix,
  valueOf: (role: VertexRole) => Value,
): Record<`${VertexRole}${Suffix}`, Value> {
  return withRoleKeys((role) => `${role}${suffix}` as const, valueOf);
}

function withRoleKeys<Key extends string, Value>(
  keyOf: (role: VertexRole) => Key,
  valueOf: (role: VertexRole) => Value,
): Record<Key, Value> {
  return Object.fromEntries(vertexRoles.map((role) => [keyOf(role), valueOf(role)])) as Record<Key, Value>;
}
