// Loads a scene into somebody's own three.js app, after the conventions of
// three's loaders: `scene.x3d` or `index.html` in, an Object3D out.

import { Loader } from "three";
import type { Progress } from "../delivery/progress.ts";
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
  /** Ends the loading, as `abort` does for all that a loader loads. */
  readonly signal?: AbortSignal;
}

export class ImgeoLoader extends Loader<ImgeoScene> {
  readonly #scheduler = new Scheduler(slotCountFor(""));
  #makeMaterial: MaterialMaker = standardMaterialOf;
  #keepsVertices = false;
  #workerUrl: string | URL | undefined;
  #workers: WorkerPool | undefined;
  #aborter = new AbortController();

  /** Shapes get what this makes of their X3D material, instead of a MeshStandardMaterial. */
  setMaterial(makeMaterial: MaterialMaker): this {
    this.#makeMaterial = makeMaterial;
    return this;
  }

  /**
   * Decodes images into vertex buffers in workers, instead of letting shaders read
   * them: more memory, but three's Raycaster, which needs vertices, finds everything.
   */
  setKeepVertices(keepsVertices: boolean): this {
    this.#keepsVertices = keepsVertices;
    return this;
  }

  /** Where the package's `imgeo-worker.js` is, if not beside the bundle. */
  setWorkerUrl(url: string | URL): this {
    this.#workerUrl = url;
    this.#workers?.dispose();
    this.#workers = undefined;
    return this;
  }

  /**
   * `onLoad` gets the scene when all of it shows something; it goes on to refine
   * itself, until its promise `complete` resolves. `onProgress` is called until
   * then. `onError` is called where there is no scene, or nothing to show of it.
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

  /** Reads a document's text; relative URLs in it start at `path`. The scene is there at once, and empty until its files come. */
  parse(text: string, path = this.resourcePath || this.path): ImgeoScene {
    const url = new URL(path, document.baseURI).href;
    return this.#sceneOf(text, "the document", url);
  }

  /** Ends all that this loader is loading. Scenes that are there stay as they are. */
  override abort(): this {
    this.#aborter.abort();
    this.#aborter = new AbortController();
    return this;
  }

  /** Ends the workers, and what is being loaded. Scenes that are there stay as they are. */
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
    const ended = AbortSignal.any([
      ...(signal ? [signal] : []),
      this.#aborter.signal,
      this.manager.abortController.signal,
    ]);
    const text = await this.#fetchText(documentUrl, ended);
    const scene = this.#sceneOf(text, documentUrl, new URL(documentUrl, document.baseURI).href);
    const end = () => {
      scene.abort();
    };
    ended.addEventListener("abort", end, { once: true });
    const forget = () => {
      ended.removeEventListener("abort", end);
    };
    scene.complete.then(forget, forget);
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
    // What is no URL is left for the request to fail on, or for the manager to know.
    const urlOf = (named: string) => (URL.canParse(named, base) ? new URL(named, base).href : named);
    const resolve = (url: string) => this.manager.resolveURL(url);
    const scene = new ImgeoScene({
      x3d: readDocument(text, name),
      url: documentUrl,
      urlOf,
      resolve,
      scheduler: this.#scheduler,
      makeMaterial: this.#makeMaterial,
      keepsVertices: this.#keepsVertices,
      runJob: (job, input, signal) => (this.#workers ??= pageWorkers(this.#workerUrl)).run(job, input, signal),
      fetch: (input, init) => fetch(input, { ...init, ...this.#requestInit }),
    });
    reportToManager(scene, this.manager, (named) => resolve(urlOf(named)));
    return scene;
  }

  async #fetchText(url: string, signal: AbortSignal): Promise<string> {
    const response = await fetch(url, { ...this.#requestInit, signal });
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
