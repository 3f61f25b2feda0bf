// Connects a page's viewer with the user interface of its view: each subject of it is in a file of its own.

import type { AnchorDescription } from "../document/description.ts";
import type { ViewSettings } from "../element/attributes.ts";
import { cameraSettingOf, readSettings } from "../element/attributes.ts";
import { listenForCameraInput } from "./pointerInput.ts";
import type { UserInterface } from "./userInterface.ts";
import type { Preview } from "../preview/preview.ts";
import { followAnchorsByPointer } from "./anchorPointer.ts";
import { AutomaticMotion } from "./automaticMotion.ts";
import { CameraChanges } from "./cameraChanges.ts";
import { CameraInput } from "./cameraInput.ts";
import type { DescribeCanvas } from "./canvasDescription.ts";
import { canvasDescriber } from "./canvasDescription.ts";
import type { OverlaidView } from "./overlays.ts";
import { sceneLabelOf } from "./sceneLabel.ts";
import { hasHotspots, hasMenus, LateOverlays } from "./lateOverlays.ts";
import { Poster } from "./poster.ts";
import { PreviewCover } from "./previewCover.ts";
import { PageViewer } from "./pageViewer.ts";
import { keepTouchAction } from "./touchAction.ts";
import { deviceSizeOf, observeDeviceSize, whenNearViewport } from "../element/visibility.ts";
import { ResetButtons } from "./resetButtons.ts";
import type { Toolbar } from "./toolbar.ts";
import { adoptSlotted, observeView } from "./viewObservers.ts";
import { addTools } from "./viewTools.ts";
import { inlinedTitle } from "./inlinedRoots.ts";
import { stageLabels } from "./labels.ts";

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
  readonly #motion: AutomaticMotion;
  readonly #changes: CameraChanges;
  readonly #describeCanvas: DescribeCanvas;
  #settings: ViewSettings;
  #anchors: readonly AnchorDescription[] = [];
  /** Size of the canvas in CSS pixels. */
  #size = { width: 0, height: 0 };
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
    this.#settings = this.#readSettings();
    this.poster = new Poster(host, ui, (name, detail) => {
      this.#send(name, detail);
      this.#motion.updateRotation();
    });
    this.viewer = new PageViewer(
      x3d,
      ui.canvas,
      context,
      {
        onProgress: (share, stage) => {
          ui.showProgress(share, stageLabels[stage]);
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
    const view: OverlaidView = {
      host,
      ui,
      viewer: this.viewer,
      anchors: () => this.#anchors,
      size: () => this.#size,
      warn: (sentence) => {
        this.#warnOnce(sentence);
      },
      signal,
    };
    this.#overlays = new LateOverlays(view);
    this.#cameraInput = new CameraInput(cameraController, () => ({
      isDisabled: !this.#settings["camera-controls"],
      canZoom: !this.#settings["disable-zoom"],
      canPan: !this.#settings["disable-pan"],
    }));
    this.#resetButtons = new ResetButtons(ui.controls, cameraController, signal);
    this.#changes = new CameraChanges(cameraController, {
      onChange: (detail) => {
        this.#send("camera-change", detail);
      },
      announce: (text) => {
        ui.announce(text);
      },
    });
    this.#describeCanvas = canvasDescriber(ui);
    this.#motion = new AutomaticMotion(
      {
        viewer: this.viewer,
        settings: () => this.#settings,
        isSceneVisible: () => this.poster.isModelVisible && this.#cover?.isThere !== true,
      },
      signal,
    );
    this.#toolbar = addTools({
      ...view,
      x3d,
      overlays: this.#overlays,
      cameraInput: this.#cameraInput,
      label: () => this.#label,
      isDrawnAsPoints: () => this.#settings["draw-as"] === "points",
      onFullScreen: () => {
        this.#updateDescription();
      },
    });
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
    followAnchorsByPointer(view, this.#overlays); // before the camera input, since pages may prevent what that follows
    listenForCameraInput(ui.canvas, this.#cameraInput, signal);
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
      isStill: () => !this.#settings["auto-rotate"] && this.#changes.isStill,
      onEnd: () => {
        this.#motion.updateRotation();
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
    this.#changes.end();
    this.#listeners.abort();
    this.#cover?.end();
    this.viewer.dispose();
  }

  /** The label of the canvas. */
  get #label(): string {
    return sceneLabelOf(this.#x3d, this.#settings.alt, inlinedTitle(this.viewer.scene.core));
  }

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

  #applySettings(): void {
    const { renderer, cameraController, scene } = this.viewer;
    const settings = this.#settings;
    this.#motion.update();
    cameraController.setCamera(cameraSettingOf(settings));
    renderer.setExposure(settings.exposure);
    renderer.scene.drawAsPoints(settings["draw-as"] === "points");
    scene.core.control.setBudget(settings.budget);
    scene.core.deliveries.geometries.setSequenceTime(settings["sequence-time"]);
    this.poster.reveal = settings.reveal;
    this.#updateDescription();
  }

  /** Updates what follows label, navigation type and settings. */
  #updateDescription(): void {
    const label = this.#label;
    this.#describeCanvas(label, this.viewer.cameraController.type, this.#cameraInput.type === "none");
    this.#onLabel(label);
    this.#applyTouchAction();
    if (this.#overlays.loaded !== undefined || hasMenus(this.viewer.cameraController))
      this.#overlays.use(({ menus }) => {
        menus.update();
      });
    this.#toolbar.update(this.#settings["camera-controls"]);
  }

  #readHotspots(): void {
    if (this.#overlays.loaded !== undefined || hasHotspots(this.#host))
      this.#overlays.use(({ hotspots }) => {
        hotspots.read();
      });
  }

  #onFrame(): void {
    const { view } = this.viewer.renderer;
    this.#cover?.onFrame();
    if (view !== undefined) this.#overlays.loaded?.hotspots.update(view, this.#size.width, this.#size.height);
    this.#resetButtons.update();
    this.#changes.onFrame();
  }

  #send(name: string, detail: object): void {
    this.#x3d.dispatchEvent(new CustomEvent(name, { detail, bubbles: false }));
  }
}
