// The groups of all meshes with levels of detail of a scene, chosen together: the meshes share the scene's GPU memory by
// the errors of their groups on the screen.

import type { CutMesh, MeshCut } from "../../levels/cut.ts";
import { chooseCut, groupMemory } from "../../levels/cut.ts";

export interface SharedMesh {
  /** The mesh as it is seen now; undefined: its index has not arrived. */
  cutMesh(): CutMesh | undefined;
  /** Its cut, or the memory that it may take, is another one since another mesh has changed. */
  followSharedCut(): void;
}

export interface SharedMeshCut extends MeshCut {
  /** GPU memory of the target. */
  readonly bytes: number;
  /** GPU memory that the mesh may take: its target, and an equal part of what the targets of all meshes leave. */
  readonly maxBytes: number;
}

const nothing: ReadonlySet<number> = new Set();
const scenes = new WeakMap<object, SharedCut>();

/** The cut of all meshes of a scene. */
export function sharedCutOf(scene: object, tolerance: number): SharedCut {
  const known = scenes.get(scene);
  if (known !== undefined) return known;
  const cut = new SharedCut(tolerance);
  scenes.set(scene, cut);
  return cut;
}

export class SharedCut {
  readonly #tolerance: number;
  readonly #meshes = new Set<SharedMesh>();
  #maxBytes = 0;
  /** Undefined: to be chosen again. */
  #cuts: ReadonlyMap<SharedMesh, SharedMeshCut> | undefined;
  #previousCuts: ReadonlyMap<SharedMesh, SharedMeshCut> = new Map();

  constructor(tolerance: number) {
    this.#tolerance = tolerance;
  }

  /** A mesh is seen in another way, or all of them may take another amount of GPU memory. */
  follow(mesh: SharedMesh, maxBytes: number): void {
    this.#meshes.add(mesh);
    this.#maxBytes = maxBytes;
    this.#cuts = undefined;
  }

  remove(mesh: SharedMesh): void {
    this.#meshes.delete(mesh);
    this.#cuts = undefined;
  }

  /** Something that the choice depends on has changed in a mesh. */
  invalidate(): void {
    this.#cuts = undefined;
  }

  /** Tells other meshes, in a microtask, where their cuts have changed. */
  cutOf(mesh: SharedMesh): SharedMeshCut {
    const cuts = this.#cuts ?? this.#choose();
    if (this.#cuts === undefined) {
      this.#cuts = cuts;
      for (const [other, cut] of cuts)
        if (other !== mesh && !isSame(cut, this.#previousCuts.get(other)))
          queueMicrotask(() => {
            if (this.#meshes.has(other)) other.followSharedCut();
          });
      this.#previousCuts = cuts;
    }
    return cuts.get(mesh) ?? { target: nothing, missingPages: nothing, bytes: 0, maxBytes: 0 };
  }

  /** A mesh whose index has not arrived is left an equal part of the memory. */
  #choose(): ReadonlyMap<SharedMesh, SharedMeshCut> {
    const all = Array.from(this.#meshes, (mesh) => ({ mesh, cutMesh: mesh.cutMesh() }));
    const known = all.flatMap(({ mesh, cutMesh }) => (cutMesh ? [{ mesh, cutMesh }] : []));
    const equalPart = this.#maxBytes / all.length;
    const budget = this.#maxBytes - (all.length - known.length) * equalPart;
    const { meshes, bytes } = chooseCut(
      known.map(({ cutMesh }) => cutMesh),
      { tolerance: this.#tolerance, budget },
    );
    const left = Math.max(0, budget - bytes) / Math.max(1, known.length);
    const cuts = new Map<SharedMesh, SharedMeshCut>();
    for (const [number, { mesh, cutMesh }] of known.entries()) {
      const cut = meshes[number] ?? { target: nothing, missingPages: nothing };
      let own = 0;
      for (const group of cut.target) own += groupMemory(cutMesh, group);
      cuts.set(mesh, { ...cut, bytes: own, maxBytes: own + left });
    }
    for (const { mesh, cutMesh } of all)
      if (!cutMesh) cuts.set(mesh, { target: nothing, missingPages: nothing, bytes: 0, maxBytes: equalPart });
    return cuts;
  }
}

function isSame(a: SharedMeshCut, b: SharedMeshCut | undefined): boolean {
  if (a.maxBytes !== b?.maxBytes || a.target.size !== b.target.size) return false;
  for (const group of a.target) if (!b.target.has(group)) return false;
  return true;
}
