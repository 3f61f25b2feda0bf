// Holds all batches of a scene, finds a batch for each member, and writes the records of members into
// the instance table.

import type { BufferGeometry, Camera } from "three";
import { Group, Matrix4, Sphere, Vector3 } from "three";
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
import { InstanceTable } from "./instanceTable.ts";
import { numbersPerFrame, StoredFrames } from "./storedFrames.ts";

export class Batches {
  /** Parent of all drawn objects, at the scene's centre: records hold single-precision matrices relative to it. */
  readonly root = new Group();
  readonly #materialFactory: MaterialFactory;
  readonly #geometries: GeometryPool;
  readonly #buffers: BufferProvider;
  readonly #table = new InstanceTable();
  readonly #frames = new StoredFrames();
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
  /** The numbers of a record that depend on the group. */
  readonly #record = new Float32Array(instanceFields.texCoordFrames);

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
      instanceIndex: this.#table.allocate(),
      batch: undefined,
      isVisible: false,
      isMirrored: false,
      sphere: new Sphere(),
    };
    this.#frames.set(member.instanceIndex, draw);
    this.#table.write(member.instanceIndex, instanceFields.texCoordFrames, draw.texCoordFrames);
    this.#table.write(member.instanceIndex, instanceFields.valueMin, draw.valueFrame.min);
    this.#table.write(member.instanceIndex, instanceFields.valueStep, draw.valueFrame.step);
    this.#table.write(member.instanceIndex, instanceFields.material, numbers);
    this.#members.add(member);
    (member.group.members ??= []).push(member);
    if (draw.isBlended) this.#blended.add(member);
    this.#write(member);
    this.#join(member);
    return member;
  }

  /** Replaces what BatchingRules.instanceNumbersOf returned for a member. */
  setMaterialNumbers({ instanceIndex }: Member, numbers: readonly number[]): void {
    this.#table.write(instanceIndex, instanceFields.material, numbers);
  }

  remove(member: Member): void {
    this.#members.delete(member);
    member.group.members = member.group.members?.filter((other) => other !== member);
    this.#blended.delete(member);
    member.batch?.remove(member);
    this.#table.release(member.instanceIndex);
    if (this.#members.size === 0) this.#disposeBatches(); // a restored context starts without objects of the lost one
  }

  /** Call when the group has moved. */
  follow({ members }: BatchedGroup): void {
    if (members) for (const member of members) this.updateRecord(member);
  }

  /** Call when the member's group has moved, has become visible or invisible, or has another effect scope. */
  updateRecord(member: Member): void {
    const { isMirrored } = member;
    if (this.#write(member)) member.batch?.invalidateBounds();
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
    this.#table.update();
    const viewFromRoot = new Matrix4().multiplyMatrices(camera.matrixWorldInverse, this.root.matrixWorld);
    const frustum = frustumOf(camera.projectionMatrix, viewFromRoot, margin);
    const runs = visibleRuns(this.#blended, frustum, viewFromRoot);
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
    this.#table.dispose();
  }

  #disposeBatches(): void {
    for (const batches of this.#batches.values()) for (const batch of batches) batch.dispose();
    this.#batches.clear();
    this.#empty.clear();
  }

  /**
   * Writes the matrix, lattice step, visibility and effect scope into the record. Returns whether one has changed. The
   * two products of matrices are written out: the root only translates, and stored coordinates are scaled and
   * translated.
   */
  #write(member: Member): boolean {
    const { group, sphere, instanceIndex } = member;
    const { elements: m } = group.matrixWorld;
    const { elements: root } = this.root.matrix;
    const frames = this.#frames.numbers;
    const at = instanceIndex * numbersPerFrame;
    const originX = frames[at] ?? 0;
    const originY = frames[at + 1] ?? 0;
    const originZ = frames[at + 2] ?? 0;
    const stepX = frames[at + 3] ?? 1;
    const stepY = frames[at + 4] ?? 1;
    const stepZ = frames[at + 5] ?? 1;
    member.isVisible = group.visible;
    member.isMirrored = isMirroring(m) !== stepX * stepY * stepZ < 0;
    // three.js detects mirroring by the object's matrix, so the object is mirrored, and the record
    // is multiplied by the same mirror.
    const mirror = member.isMirrored ? -1 : 1;
    const { 0: m0, 1: m1, 2: m2, 4: m4, 5: m5, 6: m6, 8: m8, 9: m9, 10: m10 } = m;
    const x = m0 * originX + m4 * originY + m8 * originZ + (m[12] - root[12]);
    const y = m1 * originX + m5 * originY + m9 * originZ + (m[13] - root[13]);
    const z = m2 * originX + m6 * originY + m10 * originZ + (m[14] - root[14]);
    const record = this.#record;
    record[0] = mirror * m0 * stepX;
    record[1] = mirror * m4 * stepY;
    record[2] = mirror * m8 * stepZ;
    record[3] = mirror * x;
    record[4] = m1 * stepX;
    record[5] = m5 * stepY;
    record[6] = m9 * stepZ;
    record[7] = y;
    record[8] = m2 * stepX;
    record[9] = m6 * stepY;
    record[10] = m10 * stepZ;
    record[11] = z;
    record[instanceFields.step] = stepX;
    record[instanceFields.step + 1] = stepY;
    record[instanceFields.step + 2] = stepZ;
    record[instanceFields.visibleInScope] = member.isVisible ? 1 + (group.effectScope?.value ?? 0) : 0;
    const centerX = (frames[at + 6] ?? 0) * stepX;
    const centerY = (frames[at + 7] ?? 0) * stepY;
    const centerZ = (frames[at + 8] ?? 0) * stepZ;
    sphere.center.x = m0 * centerX + m4 * centerY + m8 * centerZ + x;
    sphere.center.y = m1 * centerX + m5 * centerY + m9 * centerZ + y;
    sphere.center.z = m2 * centerX + m6 * centerY + m10 * centerZ + z;
    const scaleX = (m0 * m0 + m1 * m1 + m2 * m2) * stepX * stepX;
    const scaleY = (m4 * m4 + m5 * m5 + m6 * m6) * stepY * stepY;
    const scaleZ = (m8 * m8 + m9 * m9 + m10 * m10) * stepZ * stepZ;
    sphere.radius = (frames[at + 9] ?? 0) * Math.sqrt(Math.max(scaleX, scaleY, scaleZ));
    return this.#table.writeRounded(instanceIndex, record);
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
      uniforms: { ...draw.request.uniforms, instances: this.#table.uniform },
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
    const resources = { draw, material, addObject };
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

/** Whether an affine matrix has a negative determinant. */
function isMirroring(m: Matrix4["elements"]): boolean {
  return (
    m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8]) < 0
  );
}
