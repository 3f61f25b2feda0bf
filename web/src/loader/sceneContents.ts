// What is in a scene, read again whenever there is more to read: when the document
// of an Inline has come, and when cameras are to see another level of a LOD.

import type { Object3D } from "three";
import { Box3, Group } from "three";
import { measureRun } from "../text/glyphRendering.ts";
import type { DeliveryError } from "../delivery/deliveryError.ts";
import { Inlines } from "../delivery/inlines.ts";
import type { ResourcePool } from "../delivery/resourcePool.ts";
import type { Transfer } from "../delivery/progress.ts";
import { GeometryDeliveries } from "../delivery/geometryDeliveries.ts";
import { TextureDeliveries } from "../delivery/textureDeliveries.ts";
import type { GroupDescription, SceneDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { attributeOf } from "../document/element.ts";
import { lodLevelAt } from "../scene/lodLevel.ts";
import { readInlineGeometry } from "../document/inlineGeometry.ts";
import { SceneReader } from "../document/sceneReader.ts";
import { textReader } from "../text/textGeometry.ts";
import { SceneGroups } from "../render/shapes/sceneGroups.ts";
import type { ShapeContext } from "../render/shapes/shapeObject.ts";
import { chunkWeightsOf } from "../scheduler/priority.ts";
import { CameraObserver } from "./cameraObserver.ts";
import { AppShapes } from "./appShapes.ts";
import type { SceneLodOwner, LoadState } from "./sceneLod.ts";
import { loadStates, SceneLod } from "./sceneLod.ts";

export interface ContentsSources {
  /** The document's <X3D> and its absolute url. */
  readonly x3d: SceneElement;
  readonly url: string;
  /** The absolute url of one that the document names. */
  readonly urlOf: (url: string) => string;
  readonly pool: ResourcePool;
}

export interface ContentsListener {
  /** Something looks different. */
  onChange(): void;
  /** A file is of no use. */
  onError(error: DeliveryError): void;
  /** Something has come, or nothing more will. */
  onAdvance(): void;
}

export class SceneContents {
  /** Of all shapes, as documents tell it. */
  readonly box = new Box3();
  readonly shapes: AppShapes;
  /** Where all of it hangs. */
  readonly root = new Group();
  readonly #deliveries: GeometryDeliveries;
  readonly #pictures: TextureDeliveries;
  readonly #reader: SceneReader;
  readonly #graph: SceneGroups;
  readonly #billboards = new CameraObserver((camera) => {
    this.#graph.turnBillboards(camera);
  });
  readonly #inlines: Inlines;
  readonly #levels: SceneLod[] = [];
  /** What cameras have come to see of each LOD. */
  readonly #chosen = new Map<SceneElement, number>();
  readonly #inlineOf = new WeakMap<object, SceneElement>();
  readonly #warned = new Set<string>();
  readonly #keeper: SceneLodOwner = {
    loadStateOf: (level) => this.#presenceOf(level),
    onCamera: () => {
      this.#onLook();
    },
  };
  #scene: SceneDescription;
  #isLookedAt = false;
  #isStopped = false;

  /** Nothing is asked for, and the listener is not called, before `start`. */
  constructor({ x3d, url, urlOf, pool }: ContentsSources, setting: ShapeContext, listener: ContentsListener) {
    this.#deliveries = new GeometryDeliveries(pool);
    this.#pictures = new TextureDeliveries(pool);
    this.shapes = new AppShapes(setting, { geometries: this.#deliveries, textures: this.#pictures }, listener);
    this.#inlines = new Inlines(
      { pool, urlOf, own: { url, x3d } },
      {
        onEnd: (inline, error) => {
          if (error !== undefined) listener.onError(error);
          this.#reader.touch(inline);
          this.#read();
          listener.onChange();
          listener.onAdvance();
        },
      },
    );
    this.#reader = new SceneReader(x3d, {
      url,
      inlined: (inline) => this.#inlines.documentOf(inline),
      levelOf: (lod) => this.#chosen.get(lod),
      inlineGeometry: readInlineGeometry,
      text: textReader(measureRun),
    });
    this.#scene = this.#reader.read();
    this.#graph = new SceneGroups({
      onEnter: (shape, place, group) => {
        this.shapes.onEnter(shape, place, group);
      },
      onChange: (shape, place, group) => {
        this.shapes.onChange(shape, place, group);
      },
      onLeave: () => undefined, // documents that are read once only ever get more
      makeGroup: (description) => this.#groupOf(description),
    });
    this.root.add(this.#graph.root);
  }

  get description(): SceneDescription {
    return this.#scene;
  }

  get transfers(): readonly Readonly<Transfer>[] {
    return [...this.#inlines.transfers, ...this.#deliveries.transfers(), ...this.#pictures.transfers()];
  }

  /** All that is to be seen shows something, as far as it ever will. */
  get isShown(): boolean {
    return this.#inlines.isSettled && this.shapes.areShown;
  }

  /** All that is to be seen is there. */
  get isSettled(): boolean {
    return this.#inlines.isSettled && this.shapes.areSettled;
  }

  start(): void {
    this.#show();
  }

  /** Asks for nothing any more; what is shown stays. */
  stop(): void {
    this.#isStopped = true;
    this.#inlines.dispose();
    this.shapes.stop();
  }

  dispose(): void {
    this.stop();
    this.shapes.dispose();
  }

  #read(): void {
    const before = this.#scene;
    this.#scene = this.#reader.read();
    if (this.#scene !== before) this.#show();
  }

  #show(): void {
    const { root, inlines, chunkPriority, warnings } = this.#scene;
    this.#graph.follow(withoutLights(root));
    this.box.copy(this.#graph.box);
    if (this.#graph.hasBillboards && this.#billboards.parent === null)
      this.root.add(this.#billboards, this.#graph.root); // before what turns
    this.shapes.applyChanges();
    for (const levels of this.#levels) levels.fill();
    this.shapes.demand(
      chunkWeightsOf(chunkPriority, (problem) => {
        this.#warn(`chunkPriority: ${problem}`);
      }),
    );
    this.#inlines.follow(inlines);
    for (const { element, message } of warnings) this.#warn(`<${element.localName}> ${message}`);
  }

  #groupOf({ lod: levels, inline }: GroupDescription): Object3D | undefined {
    const element = levels?.element ?? inline;
    if (element === undefined) return undefined;
    const group = levels ? new SceneLod(levels, this.#keeper) : new Group();
    group.name = attributeOf(element, "DEF") ?? "";
    if (group instanceof SceneLod) this.#levels.push(group);
    else this.#inlineOf.set(group, element);
    return group;
  }

  /** What is hidden in it for good does not count. */
  #presenceOf(object: Object3D): LoadState {
    const inline = this.#inlineOf.get(object);
    if (inline !== undefined && this.#inlines.documentOf(inline) === undefined)
      return this.#inlines.isEnded(inline) ? "failed" : "coming";
    const found = new Set<LoadState>();
    for (const part of partsOf(object)) {
      const presence = this.shapes.loadStateOf(part) ?? this.#presenceOf(part);
      if (presence === "coming") return presence;
      found.add(presence);
    }
    return loadStates.find((presence) => found.has(presence)) ?? "nothing";
  }

  /** Cameras look in the middle of a frame, one after the other: what they are to see is asked for after it. */
  #onLook(): void {
    if (this.#isLookedAt || this.#isStopped) return;
    this.#isLookedAt = true;
    queueMicrotask(() => {
      this.#isLookedAt = false;
      if (!this.#isStopped && this.#followLooks()) this.#read();
    });
  }

  /** A LOD that stands in several places brings what the nearest camera to any of them needs. Whether one brings something else than before. */
  #followLooks(): boolean {
    const nearest = new Map<SceneElement, { readonly levels: SceneLod; readonly distance: number }>();
    for (const levels of this.#levels) {
      const distance = levels.takeDistance();
      const { element } = levels.description;
      if (distance < (nearest.get(element)?.distance ?? Infinity)) nearest.set(element, { levels, distance });
    }
    let isOther = false;
    for (const [
      element,
      {
        levels: {
          description: { range, levelCount: count },
        },
        distance,
      },
    ] of nearest) {
      const before = this.#chosen.get(element) ?? count - 1; // unknown ones bring their last
      const level = lodLevelAt(distance, range, count, before);
      this.#chosen.set(element, level);
      if (level === before) continue;
      this.#reader.touch(element);
      isOther = true;
    }
    return isOther;
  }

  /** One line for each thing, however often the documents are read. */
  #warn(message: string): void {
    if (this.#warned.has(message)) return;
    this.#warned.add(message);
    console.warn(`imgeo: ${message}`);
  }
}

/** Of a group, what is seen of it. */
function partsOf(object: Object3D): readonly Object3D[] {
  const { children } = object;
  if (!(object instanceof SceneLod)) return children.filter(({ visible }) => visible);
  const level = object.getCurrentLevel();
  return children.slice(level, level + 1);
}

const unlit = new WeakMap<GroupDescription, GroupDescription>();

/** The app has lights of its own. The same object for the same description, so that what has not changed is passed over. */
function withoutLights(group: GroupDescription): GroupDescription {
  const known = unlit.get(group);
  if (known !== undefined) return known;
  const children = group.children
    .filter(({ kind }) => kind !== "light")
    .map((child) => (child.kind === "group" ? withoutLights(child) : child));
  const isSame =
    children.length === group.children.length && children.every((child, place) => child === group.children[place]);
  const found = isSame ? group : { ...group, children };
  unlit.set(group, found);
  return found;
}
