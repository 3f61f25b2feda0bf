import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { BufferAttribute, InterleavedBuffer, type LOD, type Object3D, PerspectiveCamera, Vector3 } from "three";
import { arrayTypeOf } from "../stage/elementType.ts";
import type { ElementType } from "../stage/elementType.ts";
import type { GpuArray } from "../stage/stage.ts";
import { deferredFile, siteOf, shortDelay, type Answer } from "../delivery/delivery.testing.ts";
import { elementsOf } from "../document/elements.testing.ts";
import type { BufferProvider } from "../render/uploads/bufferProvider.ts";
import { appShapeContext } from "./appShapeContext.ts";
import { makeStandardMaterials, standardMaterialOf } from "./standardMaterials.ts";
import { SceneContents } from "./sceneContents.ts";

const shape = (name: string) => `<Shape DEF="${name}"><BinaryGeometry vertexCount="3" coord="${name}.bin"/></Shape>`;
const triangle = () => new Uint8Array(36);

/** The contents of a scene in an app without a GPU. */
function appOf(markup: string, files: Record<string, Answer>) {
  const { pool, requested, aborted, arrayOf } = siteOf(files);
  const viewOf = (bytes: GpuArray, type: ElementType) => new (arrayTypeOf(type))(arrayOf({ bytes }).buffer);
  const buffers: BufferProvider = {
    ownsBuffers: true,
    recordsOf: (bytes, type, stride) => new InterleavedBuffer(viewOf(bytes, type), stride),
    indexAttributeOf: (bytes, type) => new BufferAttribute(viewOf(bytes, type), 1),
    read: (bytes, type, first, count = Infinity) => viewOf(bytes, type).slice(first, first + count),
    dispose: (geometry) => {
      geometry.dispose();
    },
  };
  const contents = new SceneContents(
    {
      x3d: elementsOf(markup),
      url: "https://site/scene.x3d",
      urlOf: (url) => new URL(url, "https://site/").href,
      pool,
      budget: Infinity,
    },
    appShapeContext(
      makeStandardMaterials(standardMaterialOf, {
        castShadow: false,
        receiveShadow: false,
        sphere: undefined as never,
      }),
      buffers,
      {
        textureOf: () => {
          throw new RangeError("there are none");
        },
      },
    ),
    {
      onChange: () => undefined,
      onError: (error) => {
        throw error;
      },
      onAdvance: () => undefined,
      onDocuments: () => undefined,
    },
  );
  contents.start();
  /**
   * Visits the scene as a frame of three.js from a camera position does, and returns the names of the shapes that it
   * draws.
   */
  const namesDrawnFrom = async (...eye: [number, number, number]) => {
    const camera = new PerspectiveCamera();
    camera.position.set(...eye);
    camera.updateMatrixWorld();
    contents.root.updateMatrixWorld();
    const names = namesDrawnIn(contents.root, camera);
    await shortDelay();
    return names;
  };
  /** Waits until all requested files have loaded. */
  const settled = async () => {
    while (!contents.isSettled) await shortDelay();
  };
  return { contents, requested, aborted, namesDrawnFrom, settled };
}

function isLod(object: object): object is Pick<LOD, "autoUpdate" | "update"> {
  return "isLOD" in object;
}

/** Visits objects in the order of WebGLRenderer, and returns the names of the shapes that it would draw. */
function namesDrawnIn(object: Object3D, camera: PerspectiveCamera): string[] {
  if (!object.visible) return [];
  if (isLod(object) && object.autoUpdate) object.update(camera);
  return [
    ...(object.type === "Mesh" ? [object.parent?.name ?? ""] : []),
    ...object.children.flatMap((child) => namesDrawnIn(child, camera)),
  ];
}

describe("the contents of a scene in a three.js app", () => {
  test("are requested if any of their instances is visible", async () => {
    const files = { "a.bin": triangle(), "b.bin": triangle() };
    const { contents, requested, namesDrawnFrom, settled } = appOf(
      `<X3D><Group visible="false"><Transform DEF="t">${shape("a")}</Transform>${shape("b")}</Group>
      <Transform USE="t"/></X3D>`,
      files,
    );
    assert.ok(!contents.isDisplayed && !contents.isSettled);
    await settled();
    assert.deepEqual([requested, await namesDrawnFrom(0, 0, 5), contents.isDisplayed], [["a.bin"], ["a"], true]);
  });

  test("display the level of a LOD that the nearest camera requires, and the previous level until that has loaded", async () => {
    const near = deferredFile(triangle());
    const { contents, requested, aborted, namesDrawnFrom, settled } = appOf(
      `<X3D><LOD DEF="lod" range="10">${shape("near")}${shape("far")}</LOD>
      <Transform translation="100 0 0"><LOD USE="lod"/></Transform></X3D>`,
      { "near.bin": near.promise, "far.bin": triangle() },
    );
    await settled();
    assert.deepEqual(requested, ["far.bin"]);
    assert.deepEqual(await namesDrawnFrom(0, 0, 50), ["far", "far"]);
    assert.deepEqual(await namesDrawnFrom(100, 0, 5), ["far", "far"]); // near one of the LOD's instances
    while (requested.length < 2) await shortDelay();
    assert.deepEqual([contents.isDisplayed, requested[1]], [false, "near.bin"]);
    await namesDrawnFrom(0, 0, 50);
    while (aborted.length === 0) await shortDelay(); // no camera requires the near level any more
    assert.ok(contents.isDisplayed);
    await namesDrawnFrom(0, 0, 5);
    near.release();
    while (requested.length < 3) await shortDelay();
    await settled();
    assert.deepEqual(await namesDrawnFrom(0, 0, 5), ["near", "far"]);
    assert.deepEqual(await namesDrawnFrom(0, 0, 50), ["far", "far"]);
    assert.deepEqual(requested, ["far.bin", "near.bin", "near.bin"]);
  });

  test("turn billboards to the camera, and observe no camera in a scene without billboards", async () => {
    const plain = appOf(`<X3D>${shape("a")}</X3D>`, { "a.bin": triangle() });
    assert.equal(plain.contents.root.getObjectByProperty("isLOD", true), undefined);
    const { contents, namesDrawnFrom, settled } = appOf(
      `<X3D><Billboard><Transform translation="0 0 1">${shape("a")}</Transform></Billboard></X3D>`,
      { "a.bin": triangle() },
    );
    await settled();
    const positionOf = () =>
      new Vector3()
        .setFromMatrixPosition(contents.root.getObjectByName("a")?.matrixWorld ?? contents.root.matrixWorld)
        .round()
        .toArray();
    contents.root.position.set(10, 0, 0); // as an app moves the scene
    await namesDrawnFrom(20, 0, 0);
    assert.deepEqual(positionOf(), [11, 0, 0]);
    await namesDrawnFrom(10, 0, -9);
    assert.deepEqual(
      positionOf().map((coordinate) => coordinate + 0),
      [10, 0, -1],
    );
  });

  test("request nothing after they were stopped, and remain displayed", async () => {
    const { contents, requested, namesDrawnFrom, settled } = appOf(
      `<X3D><LOD range="10">${shape("near")}${shape("far")}</LOD></X3D>`,
      { "near.bin": triangle(), "far.bin": triangle() },
    );
    await settled();
    contents.stop();
    assert.deepEqual(
      [await namesDrawnFrom(0, 0, 5), await namesDrawnFrom(0, 0, 5), requested],
      [["far"], ["far"], ["far.bin"]],
    );
    contents.dispose();
    assert.deepEqual(await namesDrawnFrom(0, 0, 5), []);
  });
});
