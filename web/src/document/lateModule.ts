// What a part of the runtime (parts.ts) adds to code that has been loaded before it.

export class LateModule<Added> {
  readonly #subject: string;
  #added: Added | undefined;

  /** `subject`: as in "the module for …". */
  constructor(subject: string) {
    this.#subject = subject;
  }

  /** Undefined in tests of what happens before. */
  add(added: Added | undefined): void {
    this.#added = added;
  }

  /** Undefined until the module has been loaded, which happens before a scene that needs it is displayed. */
  get added(): Added | undefined {
    return this.#added;
  }

  /** Throws RangeError until the module has been loaded. */
  get required(): Added {
    if (this.#added === undefined) throw new RangeError(`the module for ${this.#subject} is not loaded`);
    return this.#added;
  }
}
