// Loads the overlays of a view, a module of its own, when the scene has some or the user asks for one. The scene is
// displayed without them; what is asked for meanwhile happens when they are there.

import type { CameraController } from "../navigation/cameraController.ts";
import { LatePart } from "../viewer/parts/latePart.ts";
import type * as overlays from "./overlays.ts";
import type { OverlaidView, Overlays } from "./overlays.ts";

export type OverlaysModule = typeof overlays;

/** One for all views of the page. */
let part: LatePart<OverlaysModule> | undefined;

export function setOverlaysImport(load: () => Promise<OverlaysModule>): void {
  part = new LatePart(load);
}

export class LateOverlays {
  readonly #view: OverlaidView;
  #overlays: Overlays | undefined;
  #waitingCount = 0;

  constructor(view: OverlaidView) {
    this.#view = view;
  }

  /** Undefined until something has needed them and they have been loaded. */
  get loaded(): Overlays | undefined {
    return this.#overlays;
  }

  get areLoading(): boolean {
    return this.#waitingCount > 0;
  }

  /**
   * Calls back with the overlays: at once, or when they have been loaded, in the order of the calls. If they cannot be
   * loaded, warns instead; a later call tries again. Throws RangeError before `setOverlaysImport`.
   */
  use(call: (overlays: Overlays) => void): void {
    if (this.#overlays !== undefined) {
      call(this.#overlays);
      return;
    }
    if (part === undefined) throw new RangeError("the page has no module for overlays");
    this.#waitingCount += 1;
    part
      .load()
      .then(
        (module) => {
          if (this.#view.signal.aborted) return;
          call((this.#overlays ??= new module.Overlays(this.#view)));
        },
        (error: unknown) => {
          this.#view.warn(`the module for hotspots, links, menus and help could not be loaded: ${String(error)}`);
        },
      )
      .finally(() => {
        this.#waitingCount -= 1;
        const { viewer, signal } = this.#view;
        if (!this.areLoading && !signal.aborted) viewer.renderer.frames.request(); // the page may be complete now
      });
  }
}

/** Whether the page has hotspots in a view element. */
export function hasHotspots(host: Element): boolean {
  return Array.from(host.children).some(({ slot }) => slot.startsWith("hotspot"));
}

/** Whether a scene has menus: several viewpoints with a description, or several navigation types. */
export function hasMenus({ namedViewpoints, listedTypes }: CameraController): boolean {
  return listedTypes.length > 1 || namedViewpoints.length > 1;
}
