// Holds all batches of a scene, finds a batch for each member, and writes the records of members into
// the instance table.

import type { BufferGeometry, Camera, Sphere } from "three";
import { Group, Matrix4, Vector3 } from "three";
import type { BufferStage, Stage } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import { makeDrawnObject } from "../primitives/drawnObject.ts";
import type { MaterialFactory, MaterialRequest } from "../materials/materialFactory.ts";
import type { ShapeGroup } from "../shapes/shapeGroup.ts";
import type { GeometryPool } from "../stages/geometryPool.ts";
import { frustumOf } from "../frames/viewFrustum.ts";
import type { Batch, BatchedDraw, BatchedGroup, Member } from "./batch.ts";
import { visibleRuns } from "./depthOrder.ts";
import { InstancedBatch } from "./instancedBatch.ts";
import { MergedBatch } from "./mergedBatch.ts";
import { layoutOf } from "../attributes/vertexColumns.ts";
import { OrderedMergedBatch } from "./orderedMergedBatch.ts";
import { instanceFields } from "../shaders/instanceRecord.ts";
import { MemberRecords } from "./memberRecords.ts";

export class Batches {
  /** Parent of all drawn objects, at the scene's centre: records hold single-precision matrices relative to it. */
  readonly root = new Group();
  readonly #materialFactory: MaterialFactory;
  readonly #geometries: GeometryPool;
  readonly #buffers: BufferProvider;
  readonly #records = new MemberRecords(this.root.matrix);
  readonly #members = new Set<Member>();
  /** Members of draws that blend. */
  readonly #blended = new Set<Member>();
  /** Batches by the key of their members. New members join the last batch of their key. */
  readonly #batches = new Map<string, Batch[]>();
  /**
   * Batches without members since the last frame. They are kept for one more frame, because new members may reuse
   * their programs.
   */
  #empty = new Set<Batch>();
  /** Batches whose members blend. */
  readonly #blendedBatches = new WeakSet<Batch>();
  /** Numbers that stand for stages in the keys of batches. */
  readonly #stageNumbers = new WeakMap<Stage, number>();
  #stageCount = 0;

  constructor(materialFactory: MaterialFactory, geometries: GeometryPool, buffers: BufferProvider) {
    this.#materialFactory = materialFactory;
    this.#geometries = geometries;
    this.#buffers = buffers;
    this.root.matrixAutoUpdate = false;
  }

  /** Adds a draw of an instance. `numbers`: as BatchingRules.instanceNumbersOf returns them. */
  add(draw: BatchedDraw, numbers: readonly number[], group: ShapeGroup): Member {
    const member: Member = {
      draw,
      group,
      instanceIndex: this.#records.add(draw, numbers),
      batch: undefined,
      isVisible: false,
      isMirrored: false,
    };
    this.#members.add(member);
    (member.group.members ??= []).push(member);
    if (draw.isBlended) this.#blended.add(member);
    this.#records.write(member);
    this.#join(member);
    return member;
  }

  /** Replaces what BatchingRules.instanceNumbersOf returned for a member. */
  setMaterialNumbers({ instanceIndex }: Member, numbers: readonly number[]): void {
    this.#records.table.write(instanceIndex, instanceFields.material, numbers);
  }

  remove(member: Member): void {
    this.#members.delete(member);
    member.group.members = member.group.members?.filter((other) => other !== member);
    this.#blended.delete(member);
    member.batch?.remove(member);
    this.#records.table.release(member.instanceIndex);
    if (this.#members.size === 0) this.#disposeBatches(); // a restored context starts without objects of the lost one
  }

  /** Call when the group has moved. */
  follow({ members }: BatchedGroup): void {
    if (members) for (const member of members) this.updateRecord(member);
  }

  /** Call when the member's group has moved, has become visible or invisible, or has another effect scope. */
  updateRecord(member: Member): void {
    const { isMirrored } = member;
    this.#records.write(member);
    member.batch?.invalidateBounds();
    if (member.isMirrored === isMirrored) return;
    member.batch?.remove(member);
    this.#join(member);
  }

  /** Call when the scene's bounding sphere has changed. */
  setBoundingSphere({ center, radius }: Sphere): void {
    // Every record depends on the origin, so the origin moves only when it is outside of the sphere.
    const origin = new Vector3().setFromMatrixPosition(this.root.matrix);
    if (!(radius > 0) || origin.distanceTo(center) <= radius) return;
    this.root.matrix.setPosition(center);
    this.root.updateMatrixWorld(true);
    this.updateAllRecords();
  }

  /** Call when all groups have moved or effect scopes have new numbers. */
  updateAllRecords(): void {
    for (const member of this.#members) this.updateRecord(member);
  }

  /** Call before a frame. `margin`: as in `frustumOf`. */
  update(camera: Camera, margin: readonly [number, number]): void {
    if (this.#batches.size === 0) return;
    this.#records.table.update();
    const viewFromRoot = new Matrix4().multiplyMatrices(camera.matrixWorldInverse, this.root.matrixWorld);
    const frustum = frustumOf(camera.projectionMatrix, viewFromRoot, margin);
    const runs = visibleRuns(this.#blended, this.#records.members, frustum, viewFromRoot);
    const emptyBefore = this.#empty;
    this.#empty = new Set();
    for (const [key, batches] of this.#batches) {
      const kept = batches.filter((batch) => !batch.isEmpty || !emptyBefore.has(batch));
      for (const batch of batches) {
        if (!kept.includes(batch)) {
          batch.dispose();
          continue;
        }
        if (batch.isEmpty) this.#empty.add(batch);
        if (this.#blendedBatches.has(batch)) batch.drawRuns(runs.get(batch) ?? []);
        else batch.update(frustum);
      }
      if (kept.length === 0) this.#batches.delete(key);
      else if (kept.length < batches.length) this.#batches.set(key, kept);
    }
  }

  dispose(): void {
    this.#disposeBatches();
    for (const { group } of this.#members) group.members = undefined;
    this.#members.clear();
    this.#blended.clear();
    this.#records.table.dispose();
  }

  #disposeBatches(): void {
    for (const batches of this.#batches.values()) for (const batch of batches) batch.dispose();
    this.#batches.clear();
    this.#empty.clear();
  }

  #join(member: Member): void {
    const key = this.#keyOf(member);
    const batches = this.#batches.get(key) ?? [];
    this.#batches.set(key, batches);
    let batch = batches.at(-1);
    if (batch?.hasRoomFor(member) !== true) {
      batch = this.#make(member);
      batches.push(batch);
    }
    member.batch = batch;
    batch.add(member);
  }

  #make({ draw, isMirrored }: Member): Batch {
    const request: MaterialRequest = {
      ...draw.request,
      uniforms: { ...draw.request.uniforms, instances: this.#records.table.uniform },
    };
    const material = this.#materialFactory.makeMaterial(request, draw.appearance, draw.surfaceTextures);
    material.forceSinglePass = true; // otherwise three.js draws all back faces of the batch before all front faces
    const addObject = (geometry: BufferGeometry) => {
      const object = makeDrawnObject(
        { primitive: request.primitive, isWide: request.wideLineStep > 0 },
        geometry,
        material,
      );
      object.frustumCulled = false; // `update` culls
      object.matrixAutoUpdate = false;
      if (isMirrored) object.matrix.makeScale(-1, 1, 1);
      this.#materialFactory.prepareObject(object, request, material);
      this.root.add(object);
      object.updateMatrixWorld(true);
      return object;
    };
    const resources = { draw, material, addObject, members: this.#records.members };
    const batch = !draw.isMerged
      ? new InstancedBatch(resources, this.#geometries)
      : draw.isBlended
        ? new OrderedMergedBatch(resources, this.#buffers)
        : new MergedBatch(resources, this.#buffers);
    if (draw.isBlended) this.#blendedBatches.add(batch);
    return batch;
  }

  /** A key that is equal for members that one batch can draw. */
  #keyOf({ draw: { stage, ranges, isMerged, request, materialKey }, isMirrored }: Member): string {
    const mesh = isMerged
      ? layoutOf(stage as BufferStage)
      : `${this.#numberOf(stage)} ${ranges.map((range) => stage.draws.indexOf(range)).join()}`;
    return JSON.stringify([mesh, request, materialKey, isMirrored], (name, value: unknown) =>
      name === "uniforms" || name === "shared" ? undefined : value,
    );
  }

  #numberOf(stage: Stage): number {
    const number = this.#stageNumbers.get(stage) ?? ++this.#stageCount;
    this.#stageNumbers.set(stage, number);
    return number;
  }
}
