// The entry of the npm package for pages: the runtime in one module, for apps with their own bundler.

import { ImgeoViewer } from "../element/imgeoViewer.ts";
import { ImgeoView } from "./imgeoView.ts";
import { partImports } from "./partImports.ts";
import { registerViews } from "./register.ts";

export { ImgeoView, ImgeoViewer };
export type { BlobOptions, ViewElement, ViewerElement, ViewpointEntry } from "./imgeoView.ts";
export type { ErrorDetail, Loadable, ProgressDetail, ResourceEntry } from "./loadingEvents.ts";
export type { SurfacePoint } from "./imgeoView.ts";
export type { ShapeEventProperties, ShapePointerEvent, Vector3D } from "./shapePointerEvent.ts";
export type { ViewStatistics } from "./pageViewer.ts";

registerViews(partImports);
