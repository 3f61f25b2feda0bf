// What the runtime adds to an <x3d>, and <imgeo-viewer> passes on: names of properties, methods and events.

export const viewMethods = [
  "play",
  "pause",
  "dismissPoster",
  "bindViewpoint",
  "resetView",
  "showAll",
  "getCameraOrbit",
  "getCameraPosition",
  "toBlob",
  "positionAndNormalFromPoint",
  "refineAt",
] as const;

export const viewProperties = ["statistics", "viewpoints", "paused"] as const;

/** Properties of everything that loads, shapes included. */
export const loadingProperties = ["firstImage", "complete", "errors", "resources"] as const;

/** Events that the runtime dispatches at <x3d>; none of them bubbles. */
export const viewEventNames = [
  "progress",
  "first-image",
  "refine",
  "load",
  "error",
  "camera-change",
  "model-visibility",
  "poster-dismissed",
] as const;
