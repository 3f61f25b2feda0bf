// The core that the page element and the three.js loader share. It reads a scene's
// document, again after each change; has its host display what it reads; joins the
// deliveries of shapes; requests what the view needs; and loads Inlines.

import { GeometryDeliveries } from "../delivery/geometryDeliveries.ts";
import { DeliveryError } from "../delivery/deliveryError.ts";
import type { InlinesOptions } from "../delivery/inlines.ts";
import { Inlines } from "../delivery/inlines.ts";
import { progressOf, type Progress, type Transfer } from "../delivery/progress.ts";
import type { LevelDemand } from "../delivery/geometryView.ts";
import type { SceneDeliveries } from "../delivery/requestWithinBudget.ts";
import type { ResourcePool } from "../delivery/resourcePool.ts";
import { TextureDeliveries } from "../delivery/textureDeliveries.ts";
import type { SceneDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { PartName } from "../document/parts.ts";
import { refusals } from "../document/refused.ts";
import type { SceneReaderOptions } from "../document/sceneReader.ts";
import { SceneReader } from "../document/sceneReader.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import type { NodeInstance } from "../scene/nodeInstance.ts";
import type { View } from "../render/view.ts";
import type { TextReader } from "../document/textReader.ts";
import type { textReader } from "../text/textGeometry.ts";
import { DeliveryControl } from "./deliveryControl.ts";
import type { LoadingShape } from "./loadingShape.ts";
import type { LoadingShapes } from "./loadingShapes.ts";
import { MessageLog } from "./messageLog.ts";
import { NeededParts } from "./neededParts.ts";
import type { Parts } from "./parts/parts.ts";

/** Time between progress reports: 20 a second are as many as a user can see. */
export const progressIntervalMs = 50;

/** Displays a scene, and receives what happens to its files. */
export interface ViewerHost {
  /** The document is read next. */
  beforeRead?(): void;
  /** The parts of the runtime that displaying a scene needs, besides those that reading it does. Default: none. */
  partsFor?(scene: SceneDescription): readonly PartName[];
  /** The document as it was just read is displayed later: parts of the runtime are being loaded for it. */
  onPartsNeeded?(): void;
  /** Such a part could not be loaded: the document is not displayed as it was read. The next change tries again. */
  onPartsFailed?(error: DeliveryError): void;
  /** The view of the camera; undefined if there is no single camera. */
  view(): View | undefined;
  /** What levels of detail are refined for. Default: `view`, and the budget of all. */
  levelDemand?(): LevelDemand;
  /** Keys (textureKeyOf) of textures that the host displays around the viewer. */
  sceneTextures?(): ReadonlySet<string>;
  /** The instances of shapes that have moved since the last call. Default: none, as requests do not depend on them. */
  takeMoved?(): readonly NodeInstance[];
  /** Displays a scene that differs from the previous one, and returns the differences. */
  display(scene: SceneDescription): SceneChanges;
  /** Shapes have joined deliveries, whose files are requested next. */
  onShapes(changes: SceneChanges): void;
  /** The scene is displayed, and its files are requested. */
  onScene(): void;
  /** The set of requested files may have changed. */
  onRequests?(): void;
  /** An Inline's document is requested; not called again before `onInlineRemoved`. */
  onInlineRequested?(inline: SceneElement): void;
  /** An Inline's document has loaded, or failed with `error`. The scene is read next. */
  onInlineEnd(inline: SceneElement, error: DeliveryError | undefined): void;
  /** The scene has been read with the Inline's document. */
  onInlineRead?(): void;
  /** The scene no longer has the Inline, or the Inline's `url` has changed. */
  onInlineRemoved?(inline: SceneElement): void;
}

export interface ViewerCoreOptions<Shape extends LoadingShape> {
  /** The document's <X3D>. */
  readonly x3d: SceneElement;
  readonly pool: ResourcePool;
  readonly deliveries: SceneDeliveries;
  /** The host's shapes, which join `deliveries`. */
  readonly shapes: LoadingShapes<Shape>;
  readonly reader: Pick<SceneReaderOptions, "url" | "levelOf">;
  /** How many times faces of a font have loaded; texts are laid out again when the number changes. */
  readonly fontEditionOf?: Parameters<typeof textReader>[1];
  readonly inlines: Omit<InlinesOptions, "pool">;
  /** The parts of the runtime that come when the scene needs them. */
  readonly parts: Parts;
  readonly host: ViewerHost;
}

const noTextures: ReadonlySet<string> = new Set();

/** The deliveries that shapes of one scene join. */
export function sceneDeliveriesOf(pool: ResourcePool): SceneDeliveries {
  return { geometries: new GeometryDeliveries(pool), textures: new TextureDeliveries(pool) };
}

export class ViewerCore<Shape extends LoadingShape> {
  /** Call `read` after its `touch` or `rearrange`. */
  readonly reader: SceneReader;
  readonly shapes: LoadingShapes<Shape>;
  readonly inlines: Inlines;
  readonly control: DeliveryControl;
  readonly log = new MessageLog();
  readonly deliveries: SceneDeliveries;
  readonly #x3d: SceneElement;
  readonly #host: ViewerHost;
  #scene: SceneDescription | undefined;
  #isLoading = false;
  readonly #needed: NeededParts;
  /** Called when the document is displayed as it was last read. */
  readonly #afterRead: (() => void)[] = [];
  #isDisposed = false;
  /** Whether a part that the document needs could not be loaded. */
  #havePartsFailed = false;

  /** Reads nothing before `read`, and requests nothing before `load`. */
  constructor({
    x3d,
    pool,
    deliveries,
    shapes,
    reader,
    fontEditionOf,
    inlines,
    host,
    parts,
  }: ViewerCoreOptions<Shape>) {
    this.#needed = new NeededParts(parts);
    this.#x3d = x3d;
    this.deliveries = deliveries;
    this.#host = host;
    this.shapes = shapes;
    this.inlines = new Inlines(
      { ...inlines, pool },
      {
        onBegin: (inline) => {
          host.onInlineRequested?.(inline);
        },
        onEnd: (inline, error) => {
          host.onInlineEnd(inline, error);
          this.reader.touch(inline);
          this.#afterRead.push(() => host.onInlineRead?.());
          this.read();
        },
        onRemove: (inline) => {
          host.onInlineRemoved?.(inline);
        },
      },
    );
    let text: TextReader | undefined;
    this.reader = new SceneReader(x3d, {
      ...reader,
      inlined: (inline) => this.inlines.documentOf(inline),
      get inlineGeometry() {
        return parts.documentGeometry.module?.inlineGeometryReader;
      },
      get operators() {
        return parts.operators.module?.operatorReader;
      },
      get deformation() {
        return parts.deformation.module?.deformationReader;
      },
      refusals,
      get text() {
        const module = parts.documentGeometry.module;
        return (text ??= module?.textReader(module.measureRun, fontEditionOf));
      },
      need: (part, unread) => {
        this.#needed.need(part, unread);
      },
    });
    this.control = new DeliveryControl({
      deliveries,
      view: () => host.view(),
      ...(host.levelDemand && { levelDemand: host.levelDemand.bind(host) }),
      sceneTextures: () => host.sceneTextures?.() ?? noTextures,
      takeMoved: () => host.takeMoved?.() ?? [],
      onRequests: () => {
        host.onRequests?.();
      },
    });
  }

  /** The scene that the last `read` has read; undefined before the first `read`. */
  get scene(): SceneDescription | undefined {
    return this.#scene;
  }

  /** All files that have been requested, each once. */
  get transfers(): readonly Readonly<Transfer>[] {
    const { geometries, textures } = this.deliveries;
    return [...geometries.transfers(), ...textures.transfers(), ...this.inlines.transfers];
  }

  /**
   * The progress of all files since `before`. It stays as it was while parts of the runtime are being loaded: the files
   * that they will request are not known yet.
   */
  progressSince(before: Progress): Progress {
    return this.hasBegun && !this.isLoadingParts ? progressOf(this.transfers, before) : before;
  }

  /**
   * Reads the document. If the scene has changed, displays it and requests its files; where it needs parts of the
   * runtime that have not been loaded, as soon as they have.
   */
  read(): void {
    this.#host.beforeRead?.();
    const scene = this.reader.read();
    for (const part of this.#host.partsFor?.(scene) ?? []) this.#needed.need(part);
    if (this.#needed.areLoaded) {
      this.#follow(scene);
      return;
    }
    this.#havePartsFailed = false;
    this.#host.onPartsNeeded?.();
    void this.#loadParts();
  }

  /** Whether the document is displayed as it was last read; otherwise it lacks parts of the runtime. */
  get isDisplayed(): boolean {
    return this.#needed.areLoaded;
  }

  /** Whether a scene has been displayed, or cannot be since the first one lacks a part that could not be loaded. */
  get hasBegun(): boolean {
    return this.#scene !== undefined || this.#havePartsFailed;
  }

  /** Whether parts of the runtime are being loaded for the document. */
  get isLoadingParts(): boolean {
    return !this.#needed.areLoaded && !this.#havePartsFailed;
  }

  /** Calls back when the document is displayed as it was last read: at once, or when the parts have been loaded. */
  whenDisplayed(call: () => void): void {
    if (this.isDisplayed && this.#scene !== undefined) call();
    else this.#afterRead.push(call);
  }

  /** Reads again when the parts have been loaded that the scene needs. */
  async #loadParts(): Promise<void> {
    try {
      const unread = await this.#needed.load();
      if (unread === undefined || this.#isDisposed) return;
      for (const node of unread) this.reader.touch(node);
      this.read();
    } catch (error) {
      if (this.#isDisposed) return;
      const message = `the module of a part of the runtime could not be loaded: ${String(error)}`;
      this.log.error(message);
      this.#havePartsFailed = true;
      this.#host.onPartsFailed?.(new DeliveryError("network", "", message));
    }
  }

  #follow(scene: SceneDescription): void {
    const before = this.#scene;
    this.#scene = scene;
    if (scene !== before) this.#display(scene, before);
    for (const call of this.#afterRead.splice(0)) call();
  }

  #display(scene: SceneDescription, before: SceneDescription | undefined): void {
    const changes = this.#host.display(scene);
    const leaveDeliveries = this.shapes.follow(changes);
    this.#host.onShapes(changes);
    this.control.follow(scene.chunkPriority, changes, (problem) => {
      this.log.warn(`<${this.#x3d.localName}> chunkPriority: ${problem}`);
    });
    for (const { element, message } of scene.warnings) this.log.warn(`<${element.localName}> ${message}`);
    leaveDeliveries(); // last, so that files that old and new shapes share are not fetched again
    if (this.#isLoading && scene.inlines !== before?.inlines) this.inlines.follow(scene.inlines);
    this.#host.onScene();
  }

  /**
   * Instances of shapes have moved on the screen. The document has not been read; the reader is told when attributes are
   * written.
   */
  followMoves(): void {
    this.control.followMoves();
  }

  /** Requests files from now on. */
  load(): void {
    this.#isLoading = true;
    this.inlines.follow(this.#scene?.inlines ?? []);
    this.control.start();
  }

  /** Ends all requests. What is displayed stays. */
  stop(): void {
    this.#isLoading = false;
    this.inlines.dispose();
    this.control.stop();
  }

  /** Ends all requests, and all deliveries. */
  dispose(): void {
    this.#isDisposed = true;
    this.stop();
    this.shapes.dispose();
  }
}
