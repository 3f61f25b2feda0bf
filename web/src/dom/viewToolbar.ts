// The toolbar of a view, with what each of its buttons does.

import { fullScreenRefusedLabel } from "./labels.ts";
import { Toolbar } from "./toolbar.ts";
import type { UserInterface } from "./userInterface.ts";

export interface ViewToolbarActions {
  readonly togglePoints: () => void;
  readonly isDrawnAsPoints: () => boolean;
  /** The page has entered or left full screen. */
  readonly onFullScreen: () => void;
  readonly savePicture: () => void;
  readonly openHelp: () => void;
}

/** `host`: the view element, which the full screen displays. */
export function makeViewToolbar(
  host: HTMLElement,
  ui: UserInterface,
  actions: ViewToolbarActions,
  signal: AbortSignal,
): Toolbar {
  const isFullScreen = () => document.fullscreenElement === host;
  const toolbar = new Toolbar(
    ui.controls,
    {
      points: { onClick: actions.togglePoints, isPressed: actions.isDrawnAsPoints },
      fullScreen: {
        onClick: () => {
          void (isFullScreen() ? document.exitFullscreen() : host.requestFullscreen()).catch(() => {
            ui.announce(fullScreenRefusedLabel);
          });
        },
        isPressed: isFullScreen,
      },
      picture: { onClick: actions.savePicture },
      help: { onClick: actions.openHelp, opensDialog: true },
    },
    signal,
  );
  if (!document.fullscreenEnabled) toolbar.hide("fullScreen"); // on iPhones, and in frames without permission
  document.addEventListener("fullscreenchange", actions.onFullScreen, { signal });
  return toolbar;
}
