// Joins a viewer to its face: attributes, poster, progress, lists, hotspots, and
// what is said to those who do not see the picture.

import type { StageName } from "../stage/stage.ts";
import { orbitOf } from "../navigation/orbit.ts";
import type { ViewSettings } from "../element/attributes.ts";
import { cameraSettingOf, readSettings, viewAttributes } from "../element/attributes.ts";
import { listenForCameraInput } from "./pointerInput.ts";
import type { UserInterface } from "./userInterface.ts";
import type { Preview } from "../preview/preview.ts";
import type { CameraInputLimits } from "./cameraInput.ts";
import { CameraInput } from "./cameraInput.ts";
import { Hotspots } from "./hotspots.ts";
import { AnchorLinks } from "./anchorLinks.ts";
import { Menus } from "./menus.ts";
import { sendShapePointerEvents } from "./shapePointerEvents.ts";
import { Poster } from "./poster.ts";
import { PageViewer } from "./pageViewer.ts";
import { keepTouchAction } from "./touchAction.ts";
import type { Hit } from "../render/picking/picker.ts";
import { deviceSizeOf, observeDeviceSize, whenNearViewport } from "../element/visibility.ts";
import { ResetButtons } from "./resetButtons.ts";
import { drawingLabels, keyLabels, stageLabels, navigationTypeLabels, viewLabelOf } from "./labels.ts";

/** So long after the last movement the view is described. */
const quietMs = 700;

/** In screens around the visible part of the page. */
const marginOfLoading = { auto: 1, lazy: 0, eager: Infinity } as const;

export class ViewController {
  readonly viewer: PageViewer;
  readonly poster: Poster;
  readonly #x3d: Element;
  readonly #face: UserInterface;
  readonly #hands: CameraInput;
  readonly #lists: Menus;
  readonly #links: AnchorLinks;
  readonly #waysBack: ResetButtons;
  readonly #hotspots: Hotspots;
  readonly #listeners = new AbortController();
  readonly #warned = new Set<string>();
  readonly #lessMotion = matchMedia("(prefers-reduced-motion: reduce)");
  #settings: ViewSettings;
  #size = { width: 0, height: 0 };
  #shownPose: unknown;
  #shownType: string | undefined;
  #quietTimer: ReturnType<typeof setTimeout> | undefined;
  readonly #applyTouchAction: () => void;
  /** Stands before the picture until that shows as much. */
  #look: Preview | undefined;

  /** `host` is the element in `x3d` whose shadow root the face fills. */
  constructor(x3d: Element, host: HTMLElement, face: UserInterface, context: WebGL2RenderingContext, look?: Preview) {
    this.#x3d = x3d;
    this.#face = face;
    this.#hotspots = new Hotspots(host, face.hotspots, {
      isStill: () => !this.viewer.renderer.statistics.isFrameDue && !this.viewer.navigator.isMoving,
      placeAt: async (x, y) => {
        const { canvas } = face;
        const hit = await this.viewer.pickAsync(
          Math.floor((x * canvas.width) / this.#size.width),
          Math.floor((y * canvas.height) / this.#size.height),
        );
        return hit?.position.toArray();
      },
    });
    this.poster = new Poster(host, face, (name, detail) => {
      this.#send(name, detail);
      this.#rotate();
    });
    this.viewer = new PageViewer(
      x3d,
      face.canvas,
      context,
      {
        onProgress: (share, stage) => {
          this.#showProgress(share, stage);
        },
        onFrame: () => {
          this.#onFrame();
        },
        onNavigation: () => {
          this.#describe();
        },
        onAnchors: (anchors) => {
          this.#links.update(anchors);
        },
      },
      look?.shapes,
    );
    const { signal } = this.#listeners;
    const { navigator } = this.viewer;
    this.#hands = new CameraInput(navigator, this.#limits);
    this.#lists = new Menus(face.controls, navigator, signal);
    this.#links = new AnchorLinks(face.links, navigator, (sentence) => {
      this.#warnOnce(sentence);
    });
    this.#waysBack = new ResetButtons(face.controls, navigator, signal);
    this.#settings = this.#readSettings();
    navigator.isInstant = this.#lessMotion.matches;
    this.#lessMotion.addEventListener(
      "change",
      ({ matches }) => {
        navigator.isInstant = matches;
        this.#rotate();
      },
      { signal },
    );
    this.#applyTouchAction = keepTouchAction(
      face.canvas,
      () => (this.#hands.type === "none" ? "manipulation" : this.#settings["touch-action"]),
      signal,
    );
    adoptSlotted(x3d, host);
    this.#follow(host);
    this.#apply();
    if (look !== undefined) this.#stayBehind(look);
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
        face.announce("The scene is complete.");
      },
      { signal },
    );
    sendShapePointerEvents(
      face.canvas,
      host,
      this.viewer,
      {
        onHover: (hit) => {
          this.#pointAt(hit);
        },
        onClick: (hit, native) => {
          const anchor = this.viewer.renderer.anchorOf(hit);
          if (anchor) this.#links.follow(anchor, native);
        },
      },
      signal,
    );
    listenForCameraInput(face.canvas, this.#hands, signal);
    face.canvas.addEventListener(
      "keydown",
      (event) => {
        this.#toggleDrawing(event);
      },
      { signal },
    );
    observeDeviceSize(face.canvas, signal, (width, height, ratio) => {
      this.#size = { width: width / ratio, height: height / ratio };
      this.viewer.renderer.resize(width, height, ratio);
    });
  }

  /** The view's own canvas is not seen while the look stands. */
  #stayBehind(look: Preview): void {
    const { classList } = this.#face.canvas;
    this.#look = look;
    look.onEnd = () => {
      this.#look = undefined;
      classList.remove("covered");
      this.#rotate();
    };
    if (look.shapes.length === 0) return;
    classList.add("covered");
    this.poster.onPicture();
  }

  /** Begins to show the document; what is far outside of the window waits to be loaded. */
  start(): void {
    // Known before the first request: what is asked for first depends on what is seen.
    this.viewer.renderer.setSize(...deviceSizeOf(this.#face.canvas));
    this.viewer.start();
    const margin = marginOfLoading[this.#settings.loading];
    if (margin === Infinity) this.viewer.load();
    else
      whenNearViewport(this.#face.canvas, margin, this.#listeners.signal, () => {
        this.viewer.load();
      });
    if (this.#look?.shapes.length === 0) this.#look.end(); // its files are the viewer's now
  }

  /** Turns the scene, from now on. */
  play(): void {
    this.viewer.navigator.autoRotation.start(false);
  }

  pause(): void {
    this.viewer.navigator.autoRotation.stop();
  }

  dispose(): void {
    clearTimeout(this.#quietTimer);
    this.#hotspots.dispose();
    this.#listeners.abort();
    this.#look?.end();
    this.viewer.dispose();
  }

  /** What the picture is called. */
  get #label(): string {
    const words = [
      this.#settings.alt,
      ...["aria-label", "title"].map((name) => this.#x3d.getAttribute(name)),
      this.#x3d.querySelector("worldinfo")?.getAttribute("title"),
    ];
    return words.find((word) => word !== "" && word !== null && word !== undefined) ?? "3D scene";
  }

  /** What hands and keys may not do now. */
  readonly #limits = (): CameraInputLimits => ({
    isDisabled: !this.#settings["camera-controls"],
    canZoom: !this.#settings["disable-zoom"],
    canPan: !this.#settings["disable-pan"],
  });

  /** Attributes, and elements for slots, that come and go later. */
  #follow(host: Element): void {
    const onChildren = new MutationObserver(() => {
      adoptSlotted(this.#x3d, host);
    });
    onChildren.observe(this.#x3d, { childList: true });
    const onAttributes = new MutationObserver(() => {
      this.#settings = this.#readSettings();
      this.#apply();
    });
    onAttributes.observe(this.#x3d, { attributeFilter: [...Object.keys(viewAttributes), "aria-label", "title"] });
    const onHotspots = new MutationObserver(() => {
      this.#hotspots.read();
      this.viewer.renderer.requestFrame();
    });
    onHotspots.observe(host, {
      childList: true,
      subtree: true,
      attributeFilter: ["slot", "data-position", "data-normal"],
    });
    this.#hotspots.read();
    this.#listeners.signal.addEventListener("abort", () => {
      for (const observer of [onChildren, onAttributes, onHotspots]) observer.disconnect();
    });
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

  /** Shows whether a click would lead anywhere. */
  #pointAt(hit: Hit | undefined): void {
    const { canvas } = this.#face;
    const anchor = hit && this.viewer.renderer.anchorOf(hit);
    const link = anchor && this.#links.of(anchor);
    canvas.classList.toggle("points-at-link", link !== undefined);
    canvas.title = link?.textContent ?? "";
  }

  #apply(): void {
    const { renderer, navigator } = this.viewer;
    const settings = this.#settings;
    navigator.setCamera(cameraSettingOf(settings));
    navigator.autoRotation.delayMs = settings["auto-rotate-delay"];
    navigator.autoRotation.radiansPerSecond = settings["rotation-per-second"];
    renderer.setExposure(settings.exposure);
    renderer.drawAsPoints(settings["draw-as"] === "points");
    this.viewer.setBudget(settings.budget);
    this.poster.reveal = settings.reveal;
    this.#describe();
    this.#rotate();
  }

  /** Turns by itself where the page asks for it, there is something to see, and people do not mind motion. */
  #rotate(): void {
    const { autoRotation: turntable } = this.viewer.navigator;
    const wanted =
      this.#settings["auto-rotate"] &&
      this.poster.isModelVisible &&
      this.#look === undefined &&
      !this.#lessMotion.matches;
    if (!wanted) turntable.stop();
    else if (turntable.isStopped) turntable.start(true);
  }

  /** Says what the picture is and how it moves. */
  #describe(): void {
    const { canvas } = this.#face;
    const { type } = this.viewer.navigator;
    const isStill = this.#hands.type === "none";
    canvas.setAttribute("aria-label", this.#label);
    // An application is what gets the arrow keys from screen readers.
    canvas.setAttribute("role", isStill ? "img" : "application");
    canvas.ariaRoleDescription = isStill ? null : "3D view";
    canvas.ariaDescription = isStill ? null : keyLabels[type];
    canvas.tabIndex = isStill ? -1 : 0;
    canvas.classList.toggle("moves", !isStill);
    this.#applyTouchAction();
    this.#lists.update();
    if (this.#shownType !== undefined && this.#shownType !== type)
      this.#face.announce(`${navigationTypeLabels[type]}. ${keyLabels[type]}`);
    this.#shownType = type;
  }

  /** P: the attribute says how surfaces are drawn, so that pages can follow. */
  #toggleDrawing({ key, ctrlKey, metaKey, altKey }: KeyboardEvent): void {
    if (key.toLowerCase() !== "p" || ctrlKey || metaKey || altKey || this.#hands.type === "none") return;
    const drawing = this.#settings["draw-as"] === "points" ? "surface" : "points";
    this.#x3d.setAttribute("draw-as", drawing);
    this.#face.announce(drawingLabels[drawing]);
  }

  #showProgress(share: number, stage: StageName | "none"): void {
    this.#face.showProgress(share, stageLabels[stage]);
  }

  #onFrame(): void {
    const { navigator, renderer } = this.viewer;
    const { view } = renderer;
    if (this.#look && this.viewer.displays(this.#look.shapes)) this.#look.end();
    if (view !== undefined) this.#hotspots.place(view, this.#size.width, this.#size.height);
    this.#waysBack.update();
    if (navigator.pose === this.#shownPose) return;
    const isFirst = this.#shownPose === undefined;
    this.#shownPose = navigator.pose;
    this.#send("camera-change", { source: navigator.source });
    if (!isFirst && navigator.source !== "automatic") this.#sayViewSoon();
  }

  #sayViewSoon(): void {
    clearTimeout(this.#quietTimer);
    this.#quietTimer = setTimeout(() => {
      const { navigator } = this.viewer;
      this.#face.announce(navigator.viewpointName ?? viewLabelOf(orbitOf(navigator.pose)));
    }, quietMs);
  }

  #send(name: string, detail: object): void {
    this.#x3d.dispatchEvent(new CustomEvent(name, { detail, bubbles: false }));
  }
}

/** Moves a page's elements for our slots to where slots see them. */
function adoptSlotted(x3d: Element, host: Element): void {
  host.append(...Array.from(x3d.children).filter((child) => child !== host && child.hasAttribute("slot")));
}
