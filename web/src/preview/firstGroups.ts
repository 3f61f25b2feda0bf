// The groups of meshes with levels of detail that the start view needs, as the runtime chooses them, and what a preview
// draws of them. Only scenes with such meshes load this module.

import type { Base } from "../decode/compact/baseBuffers.ts";
import type { LevelGroup } from "../decode/compact/levelGroup.ts";
import { groupOf } from "../decode/compact/levelGroup.ts";
import { DecodeError } from "../decode/decodeError.ts";
import { chooseCut, errorFactorOf, maxErrorFactor, tolerance } from "../levels/cut.ts";
import { drawRanges } from "../levels/drawRanges.ts";
import { checkCounts } from "../levels/groupCounts.ts";
import { addPageFile, groupUrl, levelPageUrl, readLevelIndex } from "../levels/levelFiles.ts";
import type { LevelIndex } from "../levels/levelIndex.ts";
import { levelViewsOf } from "../levels/levelViews.ts";
import { expectedBytesPerVertex, maxMeshBytes } from "../levels/meshMemory.ts";
import type { LevelView } from "../levels/projectedError.ts";
import { errorInPixels } from "../levels/projectedError.ts";
import type { Camera } from "../scheduler/viewMetrics.ts";
import type { EarlyLoading, EarlyRequest } from "./earlyLoading.ts";
import type { PreviewMesh } from "./previewRenderer.ts";
import type { PreviewScene } from "./previewScene.ts";

/** The bytes of a page of an index, before the index states them. */
const expectedPageBytes = 4000;

const none: ReadonlySet<number> = new Set();

/** A mesh with levels of detail, in all shapes that display it. */
interface Mesh {
  /** Absolute, of its index. */
  readonly url: string;
  /** Those of each shape. */
  readonly views: readonly LevelView[];
  /** The author's. */
  readonly priority: number;
}

interface IndexedMesh extends Mesh {
  readonly index: LevelIndex;
}

/** A mesh and the groups that its view needs: a legal cut. */
interface ChosenMesh extends IndexedMesh {
  readonly target: ReadonlySet<number>;
}

export class FirstGroups {
  /** For all groups that are not bases. */
  readonly requests: readonly EarlyRequest[];
  /** For those of which something is drawn: coarse forms of closed children, or level 0. */
  readonly drawnRequests: readonly EarlyRequest[];
  readonly #meshes: ReadonlyMap<string, ChosenMesh>;
  /** Decoded groups by the absolute URLs of their files. */
  readonly #groups = new Map<string, LevelGroup>();
  /** By the URL of the index, as long as all groups of the mesh are here. */
  readonly #drawn = new Map<string, readonly PreviewMesh[]>();

  constructor(meshes: readonly ChosenMesh[]) {
    this.requests = meshes.flatMap((mesh) => requestsOf(mesh, mesh.target));
    this.drawnRequests = meshes.flatMap((mesh) => requestsOf(mesh, drawnGroupsOf(mesh)));
    this.#meshes = new Map(meshes.map((mesh) => [mesh.url, mesh]));
  }

  /** Numbers of the groups of a mesh, by the absolute URL of its index. */
  groupsOf(indexUrl: string): readonly number[] {
    return Array.from(this.#meshes.get(indexUrl)?.target ?? none);
  }

  /** Adds the group in a file, by its absolute URL. */
  add(url: string, group: LevelGroup): void {
    this.#groups.set(url, group);
  }

  /**
   * What is drawn of a mesh, by the absolute URL of its index; undefined unless all groups of which something is drawn
   * are here and as the index states. `base`: its first group.
   */
  meshesOf(indexUrl: string, base: Base | undefined): readonly PreviewMesh[] | undefined {
    const mesh = this.#meshes.get(indexUrl);
    const drawn = this.#drawn.get(indexUrl) ?? (mesh && this.#meshesOf(mesh, base));
    if (drawn !== undefined) this.#drawn.set(indexUrl, drawn);
    return drawn;
  }

  /** Frees the arrays of all groups. */
  clear(): void {
    this.#groups.clear();
    this.#drawn.clear();
  }

  #meshesOf(mesh: ChosenMesh, base: Base | undefined): readonly PreviewMesh[] | undefined {
    const { url, index, target } = mesh;
    const drawn: PreviewMesh[] = [];
    for (const number of drawnGroupsOf(mesh)) {
      const group = number === 0 ? base && groupOf([base.decoded]) : this.#groups.get(groupUrl(url, number));
      if (group === undefined || !isAsStated(group, index, number)) return undefined;
      drawn.push({ buffers: group.buffers, ranges: drawRanges(index.children(number), group.segmentStarts, target) });
    }
    return drawn;
  }
}

export type ChooseFirstGroups = typeof chooseFirstGroups;

/**
 * Reads the indexes of a scene's meshes with levels of detail as far as its camera needs them, and chooses the groups.
 * `budget`: GPU memory of the scene in bytes. `absoluteUrlOf` makes a URL of the document absolute. Rejects if an index
 * cannot be had, or is not one of triangles that the document describes.
 */
export async function chooseFirstGroups(
  scene: PreviewScene,
  camera: Camera,
  budget: number,
  absoluteUrlOf: (url: string) => string,
  early: Pick<EarlyLoading, "request">,
): Promise<FirstGroups> {
  const read = async (url: string): Promise<Uint8Array<ArrayBuffer>> => {
    const request = { kind: "bytes", url, expectedBytes: expectedPageBytes, priority: maxErrorFactor } as const;
    const content = await early.request(request).decoded;
    if (!("bytes" in content)) throw new RangeError(`${url} is a file of another kind, too`);
    return content.bytes;
  };
  const meshes = await Promise.all(
    meshesIn(scene, camera, absoluteUrlOf).map(async (mesh): Promise<IndexedMesh> => {
      const index = await readLevelIndex(await read(mesh.url));
      if (index.hasPoints || index.hasChips) throw new DecodeError("malformed", "is no index of plain triangles");
      return { ...mesh, index };
    }),
  );
  for (;;) {
    const cut = chooseCut(
      meshes.map(({ index, views }) => ({
        index,
        errorInPixels: errorInPixels(index, views),
        open: none,
        absent: none,
        bytesPerVertex: expectedBytesPerVertex,
      })),
      { tolerance, budget: Math.min(budget, maxMeshBytes) },
    );
    const chosen = cut.meshes.flatMap((own, i) => (meshes[i] ? [{ ...meshes[i], ...own }] : []));
    const missing = chosen.flatMap(({ url, index, missingPages }) =>
      Array.from(missingPages, async (page) => {
        await addPageFile(index, page, await read(levelPageUrl(url, page)));
      }),
    );
    if (missing.length === 0) return new FirstGroups(chosen);
    await Promise.all(missing);
  }
}

function meshesIn({ shapes }: PreviewScene, camera: Camera, absoluteUrlOf: (url: string) => string): readonly Mesh[] {
  const meshes = new Map<string, Mesh>();
  for (const { geometry, priority, sceneFromShape } of shapes) {
    if (geometry.levels === undefined) continue;
    const url = absoluteUrlOf(geometry.levels.url);
    const before = meshes.get(url);
    const instances = [{ sceneFromShape: sceneFromShape.elements }];
    const views = levelViewsOf(geometry, { views: [{ camera, isOrthographic: false }], instances });
    meshes.set(url, {
      url,
      views: [...(before?.views ?? []), ...views],
      priority: Math.max(priority, before?.priority ?? 0),
    });
  }
  return Array.from(meshes.values());
}

/** The groups of the cut that have a closed child, or are of level 0. */
function drawnGroupsOf({ index, target }: ChosenMesh): readonly number[] {
  return Array.from(target).filter((group) => {
    const children = index.children(group);
    return children.length === 0 || !children.every((child) => target.has(child));
  });
}

/** For these groups, but the base. */
function requestsOf({ url, index, views, priority }: ChosenMesh, groups: Iterable<number>): EarlyRequest[] {
  const measure = errorInPixels(index, views);
  return Array.from(groups)
    .filter((group) => group !== 0)
    .map((group) => ({
      kind: "group",
      url: groupUrl(url, group),
      expectedBytes: index.bytes(group),
      priority: priority * errorFactorOf(measure(group)),
    }));
}

function isAsStated(group: LevelGroup, index: LevelIndex, number: number): boolean {
  try {
    checkCounts(group, index, number);
    return true;
  } catch {
    return false; // the runtime reports it
  }
}
