// The parts of the runtime that a scene needs and that have not been loaded yet.

import type { SceneElement } from "../document/element.ts";
import type { PartName } from "../document/parts.ts";
import type { Parts } from "./parts/parts.ts";

export class NeededParts {
  readonly #parts: Parts;
  /** With the nodes that are to be read when a part is there. */
  readonly #needed = new Map<PartName, Set<SceneElement>>();
  #isLoading = false;

  constructor(parts: Parts) {
    this.#parts = parts;
  }

  get areLoaded(): boolean {
    return this.#needed.size === 0;
  }

  need(part: PartName, unread?: SceneElement): void {
    if (this.#parts[part].module !== undefined) return;
    const nodes = this.#needed.get(part) ?? new Set();
    if (unread) nodes.add(unread);
    this.#needed.set(part, nodes);
  }

  /**
   * Loads the parts; resolves with the nodes that are to be read now, or undefined if an earlier call is still loading.
   * Rejects if a part cannot be loaded: a later call tries again.
   */
  async load(): Promise<ReadonlySet<SceneElement> | undefined> {
    if (this.#isLoading) return undefined;
    this.#isLoading = true;
    try {
      const unread = new Set<SceneElement>();
      // More may be needed meanwhile.
      for (let names = [...this.#needed.keys()]; names.length > 0; names = [...this.#needed.keys()]) {
        await Promise.all(names.map((name) => this.#parts[name].load()));
        for (const name of names) {
          for (const node of this.#needed.get(name) ?? []) unread.add(node);
          this.#needed.delete(name);
        }
      }
      return unread;
    } finally {
      this.#isLoading = false;
    }
  }
}
