// Decodes the attributes of a patch in workers: normals, texture coordinates and colors, from images of SIG classic.

import type { ImageFile, RecordLayout } from "../../../decode/classic/classicArrays.ts";
import type { GeometryDescription } from "../../../document/description.ts";
import type { VertexRole } from "../../../stage/attributeRows.ts";
import { withTexCoordRoles } from "../../../stage/attributeRows.ts";
import type { VertexArray } from "../../../stage/vertexArray.ts";
import type { BuilderTools } from "../../stageBuilder.ts";
import { normalFormatOf } from "./classicFormat.ts";

/** The available byte planes of an attribute, of `planeCount`. */
interface AttributeImages {
  readonly planes: readonly [ImageFile, ...ImageFile[]];
  readonly planeCount: number;
  readonly layout: RecordLayout;
}

/** Decodes an attribute in a worker. */
type AttributeDecoder = (
  run: BuilderTools["runJob"],
  images: AttributeImages,
  geometry: GeometryDescription,
  signal: AbortSignal,
) => Promise<VertexArray>;

export const attributeDecoders: Readonly<Record<VertexRole, AttributeDecoder>> = {
  normal: (run, { planes, planeCount, layout }, geometry, signal) =>
    planeCount > 1
      ? run("classicWords", { planes, components: 3, isSigned: true, ...layout }, signal)
      : run("classicNormals", { file: planes[0], format: normalFormatOf(geometry), ...layout }, signal),
  ...withTexCoordRoles(
    (): AttributeDecoder =>
      (run, { planes, layout }, { texCoordImageBits }, signal) =>
        run("classicTexCoords", { planes, firstBits: texCoordImageBits, ...layout }, signal),
  ),
  color: (run, { planes, planeCount, layout }, { colorComponents: components }, signal) =>
    planeCount > 1
      ? run("classicWords", { planes, components, isSigned: false, ...layout }, signal)
      : run("classicColors", { file: planes[0], components, ...layout }, signal),
};
