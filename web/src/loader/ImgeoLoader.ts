// The loader of imgeo scenes for three.js apps, with the conventions of three.js'
// loaders: it takes the URL of a `scene.x3d` or `index.html` and gives an Object3D.

import { Loader } from "three";
import type { Progress } from "../delivery/progress.ts";
import { networkMessage } from "../scheduler/download.ts";
import { Scheduler } from "../scheduler/scheduler.ts";
import { slotCountFor } from "../scheduler/downloadSlots.ts";
import { pageWorkers } from "../workers/pageWorkers.ts";
import type { WorkerPool } from "../workers/workerPool.ts";
import type { MaterialMaker } from "./standardMaterials.ts";
import { standardMaterialOf } from "./standardMaterials.ts";
import { ImgeoScene } from "./imgeoScene.ts";
import { reportToManager } from "./managerProgress.ts";
import { readDocument } from "./readDocument.ts";

export interface LoadOptions {
  /** Aborts the loading of this scene; the loader's `abort` aborts that of all scenes. */
  readonly signal?: AbortSignal;
}

export class ImgeoLoader extends Loader<ImgeoScene> {
  readonly #scheduler = new Scheduler(slotCountFor(""));
  #makeMaterial: MaterialMaker = standardMaterialOf;
  #keepsVertices = false;
  #budget = Infinity;
  #workerUrl: string | URL | undefined;
  #workers: WorkerPool | undefined;
  #aborter = new AbortController();

  /** Sets the function that makes a shape's material from its X3D material, instead of a MeshStandardMaterial. */
  setMaterial(makeMaterial: MaterialMaker): this {
    this.#makeMaterial = makeMaterial;
    return this;
  }

  /**
   * Has workers decode images to vertex buffers, instead of shaders reading them. This
   * takes more memory, but three.js' Raycaster, which needs vertices, finds everything.
   */
  setKeepVertices(keepsVertices: boolean): this {
    this.#keepsVertices = keepsVertices;
    return this;
  }

  /**
   * Sets the GPU memory in bytes of vertex data and textures of a scene beyond which its meshes with levels of detail
   * are not refined, for each scene that is loaded from now on. Nothing else depends on it.
   */
  setBudget(bytes: number): this {
    this.#budget = bytes;
    return this;
  }

  /**
   * Sets the URL of the package's `imgeo-worker.js`, if that is not beside the bundle. Its `imgeo-decoder.wasm` lies
   * beside the worker.
   */
  setWorkerUrl(url: string | URL): this {
    this.#workerUrl = url;
    this.#workers?.dispose();
    this.#workers = undefined;
    return this;
  }

  /**
   * Calls `onLoad` with the scene when every visible patch displays something or has failed. The scene refines
   * itself until its promise `complete` resolves; `onProgress` is called until then.
   * `onError` is called if the document cannot be loaded, or if nothing of the scene can be displayed.
   */
  override load(
    url: string,
    onLoad: (scene: ImgeoScene) => void,
    onProgress?: (event: ProgressEvent) => void,
    onError?: (error: unknown) => void,
    options: LoadOptions = {},
  ): void {
    const { manager } = this;
    const documentUrl = manager.resolveURL(this.path + url);
    manager.itemStart(documentUrl);
    void this.#load(documentUrl, onProgress, options)
      .then(onLoad, (error: unknown) => {
        if (onError) onError(error);
        else console.error("imgeo:", error);
        manager.itemError(documentUrl);
      })
      .finally(() => {
        manager.itemEnd(documentUrl);
      });
  }

  override loadAsync(
    url: string,
    onProgress?: (event: ProgressEvent) => void,
    options: LoadOptions = {},
  ): Promise<ImgeoScene> {
    return new Promise((resolve, reject) => {
      this.load(url, resolve, onProgress, reject, options);
    });
  }

  /**
   * Parses a document, whose relative URLs are resolved against `path`. The scene is returned at once, and is empty
   * until its files arrive.
   */
  parse(text: string, path = this.resourcePath || this.path): ImgeoScene {
    const url = new URL(path, document.baseURI).href;
    return this.#sceneOf(text, "the document", url);
  }

  /** Aborts all loading of this loader. Scenes keep what they display. */
  override abort(): this {
    this.#aborter.abort();
    this.#aborter = new AbortController();
    return this;
  }

  /** Aborts all loading and ends the workers. Scenes keep what they display. */
  dispose(): void {
    this.abort();
    this.#workers?.dispose();
    this.#workers = undefined;
  }

  async #load(
    documentUrl: string,
    onProgress: ((event: ProgressEvent) => void) | undefined,
    { signal }: LoadOptions,
  ): Promise<ImgeoScene> {
    const abortSignal = AbortSignal.any([
      ...(signal ? [signal] : []),
      this.#aborter.signal,
      this.manager.abortController.signal,
    ]);
    const text = await this.#fetchText(documentUrl, abortSignal);
    const scene = this.#sceneOf(text, documentUrl, new URL(documentUrl, document.baseURI).href);
    const abortScene = () => {
      scene.abort();
    };
    abortSignal.addEventListener("abort", abortScene, { once: true });
    const stopListening = () => {
      abortSignal.removeEventListener("abort", abortScene);
    };
    scene.complete.then(stopListening, stopListening);
    if (onProgress)
      scene.addEventListener("progress", ({ progress }) => {
        onProgress(progressEventOf(progress));
      });
    try {
      await scene.firstImage;
      return scene;
    } catch (error) {
      scene.dispose();
      throw error;
    }
  }

  #sceneOf(text: string, name: string, documentUrl: string): ImgeoScene {
    const base = this.resourcePath === "" ? documentUrl : new URL(this.resourcePath, document.baseURI).href;
    // An invalid URL is passed on: the manager may map it, or the request fails with a message.
    const urlOf = (url: string) => (URL.canParse(url, base) ? new URL(url, base).href : url);
    const resolve = (url: string) => this.manager.resolveURL(url);
    const scene = new ImgeoScene({
      x3d: readDocument(text, name),
      url: documentUrl,
      urlOf,
      resolve,
      scheduler: this.#scheduler,
      makeMaterial: this.#makeMaterial,
      keepsVertices: this.#keepsVertices,
      budget: this.#budget,
      runJob: (job, input, signal) => (this.#workers ??= pageWorkers(this.#workerUrl)).run(job, input, signal),
      fetch: (input, init) => fetch(input, { ...init, ...this.#requestInit }),
    });
    reportToManager(scene, this.manager, (url) => resolve(urlOf(url)));
    return scene;
  }

  async #fetchText(url: string, signal: AbortSignal): Promise<string> {
    const response = await fetch(url, { ...this.#requestInit, signal }).catch((error: unknown) => {
      if (signal.aborted) throw error;
      throw new Error(`${url}: ${networkMessage(url, error)}`, { cause: error });
    });
    if (!response.ok) throw new Error(`${url}: the server answered ${response.status} ${response.statusText}`.trim());
    const text = await response.text();
    const [timing] = performance.getEntriesByName(response.url).slice(-1);
    if (timing instanceof PerformanceResourceTiming) this.#scheduler.slotCount = slotCountFor(timing.nextHopProtocol);
    return text;
  }

  get #requestInit(): RequestInit {
    const { requestHeader: headers, withCredentials, priority, cache } = this;
    return { headers, credentials: withCredentials ? "include" : "same-origin", priority, cache };
  }
}

function progressEventOf({ loadedBytes, totalBytes }: Progress): ProgressEvent {
  return new ProgressEvent("progress", { lengthComputable: totalBytes > 0, loaded: loadedBytes, total: totalBytes });
}
