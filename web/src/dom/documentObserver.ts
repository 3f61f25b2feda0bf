// Reports changes of the scene in the document, except those that the runtime writes.

import { isSceneNode } from "../element/sceneNodes.ts";

export class DocumentObserver {
  readonly #x3d: Element;
  readonly #observer: MutationObserver;
  readonly #onChanges: (records: readonly MutationRecord[]) => void;

  /** `onChanges` gets what has changed in the scene of `x3d`, at least one record. */
  constructor(x3d: Element, onChanges: (records: readonly MutationRecord[]) => void) {
    this.#x3d = x3d;
    this.#onChanges = onChanges;
    this.#observer = new MutationObserver((records) => {
      this.#report(records);
    });
  }

  start(): void {
    this.#observer.observe(this.#x3d, { subtree: true, childList: true, attributes: true });
  }

  /** Changes the document without a report, which would cost more than the change. */
  writeUnobserved(write: () => void): void {
    const earlier = this.#observer.takeRecords();
    this.#observer.disconnect();
    try {
      write();
    } finally {
      this.start();
    }
    this.#report(earlier);
  }

  stop(): void {
    this.#observer.disconnect();
  }

  #report(allRecords: readonly MutationRecord[]): void {
    const records = allRecords.filter(({ target }) => isSceneNode(target, this.#x3d));
    if (records.length > 0) this.#onChanges(records);
  }
}
