// Connects a page's viewer with the user interface of its view: attributes, poster,
// progress, overlays, camera input and announcements to screen readers.

import type { AnchorDescription } from "../document/description.ts";
import type { StageName } from "../stage/stage.ts";
import { orbitOf } from "../navigation/orbit.ts";
import type { ViewSettings } from "../element/attributes.ts";
import { cameraSettingOf, readSettings } from "../element/attributes.ts";
import { listenForCameraInput } from "./pointerInput.ts";
import type { UserInterface } from "./userInterface.ts";
import type { Preview } from "../preview/preview.ts";
import type { CameraInputLimits } from "./cameraInput.ts";
import { CameraInput } from "./cameraInput.ts";
import { hasHotspots, hasMenus, LateOverlays } from "./lateOverlays.ts";
import { sendShapePointerEvents } from "./shapePointerEvents.ts";
import { Poster } from "./poster.ts";
import { PreviewCover } from "./previewCover.ts";
import { PageViewer } from "./pageViewer.ts";
import { keepTouchAction } from "./touchAction.ts";
import type { Hit } from "../render/picking/picker.ts";
import { deviceSizeOf, observeDeviceSize, whenNearViewport } from "../element/visibility.ts";
import { ResetButtons } from "./resetButtons.ts";
import type { Toolbar } from "./toolbar.ts";
import { adoptSlotted, observeView } from "./viewObservers.ts";
import { makeViewToolbar } from "./viewToolbar.ts";
import { inlinedTitle } from "./inlinedRoots.ts";
import { drawingLabels, keyLabels, navigationTypeLabels, stageLabels, viewLabelOf } from "./labels.ts";

/** The view is announced to screen readers this long after the last movement. */
const announcementDelayMs = 700;

/** Distance from the viewport, in viewport sizes, within which a scene is loaded, by the attribute `loading`. */
const loadingMargins = { auto: 1, lazy: 0, eager: Infinity } as const;

export class ViewController {
  readonly viewer: PageViewer;
  readonly poster: Poster;
  readonly #x3d: Element;
  readonly #host: HTMLElement;
  readonly #ui: UserInterface;
  readonly #cameraInput: CameraInput;
  readonly #overlays: LateOverlays;
  readonly #resetButtons: ResetButtons;
  readonly #toolbar: Toolbar;
  readonly #onLabel: (label: string) => void;
  readonly #listeners = new AbortController();
  readonly #warned = new Set<string>();
  readonly #reducedMotion = matchMedia("(prefers-reduced-motion: reduce)");
  #settings: ViewSettings;
  #anchors: readonly AnchorDescription[] = [];
  /** Size of the canvas in CSS pixels. */
  #size = { width: 0, height: 0 };
  #lastPose: unknown;
  #lastType: string | undefined;
  #announcementTimer: ReturnType<typeof setTimeout> | undefined;
  readonly #applyTouchAction: () => void;
  #cover: PreviewCover | undefined;

  /** `host`: the view element in `x3d`, in whose shadow root `ui` is. `onLabel` is called with the scene's label. */
  constructor(
    x3d: Element,
    host: HTMLElement,
    ui: UserInterface,
    context: WebGL2RenderingContext,
    preview: Preview | undefined,
    onLabel: (label: string) => void,
  ) {
    this.#onLabel = onLabel;
    this.#x3d = x3d;
    this.#host = host;
    this.#ui = ui;
    this.poster = new Poster(host, ui, (name, detail) => {
      this.#send(name, detail);
      this.#updateRotation();
    });
    this.viewer = new PageViewer(
      x3d,
      ui.canvas,
      context,
      {
        onProgress: (share, stage) => {
          this.#showProgress(share, stage);
        },
        onFrame: () => {
          this.#onFrame();
        },
        isShownByPreview: () => this.#cover?.isCurrent === true,
        onDescription: () => {
          this.#updateDescription();
        },
        onAnchors: (anchors) => {
          this.#anchors = anchors;
          this.#overlays.use(({ links }) => {
            links.update(this.#anchors);
          });
        },
        maySettle: () => !this.#overlays.areLoading,
      },
      preview,
    );
    const { signal } = this.#listeners;
    const { cameraController } = this.viewer;
    this.#overlays = new LateOverlays({
      host,
      ui,
      viewer: this.viewer,
      anchors: () => this.#anchors,
      size: () => this.#size,
      warn: (sentence) => {
        this.#warnOnce(sentence);
      },
      signal,
    });
    this.#cameraInput = new CameraInput(cameraController, this.#limits);
    this.#resetButtons = new ResetButtons(ui.controls, cameraController, signal);
    this.#toolbar = makeViewToolbar(
      host,
      ui,
      {
        togglePoints: () => {
          this.#toggleDrawing();
        },
        isDrawnAsPoints: () => x3d.getAttribute("draw-as") === "points",
        onFullScreen: () => {
          this.#updateDescription();
        },
        savePicture: () => {
          this.viewer.renderer.draw(); // what the canvas holds now can be read in this turn of the event loop only
          ui.canvas.toBlob((picture) => {
            if (picture === null) return; // a canvas without area
            this.#overlays.use((overlays) => {
              overlays.savePicture(picture, this.#label);
            });
          });
        },
        openHelp: () => {
          this.#openHelp();
        },
      },
      signal,
    );
    this.#settings = this.#readSettings();
    cameraController.isInstant = this.#reducedMotion.matches;
    this.#reducedMotion.addEventListener(
      "change",
      ({ matches }) => {
        cameraController.isInstant = matches;
        this.#updateRotation();
        this.#updateMotion();
      },
      { signal },
    );
    this.#applyTouchAction = keepTouchAction(
      ui.canvas,
      () => (this.#cameraInput.type === "none" ? "manipulation" : this.#settings["touch-action"]),
      signal,
    );
    adoptSlotted(x3d, host);
    observeView(
      x3d,
      host,
      {
        onAttributes: () => {
          this.#settings = this.#readSettings();
          this.#applySettings();
        },
        onHotspots: () => {
          this.#readHotspots();
          this.viewer.renderer.frames.request();
        },
      },
      signal,
    );
    this.#readHotspots();
    this.#applySettings();
    if (preview !== undefined) this.#coverWith(preview);
    this.poster.show(this.#settings.poster, this.#label);
    x3d.addEventListener(
      "first-image",
      () => {
        this.poster.onPicture();
      },
      { signal },
    );
    x3d.addEventListener(
      "load",
      () => {
        ui.announce("The scene is complete.");
        this.viewer.scene.view.resources.onComplete();
        this.#cover?.onComplete();
      },
      { signal },
    );
    sendShapePointerEvents(
      ui.canvas,
      host,
      this.viewer.renderer.picker,
      {
        onHover: (hit) => {
          this.#onHover(hit);
        },
        onClick: (hit, native) => {
          const anchor = this.viewer.renderer.scene.shapes.anchorAround(hit.group);
          if (anchor)
            this.#overlays.use(({ links }) => {
              links.follow(anchor, native);
            });
        },
      },
      signal,
    );
    listenForCameraInput(ui.canvas, this.#cameraInput, signal);
    ui.canvas.addEventListener(
      "keydown",
      (event) => {
        this.#onKey(event);
      },
      { signal },
    );
    observeDeviceSize(ui.canvas, signal, (width, height, ratio) => {
      this.#size = { width: width / ratio, height: height / ratio };
      this.viewer.renderer.resize(width, height, ratio);
    });
  }

  #coverWith(preview: Preview): void {
    const { viewer } = this;
    const view = {
      canvas: this.#ui.canvas,
      viewer,
      isStill: () =>
        !this.#settings["auto-rotate"] &&
        (this.#lastPose === undefined || viewer.cameraController.pose === this.#lastPose),
      onEnd: () => {
        this.#updateRotation();
      },
    };
    this.#cover = new PreviewCover(preview, view, this.#listeners.signal);
    if (preview.shapes.length > 0) this.poster.onPicture();
  }

  /**
   * Begins to follow the document, and to load files once the canvas is near enough to the viewport for the attribute
   * `loading`.
   */
  start(): void {
    // Before the first request: the order of requests depends on the view.
    this.viewer.renderer.setSize(...deviceSizeOf(this.#ui.canvas));
    this.viewer.start();
    const margin = loadingMargins[this.#settings.loading];
    if (margin === Infinity) this.viewer.scene.load();
    else
      whenNearViewport(this.#ui.canvas, margin, this.#listeners.signal, () => {
        this.viewer.scene.load();
      });
    this.#cover?.onStart();
  }

  /** Starts automatic rotation without delay. */
  play(): void {
    this.viewer.cameraController.autoRotation.start(false);
  }

  pause(): void {
    this.viewer.cameraController.autoRotation.stop();
  }

  dispose(): void {
    clearTimeout(this.#announcementTimer);
    this.#listeners.abort();
    this.#cover?.end();
    this.viewer.dispose();
  }

  /** The label of the canvas. */
  get #label(): string {
    const labels = [
      this.#settings.alt,
      ...["aria-label", "title"].map((name) => this.#x3d.getAttribute(name)),
      this.#x3d.querySelector("worldinfo")?.getAttribute("title"),
      inlinedTitle(this.viewer.scene.core),
    ];
    return labels.find((label) => label !== "" && label !== null && label !== undefined) ?? "3D scene";
  }

  /** Which camera input the attributes allow. */
  readonly #limits = (): CameraInputLimits => ({
    isDisabled: !this.#settings["camera-controls"],
    canZoom: !this.#settings["disable-zoom"],
    canPan: !this.#settings["disable-pan"],
  });

  #readSettings(): ViewSettings {
    return readSettings(this.#x3d, (sentence) => {
      this.#warnOnce(`<${this.#x3d.localName}> ${sentence}`);
    });
  }

  #warnOnce(sentence: string): void {
    if (this.#warned.has(sentence)) return;
    this.#warned.add(sentence);
    console.warn(`imgeo: ${sentence}`);
  }

  /** Shows by cursor and tooltip whether a click follows a link. */
  #onHover(hit: Hit | undefined): void {
    const { canvas } = this.#ui;
    const anchor = hit && this.viewer.renderer.scene.shapes.anchorAround(hit.group);
    const link = anchor && this.#overlays.loaded?.links.of(anchor);
    canvas.classList.toggle("points-at-link", link !== undefined);
    canvas.title = link?.textContent ?? "";
  }

  #applySettings(): void {
    const { renderer, cameraController, scene } = this.viewer;
    const settings = this.#settings;
    cameraController.setCamera(cameraSettingOf(settings));
    cameraController.autoRotation.delayMs = settings["auto-rotate-delay"];
    cameraController.autoRotation.radiansPerSecond = settings["rotation-per-second"];
    renderer.setExposure(settings.exposure);
    renderer.scene.drawAsPoints(settings["draw-as"] === "points");
    scene.core.control.setBudget(settings.budget);
    scene.core.deliveries.geometries.setSequenceTime(settings["sequence-time"]);
    this.#updateMotion();
    this.poster.reveal = settings.reveal;
    this.#updateDescription();
    this.#updateRotation();
  }

  /**
   * Starts or stops automatic rotation: on with `auto-rotate`, once the scene is visible, unless the user prefers
   * reduced motion.
   */
  #updateRotation(): void {
    const { autoRotation } = this.viewer.cameraController;
    const shouldRotate =
      this.#settings["auto-rotate"] &&
      this.poster.isModelVisible &&
      this.#cover?.isThere !== true &&
      !this.#reducedMotion.matches;
    if (!shouldRotate) autoRotation.stop();
    else if (autoRotation.isStopped) autoRotation.start(true);
  }

  /** Stops the document's clocks with `paused`; those that start by themselves, if the user prefers reduced motion. */
  #updateMotion(): void {
    const { paused } = this.#settings;
    this.viewer.scene.animation.setMotion(paused === true, paused === false || !this.#reducedMotion.matches);
  }

  /**
   * Updates the description of the canvas and its keys for screen readers, and the cursor, touch gestures and menus.
   */
  #updateDescription(): void {
    const { canvas } = this.#ui;
    const { type } = this.viewer.cameraController;
    const isStatic = this.#cameraInput.type === "none";
    const label = this.#label;
    canvas.setAttribute("aria-label", label);
    this.#onLabel(label);
    // Screen readers pass arrow keys on to the role `application` only.
    canvas.setAttribute("role", isStatic ? "img" : "application");
    canvas.ariaRoleDescription = isStatic ? null : "3D view";
    canvas.ariaDescription = isStatic ? null : keyLabels[type];
    canvas.tabIndex = isStatic ? -1 : 0;
    canvas.classList.toggle("moves", !isStatic);
    this.#applyTouchAction();
    if (this.#overlays.loaded !== undefined || hasMenus(this.viewer.cameraController))
      this.#overlays.use(({ menus }) => {
        menus.update();
      });
    this.#toolbar.update(this.#settings["camera-controls"]);
    if (this.#lastType !== undefined && this.#lastType !== type)
      this.#ui.announce(`${navigationTypeLabels[type]}. ${keyLabels[type]}`);
    this.#lastType = type;
  }

  /** The keys of tools. */
  #onKey({ key, ctrlKey, metaKey, altKey }: KeyboardEvent): void {
    if (ctrlKey || metaKey || altKey || this.#cameraInput.type === "none") return;
    if (key.toLowerCase() === "p") this.#toggleDrawing();
    else if (key === "?") this.#openHelp();
  }

  #openHelp(): void {
    this.#overlays.use((overlays) => {
      overlays.openHelp(this.#cameraInput.type);
    });
  }

  #readHotspots(): void {
    if (this.#overlays.loaded !== undefined || hasHotspots(this.#host))
      this.#overlays.use(({ hotspots }) => {
        hotspots.read();
      });
  }

  /** Changes the attribute `draw-as`, so that pages can observe it. */
  #toggleDrawing(): void {
    const drawing = this.#settings["draw-as"] === "points" ? "surface" : "points";
    this.#x3d.setAttribute("draw-as", drawing);
    this.#ui.announce(drawingLabels[drawing]);
  }

  #showProgress(share: number, stage: StageName | "none"): void {
    this.#ui.showProgress(share, stageLabels[stage]);
  }

  #onFrame(): void {
    const { cameraController, renderer } = this.viewer;
    const { view } = renderer;
    this.#cover?.onFrame();
    if (view !== undefined) this.#overlays.loaded?.hotspots.update(view, this.#size.width, this.#size.height);
    this.#resetButtons.update();
    if (cameraController.pose === this.#lastPose) return;
    const isFirst = this.#lastPose === undefined;
    this.#lastPose = cameraController.pose;
    this.#send("camera-change", { source: cameraController.source });
    if (!isFirst && cameraController.source !== "automatic") this.#announceViewSoon();
  }

  #announceViewSoon(): void {
    clearTimeout(this.#announcementTimer);
    this.#announcementTimer = setTimeout(() => {
      const { cameraController } = this.viewer;
      this.#ui.announce(cameraController.viewpointName ?? viewLabelOf(orbitOf(cameraController.pose)));
    }, announcementDelayMs);
  }

  #send(name: string, detail: object): void {
    this.#x3d.dispatchEvent(new CustomEvent(name, { detail, bubbles: false }));
  }
}
