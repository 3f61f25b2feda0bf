// The shapes of a scene in somebody's own three.js app: in each place of one an
// object, and a delivery of its geometry from when it is first to be seen.

import type { Group } from "three";
import type { DeliveryListener } from "../delivery/geometryDelivery.ts";
import type { GeometryInstance, ViewState } from "../delivery/filePriority.ts";
import { filePriorityFor, geometryInstance, texturePriorityFor } from "../delivery/filePriority.ts";
import type { DeliveryError } from "../delivery/deliveryError.ts";
import type { JoinedDelivery, GeometryDeliveries } from "../delivery/geometryDeliveries.ts";
import { ShapeTextures } from "../delivery/shapeTextures.ts";
import type { TextureDeliveries } from "../delivery/textureDeliveries.ts";
import { pictureKeyOf } from "../delivery/textureDeliveries.ts";
import type { GeometryDescription, ShapeDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import { attributeOf } from "../document/element.ts";
import type { PickCandidate } from "../render/picking/picker.ts";
import type { ShapeInstanceListener } from "../render/shapes/sceneGroups.ts";
import type { ShapeContext } from "../render/shapes/shapeObject.ts";
import { ShapeObject } from "../render/shapes/shapeObject.ts";
import { isVisibleInScene } from "../render/shapes/visibility.ts";
import type { LoadState } from "./sceneLod.ts";

export interface AppShapesListener {
  /** Something looks different. */
  onChange(): void;
  onError(error: DeliveryError): void;
  /** Something has come, or nothing more will. */
  onAdvance(): void;
}

/** Where what they show comes from. */
export interface ShapeSources {
  readonly geometries: GeometryDeliveries;
  readonly textures: TextureDeliveries;
}

/** A shape in one of its places. */
interface Placed {
  readonly shape: ShapeDescription;
  /** The same for as long as it is described so. */
  readonly geometry: GeometryInstance | undefined;
}

interface LoadedShape {
  readonly object: ShapeObject;
  readonly places: Map<object, Placed>;
  readonly textures: ShapeTextures;
  delivery: JoinedDelivery | undefined;
  /** Patches of which nothing is shown, but will be. */
  readonly missing: Set<number>;
}

/** Without a camera to measure by, only the order of what files hold counts. */
const nowhere = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

export class AppShapes implements ShapeInstanceListener {
  readonly #setting: ShapeContext;
  readonly #sources: ShapeSources;
  readonly #listener: AppShapesListener;
  readonly #shapes = new Map<SceneElement, LoadedShape>();
  readonly #byGroup = new WeakMap<object, LoadedShape>();
  readonly #changed = new Set<LoadedShape>();
  #hasPicture = false;

  constructor(setting: ShapeContext, sources: ShapeSources, listener: AppShapesListener) {
    this.#setting = setting;
    this.#sources = sources;
    this.#listener = listener;
  }

  onEnter(shape: ShapeDescription, place: object, group: Group): void {
    const loaded = this.#shapes.get(shape.element) ?? this.#begin(shape);
    this.#shapes.set(shape.element, loaded);
    this.#byGroup.set(group, loaded);
    group.name = attributeOf(shape.element, "DEF") ?? "";
    loaded.object.addInstance(group, shape.host);
    this.#follow(loaded, shape, place, group);
  }

  onChange(shape: ShapeDescription, place: object, group: Group): void {
    const loaded = this.#shapes.get(shape.element);
    if (loaded !== undefined) this.#follow(loaded, shape, place, group);
  }

  /** Documents that are read once only ever get more. */
  readonly onLeave = (): void => undefined;

  /** Of what has been told since the last time, what is to be seen begins to come. */
  applyChanges(): void {
    for (const loaded of this.#changed) this.#apply(loaded);
    this.#changed.clear();
  }

  /** Any of them shows something. */
  get hasPicture(): boolean {
    return this.#hasPicture;
  }

  /** All that is to be seen shows something, as far as it ever will. */
  get areShown(): boolean {
    return this.#areAll((shape) => shape.missing.size === 0);
  }

  /** All that is to be seen is there. */
  get areSettled(): boolean {
    return this.#areAll(({ delivery, textures }) => delivery?.isSettled !== false && textures.isSettled);
  }

  /** Of the shape in a group; undefined where there is none. */
  loadStateOf(group: object): LoadState | undefined {
    const shape = this.#byGroup.get(group);
    if (shape === undefined) return undefined;
    if (shape.missing.size > 0) return "coming";
    return !shape.object.isEmpty ? "shown" : shape.object.geometry === undefined ? "nothing" : "failed";
  }

  /** In CSS pixels; 0 where no shape says. */
  get largestWidth(): number {
    let largest = 0;
    for (const {
      object: { maxWidth: largestWidth },
    } of this.#shapes.values())
      largest = Math.max(largest, largestWidth);
    return largest;
  }

  *pickCandidates(): Generator<PickCandidate> {
    for (const { object } of this.#shapes.values()) {
      if (!object.isPickable) continue;
      for (const drawn of object.pickCandidates()) if (isVisibleInScene(drawn.group)) yield drawn;
    }
  }

  /** Asks for everything that is to be seen, coarse before fine. */
  demand(weights: ViewState["weights"]): void {
    const byGeometry = new Map<GeometryDescription, GeometryInstance[]>();
    const byPicture = new Map<string, GeometryInstance[]>();
    for (const { places } of this.#shapes.values()) {
      for (const { geometry, shape } of places.values()) {
        if (geometry === undefined || !shape.visible) continue;
        addTo(byGeometry, geometry.geometry, geometry);
        for (const texture of shape.appearance.textures) addTo(byPicture, pictureKeyOf(texture), geometry);
      }
    }
    const viewing = { camera: undefined, weights };
    this.#sources.geometries.request((geometry) => filePriorityFor(byGeometry.get(geometry) ?? [], viewing));
    this.#sources.textures.request((key, chunk) => texturePriorityFor(byPicture.get(key) ?? [], chunk, viewing));
  }

  /** Asks for nothing any more; what is shown stays. */
  stop(): void {
    this.#sources.geometries.request(() => () => undefined);
    this.#sources.textures.request(() => undefined);
  }

  dispose(): void {
    // Textures leave the draws before their images close.
    for (const { object } of this.#shapes.values()) object.dispose();
    for (const { delivery, textures } of this.#shapes.values()) {
      delivery?.cancel();
      textures.cancel();
    }
    this.#shapes.clear();
  }

  #areAll(condition: (shape: LoadedShape) => boolean): boolean {
    for (const shape of this.#shapes.values()) if (isWanted(shape) && !condition(shape)) return false;
    return true;
  }

  #begin(shape: ShapeDescription): LoadedShape {
    const object = new ShapeObject(this.#setting, shape);
    const textures = new ShapeTextures(this.#sources.textures, {
      onPicture: (role, picture) => {
        object.setTexture(
          role,
          picture && { texture: this.#setting.textures.textureOf(picture.image), hasAlpha: picture.hasAlpha },
        );
        this.#listener.onChange();
      },
      onError: (error) => {
        this.#listener.onError(error);
      },
      onSettled: () => {
        this.#listener.onAdvance();
      },
    });
    return {
      object,
      places: new Map(),
      textures,
      delivery: undefined,
      missing: new Set(shape.geometry?.patches.keys()),
    };
  }

  /** The levels of a LOD are shown by whoever draws it, so that shapes in them are hidden for other reasons alone. */
  #follow(loaded: LoadedShape, shape: ShapeDescription, place: object, group: Group): void {
    group.visible = shape.contributesToBounds;
    const {
      geometry,
      priority,
      appearance: { textures },
    } = shape;
    loaded.places.set(place, {
      shape,
      geometry: geometry && geometryInstance(geometry, nowhere, priority, textures.length > 0),
    });
    this.#changed.add(loaded);
  }

  /** What has been seen once stays, however often it is hidden. */
  #apply(loaded: LoadedShape): void {
    if (!isWanted(loaded)) return;
    for (const {
      shape: { geometry, appearance },
    } of loaded.places.values()) {
      loaded.textures.follow(appearance.textures);
      if (geometry !== undefined) loaded.delivery ??= this.#deliver(geometry, loaded);
    }
  }

  #deliver(geometry: GeometryDescription, loaded: LoadedShape): JoinedDelivery {
    const listener: DeliveryListener = {
      onStage: (patch, stage) => {
        loaded.object.setStage(geometry, patch, stage);
        loaded.missing.delete(patch);
        this.#hasPicture = true;
        this.#listener.onChange();
        this.#listener.onAdvance();
      },
      onError: (error) => {
        this.#listener.onError(error);
      },
      onSettled: () => {
        if (isWanted(loaded)) loaded.missing.clear(); // else it may be asked for again
        this.#listener.onAdvance();
      },
    };
    return this.#sources.geometries.join(geometry, listener);
  }
}

/** It is to be seen in any of its places. */
function isWanted({ places }: LoadedShape): boolean {
  for (const { shape } of places.values()) if (shape.visible) return true;
  return false;
}

function addTo<Key, Item>(lists: Map<Key, Item[]>, key: Key, item: Item): void {
  const list = lists.get(key);
  if (list === undefined) lists.set(key, [item]);
  else list.push(item);
}
