// A part of the runtime in a module of its own.

export interface PartModule {
  /** Makes the part known to the registries of what it adds to, if any. */
  readonly add?: () => void;
  readonly [name: string]: unknown;
}

export class LatePart<Module extends PartModule = PartModule> {
  readonly #import: () => Promise<Module>;
  #module: Module | undefined;
  #loading: Promise<Module> | undefined;

  constructor(load: () => Promise<Module>) {
    this.#import = load;
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

  /** Rejects if the module cannot be loaded; a later call tries again. */
  load(): Promise<Module> {
    this.#loading ??= this.#import().then(
      (module) => this.#set(module),
      (error: unknown) => {
        this.#loading = undefined;
        throw error;
      },
    );
    return this.#loading;
  }

  #set(module: Module): Module {
    module.add?.();
    this.#module = module;
    return module;
  }
}
