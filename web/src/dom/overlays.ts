// The overlays of a view: what it displays over its canvas only where its scene has it, or the user asks for it.
// Hotspots, links of Anchors, menus and help. lateOverlays.ts loads this module.

import type { AnchorDescription } from "../document/description.ts";
import type { NavigationType } from "../navigation/navigationType.ts";
import { AnchorLinks } from "./anchorLinks.ts";
import { openHelp } from "./helpDialog.ts";
import { Hotspots } from "./hotspots.ts";
import { Menus } from "./menus.ts";
import { pictureSavedLabel } from "./overlayLabels.ts";
import { overlayStyle } from "./overlayStyle.ts";
import type { PageViewer } from "./pageViewer.ts";
import { savePicture } from "./savePicture.ts";
import { ShapeVisibility } from "./shapeVisibility.ts";
import type { UserInterface } from "./userInterface.ts";

/** The view that overlays are displayed in. */
export interface OverlaidView {
  /** The view element, in whose shadow root `ui` is. */
  readonly host: HTMLElement;
  readonly ui: UserInterface;
  readonly viewer: PageViewer;
  /** The Anchors of the scene. */
  readonly anchors: () => readonly AnchorDescription[];
  /** Size of the canvas in CSS pixels. */
  readonly size: () => { readonly width: number; readonly height: number };
  readonly warn: (sentence: string) => void;
  /** Aborts when the view is disposed of. */
  readonly signal: AbortSignal;
}

export class Overlays {
  readonly hotspots: Hotspots;
  readonly links: AnchorLinks;
  readonly menus: Menus;
  readonly #ui: UserInterface;

  /** Displays what the scene has. */
  constructor({ host, ui, viewer, anchors, size, warn, signal }: OverlaidView) {
    const { cameraController, renderer } = viewer;
    const shapeVisibility = new ShapeVisibility();
    this.#ui = ui;
    host.shadowRoot?.adoptedStyleSheets.push(overlayStyle);
    this.hotspots = new Hotspots(host, ui.hotspots, {
      isStill: () => !renderer.statistics.isFrameDue && !cameraController.isMoving,
      pointAt: async (x, y) => {
        const { width, height } = size();
        const pixel = [Math.floor((x * ui.canvas.width) / width), Math.floor((y * ui.canvas.height) / height)] as const;
        return (await renderer.picker.pickAsync(...pixel))?.position.toArray();
      },
      isShapeVisible: (name) => {
        const { scene } = viewer.scene.core;
        return scene && shapeVisibility.isVisible(scene, name);
      },
    });
    this.links = new AnchorLinks(ui.links, cameraController, warn);
    this.menus = new Menus(ui.controls, cameraController, signal);
    signal.addEventListener("abort", () => {
      this.hotspots.dispose();
    });
    this.hotspots.read();
    const { view } = renderer;
    if (view !== undefined) this.hotspots.update(view, size().width, size().height);
    this.links.update(anchors());
    this.menus.update();
  }

  openHelp(type: NavigationType): void {
    openHelp(this.#ui.help, type);
  }

  /** `label`: of the scene, which names the file. */
  savePicture(picture: Blob, label: string): void {
    savePicture(picture, label);
    this.#ui.announce(pictureSavedLabel);
  }
}
