// A part of the runtime in a module of its own.

import { defaultDownloadOptions } from "../../scheduler/download.ts";

export interface PartModule {
  /** Makes the part known to the registries of what it adds to, if any. */
  readonly add?: () => void;
  readonly [name: string]: unknown;
}

/** Pauses before further attempts in milliseconds, as for other files: a busy server may answer the next one. */
const { retries, backoffMs } = defaultDownloadOptions;
const defaultPausesMs: readonly number[] = Array.from({ length: retries }, (_, attempt) => backoffMs * 2 ** attempt);

export class LatePart<Module extends PartModule = PartModule> {
  readonly #import: () => Promise<Module>;
  readonly #pausesMs: readonly number[];
  #module: Module | undefined;
  #loading: Promise<Module> | undefined;

  constructor(load: () => Promise<Module>, pausesMs = defaultPausesMs) {
    this.#import = load;
    this.#pausesMs = pausesMs;
  }

  /** A part whose module has been loaded. */
  static of<Module extends PartModule>(module: Module): LatePart<Module> {
    const part = new LatePart<Module>(
      () =>
        new Promise((resolve) => {
          resolve(module);
        }),
    );
    part.#set(module);
    return part;
  }

  /** Undefined until it has been loaded. */
  get module(): Module | undefined {
    return this.#module;
  }

  /** Rejects if the module cannot be loaded after all attempts; a later call tries again. */
  load(): Promise<Module> {
    this.#loading ??= this.#tryToImport().then(
      (module) => this.#set(module),
      (error: unknown) => {
        this.#loading = undefined;
        throw error;
      },
    );
    return this.#loading;
  }

  async #tryToImport(): Promise<Module> {
    for (const pauseMs of this.#pausesMs) {
      try {
        return await this.#import();
      } catch {
        await new Promise((resolve) => setTimeout(resolve, pauseMs));
      }
    }
    return this.#import();
  }

  #set(module: Module): Module {
    module.add?.();
    this.#module = module;
    return module;
  }
}
