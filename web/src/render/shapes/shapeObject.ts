// A displayed shape: the draws of each patch's newest stage, in one group per instance.

import type { Matrix4, Texture } from "three";
import { Vector3 } from "three";
import type { Bounds } from "../../stage/vertexArray.ts";
import type { Stage } from "../../stage/stage.ts";
import { withStreamedRange } from "../../document/attributes.ts";
import { deepEqual } from "../../document/deepEqual.ts";
import type {
  AppearanceDescription,
  CubeMapRole,
  GeometryDescription,
  PatchDescription,
  ShapeDescription,
  TextureRole,
} from "../../document/description.ts";
import { isCubeMapRole } from "../../document/description.ts";
import type { SceneElement } from "../../document/element.ts";
import { surfaceAsPoints } from "../points/surfaceAsPoints.ts";
import type { DrawMode, DrawModes } from "../batches/batchingPlan.ts";
import { alone } from "../batches/batchingPlan.ts";
import { drawModeOf } from "../batches/drawMode.ts";
import type { LateBatches } from "../batches/lateBatches.ts";
import type { JoinedCubeMap } from "../environment/cubeMaps.ts";
import type { SceneSurroundings } from "../environment/sceneSurroundings.ts";
import type { ShapeGroup } from "./shapeGroup.ts";
import type { SurfaceTexture, SurfaceTextureRole, SurfaceTextures } from "../materials/surfaceTextures.ts";
import type { PatchDraws } from "../stages/patchDraws.ts";
import { makePatchDraws } from "../stages/patchDraws.ts";
import type { OperatedFormat } from "../operators/stageOperation.ts";
import { lateOperators, operatedFormatOf, operatorsOf } from "../operators/lateOperators.ts";
import type { PickCandidate } from "../picking/picker.ts";
import type { PatchContext } from "../stages/patchContext.ts";
import { lateDeformation } from "../deformation/lateDeformation.ts";
import type { ShapePose } from "../deformation/shapePose.ts";
import { withWideLines } from "../lines/wideLines.ts";

/** What all shapes of a scene share. */
export interface ShapeContext extends Pick<
  PatchContext,
  "materialFactory" | "geometries" | "buffers" | "textures" | "shared"
> {
  /** Undefined: cube maps are not drawn. Returns undefined where no shape of the scene has a cube map. */
  readonly surroundings?: () => SceneSurroundings | undefined;
  /** Undefined: each shape is drawn alone. */
  readonly batches: LateBatches | undefined;
  /** Whether surfaces are drawn as points; call ShapeObject.redraw after a change. */
  readonly drawing: { asPoints: boolean };
}

/** In CSS pixels; about the largest point that GPUs draw. */
const maxPointSize = 1024;

interface DisplayedPatch {
  readonly geometry: GeometryDescription;
  readonly stage: Stage;
  /** The derived stage that is drawn. */
  readonly drawn: Stage;
  readonly drawMode: DrawMode;
  /** What operators have changed of its materials. */
  readonly operated: OperatedFormat | undefined;
  readonly draws: PatchDraws;
}

export class ShapeObject {
  readonly #context: ShapeContext;
  readonly #element: SceneElement;
  /** One group per instance, with the page's element for it. */
  readonly #groups = new Map<ShapeGroup, SceneElement>();
  readonly #patches = new Map<number, DisplayedPatch>();
  #appearance: AppearanceDescription;
  #geometry: GeometryDescription | undefined;
  #drawModes = alone;
  readonly #surfaceTextures = new Map<SurfaceTextureRole, SurfaceTexture>();
  /** The loaded pictures of its cube map. */
  readonly #cubePictures = new Map<CubeMapRole, Texture>();
  #cubeMap: JoinedCubeMap | undefined;
  #removeGenerated: (() => void) | undefined;
  #box: ShapeDescription["box"];
  #isPickable: boolean;
  /** Undefined where nothing moves the vertices. */
  #pose: ShapePose | undefined;

  constructor(context: ShapeContext, shape: ShapeDescription) {
    this.#context = context;
    this.#element = shape.element;
    this.#appearance = shape.appearance;
    this.#geometry = shape.geometry;
    this.#isPickable = shape.isPickable;
    this.#box = shape.box;
    this.#pose = poseOf(shape);
  }

  /** Moves the vertices. `matrices`: of each joint of its skin, for points in the shape's coordinates. */
  setPose(matrices: readonly Matrix4[], weights: readonly number[]): void {
    this.#pose?.set(matrices, weights);
  }

  /** Adds an instance. `host`: the page's element for it. */
  addInstance(group: ShapeGroup, host: SceneElement): void {
    this.#groups.set(group, host);
    for (const { draws } of this.#patches.values()) draws.addInstance(group);
  }

  /** Call when the group has moved, has become visible or invisible, or has another effect scope. */
  updateInstance(group: ShapeGroup): void {
    for (const { draws } of this.#patches.values()) draws.updateInstance(group);
  }

  removeInstance(group: ShapeGroup): void {
    this.#groups.delete(group);
    for (const { draws } of this.#patches.values()) draws.removeInstance(group);
  }

  /** One per instance. */
  get groups(): readonly ShapeGroup[] {
    return Array.from(this.#groups.keys());
  }

  /** Whether it has any instances. */
  get hasInstances(): boolean {
    return this.#groups.size > 0;
  }

  /** Bounds of what is drawn of patches for which the document gives none. */
  *bounds(): Generator<Bounds> {
    const operators = operatorsOf(this.#appearance);
    for (const { geometry, stage } of this.#patches.values())
      if (stage.bounds)
        yield operators ? lateOperators.required.boundsOf(operators, geometry, stage.bounds) : stage.bounds;
  }

  /** Whether any instance is visible. */
  get isVisible(): boolean {
    for (const { visible } of this.#groups.keys()) if (visible) return true;
    return false;
  }

  get geometry(): GeometryDescription | undefined {
    return this.#geometry;
  }

  get isEmpty(): boolean {
    return this.#patches.size === 0;
  }

  get isPickable(): boolean {
    return this.#isPickable;
  }

  /** Follows a changed description. Stages of the geometry before stay until `setStage` replaces them. */
  setShape(shape: ShapeDescription): void {
    const { appearance, isPickable, geometry, box } = shape;
    this.#followDeformer(shape);
    this.#isPickable = isPickable;
    this.#box = box;
    this.#geometry = geometry;
    const isSame = deepEqual(appearance, this.#appearance);
    const isSameCubeMap =
      deepEqual(appearance.cubeMap?.pictures, this.#appearance.cubeMap?.pictures) &&
      deepEqual(appearance.cubeMap?.generated, this.#appearance.cubeMap?.generated);
    this.#appearance = appearance;
    if (!isSameCubeMap) {
      this.#leaveCubeMap();
      for (const [role, picture] of this.#cubePictures) this.#setCubePicture(role, picture);
    }
    if (this.#patches.size > 0) this.#generateCubeMap();
    if (!isSame) this.#applyAppearance();
  }

  /** Draws again where another number of joints or displacers moves the vertices. */
  #followDeformer(shape: ShapeDescription): void {
    const before = this.#pose;
    const pose = poseOf(shape);
    if (before?.jointCount === pose?.jointCount && before?.displacerCount === pose?.displacerCount) return;
    this.#pose = pose;
    this.redraw();
    before?.dispose();
  }

  /** Sets how its geometry is drawn. */
  setDrawModes(drawModes: DrawModes): void {
    if (drawModes === this.#drawModes) return;
    this.#drawModes = drawModes;
    this.#applyAppearance();
  }

  /** Applies a texture to surfaces with texture coordinates; undefined: removes it. */
  setTexture(role: TextureRole | CubeMapRole, texture: SurfaceTexture | undefined): void {
    if (isCubeMapRole(role)) {
      this.#setCubePicture(role, texture?.texture);
      return;
    }
    if (texture) this.#surfaceTextures.set(role, texture);
    else this.#surfaceTextures.delete(role);
    this.#applyAppearance();
  }

  /** Gives its cube map a picture, and joins the cube map before the first; undefined: removes the picture. */
  #setCubePicture(role: CubeMapRole, picture: Texture | undefined): void {
    if (picture) this.#cubePictures.set(role, picture);
    else this.#cubePictures.delete(role);
    const { cubeMap } = this.#appearance;
    if (cubeMap === undefined) return;
    this.#cubeMap ??= this.#context.surroundings?.()?.cubeMaps.join(cubeMap, (texture) => {
      if (texture) this.#surfaceTextures.set("cubeMap", { texture, hasAlpha: false });
      else this.#surfaceTextures.delete("cubeMap");
      this.#applyAppearance();
    });
    this.#cubeMap?.setPicture(role, picture);
  }

  /** Begins to draw the surroundings into its cube map, if that is a generated one and none is drawn yet. */
  #generateCubeMap(): void {
    const { cubeMap } = this.#appearance;
    if (cubeMap?.generated === undefined) return;
    this.#removeGenerated ??= this.#context.surroundings?.()?.generatedCubeMaps.add(cubeMap.generated, {
      center: () => {
        const [group] = this.#groups.keys();
        const center = new Vector3();
        if (this.#box)
          center
            .fromArray(this.#box.min)
            .add(new Vector3(...this.#box.max))
            .multiplyScalar(0.5);
        return group && center.applyMatrix4(group.matrixWorld);
      },
      objects: () => Array.from(this.#groups.keys()).flatMap(({ children }) => children),
      onTexture: (texture) => {
        this.#surfaceTextures.set("cubeMap", { texture, hasAlpha: false });
        this.#applyAppearance();
      },
    });
  }

  #leaveCubeMap(): void {
    this.#removeGenerated?.();
    this.#removeGenerated = undefined;
    this.#cubeMap?.leave();
    this.#cubeMap = undefined;
    this.#surfaceTextures.delete("cubeMap");
  }

  /** Width of its lines in CSS pixels; 0: as thin as possible. */
  get lineWidth(): number {
    return this.#appearance.lines?.width ?? 0;
  }

  /** Maximum width of its points and lines in CSS pixels. */
  get maxWidth(): number {
    const { points } = this.#appearance;
    const line = this.lineWidth;
    if (points === undefined) return line;
    const [a, b, c] = points.attenuation;
    return Math.max(
      line,
      b === 0 && c === 0 ? Math.min(points.size / a, points.maxSize) : Math.min(points.maxSize, maxPointSize),
    );
  }

  #applyAppearance(): void {
    for (const [patchIndex, displayed] of Array.from(this.#patches)) {
      const patch = displayed.geometry.patches[patchIndex];
      const isSame =
        patch !== undefined &&
        this.#drawnOf(displayed.stage, patch) === displayed.drawn &&
        this.#drawModeOf(displayed.stage) === displayed.drawMode &&
        deepEqual(operatedFormatOf(displayed.stage, displayed.geometry, this.#appearance), displayed.operated);
      if (isSame)
        displayed.draws.applyAppearance(
          withStreamedRange(this.#appearance, displayed.geometry),
          this.#texturesOf(displayed.stage),
        );
      else this.setStage(displayed.geometry, patchIndex, displayed.stage);
    }
  }

  /** Those of the shape, with the image that a stage has of its own. */
  #texturesOf(stage: Stage): SurfaceTextures {
    const textures = new Map(this.#surfaceTextures);
    if (stage.kind === "buffers" && stage.chips) {
      const { image, hasAlpha } = stage.chips;
      textures.set("color", { texture: this.#context.textures.textureOf(image), hasAlpha });
    }
    return textures;
  }

  /** Replaces the stage of a patch at once; textures that both stages use stay on the GPU. Undefined: removes it. */
  setStage(geometry: GeometryDescription, patchIndex: number, stage: Stage | undefined): void {
    const patch = geometry.patches[patchIndex];
    if (patch === undefined) throw new RangeError(`no patch ${patchIndex}`);
    const before = this.#patches.get(patchIndex);
    if (stage === undefined) this.#patches.delete(patchIndex);
    else this.#patches.set(patchIndex, this.#display(geometry, patch, stage, before));
    if (before !== undefined && this.#patches.get(patchIndex)?.draws !== before.draws) before.draws.dispose();
  }

  #display(
    geometry: GeometryDescription,
    patch: PatchDescription,
    stage: Stage,
    before: DisplayedPatch | undefined,
  ): DisplayedPatch {
    this.#generateCubeMap();
    const { batches, ...context } = this.#context;
    const { batching } = context.materialFactory;
    const drawMode = this.#drawModeOf(stage);
    const drawn = this.#drawnOf(stage, patch);
    const patchContext = {
      ...context,
      geometry,
      patch,
      appearance: withStreamedRange(this.#appearance, geometry),
      surfaceTextures: this.#texturesOf(stage),
      pose: this.#pose,
    };
    const displayed = {
      ...{ geometry, stage, drawn, drawMode },
      operated: operatedFormatOf(stage, geometry, this.#appearance),
    };
    const isSame = before?.drawMode === drawMode && before.drawn !== drawn;
    if (isSame && before.draws.replaceStage?.(drawn, patchContext) === true)
      return { ...displayed, draws: before.draws };
    const draws =
      batches === undefined || batching === undefined || drawMode === "alone"
        ? makePatchDraws(drawn, patchContext)
        : batches.drawsOf(drawn, patchContext, { batching, isMerged: drawMode === "merged" });
    for (const group of this.#groups.keys()) draws.addInstance(group);
    return { ...displayed, draws };
  }

  /** The same object for the same stage, unless the drawing of points or lines changes. */
  #drawnOf(stage: Stage, { vertexCount }: PatchDescription): Stage {
    const drawn = this.#context.drawing.asPoints ? surfaceAsPoints(stage, vertexCount) : stage;
    return this.#appearance.lines ? withWideLines(drawn) : drawn;
  }

  #drawModeOf(stage: Stage): DrawMode {
    const { batching } = this.#context.materialFactory;
    const isHiddenFromItself = this.#appearance.cubeMap?.generated !== undefined;
    const isMapped = operatorsOf(this.#appearance) !== undefined; // records of batches have no operators and poses
    return batching !== undefined && !isHiddenFromItself && !isMapped && this.#pose === undefined
      ? drawModeOf(stage, this.#drawModes, this.#appearance, this.#surfaceTextures, batching)
      : "alone";
  }

  /** Every draw of every instance. */
  *pickCandidates(): Generator<PickCandidate> {
    for (const [
      patch,
      {
        draws: { picks },
      },
    ] of this.#patches) {
      for (const pick of picks)
        for (const [group, element] of this.#groups) yield { patch, group, element, shape: this.#element, pick };
    }
  }

  /** Draws everything again, after a change of the context. */
  redraw(): void {
    for (const [patchIndex, { geometry, stage }] of Array.from(this.#patches))
      this.setStage(geometry, patchIndex, stage);
  }

  clear(): void {
    for (const { draws } of this.#patches.values()) draws.dispose();
    this.#patches.clear();
    this.#leaveCubeMap();
    this.#cubePictures.clear();
    this.#surfaceTextures.clear();
  }

  dispose(): void {
    this.clear();
    this.#groups.clear();
    this.#pose?.dispose();
  }
}

function poseOf({ deformer }: ShapeDescription): ShapePose | undefined {
  return deformer && lateDeformation.added?.pose(deformer.skin?.joints.length ?? 0, deformer.displacers.length);
}
