// All that is drawn together in a scene: finds for each draw those that it can be
// drawn with, and keeps the table of their places true to the groups that they
// stand in.

import type { BufferGeometry, Camera } from "three";
import { Group, Matrix4, Sphere, Vector3 } from "three";
import type { BufferStage, Stage } from "../../stage/stage.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import { makeDrawnObject } from "../primitives/drawnObject.ts";
import type { MaterialFactory, MaterialRequest } from "../materials/materialFactory.ts";
import type { ShapeGroup } from "../lights/lightScopes.ts";
import type { GeometryPool } from "../stages/geometryPool.ts";
import { frustumOf } from "../frames/viewFrustum.ts";
import type { Batch, BatchedDraw, Member } from "./batch.ts";
import { runsOf } from "./depthOrder.ts";
import { InstancedBatch } from "./instancedBatch.ts";
import { MergedBatch } from "./mergedBatch.ts";
import { layoutOf } from "../attributes/vertexColumns.ts";
import { OrderedMergedBatch } from "./orderedMergedBatch.ts";
import { instanceFields } from "../shaders/instanceRecord.ts";
import { InstanceTable } from "./instanceTable.ts";

export class Batches {
  /** Hangs in the scene, near what is drawn: records of places count from it, in single precision. */
  readonly root = new Group();
  readonly #materialFactory: MaterialFactory;
  readonly #geometries: GeometryPool;
  readonly #buffers: BufferProvider;
  readonly #table = new InstanceTable();
  readonly #members = new Set<Member>();
  /** Those that are drawn in the order of their distance. */
  readonly #blended = new Set<Member>();
  /** By what their members have in common; new ones join the last. */
  readonly #batches = new Map<string, Batch[]>();
  /** They were empty before the last frame; until the next, others may need their programs. */
  #empty = new Set<Batch>();
  /** Those whose members blend. */
  readonly #inOrder = new WeakSet<Batch>();
  readonly #stageNumbers = new WeakMap<Stage, number>();
  #stageCount = 0;

  constructor(look: MaterialFactory, geometries: GeometryPool, buffers: BufferProvider) {
    this.#materialFactory = look;
    this.#geometries = geometries;
    this.#buffers = buffers;
    this.root.matrixAutoUpdate = false;
  }

  /** From now on the draw is in the group's place too. `look`: the field of that name in a place's record. */
  add(draw: BatchedDraw, look: readonly number[], group: ShapeGroup): Member {
    const member: Member = {
      draw,
      group,
      instanceIndex: this.#table.allocate(),
      batch: undefined,
      isVisible: false,
      isMirrored: false,
      sphere: new Sphere(),
    };
    this.#table.write(member.instanceIndex, instanceFields.texCoordFrame, draw.texCoordFrame);
    this.#table.write(member.instanceIndex, instanceFields.valueMin, draw.valueFrame.min);
    this.#table.write(member.instanceIndex, instanceFields.valueStep, draw.valueFrame.step);
    this.#table.write(member.instanceIndex, instanceFields.material, look);
    this.#members.add(member);
    if (draw.isBlended) this.#blended.add(member);
    this.#write(member, this.#rootFromScene);
    this.#join(member);
    return member;
  }

  /** Another look, for the same material. */
  setMaterialNumbers({ instanceIndex: place }: Member, look: readonly number[]): void {
    this.#table.write(place, instanceFields.material, look);
  }

  remove(member: Member): void {
    this.#members.delete(member);
    this.#blended.delete(member);
    member.batch?.remove(member);
    this.#table.release(member.instanceIndex);
    if (this.#members.size === 0) this.#disposeBatches(); // of a lost context nothing may be left for the next
  }

  /** Its group has moved, is shown or hidden, or stands in another light scope. */
  follow(member: Member): void {
    this.#followIn(this.#rootFromScene, member);
  }

  /** The scene's middle is there now. */
  sync({ center, radius }: Sphere): void {
    // A new origin changes every record: not for every move.
    const origin = new Vector3().setFromMatrixPosition(this.root.matrix);
    if (!(radius > 0) || origin.distanceTo(center) <= radius) return;
    this.root.matrix.setPosition(center);
    this.root.updateMatrixWorld(true);
    this.followAll();
  }

  /** All groups have moved, or stand in light scopes of other numbers. */
  followAll(): void {
    const rootFromScene = this.#rootFromScene;
    for (const member of this.#members) this.#followIn(rootFromScene, member);
  }

  /** Before a frame. `margin`: how far what is drawn reaches beyond its bounds, as `frustumOf` takes it. */
  update(camera: Camera, margin: readonly [number, number]): void {
    if (this.#batches.size === 0) return;
    this.#table.update();
    const viewFromRoot = new Matrix4().multiplyMatrices(camera.matrixWorldInverse, this.root.matrixWorld);
    const frustum = frustumOf(camera.projectionMatrix, viewFromRoot, margin);
    const runs = runsOf(this.#blended, frustum, viewFromRoot);
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
        if (this.#inOrder.has(batch)) batch.drawRuns(runs.get(batch) ?? []);
        else batch.update(frustum);
      }
      if (kept.length === 0) this.#batches.delete(key);
      else if (kept.length < batches.length) this.#batches.set(key, kept);
    }
  }

  dispose(): void {
    this.#disposeBatches();
    this.#members.clear();
    this.#blended.clear();
    this.#table.dispose();
  }

  #disposeBatches(): void {
    for (const batches of this.#batches.values()) for (const batch of batches) batch.dispose();
    this.#batches.clear();
    this.#empty.clear();
  }

  get #rootFromScene(): Matrix4 {
    return this.root.matrixWorld.clone().invert();
  }

  #followIn(rootFromScene: Matrix4, member: Member): void {
    const { isMirrored } = member;
    if (this.#write(member, rootFromScene)) member.batch?.invalidateBounds();
    if (member.isMirrored === isMirrored) return;
    member.batch?.remove(member);
    this.#join(member);
  }

  /** Whether what its batch knows of it has changed. */
  #write(member: Member, rootFromScene: Matrix4): boolean {
    const {
      draw: { shapeFromStored, bounds, step },
      group,
      instanceIndex: place,
      sphere,
    } = member;
    const rootFromStored = new Matrix4().multiplyMatrices(rootFromScene, group.matrixWorld).multiply(shapeFromStored);
    const [xx, xy, xz, , yx, yy, yz, , zx, zy, zz, , ox, oy, oz] = rootFromStored.elements;
    member.isVisible = group.visible;
    member.isMirrored = rootFromStored.determinant() < 0;
    // The object of what is mirrored is mirrored itself, so that three.js knows; its records are not.
    const turn = member.isMirrored ? -1 : 1;
    sphere.copy(bounds).applyMatrix4(rootFromStored);
    return this.#table.write(place, instanceFields.matrix, [
      turn * xx,
      turn * yx,
      turn * zx,
      turn * ox,
      xy,
      yy,
      zy,
      oy,
      xz,
      yz,
      zz,
      oz,
      ...step,
      member.isVisible ? 1 + (group.lightScope?.value ?? 0) : 0,
    ]);
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
    material.forceSinglePass = true; // three.js would draw all back faces of the batch before all front faces
    const addObject = (geometry: BufferGeometry) => {
      const object = makeDrawnObject(
        { primitive: request.primitive, isWide: request.wideLineStep > 0 },
        geometry,
        material,
      );
      object.frustumCulled = false; // `update` knows better
      object.matrixAutoUpdate = false;
      if (isMirrored) object.matrix.makeScale(-1, 1, 1);
      this.#materialFactory.prepareObject(object, request, material);
      this.root.add(object);
      object.updateMatrixWorld(true);
      return object;
    };
    const parts = { draw, material, addObject };
    const batch = !draw.isMerged
      ? new InstancedBatch(parts, this.#geometries)
      : draw.isBlended
        ? new OrderedMergedBatch(parts, this.#buffers)
        : new MergedBatch(parts, this.#buffers);
    if (draw.isBlended) this.#inOrder.add(batch);
    return batch;
  }

  /** The same for what one batch can draw. */
  #keyOf({ draw: { stage, ranges, isMerged, request, materialKey: lookKey }, isMirrored }: Member): string {
    const mesh = isMerged
      ? layoutOf(stage as BufferStage)
      : `${this.#numberOf(stage)} ${ranges.map((range) => stage.draws.indexOf(range)).join()}`;
    return JSON.stringify([mesh, request, lookKey, isMirrored], (name, value: unknown) =>
      name === "uniforms" || name === "shared" ? undefined : value,
    );
  }

  #numberOf(stage: Stage): number {
    const number = this.#stageNumbers.get(stage) ?? ++this.#stageCount;
    this.#stageNumbers.set(stage, number);
    return number;
  }
}
