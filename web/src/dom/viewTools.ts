// The tools of a view, as buttons of its toolbar and as keys: drawing the vertices as points, full screen, saving a
// picture, help.

import type { CameraInput } from "./cameraInput.ts";
import { drawingLabels, fullScreenRefusedLabel } from "./labels.ts";
import type { LateOverlays } from "./lateOverlays.ts";
import type { OverlaidView } from "./overlays.ts";
import { Toolbar } from "./toolbar.ts";

export interface ToolsView extends Pick<OverlaidView, "host" | "ui" | "viewer" | "signal"> {
  readonly x3d: Element;
  readonly overlays: LateOverlays;
  readonly cameraInput: Pick<CameraInput, "type">;
  /** The label of the scene. */
  readonly label: () => string;
  readonly isDrawnAsPoints: () => boolean;
  /** The page has entered or left full screen. */
  readonly onFullScreen: () => void;
}

/** Adds the tools to the view; they end with its signal. */
export function addTools(view: ToolsView): Toolbar {
  const { host, ui, viewer, signal, x3d, overlays, cameraInput, label, isDrawnAsPoints, onFullScreen } = view;
  const isFullScreen = () => document.fullscreenElement === host;
  /** Changes the attribute `draw-as`, so that pages can observe it. */
  const toggleDrawing = () => {
    const drawing = isDrawnAsPoints() ? "surface" : "points";
    x3d.setAttribute("draw-as", drawing);
    ui.announce(drawingLabels[drawing]);
  };
  const toggleFullScreen = () => {
    void (isFullScreen() ? document.exitFullscreen() : host.requestFullscreen()).catch(() => {
      ui.announce(fullScreenRefusedLabel);
    });
  };
  const savePicture = () => {
    viewer.renderer.draw(); // what the canvas holds now can be read in this turn of the event loop only
    ui.canvas.toBlob((picture) => {
      if (picture === null) return; // a canvas without area
      overlays.use((loaded) => {
        loaded.savePicture(picture, label());
      });
    });
  };
  const openHelp = () => {
    overlays.use((loaded) => {
      loaded.openHelp(cameraInput.type);
    });
  };
  const toolbar = new Toolbar(
    ui.controls,
    {
      points: { onClick: toggleDrawing, isPressed: isDrawnAsPoints },
      fullScreen: { onClick: toggleFullScreen, isPressed: isFullScreen },
      picture: { onClick: savePicture },
      help: { onClick: openHelp, opensDialog: true },
    },
    signal,
  );
  if (!document.fullscreenEnabled) toolbar.hide("fullScreen"); // on iPhones, and in frames without permission
  document.addEventListener("fullscreenchange", onFullScreen, { signal });
  ui.canvas.addEventListener(
    "keydown",
    ({ key, ctrlKey, metaKey, altKey }) => {
      if (ctrlKey || metaKey || altKey || cameraInput.type === "none") return;
      if (key.toLowerCase() === "p") toggleDrawing();
      else if (key === "?") openHelp();
    },
    { signal },
  );
  return toolbar;
}
