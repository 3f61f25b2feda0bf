// The contents of a scene in an app's own three.js scene: its groups, lights aside, with
// LODs and billboards that follow the app's cameras. Reads its document again when
// the document of an Inline has loaded, and when a camera needs another level of a LOD.

import type { Camera, Object3D, WebGLRenderer } from "three";
import { Box3, Group } from "three";
import type { FieldChange } from "../animation/documentGraph.ts";
import type { AnimatedDocuments } from "../animation/documents.ts";
import type { AnimatedElement } from "../animation/elements.ts";
import type { GeometryDeliveries } from "../delivery/geometryDeliveries.ts";
import type { Progress, Transfer } from "../delivery/progress.ts";
import type { ResourcePool } from "../delivery/resourcePool.ts";
import type { GroupDescription, SceneDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { attributeOf } from "../document/element.ts";
import { SceneGroups } from "../render/shapes/sceneGroups.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import type { ShapeContext } from "../render/shapes/shapeObject.ts";
import { lodLevelAt } from "../scene/lodLevel.ts";
import { isOfPose } from "../viewer/drawnFields.ts";
import { sceneDeliveriesOf, ViewerCore } from "../viewer/viewerCore.ts";
import { allParts } from "../viewer/parts/allParts.ts";
import { touchWritten } from "../viewer/writtenElements.ts";
import type { AppShape, AppShapesListener } from "./appShapes.ts";
import { AppShapes } from "./appShapes.ts";
import { CameraObserver } from "./cameraObserver.ts";
import { SceneCameras } from "./sceneCameras.ts";
import type { LoadState, SceneLodOwner } from "./sceneLod.ts";
import { loadStates, SceneLod } from "./sceneLod.ts";

export interface SceneSource {
  /** The document's <X3D>. */
  readonly x3d: SceneElement & AnimatedElement;
  /** The document's absolute URL. */
  readonly url: string;
  /** Makes a URL of the document absolute. */
  readonly urlOf: (url: string) => string;
  readonly pool: ResourcePool;
  /** GPU memory of the scene in bytes, beyond which levels of detail are not refined. */
  readonly budget: number;
}

export interface SceneContentsListener extends AppShapesListener {
  /** The document of an Inline has loaded, or all its URLs have failed. */
  onDocuments(): void;
}

export class SceneContents {
  /** Bounds of all visible shapes, as the documents describe them. */
  readonly box = new Box3();
  readonly geometries: GeometryDeliveries;
  readonly shapes: AppShapes;
  /** The parent of all objects of the scene. */
  readonly root = new Group();
  readonly #core: ViewerCore<AppShape>;
  readonly #groups: SceneGroups;
  readonly #billboardCameraObserver = new CameraObserver((camera) => {
    this.#groups.rotateBillboards(camera);
  });
  readonly #lods: SceneLod[] = [];
  /** The level that cameras need, by LOD. */
  readonly #levels = new Map<SceneElement, number>();
  readonly #inlineOf = new WeakMap<object, SceneElement>();
  readonly #lodOwner: SceneLodOwner = {
    loadStateOf: (level) => this.#loadStateOf(level),
    onCameraUpdate: () => {
      this.#onCameraUpdate();
    },
  };
  /** The cameras of the app that levels of detail follow. */
  readonly #cameras = new SceneCameras(() => {
    if (!this.#isStopped) this.#core.followMoves();
  });
  /** Whether a microtask will choose the levels of LODs after this frame. */
  #isLevelUpdateDue = false;
  #isStopped = false;
  readonly #listener: SceneContentsListener;
  readonly #x3d: SceneElement & AnimatedElement;

  /** Requests nothing, and does not call the listener, before `start`. */
  constructor({ x3d, url, urlOf, pool, budget }: SceneSource, context: ShapeContext, listener: SceneContentsListener) {
    this.#listener = listener;
    this.#x3d = x3d;
    const deliveries = sceneDeliveriesOf(pool);
    this.geometries = deliveries.geometries;
    this.shapes = new AppShapes(context, deliveries, listener);
    this.#core = new ViewerCore<AppShape>({
      x3d,
      pool,
      deliveries,
      shapes: this.shapes,
      reader: { url, levelOf: (lod) => this.#levels.get(lod) },
      inlines: { urlOf, ownDocument: { url, x3d } },
      parts: allParts,
      host: {
        view: () => undefined, // the app has any number of cameras
        levelDemand: () => ({ views: this.#cameras.views, maxBytes: budget }),
        display: (scene) => this.#display(scene),
        onShapes: () => {
          for (const lod of this.#lods) lod.fill();
        },
        onScene: () => {
          this.shapes.forgetMissing();
          listener.onAdvance();
        },
        onInlineEnd: (_, error) => {
          if (error !== undefined) listener.onError(error);
        },
        onInlineRead: () => {
          listener.onDocuments();
          listener.onChange();
          listener.onAdvance();
        },
      },
    });
    this.#groups = new SceneGroups({
      onEnter: (shape, instance, group) => {
        this.shapes.onEnter(shape, instance, group);
      },
      onChange: (shape, instance, group) => {
        this.shapes.onChange(shape, instance, group);
      },
      onLeave: this.shapes.onLeave,
      makeGroup: (description) => this.#groupOf(description),
    });
    this.root.add(this.#groups.root);
  }

  get description(): SceneDescription {
    return this.#core.scene ?? this.#core.reader.read();
  }

  get transfers(): readonly Readonly<Transfer>[] {
    return this.#core.transfers;
  }

  /** The progress of all files since `before`. */
  progressSince(before: Progress): Progress {
    return this.#core.progressSince(before);
  }

  /** Whether every visible shape displays something or has failed. */
  get isDisplayed(): boolean {
    return this.#core.inlines.isSettled && this.shapes.areDisplayed;
  }

  /** Whether no file of anything visible is being loaded. */
  get isSettled(): boolean {
    return this.#core.inlines.isSettled && this.shapes.areSettled;
  }

  /** The document and those that it inlines, as far as they have loaded. */
  get documents(): AnimatedDocuments {
    // Those that a browser reads are DOM elements.
    const documentOf = (inline: SceneElement): AnimatedElement | undefined =>
      this.#core.inlines.documentOf(inline)?.x3d as AnimatedElement | undefined;
    const inlines = (): readonly { readonly element: SceneElement }[] => this.#core.scene?.inlines ?? [];
    const ownDocument = this.#x3d;
    return {
      get roots() {
        const inlined = inlines().flatMap(({ element }) => documentOf(element) ?? []);
        return Array.from(new Set([ownDocument, ...inlined]));
      },
      documentOf: (inline) => documentOf(inline),
    };
  }

  /** Displays values that fields of nodes have received. Their attributes have been written. */
  displayChanges(changes: readonly FieldChange[]): void {
    const poses = changes.filter(isOfPose);
    for (const { element } of changes) touchWritten(this.#core.reader, this.#x3d, element);
    if (poses.length < changes.length) this.#core.read();
    if (poses.length > 0) {
      this.#groups.move(poses); // requests do not depend on where clips move shapes
      this.#followGroups();
    }
    this.#listener.onChange();
  }

  /** Levels of detail follow this camera, and the others that are passed in the same task. */
  followCamera(camera: Camera, renderer: WebGLRenderer, scene: Object3D): void {
    if (!this.#isStopped) this.#cameras.add(camera, renderer, scene);
  }

  start(): void {
    this.#core.load();
    this.#core.read();
  }

  /** Ends all requests. What is displayed stays. */
  stop(): void {
    this.#isStopped = true;
    this.#core.stop();
  }

  dispose(): void {
    this.stop();
    this.#core.dispose();
  }

  #display({ root }: SceneDescription): SceneChanges {
    this.#groups.follow(withoutLights(root));
    // three.js visits children in order: the observer must come before the billboards that it turns.
    if (this.#groups.hasBillboards && this.#billboardCameraObserver.parent === null)
      this.root.add(this.#billboardCameraObserver, this.#groups.root);
    this.#followGroups();
    return this.shapes.takeChanges();
  }

  #followGroups(): void {
    this.box.copy(this.#groups.box);
    for (const pose of this.#groups.poses()) this.shapes.setPose(pose);
  }

  #groupOf({ lod, inline }: GroupDescription): Object3D | undefined {
    const element = lod?.element ?? inline;
    if (element === undefined) return undefined;
    const group = lod ? new SceneLod(lod, this.#lodOwner) : new Group();
    group.name = attributeOf(element, "DEF") ?? "";
    if (group instanceof SceneLod) this.#lods.push(group);
    else this.#inlineOf.set(group, element);
    return group;
  }

  /** The state of all shapes below an object, except of those that the document hides. */
  #loadStateOf(object: Object3D): LoadState {
    const inline = this.#inlineOf.get(object);
    if (inline !== undefined && this.#core.inlines.documentOf(inline) === undefined)
      return this.#core.inlines.isEnded(inline) ? "failed" : "loading";
    const states = new Set<LoadState>();
    for (const child of visibleChildrenOf(object)) {
      const state = this.shapes.loadStateOf(child) ?? this.#loadStateOf(child);
      if (state === "loading") return state;
      states.add(state);
    }
    return loadStates.find((state) => states.has(state)) ?? "empty";
  }

  /**
   * A camera has updated a LOD in the middle of a frame. The levels that the frame's cameras need are requested after
   * the frame.
   */
  #onCameraUpdate(): void {
    if (this.#isLevelUpdateDue || this.#isStopped) return;
    this.#isLevelUpdateDue = true;
    queueMicrotask(() => {
      this.#isLevelUpdateDue = false;
      if (!this.#isStopped && this.#updateLevels()) this.#core.read();
    });
  }

  /**
   * Chooses the level of each LOD by the camera that is nearest to any of its instances. Returns whether any level has
   * changed.
   */
  #updateLevels(): boolean {
    const nearest = new Map<SceneElement, { readonly lod: SceneLod; readonly distance: number }>();
    for (const lod of this.#lods) {
      const distance = lod.takeDistance();
      const { element } = lod.description;
      if (distance < (nearest.get(element)?.distance ?? Infinity)) nearest.set(element, { lod, distance });
    }
    let hasChanged = false;
    for (const [element, { lod, distance }] of nearest) {
      const { range, levelCount } = lod.description;
      const before = this.#levels.get(element) ?? levelCount - 1; // the last, until a camera has been near
      const level = lodLevelAt(distance, range, levelCount, before);
      this.#levels.set(element, level);
      if (level === before) continue;
      this.#core.reader.touch(element);
      hasChanged = true;
    }
    return hasChanged;
  }
}

/** The children of a group that are visible: of a LOD, its current level. */
function visibleChildrenOf(object: Object3D): readonly Object3D[] {
  const { children } = object;
  if (!(object instanceof SceneLod)) return children.filter(({ visible }) => visible);
  const level = object.getCurrentLevel();
  return children.slice(level, level + 1);
}

const groupsWithoutLights = new WeakMap<GroupDescription, GroupDescription>();

/**
 * A group without its lights: the app has its own. The same object for the same description, so that unchanged groups
 * are skipped.
 */
function withoutLights(group: GroupDescription): GroupDescription {
  const known = groupsWithoutLights.get(group);
  if (known !== undefined) return known;
  const children = group.children
    .filter(({ kind }) => kind !== "light")
    .map((child) => (child.kind === "group" ? withoutLights(child) : child));
  const isSame =
    children.length === group.children.length && children.every((child, index) => child === group.children[index]);
  const result = isSame ? group : { ...group, children };
  groupsWithoutLights.set(group, result);
  return result;
}
