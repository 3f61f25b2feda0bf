// The files that a patch needs. Each encoding lists them (encodings/encodings.ts).

import type { PatchDescription, Reference } from "../document/description.ts";
import { cornerCountOf } from "../document/patchSizes.ts";
import type { Chunk } from "../scheduler/priority.ts";
import type { VertexRole } from "../stage/attributeRows.ts";
import { attributeRows, vertexRoles } from "../stage/attributeRows.ts";
import type { ContentTarget } from "./content.ts";

/** The arrays of a patch, in the order in which they become useful. PatchDescription has a member of each name. */
export const attributeRoles = ["coord", "index", "deformation", ...vertexRoles, "value"] as const;
export type AttributeRole = (typeof attributeRoles)[number];

/** What a file holds of a patch: a base mesh that stands in for it, the whole patch, or one attribute. */
export const fileRoles = ["base", "patch", ...attributeRoles] as const;
export type FileRole = (typeof fileRoles)[number];

export interface PatchFile {
  readonly role: FileRole;
  /** Index of the byte plane, most significant first; 0 where the role has one file. */
  readonly plane: number;
  readonly reference: Reference;
  /** The form that the downloaded bytes are decoded to. */
  readonly target: ContentTarget;
  /** The content that decides when the file is requested. */
  readonly chunk: Chunk;
  /** Estimated bytes of the file that the patch needs. */
  readonly expectedBytes: number;
  /** Estimated bytes on the GPU. */
  readonly storedBytes: number;
}

/** Whether only shapes with a texture need the file. */
export function isForTextures({ role }: PatchFile): boolean {
  return role in attributeRows && attributeRows[role as VertexRole].isForTextures;
}

/** Bytes of a texel on the GPU: three channels are stored as four. */
export const bytesPerTexel = 4;

/** What moves vertices is needed before anything can be drawn. */
function chunkOf(role: AttributeRole, plane: number): Chunk {
  if (role === "deformation") return { type: "coord", plane: 0 };
  if (role === "value") return { type: "color", plane };
  return { type: plane > 0 ? "refinement" : role, plane };
}

type FileSizes = Pick<PatchFile, "expectedBytes" | "storedBytes">;

/**
 * The files of a patch that has one or more for each attribute; `sizesOf` estimates the sizes of a file with
 * `elementCount` elements.
 */
export function attributeFilesOf(
  patch: PatchDescription,
  target: ContentTarget,
  sizesOf: (role: AttributeRole, reference: Reference, elementCount: number) => FileSizes,
): PatchFile[] {
  const cornerCount = cornerCountOf(patch);
  const filesOf = (role: AttributeRole, references: readonly (Reference | undefined)[]): PatchFile[] =>
    references.flatMap((reference, plane) =>
      reference === undefined
        ? []
        : {
            role,
            plane,
            reference,
            target,
            chunk: chunkOf(role, plane),
            ...sizesOf(role, reference, role === "index" ? cornerCount : patch.vertexCount),
          },
    );
  return attributeRoles.flatMap((role) =>
    filesOf(role, [patch[role], patch.lowBytes[role as VertexRole] ?? []].flat()),
  );
}
