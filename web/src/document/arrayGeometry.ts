// Describes vertex arrays as BG geometry in data: URLs, so that delivery treats them like files.

import type { ByVertexRole } from "../stage/attributeRows.ts";
import { byVertexRole, byVertexRoleWith, texCoordRoles } from "../stage/attributeRows.ts";
import { dataUrl } from "./dataUrl.ts";
import type { AttributeDescription, Box3, GeometryDescription, Reference } from "./description.ts";
import { fogDepthName } from "./description.ts";
import type { MovingGeometry } from "./movingGeometry.ts";
import type { VertexArrays } from "../tessellate/faces.ts";
import type { Vec3 } from "./fieldTypes.ts";

/** Undefined for absent or empty arrays. `texCoordMappings`: the names of the sets of texture coordinates. */
export function geometryOfArrays(
  arrays: VertexArrays | undefined,
  solid: boolean,
  texCoordMappings?: readonly string[],
): GeometryDescription | undefined {
  if (arrays === undefined || arrays.positions.length === 0) return undefined;
  const geometry = describe(arrays, solid, texCoordMappings, dataReference);
  return { ...geometry, patches: geometry.patches.map((patch) => ({ ...patch, box: boxAroundAll(arrays.positions) })) };
}

/** Geometry without files, whose vertices are those of `moving`. Its bounds change, and so are no part of it. */
export function geometryOfMovingArrays(
  moving: MovingGeometry,
  solid: boolean,
  texCoordMappings?: readonly string[],
): GeometryDescription {
  const noFile = { url: "", byteOffset: 0, byteStride: 0 };
  return { ...describe(moving.arrays, solid, texCoordMappings, () => noFile), moving };
}

function describe(
  arrays: VertexArrays,
  solid: boolean,
  texCoordMappings: readonly string[] = [""],
  referenceTo: (array: Float32Array | Uint8Array) => Reference,
): GeometryDescription {
  const {
    positions,
    normals,
    texCoords,
    furtherTexCoords = [],
    colors,
    colorComponents,
    primitive,
    fogDepths,
  } = arrays;
  const count = positions.length / 3;
  const [texCoord1, texCoord2, texCoord3] = furtherTexCoords;
  const array: ByVertexRole<Float32Array | Uint8Array> = {
    normal: normals,
    texCoord: texCoords,
    texCoord1,
    texCoord2,
    texCoord3,
    color: colors,
  };
  return {
    encoding: "bg",
    position: [0, 0, 0],
    size: [1, 1, 1],
    positionBits: 0,
    solid,
    ccw: true,
    texCoordBoxes: texCoordRoles.map(() => ({ min: [0, 0], size: [1, 1] })),
    texCoordMappings,
    colorComponents,
    normalEncoding: "rgb",
    normalBits: 8,
    texCoordImageBits: 16,
    decode: "auto",
    base: undefined,
    attributes: fogDepths ? [fogDepthDescription] : [],
    value: undefined,
    indexType: "Uint32",
    coordType: "Float32",
    ...byVertexRoleWith("Type", (role) => (role === "color" ? "Uint8" : "Float32")),
    patches: [
      {
        box: undefined,
        vertexCount: count,
        draws: [{ primitive, count }],
        implicitWidth: 1,
        implicitHeight: 1,
        grid: undefined,
        gridOrigin: [0, 0],
        index: undefined,
        coord: [referenceTo(positions)],
        ...byVertexRole((role) => array[role] && referenceTo(array[role])),
        attributes: fogDepths ? [referenceTo(fogDepths)] : [],
        value: [],
        lowBytes: {},
        data: undefined,
      },
    ],
  };
}

const fogDepthDescription: AttributeDescription = {
  name: fogDepthName,
  components: 1,
  fileCount: 1,
  bits: undefined,
  min: [],
  size: [],
};

function boxAroundAll(positions: Float32Array): Box3 {
  const cornerOf = (choose: (...values: number[]) => number, start: number): Vec3 => {
    const corner: [number, number, number] = [start, start, start];
    positions.forEach((value, i) => {
      corner[i % 3] = choose(corner[i % 3] ?? start, value);
    });
    return corner;
  };
  return { min: cornerOf(Math.min, Infinity), max: cornerOf(Math.max, -Infinity) };
}

/** BG is little-endian, as are typed arrays on every machine with a browser. */
function dataReference(array: Float32Array | Uint8Array): Reference {
  const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  return { url: dataUrl("application/octet-stream", bytes), byteOffset: 0, byteStride: 0 };
}
