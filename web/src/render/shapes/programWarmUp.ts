// Program warm-up: compiles the shader programs of shapes, as far as the document determines them,
// while the first files are loading. Drivers take a large fraction of a second for them, and drawing
// with a program that is not ready blocks the page.

import type { Camera, Object3D, Scene, WebGLRenderer } from "three";
import { BufferAttribute, BufferGeometry, Group, Texture } from "three";
import { attributeRows, vertexRoles } from "../../stage/attributeRows.ts";
import type { BufferStage, Stage, GpuVertices, TexelRange, TextureStage } from "../../stage/stage.ts";
import type { GeometryDescription, PatchDescription, ShapeDescription } from "../../document/description.ts";
import { hasShaderPrimitive, isDrawnFromImages } from "../../document/drawnFromImages.ts";
import { formatOf } from "../../document/encodings.ts";
import { isPair } from "../../document/description.ts";
import type { BatchingPlan } from "../batches/batchingPlan.ts";
import { drawModeOf } from "../batches/drawMode.ts";
import { makeDrawnObject } from "../primitives/drawnObject.ts";
import type { MaterialFactory, SceneUniforms } from "../materials/materialFactory.ts";
import type { SurfaceTexture } from "../materials/surfaceTextures.ts";
import { applicableTextures } from "../materials/surfaceTextures.ts";
import { materialRequestOf } from "../stages/materialRequests.ts";
import { operatedFormatOf } from "../operators/lateOperators.ts";
import { withWideLines } from "../lines/wideLines.ts";

const placeholderTexels: TexelRange = { image: { width: 1, height: 1, close: () => undefined }, firstTexel: 0 };
const placeholderTexture: SurfaceTexture = { texture: new Texture(), hasAlpha: false };

export class ProgramWarmUp {
  readonly #renderer: WebGLRenderer;
  readonly #camera: Camera;
  readonly #scene: Scene;
  /** Materials of these objects keep programs alive. */
  readonly #compiled = new Map<string, Object3D>();

  /** `scene` has the lights. */
  constructor(renderer: WebGLRenderer, camera: Camera, scene: Scene) {
    this.#renderer = renderer;
    this.#camera = camera;
    this.#scene = scene;
  }

  /** Starts compiling programs for the given shapes, without waiting for them. */
  compile(
    shapes: Iterable<ShapeDescription>,
    plan: BatchingPlan,
    materialFactory: MaterialFactory,
    shared: SceneUniforms,
  ): void {
    if (this.#renderer.getContext().isContextLost()) return;
    const newObjects = new Group();
    for (const [key, object] of warmUpObjects(shapes, plan, materialFactory, shared)) {
      if (this.#compiled.has(key)) continue;
      this.#compiled.set(key, object);
      newObjects.add(object);
    }
    if (newObjects.children.length > 0) this.#renderer.compile(newObjects, this.#camera, this.#scene);
  }
}

/**
 * One object per program, by a key of what makes programs differ. Covers stages from images on the GPU and base meshes
 * of compact; the formats of other buffers are known only when their files have come.
 */
function warmUpObjects(
  shapes: Iterable<ShapeDescription>,
  plan: BatchingPlan,
  materialFactory: MaterialFactory,
  shared: SceneUniforms,
): Map<string, Object3D> {
  const objects = new Map<string, Object3D>();
  const bare = new BufferGeometry();
  // three.js' programs differ by the attributes of the geometry.
  const attribute = new BufferAttribute(new Int8Array(3), 3);
  const inBuffers = new BufferGeometry().setAttribute("position", attribute).setAttribute("normal", attribute);
  for (const { geometry: described, appearance, visible } of shapes) {
    if (described === undefined || !visible) continue;
    const {
      textures,
      material: { kind, transparency },
      alpha,
      lines,
    } = appearance;
    const surfaceTextures = new Map(textures.map(({ role }) => [role, placeholderTexture]));
    for (const expected of expectedStages(described, textures.length > 0)) {
      const stage = lines ? withWideLines(expected) : expected;
      for (const range of stage.draws) {
        const applicable = applicableTextures(stage, appearance, surfaceTextures);
        const isBatched =
          materialFactory.batching !== undefined &&
          drawModeOf(stage, plan.drawModesOf(described), appearance, applicable, materialFactory.batching) !== "alone";
        const request = {
          ...materialRequestOf(stage, range, described, {}, shared, isBatched),
          ...operatedFormatOf(stage, described, appearance),
        };
        const key = JSON.stringify([
          { ...request, shared: undefined },
          kind,
          transparency > 0,
          alpha,
          ...applicable.keys(),
        ]);
        if (objects.has(key)) continue;
        const geometry = stage.kind === "buffers" ? inBuffers : bare;
        objects.set(
          key,
          makeDrawnObject(range, geometry, materialFactory.makeMaterial(request, appearance, applicable)),
        );
      }
    }
  }
  return objects;
}

/** Patches of one geometry hardly differ, so only the first is considered. */
function expectedStages(geometry: GeometryDescription, isTextured: boolean): Stage[] {
  const [patch] = geometry.patches;
  if (geometry.base !== undefined) return [expectedBase];
  if (
    patch === undefined ||
    patch.coord.length === 0 ||
    formatOf(geometry).storage !== "bytePlanes" ||
    !isDrawnFromImages(geometry, patch)
  )
    return [];
  const surface: TextureStage = {
    ...bareStage(geometry, patch),
    name: "surface",
    draws: patch.draws.filter(hasShaderPrimitive).map(({ primitive }) => ({ primitive, first: 0, count: 1 })),
    index: patch.index && placeholderTexels,
  };
  const stages: Stage[] = [surface];
  if (patch.index !== undefined)
    stages.push({ ...surface, name: "points", draws: [{ primitive: "points", first: 0, count: 1 }], index: undefined });
  let stage = surface;
  for (const role of vertexRoles) {
    if (patch[role] === undefined || (attributeRows[role].isForTextures && !isTextured)) continue;
    stage = { ...stage, name: "shaded", attributes: { ...stage.attributes, [role]: placeholderTexels } };
    stages.push(stage);
  }
  return stages;
}

const placeholderVertices: GpuVertices = {
  bytes: { byteLength: 0, close: () => undefined },
  type: "Int8",
  components: 3,
  stride: 4,
  offset: 0,
};

/** Without vertex colours, which a base may also have. */
const expectedBase: BufferStage = {
  kind: "buffers",
  vertexCount: 0,
  name: "base",
  draws: [{ primitive: "triangles", first: 0, count: 1 }],
  index: undefined,
  coord: placeholderVertices,
  attributes: { normal: placeholderVertices },
  normalFormat: { kind: "vector" },
  value: undefined,
};

function bareStage(
  { normalEncoding, normalBits, texCoordImageBits, indexType, colorComponents }: GeometryDescription,
  patch: PatchDescription,
): Omit<TextureStage, "name" | "draws" | "index"> {
  return {
    kind: "textures",
    grid: patch.grid,
    isIndexWide: indexType === "Uint32",
    implicitWidth: patch.implicitWidth,
    coord: [placeholderTexels],
    coordPlaneCount: patch.coord.length,
    missingBytesMidpoint: 0,
    attributes: {},
    normalFormat: isPair(normalEncoding) ? { kind: normalEncoding, bits: normalBits } : { kind: "byteVector" },
    texCoordBits: texCoordImageBits,
    colorComponents,
    value: undefined,
  };
}
