// A shape on the screen: the draws of each patch's newest stage, in a group for
// each place where the shape stands in the scene.

import type { Bounds } from "../../stage/vertexArray.ts";
import type { Stage } from "../../stage/stage.ts";
import { deepEqual } from "../../document/deepEqual.ts";
import type {
  AppearanceDescription,
  GeometryDescription,
  PatchDescription,
  ShapeDescription,
  TextureRole,
} from "../../document/description.ts";
import type { SceneElement } from "../../document/element.ts";
import { surfaceAsPoints } from "../points/surfaceAsPoints.ts";
import type { Batches } from "../batches/batches.ts";
import { BatchedStage, drawModeOf } from "../batches/batchedStage.ts";
import type { DrawMode, DrawModes } from "../batches/batchingPlan.ts";
import { alone } from "../batches/batchingPlan.ts";
import type { ShapeGroup } from "../lights/lightScopes.ts";
import type { SurfaceTexture } from "../materials/surfaceTextures.ts";
import type { PatchDraws } from "../stages/patchDraws.ts";
import { makePatchDraws } from "../stages/patchDraws.ts";
import type { PickCandidate } from "../picking/picker.ts";
import type { PatchContext } from "../stages/patchContext.ts";
import { withWideLines } from "../lines/wideLines.ts";

/** What all shapes of a scene share. */
export interface ShapeContext extends Pick<
  PatchContext,
  "materialFactory" | "geometries" | "buffers" | "textures" | "shared"
> {
  /** Undefined: each shape is drawn alone. */
  readonly batches: Batches | undefined;
  /** Of surfaces, whether their vertices are drawn instead; ShapeObject.redraw follows a change. */
  readonly drawing: { asPoints: boolean };
}

/** In CSS pixels; GPUs draw none that are larger. */
const maxPointSize = 1024;

interface DisplayedPatch {
  readonly geometry: GeometryDescription;
  readonly stage: Stage;
  /** What is drawn of it. */
  readonly drawn: Stage;
  readonly drawMode: DrawMode;
  readonly draws: PatchDraws;
}

export class ShapeObject {
  readonly #context: ShapeContext;
  /** One for each place, with the page's element for it there. */
  readonly #groups = new Map<ShapeGroup, SceneElement>();
  readonly #patches = new Map<number, DisplayedPatch>();
  #appearance: AppearanceDescription;
  #geometry: GeometryDescription | undefined;
  #drawing = alone;
  readonly #surfaceTextures = new Map<TextureRole, SurfaceTexture>();
  #isPickable: boolean;

  constructor(context: ShapeContext, shape: ShapeDescription) {
    this.#context = context;
    this.#appearance = shape.appearance;
    this.#geometry = shape.geometry;
    this.#isPickable = shape.isPickable;
  }

  /** It stands in this group too, from now on; `host` is the page's element for it there. */
  addInstance(group: ShapeGroup, host: SceneElement): void {
    this.#groups.set(group, host);
    for (const { draws } of this.#patches.values()) draws.addInstance(group);
  }

  /** The group has moved, is shown or hidden, or stands in another light scope. */
  updateInstance(group: ShapeGroup): void {
    for (const { draws } of this.#patches.values()) draws.updateInstance(group);
  }

  removeInstance(group: ShapeGroup): void {
    this.#groups.delete(group);
    for (const { draws } of this.#patches.values()) draws.removeInstance(group);
  }

  /** One for each place. */
  get groups(): readonly ShapeGroup[] {
    return Array.from(this.#groups.keys());
  }

  /** It stands somewhere. */
  get hasInstances(): boolean {
    return this.#groups.size > 0;
  }

  /** Of patches of which the document does not tell any. */
  *bounds(): Generator<Bounds> {
    for (const { stage } of this.#patches.values()) if (stage.kind === "buffers" && stage.bounds) yield stage.bounds;
  }

  /** In one of its places. */
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

  /** Takes over what a changed document says; what shows another geometry than before is taken away. */
  setShape({ appearance, isPickable, geometry }: ShapeDescription): void {
    this.#isPickable = isPickable;
    if (geometry !== this.#geometry) this.clear();
    this.#geometry = geometry;
    const isSame = deepEqual(appearance, this.#appearance);
    this.#appearance = appearance;
    if (!isSame) this.#applyAppearance();
  }

  /** How its geometry is drawn from now on. */
  setDrawModes(drawing: DrawModes): void {
    if (drawing === this.#drawing) return;
    this.#drawing = drawing;
    this.#applyAppearance();
  }

  /** What is laid over its surface, where it has texture coordinates; undefined: nothing. */
  setTexture(role: TextureRole, picture: SurfaceTexture | undefined): void {
    if (picture) this.#surfaceTextures.set(role, picture);
    else this.#surfaceTextures.delete(role);
    this.#applyAppearance();
  }

  /** Of its lines, in CSS pixels; 0 where they are as thin as can be. */
  get lineWidth(): number {
    return this.#appearance.lines?.width ?? 0;
  }

  /** What its points and lines may be wide, in CSS pixels. */
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
    for (const [place, shown] of Array.from(this.#patches)) {
      const patch = shown.geometry.patches[place];
      const isSame =
        patch !== undefined &&
        this.#drawnOf(shown.stage, patch) === shown.drawn &&
        this.#drawModeOf(shown.stage) === shown.drawMode;
      if (isSame) shown.draws.applyAppearance(this.#appearance, new Map(this.#surfaceTextures));
      else this.setStage(shown.geometry, place, shown.stage);
    }
  }

  /** The new stage takes the old one's place as a whole; textures that both use stay where they are. Undefined: nothing does. */
  setStage(geometry: GeometryDescription, place: number, stage: Stage | undefined): void {
    const patch = geometry.patches[place];
    if (patch === undefined) throw new RangeError(`no patch ${place}`);
    const before = this.#patches.get(place);
    if (stage === undefined) this.#patches.delete(place);
    else this.#patches.set(place, this.#show(geometry, patch, stage));
    before?.draws.dispose();
  }

  #show(geometry: GeometryDescription, patch: PatchDescription, stage: Stage): DisplayedPatch {
    const { batches, ...context } = this.#context;
    const { batching } = context.materialFactory;
    const drawMode = this.#drawModeOf(stage);
    const drawn = this.#drawnOf(stage, patch);
    const patchContext = {
      ...context,
      geometry,
      patch,
      appearance: this.#appearance,
      surfaceTextures: new Map(this.#surfaceTextures),
    };
    const draws =
      batches === undefined || batching === undefined || drawMode === "alone"
        ? makePatchDraws(drawn, patchContext)
        : new BatchedStage(drawn, patchContext, { batches, batching, isMerged: drawMode === "merged" });
    for (const group of this.#groups.keys()) draws.addInstance(group);
    return { geometry, stage, drawn, drawMode, draws };
  }

  /** The same object for the same stage, as long as nothing else is said of points and lines. */
  #drawnOf(stage: Stage, { vertexCount }: PatchDescription): Stage {
    const shown = this.#context.drawing.asPoints ? surfaceAsPoints(stage, vertexCount) : stage;
    return this.#appearance.lines ? withWideLines(shown) : shown;
  }

  #drawModeOf(stage: Stage): DrawMode {
    const { batching } = this.#context.materialFactory;
    return batching !== undefined
      ? drawModeOf(stage, this.#drawing, this.#appearance, this.#surfaceTextures, batching)
      : "alone";
  }

  /** Every draw in every place, with the number of its patch and the page's element. */
  *pickCandidates(): Generator<PickCandidate> {
    for (const [
      patch,
      {
        draws: { picks },
      },
    ] of this.#patches) {
      for (const pick of picks) for (const [group, element] of this.#groups) yield { patch, group, element, pick };
    }
  }

  /** Everything anew, as the context now says. */
  redraw(): void {
    for (const [place, { geometry, stage }] of Array.from(this.#patches)) this.setStage(geometry, place, stage);
  }

  clear(): void {
    for (const { draws } of this.#patches.values()) draws.dispose();
    this.#patches.clear();
    this.#surfaceTextures.clear();
  }

  dispose(): void {
    this.clear();
    this.#groups.clear();
  }
}
