// The members that share a delivery: each joins with a listener, and the delivery ends when the last one leaves.

export class Members<Listener> implements Iterable<Listener> {
  readonly #listeners = new Set<Listener>();
  #count = 0;

  /**
   * Adds a member. In the next microtask, unless the member has left by then, adds its listener and calls `onJoin`,
   * which reports what happened before. Returns the function with which the member leaves; a second call does nothing.
   * Calls `onEmpty` when the last member leaves.
   */
  join(listener: Listener, onJoin: () => void, onEmpty: () => void): () => void {
    let hasLeft = false;
    this.#count += 1;
    queueMicrotask(() => {
      if (hasLeft) return;
      this.#listeners.add(listener);
      onJoin();
    });
    return () => {
      if (hasLeft) return;
      hasLeft = true;
      this.#listeners.delete(listener);
      this.#count -= 1;
      if (this.#count === 0) onEmpty();
    };
  }

  /** The listeners of the members that have received what happened before they joined. */
  [Symbol.iterator](): Iterator<Listener> {
    return this.#listeners.values();
  }
}
