// What the page displays of its scene: sets it to the renderer and the camera, and follows moves, the camera's distance
// to LODs, and bound nodes.

import type { AnchorDescription, SceneDescription } from "../document/description.ts";
import type { SceneElement } from "../document/element.ts";
import type { NavigatedScene } from "../navigation/cameraController.ts";
import type { SceneChanges } from "../render/shapes/shapeChanges.ts";
import type { LodInstance } from "../scene/instances.ts";
import type { PoseChange } from "../scene/instanceTree.ts";
import { LodSelection } from "../scene/lodSelection.ts";
import type { PageSurroundings } from "./pageSurroundings.ts";
import type { PageView } from "./pageView.ts";

/** Nested LODs whose levels are chosen at once; deeper ones are chosen after the next frame. */
const maxNestedLods = 8;

export interface DisplayedSceneHost {
  readonly view: Pick<PageView, "renderer" | "cameraController">;
  readonly surroundings: PageSurroundings;
  /** The surroundings need other files. */
  requestFiles(): void;
  /** The scene has Anchors, or had some before. */
  onAnchors(anchors: readonly AnchorDescription[]): void;
  warn(message: string): void;
}

export class DisplayedScene {
  readonly #host: DisplayedSceneHost;
  readonly #lods = new LodSelection();
  #current: (NavigatedScene & { readonly lods: readonly LodInstance[] }) | undefined;
  #hasAnchors = false;
  /** Whether animation has moved the scene, so that its bounds no longer say what the camera is to frame. */
  #hasMoved = false;
  /** Nesting depth of calls of `read` in `followLods`: LODs of the scene that one call has read cause the next. */
  #nestedReads = 0;

  constructor(host: DisplayedSceneHost) {
    this.#host = host;
  }

  /** The level of a LOD that is displayed. */
  levelOf(lod: SceneElement): number | undefined {
    return this.#lods.levelOf(lod);
  }

  /** Displays a scene that has been read. */
  display(scene: SceneDescription): SceneChanges {
    const { renderer, cameraController } = this.#host.view;
    const before = this.#current;
    const { changes, ...built } = renderer.scene.set(scene);
    this.#followSurroundings();
    if (built.environmentLights.length > 1)
      this.#host.warn("has several EnvironmentLights; the first that is on is drawn");
    if (built.anchors.length > 0 || this.#hasAnchors) this.#host.onAnchors(built.anchors);
    this.#hasAnchors = built.anchors.length > 0;
    this.#current = { ...built, navigation: scene.navigation };
    const isSame = before?.navigation === scene.navigation && isSameList(before.viewpoints, built.viewpoints);
    if (!isSame || (before.sphere !== built.sphere && !this.#hasMoved)) cameraController.setScene(this.#current);
    else if (before.sphere !== built.sphere) cameraController.followMoves(this.#current);
    return changes;
  }

  movePoses(changes: readonly PoseChange[]): void {
    const built = this.#host.view.renderer.scene.move(changes);
    this.#hasMoved = true;
    if (this.#current === undefined) return;
    this.#current = { ...built, navigation: this.#current.navigation };
    this.#host.view.cameraController.followMoves(this.#current);
  }

  /** Whether the start view shows everything, as it does without viewpoints. */
  get isFramed(): boolean {
    return this.#current?.viewpoints.length === 0;
  }

  /** Follows the scene's bounds, which grow with vertices outside of the bounds that the document states. */
  followSphere(): void {
    const { sphere } = this.#host.view.renderer.scene;
    if (this.#current === undefined || this.#current.sphere === sphere) return;
    this.#current = { ...this.#current, sphere };
    this.#host.view.cameraController.setScene(this.#current);
  }

  /** Calls `read` with the LODs that need another level at the camera's distance, if there are any. */
  followLods(read: (changed: readonly SceneElement[]) => void): void {
    if (this.#current === undefined || this.#nestedReads > maxNestedLods) return;
    const changed = this.#lods.update(this.#current.lods, this.#host.view.cameraController.pose.position);
    if (changed.length === 0) return;
    this.#nestedReads += 1;
    read(changed);
    this.#nestedReads -= 1;
  }

  /** Handles a written `bind` or `set_bind`. They are events: writing the same value again binds again. */
  followBind(element: Element, attribute: string | null): void {
    if (attribute === null || !/^(set_)?bind$/i.test(attribute)) return;
    const { renderer, cameraController } = this.#host.view;
    const { scene } = renderer;
    const isBound = element.getAttribute(attribute)?.trim().toLowerCase() === "true";
    if (scene.bindFog(element, isBound)) return;
    if (scene.surroundings.bindBackground(element, isBound)) this.#followSurroundings();
    else cameraController.bind(element, isBound);
  }

  #followSurroundings(): void {
    if (this.#host.surroundings.follow()) this.#host.requestFiles();
  }
}

function isSameList<Item>(a: readonly Item[], b: readonly Item[]): boolean {
  return a.length === b.length && a.every((item, index) => item === b[index]);
}
