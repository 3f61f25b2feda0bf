import assert from "node:assert/strict";
import { describe, test } from "node:test";
import type { BufferGeometry, DataTexture, InstancedBufferAttribute } from "three";
import {
  BufferAttribute,
  Group,
  InstancedBufferGeometry,
  InterleavedBuffer,
  MeshBasicMaterial,
  PerspectiveCamera,
  Sphere,
  Vector3,
} from "three";
import type { ElementArray } from "../../stage/vertexArray.ts";
import { arrayTypeOf, elementTypeOf } from "../../stage/elementType.ts";
import type { BufferStage, GpuArray } from "../../stage/stage.ts";
import type { AppearanceDescription } from "../../document/description.ts";
import type { BufferProvider } from "../uploads/bufferProvider.ts";
import type { DrawnObject } from "../primitives/drawnObject.ts";
import type { MaterialFactory, MaterialRequest } from "../materials/materialFactory.ts";
import { lateWideLines } from "../lines/lateWideLines.ts";
import { wideLines } from "../lines/wideLineParts.ts";
import { GeometryPool } from "../stages/geometryPool.ts";
import type { BatchedDraw, Member } from "./batch.ts";
import { Batches } from "./batches.ts";
import { maxVertices } from "./mergedMesh.ts";
import { backFaces, frontFaces, instanceFields, texelsPerInstance } from "../shaders/instanceRecord.ts";
import { maxRepeatedLines } from "./instancedGeometry.ts";

const white = [1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0];

const arrays = new WeakMap<GpuArray, ElementArray>();

const buffers: BufferProvider = {
  ownsBuffers: true,
  recordsOf: (bytes, type, stride) => new InterleavedBuffer(new (arrayTypeOf(type))(bytes.byteLength), stride),
  indexAttributeOf: () => new BufferAttribute(new Uint16Array(3), 1),
  read: (bytes, _, first, count = Infinity) => (arrays.get(bytes) ?? new Uint8Array()).subarray(first, first + count),
  dispose: (geometry) => {
    geometry.dispose();
  },
};

function stored(array: ElementArray) {
  const bytes: GpuArray = { byteLength: array.byteLength, close: () => undefined };
  arrays.set(bytes, array);
  return { bytes, type: elementTypeOf(array) };
}

/** A triangle whose vertices have three numbers in records of `stride` elements. */
function stageOf(first: number, stride = 4, index = [0, 1, 2]): BufferStage {
  const coord = new Uint16Array(3 * stride).map((_, i) => (i % stride < 3 ? first + i : 7));
  return {
    kind: "buffers",
    vertexCount: 3,
    name: "full",
    draws: [{ primitive: "triangles", first: 0, count: 3 }],
    normalFormat: { kind: "vector" },
    index: stored(new Uint16Array(index)),
    coord: { ...stored(coord), components: 3, stride, offset: 0 },
    attributes: {},
    value: undefined,
  };
}

/** The first coordinate of a stage's first vertex. */
function first({ coord }: BufferStage): number {
  return arrays.get(coord.bytes)?.[0] ?? 0;
}

function drawOf(stage: BufferStage, isMerged: boolean, vertexCount = 3, isBlended = false, solid = true): BatchedDraw {
  const [{ primitive, isWide } = { primitive: "triangles", isWide: false }] = stage.draws;
  const wideLineStep = isWide !== true ? 0 : primitive === "lineStrip" ? 1 : 2;
  const request = { primitive, wideLineStep, solid, uniforms: {} } as unknown as MaterialRequest;
  return {
    stage,
    ranges: stage.draws,
    isMerged,
    isBlended,
    vertexCount,
    bounds: new Sphere(new Vector3(), 1),
    origin: [0, 0, 0],
    step: [1, 1, 1],
    texCoordFrames: [0, 0, 1, 1],
    valueFrame: { min: [first(stage), 0, 0, 0], step: [2, 0, 0, 0] },
    request,
    appearance: {} as AppearanceDescription,
    surfaceTextures: new Map(),
    materialKey: isBlended ? "blended" : "",
  };
}

class Scene {
  readonly batches: Batches;
  #table: (() => DataTexture) | undefined;
  readonly #camera = new PerspectiveCamera(60, 1, 0.1, 100);

  constructor() {
    const materialFactory: MaterialFactory = {
      makeMaterial: ({ uniforms }) => {
        this.#table = () => uniforms.instances?.value as DataTexture;
        return new MeshBasicMaterial();
      },
      applyAppearance: () => undefined,
      prepareObject: () => undefined,
      batching: undefined,
    };
    this.batches = new Batches(materialFactory, new GeometryPool(buffers), buffers);
    this.#camera.position.z = 10;
    this.#camera.updateMatrixWorld();
  }

  add(draw: BatchedDraw, x: number, scale = 1, z = 0): Member {
    const group = new Group();
    moveGroup(group, x, scale, z);
    return this.batches.add(draw, white, group);
  }

  move(member: Member, x: number, z = 0): void {
    moveGroup(member.group, x, 1, z);
    this.batches.updateRecord(member);
  }

  hide(member: Member, isHidden = true): void {
    member.group.visible = !isHidden;
    this.batches.updateRecord(member);
  }

  /** The objects that the next frame draws. */
  frame(margin: readonly [number, number] = [0, 0]): DrawnObject[] {
    this.batches.setBoundingSphere(new Sphere(new Vector3(), 10));
    this.batches.update(this.#camera, margin);
    return (this.batches.root.children as DrawnObject[]).filter(({ visible }) => visible);
  }

  moveCameraToOtherSide(): void {
    this.#camera.position.z *= -1;
    this.#camera.lookAt(0, 0, 0);
    this.#camera.updateMatrixWorld();
  }

  record({ instanceIndex }: Member): number[] {
    const numbers = this.#table?.().image.data as Float32Array;
    return Array.from(
      numbers.subarray(4 * texelsPerInstance * instanceIndex, 4 * texelsPerInstance * (instanceIndex + 1)),
    );
  }
}

function moveGroup(group: Group, x: number, scale = 1, z = 0): void {
  group.matrix.makeScale(scale, 1, 1).setPosition(x, 0, z);
  group.matrixAutoUpdate = false;
  group.updateMatrixWorld(true);
}

function instancesIn({ geometry }: DrawnObject): number[] {
  assert.ok(geometry instanceof InstancedBufferGeometry);
  return Array.from(geometry.getAttribute("instanceIndex").array.subarray(0, geometry.instanceCount));
}

function meshIn({ geometry }: { geometry: BufferGeometry }) {
  const column = (name: string) => Array.from(geometry.getAttribute(name).array);
  return {
    index: Array.from(geometry.index?.array ?? []),
    instances: column("instanceIndex"),
    coords: (geometry.getAttribute("position") as unknown as { data: InterleavedBuffer }).data.array,
  };
}

describe("a stage with many instances", () => {
  const draw = drawOf(stageOf(0), false);

  test("is one draw call with the instances that the camera sees", () => {
    const scene = new Scene();
    const members = [-90, -2, 0, 2, 90].map((x) => scene.add(draw, x));
    const [drawn, ...others] = scene.frame();
    assert.ok(drawn);
    assert.equal(others.length, 0);
    assert.deepEqual(
      instancesIn(drawn),
      members.slice(1, 4).map((member) => member.instanceIndex),
    );
  });

  test("has no upper limit on its instances", () => {
    const scene = new Scene();
    for (let n = 0; n < 300; ++n) scene.add(draw, 0);
    const [drawn] = scene.frame();
    assert.ok(drawn);
    assert.equal(new Set(instancesIn(drawn)).size, 300);
  });

  test("updates when an instance is hidden, moved, and removed", () => {
    const scene = new Scene();
    const [first, second, third] = [0, 1, 2].map((x) => scene.add(draw, x)) as [Member, Member, Member];
    const [drawn] = scene.frame();
    assert.ok(drawn);
    scene.hide(first);
    scene.frame();
    assert.deepEqual(instancesIn(drawn), [second.instanceIndex, third.instanceIndex]);
    const before = scene.record(third);
    scene.move(second, 3);
    scene.frame();
    assert.equal(scene.record(second)[instanceFields.matrix + 3], 3);
    assert.deepEqual(scene.record(third), before);
    scene.batches.remove(second);
    scene.frame();
    assert.deepEqual(instancesIn(drawn), [third.instanceIndex]);
    const other = scene.add(drawOf(stageOf(9), false), 0);
    scene.frame();
    scene.move(other, 90);
    scene.batches.remove(third);
    scene.batches.remove(first);
    assert.deepEqual(scene.frame(), []);
    assert.equal(scene.batches.root.children.length, 2);
    scene.frame();
    assert.equal(scene.batches.root.children.length, 1, "an empty batch stays for one frame");
    scene.batches.remove(other);
    assert.equal(scene.batches.root.children.length, 0, "the last batch is removed at once");
  });

  test("draws mirrored instances separately, under a mirrored object, with records that do not mirror", () => {
    const scene = new Scene();
    const member = scene.add(draw, 1, -1);
    scene.add(draw, 0);
    const [drawn, ...others] = scene.frame().toReversed();
    assert.ok(drawn);
    assert.equal(others.length, 1);
    const mirrored = [drawn, ...others].find(({ matrixWorld }) => matrixWorld.determinant() < 0);
    assert.ok(mirrored);
    assert.deepEqual(instancesIn(mirrored), [member.instanceIndex]);
    const firstRow = scene.record(member).slice(0, 4);
    assert.deepEqual(
      firstRow.map((number) => number + 0), // -0 is 0
      [1, 0, 0, -1],
    );
    scene.move(member, 1);
    assert.equal(scene.frame().length, 1, "it has joined the other instances");
  });

  test("has matrices relative to the scene's centre, so that single precision is enough", () => {
    const scene = new Scene();
    const member = scene.add(draw, 1e7 + 0.25);
    scene.batches.setBoundingSphere(new Sphere(new Vector3(1e7, 0, 0), 10));
    assert.equal(scene.record(member)[instanceFields.matrix + 3], 0.25);
  });
});

test("10,000 shapes, half of them one mesh and half meshes of their own, take five draw calls", () => {
  const scene = new Scene();
  const ball = drawOf(stageOf(0), false);
  for (let n = 0; n < 5000; ++n) {
    scene.add(ball, 0);
    scene.add(drawOf(stageOf(n), true, 50), 0);
  }
  assert.equal(scene.frame().length, 5);
});

describe("small meshes", () => {
  test("are merged into one mesh, whatever the stride of their vertices", () => {
    const scene = new Scene();
    const [a, b] = [scene.add(drawOf(stageOf(100), true), 0), scene.add(drawOf(stageOf(200, 3), true), 1)];
    const [drawn, ...others] = scene.frame();
    assert.ok(drawn);
    assert.equal(others.length, 0);
    const { index, instances, coords } = meshIn(drawn);
    assert.deepEqual(index, [0, 1, 2, 3, 4, 5]);
    assert.deepEqual(instances, [
      a.instanceIndex,
      a.instanceIndex,
      a.instanceIndex,
      b.instanceIndex,
      b.instanceIndex,
      b.instanceIndex,
    ]);
    const vertices = Array.from({ length: 6 }, (_, v) => Array.from(coords.subarray(4 * v, 4 * v + 3)));
    assert.deepEqual(vertices, [
      [100, 101, 102],
      [104, 105, 106],
      [108, 109, 110],
      [200, 201, 202],
      [203, 204, 205],
      [206, 207, 208],
    ]);
  });

  test("are hidden through their records, and leave no triangle when removed", () => {
    const scene = new Scene();
    const members = Array.from({ length: 5 }, (_, n) => scene.add(drawOf(stageOf(10 * n), true), 0)) as [
      Member,
      Member,
      Member,
      ...Member[],
    ];
    scene.frame();
    scene.hide(members[0]);
    scene.frame();
    assert.deepEqual(
      members.map((member) => scene.record(member)[instanceFields.visibleInScope]),
      [0, 1, 1, 1, 1],
    );
    scene.batches.remove(members[1]);
    const [drawn] = scene.frame();
    assert.ok(drawn);
    assert.deepEqual(meshIn(drawn).index.slice(0, 9), [0, 1, 2, 0, 0, 0, 6, 7, 8]);
    scene.batches.remove(members[0]);
    scene.batches.remove(members[2]);
    const [packed] = scene.frame();
    assert.ok(packed);
    assert.deepEqual(
      meshIn(packed).instances,
      members.slice(3).flatMap((member) => Array<number>(3).fill(member.instanceIndex)),
      "it is rebuilt",
    );
  });

  test("cannot refer to other meshes' vertices, whatever their index contains", () => {
    const scene = new Scene();
    scene.add(drawOf(stageOf(0, 4, [0, 1, 9]), true), 0);
    scene.add(drawOf(stageOf(50), true), 0);
    const [drawn] = scene.frame();
    assert.ok(drawn);
    assert.deepEqual(meshIn(drawn).index, [0, 1, 2, 3, 4, 5]);
  });

  test("become several merged meshes beyond 16-bit indices, and separate ones where they are mirrored", () => {
    const scene = new Scene();
    const large = (first: number) => drawOf(stageOf(first), true, Math.ceil(maxVertices / 2));
    scene.add(large(0), 0);
    scene.add(large(1), 0);
    assert.equal(scene.frame().length, 2);
    scene.add(drawOf(stageOf(2), true), 0);
    assert.equal(scene.frame().length, 2);
    scene.add(drawOf(stageOf(3), true), 0, -1);
    assert.equal(scene.frame().length, 3);
  });

  test("are culled when all of them are out of view", () => {
    const scene = new Scene();
    const [left, right] = [scene.add(drawOf(stageOf(0), true), -90), scene.add(drawOf(stageOf(9), true), -80)];
    assert.deepEqual(scene.frame(), []);
    scene.move(right, 0);
    assert.equal(scene.frame().length, 1);
    scene.hide(right);
    scene.hide(left);
    assert.deepEqual(scene.frame(), []);
  });
});

describe("wide lines", () => {
  lateWideLines.add(wideLines);

  /** Two lines between three vertices. */
  function linesOf(start: number): BufferStage {
    return {
      ...stageOf(start),
      index: undefined,
      draws: [{ primitive: "lineStrip", first: 0, count: 3, isWide: true }],
    };
  }

  /** Per line: the instance, and the first coordinates of both ends. */
  function linesIn({ geometry }: DrawnObject): number[][] {
    assert.ok(geometry instanceof InstancedBufferGeometry);
    const [instances, begins, ends] = ["instanceIndex", "position", "positionEnd"].map(
      (name) => geometry.getAttribute(name) as InstancedBufferAttribute,
    );
    assert.ok(instances && begins && ends);
    return Array.from({ length: geometry.instanceCount }, (_, line) => {
      const { meshPerAttribute } = instances;
      return [instances.getX(Math.floor(line / meshPerAttribute)), begins.getX(line), ends.getX(line)];
    });
  }

  const linesAt = ({ instanceIndex: own }: Member, start: number) => [
    [own, start, start + 4],
    [own, start + 4, start + 8],
  ];

  test("of small meshes are one draw call, and nothing of removed ones remains", () => {
    const scene = new Scene();
    const members = [10, 20, 30].map((start) => scene.add(drawOf(linesOf(start), true), 0)) as [Member, Member, Member];
    const [drawn, ...others] = scene.frame();
    assert.ok(drawn);
    assert.equal(others.length, 0);
    assert.equal(drawn.type, "Mesh");
    assert.deepEqual(
      linesIn(drawn),
      members.flatMap((member, n) => linesAt(member, 10 * n + 10)),
    );
    scene.batches.remove(members[1]);
    const [left] = scene.frame();
    assert.ok(left);
    assert.deepEqual(linesIn(left), [...linesAt(members[0], 10), ...linesAt(members[2], 30)]);
  });

  test("of one mesh are one draw call for all instances, line by line", () => {
    const scene = new Scene();
    const draw = drawOf(linesOf(10), false);
    const first = scene.add(draw, 0);
    scene.frame();
    const others = [1, 2, -90].map((x) => scene.add(draw, x));
    const [drawn, ...further] = scene.frame();
    assert.ok(drawn);
    assert.equal(further.length, 0);
    assert.deepEqual(
      linesIn(drawn),
      [first, ...others.slice(0, 2)].flatMap((member) => linesAt(member, 10)),
    );
  });

  test("of large meshes are split into draw calls by the limit on repeated lines", () => {
    const scene = new Scene();
    const lineCount = Math.floor(maxRepeatedLines / 3) + 1;
    const stage = {
      ...linesOf(0),
      draws: [{ primitive: "lineStrip", first: 0, count: lineCount + 1, isWide: true }],
    } as const;
    const members = [0, 1, 2].map((x) => scene.add(drawOf(stage, false), x));
    const calls = scene.frame();
    assert.deepEqual(
      calls.map((call) => new Set(linesIn(call).map(([own]) => own)).size),
      [2, 1],
    );
    assert.deepEqual(
      new Set(calls.flatMap(linesIn).map(([own]) => own)),
      new Set(members.map((member) => member.instanceIndex)),
    );
  });

  test("that blend are drawn in depth order, also among surfaces", () => {
    const scene = new Scene();
    const [lines, panes] = [drawOf(linesOf(10), false, 3, true), drawOf(stageOf(0), true, 3, true)];
    const members = [
      scene.add(lines, 0, 1, 1),
      scene.add(panes, 0, 1, 0),
      scene.add(lines, 0, 1, -1),
      scene.add(lines, 0, 1, -2),
    ] as [Member, Member, Member, Member];
    const calls = scene.frame().toSorted((a, b) => a.renderOrder - b.renderOrder);
    assert.equal(calls.length, 3);
    const [far, , near] = calls;
    assert.ok(far && near);
    assert.deepEqual(
      linesIn(far).map(([own]) => own),
      [members[3], members[3], members[2], members[2]].map((member) => member.instanceIndex),
    );
    assert.deepEqual(
      linesIn(near).map(([own]) => own),
      [members[0], members[0]].map((member) => member.instanceIndex),
    );
  });

  test("are drawn while their width reaches into the view", () => {
    const scene = new Scene();
    const edge = 10 * Math.tan(Math.PI / 6); // half the height of the view at z = 0; the bounds have radius 1
    const [merged, instanced] = [
      scene.add(drawOf(linesOf(10), true), edge + 1.3),
      scene.add(drawOf(linesOf(20), false), -edge - 1.3),
    ];
    assert.equal(scene.frame().length, 0);
    assert.equal(scene.frame([0, 0.2]).length, 0);
    assert.equal(scene.frame([0.2, 0]).length, 2);
    for (const member of [merged, instanced]) scene.move(member, 2 * edge);
    assert.equal(scene.frame([0.2, 0.2]).length, 0);
  });
});

test("instance records hold what stored values mean, so that shapes of different ranges share a draw call", () => {
  const scene = new Scene();
  const members = [10, 20].map((start) => scene.add(drawOf(stageOf(start), true), 0));
  assert.equal(scene.frame().length, 1);
  const { valueMin, valueStep } = instanceFields;
  assert.deepEqual(
    members.map((member) => [scene.record(member)[valueMin], scene.record(member)[valueStep]]),
    [
      [10, 2],
      [20, 2],
    ],
  );
});

describe("blended draws", () => {
  /** Indices of the members that the next frame draws, in order, call by call. */
  function drawnMembers(scene: Scene, members: readonly Member[]): number[][] {
    const calls = scene.frame().toSorted((a, b) => a.renderOrder - b.renderOrder);
    return calls.map((call) =>
      instancesDrawnBy(call).map((number) => members.findIndex(({ instanceIndex: own }) => own === number)),
    );
  }

  /** The instance index of each triangle of a merged mesh, or of each instance of an instanced draw. */
  function instancesDrawnBy(call: DrawnObject): number[] {
    const { geometry } = call;
    if (geometry instanceof InstancedBufferGeometry) return instancesIn(call);
    const { index, instances } = meshIn(call);
    const { start, count } = geometry.drawRange;
    return index
      .slice(start, start + count)
      .filter((_, corner) => corner % 3 === 0)
      .map((vertex) => instances[vertex] ?? -1);
  }

  const depths = [3, -2, 5, 0, -4];

  for (const isMerged of [false, true]) {
    test(`are one draw call, the farthest first, from every side: ${isMerged ? "merged" : "instances"}`, () => {
      const scene = new Scene();
      const draw = drawOf(stageOf(0), isMerged, 3, true);
      const members = depths.map((z) => scene.add(draw, 0, 1, z));
      assert.deepEqual(drawnMembers(scene, members), [[4, 1, 3, 0, 2]]);
      scene.moveCameraToOtherSide();
      assert.deepEqual(drawnMembers(scene, members), [[2, 0, 3, 1, 4]]);
      scene.moveCameraToOtherSide();
      const [first, second] = members;
      assert.ok(first && second);
      scene.hide(first);
      scene.move(second, 90);
      assert.deepEqual(drawnMembers(scene, members), [[4, 3, 2]]);
      scene.hide(first, false);
      scene.batches.remove(second);
      const last = scene.add(draw, 0, 1, 4);
      assert.deepEqual(drawnMembers(scene, [...members.filter((member) => member !== second), last]), [
        [3, 2, 0, 4, 1],
      ]);
    });
  }

  test("alternate between batches in depth order, without opaque draws", () => {
    const scene = new Scene();
    const [merged, instances] = [drawOf(stageOf(0), true, 3, true), drawOf(stageOf(9), false, 3, true)];
    const members = [-4, -3, 1, 2].map((z) => scene.add(merged, 0, 1, z));
    members.push(...[-2, -1, 4].map((z) => scene.add(instances, 0, 1, z)));
    assert.deepEqual(drawnMembers(scene, members), [[0, 1], [4, 5], [2, 3], [6]]);
    scene.add(drawOf(stageOf(0), true), 0);
    const [opaque] = scene.frame().filter(({ renderOrder }) => renderOrder === 0);
    assert.equal(opaque?.geometry.index?.count, 3);
    const far = members.slice(2, 4);
    far.forEach((member, n) => {
      scene.move(member, 0, -6 + n);
    });
    assert.deepEqual(drawnMembers(scene, members).slice(1), [
      [2, 3, 0, 1],
      [4, 5, 6],
    ]);
  });

  for (const isMerged of [false, true]) {
    test(`with two sides draw back faces, then front faces: ${isMerged ? "merged" : "instances"}`, () => {
      const scene = new Scene();
      const draw = drawOf(stageOf(0), isMerged, 3, true, false);
      const [near, far] = [scene.add(draw, 0, 1, 1), scene.add(draw, 0, 1, -1)];
      const [call, ...others] = scene.frame();
      assert.ok(call);
      assert.equal(others.length, 0);
      assert.deepEqual(
        instancesDrawnBy(call),
        [far, near].flatMap((member) => [member.instanceIndex + backFaces, member.instanceIndex + frontFaces]),
      );
    });
  }
});
